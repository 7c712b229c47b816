use super::{LinearPressure, NodalSpace};
use crate::element::{Element, P2Bubble, Q2, TriangleP2};
use crate::geometry::{Mapped, Tabulated};
use crate::quadrature::rule;
use crate::{PlanarMesh, Point};

/// Continuous fields for pictures and files from fields that jump between cells: at each dof of the
/// velocity the mean over the cells round it, weighted by their areas.
///
/// What is continuous and linear is reproduced. Of smooth flows both pressure and vorticity are of order
/// two. On the rim the mean is one-sided. After the construction nothing is allocated.
///
/// ```
/// use lumley_fem::{MeshDescription, PlanarMesh, space::{NodalSpace, Recovery}};
/// let mesh = PlanarMesh::new(MeshDescription::structured([2, 2], |[i, _]| i == 1, |p| p))?;
/// let space = NodalSpace::velocity(mesh.topology());
/// let rotation: Vec<_> = space.points(&mesh).into_iter().map(|[x, y]| [-3.0 * y, 3.0 * x]).collect();
/// let mut vorticity = vec![0.0; space.dofs().len()];
/// Recovery::new(&space).vorticity(&mesh, &space, &rotation, &mut vorticity);
/// assert!(vorticity.iter().all(|omega| (omega - 6.0).abs() < 1e-13));
/// # Ok::<(), lumley_fem::MeshError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Recovery {
    triangle: Tables<6, 7>,
    quadrilateral: Tables<9, 9>,
    areas: Vec<f64>,
}

impl Recovery {
    /// For fields on a space made by [`NodalSpace::velocity`].
    pub fn new(space: &NodalSpace) -> Self {
        Self {
            triangle: Tables::new(&TriangleP2, &P2Bubble, 4),
            quadrilateral: Tables::new(&Q2, &Q2, 5),
            areas: vec![0.0; space.dofs().len()],
        }
    }

    /// The pressure, in Pa, at the dofs of the velocity; `coefficients` are those of the [`LinearPressure`] of
    /// each cell.
    ///
    /// # Panics
    /// If the lengths do not fit the mesh, or the space has not seven dofs on a triangle and nine on a
    /// quadrilateral.
    pub fn pressure(
        &mut self,
        mesh: &PlanarMesh,
        space: &NodalSpace,
        coefficients: &[[f64; 3]],
        nodal: &mut [f64],
    ) {
        assert_eq!(coefficients.len(), mesh.topology().cells(), "pressures of each cell");
        self.mean(mesh, space, &Pressure(coefficients), nodal);
    }

    /// The vorticity `∂v/∂x − ∂u/∂y`, in 1/s, at the dofs of the velocity (u, v).
    ///
    /// # Panics
    /// As [`pressure`](Self::pressure).
    pub fn vorticity(
        &mut self,
        mesh: &PlanarMesh,
        space: &NodalSpace,
        velocity: &[Point],
        nodal: &mut [f64],
    ) {
        assert_eq!(velocity.len(), space.dofs().len(), "a velocity at each dof");
        self.mean(mesh, space, &Vorticity(velocity), nodal);
    }

    fn mean(
        &mut self,
        mesh: &PlanarMesh,
        space: &NodalSpace,
        field: &impl CellField,
        nodal: &mut [f64],
    ) {
        assert_eq!(space.dofs().len(), self.areas.len(), "the space of the construction");
        assert_eq!(nodal.len(), self.areas.len(), "a value at each dof");
        let mut sums = Sums { values: nodal, areas: &mut self.areas };
        sums.clear();
        let triangles = mesh.topology().triangles().len();
        for (t, dofs) in space.dofs().triangles().iter().enumerate() {
            sums.add(&self.triangle.map(t, mesh.triangle(t)), dofs, field);
        }
        for (q, dofs) in space.dofs().quadrilaterals().iter().enumerate() {
            let cell = self.quadrilateral.map(triangles + q, mesh.quadrilateral(q));
            sums.add(&cell, dofs, field);
        }
        sums.divide();
    }
}

/// What belongs to the reference cell: N geometry functions, M functions of the velocity.
#[derive(Debug, Clone)]
struct Tables<const N: usize, const M: usize> {
    geometry: Vec<Tabulated<N>>,
    velocity: Vec<Tabulated<M>>,
    area: Vec<Tabulated<N>>,
}

impl<const N: usize, const M: usize> Tables<N, M> {
    /// `degree` makes area and centroid exact.
    fn new(geometry: &dyn Element, velocity: &dyn Element, degree: usize) -> Self {
        Self {
            geometry: Tabulated::at_nodes(geometry, velocity),
            velocity: Tabulated::at_nodes(velocity, velocity),
            area: Tabulated::on(geometry, &rule(geometry.layout().cell, degree)),
        }
    }

    fn map(&self, number: usize, nodes: [Point; N]) -> MappedCell<'_, N, M> {
        let area = self.area.iter().map(|at| Mapped::new(&nodes, at).weight).sum();
        MappedCell { tables: self, number, nodes, area }
    }
}

/// A cell of a mesh, with its dofs.
struct MappedCell<'a, const N: usize, const M: usize> {
    tables: &'a Tables<N, M>,
    number: usize,
    nodes: [Point; N],
    area: f64,
}

impl<const N: usize, const M: usize> MappedCell<'_, N, M> {
    fn at_dof(&self, dof: usize) -> Mapped {
        Mapped::new(&self.nodes, &self.tables.geometry[dof])
    }

    fn pressure_functions(&self) -> LinearPressure {
        let points = self.tables.area.iter().map(|at| Mapped::new(&self.nodes, at));
        LinearPressure::centred(points.map(|mapped| (mapped.point, mapped.weight)))
    }
}

/// A field that each cell has values of its own of, at its dofs.
trait CellField {
    fn at_dofs<const N: usize, const M: usize>(
        &self,
        cell: &MappedCell<'_, N, M>,
        dofs: &[usize; M],
    ) -> [f64; M];
}

struct Pressure<'a>(&'a [[f64; 3]]);

impl CellField for Pressure<'_> {
    fn at_dofs<const N: usize, const M: usize>(
        &self,
        cell: &MappedCell<'_, N, M>,
        _: &[usize; M],
    ) -> [f64; M] {
        let (functions, coefficients) = (cell.pressure_functions(), self.0[cell.number]);
        std::array::from_fn(|k| {
            let psi = functions.values(cell.at_dof(k).point);
            psi[0] * coefficients[0] + psi[1] * coefficients[1] + psi[2] * coefficients[2]
        })
    }
}

struct Vorticity<'a>(&'a [Point]);

impl CellField for Vorticity<'_> {
    fn at_dofs<const N: usize, const M: usize>(
        &self,
        cell: &MappedCell<'_, N, M>,
        dofs: &[usize; M],
    ) -> [f64; M] {
        let velocity = dofs.map(|dof| self.0[dof]);
        std::array::from_fn(|k| {
            let gradients = cell.at_dof(k).gradients(&cell.tables.velocity[k].dphi);
            velocity.iter().zip(gradients).map(|([u, v], [x, y])| v * x - u * y).sum()
        })
    }
}

/// Sums over the cells round each dof.
struct Sums<'a> {
    values: &'a mut [f64],
    areas: &'a mut [f64],
}

impl Sums<'_> {
    fn clear(&mut self) {
        self.values.fill(0.0);
        self.areas.fill(0.0);
    }

    fn add<const N: usize, const M: usize>(
        &mut self,
        cell: &MappedCell<'_, N, M>,
        dofs: &[usize; M],
        field: &impl CellField,
    ) {
        for (&dof, value) in dofs.iter().zip(field.at_dofs(cell, dofs)) {
            self.values[dof] += cell.area * value;
            self.areas[dof] += cell.area;
        }
    }

    fn divide(self) {
        for (value, area) in self.values.iter_mut().zip(self.areas) {
            *value /= *area;
        }
    }
}
