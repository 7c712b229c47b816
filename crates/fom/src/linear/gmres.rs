use super::vector::{add_scaled, dot, norm, scale};
use thiserror::Error;

/// Why GMRES did not reach its tolerance.
///
/// ```
/// use lumley_fom::linear::GmresError;
/// let error = GmresError::Iterations { iterations: 200, residual: 1e-3, tolerance: 1e-10 };
/// assert!(error.to_string().contains("200 iterations"));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum GmresError {
    /// The residual is still too large after the iterations that were allowed.
    #[error(
        "GMRES stopped after {iterations} iterations at a relative residual of {residual:e}, \
         {tolerance:e} was asked for: renew the preconditioner or allow more iterations"
    )]
    Iterations {
        /// Number of iterations.
        iterations: usize,
        /// Residual relative to the right-hand side.
        residual: f64,
        /// The residual that was asked for.
        tolerance: f64,
    },
    /// A whole cycle between two restarts did not reduce the residual.
    #[error(
        "GMRES stagnates at a relative residual of {residual:e} after {iterations} iterations, \
         {tolerance:e} was asked for: renew the preconditioner or restart later"
    )]
    Stagnation {
        /// Number of iterations.
        iterations: usize,
        /// Residual relative to the right-hand side.
        residual: f64,
        /// The residual that was asked for.
        tolerance: f64,
    },
    /// The preconditioned operator sends the search space into itself, and the solution is not in it.
    #[error(
        "GMRES broke down after {iterations} iterations at a relative residual of {residual:e}: \
         the matrix or the preconditioner is singular"
    )]
    Breakdown {
        /// Number of iterations.
        iterations: usize,
        /// Residual relative to the right-hand side.
        residual: f64,
    },
    /// The right-hand side, the start or a product is not finite.
    #[error("GMRES met a number that is not finite in iteration {iteration}")]
    NotFinite {
        /// The iteration, zero before the first.
        iteration: usize,
    },
}

/// When GMRES stops.
///
/// ```
/// use lumley_fom::linear::GmresLimits;
/// let limits = GmresLimits { tolerance: 1e-8, ..GmresLimits::default() };
/// assert_eq!(limits.restart, 20);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GmresLimits {
    /// Residual relative to the right-hand side, both in the 2-norm.
    pub tolerance: f64,
    /// Iterations between two restarts: directions that are kept.
    pub restart: usize,
    /// Iterations altogether.
    pub iterations: usize,
}

impl Default for GmresLimits {
    /// Tolerance 1e-10, restart after 20 iterations, 200 altogether.
    fn default() -> Self {
        Self { tolerance: 1e-10, restart: 20, iterations: 200 }
    }
}

/// A cycle that does not reduce the residual below this share of it is stagnation.
const PROGRESS: f64 = 0.9;
/// Orthogonalised directions shorter than this share of their length are round-off.
const DEPENDENT: f64 = 1e-14;

/// Flexible GMRES (Saad, 1993): the preconditioner stands on the right and may change between
/// iterations.
///
/// The residual of `A (x₀ + Z y)` is made least over the preconditioned directions `Z`, with
/// modified Gram–Schmidt and Givens rotations. All memory is taken at the start.
///
/// ```
/// use lumley_fom::linear::{Gmres, GmresLimits};
/// let mut gmres = Gmres::new(2, GmresLimits::default());
/// let matrix = |x: &[f64], y: &mut [f64]| y.copy_from_slice(&[2.0 * x[0] + x[1], 4.0 * x[1]]);
/// let identity = |x: &[f64], y: &mut [f64]| y.copy_from_slice(x);
/// let mut x = [0.0; 2];
/// let iterations = gmres.solve(matrix, identity, &[3.0, 4.0], &mut x)?;
/// assert!(iterations <= 2 && (x[0] - 1.0).abs() < 1e-12 && (x[1] - 1.0).abs() < 1e-12);
/// # Ok::<(), lumley_fom::linear::GmresError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Gmres {
    limits: GmresLimits,
    count: usize,
    /// Orthonormal directions of the residual space, one after the other.
    basis: Vec<f64>,
    /// What the preconditioner made of them.
    preconditioned: Vec<f64>,
    least_squares: LeastSquares,
}

impl Gmres {
    /// Room for systems of `count` unknowns.
    ///
    /// # Panics
    /// If the restart is zero or the tolerance is not positive.
    pub fn new(count: usize, limits: GmresLimits) -> Self {
        assert!(limits.restart > 0, "GMRES keeps at least one direction");
        assert!(limits.tolerance > 0.0, "a tolerance is positive");
        Self {
            limits,
            count,
            basis: vec![0.0; count * (limits.restart + 1)],
            preconditioned: vec![0.0; count * limits.restart],
            least_squares: LeastSquares::new(limits.restart),
        }
    }

    /// When it stops.
    pub fn limits(&self) -> &GmresLimits {
        &self.limits
    }

    /// Solves `A x = b` from the start value in `x`; returns the number of iterations.
    ///
    /// * `operator`: `y ← A x`, called as `operator(x, y)`
    /// * `preconditioner`: `y ← M⁻¹ x` with M near A
    ///
    /// # Errors
    /// Every variant of [`GmresError`]; `x` is then what it was at the last restart.
    ///
    /// # Panics
    /// If a vector has the wrong length.
    pub fn solve(
        &mut self,
        mut operator: impl FnMut(&[f64], &mut [f64]),
        mut preconditioner: impl FnMut(&[f64], &mut [f64]),
        b: &[f64],
        x: &mut [f64],
    ) -> Result<usize, GmresError> {
        assert_eq!([b.len(), x.len()], [self.count; 2], "one entry for each unknown");
        let size = norm(b);
        if size == 0.0 {
            x.fill(0.0);
            return Ok(0);
        }
        let (mut iterations, mut before) = (0, f64::INFINITY);
        loop {
            let residual = self.start(&mut operator, b, x) / size;
            let GmresLimits { tolerance, iterations: most, .. } = self.limits;
            if !residual.is_finite() {
                return Err(GmresError::NotFinite { iteration: iterations });
            } else if residual <= tolerance {
                return Ok(iterations);
            } else if iterations >= most {
                return Err(GmresError::Iterations { iterations, residual, tolerance });
            } else if residual > PROGRESS * before {
                return Err(GmresError::Stagnation { iterations, residual, tolerance });
            }
            before = residual;
            let done = self.cycle(&mut operator, &mut preconditioner, size, &mut iterations)?;
            self.update(x);
            if done {
                return Ok(iterations);
            }
        }
    }

    /// Puts the normalised residual first in the basis; returns its norm.
    fn start(
        &mut self,
        operator: &mut impl FnMut(&[f64], &mut [f64]),
        b: &[f64],
        x: &[f64],
    ) -> f64 {
        let first = &mut self.basis[..self.count];
        operator(x, first);
        for (r, b) in first.iter_mut().zip(b) {
            *r = b - *r;
        }
        let residual = norm(first);
        if residual > 0.0 {
            scale(first, 1.0 / residual);
        }
        self.least_squares.start(residual);
        residual
    }

    /// Iterates until the next restart; true if the tolerance is reached.
    fn cycle(
        &mut self,
        operator: &mut impl FnMut(&[f64], &mut [f64]),
        preconditioner: &mut impl FnMut(&[f64], &mut [f64]),
        size: f64,
        iterations: &mut usize,
    ) -> Result<bool, GmresError> {
        let most = self.limits.restart.min(self.limits.iterations - *iterations);
        for j in 0..most {
            *iterations += 1;
            let (known, next) = self.basis.split_at_mut((j + 1) * self.count);
            let next = &mut next[..self.count];
            let direction = &mut self.preconditioned[j * self.count..][..self.count];
            preconditioner(&known[j * self.count..], direction);
            operator(direction, next);
            let length = norm(next);
            let column = self.least_squares.column();
            for (h, v) in column.iter_mut().zip(known.chunks_exact(self.count)) {
                *h = dot(next, v);
                add_scaled(next, v, -*h);
            }
            let rest = norm(next);
            if !(length.is_finite() && rest.is_finite()) {
                return Err(GmresError::NotFinite { iteration: *iterations });
            }
            let dependent = rest <= DEPENDENT * length;
            column[j + 1] = if dependent { 0.0 } else { rest };
            let before = self.least_squares.residual() / size;
            let [diagonal, residual] = self.least_squares.rotate();
            if dependent && diagonal <= DEPENDENT * length {
                let (iterations, residual) = (*iterations, before);
                return Err(GmresError::Breakdown { iterations, residual });
            }
            if dependent {
                // The solution lies in the space; the true residual tells.
                return Ok(false);
            }
            if residual / size <= self.limits.tolerance {
                return Ok(true);
            }
            scale(next, 1.0 / rest);
        }
        Ok(false)
    }

    /// `x ← x + Z y`
    fn update(&mut self, x: &mut [f64]) {
        let y = self.least_squares.solve();
        for (z, &y) in self.preconditioned.chunks_exact(self.count).zip(y) {
            add_scaled(x, z, y);
        }
    }
}

/// The small least-squares problem `min |β e₁ − H y|`, made triangular as H grows.
#[derive(Debug, Clone)]
struct LeastSquares {
    restart: usize,
    columns: usize,
    /// Columns of H after the rotations, each `restart + 1` long.
    h: Vec<f64>,
    rotations: Vec<[f64; 2]>,
    rhs: Vec<f64>,
    y: Vec<f64>,
}

impl LeastSquares {
    fn new(restart: usize) -> Self {
        Self {
            restart,
            columns: 0,
            h: vec![0.0; restart * (restart + 1)],
            rotations: vec![[1.0, 0.0]; restart],
            rhs: vec![0.0; restart + 1],
            y: vec![0.0; restart],
        }
    }

    fn start(&mut self, residual: f64) {
        self.columns = 0;
        self.rhs.fill(0.0);
        self.rhs[0] = residual;
    }

    /// The next column of H: the rows that it has, one below the diagonal.
    fn column(&mut self) -> &mut [f64] {
        &mut self.h[self.columns * (self.restart + 1)..][..self.columns + 2]
    }

    /// The residual that is left.
    fn residual(&self) -> f64 {
        self.rhs[self.columns].abs()
    }

    /// Takes the column in; returns its entry on the diagonal and the residual that is left.
    fn rotate(&mut self) -> [f64; 2] {
        let j = self.columns;
        let column = &mut self.h[j * (self.restart + 1)..][..j + 2];
        for (i, [c, s]) in self.rotations[..j].iter().enumerate() {
            (column[i], column[i + 1]) =
                (c * column[i] + s * column[i + 1], c * column[i + 1] - s * column[i]);
        }
        let length = column[j].hypot(column[j + 1]);
        let rotation =
            if length > 0.0 { [column[j] / length, column[j + 1] / length] } else { [1.0, 0.0] };
        column[j] = length;
        self.rotations[j] = rotation;
        self.rhs[j + 1] = -rotation[1] * self.rhs[j];
        self.rhs[j] *= rotation[0];
        self.columns += 1;
        [length, self.residual()]
    }

    fn solve(&mut self) -> &[f64] {
        let columns = self.columns;
        self.y[..columns].copy_from_slice(&self.rhs[..columns]);
        for j in (0..columns).rev() {
            let column = &self.h[j * (self.restart + 1)..][..=j];
            let (above, below) = self.y.split_at_mut(j);
            below[0] /= column[j];
            for (y, h) in above.iter_mut().zip(column) {
                *y -= h * below[0];
            }
        }
        &self.y[..columns]
    }
}
