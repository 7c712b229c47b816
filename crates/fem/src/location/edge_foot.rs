use crate::Point;

/// Parts into which an edge is cut: a search starts at each end of them.
const PARTS: usize = 8;

/// Newton steps of a search: the distance at the end is then right to the round-off of its square.
const STEPS: usize = 6;

/// Square of the distance, in m², of a point from the quadratic edge with these start, end and middle, and
/// the parameter from 0 to 1 of the nearest point of it.
pub(super) fn foot([a, b, middle]: &[Point; 3], point: Point) -> (f64, f64) {
    // The edge is `origin + s slope + s² bend`, seen from the point.
    let origin = [0, 1].map(|d| a[d] - point[d]);
    let slope = [0, 1].map(|d| 4.0 * middle[d] - 3.0 * a[d] - b[d]);
    let bend = [0, 1].map(|d| 2.0 * (a[d] + b[d] - 2.0 * middle[d]));
    let at = |s: f64| [0, 1].map(|d| origin[d] + s * (slope[d] + s * bend[d]));
    let square = |s: f64| dot(at(s), at(s));
    let better = |s: f64, t: f64| if square(t) < square(s) { t } else { s };
    let part = 1.0 / PARTS as f64;
    let refined = |start: f64| {
        let mut s = start;
        for _ in 0..STEPS {
            let (x, along) = (at(s), [0, 1].map(|d| slope[d] + 2.0 * s * bend[d]));
            let curvature = dot(along, along) + 2.0 * dot(x, bend);
            let steepness = if curvature > 0.0 { curvature } else { dot(along, along) };
            let next = s - dot(x, along) / steepness;
            s = next.clamp(start - part, start + part).clamp(0.0, 1.0);
        }
        better(start, s)
    };
    let best = (0..=PARTS).map(|k| refined(k as f64 * part)).fold(0.0, better);
    (square(best), best)
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// No point of a fine division of the edge is nearer.
    #[test]
    fn nothing_on_the_edge_is_nearer() {
        let edges = [
            [[0.0, 0.0], [2.0, 1.0], [1.0, 0.5]],
            [[0.0, 0.0], [1.0, 0.0], [0.5, 0.4]],
            [[0.0, 0.0], [1.0, 0.0], [0.3, -0.2]],
        ];
        for edge in &edges {
            for k in 0..400 {
                let point = [f64::from(k % 20) * 0.15 - 0.8, f64::from(k / 20) * 0.13 - 1.1];
                let (square, s) = foot(edge, point);
                let phi = |s: f64| {
                    [(1.0 - s) * (1.0 - 2.0 * s), s * (2.0 * s - 1.0), 4.0 * s * (1.0 - s)]
                };
                let distance = |s: f64| {
                    let f = phi(s);
                    let at = [0, 1].map(|d| (0..3).map(|k| f[k] * edge[k][d]).sum::<f64>());
                    (at[0] - point[0]).hypot(at[1] - point[1])
                };
                assert!((distance(s) - square.sqrt()).abs() < 1e-14);
                let least = (0..=10_000)
                    .map(|k| distance(f64::from(k) * 1e-4))
                    .fold(f64::INFINITY, f64::min);
                assert!(distance(s) <= least + 1e-14, "{edge:?} from {point:?}");
            }
        }
    }
}
