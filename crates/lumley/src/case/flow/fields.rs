//! Velocities and forces that a case gives.

use super::raw::RampShape;
use crate::case::CaseError;
use crate::case::ask::Ask;
use crate::case::formula::Variables;
use crate::case::term::{Scalar, Term};
use lumley_fem::Point;
use lumley_fom::flow::VectorField;
use std::f64::consts::PI;
use std::sync::Arc;

/// Two terms: numbers or formulas.
pub(super) struct Given(pub [Scalar; 2]);

impl Given {
    pub fn read(
        ask: &Ask,
        key: &str,
        terms: &[Term; 2],
        variables: Variables,
        unit: &str,
    ) -> Result<Self, CaseError> {
        let read = |term| Scalar::read(ask, key, term, variables, unit);
        Ok(Self([read(&terms[0])?, read(&terms[1])?]))
    }

    pub fn uses_time(&self) -> bool {
        self.0.iter().any(Scalar::uses_time)
    }
}

impl VectorField for Given {
    fn value(&self, at: Point, time: f64) -> Point {
        [self.0[0].value(at, time), self.0[1].value(at, time)]
    }
}

/// `4 s (1 − s)` times the peak along the inward normal of a straight boundary.
pub(super) struct Parabola {
    /// An end of the boundary, in m.
    pub start: Point,
    /// From that end to the other, in m.
    pub span: Point,
    /// Largest velocity, in m/s, into the domain.
    pub peak: Point,
}

impl VectorField for Parabola {
    fn value(&self, at: Point, _: f64) -> Point {
        let dot = |a: Point, b: Point| a[0] * b[0] + a[1] * b[1];
        let along = [0, 1].map(|d| at[d] - self.start[d]);
        let s = (dot(along, self.span) / dot(self.span, self.span)).clamp(0.0, 1.0);
        self.peak.map(|peak| 4.0 * s * (1.0 - s) * peak)
    }
}

/// Values at increasing times: linear between them, constant before the first and after the last.
pub(super) struct TimeTable {
    times: Vec<f64>,
    values: Vec<Point>,
}

impl TimeTable {
    pub fn new(rows: &[(f64, Point)]) -> Self {
        let (times, values) = rows.iter().copied().unzip();
        Self { times, values }
    }

    fn at(&self, time: f64) -> Point {
        let next = self.times.partition_point(|&t| t <= time);
        if next == 0 || next == self.times.len() {
            return self.values[next.saturating_sub(1)];
        }
        let (before, after) = (&self.values[next - 1], &self.values[next]);
        let (start, end) = (self.times[next - 1], self.times[next]);
        let share = (time - start) / (end - start);
        [0, 1].map(|d| before[d] * (1.0 - share) + after[d] * share)
    }
}

impl VectorField for TimeTable {
    fn value(&self, _: Point, time: f64) -> Point {
        self.at(time)
    }
}

/// A velocity that grows from zero at t = 0 to the whole.
pub(super) struct Ramped {
    pub whole: Arc<dyn VectorField>,
    /// How long it grows, in s.
    pub time: f64,
    pub shape: RampShape,
}

impl VectorField for Ramped {
    fn value(&self, at: Point, time: f64) -> Point {
        let passed = (time / self.time).clamp(0.0, 1.0);
        let share = match self.shape {
            RampShape::Smooth => 0.5 * (1.0 - (PI * passed).cos()),
            RampShape::Linear => passed,
        };
        self.whole.value(at, time).map(|value| share * value)
    }
}

/// Refuses a field, written as `written` under `key`, that is not finite at these points and times.
pub(super) fn check_finite(
    ask: &Ask,
    (key, written): (&str, &str),
    field: &dyn VectorField,
    points: &[Point],
    times: &[f64],
) -> Result<(), CaseError> {
    for &time in times {
        for &at in points {
            let [u, v] = field.value(at, time);
            let expected = format!(
                "finite values; at ({:?}, {:?}) m and t = {time:?} s it gives ({u}, {v})",
                at[0], at[1]
            );
            ask.that(u.is_finite() && v.is_finite(), key, written, &expected)?;
        }
    }
    Ok(())
}

/// Two terms as the case file has them.
pub(super) fn written(terms: &[Term; 2]) -> String {
    format!("[{}, {}]", terms[0], terms[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_is_linear_and_constant_beyond_its_ends() {
        let table = TimeTable::new(&[(1.0, [0.0, 2.0]), (3.0, [4.0, 0.0])]);
        assert_eq!(table.at(-5.0), [0.0, 2.0]);
        assert_eq!(table.at(2.0), [2.0, 1.0]);
        assert_eq!(table.at(3.0), [4.0, 0.0]);
        assert_eq!(table.at(9.0), [4.0, 0.0]);
    }

    #[test]
    fn a_parabola_is_zero_at_its_ends_and_points_inwards() {
        let slanted = Parabola { start: [1.0, 1.0], span: [2.0, 2.0], peak: [-0.3, 0.3] };
        assert_eq!(slanted.value([1.0, 1.0], 0.0), [0.0, 0.0]);
        assert_eq!(slanted.value([3.0, 3.0], 0.0), [0.0, 0.0]);
        assert_eq!(slanted.value([2.0, 2.0], 0.0), [-0.3, 0.3]);
        let [u, v] = slanted.value([1.5, 1.5], 0.0);
        assert!((u + 0.225).abs() < 1e-15 && (v - 0.225).abs() < 1e-15);
    }

    #[test]
    fn ramps_start_from_rest_and_end_with_the_whole() {
        for shape in [RampShape::Smooth, RampShape::Linear] {
            let whole: Arc<dyn VectorField> = Arc::new(|_: Point, t: f64| [2.0, t]);
            let ramped = Ramped { whole, time: 0.5, shape };
            assert_eq!(ramped.value([0.0; 2], 0.0), [0.0, 0.0]);
            assert!((ramped.value([0.0; 2], 0.25)[0] - 1.0).abs() < 1e-15);
            assert_eq!(ramped.value([0.0; 2], 0.7), [2.0, 0.7]);
        }
    }
}
