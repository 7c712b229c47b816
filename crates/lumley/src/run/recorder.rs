use super::Work;
use crate::Error;
use crate::model::{Frame, Model, Observer, Stop};
use crate::record::{
    Description, FrameDescription, Quantity, RecordWriter, SeriesDescription, Snapshot,
};
use std::path::Path;

/// How a gauge reads its model.
type Reading<M> = Box<dyn Fn(&M) -> Result<Vec<f64>, Error> + Send>;

/// A short vector that is read off the model and recorded with each snapshot, as a series.
pub struct Gauge<M> {
    name: String,
    entries: Vec<Quantity>,
    sample: Reading<M>,
}

impl<M: Model> Gauge<M> {
    /// The series `name` with these entries, read off the model by `sample`.
    pub fn new(
        name: impl Into<String>,
        entries: Vec<Quantity>,
        sample: impl Fn(&M) -> Result<Vec<f64>, Error> + Send + 'static,
    ) -> Self {
        Self { name: name.into(), entries, sample: Box::new(sample) }
    }

    /// Position and velocity of the piston.
    pub fn of_body() -> [Self; 2] {
        [
            Self::new("position", vec![Quantity::new("X", "m")], |model| {
                Ok(model.bodies()[0].position.clone())
            }),
            Self::new("velocity", vec![Quantity::new("X'", "m/s")], |model| {
                Ok(model.bodies()[0].velocity.clone())
            }),
        ]
    }
}

/// The observer that writes snapshots to a record: fields in frames, gauges as series.
pub struct Recorder<M> {
    writer: RecordWriter,
    frames: Vec<(Frame, Vec<f64>)>,
    gauges: Vec<Gauge<M>>,
}

/// What a record is of, its frames, and the gauges beside them.
pub struct Plan<M> {
    /// Name of the case.
    pub case: String,
    /// The resolved case file.
    pub case_file: String,
    /// Most snapshots that wait in memory, if not as many as 64 MiB hold.
    pub gathered: Option<usize>,
    /// The frames and what the record says of them.
    pub frames: Vec<(Frame, FrameDescription)>,
    /// The gauges.
    pub gauges: Vec<Gauge<M>>,
}

impl<M: Model> Plan<M> {
    fn description(&self) -> Description {
        let series = |gauge: &Gauge<M>| SeriesDescription {
            name: gauge.name.clone(),
            entries: gauge.entries.clone(),
        };
        let provenance = [
            ("program", format!("lumley {}", env!("CARGO_PKG_VERSION"))),
            ("case", self.case.clone()),
            ("case_file", self.case_file.clone()),
        ];
        Description {
            frames: self.frames.iter().map(|(_, description)| description.clone()).collect(),
            series: self.gauges.iter().map(series).collect(),
            provenance: provenance.map(|(key, value)| (key.to_owned(), value)).into(),
            gathered: self.gathered,
        }
    }
}

impl<M: Model> Recorder<M> {
    /// A new, empty record in `folder`.
    ///
    /// # Errors
    /// The failure of the disk.
    pub fn create(folder: &Path, plan: Plan<M>) -> Result<Self, Error> {
        let writer = RecordWriter::create(folder, &plan.description())?;
        Ok(Self::new(writer, plan))
    }

    /// The record in `folder`, cut to its first `snapshots`, to go on with.
    ///
    /// # Errors
    /// A record that is damaged or shorter.
    pub fn resume(folder: &Path, plan: Plan<M>, snapshots: usize) -> Result<Self, Error> {
        let mut writer = RecordWriter::open(folder)?;
        writer.truncate(snapshots)?;
        Ok(Self::new(writer, plan))
    }

    fn new(writer: RecordWriter, plan: Plan<M>) -> Self {
        let buffer = |(frame, description): (Frame, FrameDescription)| {
            (frame, vec![0.0; description.rows()])
        };
        Self { writer, frames: plan.frames.into_iter().map(buffer).collect(), gauges: plan.gauges }
    }

    /// Commits what was recorded so far.
    ///
    /// # Errors
    /// The failure of the disk.
    pub fn flush(&mut self) -> Result<(), Error> {
        Ok(self.writer.flush()?)
    }

    /// Commits everything and closes the record.
    ///
    /// # Errors
    /// The failure of the disk.
    pub fn finish(self) -> Result<(), Error> {
        Ok(self.writer.finish()?)
    }
}

impl<M: Model> Observer<M> for Recorder<M> {
    fn observe(&mut self, model: &M, Stop { time, .. }: Stop, _: &Work) -> Result<(), Error> {
        for (frame, values) in &mut self.frames {
            model.sample(frame, values)?;
        }
        let series = self.gauges.iter().map(|gauge| (gauge.sample)(model));
        let series: Vec<Vec<f64>> = series.collect::<Result<_, _>>()?;
        let fields: Vec<&[f64]> = self.frames.iter().map(|(_, values)| values.as_slice()).collect();
        let series: Vec<&[f64]> = series.iter().map(Vec::as_slice).collect();
        self.writer.append(&Snapshot { time, fields: &fields, series: &series })?;
        Ok(())
    }
}
