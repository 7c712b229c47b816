/// Whole steps between snapshots, whole intervals to the end: no snapshot falls between two steps.
///
/// ```
/// use lumley::case::Schedule;
/// let schedule = Schedule::new(5e-4, 0.01, 2.0).expect("whole numbers");
/// assert_eq!((schedule.steps_per_snapshot, schedule.intervals), (20, 200));
/// assert_eq!(schedule.snapshots(), 201);
/// assert!(Schedule::new(3e-4, 0.01, 2.0).is_none());
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Schedule {
    /// Time step, in s.
    pub step: f64,
    /// Time between snapshots, in s.
    pub interval: f64,
    /// Steps between snapshots.
    pub steps_per_snapshot: usize,
    /// Intervals between snapshots; the first snapshot is the initial state.
    pub intervals: usize,
}

impl Schedule {
    /// The schedule, if `interval` is a whole number of `step`s and `end` of `interval`s, to 1e-9.
    pub fn new(step: f64, interval: f64, end: f64) -> Option<Self> {
        let steps_per_snapshot = whole(interval / step)?;
        let intervals = whole(end / interval)?;
        Some(Self { step, interval, steps_per_snapshot, intervals })
    }

    /// Number of snapshots M, the initial state among them.
    pub fn snapshots(&self) -> usize {
        self.intervals + 1
    }

    /// Number of time steps to the end.
    pub fn steps(&self) -> usize {
        self.intervals * self.steps_per_snapshot
    }

    /// End of the run, in s.
    pub fn end(&self) -> f64 {
        self.time(self.intervals)
    }

    /// Time of snapshot `k`, in s, without the round-off of summed steps.
    pub fn time(&self, k: usize) -> f64 {
        k as f64 * self.interval
    }
}

/// `x` as a whole number of at least one, if it is one to 1e-9.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "checked to be in range"
)]
fn whole(x: f64) -> Option<usize> {
    let n = x.round();
    ((1.0..=1e15).contains(&n) && (x - n).abs() <= 1e-9 * n).then_some(n as usize)
}
