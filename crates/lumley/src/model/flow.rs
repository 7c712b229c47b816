use super::view::View;
use super::{Frame, Model, StepError, StepReport};
use lumley_body::{BodyState, ImplicitScheme};
use lumley_fem::UniformGrid;
use lumley_fem::transfer::{Bodies, Coverage, PlanarTransfer, Transfer, TransferError};
use lumley_fom::flow::{Flow, FlowError, FlowStep, StepControl};
use lumley_fom::motion::RigidVelocity;
use std::cell::RefCell;
use std::io::{self, Read, Write};

/// A flow in the plane as a model: with its steps, and with the fixed grids on which it is recorded.
///
/// ```
/// use lumley::case::Case;
/// use lumley::model::Model;
/// let text = lumley::cases::find("cylinder-2d2").expect("a case of lumley's own").text;
/// let Case::Flow(case) = Case::parse("cylinder-2d2/case.toml".as_ref(), text, true, &[])? else {
///     panic!("it has a [flow]");
/// };
/// let mut model = lumley::run::planar_flow(&case, 1)?;
/// model.step(0.01)?;
/// assert_eq!(model.time(), 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct FlowModel {
    flow: Flow,
    stepping: Stepping,
    last: FlowStep,
    solids: Vec<Solid>,
    states: Vec<BodyState>,
    views: RefCell<Vec<View>>,
}

/// How long the steps of a flow are.
///
/// ```
/// use lumley::model::Stepping;
/// let stepping = Stepping::Fixed { step: 0.01 };
/// assert_eq!(stepping, Stepping::Fixed { step: 1e-2 });
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stepping {
    /// All the same.
    Fixed {
        /// In s.
        step: f64,
    },
    /// As the error wants it.
    Adaptive {
        /// The first, in s.
        first: f64,
        /// How the others follow.
        control: StepControl,
    },
}

/// A body in the flow, by the dofs on its boundary.
struct Solid {
    name: String,
    dofs: Vec<usize>,
    /// Its number among the bodies that move.
    moving: Option<usize>,
}

impl FlowModel {
    /// The model with these steps, recorded in no frame yet.
    pub fn new(mut flow: Flow, stepping: Stepping) -> Self {
        let (mesh, space) = (flow.mesh(), flow.space());
        let is_body = |name: &str| Bodies::new(mesh, &[name]).is_ok();
        let moving = |name: &String| {
            let mut bodies = flow.bodies()?.tree().bodies().iter();
            bodies.position(|body| body.boundary.as_ref() == Some(name))
        };
        let boundaries = mesh.topology().boundaries().iter();
        let solids = boundaries.filter(|boundary| is_body(&boundary.name)).map(|boundary| Solid {
            name: boundary.name.clone(),
            dofs: space.dofs().on_boundary(mesh.topology(), boundary),
            moving: moving(&boundary.name),
        });
        let solids = solids.collect();
        let states = flow.bodies().map_or(Vec::new(), states);
        let views = RefCell::new(Vec::new());
        if let Stepping::Adaptive { first, .. } = stepping {
            flow.suggest_step(first);
        }
        let last = FlowStep::default();
        Self { flow, stepping, last, solids, states, views }
    }

    /// Makes the frame on `grid` known: [`Frame::Fixed`], or for a picture [`Frame::Picture`].
    ///
    /// # Errors
    /// Parameters of the transfer that are out of range.
    ///
    /// # Panics
    /// If the grid is one of an interval.
    pub fn add_grid(
        &mut self,
        grid: UniformGrid,
        method: Transfer,
        picture: bool,
    ) -> Result<Coverage, TransferError> {
        let mut transfer = PlanarTransfer::new(method, grid, self.solids())?;
        let coverage = transfer.update(self.flow.mesh());
        self.views.get_mut().push(View::new(transfer, picture.then_some(self.flow.space())));
        Ok(coverage)
    }

    /// The flow.
    pub fn flow(&self) -> &Flow {
        &self.flow
    }

    /// The flow, to be changed.
    pub fn flow_mut(&mut self) -> &mut Flow {
        &mut self.flow
    }

    /// What the last step was like.
    pub fn last_step(&self) -> &FlowStep {
        &self.last
    }

    /// Cells that fluid crossed in the last step, at most: the Courant number.
    pub fn courant_number(&self) -> f64 {
        self.flow.courant_number(self.flow.last_step().unwrap_or(0.0))
    }

    /// Names of the boundaries that go round a body.
    pub fn bodies_in_it(&self) -> impl Iterator<Item = &str> {
        self.solids.iter().map(|solid| solid.name.as_str())
    }

    /// The bodies in the flow, in that order.
    pub(crate) fn solids(&self) -> Bodies {
        let names: Vec<&str> = self.bodies_in_it().collect();
        Bodies::new(self.flow.mesh(), &names).expect("each of them is a body")
    }

    /// The velocities that they have, and the fluid at their boundaries.
    pub(crate) fn solid_velocities(&self) -> Vec<RigidVelocity> {
        self.solids.iter().map(|solid| self.velocity_of(solid)).collect()
    }

    /// Makes a step of the flow and adds it to the report.
    fn count(
        &mut self,
        report: &mut StepReport,
        step: impl FnOnce(&mut Flow) -> Result<FlowStep, FlowError>,
    ) -> Result<(), FlowError> {
        self.last = step(&mut self.flow)?;
        report.iterations += self.last.iterations;
        report.renewals += self.last.renewals;
        Ok(())
    }

    /// That of a body which moves as the flow's bodies do is known; any other follows from its boundary's.
    fn velocity_of(&self, solid: &Solid) -> RigidVelocity {
        if let (Some(body), Some(bodies)) = (solid.moving, self.flow.bodies()) {
            let (kinematics, given) = (bodies.kinematics(), &bodies.tree().bodies()[body]);
            return RigidVelocity {
                centre: kinematics.centre(body),
                velocity: kinematics.velocity(body, given.centre),
                rate: kinematics.spin(body),
            };
        }
        let (points, velocities) = (self.flow.dof_points(), self.flow.mesh_velocity());
        RigidVelocity::fit(solid.dofs.iter().map(|&dof| (points[dof], velocities[dof])))
    }
}

/// The coordinates of each body's joint.
fn states(bodies: &ImplicitScheme) -> Vec<BodyState> {
    let tree = bodies.tree();
    let mut states = vec![BodyState::default(); tree.bodies().len()];
    for (k, coordinate) in tree.coordinates().iter().enumerate() {
        let state = &mut states[coordinate.body];
        state.position.push(bodies.position()[k]);
        state.velocity.push(bodies.velocity()[k]);
    }
    states
}

impl Model for FlowModel {
    fn time(&self) -> f64 {
        match self.stepping {
            // Without the round-off of summed steps.
            Stepping::Fixed { step } => self.flow.steps() as f64 * step,
            Stepping::Adaptive { .. } => self.flow.time(),
        }
    }

    fn step(&mut self, dt: f64) -> Result<StepReport, StepError> {
        let mut report = StepReport::default();
        match self.stepping {
            Stepping::Fixed { .. } => self.count(&mut report, |flow| flow.step(dt))?,
            // What the error refuses is made in shorter steps.
            Stepping::Adaptive { control, .. } => {
                let end = self.flow.time() + dt;
                while self.flow.time() < end - 1e-9 * dt {
                    self.count(&mut report, |flow| flow.step_towards(end, &control))?;
                }
            }
        }
        self.states = self.flow.bodies().map_or(Vec::new(), states);
        Ok(report)
    }

    fn suggested_step(&self) -> Option<f64> {
        match self.stepping {
            Stepping::Fixed { .. } => None,
            Stepping::Adaptive { .. } => self.flow.wanted_step(),
        }
    }

    fn sample(&self, frame: &Frame, v: &mut [f64]) -> Result<(), StepError> {
        let (grid, picture) = match frame {
            Frame::Fixed { grid, .. } => (grid, false),
            Frame::Picture { grid } => (grid, true),
            Frame::Reference => return Err(StepError::UnknownFrame { frame: frame.name() }),
        };
        let mut views = self.views.borrow_mut();
        let view = views.iter_mut().find(|view| view.is_of(grid, picture));
        let view = view.ok_or(StepError::UnknownFrame { frame: frame.name() })?;
        Ok(view.sample(&self.flow, &self.solid_velocities(), v)?)
    }

    fn bodies(&self) -> &[BodyState] {
        &self.states
    }

    fn forget(&mut self) {
        self.flow.forget_factor();
    }

    fn save(&self, to: &mut dyn Write) -> io::Result<()> {
        self.flow.save(to)
    }

    fn restore(&mut self, from: &mut dyn Read) -> io::Result<()> {
        self.flow.restore(from).map_err(io::Error::other)?;
        self.states = self.flow.bodies().map_or(Vec::new(), states);
        self.views.get_mut().iter_mut().for_each(View::forget);
        Ok(())
    }
}
