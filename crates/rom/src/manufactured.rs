//! Manufactured modes for tests: given functions made orthonormal in L2, as POD would give them.

use faer::Mat;
use lumley_fem::LineMesh;
use lumley_fem::element::{Element, P1, P2};
use lumley_fem::quadrature::gauss_legendre;

/// Where the manufactured modes of [`grid_modes`] have their kink, in m.
pub const KINK: f64 = 0.95;

/// Equally spaced nodes from 0 to `end`.
pub fn nodes(end: f64, count: usize) -> Vec<f64> {
    (0..count).map(|k| end * k as f64 / (count - 1) as f64).collect()
}

/// Modes like those of the piston's global velocity: zero at 0, slopes in the fluid, constant beyond.
pub fn grid_modes(nodes: &[f64], count: usize) -> Mat<f64> {
    orthonormal(nodes, 1, count, |k, x| {
        let xi = (x / KINK).min(1.0);
        if k == 0 { xi } else { (k as f64 * std::f64::consts::PI * xi).sin() + 0.3 * xi * xi }
    })
}

/// Modes that vanish at both ends of the reference frame.
pub fn reference_modes(nodes: &[f64], degree: usize, count: usize) -> Mat<f64> {
    let power = |k| i32::try_from(k).expect("a few modes");
    orthonormal(nodes, degree, count, |k, xi| xi * (1.0 - xi) * (1.0 + xi).powi(power(k)))
}

/// The functions `f(k, x)`, k < `count`, made orthonormal one after the other, twice.
pub fn orthonormal(
    nodes: &[f64],
    degree: usize,
    count: usize,
    f: impl Fn(usize, f64) -> f64,
) -> Mat<f64> {
    let mut modes: Vec<Vec<f64>> = Vec::new();
    for k in 0..count {
        let mut mode: Vec<f64> = nodes.iter().map(|&x| f(k, x)).collect();
        for _ in 0..2 {
            for earlier in &modes {
                let part = product(nodes, degree, earlier, &mode);
                mode.iter_mut().zip(earlier).for_each(|(m, e)| *m -= part * e);
            }
            let length = product(nodes, degree, &mode, &mode).sqrt();
            for value in &mut mode {
                *value /= length;
            }
        }
        modes.push(mode);
    }
    Mat::from_fn(nodes.len(), count, |i, k| modes[k][i])
}

/// The product in L2 of two finite element functions given at nodes from left to right.
fn product(nodes: &[f64], degree: usize, f: &[f64], g: &[f64]) -> f64 {
    let element: &dyn Element = if degree == 1 { &P1 } else { &P2 };
    let mesh = LineMesh::new((nodes.len() - 1) / degree, element);
    let arrange = |values: &[f64]| {
        let mut arranged = vec![0.0; values.len()];
        mesh.left_to_right().zip(values).for_each(|(node, v)| arranged[node] = *v);
        arranged
    };
    let [x, f, g] = [nodes, f, g].map(arrange);
    let at = |values: &[f64], place| mesh.evaluate(&x, values, place).expect("inside");
    let cell = |c: usize| {
        let size = x[c + 1] - x[c];
        let start = x[c];
        gauss_legendre(3)
            .into_iter()
            .map(move |(s, w)| (start + s * size, w * size))
            .collect::<Vec<_>>()
    };
    (0..mesh.cells()).flat_map(cell).map(|(p, w)| w * at(&f, p) * at(&g, p)).sum()
}
