use serde::{Deserialize, Serialize};

/// A function of time by values at times. Between them, cubic polynomials whose slopes at the times are those of the
/// parabola through the neighbours, so that the velocity has no jumps; parabolas are met exactly. Before the first and
/// after the last time it keeps the value: let the table begin and end at rest, or cover the whole run.
///
/// ```
/// use lumley_body::joint::Table;
/// let table = Table::new(vec![0.0, 1.0, 3.0], vec![0.0, 1.0, 9.0])?;
/// assert_eq!([-1.0, 0.5, 2.0, 4.0].map(|t| table.at(t)), [0.0, 0.25, 4.0, 9.0]);
/// let error = Table::new(vec![0.0, 1.0, 0.5], vec![0.0; 3]).unwrap_err();
/// assert!(error.to_string().starts_with("motion table: time 3 is 0.5 s after 1 s"));
/// # Ok::<(), lumley_body::joint::TableError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Columns", into = "Columns")]
pub struct Table {
    times: Vec<f64>,
    values: Vec<f64>,
    slopes: Vec<f64>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Columns {
    times: Vec<f64>,
    values: Vec<f64>,
}

/// Why a table is no function of time.
///
/// ```
/// use lumley_body::joint::TableError;
/// let error = TableError::Length { times: 3, values: 2 };
/// assert_eq!(error.to_string(), "motion table: 3 times and 2 values, expected as many of each, and one or more");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum TableError {
    /// Columns of different lengths, or empty.
    #[error(
        "motion table: {times} times and {values} values, expected as many of each, and one or more"
    )]
    Length {
        /// Number of times.
        times: usize,
        /// Number of values.
        values: usize,
    },
    /// A time that is not after the one before.
    #[error(
        "motion table: time {row} is {found} s after {before} s, expected times that increase: sort the rows by time"
    )]
    Backwards {
        /// Which one, counted from 1.
        row: usize,
        /// The time found, in s.
        found: f64,
        /// The one before it, in s.
        before: f64,
    },
    /// An entry that is not a finite number.
    #[error("motion table: row {row} is {value} at {time} s, expected finite numbers")]
    NotFinite {
        /// Which one, counted from 1.
        row: usize,
        /// Its time, in s.
        time: f64,
        /// Its value.
        value: f64,
    },
}

impl Table {
    /// The function that has these values at these times, in s.
    ///
    /// # Errors
    /// Every variant of [`TableError`].
    pub fn new(times: Vec<f64>, values: Vec<f64>) -> Result<Self, TableError> {
        if times.len() != values.len() || times.is_empty() {
            return Err(TableError::Length { times: times.len(), values: values.len() });
        }
        for (row, (&time, &value)) in (1..).zip(times.iter().zip(&values)) {
            if !(time.is_finite() && value.is_finite()) {
                return Err(TableError::NotFinite { row, time, value });
            }
        }
        for (row, pair) in (2..).zip(times.windows(2)) {
            if pair[1] <= pair[0] {
                return Err(TableError::Backwards { row, found: pair[1], before: pair[0] });
            }
        }
        let slopes = slopes(&times, &values);
        Ok(Self { times, values, slopes })
    }

    /// Its value at a time in s.
    pub fn at(&self, time: f64) -> f64 {
        let next = self.times.partition_point(|&t| t <= time);
        let last = self.times.len() - 1;
        if next == 0 || next > last {
            return self.values[next.min(last)];
        }
        let k = next - 1;
        let length = self.times[next] - self.times[k];
        let s = (time - self.times[k]) / length;
        let rise = self.values[next] - self.values[k];
        let (left, right) = (length * self.slopes[k] - rise, length * self.slopes[next] - rise);
        self.values[k] + s * (rise + (1.0 - s) * ((1.0 - s) * left - s * right))
    }
}

/// Slope at each time of the parabola through it and its neighbours, at the ends that of the last parabola.
fn slopes(times: &[f64], values: &[f64]) -> Vec<f64> {
    let n = times.len();
    let secant = |k: usize| (values[k + 1] - values[k]) / (times[k + 1] - times[k]);
    let slope = |k: usize| match n {
        1 => 0.0,
        2 => secant(0),
        _ => {
            let middle = k.clamp(1, n - 2);
            let curvature =
                (secant(middle) - secant(middle - 1)) / (times[middle + 1] - times[middle - 1]);
            let before = secant(middle - 1);
            before + curvature * (2.0 * times[k] - times[middle] - times[middle - 1])
        }
    };
    (0..n).map(slope).collect()
}

impl TryFrom<Columns> for Table {
    type Error = TableError;

    fn try_from(Columns { times, values }: Columns) -> Result<Self, TableError> {
        Self::new(times, values)
    }
}

impl From<Table> for Columns {
    fn from(Table { times, values, .. }: Table) -> Self {
        Self { times, values }
    }
}
