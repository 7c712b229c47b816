use super::GenerateError;
use super::divide::divide;
use super::placed::Placed;
use super::size::SizeField;
use crate::Point;

/// The rows of quadrilaterals along a body.
pub(super) struct Rows {
    /// Edges on the body, counterclockwise round it: end, end, middle.
    pub body: Vec<[usize; 3]>,
    /// Edges on the outer side of the last row, likewise; those on the body where there is no row.
    pub rim: Vec<[usize; 3]>,
    pub quadrilaterals: Vec<[usize; 9]>,
}

impl Rows {
    /// Appends the nodes of the rows along a body.
    pub fn new(
        placed: &Placed<'_>,
        field: &SizeField,
        points: &mut Vec<Point>,
        limit: usize,
    ) -> Result<Self, GenerateError> {
        let round = divide_round(placed, field, limit)?;
        let (count, rows) = (round.len(), placed.levels.len() - 1);
        if (count / 2).saturating_mul(rows) > limit {
            return Err(GenerateError::TooManyCells { limit });
        }
        let first = points.len();
        for height in with_middles(&placed.levels) {
            points.extend(round.iter().map(|&(piece, t)| placed.curves[piece].at(t, height)));
        }
        let node = |level: usize, k: usize| first + level * count + k % count;
        let edges = |level: usize| {
            let edge = |k: usize| [node(level, k), node(level, k + 2), node(level, k + 1)];
            (0..count).step_by(2).map(edge).collect()
        };
        let cell = |row: usize, k: usize| {
            let places = [(0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1), (1, 1)];
            places.map(|(up, along)| node(2 * row + up, k + along))
        };
        let cells = (0..rows).flat_map(|row| (0..count).step_by(2).map(move |k| cell(row, k)));
        Ok(Self { body: edges(0), rim: edges(2 * rows), quadrilaterals: cells.collect() })
    }
}

/// Ends and middles, one after the other, of edges round the body: the piece and where on it.
fn divide_round(
    placed: &Placed<'_>,
    field: &SizeField,
    limit: usize,
) -> Result<Vec<(usize, f64)>, GenerateError> {
    let height = placed.thickness();
    let mut round = Vec::new();
    for (piece, curve) in placed.curves.iter().enumerate() {
        let size = |t: f64| {
            let outside = field.at(curve.at(t, height)) / curve.speed(t, height);
            outside.min(placed.size_on_body(curve, t) / curve.speed(t, 0.0))
        };
        let ends = divide(size, limit)?;
        let all = with_middles(&ends);
        round.extend(all[..all.len() - 1].iter().map(|&t| (piece, t)));
    }
    Ok(round)
}

fn with_middles(ends: &[f64]) -> Vec<f64> {
    let pairs = ends.windows(2).flat_map(|w| [0.5 * (w[0] + w[1]), w[1]]);
    ends.first().copied().into_iter().chain(pairs).collect()
}
