use super::compare::Comparison;
use super::ground::{Ground, is_mapped};
use super::simulate::fixed_and_described;
use crate::Error;
use crate::case::Schedule;
use crate::directory::Workplace;
use crate::model::{Observer, StepError, Stop};
use crate::progress::Progress;
use crate::record::Quantity;
use crate::run::decompose::SWEEP;
use crate::run::parallel::in_parallel;
use crate::run::{Gauge, Plan, Recorder, Work, advance};
use crate::summary::{Failure, Reduced};
use lumley_rom::{Integrator, ModelChoice, ProjectionKind, ReducedError, ReducedPiston};
use std::path::Path;

/// Steps over which the time of one is measured.
const TIMED_STEPS: usize = 500;

/// One reduced model with one number of modes, after its run.
struct Attempt {
    res_percent: Option<f64>,
    failure: Option<Failure>,
    stable_step: Option<f64>,
}

/// Runs every reduced model of the case with 1, 2, ... modes on `threads` threads; records the one that is
/// shown in `rom/LABEL/record`.
pub(super) fn reduce(
    ground: &Ground,
    place: &Workplace,
    threads: usize,
    progress: &mut Progress,
) -> Result<Vec<Reduced>, Error> {
    let labels = labels(&ground.case.models);
    for label in &labels {
        place.fresh_folder(&format!("rom/{label}"))?;
    }
    let jobs = jobs(ground);
    progress.begin("reduced models", jobs.len());
    let results = in_parallel(&jobs, threads, progress, &|&(model, modes)| {
        let choice = &ground.case.models[model];
        let record = place.path().join("rom").join(&labels[model]).join("record");
        let keep = (modes == ground.shown_of(choice)).then_some(record);
        ground.attempt(choice, modes, keep.as_deref())
    })?;
    // Models that run side by side slow each other down: steps are timed one model at a time.
    let timed = jobs.iter().zip(&results).map(|(&(model, modes), attempt)| match attempt.failure {
        None => ground.step_us(&ground.case.models[model], modes),
        Some(_) => Ok(None),
    });
    let timed: Vec<Option<f64>> = timed.collect::<Result<_, _>>()?;
    let of_model = |k: usize| {
        let choice = &ground.case.models[k];
        let mut entry = entry(choice, &labels[k], ground.shown_of(choice));
        let mine = jobs.iter().zip(&results).zip(&timed).filter(|((job, _), _)| job.0 == k);
        for ((&(_, modes), attempt), step_us) in mine {
            entry.modes.push(modes);
            entry.res_percent.push(attempt.res_percent);
            entry.step_us.push(*step_us);
            entry.failure.push(attempt.failure.clone());
            entry.stable_step.push(attempt.stable_step);
        }
        entry
    };
    Ok((0..labels.len()).map(of_model).collect())
}

/// What the summary says of a model before any of its runs.
fn entry(choice: &ModelChoice, label: &str, shown: usize) -> Reduced {
    let (beta, sigma) = match choice.projection {
        ProjectionKind::Multiplier(multiplier) => (Some(multiplier.beta), None),
        ProjectionKind::Penalty(penalty) => (None, Some(penalty.sigma)),
        _ => (None, None),
    };
    Reduced {
        projection: choice.projection.name().to_owned(),
        beta,
        sigma,
        closure: choice.closure.name().to_owned(),
        reference_frame: is_mapped(choice),
        label: label.to_owned(),
        shown: Some(shown),
        ..Reduced::default()
    }
}

impl Ground<'_> {
    /// What is recorded of a reduced model.
    fn plan(&self, choice: &ModelChoice, modes: usize) -> Plan<ReducedPiston> {
        let [position, velocity] = Gauge::of_body();
        let unit = if is_mapped(choice) { "m/s" } else { "m3/2/s" };
        let names = (1..=modes).map(|n| Quantity::new(format!("a{n}"), unit)).collect();
        Plan {
            case: self.case.name.clone(),
            case_file: self.case.to_toml(),
            gathered: None,
            frames: vec![fixed_and_described(self.case)],
            gauges: vec![
                position,
                velocity,
                Gauge::new(
                    "traction",
                    vec![Quantity::new("tau", "m2/s2")],
                    |model: &ReducedPiston| Ok(vec![model.traction()]),
                ),
                Gauge::new("coefficients", names, |model: &ReducedPiston| {
                    Ok(model.coefficients().to_vec())
                }),
            ],
        }
    }

    /// Runs the model; a model that fails is a result, a disk that fails is an error.
    fn attempt(
        &self,
        choice: &ModelChoice,
        modes: usize,
        record: Option<&Path>,
    ) -> Result<Attempt, Error> {
        let mut attempt = Attempt { res_percent: None, failure: None, stable_step: None };
        match self.run(choice, modes, record, &mut attempt) {
            Err(Error::Step(StepError::Reduced(error @ ReducedError::Diverged { time, .. }))) => {
                attempt.failure = Some(Failure { time, message: error.to_string() });
                Ok(attempt)
            }
            Err(Error::Reduced(error @ ReducedError::TooLarge { .. })) => {
                attempt.failure = Some(Failure { time: 0.0, message: error.to_string() });
                Ok(attempt)
            }
            Err(other) => Err(other),
            Ok(()) => Ok(attempt),
        }
    }

    fn run(
        &self,
        choice: &ModelChoice,
        modes: usize,
        record: Option<&Path>,
        attempt: &mut Attempt,
    ) -> Result<(), Error> {
        let mut model = self.build(choice, modes)?;
        if matches!(self.case.integrator, Integrator::Rk4 {}) {
            attempt.stable_step = Some(model.stable_step());
        }
        let recorder = match record {
            Some(folder) => Some(Recorder::create(folder, self.plan(choice, modes))?),
            None => None,
        };
        let mut observer = Both { recorder, comparison: self.comparison() };
        let finished = advance(&mut model, &self.case.rom_schedule, 0, &mut observer);
        if let Some(recorder) = observer.recorder {
            recorder.finish()?;
        }
        finished?;
        attempt.res_percent = observer.comparison.map(|c| c.percent());
        Ok(())
    }

    /// Time of a step of a model that is known to run, in µs, over the first steps.
    fn step_us(&self, choice: &ModelChoice, modes: usize) -> Result<Option<f64>, Error> {
        let schedule = &self.case.rom_schedule;
        let intervals = TIMED_STEPS.div_ceil(schedule.steps_per_snapshot).min(schedule.intervals);
        let mut model = self.build(choice, modes)?;
        let work = advance(&mut model, &Schedule { intervals, ..*schedule }, 0, &mut Nobody)?;
        Ok(work.step_us())
    }
}

/// Watches nothing.
struct Nobody;

impl Observer<ReducedPiston> for Nobody {
    fn observe(&mut self, _: &ReducedPiston, _: Stop, _: &Work) -> Result<(), Error> {
        Ok(())
    }
}

struct Both<'a> {
    recorder: Option<Recorder<ReducedPiston>>,
    comparison: Option<Comparison<'a>>,
}

impl Observer<ReducedPiston> for Both<'_> {
    fn observe(&mut self, model: &ReducedPiston, stop: Stop, work: &Work) -> Result<(), Error> {
        if let Some(recorder) = &mut self.recorder {
            recorder.observe(model, stop, work)?;
        }
        self.comparison.as_mut().map_or(Ok(()), |c| c.observe(model, stop, work))
    }
}

/// Pairs of model and number of modes: 1 to [`SWEEP`], as far as the basis goes, and the number that is shown.
fn jobs(ground: &Ground) -> Vec<(usize, usize)> {
    let numbers = |choice: &ModelChoice| {
        let (shown, most) = (ground.shown_of(choice), ground.most_of(choice));
        (1..=most).filter(move |n| *n <= SWEEP || *n == shown)
    };
    let models = ground.case.models.iter().enumerate();
    models.flat_map(|(k, choice)| numbers(choice).map(move |n| (k, n))).collect()
}

/// One name for each model: the projection, its closure, and a number where that is not enough.
fn labels(models: &[ModelChoice]) -> Vec<String> {
    let mut labels: Vec<String> = Vec::new();
    for choice in models {
        let projection = choice.projection.name();
        let plain = match choice.closure.name() {
            "none" => projection.to_owned(),
            closure => format!("{projection}-{closure}"),
        };
        let numbered = (2..).map(|k| format!("{plain}-{k}"));
        let mut candidates = std::iter::once(plain.clone()).chain(numbered);
        labels.extend(candidates.find(|label| !labels.contains(label)));
    }
    labels
}
