use super::ground::Ground;
use super::simulate::full_order;
use crate::Error;
use crate::case::{PistonCase, Schedule};
use crate::model::Model;
use crate::progress::Progress;
use crate::run::{Work, advance};
use crate::summary::{Reduced, Speedup, Variant};
use lumley_rom::ModelChoice;

/// Share of its error that a reduced model may lose to a longer step.
const LOSS: f64 = 0.02;

/// Coarser full-order models of the same scheme, each cheaper than all that are more accurate, as far as
/// the most accurate of the reduced models; if none is, the run's own, which took `work`, is the last.
///
/// A reduced model is fast against the full-order model that made it; whether that is worth anything
/// depends on what a coarser full-order model would have cost.
pub(super) fn variants(
    ground: &Ground,
    work: &Work,
    reduced: &[Reduced],
    progress: &mut Progress,
) -> Result<Vec<Variant>, Error> {
    let targets = reduced.iter().filter_map(Reduced::shown_res).filter(|res| *res < 100.0);
    let strictest = targets.fold(f64::INFINITY, f64::min);
    let mut variants: Vec<Variant> = Vec::new();
    let best = |variants: &[Variant]| variants.last().map_or(f64::INFINITY, |v| v.res_percent);
    let sizes = coarser(ground.case);
    progress.begin("cost", sizes.len());
    for (k, (cells, steps)) in sizes.into_iter().enumerate() {
        progress.advance(k, &format!("{cells} cells, {steps} steps per snapshot"));
        if best(&variants) <= strictest || strictest.is_infinite() {
            break;
        }
        let model = full_order(&PistonCase { cells, ..ground.case.clone() })?;
        let variant = measure(ground, model, cells, &with_steps(&ground.case.schedule, steps))?;
        variants.extend(variant.filter(|v| v.res_percent < best(&variants)));
    }
    if best(&variants) > strictest && strictest.is_finite() {
        variants.push(own(ground, work));
    }
    // Cells and steps only foretell the time: by the time itself, what is beaten goes.
    let times: Vec<f64> = variants.iter().map(Variant::milliseconds).collect();
    let mut later = times.iter().enumerate().map(|(k, time)| times[k..].iter().all(|t| t >= time));
    variants.retain(|_| later.next().unwrap_or(true));
    Ok(variants)
}

/// The shown run of `model` with the longest step that keeps its accuracy, beside the cheapest of
/// `variants` that is no less accurate.
pub(super) fn speedup(
    ground: &Ground,
    choice: &ModelChoice,
    model: &Reduced,
    variants: &[Variant],
) -> Result<Option<Speedup>, Error> {
    let (Some(res_percent), Some(modes)) = (model.shown_res(), model.shown) else {
        return Ok(None);
    };
    let accurate = variants.iter().filter(|variant| variant.res_percent <= res_percent);
    let cheapest = accurate.min_by(|a, b| a.milliseconds().total_cmp(&b.milliseconds()));
    let Some(full) = cheapest.copied() else { return Ok(None) };
    let schedule = &ground.case.rom_schedule;
    let mut longest = None;
    for steps in halves(schedule.steps_per_snapshot) {
        let run =
            measure(ground, ground.build(choice, modes)?, modes, &with_steps(schedule, steps))?;
        match run.filter(|run| run.res_percent <= (1.0 + LOSS) * res_percent) {
            Some(run) => longest = Some(run),
            None => break,
        }
    }
    Ok(longest.map(|reduced| {
        let ratio = full.milliseconds() / reduced.milliseconds();
        Speedup { reduced, full, ratio }
    }))
}

/// The run itself, which has no error against itself.
fn own(ground: &Ground, work: &Work) -> Variant {
    let schedule = &ground.case.schedule;
    Variant {
        size: ground.case.cells,
        step: schedule.step,
        steps: schedule.steps(),
        step_us: work.step_us().unwrap_or_default(),
        res_percent: 0.0,
    }
}

/// Numbers of cells and of steps per snapshot, halved again and again, cheapest first, without the run's
/// own.
fn coarser(case: &PistonCase) -> Vec<(usize, usize)> {
    let cells = halves(case.cells).filter(|cells| *cells >= 4);
    let steps = || halves(case.schedule.steps_per_snapshot);
    let mut sizes: Vec<_> = cells.flat_map(|c| steps().map(move |s| (c, s))).collect();
    sizes.sort_by_key(|(cells, steps)| cells * steps);
    sizes.pop();
    sizes
}

fn halves(n: usize) -> impl Iterator<Item = usize> {
    (0..usize::BITS).map(move |k| n >> k).take_while(|n| *n > 0)
}

fn with_steps(schedule: &Schedule, steps: usize) -> Schedule {
    Schedule { step: schedule.interval / steps as f64, steps_per_snapshot: steps, ..*schedule }
}

/// Runs `model` and compares it with the run; `None` where it fails, as very coarse ones may.
fn measure<M: Model>(
    ground: &Ground,
    mut model: M,
    size: usize,
    schedule: &Schedule,
) -> Result<Option<Variant>, Error> {
    let Some(mut comparison) = ground.comparison() else { return Ok(None) };
    let work = match advance(&mut model, schedule, 0, &mut comparison) {
        Ok(work) => work,
        Err(Error::Step(_)) => return Ok(None),
        Err(other) => return Err(other),
    };
    Ok(Some(Variant {
        size,
        step: schedule.step,
        steps: schedule.steps(),
        step_us: work.step_us().unwrap_or_default(),
        res_percent: comparison.percent(),
    }))
}
