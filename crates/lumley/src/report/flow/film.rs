//! Pictures of a flow at several times, small enough for a page.

use crate::report::html::spread;
use lumley_fem::UniformGrid;
use std::ops::Range;

/// Most pictures of a quantity, and the fewest for which the pictures are made coarser instead.
const FRAMES: usize = 60;
const FEWEST: usize = 24;

/// Most nodes of a picture in one direction: a figure has hardly more pixels.
const NODES: usize = 480;

/// Most pixels of all pictures together; each takes about a fifth of a byte in a page.
const PIXELS: usize = 12_000_000;

/// What the pictures show.
///
/// ```
/// assert_eq!(lumley::report::View::Vorticity.name(), "vorticity");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum View {
    /// |u|, in m/s.
    Speed,
    /// p, in Pa.
    Pressure,
    /// ∂v/∂x − ∂u/∂y, in 1/s.
    Vorticity,
}

impl View {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Speed, Self::Pressure, Self::Vorticity];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Speed => "speed",
            Self::Pressure => "pressure",
            Self::Vorticity => "vorticity",
        }
    }

    /// Its unit, in markup.
    pub(super) fn unit(self) -> &'static str {
        match self {
            Self::Speed => "m/s",
            Self::Pressure => "Pa",
            Self::Vorticity => "s^{−1}",
        }
    }
}

/// Speed, pressure and vorticity on a grid at a number of times: of what a run recorded as many nodes and
/// times as a page can hold.
///
/// ```
/// use lumley::report::{Film, View};
/// use lumley_fem::UniformGrid;
/// use std::ops::Range;
///
/// let grid = UniformGrid::rectangle([0.0, 0.0], [2.0, 1.0], [3, 2]);
/// // u, v, p and vorticity: 3, 4, 5 and 6 at all nodes and both times.
/// let read = |rows: Range<usize>, times: usize| -> std::io::Result<faer::Mat<f64>> {
///     Ok(faer::Mat::from_fn(rows.len(), times, |i, _| 3.0 + ((rows.start + i) / 6) as f64))
/// };
/// let film = Film::sample(&grid, &[0.0, 0.1], read)?;
/// assert_eq!(film.times(), [0.0, 0.1]);
/// assert_eq!(film.picture(View::Speed, 1), vec![5.0; 6]);
/// assert_eq!(film.picture(View::Vorticity, 0), vec![6.0; 6]);
/// # Ok::<(), std::io::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Film {
    x: Vec<f64>,
    y: Vec<f64>,
    times: Vec<f64>,
    /// For each view one picture after the other, rows from below.
    views: [Vec<f32>; 3],
}

/// Which nodes and times are taken.
struct Choice {
    columns: Vec<usize>,
    rows: Vec<usize>,
    times: Vec<usize>,
}

impl Choice {
    /// Few pictures rather than coarse ones, to a point.
    fn new([nx, ny]: [usize; 2], times: usize) -> Self {
        let most = PIXELS / View::ALL.len();
        let mut nodes = [nx.min(NODES), ny.min(NODES)];
        let fewest = times.clamp(1, FEWEST);
        let pixels = nodes[0] * nodes[1] * fewest;
        if pixels > most {
            let scale = (most as f64 / pixels as f64).sqrt();
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "below 480"
            )]
            let scaled = |n: usize| ((n as f64 * scale) as usize).max(2);
            nodes = nodes.map(scaled);
        }
        let times = spread(times, FRAMES.min(most / (nodes[0] * nodes[1])).max(1));
        Self { columns: spread(nx, nodes[0]), rows: spread(ny, nodes[1]), times }
    }
}

impl Film {
    /// Takes what a page can hold of the four components u, v, p and vorticity on `grid` at `times`.
    ///
    /// `read` gives some rows of the frame at the first so many times, a line of the grid at a time.
    ///
    /// # Errors
    /// The failure of `read`.
    ///
    /// # Panics
    /// If `read` gives something else than it was asked for.
    pub fn sample<E>(
        grid: &UniformGrid,
        times: &[f64],
        mut read: impl FnMut(Range<usize>, usize) -> Result<faer::Mat<f64>, E>,
    ) -> Result<Self, E> {
        let [nx, ny] = grid.nodes();
        let choice = Choice::new([nx, ny], times.len());
        let size = choice.columns.len() * choice.rows.len();
        let mut views = [(); 3].map(|()| vec![0.0; size * choice.times.len()]);
        for (j, row) in choice.rows.iter().enumerate() {
            let mut line = |component: usize| {
                let first = (component * ny + row) * nx;
                read(first..first + nx, times.len())
                    .inspect(|x| assert_eq!(x.shape(), (nx, times.len()), "a line of the grid"))
            };
            let [u, v, p, vorticity] = [line(0)?, line(1)?, line(2)?, line(3)?];
            for (k, &time) in choice.times.iter().enumerate() {
                let first = k * size + j * choice.columns.len();
                for (place, &i) in (first..).zip(&choice.columns) {
                    let values =
                        [u[(i, time)].hypot(v[(i, time)]), p[(i, time)], vorticity[(i, time)]];
                    for (view, value) in views.iter_mut().zip(values) {
                        #[expect(clippy::cast_possible_truncation, reason = "colours need no more")]
                        let value = value as f32;
                        view[place] = value;
                    }
                }
            }
        }
        Ok(Self {
            x: choice.columns.iter().map(|&i| grid.point(i)[0]).collect(),
            y: choice.rows.iter().map(|&j| grid.point(j * nx)[1]).collect(),
            times: choice.times.iter().map(|&k| times[k]).collect(),
            views,
        })
    }

    /// Times of the pictures, in s.
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// x of the columns and y of the rows, in m.
    pub fn nodes(&self) -> (&[f64], &[f64]) {
        (&self.x, &self.y)
    }

    /// The values of picture `k`, row by row from below.
    ///
    /// # Panics
    /// If there is no such picture.
    pub fn picture(&self, view: View, k: usize) -> Vec<f64> {
        let size = self.x.len() * self.y.len();
        self.views[view as usize][k * size..][..size].iter().map(|&v| f64::from(v)).collect()
    }

    /// The values that the colours of a view stand for, the same in all pictures.
    ///
    /// Extremes that few places have would leave no colours for the rest: vorticity at a wall, pressure at
    /// an impulsive start. So the ends are quantiles over a picture, and of the pictures' the middle one.
    pub(super) fn range(&self, view: View) -> (f64, f64) {
        let pictures = 0..self.times.len();
        let ends: Vec<(f64, f64)> = pictures.map(|k| ends(view, self.picture(view, k))).collect();
        // The fastest picture counts for the speed: it has no such extremes.
        let share = if view == View::Speed { 1.0 } else { 0.5 };
        let (low, high): (Vec<f64>, Vec<f64>) = ends.into_iter().unzip();
        (quantile(low, 1.0 - share), quantile(high, share))
    }
}

/// The range of one picture.
fn ends(view: View, values: Vec<f64>) -> (f64, f64) {
    match view {
        View::Speed => (0.0, quantile(values, 0.999)),
        View::Pressure => (quantile(values.clone(), 0.005), quantile(values, 0.995)),
        View::Vorticity => {
            let sizes: Vec<f64> =
                values.iter().map(|v| v.abs()).filter(|v| v.is_finite()).collect();
            // Of what is above the mean, which does not depend on how much of the picture is at rest.
            let mean = sizes.iter().sum::<f64>() / sizes.len().max(1) as f64;
            let limit = quantile(sizes.into_iter().filter(|v| *v >= mean).collect(), 0.93);
            (-limit, limit)
        }
    }
}

/// The value below which the share `s` of the finite values lies; 0 without values.
pub(super) fn quantile(values: Vec<f64>, s: f64) -> f64 {
    let mut values: Vec<f64> = values.into_iter().filter(|v| v.is_finite()).collect();
    if values.is_empty() {
        return 0.0;
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "below the length")]
    let place = (s * (values.len() - 1) as f64).round() as usize;
    *values.select_nth_unstable_by(place, f64::total_cmp).1
}

#[cfg(test)]
mod tests {
    use super::*;
    use faer::Mat;
    use std::convert::Infallible;

    /// Value of a component at a node and a time, by which they can be told apart.
    fn value(row: usize, time: usize) -> f64 {
        row as f64 + 0.5 * time as f64
    }

    fn film(nodes: [usize; 2], times: usize) -> Film {
        let grid = UniformGrid::rectangle([0.0, 0.0], [2.0, 1.0], nodes);
        let times: Vec<f64> = (0..times).map(|k| k as f64).collect();
        let read = |rows: Range<usize>, times: usize| {
            Ok::<_, Infallible>(Mat::from_fn(rows.len(), times, |i, k| value(rows.start + i, k)))
        };
        let Ok(film) = Film::sample(&grid, &times, read);
        film
    }

    #[test]
    fn small_films_are_taken_whole() {
        let film = film([3, 2], 4);
        let expected = |component: usize, k| -> Vec<f64> {
            (0..6).map(|node| value(component * 6 + node, k)).collect()
        };
        assert_eq!(film.picture(View::Pressure, 3), expected(2, 3));
        assert_eq!(film.picture(View::Vorticity, 1), expected(3, 1));
        let (u, v) = (expected(0, 2), expected(1, 2));
        for (speed, (u, v)) in film.picture(View::Speed, 2).iter().zip(u.iter().zip(v)) {
            assert!((speed / u.hypot(v) - 1.0).abs() < 1e-6, "{speed}");
        }
        assert_eq!(film.nodes(), (&[0.0, 1.0, 2.0][..], &[0.0, 1.0][..]));
    }

    #[test]
    fn large_films_become_small_ones_with_the_same_ends() {
        for (nodes, times) in [([480, 480], 100), ([2000, 3], 1000), ([900, 600], 1), ([60, 40], 7)]
        {
            let choice = Choice::new(nodes, times);
            let size = choice.columns.len() * choice.rows.len();
            assert!(3 * size * choice.times.len() <= PIXELS, "{nodes:?} {times}");
            assert!(choice.times.len() >= times.min(FEWEST), "{}", choice.times.len());
            assert_eq!(choice.columns.last(), Some(&(nodes[0] - 1)));
            assert_eq!(choice.times.last(), Some(&(times - 1)));
        }
    }

    #[test]
    fn nothing_recorded_is_no_film() {
        assert!(film([3, 2], 0).times().is_empty());
        assert_eq!(film([3, 2], 0).range(View::Vorticity), (0.0, 0.0));
    }

    /// A wake of size 2 in a tenth of the picture, a layer of size 100 in half a percent.
    #[test]
    fn the_wall_layer_does_not_wash_out_the_wake() {
        let picture = |free: usize| -> Vec<f64> {
            let wake = (0..1000).map(|k| if k % 2 == 0 { 2.0 } else { -1.0 });
            vec![0.0; free].into_iter().chain(wake).chain(vec![100.0; 30]).collect()
        };
        for free in [9_000, 90_000] {
            assert_eq!(ends(View::Vorticity, picture(free)), (-2.0, 2.0));
        }
    }

    #[test]
    fn quantiles() {
        let values = vec![3.0, 1.0, f64::NAN, 2.0];
        assert_eq!([0.0, 0.5, 1.0].map(|s| quantile(values.clone(), s)), [1.0, 2.0, 3.0]);
        assert_eq!(quantile(vec![], 0.5), 0.0);
    }
}
