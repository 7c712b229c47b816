//! Formulas of x, y and t in case files.
//!
//! The usual order of operations: `^` before `*` and `/` before `+` and `-`, the sign after `^`, so that
//! `-x^2` is `-(x^2)`; powers from the right, all else from the left.

mod error;
mod reader;

pub use error::FormulaError;

use lumley_fem::Point;
use reader::Reader;

/// Most values that wait for their operation; deeper formulas are refused.
const DEPTH: usize = 32;

/// What a formula may name.
///
/// ```
/// use lumley::case::formula::{Formula, Variables};
/// assert!(Formula::read("x", Variables::Time).is_err());
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Variables {
    /// The place x, y in m and the time t in s.
    PlaceAndTime,
    /// The place alone.
    Place,
    /// The time alone.
    Time,
}

impl Variables {
    fn names(self) -> &'static [&'static str] {
        match self {
            Self::PlaceAndTime => &["x", "y", "t"],
            Self::Place => &["x", "y"],
            Self::Time => &["t"],
        }
    }
}

/// A formula that has been read, ready to be evaluated without allocation.
///
/// It knows numbers, x, y, t, pi, e, the operations `+ - * / ^`, the comparisons `< <= > >=`, which are 1 or 0,
/// `if(condition, then, otherwise)` and the functions
///
/// ```text
/// abs  acos  asin  atan  atan2(y, x)  cos  cosh  exp  floor  hypot(x, y)  ln  log10
/// max(a, b)  min(a, b)  sign  sin  sinh  sqrt  step (0 below 0, else 1)  tan  tanh
/// ```
///
/// ```
/// use lumley::case::formula::{Formula, Variables};
/// let inflow = Formula::read("6*y*(0.41 - y)/0.41^2", Variables::PlaceAndTime)?;
/// assert!((inflow.value([0.0, 0.205], 0.0) - 1.5).abs() < 1e-15);
/// let error = Formula::read("2 y", Variables::PlaceAndTime).unwrap_err();
/// assert_eq!(error.column, 3);
/// # Ok::<(), lumley::case::formula::FormulaError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Formula {
    steps: Vec<Step>,
}

/// A step of the evaluation on a stack of values.
#[derive(Debug, Clone, Copy)]
enum Step {
    Number(f64),
    X,
    Y,
    Time,
    One(Function<fn(f64) -> f64>),
    Two(Function<fn(f64, f64) -> f64>),
    /// The condition, what holds if it is not zero, what holds otherwise.
    If,
}

/// A function with the name that it has in formulas.
#[derive(Debug, Clone, Copy)]
struct Function<F> {
    name: &'static str,
    call: F,
}

impl PartialEq for Step {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Number(a), Self::Number(b)) => a.to_bits() == b.to_bits(),
            (Self::X, Self::X)
            | (Self::Y, Self::Y)
            | (Self::Time, Self::Time)
            | (Self::If, Self::If) => true,
            (Self::One(a), Self::One(b)) => a.name == b.name,
            (Self::Two(a), Self::Two(b)) => a.name == b.name,
            _ => false,
        }
    }
}

impl Formula {
    /// Reads a formula.
    ///
    /// # Errors
    /// [`FormulaError`], with the place.
    pub fn read(text: &str, variables: Variables) -> Result<Self, FormulaError> {
        Reader::new(text, variables).formula().map(|steps| Self { steps })
    }

    /// Its value at a point in m and a time in s; NaN or infinite where it has none.
    pub fn value(&self, [x, y]: Point, time: f64) -> f64 {
        let mut stack = [0.0; DEPTH];
        let mut top = 0;
        for step in &self.steps {
            let value = match step {
                Step::Number(value) => *value,
                Step::X => x,
                Step::Y => y,
                Step::Time => time,
                Step::One(function) => {
                    top -= 1;
                    (function.call)(stack[top])
                }
                Step::Two(function) => {
                    top -= 2;
                    (function.call)(stack[top], stack[top + 1])
                }
                Step::If => {
                    top -= 3;
                    if stack[top] == 0.0 { stack[top + 2] } else { stack[top + 1] }
                }
            };
            stack[top] = value;
            top += 1;
        }
        stack[0]
    }

    /// Whether it names the time.
    pub fn uses_time(&self) -> bool {
        self.steps.contains(&Step::Time)
    }
}

#[cfg(test)]
mod tests;
