use super::channel::{Channel, Rectangle};
use super::divide::divide;
use super::size::SizeField;
use super::{GenerateError, channel};
use crate::{NamedBoundary, Point};

/// Rectangles of a channel between lines of x and of y, but for those where triangles are.
pub(super) struct Lattice {
    lines: [Vec<f64>; 2],
    /// First and last line of the hole for triangles.
    hole: Option<[[usize; 2]; 2]>,
    /// Numbers of the nodes, corners and middles of cells; row by row.
    numbers: Vec<usize>,
}

/// No node: it lies within the hole.
const NONE: usize = usize::MAX;

impl Lattice {
    /// Lines as far apart as `field` says, some of them along the sides of `hole`.
    pub fn new(
        channel: &Channel,
        hole: Option<Rectangle>,
        field: &SizeField,
    ) -> Result<Self, GenerateError> {
        let sides = [channel.x, channel.y];
        let hole = hole.map(|hole| [hole.x, hole.y]);
        let along = |axis: usize| {
            let mut ends = sides[axis].to_vec();
            ends.extend(hole.into_iter().flat_map(|hole| hole[axis]));
            ends.sort_by(f64::total_cmp);
            ends.dedup();
            divide_sections(&ends, |value| spacing(field, hole, axis, value), channel.limit)
        };
        let lines = [along(0)?, along(1)?];
        let mark = |axis: usize, value: f64| lines[axis].partition_point(|&line| line < value);
        let marks = hole.map(|hole| [0, 1].map(|axis| hole[axis].map(|value| mark(axis, value))));
        let lattice = Self { lines, hole: marks, numbers: vec![] };
        lattice.check_size(channel.limit)?;
        Ok(lattice)
    }

    fn check_size(&self, limit: usize) -> Result<(), GenerateError> {
        let [nx, ny] = self.cells();
        let all = nx.saturating_mul(ny);
        let in_hole = self.hole.map_or(0, |[[a, b], [c, d]]| (b - a) * (d - c));
        if all - in_hole > limit || all > limit.saturating_mul(4) {
            return Err(GenerateError::TooManyCells { limit });
        }
        Ok(())
    }

    /// Cells in each direction, those of the hole counted.
    fn cells(&self) -> [usize; 2] {
        [0, 1].map(|d| self.lines[d].len() - 1)
    }

    /// Appends the nodes.
    pub fn number(&mut self, points: &mut Vec<Point>) {
        let [nx, ny] = self.cells();
        let at = |d: usize, k: usize| match k % 2 {
            0 => self.lines[d][k / 2],
            _ => 0.5 * (self.lines[d][k / 2] + self.lines[d][k / 2 + 1]),
        };
        let within = |[[a, b], [c, d]]: [[usize; 2]; 2], i: usize, j: usize| {
            2 * a < i && i < 2 * b && 2 * c < j && j < 2 * d
        };
        for (j, i) in (0..=2 * ny).flat_map(|j| (0..=2 * nx).map(move |i| (j, i))) {
            if self.hole.is_some_and(|hole| within(hole, i, j)) {
                self.numbers.push(NONE);
            } else {
                self.numbers.push(points.len());
                points.push([at(0, i), at(1, j)]);
            }
        }
    }

    /// The node at position (i, j), two for each cell.
    fn node(&self, i: usize, j: usize) -> usize {
        let number = self.numbers[j * (2 * self.cells()[0] + 1) + i];
        debug_assert!(number != NONE, "a node outside of the hole");
        number
    }

    /// The rectangles.
    pub fn quadrilaterals(&self) -> Vec<[usize; 9]> {
        const PLACES: [[usize; 2]; 9] =
            [[0, 0], [2, 0], [2, 2], [0, 2], [1, 0], [2, 1], [1, 2], [0, 1], [1, 1]];
        let [nx, ny] = self.cells();
        let all = (0..ny).flat_map(|j| (0..nx).map(move |i| [i, j]));
        let outside = all.filter(|&[i, j]| {
            !self.hole.is_some_and(|[[a, b], [c, d]]| (a..b).contains(&i) && (c..d).contains(&j))
        });
        outside.map(|[i, j]| PLACES.map(|[p, q]| self.node(2 * i + p, 2 * j + q))).collect()
    }

    /// The sides of the channel.
    pub fn sides(&self) -> Vec<NamedBoundary> {
        let [nx, ny] = self.cells();
        let column = |i: usize| (0..ny).map(move |j| [[i, 2 * j], [i, 2 * j + 2], [i, 2 * j + 1]]);
        let row = |j: usize| (0..nx).map(move |i| [[2 * i, j], [2 * i + 2, j], [2 * i + 1, j]]);
        let edges: [Vec<_>; 4] = [
            column(0).collect(),
            column(2 * nx).collect(),
            row(0).collect(),
            row(2 * ny).collect(),
        ];
        let number = |places: &[[usize; 2]; 3]| places.map(|[i, j]| self.node(i, j));
        let named = channel::SIDES.into_iter().zip(edges);
        named
            .map(|(name, edges)| NamedBoundary {
                name: name.to_owned(),
                edges: edges.iter().map(number).collect(),
            })
            .collect()
    }

    /// The edges round the hole, counterclockwise: end, end, middle.
    pub fn rim_of_hole(&self) -> Vec<[usize; 3]> {
        let Some([[a, b], [c, d]]) = self.hole else { return vec![] };
        let bottom = (2 * a..2 * b).map(|i| [i, 2 * c]);
        let right = (2 * c..2 * d).map(|j| [2 * b, j]);
        let top = (2 * a + 1..=2 * b).rev().map(|i| [i, 2 * d]);
        let left = (2 * c + 1..=2 * d).rev().map(|j| [2 * a, j]);
        let round: Vec<usize> =
            bottom.chain(right).chain(top).chain(left).map(|[i, j]| self.node(i, j)).collect();
        let count = round.len();
        (0..count).step_by(2).map(|k| [round[k], round[(k + 2) % count], round[k + 1]]).collect()
    }
}

/// The distance of lines at this coordinate: on the hole's own rim within its range, else on the whole line.
fn spacing(field: &SizeField, hole: Option<[[f64; 2]; 2]>, axis: usize, value: f64) -> f64 {
    match hole {
        Some(hole) if hole[axis][0] < value && value < hole[axis][1] => {
            let rim = hole[1 - axis].map(|other| match axis {
                0 => field.at([value, other]),
                _ => field.at([other, value]),
            });
            rim[0].min(rim[1])
        }
        _ => field.on_line(axis, value),
    }
}

fn divide_sections(
    ends: &[f64],
    size: impl Fn(f64) -> f64,
    limit: usize,
) -> Result<Vec<f64>, GenerateError> {
    let mut lines = vec![ends[0]];
    for section in ends.windows(2) {
        let [a, b] = [section[0], section[1]];
        let at = |t: f64| a * (1.0 - t) + b * t;
        let parts = divide(|t| size(at(t)) / (b - a), limit)?;
        lines.extend(parts.into_iter().skip(1).map(at));
    }
    Ok(lines)
}
