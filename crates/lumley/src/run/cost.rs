use super::compare::Comparison;
use super::ground::Ground;
use super::simulate::{fixed, full_order};
use super::advance;
use crate::Error;
use crate::case::{Case, Schedule};
use crate::summary::{Reduced, Speedup, Variant};

/// Coarser full-order models of the same scheme, each cheaper than all that are more accurate, as far as
/// the most accurate of the reduced models.
///
/// A reduced model is fast against the full-order model that made it; whether that is worth anything
/// depends on what a coarser full-order model would have cost.
pub(super) fn variants(ground: &Ground, reduced: &[Reduced]) -> Result<Vec<Variant>, Error> {
    let targets = reduced.iter().filter_map(Reduced::shown_res).filter(|res| *res < 100.0);
    let strictest = targets.fold(f64::INFINITY, f64::min);
    let mut variants: Vec<Variant> = Vec::new();
    let best = |variants: &[Variant]| variants.last().map_or(f64::INFINITY, |v| v.res_percent);
    for (cells, steps) in coarser(ground.case) {
        if best(&variants) <= strictest || strictest.is_infinite() {
            break;
        }
        let variant = measure(ground, cells, steps)?;
        variants.extend(variant.filter(|v| v.res_percent < best(&variants)));
    }
    Ok(variants)
}

/// The cheapest of `variants` that is no less accurate than `model`, beside it.
pub(super) fn speedup(case: &Case, model: &Reduced, variants: &[Variant]) -> Option<Speedup> {
    let res_percent = model.shown_res()?;
    let reduced_ms = model.shown_step_us()? * case.rom_schedule.steps() as f64 / 1e3;
    let accurate = variants.iter().filter(|variant| variant.res_percent <= res_percent);
    let full = *accurate.min_by(|a, b| a.milliseconds().total_cmp(&b.milliseconds()))?;
    Some(Speedup { full, reduced_ms, ratio: full.milliseconds() / reduced_ms })
}

/// Numbers of cells and of steps per snapshot, halved again and again, cheapest first; last the run's own.
fn coarser(case: &Case) -> Vec<(usize, usize)> {
    let halves = |n: usize| (0..).map(move |k| n >> k).take_while(|n| *n > 0);
    let steps = || halves(case.schedule.steps_per_snapshot);
    let cells = halves(case.cells).filter(|cells| *cells >= 4);
    let mut sizes: Vec<_> = cells.flat_map(|c| steps().map(move |s| (c, s))).collect();
    sizes.sort_by_key(|(cells, steps)| cells * steps);
    sizes
}

/// Runs the full-order model with other cells and steps per snapshot; `None` where it fails, as very
/// coarse ones may.
fn measure(ground: &Ground, cells: usize, steps: usize) -> Result<Option<Variant>, Error> {
    let (case, Some(full)) = (ground.case, &ground.full) else { return Ok(None) };
    let step = case.schedule.interval / steps as f64;
    let schedule = Schedule { step, steps_per_snapshot: steps, ..case.schedule };
    let mut model = full_order(&Case { cells, ..case.clone() })?;
    let mut comparison = Comparison::new(fixed(case), full.as_ref(), &ground.product);
    let work = match advance(&mut model, &schedule, 0, &mut comparison) {
        Ok(work) => work,
        Err(Error::Step(_)) => return Ok(None),
        Err(other) => return Err(other),
    };
    let (step_us, steps) = (work.step_us().unwrap_or_default(), schedule.steps());
    Ok(Some(Variant { cells, step, steps, step_us, res_percent: comparison.percent() }))
}
