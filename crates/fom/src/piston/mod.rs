//! The piston: the Burgers equation on a moving interval, coupled with a block on a spring.

mod assembly;
mod checkpoint;
mod error;
mod field;
mod forcing;
mod instant;
mod magnitude;
mod newton;
mod parameters;
mod tensors;
#[cfg(test)]
mod uniform_flow;

pub use error::PistonError;
pub use forcing::Forcing;
pub use newton::PistonStep;
pub use parameters::{InitialFlow, PistonParameters};

use crate::TimeScheme;
use assembly::{Assembly, FluidEquations};
use instant::{Instant, Variation};
use lumley_body::BodyState;
use lumley_fem::LineMesh;
use lumley_fem::element::{P1, P2};

/// Largest number of cells: beyond it, a slip of the pen is likelier than a wish.
const MOST_CELLS: usize = 1_000_000;

/// The full-order piston, paper eqs. (33) and (34), on the moving mesh `x = xi X(t)`, `w = xi X'`.
///
/// ```text
/// u_t + (u − w) u_x − nu u_xx = 0 on (0, X),   u(0, t) = 0,   u(X, t) = X'
/// m X'' + K (X − x0) + b X' = −c_F nu u_x(X−)
/// ```
///
/// Finite elements of degree 1 or 2 on equal cells, in the advective form, which keeps uniform flow
/// under any motion of the mesh. Each step solves for fluid and block together by Newton-Raphson, at
/// a cost linear in the cells and without allocation. The traction is the consistent flux, the
/// residual of the fluid's equation at the interface, which converges with the order of u.
///
/// ```
/// use lumley_body::joint::Prismatic;
/// use lumley_fom::{InitialFlow, Piston, PistonParameters, TimeScheme};
/// let parameters = PistonParameters {
///     viscosity: 0.2,
///     domain_length: 1.1,
///     force_factor: 0.0,
///     joint: Prismatic { mass: 0.5, stiffness: 39.5, damping: 0.1, rest_length: 0.95 },
///     initial_position: 0.9,
///     initial_velocity: 0.0,
///     initial_flow: InitialFlow::Zero,
/// };
/// let mut piston = Piston::new(&parameters, 50, 1, TimeScheme::Bdf2)?;
/// for _ in 0..100 {
///     piston.step(0.001)?;
/// }
/// // This block does not feel the fluid: it is the damped oscillator.
/// let (x, v) = parameters.joint.free_motion(0.9, 0.0, 0.1);
/// assert!((piston.interface() - x).abs() < 1e-6);
/// assert!((piston.body().velocity[0] - v).abs() < 1e-4);
/// # Ok::<(), lumley_fom::PistonError>(())
/// ```
#[derive(Debug)]
pub struct Piston {
    parameters: PistonParameters,
    scheme: TimeScheme,
    mesh: LineMesh,
    reference: Vec<f64>,
    forcing: Option<Box<dyn Forcing>>,
    fluid: Box<dyn FluidEquations>,
    /// The instant before `now`, as long as a step leads from the one to the other.
    before: Instant,
    now: Instant,
    /// Where the next instant is sought; without meaning between steps.
    trial: Instant,
    previous_step: Option<f64>,
    body: BodyState,
    traction: f64,
}

impl Piston {
    /// The piston at t = 0 on a mesh of `cells` cells with elements of this `degree`, 1 or 2.
    ///
    /// # Errors
    /// The [`PistonError`] that names what is out of its range.
    pub fn new(
        parameters: &PistonParameters,
        cells: usize,
        degree: usize,
        scheme: TimeScheme,
    ) -> Result<Self, PistonError> {
        Self::build(parameters, cells, degree, scheme, None)
    }

    /// The piston of [`new`](Self::new) with sources in its equations.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn forced(
        parameters: &PistonParameters,
        cells: usize,
        degree: usize,
        scheme: TimeScheme,
        forcing: Box<dyn Forcing>,
    ) -> Result<Self, PistonError> {
        Self::build(parameters, cells, degree, scheme, Some(forcing))
    }

    fn build(
        parameters: &PistonParameters,
        cells: usize,
        degree: usize,
        scheme: TimeScheme,
        forcing: Option<Box<dyn Forcing>>,
    ) -> Result<Self, PistonError> {
        parameters.check()?;
        let (mesh, fluid) = discretise(cells, degree, parameters.viscosity)?;
        let reference = mesh.uniform(0.0, 1.0);
        let u = reference.iter().map(|&xi| parameters.initial_velocity_at(xi)).collect();
        let now = Instant {
            time: 0.0,
            interface: parameters.initial_position,
            u,
            rate: vec![0.0; mesh.nodes()],
            last: cells,
        };
        let mut piston = Self {
            parameters: parameters.clone(),
            scheme,
            mesh,
            reference,
            forcing,
            fluid,
            before: now.clone(),
            trial: now.clone(),
            now,
            previous_step: None,
            body: BodyState::new(vec![0.0], vec![0.0]),
            traction: 0.0,
        };
        piston.start()?;
        Ok(piston)
    }

    /// Finds the accelerations of the initial state, in which the equations are linear.
    fn start(&mut self) -> Result<(), PistonError> {
        let variation = Variation { rate: 1.0, state: 0.0 };
        self.trial.clone_from(&self.now);
        self.evaluate();
        self.iterate(variation);
        self.evaluate();
        if !self.consistent_traction().is_finite() {
            return Err(PistonError::NonFinite { time: self.now.time });
        }
        self.accept();
        Ok(())
    }

    /// One step of `dt`, in s, which may differ from the step before.
    ///
    /// On an error the piston stays as it was before the step.
    ///
    /// # Errors
    /// [`PistonError::Step`], [`PistonError::NotConverged`], [`PistonError::InterfaceLeft`],
    /// [`PistonError::NonFinite`].
    pub fn step(&mut self, dt: f64) -> Result<PistonStep, PistonError> {
        if !(dt.is_finite() && dt > 0.0) {
            return Err(PistonError::Step(dt));
        }
        let variation = self.predict(dt);
        let step = self.solve(variation)?;
        self.accept();
        self.previous_step = Some(dt);
        Ok(step)
    }

    /// Sets the trial instant to `y + dt y'`, with the rates that the scheme gives it.
    fn predict(&mut self, dt: f64) -> Variation {
        let formula = self.scheme.formula(dt, self.previous_step);
        let Self { before, now, trial, .. } = self;
        let known = now.u.iter().zip(&now.rate).zip(&before.u);
        for ((u, rate), ((now, now_rate), before)) in
            trial.u.iter_mut().zip(&mut trial.rate).zip(known)
        {
            *u = now + dt * now_rate;
            *rate = formula.new * *u
                + formula.now * now
                + formula.before * before
                + formula.rate * now_rate;
        }
        let history = formula.now * now.interface
            + formula.before * before.interface
            + formula.rate * now.velocity();
        trial.interface = (trial.velocity() - history) / formula.new;
        trial.time = now.time + dt;
        Variation { rate: formula.new, state: 1.0 }
    }

    /// Makes the trial instant the present one.
    fn accept(&mut self) {
        self.traction = self.consistent_traction();
        std::mem::swap(&mut self.before, &mut self.now);
        std::mem::swap(&mut self.now, &mut self.trial);
        self.show_body();
    }

    fn show_body(&mut self) {
        self.body.position[0] = self.now.interface;
        self.body.velocity[0] = self.now.velocity();
    }

    /// Time, in s.
    pub fn time(&self) -> f64 {
        self.now.time
    }

    /// Position X of the interface, in m.
    pub fn interface(&self) -> f64 {
        self.now.interface
    }

    /// Position and velocity of the block.
    pub fn body(&self) -> &BodyState {
        &self.body
    }

    /// Acceleration X'' of the block, in m/s².
    pub fn acceleration(&self) -> f64 {
        self.now.acceleration()
    }

    /// Traction `nu u_x(X−)` of the fluid at the interface, in m²/s².
    pub fn traction(&self) -> f64 {
        self.traction
    }

    /// The mesh in the reference domain from 0 to 1.
    pub fn mesh(&self) -> &LineMesh {
        &self.mesh
    }

    /// Coordinates xi of the nodes, from the wall to the interface.
    pub fn nodes(&self) -> impl Iterator<Item = f64> + '_ {
        self.mesh.left_to_right().map(|node| self.reference[node])
    }

    /// Velocities of the fluid at these nodes, in m/s.
    pub fn velocities(&self) -> impl Iterator<Item = f64> + '_ {
        self.mesh.left_to_right().map(|node| self.now.u[node])
    }
}

/// The mesh and the fluid's equations on it.
fn discretise(
    cells: usize,
    degree: usize,
    viscosity: f64,
) -> Result<(LineMesh, Box<dyn FluidEquations>), PistonError> {
    if !(2..=MOST_CELLS).contains(&cells) {
        return Err(PistonError::Cells { cells, largest: MOST_CELLS });
    }
    match degree {
        1 => {
            let mesh = LineMesh::new(cells, &P1);
            Ok((mesh, Box::new(Assembly::<2>::new(&mesh, viscosity))))
        }
        2 => {
            let mesh = LineMesh::new(cells, &P2);
            Ok((mesh, Box::new(Assembly::<3>::new(&mesh, viscosity))))
        }
        _ => Err(PistonError::Degree(degree)),
    }
}
