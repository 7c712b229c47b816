//! The maps of curved cells as polynomials: coefficient `[i][j]` belongs to the i-th power of the first coordinate
//! and the j-th of the second.

use crate::Point;
use std::array::from_fn;

/// The quadratic through the nodes of a triangle, by powers of the coordinates from the centroid.
pub(super) fn triangle(nodes: &[Point; 6]) -> [[Point; 3]; 3] {
    let mut c = [[[0.0; 2]; 3]; 3];
    for d in 0..2 {
        let [u, v, w, uv, vw, wu] = nodes.map(|node| node[d]);
        c[0][0][d] = (4.0 * (uv + vw + wu) - (u + v + w)) / 9.0;
        c[1][0][d] = (v - u + 4.0 * (vw - wu)) / 3.0;
        c[0][1][d] = (w - u + 4.0 * (vw - uv)) / 3.0;
        c[2][0][d] = 2.0 * (u + v - 2.0 * uv);
        c[0][2][d] = 2.0 * (u + w - 2.0 * wu);
        c[1][1][d] = 4.0 * (u - uv + vw - wu);
    }
    c
}

/// The biquadratic through the nodes of a quadrilateral, by powers of the coordinates from the centre.
pub(super) fn square(nodes: &[Point; 9]) -> [[Point; 3]; 3] {
    /// Of the quadratic through these values at -1/2, 0 and 1/2.
    fn powers([a, b, c]: [Point; 3]) -> [Point; 3] {
        let of = |d: usize| [b[d], c[d] - a[d], 2.0 * (a[d] + c[d] - 2.0 * b[d])];
        let (x, y) = (of(0), of(1));
        from_fn(|k| [x[k], y[k]])
    }
    let rows = [[0, 4, 1], [7, 8, 5], [3, 6, 2]].map(|row| powers(row.map(|k| nodes[k])));
    from_fn(|i| powers(rows.map(|row| row[i])))
}
