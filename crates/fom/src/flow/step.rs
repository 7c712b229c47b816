use super::cells::Terms;
use super::solve::Change;
use super::{Flow, FlowError, Linearisation};
use crate::coupling::Coupling;
use crate::linear::LaggedStep;
use crate::time_scheme::RateFormula;

/// Newton's method stops when the velocity changes by less than this share of its largest value.
const NEWTON_TOLERANCE: f64 = 1e-9;
/// Most linear systems in a step.
const MOST_SYSTEMS: usize = 20;
/// How far a body may be, over its radius, from where it was foreseen: less than the error of a step that follows its
/// motion.
const PLACE_TOLERANCE: f64 = 1e-3;

/// How a step went.
///
/// ```
/// assert_eq!(lumley_fom::flow::FlowStep::default().iterations, 0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FlowStep {
    /// Iterations of GMRES, of all linear systems.
    pub iterations: usize,
    /// Linear systems: one, or the iterations of Newton's method, or those until bodies are where the mesh has them.
    pub systems: usize,
    /// Factorisations that were renewed.
    pub renewals: usize,
    /// How far the new velocity is from the extrapolated one, over the largest velocity: what an adaptive step
    /// keeps small.
    pub extrapolation_error: f64,
    /// The largest velocity, in m/s.
    pub largest_velocity: f64,
}

impl FlowStep {
    pub(super) fn count(&mut self, solved: LaggedStep) {
        self.iterations += solved.iterations;
        self.systems += 1;
        self.renewals += usize::from(solved.renewed);
    }
}

impl Flow {
    /// One step of `dt`, in s.
    ///
    /// # Errors
    /// [`FlowError`]: the mesh is then half-moved, but [`save`](Self::save) still writes the flow of the step before.
    pub fn step(&mut self, dt: f64) -> Result<FlowStep, FlowError> {
        let step = self.compute(dt)?;
        let time = self.time + dt;
        if self.parameters.linearisation != Linearisation::Newton {
            let (error, largest) = (step.extrapolation_error, step.largest_velocity);
            let watched = self.stability.watch(time, error, largest);
            watched.map_err(|error| self.explain(error))?;
        }
        self.accept(time, dt);
        Ok(step)
    }

    /// Computes the flow after a step of `dt`, in s, into `work`.
    pub(super) fn compute(&mut self, dt: f64) -> Result<FlowStep, FlowError> {
        if !(dt.is_finite() && dt > 0.0) {
            return Err(FlowError::Step { dt });
        }
        let time = self.time + dt;
        let formula = self.parameters.scheme.damping_formula(dt, self.previous);
        let ahead = match self.previous {
            Some(previous) if formula.before != 0.0 => dt / previous,
            _ => 0.0,
        };
        if let Some(bodies) = &mut self.bodies {
            let foreseen = bodies.foresee(dt, formula, ahead, &self.loads);
            foreseen.map_err(|error| self.explain(error))?;
        }
        self.extrapolate(ahead);
        self.solve_step(time, formula).map_err(|error| self.explain(error))
    }

    /// Tells an error that explicit coupling makes from one that a smaller step would mend.
    pub(super) fn explain(&self, source: FlowError) -> FlowError {
        match self.added_mass_share().filter(|share| *share > 0.5 * Coupling::EXPLICIT_LIMIT) {
            Some(share) => FlowError::AddedMass { share, source: Box::new(source) },
            None => source,
        }
    }

    /// Prepares the equations at `time`, where the mesh is then, linearised about `work.base`.
    fn prepare(&mut self, terms: &Terms, time: f64, formula: RateFormula) -> Result<(), FlowError> {
        self.move_mesh(time, formula)?;
        self.set_given(time)?;
        self.give_bodies();
        self.set_force(time)?;
        self.subtract_history(formula);
        self.hold_base();
        self.guess(terms);
        Ok(())
    }

    /// Moves the mesh to `time`; its velocity is the difference formula of its places, so that the scheme keeps a
    /// uniform flow.
    fn move_mesh(&mut self, time: f64, formula: RateFormula) -> Result<(), FlowError> {
        match (&mut self.motion, &mut self.bodies) {
            (Some(motion), _) => motion.carry(time, &mut self.mesh)?,
            (None, Some(bodies)) => bodies.carry(time, &mut self.mesh)?,
            (None, None) => return Ok(()),
        }
        let work = &mut self.work;
        let past = self.nodes[0].iter().zip(&self.nodes[1]);
        let moves = work.node_velocity.iter_mut().zip(self.mesh.nodes()).zip(past);
        for ((velocity, new), (now, before)) in moves {
            // As differences, so that a node which stays has no velocity at all.
            *velocity = [0, 1]
                .map(|d| formula.new * (new[d] - now[d]) + formula.before * (before[d] - now[d]));
        }
        self.places.spread(&work.node_velocity, &mut self.mesh_velocity);
        self.places.spread(self.mesh.nodes(), &mut work.dof_points);
        self.follow_slides();
        self.show_pivots();
        Ok(())
    }

    /// Takes the known part of the rate off the source.
    fn subtract_history(&mut self, formula: RateFormula) {
        let past = self.velocity[0].iter().zip(&self.velocity[1]);
        for (source, (now, before)) in self.work.source.iter_mut().zip(past) {
            for d in 0..2 {
                source[d] -= formula.now * now[d] + formula.before * before[d];
            }
        }
    }

    /// Extrapolates velocity and pressure to the end of a step, their last change times `ratio` further: linearly with
    /// BDF2, else as they are, the paper's.
    fn extrapolate(&mut self, ratio: f64) {
        let ahead = |now: f64, before: f64| now + ratio * (now - before);
        let past = self.velocity[0].iter().zip(&self.velocity[1]);
        for (base, (now, before)) in self.work.base.iter_mut().zip(past) {
            *base = [0, 1].map(|d| ahead(now[d], before[d]));
        }
        let past = self.pressure[0].iter().zip(&self.pressure[1]);
        for (new, (now, before)) in self.work.new_pressure.iter_mut().zip(past) {
            new[0] = ahead(now[0], before[0]);
        }
    }

    /// Solves the equations at `time`: once, and again where Newton's method wants it, or where bodies are not where
    /// they were foreseen.
    fn solve_step(&mut self, time: f64, formula: RateFormula) -> Result<FlowStep, FlowError> {
        let mut step = FlowStep::default();
        let linearisation = self.parameters.linearisation;
        let newton = linearisation == Linearisation::Newton;
        let terms = self.terms(formula.new, linearisation != Linearisation::Extrapolation);
        self.prepare(&terms, time, formula)?;
        loop {
            step.count(self.solve(&terms, time)?);
            let Change { share: change, largest } = self.change();
            step.largest_velocity = largest;
            if step.systems == 1 {
                step.extrapolation_error = change;
            }
            let apart = self.correct_bodies(formula);
            let wanted = if newton { NEWTON_TOLERANCE } else { PLACE_TOLERANCE };
            if apart <= wanted && !(newton && change > NEWTON_TOLERANCE) {
                return Ok(step);
            }
            if step.systems == MOST_SYSTEMS {
                return Err(not_converged(time, step.systems, change, (apart, wanted)));
            }
            self.work.base.copy_from_slice(&self.work.new_velocity);
            if apart > 0.0 {
                self.prepare(&terms, time, formula)?;
            }
        }
    }

    /// Gives the bodies the velocities that were found; how far they are then from where the mesh has them, over their
    /// radius.
    fn correct_bodies(&mut self, formula: RateFormula) -> f64 {
        let Self { bodies, rigid, work, .. } = self;
        let Some(bodies) = bodies.as_mut().filter(|_| rigid.count() > 0) else { return 0.0 };
        work.body_velocity.copy_from_slice(&bodies.scheme().trial().velocity);
        rigid.correct(&work.solution, &mut work.body_velocity);
        bodies.propose(formula, &work.body_velocity)
    }

    /// The new flow is the flow.
    pub(super) fn accept(&mut self, time: f64, dt: f64) {
        self.velocity.swap(0, 1);
        self.velocity[0].copy_from_slice(&self.work.new_velocity);
        self.pressure.swap(0, 1);
        self.pressure[0].copy_from_slice(&self.work.new_pressure);
        if self.moves() {
            self.nodes.swap(0, 1);
            self.nodes[0].copy_from_slice(self.mesh.nodes());
        }
        (self.time, self.previous) = (time, Some(dt));
        self.steps += 1;
        self.update_loads();
        if let Some(bodies) = &mut self.bodies {
            bodies.accept(dt);
        }
        self.show_bodies();
    }

    /// The mesh is where the bodies were found, which is next to where they were foreseen.
    pub(super) fn show_bodies(&mut self) {
        let Some(bodies) = &mut self.bodies else { return };
        bodies.show(&mut self.mesh);
        self.places.spread(self.mesh.nodes(), &mut self.work.dof_points);
        self.show_pivots();
    }

    /// The pivots of the boundaries that move are where their motion puts them.
    pub(super) fn show_pivots(&mut self) {
        for (k, &boundary) in self.moving.iter().enumerate() {
            self.pivots[boundary] = match (&self.motion, &self.bodies) {
                (Some(motion), _) => motion.pivot(k),
                (None, Some(bodies)) => bodies.pivot(k),
                (None, None) => unreachable!("nothing moves by itself"),
            };
        }
    }
}

/// A step that took too many systems: because of the bodies, or the flow.
fn not_converged(time: f64, iterations: usize, change: f64, apart: (f64, f64)) -> FlowError {
    let (apart, wanted) = apart;
    if apart > wanted {
        return FlowError::NotPlaced { time, iterations, apart, wanted };
    }
    let wanted = NEWTON_TOLERANCE;
    FlowError::NoConvergence { time, iterations, change, wanted, remedy: "take a smaller step" }
}
