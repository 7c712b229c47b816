use super::{Flow, FlowError, FlowStep};

/// Newton's method takes over from Picard's when the velocity changes by less than this share of its largest value.
const NEWTON_FROM: f64 = 0.1;

/// When a steady flow counts as found.
///
/// ```
/// let limits = lumley_fom::flow::SteadyLimits::default();
/// assert!(limits.tolerance < 1e-8);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SteadyLimits {
    /// Largest change of the velocity in an iteration over its largest value.
    pub tolerance: f64,
    /// Most iterations.
    pub iterations: usize,
}

impl Default for SteadyLimits {
    /// A change of 1e-9 in at most 60 iterations.
    fn default() -> Self {
        Self { tolerance: 1e-9, iterations: 60 }
    }
}

/// How a steady flow was found.
///
/// ```
/// assert!(lumley_fom::flow::SteadyReport::default().changes.is_empty());
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SteadyReport {
    /// Largest change of the velocity over its largest value, iteration by iteration.
    pub changes: Vec<f64>,
    /// The work.
    pub work: FlowStep,
}

impl Flow {
    /// Replaces the flow by the steady one, iterating from the flow as it is: Picard's method until it is near, then
    /// Newton's. `observe` is called after each iteration with its number and the change.
    ///
    /// # Errors
    /// [`FlowError::NoConvergence`], and what a step says.
    pub fn settle(
        &mut self,
        limits: SteadyLimits,
        mut observe: impl FnMut(usize, f64),
    ) -> Result<SteadyReport, FlowError> {
        let time = self.time;
        self.set_given(time)?;
        self.rigid.hold(&mut self.given.velocity);
        self.set_force(time)?;
        self.work.base.copy_from_slice(&self.velocity[0]);
        self.work.new_pressure.copy_from_slice(&self.pressure[0]);
        self.hold_base();
        self.guess(&self.terms(0.0, false));
        let mut report = SteadyReport::default();
        let mut change = f64::INFINITY;
        while change > limits.tolerance {
            if report.changes.len() == limits.iterations {
                return Err(FlowError::NoConvergence {
                    time,
                    iterations: limits.iterations,
                    change,
                    wanted: limits.tolerance,
                    remedy: "start from the steady flow at a smaller Reynolds number, refine the mesh, or \
                             let the flow develop in time: it may have no stable steady state",
                });
            }
            let terms = self.terms(0.0, change < NEWTON_FROM);
            report.work.count(self.solve(&terms, time)?);
            change = self.change().share;
            report.changes.push(change);
            observe(report.changes.len(), change);
            self.work.base.copy_from_slice(&self.work.new_velocity);
        }
        self.take_steady();
        Ok(report)
    }

    /// The creeping flow: no inertia.
    pub(super) fn creep(&mut self) -> Result<(), FlowError> {
        self.set_given(self.time)?;
        self.rigid.hold(&mut self.given.velocity);
        self.set_force(self.time)?;
        // At rest nothing is carried.
        self.work.base.copy_from_slice(&self.mesh_velocity);
        let terms = self.terms(0.0, false);
        self.guess(&terms);
        self.solve(&terms, self.time)?;
        self.take_steady();
        Ok(())
    }

    fn take_steady(&mut self) {
        for past in &mut self.velocity {
            past.copy_from_slice(&self.work.new_velocity);
        }
        for past in &mut self.pressure {
            past.copy_from_slice(&self.work.new_pressure);
        }
        self.update_loads();
    }
}
