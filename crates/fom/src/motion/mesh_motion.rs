use super::laplace::Laplace;
use super::outline::Outline;
use super::rigid_motion::Turn;
use super::stiffness::Follower;
use super::zone::{Tie, ties};
use super::{MotionError, MotionParameters, RigidMotion};
use lumley_fem::{MeshError, PlanarMesh, Point, Topology};

/// A boundary that moves as a rigid body does.
///
/// ```
/// use lumley_fom::motion::MovingBoundary;
/// let cylinder = MovingBoundary { name: "cylinder".into(), pivot: [0.2, 0.2] };
/// assert_eq!(cylinder.pivot, [0.2, 0.2]);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct MovingBoundary {
    /// Its name in the mesh.
    pub name: String,
    /// The point about which it turns, where it is in the mesh as it was given, in m.
    pub pivot: Point,
}

/// The motion of a mesh whose boundaries move as rigid bodies, paper eqs. (24) and (25).
///
/// For each boundary b that moves, `div(lambda grad h) = 0` with h = 1 on b and h = 0 on all other boundaries
/// is solved once, on the mesh as it was given; so is g with the stiffness of angles. Then the node that was
/// at X is at
///
/// ```text
/// x = X + sum over b of h_b D_b + (R(g_b angle_b) - I) (X - c_b)
/// ```
///
/// where c is the centre of the boundary and D how far it has moved. For translations this is (25) for the
/// displacement; that angles fade, and not the displacements by them, lets bodies turn far. It does not matter
/// about which pivot a motion is described.
///
/// ```
/// use lumley_fem::{PlanarMesh, generate::Channel};
/// use lumley_fom::motion::{MeshMotion, MotionParameters, MovingBoundary, RigidMotion};
/// let channel: Channel = toml::from_str(
///     "x = [-2, 4]\ny = [-2, 2]\nsize = 0.5
///      [[bodies]]\nname = 'disc'\nsize = 0.2\nshape = { kind = 'disc', centre = [0, 0], radius = 0.5 }",
/// )?;
/// let mut mesh = PlanarMesh::new(channel.mesh()?)?;
/// let disc = MovingBoundary { name: "disc".into(), pivot: [0.0, 0.0] };
/// let motion = MeshMotion::new(&mesh, &[disc], &MotionParameters::default())?;
/// let position = RigidMotion { translation: [0.0, 1.0], angle: 0.3 };
/// motion.carry(&[position], 0.0, &mut mesh)?;
/// let edge = mesh.topology().boundary("disc").unwrap().edges[0];
/// for [x, y] in mesh.edge(edge) {
///     assert!((x.hypot(y - 1.0) - 0.5).abs() < 1e-15);
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct MeshMotion {
    reference: Vec<Point>,
    free: Vec<usize>,
    bodies: Vec<Body>,
}

/// A moving boundary and what it takes with it.
#[derive(Debug, Clone, PartialEq)]
struct Body {
    boundary: MovingBoundary,
    centre: Point,
    /// Nodes that move rigidly with it.
    rigid: Vec<usize>,
    /// h and g at the free nodes.
    shares: Vec<[f64; 2]>,
}

impl MeshMotion {
    /// Solves (25) on a mesh, which is the one that positions are then relative to.
    ///
    /// # Errors
    /// All variants of [`MotionError`] but those of the steps.
    pub fn new(
        mesh: &PlanarMesh,
        moving: &[MovingBoundary],
        parameters: &MotionParameters,
    ) -> Result<Self, MotionError> {
        parameters.check()?;
        let numbers = find(mesh.topology(), moving)?;
        let outline = |&k: &usize| Outline::new(mesh, &mesh.topology().boundaries()[k]);
        let outlines: Vec<Outline> = numbers.iter().map(outline).collect();
        let ties = ties(mesh, &numbers, &outlines, parameters.rigid_zone)?;
        let stiffness = parameters.stiffness;
        let solve = |follower: Follower| {
            let stiffness = |at: Point, area: f64| stiffness.at(follower, at, area, &outlines);
            let bodies = moving.len();
            Laplace { mesh, ties: &ties, bodies, stiffness: &stiffness }.solve()
        };
        let (h, g) = (solve(Follower::Displacement)?, solve(Follower::Angle)?);
        let shares = |b: usize| (0..h.nrows()).map(|k| [h[(k, b)], g[(k, b)]]).collect();
        let tied = |tie: Tie| (0..ties.len()).filter(|&node| ties[node] == tie).collect();
        let bodies =
            moving.iter().zip(&outlines).enumerate().map(|(b, (boundary, outline))| Body {
                boundary: boundary.clone(),
                centre: outline.centre(),
                rigid: tied(Tie::Body(b)),
                shares: shares(b),
            });
        let bodies = bodies.collect();
        Ok(Self { reference: mesh.nodes().to_vec(), free: tied(Tie::Free), bodies })
    }

    /// The boundaries that move, in the order of their positions.
    pub fn boundaries(&self) -> impl ExactSizeIterator<Item = &MovingBoundary> {
        self.bodies.iter().map(|body| &body.boundary)
    }

    /// Puts the nodes where they belong when the boundaries are at `positions`. Nodes of boundaries that move,
    /// and of their rigid zones, are exactly at [`RigidMotion::place`]; those of boundaries that stay are
    /// exactly where they were. Allocates nothing.
    ///
    /// # Panics
    /// If there is not one position for each boundary that moves, or the nodes are not as many as the mesh has.
    pub fn place(&self, positions: &[RigidMotion], nodes: &mut [Point]) {
        assert_eq!(positions.len(), self.bodies.len(), "a position for each boundary that moves");
        nodes.copy_from_slice(&self.reference);
        for (body, position) in self.bodies.iter().zip(positions) {
            let place = position.map(body.boundary.pivot);
            for &node in &body.rigid {
                nodes[node] = place(self.reference[node]);
            }
            self.place_free(body, position, nodes);
        }
    }

    fn place_free(&self, body: &Body, position: &RigidMotion, nodes: &mut [Point]) {
        let (centre, angle) = (body.centre, position.angle);
        let moved = position.displacement(body.boundary.pivot, centre);
        for (&node, [h, g]) in self.free.iter().zip(&body.shares) {
            let [x, y] = self.reference[node];
            let turned = Turn::by(g * angle).displacement([x - centre[0], y - centre[1]]);
            nodes[node][0] += h * moved[0] + turned[0];
            nodes[node][1] += h * moved[1] + turned[1];
        }
    }

    /// [`place`](Self::place) for the nodes of `mesh`, and a look whether all cells survived. `time`, in s, is
    /// for the error. Allocates nothing unless there is one.
    ///
    /// # Errors
    /// [`MotionError::Positions`] and [`MotionError::OtherMesh`] for what does not fit;
    /// [`MotionError::NotFinite`]; then `mesh` is as it was. [`MotionError::Tangled`] and [`MotionError::Lost`]
    /// for what the motion did to the cells: then `mesh` is as bad as they say.
    pub fn carry(
        &self,
        positions: &[RigidMotion],
        time: f64,
        mesh: &mut PlanarMesh,
    ) -> Result<(), MotionError> {
        let (expected, found) = (self.bodies.len(), positions.len());
        if expected != found {
            return Err(MotionError::Positions { expected, found });
        }
        let (expected, found) = (self.reference.len(), mesh.nodes().len());
        if expected != found {
            return Err(MotionError::OtherMesh { expected, found });
        }
        if let Some(k) = positions.iter().position(|position| !position.is_finite()) {
            let boundary = self.bodies[k].boundary.name.clone();
            return Err(MotionError::NotFinite { time, boundary, motion: positions[k] });
        }
        self.place(positions, mesh.nodes_mut());
        mesh.check().map_err(|error| match error {
            MeshError::Inverted { cell, determinant } => {
                let quality = mesh.cell_qualities()[cell.cell].scaled_jacobian;
                MotionError::Tangled { time, cell, quality, determinant }
            }
            error => MotionError::Lost { time, error },
        })
    }
}

/// Numbers of the moving boundaries among those of the mesh.
fn find(topology: &Topology, moving: &[MovingBoundary]) -> Result<Vec<usize>, MotionError> {
    if moving.is_empty() {
        return Err(MotionError::NothingMoves);
    }
    let boundaries = topology.boundaries();
    let number = |(k, MovingBoundary { name, pivot }): (usize, &MovingBoundary)| {
        if moving[..k].iter().any(|other| other.name == *name) {
            return Err(MotionError::Twice(name.clone()));
        }
        for x in *pivot {
            let what = format!("pivot of boundary \"{name}\"");
            MotionError::require(x.is_finite(), &what, x, "m", "finite coordinates")?;
        }
        boundaries.iter().position(|boundary| boundary.name == *name).ok_or_else(|| {
            let known = boundaries.iter().map(|boundary| boundary.name.clone()).collect();
            MotionError::UnknownBoundary { name: name.clone(), known }
        })
    };
    moving.iter().enumerate().map(number).collect()
}
