//! The part of the modes that a report draws, small whatever the size of the grid.

use crate::report::html::spread;
use faer::Mat;
use std::ops::Range;

/// The uniform grid that the rows of modes stand for.
///
/// A mode lists its first component at all nodes, then the second, and so on; within a component
/// the first direction runs fastest.
///
/// ```
/// use lumley::report::FieldGrid;
///
/// let plane = FieldGrid { nodes: [211, 121, 1], components: 2 };
/// assert_eq!(plane.len(), 2 * 211 * 121);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FieldGrid {
    /// Nodes in each direction, 1 where there is none.
    pub nodes: [usize; 3],
    /// Components of the field at a node.
    pub components: usize,
}

impl FieldGrid {
    /// Numbers in a mode.
    pub fn len(&self) -> usize {
        self.nodes.iter().fold(self.components, |n, &k| n.saturating_mul(k))
    }

    /// Whether it has one direction.
    pub fn is_line(&self) -> bool {
        self.nodes[1] == 1 && self.nodes[2] == 1
    }

    /// Whether there is no node.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// Most nodes of a picture in a direction: a figure has no more pixels.
const PICTURE: usize = 400;

/// Intervals of a curve, of which each shows at most four nodes.
const INTERVALS: usize = 1000;

/// Most rows that are read at a time.
const ROWS: usize = 1 << 14;

/// As much of the modes as a report can show: of a picture at most 400 nodes in each direction,
/// evenly spread, of a curve about four thousand, and among them all peaks.
///
/// ```
/// use faer::Mat;
/// use lumley::report::{DrawnModes, FieldGrid};
/// use std::{io, ops::Range};
///
/// let grid = FieldGrid { nodes: [5, 1, 1], components: 2 };
/// let mode = Mat::from_fn(10, 1, |i, _| i as f64);
/// let read = |rows: Range<usize>| -> io::Result<Mat<f64>> {
///     Ok(mode.subrows(rows.start, rows.len()).to_owned())
/// };
/// let drawn = DrawnModes::sample(grid, 1, read)?;
/// assert_eq!(drawn.grid(), grid);
/// # Ok::<(), std::io::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnModes {
    grid: FieldGrid,
    /// For each component the modes.
    pub(in crate::report) fields: Vec<Vec<DrawnField>>,
}

/// One component of a mode: `values[j * x.len() + i]` at the nodes `x[i]` and `y[j]`, counted from 1.
#[derive(Debug, Clone, Default, PartialEq)]
pub(in crate::report) struct DrawnField {
    pub x: Vec<f64>,
    pub y: Vec<f64>,
    pub values: Vec<f64>,
}

impl DrawnModes {
    /// Modes that a report draws, the first ones.
    pub const COUNT: usize = 6;

    /// Takes what is drawn of `modes` modes on `grid`; in three directions the middle slice.
    ///
    /// `read` gives some rows of the modes, a few thousand at a time: those of a field of one direction all,
    /// those of others in the lines that are drawn.
    ///
    /// # Errors
    /// The failure of `read`.
    ///
    /// # Panics
    /// If there is no node, or `read` gives something else than it was asked for.
    pub fn sample<E>(
        grid: FieldGrid,
        modes: usize,
        mut read: impl FnMut(Range<usize>) -> Result<Mat<f64>, E>,
    ) -> Result<Self, E> {
        assert!(!grid.is_empty(), "a grid has nodes");
        let mut read = |rows: Range<usize>| {
            let shape = (rows.len(), modes);
            read(rows).inspect(|x| assert_eq!(x.shape(), shape, "the rows of the modes"))
        };
        let [nx, ny, nz] = grid.nodes;
        let mut fields = vec![vec![DrawnField::default(); modes]; grid.components];
        for (component, fields) in fields.iter_mut().enumerate() {
            let start = (component * nz + nz / 2) * nx * ny;
            if grid.is_line() {
                curves(fields, start..start + nx, &mut read)?;
            } else {
                pictures(fields, start, [nx, ny], &mut read)?;
            }
        }
        Ok(Self { grid, fields })
    }

    /// The whole grid.
    pub fn grid(&self) -> FieldGrid {
        self.grid
    }
}

/// Of each interval the first, lowest, highest and last node.
fn curves<E>(
    fields: &mut [DrawnField],
    rows: Range<usize>,
    read: &mut impl FnMut(Range<usize>) -> Result<Mat<f64>, E>,
) -> Result<(), E> {
    let interval = rows.len().div_ceil(INTERVALS).min(ROWS);
    for first in rows.clone().step_by(ROWS / interval * interval) {
        let last = rows.end.min(first + ROWS / interval * interval);
        let x = read(first..last)?;
        for (k, field) in fields.iter_mut().enumerate() {
            for (part, values) in x.col_as_slice(k).chunks(interval).enumerate() {
                let before = first - rows.start + part * interval;
                for at in extremes(values) {
                    field.x.push((before + at + 1) as f64);
                    field.values.push(values[at]);
                }
            }
        }
    }
    for field in fields {
        field.y.push(1.0);
    }
    Ok(())
}

/// Places of the first, lowest, highest and last value, in their order.
fn extremes(values: &[f64]) -> Vec<usize> {
    let by_value = |a: &usize, b: &usize| values[*a].total_cmp(&values[*b]);
    let all = 0..values.len();
    let (low, high) = (all.clone().min_by(by_value), all.clone().max_by(by_value));
    let mut places: Vec<usize> = [low, high, Some(0), all.last()].into_iter().flatten().collect();
    places.sort_unstable();
    places.dedup();
    places
}

/// Nodes that are evenly spread over the plane of `nodes` nodes, whose rows begin at `start`.
fn pictures<E>(
    fields: &mut [DrawnField],
    start: usize,
    nodes: [usize; 2],
    read: &mut impl FnMut(Range<usize>) -> Result<Mat<f64>, E>,
) -> Result<(), E> {
    let [columns, lines] = nodes.map(|count| spread(count, PICTURE));
    for line in lines.iter().map(|j| start + j * nodes[0]) {
        for part in columns.chunk_by(|a, b| a / ROWS == b / ROWS) {
            let x = read(line + part[0]..line + part[part.len() - 1] + 1)?;
            for (field, column) in fields.iter_mut().zip(x.col_iter()) {
                field.values.extend(part.iter().map(|i| column[i - part[0]]));
            }
        }
    }
    let numbers = |places: &[usize]| places.iter().map(|k| (k + 1) as f64).collect();
    for field in fields {
        (field.x, field.y) = (numbers(&columns), numbers(&lines));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Value of a mode in a row, by which nodes can be told apart.
    fn value(row: usize, mode: usize) -> f64 {
        row as f64 + 0.25 * mode as f64
    }

    /// The sample, and the rows that it took to read.
    fn sample(
        nodes: [usize; 3],
        components: usize,
        f: fn(usize, usize) -> f64,
    ) -> (DrawnModes, usize) {
        let grid = FieldGrid { nodes, components };
        let mut rows_read = 0;
        let read = |rows: Range<usize>| {
            assert!(rows.end <= grid.len() && rows.len() <= ROWS, "{rows:?}");
            rows_read += rows.len();
            Ok::<_, std::convert::Infallible>(Mat::from_fn(rows.len(), 2, |i, k| {
                f(rows.start + i, k)
            }))
        };
        let Ok(drawn) = DrawnModes::sample(grid, 2, read);
        (drawn, rows_read)
    }

    #[test]
    fn small_fields_are_drawn_whole() {
        let (drawn, _) = sample([3, 2, 5], 2, value);
        let middle = |component: usize, mode: usize| -> Vec<f64> {
            (0..6).map(|i| value((component * 5 + 2) * 6 + i, mode)).collect()
        };
        for (component, fields) in drawn.fields.iter().enumerate() {
            for (mode, DrawnField { x, y, values }) in fields.iter().enumerate() {
                assert_eq!(*values, middle(component, mode));
                assert_eq!((&x[..], &y[..]), (&[1.0, 2.0, 3.0][..], &[1.0, 2.0][..]));
            }
        }
        let (drawn, _) = sample([900, 1, 1], 1, value);
        assert_eq!(drawn.fields[0][1].values, (0..900).map(|i| value(i, 1)).collect::<Vec<_>>());
    }

    /// Lines longer than what is read at a time; the nodes are the true ones, both ends among them.
    #[test]
    fn large_pictures_are_spread() {
        let [nx, ny] = [20_000, 1500];
        let (drawn, rows_read) = sample([nx, ny, 1], 1, value);
        let DrawnField { x, y, values } = &drawn.fields[0][1];
        assert_eq!((x.len(), y.len(), values.len()), (PICTURE, PICTURE, PICTURE * PICTURE));
        assert_eq!((x[0], y[0], x[PICTURE - 1], y[PICTURE - 1]), (1.0, 1.0, 20_000.0, 1500.0));
        assert!(x.windows(2).all(|pair| (50.0..=51.0).contains(&(pair[1] - pair[0]))));
        for (k, found) in values.iter().enumerate() {
            let (i, j) = (x[k % PICTURE] - 1.0, y[k / PICTURE] - 1.0);
            assert_eq!(*found, j * nx as f64 + i + 0.25);
        }
        assert!(rows_read <= PICTURE * nx, "{rows_read}");
    }

    #[test]
    fn a_long_curve_keeps_its_peaks() {
        fn spiky(row: usize, mode: usize) -> f64 {
            match (row % 1_000_003, mode) {
                (123_457, 0) => 9.0,
                (765_432, 1) => -7.0,
                _ => (row as f64 * 1e-5).sin(),
            }
        }
        let (drawn, rows_read) = sample([1_000_003, 1, 1], 2, spiky);
        assert_eq!(rows_read, 2 * 1_000_003);
        for fields in &drawn.fields {
            for (field, (place, peak)) in fields.iter().zip([(123_457, 9.0), (765_432, -7.0)]) {
                let DrawnField { x, values, .. } = field;
                assert!(x.len() == values.len() && x.len() <= 4 * INTERVALS, "{}", x.len());
                let at = x.iter().position(|node| *node == f64::from(place + 1));
                assert_eq!(values[at.expect("the peak")], peak);
                assert!(x.is_sorted() && (x[0], x[x.len() - 1]) == (1.0, 1_000_003.0));
            }
        }
    }
}
