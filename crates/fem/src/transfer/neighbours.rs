use super::closest::Closest;
use crate::Point;

/// Finds the k points of a set that are nearest to a given one.
///
/// The points are sorted along the first axis and visited outwards from the given one, until the
/// distance along that axis alone is too large. This is exact in any dimension; on a line it
/// visits k + 1 points, in the plane a strip.
pub(super) struct Neighbours {
    sorted: Vec<(Point, usize)>,
    closest: Closest,
}

impl Neighbours {
    /// Over `points`, of which there are at least `wanted`.
    pub(super) fn new(points: impl Iterator<Item = Point>, wanted: usize) -> Self {
        let mut sorted: Vec<_> = points.enumerate().map(|(index, p)| (p, index)).collect();
        sorted.sort_by(|a, b| a.0[0].total_cmp(&b.0[0]));
        assert!((1..=sorted.len()).contains(&wanted), "{wanted} of {} points", sorted.len());
        Self { sorted, closest: Closest::new(wanted) }
    }

    /// Squared distances in m² and indices of the nearest points, the nearest first; equal
    /// distances in the order of the points.
    pub(super) fn nearest(&mut self, p: Point) -> &[(f64, usize)] {
        self.closest.clear();
        let mut right = self.sorted.partition_point(|(q, _)| q[0] < p[0]);
        let mut left = right;
        let gap = |entry: Option<&(Point, usize)>| {
            entry.map_or(f64::INFINITY, |(q, _)| (q[0] - p[0]).abs())
        };
        while left > 0 || right < self.sorted.len() {
            let behind = gap(left.checked_sub(1).and_then(|k| self.sorted.get(k)));
            let ahead = gap(self.sorted.get(right));
            if behind.min(ahead).powi(2) > self.closest.limit() {
                break;
            }
            let visited = if behind < ahead {
                left -= 1;
                left
            } else {
                right += 1;
                right - 1
            };
            let (q, index) = self.sorted[visited];
            self.closest.insert((q[0] - p[0]).powi(2) + (q[1] - p[1]).powi(2), index);
        }
        self.closest.found()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Low-discrepancy points: spread, without pattern, and the same each time.
    fn points(n: usize, dimension: usize) -> Vec<Point> {
        let fraction = |k: usize, step: f64| (k as f64 * step).fract();
        (1..=n)
            .map(|k| {
                [
                    fraction(k, 0.754_877_666),
                    if dimension == 1 { 0.0 } else { fraction(k, 0.569_840_291) },
                ]
            })
            .collect()
    }

    fn by_force(points: &[Point], p: Point, wanted: usize) -> Vec<(f64, usize)> {
        let square = |q: &Point| (q[0] - p[0]).powi(2) + (q[1] - p[1]).powi(2);
        let mut all: Vec<_> = points.iter().enumerate().map(|(k, q)| (square(q), k)).collect();
        all.sort_by(|a, b| a.partial_cmp(b).expect("finite"));
        all.truncate(wanted);
        all
    }

    #[test]
    fn same_as_brute_force_in_each_dimension() {
        for dimension in [1, 2] {
            let mut set = points(120, dimension);
            set.push(set[7]); // a node twice
            for wanted in [1, 2, 5, 121] {
                let mut search = Neighbours::new(set.iter().copied(), wanted);
                for p in [[0.5, 0.5], [0.0, 0.0], [2.0, -1.0], set[7], set[30]] {
                    assert_eq!(
                        search.nearest(p),
                        by_force(&set, p, wanted),
                        "{dimension}-D, {p:?}"
                    );
                }
            }
        }
    }
}
