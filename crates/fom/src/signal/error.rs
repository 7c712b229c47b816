/// Why a signal has no statistics.
///
/// ```
/// use lumley_fom::signal::{Signal, SignalError};
/// let error = Signal::new(&[0.0, 1.0], &[3.0]).expect_err("a value is missing");
/// assert!(matches!(error, SignalError::Count { times: 2, values: 1 }));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum SignalError {
    /// Not one value for each time, or none at all.
    #[error(
        "{times} times and {values} values\n  help: give one value for each time, and at least one"
    )]
    Count {
        /// Times given.
        times: usize,
        /// Values given.
        values: usize,
    },
    /// A number is infinite or not one.
    #[error(
        "entry {index}: value {value} at {time} s\n  help: give finite numbers; drop those after a divergence"
    )]
    NotFinite {
        /// The entry, counted from 0.
        index: usize,
        /// Its time, in s.
        time: f64,
        /// Its value.
        value: f64,
    },
    /// Times do not increase.
    #[error(
        "entry {index}: time {time} s does not come after {previous} s\n  help: give strictly increasing times"
    )]
    Order {
        /// The entry, counted from 0.
        index: usize,
        /// Its time, in s.
        time: f64,
        /// The time before, in s.
        previous: f64,
    },
}
