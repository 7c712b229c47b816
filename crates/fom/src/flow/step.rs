use super::solve::Change;
use super::{Flow, FlowError, Linearisation};
use crate::linear::LaggedStep;
use crate::time_scheme::RateFormula;

/// Newton's method stops when the velocity changes by less than this share of its largest value.
const NEWTON_TOLERANCE: f64 = 1e-9;
/// Most iterations of Newton's method in a step.
const NEWTON_ITERATIONS: usize = 20;

/// How a step went.
///
/// ```
/// assert_eq!(lumley_fom::flow::FlowStep::default().iterations, 0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FlowStep {
    /// Iterations of GMRES, of all linear systems.
    pub iterations: usize,
    /// Linear systems: one, or the iterations of Newton's method.
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
            self.stability.watch(time, step.extrapolation_error, step.largest_velocity)?;
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
        self.move_mesh(time, formula)?;
        self.set_given(time)?;
        self.set_force(time)?;
        self.subtract_history(formula);
        self.extrapolate(dt, formula);
        self.guess();
        self.solve_step(time, formula)
    }

    /// Moves the mesh to `time`; its velocity is the difference formula of its places, so that the scheme keeps a
    /// uniform flow.
    fn move_mesh(&mut self, time: f64, formula: RateFormula) -> Result<(), FlowError> {
        let Some(motion) = &mut self.motion else { return Ok(()) };
        motion.carry(time, &mut self.mesh)?;
        let work = &mut self.work;
        let past = self.nodes[0].iter().zip(&self.nodes[1]);
        let moves = work.node_velocity.iter_mut().zip(self.mesh.nodes()).zip(past);
        for ((velocity, new), (now, before)) in moves {
            *velocity = [0, 1]
                .map(|d| formula.new * new[d] + formula.now * now[d] + formula.before * before[d]);
        }
        self.places.spread(&work.node_velocity, &mut self.mesh_velocity);
        self.places.spread(self.mesh.nodes(), &mut work.dof_points);
        self.slides.follow(&self.mesh);
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

    /// Extrapolates velocity and pressure to the end of a step: linearly with BDF2, else as they are, the paper's.
    fn extrapolate(&mut self, dt: f64, formula: RateFormula) {
        let ratio = match self.previous {
            Some(previous) if formula.before != 0.0 => dt / previous,
            _ => 0.0,
        };
        let ahead = |now: f64, before: f64| now + ratio * (now - before);
        let past = self.velocity[0].iter().zip(&self.velocity[1]);
        for (base, (now, before)) in self.work.base.iter_mut().zip(past) {
            *base = [0, 1].map(|d| ahead(now[d], before[d]));
        }
        let past = self.pressure[0].iter().zip(&self.pressure[1]);
        for (new, (now, before)) in self.work.new_pressure.iter_mut().zip(past) {
            new[0] = ahead(now[0], before[0]);
        }
        self.hold_base();
    }

    fn solve_step(&mut self, time: f64, formula: RateFormula) -> Result<FlowStep, FlowError> {
        let mut step = FlowStep::default();
        let linearisation = self.parameters.linearisation;
        let terms = self.terms(formula.new, linearisation != Linearisation::Extrapolation);
        step.count(self.solve(&terms, time)?);
        let Change { share: mut change, largest } = self.change();
        (step.extrapolation_error, step.largest_velocity) = (change, largest);
        while linearisation == Linearisation::Newton && change > NEWTON_TOLERANCE {
            if step.systems == NEWTON_ITERATIONS {
                return Err(FlowError::NoConvergence {
                    time,
                    iterations: step.systems,
                    change,
                    wanted: NEWTON_TOLERANCE,
                    remedy: "take a smaller step",
                });
            }
            self.work.base.copy_from_slice(&self.work.new_velocity);
            step.count(self.solve(&terms, time)?);
            Change { share: change, largest: step.largest_velocity } = self.change();
        }
        Ok(step)
    }

    /// The new flow is the flow.
    pub(super) fn accept(&mut self, time: f64, dt: f64) {
        self.velocity.swap(0, 1);
        self.velocity[0].copy_from_slice(&self.work.new_velocity);
        self.pressure.swap(0, 1);
        self.pressure[0].copy_from_slice(&self.work.new_pressure);
        if self.motion.is_some() {
            self.nodes.swap(0, 1);
            self.nodes[0].copy_from_slice(self.mesh.nodes());
        }
        self.show_pivots();
        (self.time, self.previous) = (time, Some(dt));
        self.steps += 1;
        self.update_loads();
    }

    /// The pivots of the boundaries that move are where their motion puts them.
    pub(super) fn show_pivots(&mut self) {
        let Some(motion) = &self.motion else { return };
        for (k, &boundary) in self.moving.iter().enumerate() {
            self.pivots[boundary] = motion.pivot(k);
        }
    }
}
