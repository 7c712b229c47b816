use super::instruments::Instruments;
use super::paraview::Paraview;
use super::timeline::Due;
use super::{Plan, series};
use crate::Error;
use crate::case::Reference;
use crate::directory::Workplace;
use crate::model::{FlowModel, Model, Observer, StepReport, Stop};
use crate::run::checkpoint::Progressed;
use crate::run::keeper::Outputs;
use crate::run::{Recorder, Stops, Work};

/// Everything that a flow writes while it goes.
pub(super) struct FlowOutputs<'a> {
    plan: &'a Plan<'a>,
    record: Option<Recorder<FlowModel>>,
    pictures: Recorder<FlowModel>,
    paraview: Paraview,
    pub instruments: Instruments,
}

impl<'a> FlowOutputs<'a> {
    /// New files, in the place of those of a run that was stopped before its first checkpoint.
    pub fn create(plan: &'a Plan, model: &FlowModel, place: &Workplace) -> Result<Self, Error> {
        place.remove("record")?;
        let record = match &plan.case.record {
            Some(choice) => {
                let folder = place.fresh_folder("record")?;
                Some(Recorder::create(&folder, series::record(plan.case, choice))?)
            }
            None => None,
        };
        let pictures = place.fresh_folder("pictures")?;
        Ok(Self {
            plan,
            record,
            pictures: Recorder::create(&pictures, series::pictures(plan))?,
            paraview: Paraview::create(model, place)?,
            instruments: Instruments::open(plan.case, plan.points.clone(), place.path(), None)?,
        })
    }

    /// The files of a run that goes on, cut to where its checkpoint is.
    pub fn resume(
        plan: &'a Plan,
        model: &FlowModel,
        place: &Workplace,
        before: &Progressed,
    ) -> Result<Self, Error> {
        let folder = |name: &str| place.path().join(name);
        let count = |is_due: fn(&Due) -> bool| plan.timeline.before(before.stops, is_due);
        let record = plan.case.record.as_ref().map(|choice| {
            let snapshots = count(|due| due.snapshot);
            Recorder::resume(&folder("record"), series::record(plan.case, choice), snapshots)
        });
        let pictures = count(|due| due.picture);
        let pictures = Recorder::resume(&folder("pictures"), series::pictures(plan), pictures)?;
        let time = plan.timeline.time_of(before.stops - 1);
        let (points, lengths) = (plan.points.clone(), Some(&before.lengths[..]));
        Ok(Self {
            plan,
            record: record.transpose()?,
            pictures,
            paraview: Paraview::resume(model, place, time)?,
            instruments: Instruments::open(plan.case, points, place.path(), lengths)?,
        })
    }
}

impl Observer<FlowModel> for FlowOutputs<'_> {
    fn observe(&mut self, model: &FlowModel, stop: Stop, work: &Work) -> Result<(), Error> {
        let due = self.plan.timeline.due(stop.number);
        if due.snapshot
            && let Some(record) = &mut self.record
        {
            record.observe(model, stop, work)?;
        }
        if due.picture {
            self.pictures.observe(model, stop, work)?;
        }
        if due.paraview {
            self.paraview.write(model, stop.time)?;
        }
        if stop.number == 0 {
            self.instruments.follow(model)?;
        }
        // Readers that look on see the tables grow.
        Ok(self.instruments.flush(false)?)
    }

    fn stepped(&mut self, model: &FlowModel, report: &StepReport, dt: f64) -> Result<(), Error> {
        Ok(self.instruments.stepped(model, report, dt)?)
    }
}

impl Outputs<FlowModel> for FlowOutputs<'_> {
    fn flush(&mut self) -> Result<(), Error> {
        if let Some(record) = &mut self.record {
            record.flush()?;
        }
        self.pictures.flush()?;
        Ok(self.instruments.flush(true)?)
    }

    fn lengths(&self) -> Vec<u64> {
        self.instruments.lengths()
    }

    fn status(&self, model: &FlowModel) -> String {
        let (time, cfl) = (model.time(), model.courant_number());
        let iterations = model.last_step().iterations;
        let loads = loads(model, self.plan.case.reference.as_ref());
        format!("t = {time:.3} s, CFL {cfl:.2}, {iterations} iterations{loads}")
    }
}

/// The loads on the first bodies.
fn loads(model: &FlowModel, reference: Option<&Reference>) -> String {
    let flow = model.flow();
    let boundaries = flow.mesh().topology().boundaries().iter().zip(flow.loads());
    let bodies: Vec<&str> = model.bodies_in_it().take(2).collect();
    let of_body = boundaries.filter(|(boundary, _)| bodies.contains(&boundary.name.as_str()));
    let words = of_body.map(|(boundary, load)| {
        let name = &boundary.name;
        match reference {
            Some(reference) => {
                let [cd, cl] = reference.coefficients(load.force);
                format!(", {name} Cd {cd:.3} Cl {cl:.3}")
            }
            None => format!(", {name} F = ({:.3e}, {:.3e}) N/m", load.force[0], load.force[1]),
        }
    });
    words.collect()
}
