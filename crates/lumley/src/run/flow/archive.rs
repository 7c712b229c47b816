//! `end.npz` of a run directory, from which another run can start.

use super::start::{OUTSIDE, extent};
use crate::Error;
use crate::format::npz::{NpzReader, NpzWriter};
use crate::format::{FormatError, mesh};
use crate::model::FlowModel;
use faer::Mat;
use lumley_fem::space::NodalSpace;
use lumley_fem::{PlanarMesh, Point, PointLocator};
use std::path::Path;

/// Name of the mesh when nothing has moved, and of the last state.
pub(super) const MESH: &str = "mesh.npz";
pub(super) const END: &str = "end.npz";

/// Writes the state of the model.
pub(super) fn write_end(path: &Path, model: &FlowModel) -> Result<(), FormatError> {
    let flow = model.flow();
    let pressure = flow.pressure();
    let mut npz = NpzWriter::create(path)?;
    mesh::write_points(&mut npz, "points", flow.mesh().nodes())?;
    mesh::write_points(&mut npz, "velocity", flow.velocity())?;
    let pressures = Mat::from_fn(pressure.len(), 3, |cell, k| pressure[cell][k]);
    npz.matrix("pressure", pressures.as_ref())?;
    npz.vector("time", &[flow.time()])?;
    npz.finish()
}

/// The flow at the end of a run.
pub(super) struct End {
    mesh: PlanarMesh,
    space: NodalSpace,
    velocity: Vec<Point>,
    locator: PointLocator,
    outside: f64,
}

impl End {
    /// Of the complete run in `folder`.
    pub fn read(folder: &Path) -> Result<Self, Error> {
        let path = folder.join(END);
        let npz = NpzReader::open(&path)?;
        let mut mesh = mesh::read(&folder.join(MESH))?;
        let (nodes, velocity) =
            (mesh::read_points(&npz, "points")?, mesh::read_points(&npz, "velocity")?);
        let space = NodalSpace::velocity(mesh.topology());
        if nodes.len() != mesh.nodes().len() || velocity.len() != space.dofs().len() {
            let message = "it does not belong to mesh.npz beside it".to_owned();
            return Err(Error::Damaged { path, message });
        }
        mesh.nodes_mut().copy_from_slice(&nodes);
        let (locator, outside) = (PointLocator::new(&mesh), OUTSIDE * extent(&mesh));
        Ok(Self { mesh, space, velocity, locator, outside })
    }

    /// The velocity at a point, in m/s; `None` away from the mesh.
    pub fn velocity_at(&self, point: Point) -> Option<Point> {
        let at = self.locator.locate_near(&self.mesh, point, self.outside)?;
        Some(self.space.vector(&self.velocity, &at))
    }
}
