use super::{DynamicsError, check_loads, check_step, check_tree};
use crate::{BodyState, Equations, Kinematics, Load, Square, Tree};

/// The bodies of a tree without a fluid, by the classical Runge-Kutta scheme of fourth order: explicit, of high
/// accuracy, for bodies that nothing prescribes. A step allocates nothing.
///
/// ```
/// use lumley_body::{RigidBody, RungeKutta, Tree};
/// let stone: RigidBody = toml::from_str(
///     "name = 'stone'\nmass = 1\ninertia = 1\ncentre = [0, 0]\njoint = { kind = 'free' }
///      start = { velocity = [1, 4.905, 2] }",
/// )?;
/// let mut stone = RungeKutta::new(Tree::new(&[stone], [0.0, -9.81])?)?;
/// stone.step(1.0, &[])?;
/// let error = |k: usize, exact: f64| (stone.state().position[k] - exact).abs();
/// assert!(error(0, 1.0) < 1e-15 && error(1, 0.0) < 1e-15 && error(2, 2.0) < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct RungeKutta {
    tree: Tree,
    kinematics: Kinematics,
    equations: Equations,
    mass: Square,
    time: f64,
    state: BodyState,
    stage: BodyState,
    sum: BodyState,
    acceleration: Vec<f64>,
    zeros: Vec<f64>,
}

impl RungeKutta {
    /// The bodies at their start, at the time 0.
    ///
    /// # Errors
    /// Bodies without inertia, or a prescribed coordinate.
    pub fn new(tree: Tree) -> Result<Self, DynamicsError> {
        check_tree(&tree)?;
        if let Some(k) = tree.coordinates().iter().position(|coordinate| coordinate.prescribed) {
            return Err(DynamicsError::Explicit { coordinate: tree.label(k) });
        }
        let state = tree.start(0.0)?;
        let n = state.position.len();
        Ok(Self {
            kinematics: Kinematics::new(&tree),
            equations: Equations::new(&tree),
            mass: Square::zeros(n),
            time: 0.0,
            stage: state.clone(),
            sum: state.clone(),
            acceleration: vec![0.0; n],
            zeros: vec![0.0; n],
            state,
            tree,
        })
    }

    /// Goes on by `dt` in s, under loads that stay as they are.
    ///
    /// # Errors
    /// [`DynamicsError`]; the step is then not made.
    pub fn step(&mut self, dt: f64, loads: &[Load]) -> Result<(), DynamicsError> {
        check_step(self.time, dt)?;
        check_loads(&self.tree, self.time, loads)?;
        copy(&self.state, &mut self.stage);
        copy(&self.state, &mut self.sum);
        for (weight, reach) in [(1.0, 0.5), (2.0, 0.5), (2.0, 1.0), (1.0, 0.0)] {
            self.accelerate(loads)?;
            for k in 0..self.acceleration.len() {
                let (v, a) = (self.stage.velocity[k], self.acceleration[k]);
                self.sum.position[k] += weight * dt / 6.0 * v;
                self.sum.velocity[k] += weight * dt / 6.0 * a;
                self.stage.position[k] = self.state.position[k] + reach * dt * v;
                self.stage.velocity[k] = self.state.velocity[k] + reach * dt * a;
            }
        }
        std::mem::swap(&mut self.state, &mut self.sum);
        self.time += dt;
        Ok(())
    }

    /// The acceleration at the stage: `M a = −r(q, v, 0)`.
    fn accelerate(&mut self, loads: &[Load]) -> Result<(), DynamicsError> {
        self.kinematics.update(&self.stage.position, &self.stage.velocity, &self.zeros);
        self.equations.assemble(&self.kinematics, loads);
        self.mass.copy_from(self.equations.mass());
        for (acceleration, residual) in self.acceleration.iter_mut().zip(self.equations.residual())
        {
            *acceleration = -residual;
        }
        self.mass.solve(&mut self.acceleration).map_err(|k| DynamicsError::Singular {
            time: self.time,
            coordinate: self.tree.label(k),
        })
    }

    /// The time, in s.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Coordinates and velocities.
    pub fn state(&self) -> &BodyState {
        &self.state
    }
}

fn copy(from: &BodyState, to: &mut BodyState) {
    to.position.copy_from_slice(&from.position);
    to.velocity.copy_from_slice(&from.velocity);
}
