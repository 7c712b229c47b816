//! The reduced piston: a projected flow, its block, and an integrator.

mod checkpoint;
mod physics;

pub(crate) use physics::Motion;
pub use physics::{PistonPhysics, PistonStart};

use crate::basis::{Basis, Frame, norm};
use crate::integrator::{Integrator, Stepper, System, stable_step};
use crate::projection::{Projection, ProjectionKind, project};
use crate::{Divergence, ModelChoice, ReducedError};
use checkpoint::{Identity, identity};
use lumley_body::BodyState;
use lumley_fem::UniformGrid;

/// Norm of the velocity, over the largest that the energy of the start accounts for, that is taken for
/// a divergence. A wrong but bounded model stays below.
const NONSENSE: f64 = 5.0;
/// Positions of the block at which the stable step is estimated.
const POSITIONS: usize = 32;

/// A reduced-order model of the piston, paper (37) with (34), stepped in time.
///
/// The state is `(a_1 .. a_N, X, X')`. A step allocates nothing and takes O(N³), whatever the grid.
///
/// ```
/// use lumley_body::joint::Prismatic;
/// use lumley_rom::{Basis, ClosureKind, Integrator, ModelChoice, PistonPhysics, PistonStart};
/// use lumley_rom::{ProjectionKind, ReducedPiston};
///
/// let joint = Prismatic { mass: 0.5, stiffness: 39.5, damping: 0.1, rest_length: 0.95 };
/// let physics =
///     PistonPhysics { viscosity: 0.2, force_factor: 1.0, domain_length: 1.1, joint };
/// let modes = faer::mat![[0.0], [30_f64.sqrt() / 4.0], [0.0]]; // sqrt(30) ξ (1 − ξ)
/// let basis = Basis::on_reference(&[0.0, 0.5, 1.0], 2, modes.as_ref(), None)?;
/// let model =
///     ModelChoice { projection: ProjectionKind::Mapped {}, closure: ClosureKind::default() };
/// let start = PistonStart { coefficients: vec![0.0], position: 0.9, velocity: 0.0 };
///
/// let mut piston = ReducedPiston::new(&physics, &model, Integrator::Rk4 {}, &basis, &start)?;
/// for _ in 0..1000 {
///     piston.step(1e-3)?;
/// }
/// assert!((piston.time() - 1.0).abs() < 1e-12);
/// assert!((piston.body().position[0] - 0.95).abs() < 0.01);
/// # Ok::<(), lumley_rom::ReducedError>(())
/// ```
pub struct ReducedPiston {
    system: PistonSystem,
    stepper: Box<dyn Stepper>,
    basis: Basis,
    kind: ProjectionKind,
    identity: Identity,
    time: f64,
    now: State,
    next: State,
    body: BodyState,
    /// Largest [`norm_of`](Self::norm_of) a state that makes sense.
    limit: f64,
    length: f64,
    /// Positions in m between which the spring lets the block move from the start.
    reach: (f64, f64),
}

/// A state `(a, X, X')`, with the frozen coefficient of a mean in front, and what belongs to it.
#[derive(Debug, Clone)]
struct State {
    y: Vec<f64>,
    rates: Vec<f64>,
    traction: f64,
}

/// Flow and body as one system of ordinary differential equations.
struct PistonSystem {
    projection: Box<dyn Projection>,
    /// Of the last evaluation.
    traction: f64,
}

impl System for PistonSystem {
    fn rates(&mut self, y: &[f64], rates: &mut [f64]) {
        let width = y.len() - 2;
        let body = Motion { position: y[width], velocity: y[width + 1] };
        let response = self.projection.rates(body, &y[..width], &mut rates[..width]);
        rates[width] = body.velocity;
        rates[width + 1] = response.acceleration;
        self.traction = response.traction;
    }
}

impl ReducedPiston {
    /// Builds the operators of `model` on `basis` and takes up the start.
    ///
    /// # Errors
    /// A parameter out of range; a basis in another frame than the projection's, or on another
    /// domain; a start that does not fit.
    pub fn new(
        physics: &PistonPhysics,
        model: &ModelChoice,
        integrator: Integrator,
        basis: &Basis,
        start: &PistonStart,
    ) -> Result<Self, ReducedError> {
        physics.validate()?;
        model.validate()?;
        integrator.validate()?;
        start.validate(basis.modes(), physics)?;
        let mut y = vec![1.0; basis.frozen()];
        y.extend(&start.coefficients);
        y.extend([start.position, start.velocity]);
        let state = State { rates: vec![0.0; y.len()], traction: 0.0, y };
        let mut piston = Self {
            system: PistonSystem { projection: project(model, physics, basis)?, traction: 0.0 },
            stepper: integrator.stepper(state.y.len()),
            basis: basis.clone(),
            kind: model.projection,
            identity: identity(physics, model, integrator, basis),
            time: 0.0,
            next: state.clone(),
            now: state,
            body: BodyState::new(vec![start.position], vec![start.velocity]),
            limit: NONSENSE * physics.largest_norm(start, basis),
            length: physics.domain_length,
            reach: physics.reach(start),
        };
        piston.evaluate();
        Ok(piston)
    }

    /// Moves the model by `dt` seconds.
    ///
    /// # Errors
    /// A step that is not positive and finite; a divergence, after which the model still has the state
    /// before the step.
    pub fn step(&mut self, dt: f64) -> Result<(), ReducedError> {
        ReducedError::check_positive("the time step", dt, "s")?;
        self.next.y.copy_from_slice(&self.now.y);
        self.next.rates.copy_from_slice(&self.now.rates);
        let State { y, rates, .. } = &mut self.next;
        let outcome = self.stepper.step(&mut self.system, y, rates, dt);
        self.next.traction = self.system.traction;
        if let Some(cause) = self.divergence(outcome) {
            let stable_step = self.stepper.is_explicit().then(|| self.stable_step());
            return Err(ReducedError::Diverged {
                time: self.time,
                step: dt,
                stable_step,
                projection: self.kind,
                cause,
            });
        }
        std::mem::swap(&mut self.now, &mut self.next);
        self.time += dt;
        self.publish();
        Ok(())
    }

    /// Time since the start, in s.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// The coefficients `a_1 .. a_N`, in m^(3/2)/s on a fixed grid, in m/s in the reference frame.
    pub fn coefficients(&self) -> &[f64] {
        &self.functions()[self.basis.frozen()..]
    }

    /// Position X in m and velocity X' in m/s of the block.
    pub fn body(&self) -> &BodyState {
        &self.body
    }

    /// τ, which stands for the fluid's `ν u_x(X-)`, in m²/s²; the block feels `−c_F τ`.
    pub fn traction(&self) -> f64 {
        self.now.traction
    }

    /// Longest step in s for which explicit RK4 is stable: 2.785 over the spectral radius of viscosity
    /// and interface forces, the smallest over the positions that the spring lets the block reach from
    /// its start.
    ///
    /// An estimate, good to a few per cent: convection is left out, the radius comes from the power
    /// method, the positions are sampled. It takes some thousands of evaluations.
    pub fn stable_step(&mut self) -> f64 {
        let mut y = self.now.y.clone();
        let width = y.len() - 2;
        y[self.basis.frozen()..width].fill(0.0);
        y[width + 1] = 0.0;
        let (here, (low, high)) = (y[width], self.reach);
        let inner =
            (0..POSITIONS).map(|k| low + (high - low) * (k as f64 + 0.5) / POSITIONS as f64);
        let at = |position| {
            y[width] = position;
            stable_step(&mut self.system, &y, here)
        };
        inner.chain([here]).map(at).fold(f64::INFINITY, f64::min)
    }

    /// Writes the global velocity at the nodes of a line in (0, L), in m/s.
    ///
    /// On a fixed grid `sum_n a_n Φ_n`; in the reference frame `X' ξ + sum_n a_n φ_n(ξ)` in the
    /// fluid and X' beyond.
    ///
    /// # Errors
    /// A grid that is not a line inside of the domain, or a `velocity` of another length.
    pub fn sample(&self, grid: &UniformGrid, velocity: &mut [f64]) -> Result<(), ReducedError> {
        self.check_grid(grid, velocity.len())?;
        for (k, v) in velocity.iter_mut().enumerate() {
            *v = self.velocity_at(grid.point(k)[0]);
        }
        Ok(())
    }

    fn velocity_at(&self, x: f64) -> f64 {
        let (position, velocity) = (self.body.position[0], self.body.velocity[0]);
        let xi = x / position;
        match self.basis.frame() {
            Frame::Grid => self.basis.evaluate(x, self.functions()),
            Frame::Reference if xi < 1.0 => {
                velocity * xi + self.basis.evaluate(xi, self.functions())
            }
            Frame::Reference => velocity,
        }
    }

    /// Coefficients of all functions, that of the mean included.
    fn functions(&self) -> &[f64] {
        &self.now.y[..self.now.y.len() - 2]
    }

    /// Rates and traction of the present state.
    fn evaluate(&mut self) {
        self.system.rates(&self.now.y, &mut self.now.rates);
        self.now.traction = self.system.traction;
    }

    fn publish(&mut self) {
        let width = self.now.y.len() - 2;
        self.body.position[0] = self.now.y[width];
        self.body.velocity[0] = self.now.y[width + 1];
    }

    /// What is wrong with the next state, if anything.
    fn divergence(&self, outcome: Result<(), Divergence>) -> Option<Divergence> {
        if let Err(cause) = outcome {
            return Some(cause);
        }
        let State { y, rates, .. } = &self.next;
        let (norm, position) = (self.norm_of(y), y[y.len() - 2]);
        if !(norm.is_finite() && position.is_finite() && rates.iter().all(|r| r.is_finite())) {
            Some(Divergence::NotFinite)
        } else if !(position > 0.0 && position < self.length) {
            Some(Divergence::Outside { position, length: self.length })
        } else if norm > self.limit {
            Some(Divergence::Speed { norm, limit: self.limit })
        } else {
            None
        }
    }

    /// Norm of the flow in L2, the mean apart, and of the block's velocity all over the basis' domain.
    fn norm_of(&self, y: &[f64]) -> f64 {
        let (flow, body) = y.split_at(y.len() - 2);
        norm(&flow[self.basis.frozen()..]).hypot(body[1] * self.basis.extent().sqrt())
    }

    fn check_grid(&self, grid: &UniformGrid, found: usize) -> Result<(), ReducedError> {
        let (lower, upper) = grid.bounds();
        let beyond = self.length * (1.0 + 1e-12);
        if grid.dimension() != 1 || lower[0] < 0.0 || upper[0] > beyond {
            return Err(ReducedError::Grid {
                lower: lower[0],
                upper: upper[0],
                dimension: grid.dimension(),
                expected: "a line inside of (0, L)",
            });
        }
        if found != grid.len() {
            let (what, expected) = ("values of the sampled velocity", grid.len());
            return Err(ReducedError::Count { what, found, expected });
        }
        Ok(())
    }
}
