use super::raw::TimeSection;
use super::{FlowFile, March};
use crate::case::CaseError;
use crate::case::ask::{Ask, Number};
use lumley_fom::TimeScheme;
use lumley_fom::flow::{SteadyLimits, StepControl};

/// Most steps of a run, and most instants.
const MOST: f64 = 1e9;
/// How far, in steps, an instant may lie from the end of a step.
const ROUND_OFF: f64 = 1e-6;

/// The steps of a flow.
///
/// ```
/// let time = lumley::case::TimeChoice { end: 8.0, step: 0.004, steps: Some(2000), adaptive: None };
/// assert_eq!(time.step_at(0.1), 25);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimeChoice {
    /// End of the run, in s.
    pub end: f64,
    /// Time step, in s; with `adaptive` the first.
    pub step: f64,
    /// Number of steps; `None` where they follow the error.
    pub steps: Option<usize>,
    /// How they follow it.
    pub adaptive: Option<StepControl>,
}

impl TimeChoice {
    /// The number of the fixed step that ends at `time`, in s.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a checked case has at most 1e9 steps"
    )]
    pub fn step_at(&self, time: f64) -> usize {
        (time / self.step).round() as usize
    }
}

/// Equally spaced instants.
///
/// ```
/// let instants = lumley::case::Instants { start: 4.0, interval: 0.5, count: 9 };
/// assert_eq!(instants.time(8), 8.0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Instants {
    /// The first, in s.
    pub start: f64,
    /// Between two, in s.
    pub interval: f64,
    /// How many.
    pub count: usize,
}

impl Instants {
    /// Instant `k`, in s, without the round-off of summed intervals.
    pub fn time(&self, k: usize) -> f64 {
        self.start + k as f64 * self.interval
    }
}

/// Share of the reference velocity that counts as a large velocity where steps follow the error.
const REFERENCE_SHARE: f64 = 0.1;

/// Through time or to the steady flow, whichever the case asks for.
pub(super) fn march(ask: &Ask, file: &FlowFile) -> Result<March, CaseError> {
    match (&file.time, &file.steady) {
        (Some(time), None) => {
            let mut choice = unsteady(ask, time)?;
            if let (Some(adaptive), Some(reference)) = (&mut choice.adaptive, &file.flow.reference)
            {
                // What is slow beside the reference need not be resolved.
                adaptive.velocity =
                    adaptive.velocity.max(REFERENCE_SHARE * reference.velocity.abs());
            }
            Ok(March::Unsteady(choice))
        }
        (None, Some(steady)) => {
            let expected = "a number above 0 and below 1, such as 1e-9";
            let (tolerance, iterations) = (steady.tolerance, steady.iterations);
            let ok = tolerance > 0.0 && tolerance < 1.0;
            ask.that(ok, "steady.tolerance", Number(tolerance), expected)?;
            ask.that(iterations >= 1, "steady.iterations", iterations, "at least 1")?;
            Ok(March::Steady(SteadyLimits { tolerance, iterations }))
        }
        (Some(_), Some(_)) => {
            Err(ask.refuse("steady", "a table", "either [time] or [steady], not both"))
        }
        (None, None) => {
            let expected = "[time] with end and step in s, or [steady] for the steady flow";
            Err(ask.refuse("time", "nothing", expected))
        }
    }
}

fn unsteady(ask: &Ask, time: &TimeSection) -> Result<TimeChoice, CaseError> {
    let TimeSection { end, step, scheme, adaptive } = *time;
    ask.positive("time.end", end, "s")?;
    ask.positive("time.step", step, "s")?;
    let ok = scheme != TimeScheme::CrankNicolson;
    let expected = "bdf2 or implicit-euler: a flow has no rate of the pressure to begin with";
    ask.that(ok, "time.scheme", "crank-nicolson", expected)?;
    let most = format!("at least {:e} of time.end = {end:?} s", 1.0 / MOST);
    ask.that(end / step <= MOST, "time.step", Number(step), &most)?;
    let steps = match &adaptive {
        None => Some(whole(ask, "time.step", step, ("time.end", end))?),
        Some(adaptive) => {
            check_adaptive(ask, adaptive, step)?;
            None
        }
    };
    Ok(TimeChoice { end, step, steps, adaptive })
}

fn check_adaptive(ask: &Ask, adaptive: &StepControl, step: f64) -> Result<(), CaseError> {
    let StepControl { tolerance, shortest, longest, velocity } = *adaptive;
    ask.not_negative("time.adaptive.velocity", velocity, "m/s")?;
    let share = "a number above 0 and below 1, such as 1e-3";
    let ok = tolerance > 0.0 && tolerance < 1.0;
    ask.that(ok, "time.adaptive.tolerance", Number(tolerance), share)?;
    ask.positive("time.adaptive.shortest", shortest, "s")?;
    ask.positive("time.adaptive.longest", longest, "s")?;
    let ok = shortest <= longest;
    let least = format!("at least time.adaptive.shortest = {shortest:?} s");
    ask.that(ok, "time.adaptive.longest", Number(longest), &least)?;
    let between =
        format!("between the shortest and the longest step, {shortest:?} to {longest:?} s");
    ask.that((shortest..=longest).contains(&step), "time.step", Number(step), &between)
}

/// How many times `part`, the value of `key`, goes into a whole, which has a key and a value in s.
fn whole(ask: &Ask, key: &str, part: f64, (of, all): (&str, f64)) -> Result<usize, CaseError> {
    let count = (all / part).round();
    if count < 1.0 || (all / part - count).abs() > ROUND_OFF {
        let near = all / (all / part).ceil();
        let expected = format!("a whole fraction of {of} = {all:?} s, such as {near:?}");
        return Err(ask.refuse(key, Number(part), &expected));
    }
    Ok(to_count(count))
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "callers keep it between 0 and 1e9"
)]
fn to_count(count: f64) -> usize {
    count as usize
}

/// The instants from `start` on, every `interval`, as far as the run goes.
///
/// Fixed steps must end at each of them; adaptive steps are cut to.
pub(super) fn instants(
    ask: &Ask,
    time: &TimeChoice,
    (start_key, start): (&str, f64),
    (key, interval): (&str, f64),
) -> Result<Instants, CaseError> {
    ask.positive(key, interval, "s")?;
    let within = format!("a time in s from 0 to time.end = {:?} s", time.end);
    ask.that((0.0..=time.end).contains(&start), start_key, Number(start), &within)?;
    let most = format!("at least {:e} of time.end = {:?} s", 1.0 / MOST, time.end);
    ask.that(time.end / interval <= MOST, key, Number(interval), &most)?;
    if time.steps.is_some() {
        multiple(ask, key, interval, time.step)?;
        if start > 0.0 {
            multiple(ask, start_key, start, time.step)?;
        }
    }
    let count = ((time.end - start) / interval + ROUND_OFF).floor();
    Ok(Instants { start, interval, count: 1 + to_count(count) })
}

fn multiple(ask: &Ask, key: &str, value: f64, step: f64) -> Result<(), CaseError> {
    let count = (value / step).round();
    let ok = count >= 1.0 && (value / step - count).abs() <= ROUND_OFF;
    let near = count.max(1.0) * step;
    let expected = format!("a multiple of time.step = {step:?} s, such as {}", Rounded(near));
    ask.that(ok, key, Number(value), &expected)
}

/// A product in as many digits as a person would write: 0.3, not 0.30000000000000004.
struct Rounded(f64);

impl std::fmt::Display for Rounded {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let rounded: f64 = format!("{:.12e}", self.0).parse().unwrap_or(self.0);
        write!(f, "{rounded:?}")
    }
}
