use super::quadratic::{entries, entry_count, multiply, subtract_contraction};
use super::{Projection, Response, subtract_viscous};
use crate::basis::{Basis, dot};
use crate::closure::ClosureKind;
use crate::piston::{Motion, PistonPhysics};

/// Galerkin system in the reference frame ξ = x/X of the fluid, beyond the paper.
///
/// With `u = X' ξ + w`, `w = sum_n a_n φ_n(ξ)`, φ_n zero at both ends, `c_n = int ξ φ_n`,
/// `T_nmp = int φ_n φ_m φ_p'` and `G_nm = int φ_n' φ_m'` over (0, 1):
///
/// ```text
/// a_n' = −X'' c_n − (X'/X) (φ_n, w) − (1/X) (T a a)_n − (ν/X²) (G a)_n
/// τ    = X (X''/3 + c.a') + X' (ξ, w) − |w|²/2 + ν X'/X
/// m X'' = f(X, X') − c_F τ
/// ```
///
/// The traction is the fluid equation tested with ξ. It holds `a'` and thus `X''`, so the mass solved with
/// is `m + c_F X (1/3 − |c|²)`. By Bessel's inequality `|c|² <= |ξ|² = 1/3`: it is never less than m.
pub(crate) struct Mapped {
    physics: PistonPhysics,
    closure: ClosureKind,
    frozen: usize,
    /// `(φ_n, φ_m)`: the identity, but for a mean.
    mass: Vec<f64>,
    stiffness: Vec<f64>,
    convection: Vec<f64>,
    /// c, the mean's included.
    moment: Vec<f64>,
    /// `1/3 − |c|²` over the modes proper: fluid mass that the modes do not carry, per c_F X.
    stiff_mass: f64,
    viscous: Vec<f64>,
    product: Vec<f64>,
}

impl Mapped {
    pub fn new(physics: PistonPhysics, closure: ClosureKind, basis: &Basis) -> Self {
        let (n, frozen) = (basis.width(), basis.frozen());
        let mut moment = vec![0.0; n];
        for (k, xi) in basis.nodes().iter().enumerate() {
            for (c, dual) in moment.iter_mut().zip(basis.dual_row(k)) {
                *c += xi * dual;
            }
        }
        let stiff_mass = 1.0 / 3.0 - dot(&moment[frozen..], &moment[frozen..]);
        let mut system = Self {
            physics,
            closure,
            frozen,
            mass: vec![0.0; n * n],
            stiffness: vec![0.0; n * n],
            convection: vec![0.0; entry_count(n)],
            moment,
            stiff_mass,
            viscous: vec![0.0; n],
            product: vec![0.0; n],
        };
        basis.integrate(|weight, phi, slope| system.accumulate(weight, phi, slope));
        system
    }

    /// Adds one quadrature point to the tensors.
    fn accumulate(&mut self, weight: f64, phi: &[f64], slope: &[f64]) {
        let n = phi.len();
        for k in 0..n * n {
            self.mass[k] += weight * phi[k / n] * phi[k % n];
            self.stiffness[k] += weight * slope[k / n] * slope[k % n];
        }
        for (entry, (i, m, p)) in self.convection.iter_mut().zip(entries(n)) {
            if i < n {
                let half = if m == p { 0.5 } else { 1.0 };
                *entry += weight * half * phi[i] * (phi[m] * slope[p] + phi[p] * slope[m]);
            }
        }
    }
}

impl Projection for Mapped {
    fn rates(&mut self, body: Motion, a: &[f64], rates: &mut [f64]) -> Response {
        let Motion { position: x, velocity: v } = body;
        let PistonPhysics { viscosity: nu, force_factor, joint, .. } = self.physics;

        rates.fill(0.0);
        subtract_contraction(&self.convection, a, rates);
        multiply(&self.mass, a, &mut self.product);
        multiply(&self.stiffness, a, &mut self.viscous);
        for (i, rate) in rates.iter_mut().enumerate() {
            *rate = (*rate - v * self.product[i]) / x;
            self.viscous[i] *= nu / (x * x);
        }
        subtract_viscous(self.closure, self.frozen, &mut self.viscous, rates);

        // τ without the part of X'', which goes to the left-hand side.
        let steady = x * dot(&self.moment, rates) + v * dot(&self.moment, a)
            - 0.5 * dot(a, &self.product)
            + nu * v / x;
        let added_mass = x * self.stiff_mass;
        let acceleration =
            (joint.force(x, v) - force_factor * steady) / (joint.mass + force_factor * added_mass);
        for (rate, c) in rates[self.frozen..].iter_mut().zip(&self.moment[self.frozen..]) {
            *rate -= acceleration * c;
        }
        Response { traction: steady + added_mass * acceleration, acceleration }
    }
}
