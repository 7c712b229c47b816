//! The transfer from a planar mesh that moves, all nodes of the grid at once.

mod bodies;
mod crossing;
mod error;
mod places;
mod vicinity;

pub use bodies::{Bodies, BodyError};
pub use places::{Coverage, Place};

use super::closest::shepard;
use super::{GridError, Transfer, TransferError};
use crate::space::NodalSpace;
use crate::{Location, PlanarMesh, Point, UniformGrid};
use places::Places;
use vicinity::Vicinity;

/// The velocity on a planar mesh at one instant, with that of the bodies in its holes.
///
/// ```
/// use lumley_fem::{MeshDescription, PlanarMesh, space::NodalSpace, transfer::PlanarFlow};
/// let mesh = PlanarMesh::new(MeshDescription::structured([2, 2], |_| false, |p| p))?;
/// let space = NodalSpace::velocity(mesh.topology());
/// let velocity = space.points(&mesh);
/// let at_rest = |_: usize, _: [f64; 2]| [0.0, 0.0];
/// let flow = PlanarFlow { mesh: &mesh, space: &space, velocity: &velocity, solid: &at_rest };
/// assert_eq!(flow.velocity.len(), flow.space.dofs().len());
/// # Ok::<(), lumley_fem::MeshError>(())
/// ```
#[derive(Clone, Copy)]
pub struct PlanarFlow<'a> {
    /// The mesh.
    pub mesh: &'a PlanarMesh,
    /// The space of a component of the velocity.
    pub space: &'a NodalSpace,
    /// A vector for each dof, in m/s.
    pub velocity: &'a [Point],
    /// The velocity, in m/s, of the body with this number at a point in m.
    pub solid: &'a dyn Fn(usize, Point) -> Point,
}

/// The transfer of a velocity from a moving planar mesh to a grid, paper eqs. (27)-(30).
///
/// [`update`](Self::update) finds for every node of the grid the cell of the mesh, cell by cell, or the
/// body that it is in; any number of fields can then be brought over. A node is in the fluid if it is in a cell,
/// the rim included; else it is in the body whose boundary goes round it, by the very curves that bound the
/// cells. What is in neither is outside: it gets zero, and [`Coverage::outside`] counts it.
///
/// After the first use nothing is allocated. One thread: the bits do not depend on how many there are.
///
/// ```
/// use lumley_fem::transfer::{Bodies, PlanarFlow, PlanarTransfer, Transfer};
/// use lumley_fem::{MeshDescription, PlanarMesh, UniformGrid, space::NodalSpace};
/// let mesh = PlanarMesh::new(MeshDescription::structured([3, 2], |[i, _]| i == 1, |p| p))?;
/// let space = NodalSpace::velocity(mesh.topology());
/// let shear: Vec<_> = space.points(&mesh).into_iter().map(|[_, y]| [2.0 * y, 0.0]).collect();
/// let grid = UniformGrid::rectangle([0.0, 0.0], [1.0, 1.0], [5, 3]);
///
/// let mut transfer = PlanarTransfer::new(Transfer::default(), grid, Bodies::none())?;
/// let coverage = transfer.update(&mesh);
/// assert_eq!((coverage.fluid, coverage.outside), (15, 0));
/// let none = |_: usize, _: [f64; 2]| unreachable!("there is no body");
/// let flow = PlanarFlow { mesh: &mesh, space: &space, velocity: &shear, solid: &none };
/// let mut v = [f64::NAN; 30];
/// transfer.transfer(flow, &mut v)?;
/// assert!((v[7] - 1.0).abs() < 1e-15 && v[15..].iter().all(|v| *v == 0.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct PlanarTransfer {
    method: Method,
    bodies: Bodies,
    places: Places,
}

/// How the fluid's velocity is found at a node of the grid.
enum Method {
    FiniteElement,
    InverseDistance { power: f64, neighbours: usize, vicinity: Vicinity },
}

impl PlanarTransfer {
    /// A transfer to this grid.
    ///
    /// # Errors
    /// [`TransferError::Power`] and [`TransferError::NoNeighbours`].
    ///
    /// # Panics
    /// If the grid is one of an interval.
    pub fn new(method: Transfer, grid: UniformGrid, bodies: Bodies) -> Result<Self, TransferError> {
        method.check()?;
        let method = match method {
            Transfer::FiniteElement {} => Method::FiniteElement,
            Transfer::InverseDistance { power, neighbours } => {
                let vicinity = Vicinity::new(neighbours);
                Method::InverseDistance { power, neighbours, vicinity }
            }
        };
        Ok(Self { method, bodies, places: Places::new(grid) })
    }

    /// Follows the nodes of the mesh. All nodes are outside before the first time.
    pub fn update(&mut self, mesh: &PlanarMesh) -> Coverage {
        self.places.update(mesh, &self.bodies);
        self.places.coverage
    }

    /// Where the nodes of the grid are, since the last update.
    pub fn places(&self) -> &[Place] {
        &self.places.nodes
    }

    /// The grid.
    pub fn grid(&self) -> &UniformGrid {
        &self.places.grid
    }

    /// The characteristic function `χ_F`, paper eq. (27): 1 in the fluid, 0 in bodies and outside.
    ///
    /// # Panics
    /// If `chi` has not one entry for each node of the grid.
    pub fn characteristic(&self, chi: &mut [f64]) {
        assert_eq!(chi.len(), self.places.grid.len(), "one value for each node of the grid");
        for (chi, place) in chi.iter_mut().zip(&self.places.nodes) {
            *chi = if matches!(place, Place::Fluid(_)) { 1.0 } else { 0.0 };
        }
    }

    /// The global velocity `v = χ_F v_f + (1 − χ_F) v_s` on the nodes of the grid, paper eq. (30), in m/s, from
    /// the mesh of the last update: x components first, then y components.
    ///
    /// # Errors
    /// [`TransferError::TooFewNodes`].
    ///
    /// # Panics
    /// If `out` has not two entries for each node of the grid, or `flow` not one vector for each dof, or another
    /// mesh.
    pub fn transfer(&mut self, flow: PlanarFlow<'_>, out: &mut [f64]) -> Result<(), TransferError> {
        let Self { method, places: Places { grid, nodes, .. }, .. } = self;
        assert_eq!(out.len(), 2 * grid.len(), "one value for each component and node");
        assert_eq!(flow.velocity.len(), flow.space.dofs().len(), "one vector for each dof");
        method.prepare(&flow)?;
        let (x, y) = out.split_at_mut(grid.len());
        for (k, (place, (x, y))) in nodes.iter().zip(x.iter_mut().zip(y)).enumerate() {
            [*x, *y] = match place {
                Place::Fluid(at) => method.velocity(&flow, at, grid.point(k)),
                Place::Solid(body) => (flow.solid)(*body, grid.point(k)),
                Place::Outside => [0.0; 2],
            };
        }
        Ok(())
    }

    /// How far the bilinear field with the nodal values `values`, such as [`transfer`](Self::transfer) gives, is
    /// from the global velocity (29) itself, over the part of mesh and bodies within the grid.
    ///
    /// By quadrature on the cells of the mesh, and at many points of each cell of the grid in bodies. Allocates.
    ///
    /// # Panics
    /// If `values` has not two entries for each node of the grid.
    pub fn error(&self, flow: PlanarFlow<'_>, values: &[f64]) -> GridError {
        error::error(&self.places.grid, &self.bodies, flow, values)
    }
}

impl Method {
    fn prepare(&mut self, flow: &PlanarFlow<'_>) -> Result<(), TransferError> {
        if let Self::InverseDistance { neighbours, vicinity, .. } = self {
            let (wanted, nodes) = (*neighbours, flow.space.dofs().len());
            if wanted > nodes {
                return Err(TransferError::TooFewNodes { wanted, nodes });
            }
            vicinity.update(flow);
        }
        Ok(())
    }

    fn velocity(&mut self, flow: &PlanarFlow<'_>, at: &Location, point: Point) -> Point {
        match self {
            Self::FiniteElement => flow.space.vector(flow.velocity, at),
            Self::InverseDistance { power, vicinity, .. } => {
                weighted(vicinity.nearest(flow, at, point), *power, flow.velocity)
            }
        }
    }
}

/// The mean of the velocities of these nodes with Shepard's weights.
fn weighted(found: &[(f64, usize)], power: f64, velocity: &[Point]) -> Point {
    let mut v = [0.0; 2];
    let sum = shepard(found, power, |node, weight| {
        v = [0, 1].map(|d| v[d] + weight * velocity[node][d]);
    });
    v.map(|v| v / sum)
}
