use super::{Analysis, Gmres, GmresError, GmresLimits, Multifrontal, SingularMatrix};
use faer::Par;
use std::sync::Arc;
use thiserror::Error;

/// When to renew a factorisation that preconditions GMRES while the matrix changes.
///
/// A factorisation costs as much as `price` iterations. Over the s systems solved with it the cost of
/// each was `(price + Σ iterations)/s` on average; it falls as long as the last system took fewer
/// iterations than that. From then on it rises, and the factorisation is due. Iterations are counted,
/// not time: the same run renews at the same steps.
///
/// ```
/// use lumley_fom::linear::RenewalPolicy;
/// let mut policy = RenewalPolicy::new(6.0);
/// policy.renewed();
/// for iterations in [2, 2, 3, 3] {
///     policy.solved(iterations);
///     assert!(!policy.is_due());
/// }
/// policy.solved(5); // above (6 + 15)/5
/// assert!(policy.is_due());
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RenewalPolicy {
    price: f64,
    systems: usize,
    iterations: usize,
    due: bool,
}

impl RenewalPolicy {
    /// * `price`: of a factorisation, in iterations
    pub fn new(price: f64) -> Self {
        Self { price, systems: 0, iterations: 0, due: true }
    }

    /// Whether the next system wants a new factorisation.
    pub fn is_due(&self) -> bool {
        self.due
    }

    /// There is a new factorisation.
    pub fn renewed(&mut self) {
        *self = Self { due: false, ..Self::new(self.price) };
    }

    /// Another system took this many iterations.
    pub fn solved(&mut self, iterations: usize) {
        self.systems += 1;
        self.iterations += iterations;
        let average = (self.price + self.iterations as f64) / self.systems as f64;
        self.due = iterations as f64 > average;
    }

    /// The next system gets a new factorisation, whatever the old one is worth.
    pub fn forget(&mut self) {
        self.due = true;
    }
}

/// Why a system was not solved.
///
/// ```
/// use lumley_fom::linear::{LaggedError, SingularMatrix};
/// let singular = SingularMatrix { unknown: 3, pivot: 0.0, least: 1e-8 };
/// assert_eq!(LaggedError::from(singular).to_string(), singular.to_string());
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum LaggedError {
    /// The matrix is singular in single precision.
    #[error(transparent)]
    Singular(#[from] SingularMatrix),
    /// GMRES failed with a factorisation of this very matrix.
    #[error(transparent)]
    Gmres(#[from] GmresError),
}

impl LaggedError {
    /// What to do about it.
    pub fn remedy(&self) -> &'static str {
        match self {
            Self::Singular(_) => {
                "look for a part of the domain whose flow or pressure no condition determines"
            }
            Self::Gmres(_) => {
                "a smaller step makes the system easier, and so does a mesh of better quality"
            }
        }
    }

    /// Whether all numbers were finite.
    pub fn is_finite(&self) -> bool {
        match self {
            Self::Singular(singular) => singular.pivot.is_finite(),
            Self::Gmres(error) => !matches!(error, GmresError::NotFinite { .. }),
        }
    }
}

/// How a system was solved.
///
/// ```
/// use lumley_fom::linear::LaggedStep;
/// let step = LaggedStep { iterations: 3, renewed: false };
/// assert!(!step.renewed);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LaggedStep {
    /// Iterations of GMRES with the factorisation that led to the solution.
    pub iterations: usize,
    /// Whether the matrix was factorised.
    pub renewed: bool,
}

/// Solves a sequence of systems whose matrices change little from one to the next: GMRES with an old
/// factorisation in single precision, which is renewed as the [`RenewalPolicy`] says, and whenever
/// GMRES fails with an old one.
///
/// ```
/// use faer::Par;
/// use lumley_fom::linear::{
///     Analysis, CellUnknowns, DelayedUnknowns, GmresLimits, LaggedSolver, RenewalPolicy,
/// };
/// let line = CellUnknowns::new(3, &[vec![0, 1], vec![1, 2]])?;
/// let analysis = Analysis::new(line, &[[0.0, 0.0], [1.0, 0.0]], &DelayedUnknowns::default());
/// let (limits, policy) = (GmresLimits::default(), RenewalPolicy::new(6.0));
/// let mut solver = LaggedSolver::new(analysis, limits, policy, Par::Seq);
/// let mut x = [0.0; 3];
/// let first = solver.solve(&[2.0, -1.0, -1.0, 2.0].repeat(2), &[1.0, 2.0, 1.0], &mut x)?;
/// let next = solver.solve(&[2.1, -1.0, -1.0, 2.1].repeat(2), &[1.1, 2.2, 1.1], &mut x)?;
/// assert!(first.renewed && !next.renewed);
/// assert!((x[1] - 1.0).abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct LaggedSolver {
    factors: Multifrontal<f32>,
    gmres: Gmres,
    policy: RenewalPolicy,
}

impl LaggedSolver {
    /// Room for systems with this pattern.
    pub fn new(
        analysis: Arc<Analysis>,
        limits: GmresLimits,
        policy: RenewalPolicy,
        par: Par,
    ) -> Self {
        let gmres = Gmres::new(analysis.cells().count(), limits);
        Self { factors: Multifrontal::new(analysis, par), gmres, policy }
    }

    /// Factorises at the next system, so that what follows does not depend on what was before: a run
    /// that continues from a checkpoint has no old factorisation.
    pub fn forget(&mut self) {
        self.policy.forget();
    }

    /// Solves `A x = b` from the start value in `x`, where A is the sum of these cell matrices.
    ///
    /// # Errors
    /// If the matrix is singular, or GMRES does not converge with its own factorisation.
    pub fn solve(
        &mut self,
        matrices: &[f64],
        b: &[f64],
        x: &mut [f64],
    ) -> Result<LaggedStep, LaggedError> {
        if !self.policy.is_due() {
            match self.iterate(matrices, b, x) {
                Ok(iterations) => return Ok(LaggedStep { iterations, renewed: false }),
                Err(_) => self.policy.forget(),
            }
        }
        self.factors.factorise(matrices)?;
        self.policy.renewed();
        match self.iterate(matrices, b, x) {
            Ok(iterations) => Ok(LaggedStep { iterations, renewed: true }),
            Err(error) => {
                self.policy.forget();
                Err(error.into())
            }
        }
    }

    fn iterate(&mut self, matrices: &[f64], b: &[f64], x: &mut [f64]) -> Result<usize, GmresError> {
        let Self { factors, gmres, policy } = self;
        let analysis = factors.analysis().clone();
        let precondition = |r: &[f64], z: &mut [f64]| {
            z.copy_from_slice(r);
            factors.solve(z);
        };
        let multiply = |x: &[f64], y: &mut [f64]| analysis.cells().multiply(matrices, x, y);
        let iterations = gmres.solve(multiply, precondition, b, x)?;
        policy.solved(iterations);
        Ok(iterations)
    }
}
