use crate::Point;

/// Where the line `y` crosses a quadratic edge with these start, end and middle: x, in m, at most twice.
///
/// The edge is cut where it turns back in y. A part from `y0` to `y1` crosses if exactly one of them is
/// at most `y`: along a closed curve, whose edges share their ends, the number of crossings is even.
pub(super) fn crossings(&[a, b, middle]: &[Point; 3], y: f64) -> [Option<f64>; 2] {
    let [x_edge, y_edge] = [0, 1].map(|d| Quadratic::through(a[d], b[d], middle[d]));
    let part = |[s0, s1]: [f64; 2], [y0, y1]: [f64; 2]| {
        let is_crossed = (y0 <= y) != (y1 <= y);
        is_crossed.then(|| x_edge.at(y_edge.root(y, y1 > y0).clamp(s0, s1)))
    };
    match y_edge.turn() {
        None => [part([0.0, 1.0], [a[1], b[1]]), None],
        Some(s) => {
            let turn = y_edge.at(s);
            [part([0.0, s], [a[1], turn]), part([s, 1.0], [turn, b[1]])]
        }
    }
}

/// `c + b s + a s²`
struct Quadratic {
    a: f64,
    b: f64,
    c: f64,
}

impl Quadratic {
    fn through(start: f64, end: f64, middle: f64) -> Self {
        Self {
            a: 2.0 * (start + end - 2.0 * middle),
            b: 4.0 * middle - 3.0 * start - end,
            c: start,
        }
    }

    fn at(&self, s: f64) -> f64 {
        self.c + s * (self.b + s * self.a)
    }

    /// Where it has an extremum between 0 and 1.
    fn turn(&self) -> Option<f64> {
        let s = -self.b / (2.0 * self.a);
        (0.0 < s && s < 1.0).then_some(s)
    }

    /// Where it has this value, rising or falling. By the formula that does not cancel.
    fn root(&self, value: f64, rising: bool) -> f64 {
        let sign = if rising { 1.0 } else { -1.0 };
        let discriminant = self.b * self.b - 4.0 * self.a * (self.c - value);
        let slope = sign * discriminant.max(0.0).sqrt();
        if self.b * sign < 0.0 {
            (slope - self.b) / (2.0 * self.a)
        } else if self.b + slope == 0.0 {
            0.0
        } else {
            2.0 * (value - self.c) / (self.b + slope)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn straight_edges_are_crossed_once_or_not() {
        let edge = [[1.0, 0.0], [3.0, 4.0], [2.0, 2.0]];
        assert_eq!(crossings(&edge, 1.0), [Some(1.5), None]);
        assert_eq!(crossings(&edge, 0.0), [Some(1.0), None]);
        assert_eq!(crossings(&edge, 4.0), [None, None]);
        let level = [[1.0, 1.0], [3.0, 1.0], [2.0, 1.0]];
        assert_eq!(crossings(&level, 1.0), [None, None]);
    }

    /// `x = s`, `y = 4 s (1 − s)`: crossed at `(1 ± sqrt(1 − y))/2`.
    #[test]
    fn an_arch_is_crossed_twice() {
        let arch = [[0.0, 0.0], [1.0, 0.0], [0.5, 1.0]];
        for y in [0.0, 1e-12, 0.3, 0.99, 1.0 - 1e-12] {
            let [Some(left), Some(right)] = crossings(&arch, y) else { panic!("{y}") };
            let half = 0.5 * (1.0 - y).sqrt();
            assert!((left - 0.5 + half).abs() < 1e-9 && (right - 0.5 - half).abs() < 1e-9, "{y}");
        }
        assert_eq!(crossings(&arch, 1.0), [None, None]);
        assert_eq!(crossings(&arch, -0.1), [None, None]);
    }
}
