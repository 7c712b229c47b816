use lumley_fem::element::Element;
use lumley_fem::quadrature::gauss_legendre;
use std::array::from_fn;

/// A rank-two and a rank-three tensor over the P functions of a cell.
pub(super) type Matrix<const P: usize> = [[f64; P]; P];
pub(super) type Tensor<const P: usize> = [[[f64; P]; P]; P];

/// Integrals over the reference interval of products of the P functions of an element.
#[derive(Debug, Clone)]
pub(super) struct ReferenceTensors<const P: usize> {
    /// `∫ φ_i φ_j`.
    pub mass: Matrix<P>,
    /// `∫ φ_i' φ_j'`.
    pub stiffness: Matrix<P>,
    /// `∫ φ_i φ_j φ_k'`.
    pub convection: Tensor<P>,
    /// Points of a quadrature, with weight times `φ_i`.
    pub load: Vec<(f64, [f64; P])>,
}

impl<const P: usize> ReferenceTensors<P> {
    pub fn new(element: &dyn Element) -> Self {
        assert_eq!(element.layout().nodes(), P, "another element");
        let mut tensors = Self {
            mass: [[0.0; P]; P],
            stiffness: [[0.0; P]; P],
            convection: [[[0.0; P]; P]; P],
            load: Vec::new(),
        };
        // Exact to degree 2 P + 1: the convection of degree P − 1 needs 3 P − 4 only.
        for (x, weight) in gauss_legendre(P + 1) {
            let (mut phi, mut dphi) = ([0.0; P], [[0.0; 2]; P]);
            element.tabulate([x, 0.0], &mut phi, &mut dphi);
            tensors.add(weight, &phi, &dphi.map(|d| d[0]));
            tensors.load.push((x, phi.map(|phi| weight * phi)));
        }
        tensors
    }

    fn add(&mut self, weight: f64, phi: &[f64; P], dphi: &[f64; P]) {
        for i in 0..P {
            for j in 0..P {
                self.mass[i][j] += weight * phi[i] * phi[j];
                self.stiffness[i][j] += weight * dphi[i] * dphi[j];
                for (entry, slope) in self.convection[i][j].iter_mut().zip(dphi) {
                    *entry += weight * phi[i] * phi[j] * slope;
                }
            }
        }
    }
}

/// `factor` times a matrix.
pub(super) fn scaled<const P: usize>(factor: f64, matrix: &Matrix<P>) -> Matrix<P> {
    matrix.map(|row| row.map(|entry| factor * entry))
}

/// The sum of two matrices.
pub(super) fn sum<const P: usize>(a: &Matrix<P>, b: &Matrix<P>) -> Matrix<P> {
    from_fn(|i| from_fn(|j| a[i][j] + b[i][j]))
}

/// The matrix times a vector.
pub(super) fn times<const P: usize>(matrix: &Matrix<P>, x: &[f64; P]) -> [f64; P] {
    matrix.map(|row| row.iter().zip(x).map(|(m, x)| m * x).sum())
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumley_fem::element::{P1, P2};

    fn close(a: &[f64], b: &[f64]) {
        for (a, b) in a.iter().zip(b) {
            assert!((a - b).abs() < 1e-15, "{a} {b}");
        }
    }

    #[test]
    fn textbook_matrices() {
        let p1 = ReferenceTensors::<2>::new(&P1);
        close(p1.mass.as_flattened(), &[1. / 3., 1. / 6., 1. / 6., 1. / 3.]);
        close(p1.stiffness.as_flattened(), &[1., -1., -1., 1.]);
        close(p1.convection[0].as_flattened(), &[-1. / 3., 1. / 3., -1. / 6., 1. / 6.]);
        let p2 = ReferenceTensors::<3>::new(&P2);
        let mass = [4., -1., 2., -1., 4., 2., 2., 2., 16.].map(|m| m / 30.);
        close(p2.mass.as_flattened(), &mass);
        let stiffness = [7., 1., -8., 1., 7., -8., -8., -8., 16.].map(|k| k / 3.);
        for (a, b) in p2.stiffness.as_flattened().iter().zip(stiffness) {
            assert!((a - b).abs() < 1e-14, "{a} {b}");
        }
    }

    /// `∫ (φ_i φ_j φ_k)' = φ_i φ_j φ_k` at the right end less at the left one.
    #[test]
    fn convection_integrates_by_parts() {
        let t = ReferenceTensors::<3>::new(&P2).convection;
        for (i, j, k) in (0..27).map(|n| (n / 9, n / 3 % 3, n % 3)) {
            let sum = t[i][j][k] + t[j][k][i] + t[k][i][j];
            let boundary = if (i, j) != (j, k) || i == 2 { 0.0 } else { [-1.0, 1.0][i] };
            assert!((sum - boundary).abs() < 1e-14, "{i}{j}{k}: {sum} {boundary}");
        }
    }
}
