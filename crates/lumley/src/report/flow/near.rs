//! The part of a grid in which modes differ from nothing.

use crate::report::pod::DrawnField;
use std::ops::Range;

/// Part of its peak below which a mode is taken for nothing.
const NOTHING: f64 = 0.05;

/// Share of the grid up to which what is near a body is worth a picture of its own.
const SHARE: f64 = 0.5;

/// Columns and rows of a part of a grid.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Part {
    columns: Range<usize>,
    rows: Range<usize>,
}

impl Part {
    /// The part that holds all `fields`, which have the same nodes, but those that fill the grid, as the mean
    /// stream does; `None` where that is most of the grid.
    pub(super) fn with_all_local<'a>(fields: impl Iterator<Item = &'a DrawnField>) -> Option<Self> {
        let mut nodes = [0; 2];
        let parts = fields.filter_map(|field| {
            nodes = [field.x.len(), field.y.len()];
            Self::of(field).filter(|part| part.share(nodes) <= SHARE)
        });
        let all = parts.reduce(Self::union)?.wider(nodes);
        (all.share(nodes) <= SHARE).then_some(all)
    }

    /// Where a field is something.
    fn of(field: &DrawnField) -> Option<Self> {
        let peak = field.values.iter().fold(0.0_f64, |peak, v| peak.max(v.abs()));
        let least = NOTHING * peak;
        let some = |k: &usize| field.values[*k].abs() > least;
        let nx = field.x.len();
        let single = |k: usize| Self { columns: k % nx..k % nx + 1, rows: k / nx..k / nx + 1 };
        (0..field.values.len()).filter(some).map(single).reduce(Self::union)
    }

    fn union(self, other: Self) -> Self {
        let both = |a: Range<usize>, b: Range<usize>| a.start.min(b.start)..a.end.max(b.end);
        Self { columns: both(self.columns, other.columns), rows: both(self.rows, other.rows) }
    }

    /// With a twentieth of the grid more on all sides.
    fn wider(self, [nx, ny]: [usize; 2]) -> Self {
        let more = |part: Range<usize>, n: usize| {
            part.start.saturating_sub(n / 20)..(part.end + n / 20).min(n)
        };
        Self { columns: more(self.columns, nx), rows: more(self.rows, ny) }
    }

    /// How much of the grid it is.
    fn share(&self, [nx, ny]: [usize; 2]) -> f64 {
        (self.columns.len() * self.rows.len()) as f64 / (nx * ny) as f64
    }

    /// What a field is there.
    pub(super) fn cut(&self, field: &DrawnField) -> DrawnField {
        let nx = field.x.len();
        let row = |j: usize| &field.values[j * nx..][self.columns.clone()];
        DrawnField {
            x: field.x[self.columns.clone()].to_vec(),
            y: field.y[self.rows.clone()].to_vec(),
            values: self.rows.clone().flat_map(|j| row(j).iter().copied()).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn field(value: impl Fn(usize, usize) -> f64) -> DrawnField {
        let nodes = |n: u8| (1..=n).map(f64::from).collect::<Vec<f64>>();
        let values = (0..40 * 20).map(|k| value(k % 40, k / 40)).collect();
        DrawnField { x: nodes(40), y: nodes(20), values }
    }

    #[test]
    fn a_stream_does_not_count_and_what_is_local_does() {
        let stream = field(|_, _| 1.0);
        let spot =
            field(|i, j| if (10..16).contains(&i) && (5..9).contains(&j) { -2.0 } else { 0.01 });
        let part = Part::with_all_local([&stream, &spot].into_iter()).expect("a spot");
        assert_eq!(part, Part { columns: 8..18, rows: 4..10 });
        let cut = part.cut(&spot);
        assert_eq!((cut.x[0], cut.y[5], cut.values.len()), (9.0, 10.0, 60));
        assert_eq!((cut.values[0], cut.values[12]), (0.01, -2.0));
        let wave = field(|i, _| (i as f64).sin());
        assert_eq!(Part::with_all_local([&stream, &wave].into_iter()), None);
        assert_eq!(Part::with_all_local([&field(|_, _| 0.0)].into_iter()), None);
        assert_eq!(Part::with_all_local(std::iter::empty()), None);
    }
}
