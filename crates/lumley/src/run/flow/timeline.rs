use crate::case::{FlowCase, Instants, March, TimeChoice};
use crate::run::Stops;
use crate::run::advance::whole_part;
use std::collections::BTreeMap;

/// Steps between checkpoints: a factorisation costs less than one of them.
const STEPS_BETWEEN: usize = 100;
/// Most pictures of a run.
pub(super) const PICTURES: usize = 100;
/// Adaptive runs tell instants apart, and their progress, by this part of their length.
const PARTS: f64 = 1e9;
const SHOWN_PARTS: f64 = 1e3;

/// What is done at a stop.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
#[expect(clippy::struct_excessive_bools, reason = "each is due or not, whatever the others are")]
pub(super) struct Due {
    pub snapshot: bool,
    pub picture: bool,
    pub paraview: bool,
    pub checkpoint: bool,
}

/// When a flow is recorded, drawn, written for ParaView, and kept.
///
/// Checkpoints stand at fixed distances in simulated time, so that they depend on nothing but the case.
#[derive(Debug, Clone)]
pub(super) struct Timeline {
    step: f64,
    end: f64,
    fixed: bool,
    stops: Vec<Stop>,
}

#[derive(Debug, Clone, Copy)]
struct Stop {
    /// In steps, or parts of the end.
    at: u64,
    time: f64,
    due: Due,
}

/// The stops while they are gathered.
struct Draft<'a> {
    time: &'a TimeChoice,
    stops: BTreeMap<u64, Stop>,
}

impl Timeline {
    pub fn new(case: &FlowCase) -> Self {
        match &case.march {
            March::Steady(_) => Self::steady(),
            March::Unsteady(time) => Self::unsteady(case, time),
        }
    }

    /// One stop at which everything is written but a record.
    fn steady() -> Self {
        let due = Due { picture: true, paraview: true, ..Due::default() };
        Self { step: 1.0, end: 0.0, fixed: true, stops: vec![Stop { at: 0, time: 0.0, due }] }
    }

    fn unsteady(case: &FlowCase, time: &TimeChoice) -> Self {
        let mut draft = Draft { time, stops: BTreeMap::new() };
        let everything = Instants { start: 0.0, interval: time.end, count: 2 };
        draft.add(&everything, |_| {});
        if let Some(record) = &case.record {
            draft.add(&record.when, |due| due.snapshot = true);
        }
        let pictures = pictures(case, time);
        draft.add(&pictures, |due| due.picture = true);
        let last = Instants { start: time.end, interval: time.end, count: 1 };
        draft.add(case.paraview.as_ref().unwrap_or(&last), |due| due.paraview = true);
        draft.add(&last, |due| due.paraview = true);
        draft.add(&checkpoints(time), |due| due.checkpoint = true);
        let stops = draft.stops.into_values().collect();
        Self { step: time.step, end: time.end, fixed: time.steps.is_some(), stops }
    }

    pub fn due(&self, k: usize) -> Due {
        self.stops[k].due
    }

    /// How many pictures are taken.
    pub fn pictures(&self) -> usize {
        self.before(self.stops.len(), |due| due.picture)
    }

    /// At how many of the first `count` stops that is due.
    pub fn before(&self, count: usize, is_due: impl Fn(&Due) -> bool) -> usize {
        self.stops.iter().take(count).filter(|stop| is_due(&stop.due)).count()
    }
}

impl Draft<'_> {
    fn add(&mut self, instants: &Instants, mark: impl Fn(&mut Due)) {
        for k in 0..instants.count {
            let time = instants.time(k).min(self.time.end);
            let at = match self.time.steps {
                Some(_) => self.time.step_at(time) as u64,
                None => whole_part(time / self.time.end * PARTS) as u64,
            };
            let stop = Stop { at, time, due: Due::default() };
            mark(&mut self.stops.entry(at).or_insert(stop).due);
        }
    }
}

/// At most [`PICTURES`]: of the snapshots where there are such, else of the whole run.
fn pictures(case: &FlowCase, time: &TimeChoice) -> Instants {
    match (&case.record, time.steps) {
        (Some(record), _) => every(&record.when, record.when.count.div_ceil(PICTURES)),
        (None, Some(steps)) => {
            let all = Instants { start: 0.0, interval: time.step, count: steps + 1 };
            every(&all, (steps + 1).div_ceil(PICTURES))
        }
        (None, None) => {
            let interval = time.end / (PICTURES - 1) as f64;
            Instants { start: 0.0, interval, count: PICTURES }
        }
    }
}

/// Every `n`-th instant.
fn every(instants: &Instants, n: usize) -> Instants {
    let &Instants { start, interval, count } = instants;
    Instants { start, interval: n as f64 * interval, count: count.div_ceil(n) }
}

fn checkpoints(time: &TimeChoice) -> Instants {
    let step = time.adaptive.map_or(time.step, |adaptive| adaptive.longest);
    let interval = STEPS_BETWEEN as f64 * step;
    Instants { start: 0.0, interval, count: 1 + whole_part(time.end / interval) }
}

impl Stops for Timeline {
    fn count(&self) -> usize {
        self.stops.len()
    }

    fn time_of(&self, k: usize) -> f64 {
        self.stops[k].time
    }

    #[expect(clippy::cast_possible_truncation, reason = "a checked case has at most 1e9 steps")]
    fn steps_to(&self, k: usize) -> usize {
        (self.stops[k].at - self.stops[k - 1].at) as usize
    }

    fn step(&self) -> f64 {
        self.step
    }

    fn keeps(&self, k: usize) -> bool {
        self.stops[k].due.checkpoint
    }

    fn progress(&self, time: f64) -> (usize, usize) {
        let (part, parts) = if self.fixed {
            (self.step, self.end / self.step)
        } else {
            (self.end / SHOWN_PARTS, SHOWN_PARTS)
        };
        (whole_part(time / part), whole_part(parts))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Case;

    fn of(settings: &[&str]) -> Result<(FlowCase, Timeline), Box<dyn std::error::Error>> {
        let text = crate::cases::find("cylinder-2d2").ok_or("it comes with lumley")?.text;
        let settings: Vec<String> = settings.iter().map(|&setting| setting.into()).collect();
        match Case::parse("cylinder-2d2/case.toml".as_ref(), text, true, &settings)? {
            Case::Flow(case) => Ok((*case.clone(), Timeline::new(&case))),
            Case::Piston(_) => Err("it has a [flow]".into()),
        }
    }

    /// Steps of 0.01 s to 3 s: snapshots every 0.02 s from 2 s on, files every 0.1 s, checkpoints every second.
    #[test]
    fn fixed_steps_meet_every_instant() -> Result<(), Box<dyn std::error::Error>> {
        let (_, timeline) = of(&[])?;
        let all = timeline.count();
        assert_eq!((1..all).map(|k| timeline.steps_to(k)).sum::<usize>(), 300);
        assert_eq!(timeline.time_of(all - 1), 3.0);
        assert_eq!(timeline.before(all, |due| due.snapshot), 51);
        assert_eq!(timeline.before(all, |due| due.picture), 51);
        assert_eq!(timeline.before(all, |due| due.paraview), 31);
        let kept = (0..all).filter(|&k| timeline.keeps(k)).map(|k| timeline.time_of(k));
        assert_eq!(kept.collect::<Vec<_>>(), [0.0, 1.0, 2.0, 3.0]);
        for k in 1..all {
            assert!(timeline.time_of(k) > timeline.time_of(k - 1));
        }
        assert_eq!(timeline.progress(1.5), (150, 300));
        Ok(())
    }

    #[test]
    fn there_are_not_too_many_pictures() -> Result<(), Box<dyn std::error::Error>> {
        for settings in [&["record.interval=0.01", "record.start=0.0"][..], &["time.end=8.0"]] {
            let (_, timeline) = of(settings)?;
            assert!((50..=PICTURES).contains(&timeline.pictures()), "{}", timeline.pictures());
        }
        Ok(())
    }

    /// What is cut for a step that follows the error: only instants of the case and checkpoints.
    #[test]
    fn adaptive_steps_have_the_same_instants() -> Result<(), Box<dyn std::error::Error>> {
        let adaptive = "time.adaptive={ tolerance = 1e-3, shortest = 1e-3, longest = 0.01 }";
        let (_, timeline) = of(&[adaptive])?;
        let (_, fixed) = of(&[])?;
        assert_eq!(timeline.count(), fixed.count());
        for k in 0..fixed.count() {
            assert_eq!(timeline.due(k), fixed.due(k));
            assert!((timeline.time_of(k) - fixed.time_of(k)).abs() < 1e-12);
        }
        assert_eq!(timeline.progress(1.5), (500, 1000));
        Ok(())
    }
}
