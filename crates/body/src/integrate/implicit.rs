use super::{DynamicsError, RateFormula, check_loads, check_step, check_tree};
use crate::{BodyState, Equations, Kinematics, Load, PrescribedError, Square, Tree};

/// A residual below this part of the sum of its terms' magnitudes is round-off.
const TOLERANCE: f64 = 1e-12;
const ITERATIONS: usize = 25;

/// The bodies of a tree without a fluid, by the implicit schemes of the flow.
///
/// At the new instant `r(q₊, v₊, v'₊) = 0` with `q'₊ = v₊`, both rates by one [`RateFormula`]; prescribed coordinates are
/// where their functions say, and their velocities are the rates of that. Newton's method with the complete tangent. A step
/// allocates nothing; one that fails leaves time, positions and velocities as they were.
///
/// ```
/// use lumley_body::{ImplicitScheme, RateFormula, RigidBody, Tree};
/// let block: RigidBody = toml::from_str(
///     "name = 'block'\nmass = 1\ncentre = [0, 0]
///      start = { position = [1] }
///      joint = { kind = 'prismatic', along = [1, 0], spring = { stiffness = 1 } }",
/// )?;
/// let mut block = ImplicitScheme::new(Tree::new(&[block], [0.0, 0.0])?, 0.0)?;
/// let euler = RateFormula { new: 10.0, now: -10.0, before: 0.0 };
/// block.step(0.1, euler, &[])?;
/// assert!((block.position()[0] - 1.0 / 1.01).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct ImplicitScheme {
    tree: Tree,
    kinematics: Kinematics,
    equations: Equations,
    tangent: Square,
    correction: Vec<f64>,
    acceleration: Vec<f64>,
    time: f64,
    new: BodyState,
    now: BodyState,
    before: BodyState,
}

impl ImplicitScheme {
    /// The bodies at their start, at a time in s.
    ///
    /// # Errors
    /// Bodies without inertia, or a prescribed coordinate that is not a number.
    pub fn new(tree: Tree, time: f64) -> Result<Self, DynamicsError> {
        check_tree(&tree)?;
        Ok(Self::in_fluid(tree, time)?)
    }

    /// The bodies at their start, at a time in s, for who solves the equations together with those of a fluid, whose
    /// inertia massless bodies may have: by [`predict`](Self::predict), [`propose`](Self::propose) and
    /// [`accept`](Self::accept). [`solve`](Self::solve) may find massless ones singular.
    ///
    /// # Errors
    /// A prescribed coordinate that is not a number.
    pub fn in_fluid(tree: Tree, time: f64) -> Result<Self, PrescribedError> {
        let start = tree.start(time)?;
        let n = start.position.len();
        let mut scheme = Self {
            kinematics: Kinematics::new(&tree),
            equations: Equations::new(&tree),
            tangent: Square::zeros(n),
            correction: vec![0.0; n],
            acceleration: vec![0.0; n],
            time,
            new: start.clone(),
            before: start.clone(),
            now: start,
            tree,
        };
        scheme.kinematics.update(&scheme.now.position, &scheme.now.velocity, &scheme.acceleration);
        Ok(scheme)
    }

    /// Goes on by `dt` in s, with the weights of the scheme for this step, under loads that are those of the new
    /// instant. The number of Newton iterations.
    ///
    /// # Errors
    /// [`DynamicsError`]; the step is then not made.
    pub fn step(
        &mut self,
        dt: f64,
        formula: RateFormula,
        loads: &[Load],
    ) -> Result<usize, DynamicsError> {
        let iterations = self.solve(dt, formula, loads)?;
        self.accept(dt);
        Ok(iterations)
    }

    /// The [`trial`](Self::trial) of such a step, which [`accept`](Self::accept) makes the state, or another trial
    /// replaces.
    ///
    /// # Errors
    /// [`DynamicsError`].
    pub fn solve(
        &mut self,
        dt: f64,
        formula: RateFormula,
        loads: &[Load],
    ) -> Result<usize, DynamicsError> {
        check_step(self.time, dt)?;
        check_loads(&self.tree, self.time, loads)?;
        self.start_trial(dt, 0.0)?;
        for iterations in 0..=ITERATIONS {
            self.assemble(formula, loads);
            if self.worst(formula).is_none() {
                return Ok(iterations);
            }
            self.correct(formula)?;
        }
        Err(self.no_convergence(formula))
    }

    /// A [`trial`](Self::trial) after `dt` in s with extrapolated velocities, `v + ahead (v − v₋)`, and the equations
    /// there without loads.
    ///
    /// # Errors
    /// A prescribed coordinate that is not a number.
    pub fn predict(
        &mut self,
        dt: f64,
        formula: RateFormula,
        ahead: f64,
    ) -> Result<(), PrescribedError> {
        self.start_trial(dt, ahead)?;
        self.assemble(formula, &[]);
        Ok(())
    }

    /// Gives the [`trial`](Self::trial) these velocities, but for prescribed ones, with the positions that follow, and
    /// the equations there without loads.
    ///
    /// # Panics
    /// If there is not one velocity for each coordinate.
    pub fn propose(&mut self, formula: RateFormula, velocity: &[f64]) {
        self.new.velocity.copy_from_slice(velocity);
        self.assemble(formula, &[]);
    }

    /// The trial becomes the state, `dt` in s later.
    pub fn accept(&mut self, dt: f64) {
        std::mem::swap(&mut self.before, &mut self.now);
        std::mem::swap(&mut self.now, &mut self.new);
        self.time += dt;
    }

    /// Coordinates and velocities that were found last, by [`solve`](Self::solve), [`predict`](Self::predict) or
    /// [`propose`](Self::propose).
    pub fn trial(&self) -> &BodyState {
        &self.new
    }

    /// Goes back to what [`state`](Self::state) and [`time`](Self::time) were.
    ///
    /// # Panics
    /// If a state has not one number for each coordinate.
    pub fn restore(&mut self, time: f64, [now, before]: [&BodyState; 2]) {
        for (own, given) in [(&mut self.now, now), (&mut self.before, before)] {
            own.position.copy_from_slice(&given.position);
            own.velocity.copy_from_slice(&given.velocity);
        }
        self.time = time;
        self.acceleration.fill(0.0);
        self.kinematics.update(&self.now.position, &self.now.velocity, &self.acceleration);
    }

    fn start_trial(&mut self, dt: f64, ahead: f64) -> Result<(), PrescribedError> {
        self.tree.prescribe(self.time + dt, &mut self.new.position)?;
        let past = self.now.velocity.iter().zip(&self.before.velocity);
        for (new, (now, before)) in self.new.velocity.iter_mut().zip(past) {
            *new = now + ahead * (now - before);
        }
        Ok(())
    }

    /// The equations for the new velocities, or the new positions where they are prescribed.
    fn assemble(&mut self, formula: RateFormula, loads: &[Load]) {
        for (k, coordinate) in self.tree.coordinates().iter().enumerate() {
            let known = formula.known(self.now.position[k], self.before.position[k]);
            if coordinate.prescribed {
                self.new.velocity[k] = formula.new * self.new.position[k] + known;
            } else {
                self.new.position[k] = (self.new.velocity[k] - known) / formula.new;
            }
            let [new, now, before] = self.velocities(k);
            self.acceleration[k] = formula.rate(new, now, before);
        }
        self.kinematics.update(&self.new.position, &self.new.velocity, &self.acceleration);
        self.equations.assemble(&self.kinematics, loads);
    }

    fn velocities(&self, k: usize) -> [f64; 3] {
        [&self.new, &self.now, &self.before].map(|state| state.velocity[k])
    }

    /// The free coordinate whose residual is largest against its round-off, where that is not met: with both.
    fn worst(&self, formula: RateFormula) -> Option<(usize, f64, f64)> {
        let at = |k: usize| (k, self.equations.residual()[k].abs(), self.tolerance(k, formula));
        let coordinates = self.tree.coordinates().iter().enumerate();
        let free = coordinates.filter(|(_, coordinate)| !coordinate.prescribed).map(|(k, _)| at(k));
        let missed =
            free.filter(|(_, residual, tolerance)| residual.is_nan() || residual > tolerance);
        missed.max_by(|a, b| (a.1 / a.2).total_cmp(&(b.1 / b.2)))
    }

    fn tolerance(&self, row: usize, formula: RateFormula) -> f64 {
        let weights = [formula.new, formula.now, formula.before];
        let magnitude = |(k, mass): (usize, &f64)| {
            let terms = weights.into_iter().zip(self.velocities(k));
            mass.abs() * terms.map(|(weight, v)| (weight * v).abs()).sum::<f64>()
        };
        let inertia: f64 = self.equations.mass().row(row).iter().enumerate().map(magnitude).sum();
        TOLERANCE * (inertia + self.equations.magnitude()[row])
    }

    fn correct(&mut self, formula: RateFormula) -> Result<(), DynamicsError> {
        self.equations.tangent(formula.new, &mut self.tangent);
        for (k, coordinate) in self.tree.coordinates().iter().enumerate() {
            let known = coordinate.prescribed;
            self.correction[k] = if known { 0.0 } else { self.equations.residual()[k] };
        }
        self.tangent.solve(&mut self.correction).map_err(|k| DynamicsError::Singular {
            time: self.time,
            coordinate: self.tree.label(k),
        })?;
        for (velocity, correction) in self.new.velocity.iter_mut().zip(&self.correction) {
            *velocity -= correction;
        }
        Ok(())
    }

    fn no_convergence(&self, formula: RateFormula) -> DynamicsError {
        let (k, residual, tolerance) = self.worst(formula).expect("a residual that is too large");
        DynamicsError::NoConvergence {
            time: self.time,
            iterations: ITERATIONS,
            coordinate: self.tree.label(k),
            residual,
            tolerance,
        }
    }

    /// The bodies.
    pub fn tree(&self) -> &Tree {
        &self.tree
    }

    /// The time, in s.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// The coordinates, in m or rad.
    pub fn position(&self) -> &[f64] {
        &self.now.position
    }

    /// The velocities, in m/s or rad/s.
    pub fn velocity(&self) -> &[f64] {
        &self.now.velocity
    }

    /// Coordinates and velocities now and a step before: what the scheme goes on from.
    pub fn state(&self) -> [&BodyState; 2] {
        [&self.now, &self.before]
    }

    /// Where the bodies are and how they move, in the last trial or, once that is accepted, now.
    pub fn kinematics(&self) -> &Kinematics {
        &self.kinematics
    }

    /// The equations at the same instant.
    ///
    /// Residuals of prescribed coordinates are the loads that the prescription takes.
    pub fn equations(&self) -> &Equations {
        &self.equations
    }
}
