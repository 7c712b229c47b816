//! Paths through many points, as short as the eye allows.

use std::fmt::Write;

use super::svg::Px;

/// A position, or a gap.
pub(super) type Point = Option<(f64, f64)>;

/// How far a path may pass by a point that it leaves out, in user units.
const TOLERANCE: f64 = 0.1;

/// The path through the points, lifted at gaps; a point between two gaps is a dot.
pub(super) fn through(points: &[Point]) -> String {
    let mut d = String::new();
    for run in thin(points).split(Option::is_none) {
        let run: Vec<(f64, f64)> = run.iter().copied().flatten().collect();
        for (k, (x, y)) in straighten(&run).into_iter().enumerate() {
            let (x, y) = (Px((x * 10.0).round() / 10.0), Px((y * 10.0).round() / 10.0));
            let _ = write!(d, "{}{x} {y}", if k == 0 { 'M' } else { 'L' });
        }
        if run.len() == 1 {
            d += "h0";
        }
    }
    d
}

/// Of the points of one unit of width keeps the first, lowest, highest and last.
fn thin(points: &[Point]) -> Vec<Point> {
    let column = |p: &Point| p.map(|(x, _)| x.floor());
    points.chunk_by(|p, q| column(p) == column(q)).flat_map(extremes).collect()
}

/// First, lowest, highest and last of the points of one column, in their order.
fn extremes(column: &[Point]) -> Vec<Point> {
    let height = |k: &usize| column[*k].map_or(0.0, |(_, y)| y);
    let by_height = |a: &usize, b: &usize| height(a).total_cmp(&height(b));
    let last = column.len() - 1;
    let (low, high) = ((0..=last).min_by(by_height), (0..=last).max_by(by_height));
    let mut kept: Vec<usize> = [0, last].into_iter().chain(low).chain(high).collect();
    kept.sort_unstable();
    kept.dedup();
    kept.into_iter().map(|k| column[k]).collect()
}

/// Leaves out points that the path through the others passes within [`TOLERANCE`] (Douglas and
/// Peucker, 1973).
fn straighten(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let [first, .., last] = points else { return points.to_vec() };
    let off = |k: &usize| distance(points[*k], *first, *last);
    let farthest = (1..points.len() - 1).max_by(|a, b| off(a).total_cmp(&off(b)));
    match farthest.filter(|k| off(k) > TOLERANCE) {
        None => vec![*first, *last],
        Some(k) => {
            let mut kept = straighten(&points[..=k]);
            kept.pop();
            kept.extend(straighten(&points[k..]));
            kept
        }
    }
}

/// Distance of `p` from the segment from `a` to `b`.
fn distance(p: (f64, f64), a: (f64, f64), b: (f64, f64)) -> f64 {
    let (dx, dy) = (b.0 - a.0, b.1 - a.1);
    let length2 = dx * dx + dy * dy;
    let along = (p.0 - a.0) * dx + (p.1 - a.1) * dy;
    let s = if length2 > 0.0 { (along / length2).clamp(0.0, 1.0) } else { 0.0 };
    (p.0 - a.0 - s * dx).hypot(p.1 - a.1 - s * dy)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wave(count: u32) -> Vec<(f64, f64)> {
        let at = |k| f64::from(k) * 700.0 / f64::from(count);
        (0..=count).map(|k| (at(k), 100.0 + 80.0 * (at(k) / 40.0).sin())).collect()
    }

    #[test]
    fn gaps_lift_the_pen_and_lone_points_show() {
        let p = |x: f64, y: f64| Some((x, y));
        let points =
            [p(0.0, 1.0), p(1.0, 1.5), None, p(3.0, 1.0), None, None, p(5.0, 1.0), p(6.0, 0.0)];
        assert_eq!(through(&points), "M0 1L1 1.5M3 1h0M5 1L6 0");
        assert_eq!(through(&[None, None]), "");
        assert_eq!(through(&[]), "");
    }

    #[test]
    fn a_straight_line_needs_two_points_and_a_curve_stays_within_the_tolerance() {
        let line: Vec<(f64, f64)> = (0..500).map(|k| (f64::from(k), 0.3 * f64::from(k))).collect();
        assert_eq!(straighten(&line), [line[0], line[499]]);

        let wave = wave(1400);
        let short = straighten(&wave);
        assert!(short.len() < wave.len() / 4, "{}", short.len());
        for &p in &wave {
            let off = short.windows(2).map(|s| distance(p, s[0], s[1])).fold(f64::MAX, f64::min);
            assert!(off <= TOLERANCE, "{p:?} is {off} off");
        }
    }

    #[test]
    fn thinning_keeps_peaks_and_gaps() {
        let mut points: Vec<Point> =
            (0..100_000).map(|k| Some((f64::from(k) / 1000.0, 50.0))).collect();
        points[54_321] = Some((54.321, 0.0));
        points[77_777] = None;
        let thinned = thin(&points);
        assert!(thinned.len() < 450, "{}", thinned.len());
        assert!(thinned.contains(&Some((54.321, 0.0))));
        assert!(thinned.contains(&None));
        assert_eq!((thinned.first(), thinned.last()), (points.first(), points.last()));
    }
}
