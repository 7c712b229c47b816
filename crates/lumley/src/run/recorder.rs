use super::Work;
use crate::Error;
use crate::case::PistonCase;
use crate::model::{Frame, Model, Observer};
use crate::record::{
    Description, FrameDescription, Quantity, RecordWriter, SeriesDescription, Snapshot, Support,
};
use std::path::Path;

/// How a gauge reads its model.
type Reading<M> = Box<dyn Fn(&M) -> Result<Vec<f64>, Error> + Send>;

/// A short vector that is read off the model and recorded with each snapshot, as a series.
pub struct Gauge<M> {
    name: &'static str,
    entries: Vec<Quantity>,
    sample: Reading<M>,
}

impl<M: Model> Gauge<M> {
    /// The series `name` with these entries, read off the model by `sample`.
    pub fn new(
        name: &'static str,
        entries: Vec<Quantity>,
        sample: impl Fn(&M) -> Result<Vec<f64>, Error> + Send + 'static,
    ) -> Self {
        Self { name, entries, sample: Box::new(sample) }
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
    interval: f64,
    frames: Vec<(Frame, Vec<f64>)>,
    gauges: Vec<Gauge<M>>,
}

/// The frames of a record, their supports, and the gauges beside them.
pub struct Plan<M> {
    /// Time between snapshots, in s.
    pub interval: f64,
    /// The frames and the nodes they have.
    pub frames: Vec<(Frame, Support)>,
    /// The gauges.
    pub gauges: Vec<Gauge<M>>,
}

impl<M: Model> Plan<M> {
    fn description(&self, case: &PistonCase) -> Description {
        let frame = |(frame, support): &(Frame, Support)| FrameDescription {
            name: frame.name().into(),
            support: support.clone(),
            length_unit: frame.length_unit().into(),
            components: vec![Quantity::new("u", "m/s")],
        };
        let series = |gauge: &Gauge<M>| SeriesDescription {
            name: gauge.name.into(),
            entries: gauge.entries.clone(),
        };
        let provenance = [
            ("program", format!("lumley {}", env!("CARGO_PKG_VERSION"))),
            ("case", case.name.clone()),
            ("case_file", case.to_toml()),
        ];
        Description {
            frames: self.frames.iter().map(frame).collect(),
            series: self.gauges.iter().map(series).collect(),
            provenance: provenance.map(|(key, value)| (key.to_owned(), value)).into(),
        }
    }
}

impl<M: Model> Recorder<M> {
    /// A new, empty record in `folder`.
    ///
    /// # Errors
    /// The failure of the disk.
    pub fn create(folder: &Path, case: &PistonCase, plan: Plan<M>) -> Result<Self, Error> {
        let writer = RecordWriter::create(folder, &plan.description(case))?;
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
        let buffer = |(frame, support): (Frame, Support)| (frame, vec![0.0; support.len()]);
        let interval = plan.interval;
        Self {
            writer,
            interval,
            frames: plan.frames.into_iter().map(buffer).collect(),
            gauges: plan.gauges,
        }
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
    fn observe(&mut self, model: &M, snapshot: usize, _: &Work) -> Result<(), Error> {
        // Not the model's own time, which is a sum of steps and of their round-off.
        let time = snapshot as f64 * self.interval;
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
