use crate::directory::{DirectoryError, Workplace};
use crate::format::FormatError;
use crate::format::vtu::{Collection, Frame, Values, VtuWriter};
use crate::model::{FlowModel, NodalFields};
use std::path::PathBuf;

/// Name of the folder, of the series and of its files.
const FOLDER: &str = "paraview";

/// The files for ParaView.
pub(super) struct Paraview {
    folder: PathBuf,
    writer: VtuWriter,
    series: Collection,
    fields: NodalFields,
}

impl Paraview {
    /// An empty series, in the place of an older one.
    pub fn create(model: &FlowModel, place: &Workplace) -> Result<Self, DirectoryError> {
        let folder = place.fresh_folder(FOLDER)?;
        let series = Collection::new(folder.join("flow.pvd"));
        Ok(Self::new(model, folder, series))
    }

    /// The series as far as it went until `time`, in s.
    pub fn resume(model: &FlowModel, place: &Workplace, time: f64) -> Result<Self, crate::Error> {
        let folder = place.folder(FOLDER)?;
        let series = Collection::resume(folder.join("flow.pvd"), time)?;
        Ok(Self::new(model, folder, series))
    }

    fn new(model: &FlowModel, folder: PathBuf, series: Collection) -> Self {
        let space = model.flow().space();
        Self { folder, writer: VtuWriter::new(space), series, fields: NodalFields::new(space) }
    }

    /// Adds the flow as it is at `time`, in s.
    pub fn write(&mut self, model: &FlowModel, time: f64) -> Result<(), FormatError> {
        let flow = model.flow();
        self.fields.update(flow);
        let point_fields = [
            ("velocity", Values::Vectors(flow.velocity())),
            ("pressure", Values::Scalars(&self.fields.pressure)),
            ("vorticity", Values::Scalars(&self.fields.vorticity)),
            ("mesh_velocity", Values::Vectors(flow.mesh_velocity())),
        ];
        let points = flow.dof_points();
        let frame = Frame { time, points, point_fields: &point_fields, cell_fields: &[] };
        let name = format!("flow-{:06}.vtu", self.series.entries().len());
        self.writer.write(&self.folder.join(&name), &frame)?;
        self.series.push(time, &name)
    }
}
