use crate::PrescribedError;

/// Why bodies cannot be moved over a step.
///
/// ```
/// use lumley_body::DynamicsError;
/// let error = DynamicsError::Massless { coordinate: "disc.y".into() };
/// assert!(error.to_string().starts_with("nothing has inertia along disc.y"));
/// ```
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum DynamicsError {
    /// Bodies without inertia, and no fluid to give them one.
    #[error(
        "nothing has inertia along {coordinate}: without a fluid give the body, or one that it carries, a mass and an inertia above 0"
    )]
    Massless {
        /// The coordinate.
        coordinate: String,
    },
    /// A step that is not a positive number.
    #[error("the step from t = {time} s is {step} s, expected a finite number above 0")]
    Step {
        /// The time, in s.
        time: f64,
        /// The step, in s.
        step: f64,
    },
    /// A load that is not a number.
    #[error(
        "the load on body \"{body}\" after t = {time} s is {force:?} N/m and {moment} N, expected finite numbers"
    )]
    Load {
        /// The body.
        body: String,
        /// The time, in s.
        time: f64,
        /// Its force, in N/m.
        force: [f64; 2],
        /// Its moment, in N.
        moment: f64,
    },
    /// A prescribed coordinate that is not a number.
    #[error(transparent)]
    Prescribed(#[from] PrescribedError),
    /// A prescribed coordinate in a scheme that only takes free ones.
    #[error(
        "{coordinate} is prescribed, which the Runge-Kutta scheme does not do: take an implicit one"
    )]
    Explicit {
        /// The coordinate.
        coordinate: String,
    },
    /// Equations without a single solution.
    #[error(
        "the equations of the bodies are singular at {coordinate} after t = {time} s: take a smaller step"
    )]
    Singular {
        /// The time, in s.
        time: f64,
        /// The coordinate.
        coordinate: String,
    },
    /// Newton's method that did not converge.
    #[error(
        "the bodies did not converge in {iterations} iterations after t = {time} s: the residual at {coordinate} is {residual:e}, expected {tolerance:e} or less: take a smaller step"
    )]
    NoConvergence {
        /// The time, in s.
        time: f64,
        /// Iterations made.
        iterations: usize,
        /// Where the residual is largest against what is asked for.
        coordinate: String,
        /// The residual there, in N/m or N.
        residual: f64,
        /// What is asked for.
        tolerance: f64,
    },
}
