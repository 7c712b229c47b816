use super::nodal_fields::NodalFields;
use super::{Frame, Model, StepError, StepReport};
use lumley_body::BodyState;
use lumley_fem::transfer::{Bodies, Coverage, PlanarFlow, PlanarTransfer, Transfer, TransferError};
use lumley_fem::{Point, UniformGrid};
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
}

/// A fixed grid and what is on it.
struct View {
    transfer: PlanarTransfer,
    placed: bool,
    /// Pressure and vorticity at the dofs, for a picture.
    scalars: Option<(NodalFields, Vec<Point>)>,
}

impl FlowModel {
    /// The model with these steps, recorded in no frame yet.
    pub fn new(mut flow: Flow, stepping: Stepping) -> Self {
        let (mesh, space) = (flow.mesh(), flow.space());
        let is_body = |name: &str| Bodies::new(mesh, &[name]).is_ok();
        let boundaries = mesh.topology().boundaries().iter();
        let solids = boundaries.filter(|boundary| is_body(&boundary.name)).map(|boundary| Solid {
            name: boundary.name.clone(),
            dofs: space.dofs().on_boundary(mesh.topology(), boundary),
        });
        let solids = solids.collect();
        let views = RefCell::new(Vec::new());
        if let Stepping::Adaptive { first, .. } = stepping {
            flow.suggest_step(first);
        }
        let last = FlowStep::default();
        Self { flow, stepping, last, solids, views }
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
        let mesh = self.flow.mesh();
        let names: Vec<&str> = self.bodies_in_it().collect();
        let bodies = Bodies::new(mesh, &names).expect("each of them is a body");
        let mut transfer = PlanarTransfer::new(method, grid, bodies)?;
        let coverage = transfer.update(mesh);
        let space = self.flow.space();
        let scalars =
            picture.then(|| (NodalFields::new(space), vec![[0.0; 2]; space.dofs().len()]));
        self.views.get_mut().push(View { transfer, placed: true, scalars });
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

    /// The rigid velocity of a body, which the fluid has at its boundary.
    fn velocity_of(&self, solid: &Solid) -> RigidVelocity {
        let (points, velocities) = (self.flow.dof_points(), self.flow.mesh_velocity());
        RigidVelocity::fit(solid.dofs.iter().map(|&dof| (points[dof], velocities[dof])))
    }
}

impl View {
    /// The velocity, and for a picture pressure and vorticity behind it.
    fn sample(&mut self, model: &FlowModel, out: &mut [f64]) -> Result<(), TransferError> {
        let flow = &model.flow;
        if !self.placed || flow.moves() {
            self.transfer.update(flow.mesh());
            self.placed = true;
        }
        let solids: Vec<RigidVelocity> =
            model.solids.iter().map(|solid| model.velocity_of(solid)).collect();
        let solid = |body: usize, point: Point| solids[body].at(point);
        let (mesh, space) = (flow.mesh(), flow.space());
        let velocity = PlanarFlow { mesh, space, velocity: flow.velocity(), solid: &solid };
        let (first, second) = out.split_at_mut(2 * self.transfer.grid().len());
        self.transfer.transfer(velocity, first)?;
        let Some((fields, pairs)) = &mut self.scalars else { return Ok(()) };
        fields.update(flow);
        let values = fields.pressure.iter().zip(&fields.vorticity);
        pairs.iter_mut().zip(values).for_each(|(pair, (p, omega))| *pair = [*p, *omega]);
        let none = |_: usize, _: Point| [0.0; 2];
        self.transfer.transfer(PlanarFlow { mesh, space, velocity: pairs, solid: &none }, second)
    }
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
        let is_it =
            |view: &&mut View| view.transfer.grid() == grid && view.scalars.is_some() == picture;
        let view = views.iter_mut().find(is_it);
        let view = view.ok_or(StepError::UnknownFrame { frame: frame.name() })?;
        Ok(view.sample(self, v)?)
    }

    fn bodies(&self) -> &[BodyState] {
        &[]
    }

    fn forget(&mut self) {
        self.flow.forget_factor();
    }

    fn save(&self, to: &mut dyn Write) -> io::Result<()> {
        self.flow.save(to)
    }

    fn restore(&mut self, from: &mut dyn Read) -> io::Result<()> {
        self.flow.restore(from).map_err(io::Error::other)?;
        for view in self.views.get_mut() {
            view.placed = false;
        }
        Ok(())
    }
}
