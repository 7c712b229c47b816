use std::fmt;

/// Sources in the equations of the piston: paper eq. (33) = `fluid`, (34) = the fluid's force + `body`.
///
/// Manufactured solutions are made with it. Sources depend on time and on the place in the
/// reference domain, not on the unknowns, so that Newton's method keeps its order.
///
/// ```
/// use lumley_fom::Forcing;
/// #[derive(Debug)]
/// struct Shaker;
/// impl Forcing for Shaker {
///     fn body(&self, t: f64) -> f64 {
///         0.1 * (5.0 * t).sin()
///     }
/// }
/// assert_eq!((Shaker.fluid(0.5, 0.0), Shaker.body(0.0)), (0.0, 0.0));
/// ```
pub trait Forcing: fmt::Debug + Send + Sync {
    /// Source of the fluid's equation at `xi = x/X`, from 0 to 1, and time `t` in s; in m/s².
    fn fluid(&self, xi: f64, t: f64) -> f64 {
        let _ = (xi, t);
        0.0
    }

    /// Force on the block at time `t` in s, besides spring, damper and fluid; in N.
    fn body(&self, t: f64) -> f64 {
        let _ = t;
        0.0
    }
}
