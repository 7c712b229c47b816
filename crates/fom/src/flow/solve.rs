use super::cells::{NodalFields, Terms};
use super::unknowns::NodeUnknowns;
use super::{Flow, FlowError, ViscousForm};
use crate::linear::LaggedStep;

impl Flow {
    /// The terms of the equations with this weight of the new velocity in its rate, per s.
    pub(super) fn terms(&self, rate: f64, newton: bool) -> Terms {
        Terms {
            density: self.parameters.density,
            viscosity: self.parameters.viscosity,
            rate,
            stress: self.parameters.viscous_form == ViscousForm::Stress,
            newton,
            divergence: 0.0,
        }
    }

    /// Sets what boundaries give at `time`.
    pub(super) fn set_given(&mut self, time: f64) -> Result<(), FlowError> {
        let Self { given, mesh, places, conditions, mesh_velocity, .. } = self;
        given.update(mesh, places, conditions, mesh_velocity, time)
    }

    /// Sets the body force at `time` as the source.
    pub(super) fn set_force(&mut self, time: f64) -> Result<(), FlowError> {
        let Some(force) = &self.parameters.body_force else {
            self.work.source.fill([0.0; 2]);
            return Ok(());
        };
        for (source, &place) in self.work.source.iter_mut().zip(&self.work.dof_points) {
            *source = force.value(place, time);
            if !source.iter().all(|f| f.is_finite()) {
                let what = "the body force".into();
                return Err(FlowError::NotFinite { what, place, time, value: *source });
            }
        }
        Ok(())
    }

    /// Puts the given velocities into `work.base`, where they are known better than by extrapolation.
    pub(super) fn hold_base(&mut self) {
        for (dof, node) in self.unknowns.nodes.iter().enumerate() {
            if matches!(node, NodeUnknowns::Held(_) | NodeUnknowns::Rigid { .. }) {
                self.work.base[dof] = self.given.velocity[dof];
            }
        }
    }

    /// Finds the directions along which dofs on slip boundaries move, where the mesh is now.
    pub(super) fn follow_slides(&mut self) {
        self.slides.follow(&self.mesh, &mut self.work.directions[..self.slides.count()]);
    }

    /// What bodies give to the velocities of their boundaries: those of the trial.
    pub(super) fn give_bodies(&mut self) {
        if let Some(bodies) = &self.bodies {
            self.rigid.give(bodies.scheme(), &mut self.given.velocity);
        }
    }

    /// Linearises the equations of the bodies, and starts the linear solver from `work.base` and `work.new_pressure`.
    pub(super) fn guess(&mut self, terms: &Terms) {
        let Self { unknowns, slides, rigid, bodies, work, .. } = self;
        if let Some(bodies) = bodies {
            rigid.linearise(bodies.scheme(), terms, &mut work.directions[slides.count()..]);
            work.solution[..rigid.count()].fill(0.0);
        }
        for (&node, velocity) in unknowns.nodes.iter().zip(&work.base) {
            match node {
                NodeUnknowns::Free(k) => work.solution[k..k + 2].copy_from_slice(velocity),
                NodeUnknowns::Slides(slide, k) => {
                    let tangent = work.directions[slide];
                    work.solution[k] = tangent[0] * velocity[0] + tangent[1] * velocity[1];
                }
                NodeUnknowns::Rigid { .. } | NodeUnknowns::Held(_) => {}
            }
        }
        // A pressure that is known up to a constant is zero in the last cell.
        let level =
            if unknowns.pinned() { work.new_pressure.last().map_or(0.0, |p| p[0]) } else { 0.0 };
        for (&unknown, pressure) in unknowns.pressures.iter().zip(&work.new_pressure) {
            if let Some(k) = unknown {
                work.solution[k] = pressure[0] - level;
            }
        }
    }

    /// Solves the equations with `work.source`, linearised about `work.base`: the new velocity and pressure are
    /// in `work`.
    pub(super) fn solve(&mut self, terms: &Terms, time: f64) -> Result<LaggedStep, FlowError> {
        let mut terms = *terms;
        if self.unknowns.pinned() {
            terms.divergence = self.given.divergence(&self.mesh, time)?;
        }
        let Self { system, space, pattern, rigid, given, work, .. } = self;
        let wind = work.wind.iter_mut().zip(&work.base).zip(&self.mesh_velocity);
        wind.for_each(|((wind, u), w)| *wind = [0, 1].map(|d| u[d] - w[d]));
        let fields = NodalFields {
            nodes: self.mesh.nodes(),
            wind: &work.wind,
            source: &work.source,
            base: &work.base,
        };
        let directions = &work.directions;
        system.assemble(&terms, &fields, directions, self.parallel);
        system.right_side(space, pattern, directions, &given.velocity, &mut work.right);
        let cells = system.order().len();
        rigid.add(pattern, cells, &mut system.matrices, &mut work.right);
        let solved = self.solver.solve(&system.matrices, &work.right, &mut work.solution);
        let solved = solved.map_err(|source| {
            if source.is_finite() {
                FlowError::Linear { time, source }
            } else {
                FlowError::Diverged { time }
            }
        })?;
        self.distribute(time)?;
        Ok(solved)
    }

    /// Takes the solution of the linear system to the velocity and the pressure.
    fn distribute(&mut self, time: f64) -> Result<(), FlowError> {
        let Self { unknowns, rigid, given, work, .. } = self;
        let x = &work.solution;
        if !x.iter().all(|x| x.is_finite()) {
            return Err(FlowError::Diverged { time });
        }
        for (dof, &node) in unknowns.nodes.iter().enumerate() {
            work.new_velocity[dof] = match node {
                NodeUnknowns::Free(k) => [x[k], x[k + 1]],
                NodeUnknowns::Slides(slide, k) => work.directions[slide].map(|t| t * x[k]),
                NodeUnknowns::Rigid { body, first } => {
                    rigid.columns(body).fold(given.velocity[dof], |[u, v], (k, direction)| {
                        let [a, b] = work.directions[first + direction];
                        [u + a * x[k], v + b * x[k]]
                    })
                }
                NodeUnknowns::Held(_) => given.velocity[dof],
            };
        }
        for (pressure, unknown) in work.new_pressure.iter_mut().zip(&unknowns.pressures) {
            pressure[0] = unknown.map_or(0.0, |k| x[k]);
        }
        self.system.recover(&self.space, &mut work.new_velocity, &mut work.new_pressure);
        if unknowns.pinned() {
            self.level_pressure();
        }
        Ok(())
    }

    /// Makes the mean of a pressure zero that is known up to a constant.
    fn level_pressure(&mut self) {
        let (mut total, mut level) = (0.0, 0.0);
        for (cell, pressure) in self.work.new_pressure.iter().enumerate() {
            let area = self.cell_area(cell);
            total += area;
            level += area * pressure[0];
        }
        self.work.new_pressure.iter_mut().for_each(|p| p[0] -= level / total);
    }

    /// How far the new velocity is from `work.base`.
    pub(super) fn change(&self) -> Change {
        let work = &self.work;
        let pairs = work.new_velocity.iter().zip(&work.base);
        let change = pairs.map(|(u, v)| (u[0] - v[0]).hypot(u[1] - v[1])).fold(0.0, f64::max);
        let largest = work.new_velocity.iter().map(|u| u[0].hypot(u[1])).fold(0.0, f64::max);
        let share = if change > 0.0 { change / largest.max(f64::MIN_POSITIVE) } else { 0.0 };
        Change { share, largest }
    }
}

/// A change of the velocity.
pub(super) struct Change {
    /// The largest one over the largest velocity.
    pub share: f64,
    /// The largest velocity, in m/s.
    pub largest: f64,
}
