use super::given::Given;
use super::loads::{Load, LoadDofs, edge_rule};
use super::output::area_rules;
use super::places::DofPlaces;
use super::rigid::RigidBodies;
use super::slip::Slides;
use super::stability::Stability;
use super::system::System;
use super::unknowns::Unknowns;
use super::{Condition, Flow, FlowError, FlowParameters, VectorField, Work};
use crate::coupling::{BodyMotion, BodySetup};
use crate::disjoint_sets::DisjointSets;
use crate::linear::{
    Analysis, CellUnknowns, DelayedUnknowns, GmresLimits, LaggedSolver, RenewalPolicy,
};
use crate::motion::Motion;
use faer::Par;
use lumley_fem::space::NodalSpace;
use lumley_fem::{PlanarMesh, Point};
use std::sync::Arc;

/// Iterations that a factorisation costs.
const FACTOR_PRICE: f64 = 8.0;
/// Residual of the linear systems over their right-hand sides: 1e-8 would leave errors of 1e-6 in the velocity.
const LINEAR_TOLERANCE: f64 = 1e-10;

/// How the flow begins.
///
/// ```
/// use lumley_fom::flow::FlowStart;
/// let stream = FlowStart::Velocity(std::sync::Arc::new(|_: [f64; 2], _| [1.0, 0.0]));
/// assert!(matches!(stream, FlowStart::Velocity(_)));
/// ```
#[derive(Clone)]
pub enum FlowStart {
    /// At rest.
    Rest,
    /// With this velocity, which need not fit the boundaries: the first step makes it so.
    Velocity(Arc<dyn VectorField>),
    /// With the creeping flow, without inertia, that the boundaries have at the start; bodies that move are at rest in
    /// it.
    Stokes,
}

/// How the mesh of a flow moves.
///
/// ```
/// use lumley_fom::{coupling::BodySetup, flow::FlowMotion};
/// assert!(matches!(FlowMotion::default(), FlowMotion::Still));
/// let bodies = FlowMotion::Bodies(BodySetup::default());
/// # assert!(matches!(bodies, FlowMotion::Bodies(_)));
/// ```
#[derive(Default)]
pub enum FlowMotion {
    /// Not at all.
    #[default]
    Still,
    /// As the time says.
    Given(Box<dyn Motion>),
    /// As bodies in the flow do, which it moves, or which are prescribed.
    Bodies(BodySetup),
}

/// Everything a flow is made of.
///
/// See [`Flow`] for an example.
pub struct FlowSetup {
    /// The mesh.
    pub mesh: PlanarMesh,
    /// Fluid and scheme.
    pub parameters: FlowParameters,
    /// Conditions by name of the boundary, each boundary once.
    pub conditions: Vec<(String, Condition)>,
    /// How it begins.
    pub start: FlowStart,
    /// How the mesh moves.
    pub motion: FlowMotion,
    /// Whether all cores assemble and factorise; the bits are the same.
    pub parallel: bool,
}

impl Flow {
    /// The flow at its start.
    ///
    /// # Errors
    /// Every variant of [`FlowError`] but those of a step.
    pub fn new(setup: FlowSetup) -> Result<Self, FlowError> {
        let FlowSetup { mut mesh, parameters, conditions, start, motion, parallel } = setup;
        parameters.check()?;
        let conditions = by_boundary(&mesh, conditions)?;
        let (mut motion, mut bodies) = movers(motion, &mesh, parameters.density)?;
        let moving = moving(&mesh, &conditions, motion.as_deref(), bodies.as_ref())?;
        let space = NodalSpace::velocity(mesh.topology());
        let rigid = RigidBodies::new(bodies.as_ref(), &mesh, &space);
        let nodes = put_at_start(&mut motion, &mut bodies, &mut mesh)?;
        let slides = Slides::new(&mesh, &space, &conditions);
        let unknowns = Unknowns::new(&mesh, &space, &conditions, &slides, &rigid)?;
        check_parts(&mesh, &conditions, &unknowns)?;
        let (system, pattern) = System::new(&mesh, &space, &conditions, &unknowns, &rigid);
        let solver = solver(&mesh, &unknowns, (&system, &rigid), &pattern, parallel);
        let (dofs, cells) = (space.dofs().len(), mesh.topology().cells());
        let boundaries = mesh.topology().boundaries().len();
        let mut flow = Self {
            places: DofPlaces::new(mesh.topology(), &space),
            given: Given::new(&mesh, &space, &unknowns, &moving),
            load_dofs: LoadDofs::new(&mesh, &space, &conditions),
            time: 0.0,
            previous: None,
            steps: 0,
            forced_steps: 0,
            stability: Stability::default(),
            wanted_step: None,
            velocity: [vec![[0.0; 2]; dofs], vec![[0.0; 2]; dofs]],
            pressure: [vec![[0.0; 3]; cells], vec![[0.0; 3]; cells]],
            nodes,
            mesh_velocity: vec![[0.0; 2]; dofs],
            loads: vec![Load::default(); boundaries],
            pivots: vec![[0.0; 2]; boundaries],
            work: Work {
                directions: vec![[0.0; 2]; slides.count() + rigid.directions()],
                body_velocity: bodies
                    .as_ref()
                    .map_or(Vec::new(), |b| b.scheme().velocity().to_vec()),
                ..Work::new(dofs, cells, mesh.nodes().len(), unknowns.count)
            },
            edge_rule: edge_rule(),
            area_rules: area_rules(),
            moving,
            parameters,
            conditions,
            mesh,
            space,
            motion,
            bodies,
            parallel,
            unknowns,
            pattern,
            system,
            solver,
            slides,
            rigid,
        };
        flow.follow_slides();
        flow.places.spread(flow.mesh.nodes(), &mut flow.work.dof_points);
        flow.show_pivots();
        flow.begin(start)?;
        Ok(flow)
    }

    fn begin(&mut self, start: FlowStart) -> Result<(), FlowError> {
        match start {
            FlowStart::Rest => {}
            FlowStart::Velocity(field) => {
                for (velocity, &place) in self.velocity[0].iter_mut().zip(&self.work.dof_points) {
                    let value = field.value(place, 0.0);
                    if !value.iter().all(|v| v.is_finite()) {
                        let what = "the initial velocity".into();
                        return Err(FlowError::NotFinite { what, place, time: 0.0, value });
                    }
                    *velocity = value;
                }
            }
            FlowStart::Stokes => self.creep()?,
        }
        let [now, before] = &mut self.velocity;
        before.copy_from_slice(now);
        Ok(())
    }
}

/// What moves the mesh: nothing, a motion, or bodies.
type Movers = (Option<Box<dyn Motion>>, Option<BodyMotion>);

fn movers(motion: FlowMotion, mesh: &PlanarMesh, density: f64) -> Result<Movers, FlowError> {
    Ok(match motion {
        FlowMotion::Still => (None, None),
        FlowMotion::Given(motion) => (Some(motion), None),
        FlowMotion::Bodies(setup) => (None, Some(BodyMotion::new(setup, mesh, density)?)),
    })
}

/// Moves the mesh to where it starts; where its nodes are now and were a step before, if it moves.
fn put_at_start(
    motion: &mut Option<Box<dyn Motion>>,
    bodies: &mut Option<BodyMotion>,
    mesh: &mut PlanarMesh,
) -> Result<[Vec<Point>; 2], FlowError> {
    match (motion, bodies) {
        (None, None) => return Ok([Vec::new(), Vec::new()]),
        (Some(motion), _) => motion.carry(0.0, mesh)?,
        (None, Some(bodies)) => bodies.carry(0.0, mesh)?,
    }
    Ok([mesh.nodes().to_vec(), mesh.nodes().to_vec()])
}

/// The conditions in the order of the mesh's boundaries.
fn by_boundary(
    mesh: &PlanarMesh,
    conditions: Vec<(String, Condition)>,
) -> Result<Vec<Condition>, FlowError> {
    let boundaries = mesh.topology().boundaries();
    let mut found: Vec<Option<Condition>> = vec![None; boundaries.len()];
    for (name, condition) in conditions {
        let place = boundary_number(mesh, &name)?;
        if found[place].replace(condition).is_some() {
            return Err(FlowError::TwoConditions { boundary: name });
        }
    }
    let pairs = boundaries.iter().zip(found);
    let missing = |name: &str| FlowError::NoCondition { boundary: name.into() };
    pairs.map(|(boundary, found)| found.ok_or_else(|| missing(&boundary.name))).collect()
}

/// Number of the boundary of that name.
pub(crate) fn boundary_number(mesh: &PlanarMesh, name: &str) -> Result<usize, FlowError> {
    let boundaries = mesh.topology().boundaries();
    boundaries.iter().position(|boundary| boundary.name == name).ok_or_else(|| {
        let known: Vec<&str> = boundaries.iter().map(|b| b.name.as_str()).collect();
        FlowError::UnknownBoundary { boundary: name.into(), known: known.join(", ") }
    })
}

/// Numbers of the boundaries that move, which do not slip.
fn moving(
    mesh: &PlanarMesh,
    conditions: &[Condition],
    motion: Option<&dyn Motion>,
    bodies: Option<&BodyMotion>,
) -> Result<Vec<usize>, FlowError> {
    let given = motion.map_or(Vec::new(), |motion| motion.boundaries());
    let given = given.into_iter().map(|name| boundary_number(mesh, name));
    let of_bodies = bodies.into_iter().flat_map(BodyMotion::boundaries).map(|[_, k]| Ok(k));
    let check = |place: Result<usize, FlowError>| {
        let place = place?;
        match &conditions[place] {
            Condition::NoSlip => Ok(place),
            other => {
                let boundary = mesh.topology().boundaries()[place].name.clone();
                Err(FlowError::MovingBoundary { boundary, condition: other.name() })
            }
        }
    };
    given.chain(of_bodies).map(check).collect()
}

/// A mesh in one piece may be closed; of several each must have an outlet, for one pressure alone is set.
fn check_parts(
    mesh: &PlanarMesh,
    conditions: &[Condition],
    unknowns: &Unknowns,
) -> Result<(), FlowError> {
    let topology = mesh.topology();
    let mut parts = DisjointSets::new(topology.cells());
    for [a, b] in neighbours(mesh, unknowns) {
        parts.join(a, b);
    }
    let roots: Vec<usize> =
        (0..topology.cells()).filter(|&cell| parts.root(cell) == cell).collect();
    let mut open = vec![false; topology.cells()];
    for (boundary, condition) in topology.boundaries().iter().zip(conditions) {
        if matches!(condition, Condition::TractionFree) {
            let cells = boundary.edges.iter().map(|&edge| topology.edges()[edge].left.cell);
            cells.for_each(|cell| open[parts.root(cell)] = true);
        }
    }
    match roots.iter().find(|&&root| !open[root]) {
        Some(&cell) if roots.len() > 1 => Err(FlowError::Parts { parts: roots.len(), cell }),
        _ => Ok(()),
    }
}

/// Pairs of cells that share an edge, or would if periodic boundaries were glued.
fn neighbours(mesh: &PlanarMesh, unknowns: &Unknowns) -> impl Iterator<Item = [usize; 2]> {
    let inner = mesh.topology().edges().iter();
    let inner = inner.filter_map(|edge| Some([edge.left.cell, edge.right?.cell]));
    inner.chain(unknowns.periodic.iter().copied())
}

fn solver(
    mesh: &PlanarMesh,
    unknowns: &Unknowns,
    (system, rigid): (&System, &RigidBodies),
    pattern: &CellUnknowns,
    parallel: bool,
) -> LaggedSolver {
    let order = system.order();
    let mut rank = vec![0; order.len()];
    order.iter().enumerate().for_each(|(k, &cell)| rank[cell] = k);
    let centroids = order.iter().map(|&cell| mesh.centre(cell));
    let centroids: Vec<_> = centroids.chain(rigid.cells().map(|(_, centre)| centre)).collect();
    let pressures: Vec<[usize; 2]> = order
        .iter()
        .enumerate()
        .filter_map(|(k, &cell)| Some([unknowns.pressures[cell]?, k]))
        .collect();
    let neighbours: Vec<[usize; 2]> =
        neighbours(mesh, unknowns).map(|cells| cells.map(|cell| rank[cell])).collect();
    let delayed = DelayedUnknowns { unknowns: &pressures, neighbours: &neighbours };
    let analysis = Analysis::new(pattern.clone(), &centroids, &delayed);
    let limits = GmresLimits { tolerance: LINEAR_TOLERANCE, ..GmresLimits::default() };
    let par = if parallel { Par::rayon(0) } else { Par::Seq };
    LaggedSolver::new(analysis, limits, RenewalPolicy::new(FACTOR_PRICE), par)
}

impl Work {
    fn new(dofs: usize, cells: usize, nodes: usize, unknowns: usize) -> Self {
        let vectors = |len| vec![[0.0; 2]; len];
        Self {
            wind: vectors(dofs),
            source: vectors(dofs),
            base: vectors(dofs),
            dof_points: vectors(dofs),
            node_velocity: vectors(nodes),
            directions: Vec::new(),
            body_velocity: Vec::new(),
            right: vec![0.0; unknowns],
            solution: vec![0.0; unknowns],
            new_velocity: vectors(dofs),
            new_pressure: vec![[0.0; 3]; cells],
        }
    }
}
