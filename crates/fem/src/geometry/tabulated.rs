use crate::Point;
use crate::element::Element;

/// The N functions of an element at a point of its reference cell, with the weight of a quadrature.
///
/// ```
/// use lumley_fem::{element::{Cell, Q2}, geometry::Tabulated, quadrature::rule};
/// let points: Vec<Tabulated<9>> = Tabulated::on(&Q2, &rule(Cell::Quadrilateral, 5));
/// let integral: f64 = points.iter().map(|at| at.weight * at.phi[8]).sum();
/// assert!((integral - 4.0 / 9.0).abs() < 1e-15);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tabulated<const N: usize> {
    /// The point, in reference coordinates.
    pub reference: Point,
    /// Weight of the quadrature.
    pub weight: f64,
    /// Values of the functions.
    pub phi: [f64; N],
    /// Gradients of the functions, in reference coordinates.
    pub dphi: [Point; N],
}

impl<const N: usize> Tabulated<N> {
    /// The functions of `element` at one point.
    ///
    /// # Panics
    /// If the element has not N functions.
    pub fn at(element: &dyn Element, reference: Point, weight: f64) -> Self {
        assert_eq!(element.layout().nodes(), N, "functions of the element");
        let (mut phi, mut dphi) = ([0.0; N], [[0.0; 2]; N]);
        element.tabulate(reference, &mut phi, &mut dphi);
        Self { reference, weight, phi, dphi }
    }

    /// The functions of `element` at all points of a quadrature.
    ///
    /// # Panics
    /// If the element has not N functions.
    pub fn on(element: &dyn Element, rule: &[(Point, f64)]) -> Vec<Self> {
        rule.iter().map(|&(point, weight)| Self::at(element, point, weight)).collect()
    }

    /// The functions of `element` at the nodes of `other`; there is no quadrature, all weights are zero.
    ///
    /// # Panics
    /// If the element has not N functions.
    pub fn at_nodes(element: &dyn Element, other: &dyn Element) -> Vec<Self> {
        other.nodes().iter().map(|&point| Self::at(element, point, 0.0)).collect()
    }

    /// The function with these nodal values.
    pub fn value(&self, nodal: &[f64; N]) -> f64 {
        self.phi.iter().zip(nodal).map(|(phi, v)| phi * v).sum()
    }
}
