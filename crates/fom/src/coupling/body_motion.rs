use super::wet::Wet;
use super::{BodySetup, Coupling, added_mass, collision};
use crate::flow::{FlowError, Load};
use crate::motion::{MeshMotion, MotionError, MovingBoundary, RigidMotion};
use crate::time_scheme::RateFormula;
use lumley_body::{BodyState, DynamicsError, ImplicitScheme, Placement, Tree};
use lumley_fem::{PlanarMesh, Point};

/// The bodies in a flow, and the mesh that follows them.
#[derive(Debug, Clone)]
pub(crate) struct BodyMotion {
    scheme: ImplicitScheme,
    coupling: Coupling,
    mesh: MeshMotion,
    wet: Vec<Wet>,
    density: f64,
    /// Where the wet bodies were put last.
    placed: Vec<RigidMotion>,
    /// Kept, so that a step allocates nothing.
    loads: Vec<lumley_body::Load>,
}

impl BodyMotion {
    /// The bodies at their start in a fluid of this density, in kg/m³.
    pub fn new(setup: BodySetup, mesh: &PlanarMesh, density: f64) -> Result<Self, FlowError> {
        let BodySetup { mut bodies, gravity, coupling, mesh: parameters } = setup;
        let wet = Wet::all(&bodies, mesh)?;
        for wet in &wet {
            bodies[wet.body].displaced = Some(wet.displaced(density));
        }
        let tree = Tree::new(&bodies, gravity)?;
        let scheme = match coupling {
            Coupling::Explicit => ImplicitScheme::new(tree, 0.0)?,
            Coupling::Monolithic => {
                if let Some(k) = coupling.massless_coordinate(&tree) {
                    return Err(FlowError::Massless { coordinate: tree.label(k) });
                }
                ImplicitScheme::in_fluid(tree, 0.0).map_err(DynamicsError::from)?
            }
        };
        let boundaries = mesh.topology().boundaries();
        let moving = wet.iter().map(|wet| MovingBoundary {
            name: boundaries[wet.boundary].name.clone(),
            pivot: scheme.kinematics().placement(wet.body).pivot,
        });
        let moving: Vec<MovingBoundary> = moving.collect();
        let mesh = MeshMotion::new(mesh, &moving, &parameters)?;
        let placed = vec![RigidMotion::REST; wet.len()];
        let loads = Vec::with_capacity(wet.len());
        Ok(Self { scheme, coupling, mesh, wet, density, placed, loads })
    }

    pub fn coupling(&self) -> Coupling {
        self.coupling
    }

    /// The bodies, with their coordinates now.
    pub fn scheme(&self) -> &ImplicitScheme {
        &self.scheme
    }

    /// Body and number of the boundary of each wet body.
    pub fn boundaries(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        self.wet.iter().map(|wet| [wet.body, wet.boundary])
    }

    /// Areas of the wet bodies, in m².
    pub fn areas(&self) -> impl Iterator<Item = f64> + '_ {
        self.wet.iter().map(|wet| wet.area)
    }

    /// Centre of mass of the k-th wet body, in m, in the last trial: the pivot of its load.
    pub fn pivot(&self, k: usize) -> Point {
        self.scheme.kinematics().centre(self.wet[k].body)
    }

    /// Where the bodies are after a step: as the loads of the step before want it, by boundary; or as foreseen,
    /// velocities `ahead` times their last change further.
    pub fn foresee(
        &mut self,
        dt: f64,
        formula: RateFormula,
        ahead: f64,
        loads: &[Load],
    ) -> Result<(), FlowError> {
        match self.coupling {
            Coupling::Monolithic => {
                let predicted = self.scheme.predict(dt, formula.of_bodies(), ahead);
                predicted.map_err(DynamicsError::from)?;
            }
            Coupling::Explicit => {
                self.loads.clear();
                for &Wet { body, boundary, .. } in &self.wet {
                    let Load { force, moment } = loads[boundary];
                    let at = self.scheme.tree().bodies()[body].centre;
                    self.loads.push(lumley_body::Load { body, at, force, moment });
                }
                self.scheme.solve(dt, formula.of_bodies(), &self.loads)?;
            }
        }
        Ok(())
    }

    /// Gives the bodies these velocities. How far some wet body is then from where it was put, as a part of its
    /// radius.
    pub fn propose(&mut self, formula: RateFormula, velocity: &[f64]) -> f64 {
        self.scheme.propose(formula.of_bodies(), velocity);
        let apart = |(wet, placed): (&Wet, &RigidMotion)| {
            let placement = self.scheme.kinematics().placement(wet.body);
            let now = rigid_motion(placement);
            let [p, q] = [&now, placed].map(|motion| motion.place(placement.pivot, wet.centroid));
            let turned = (now.angle - placed.angle).abs();
            (p[0] - q[0]).hypot(p[1] - q[1]) / wet.radius + turned
        };
        self.wet.iter().zip(&self.placed).map(apart).fold(0.0, f64::max)
    }

    /// Moves the mesh to where the bodies are in the last trial, at `time`, in s.
    pub fn carry(&mut self, time: f64, mesh: &mut PlanarMesh) -> Result<(), FlowError> {
        self.place();
        let Err(error) = self.mesh.carry(&self.placed, time, mesh) else { return Ok(()) };
        Err(self.explain(error, time, mesh))
    }

    /// What a mesh that did not survive says of the bodies in it.
    fn explain(&self, source: MotionError, time: f64, mesh: &PlanarMesh) -> FlowError {
        if !matches!(source, MotionError::Tangled { .. } | MotionError::Lost { .. }) {
            return source.into();
        }
        let names = |pair: [usize; 2]| pair.map(|k| mesh.topology().boundaries()[k].name.clone());
        if let Some(pair) = collision::find(mesh, &self.wet) {
            let [body, with] = names(pair);
            return FlowError::Collision { time, body, with };
        }
        let radius = self.wet.iter().map(|wet| wet.radius).fold(0.0, f64::max);
        match collision::nearest_pair(mesh, &self.wet).filter(|(_, gap)| *gap < radius) {
            Some((pair, gap)) => {
                let [body, with] = names(pair);
                FlowError::Squeezed { body, with, gap, source: Box::new(source) }
            }
            None => source.into(),
        }
    }

    /// [`carry`](Self::carry) without looking whether the cells survive: for a place that is next to one where they do.
    pub fn show(&mut self, mesh: &mut PlanarMesh) {
        self.place();
        self.mesh.place(&self.placed, mesh.nodes_mut());
    }

    fn place(&mut self) {
        for (placed, wet) in self.placed.iter_mut().zip(&self.wet) {
            *placed = rigid_motion(self.scheme.kinematics().placement(wet.body));
        }
    }

    /// The last trial is the state, `dt` in s later.
    pub fn accept(&mut self, dt: f64) {
        self.scheme.accept(dt);
    }

    /// The numbers from which it goes on.
    pub fn state(&self) -> impl Iterator<Item = f64> + '_ {
        let states = self.scheme.state().into_iter();
        states.flat_map(|state| state.position.iter().chain(&state.velocity)).copied()
    }

    /// Takes the numbers of [`state`](Self::state) at `time`, in s.
    pub fn restore(&mut self, time: f64, mut next: impl FnMut() -> f64) {
        let n = self.scheme.position().len();
        let mut list = || (0..n).map(|_| next()).collect();
        let [now, before] = [0, 1].map(|_| {
            let position = list();
            BodyState::new(position, list())
        });
        self.scheme.restore(time, [&now, &before]);
    }

    /// The added mass over that of the bodies, where they are in the last trial.
    pub fn added_mass_share(&self) -> f64 {
        let (tree, kinematics) = (self.scheme.tree(), self.scheme.kinematics());
        added_mass::share(tree, kinematics, &self.wet, self.density)
    }
}

fn rigid_motion(Placement { translation, rotation, .. }: Placement) -> RigidMotion {
    RigidMotion { translation, angle: rotation }
}
