use super::NodalFields;
use lumley_fem::space::NodalSpace;
use lumley_fem::transfer::{PlanarFlow, PlanarTransfer, TransferError};
use lumley_fem::{Point, UniformGrid};
use lumley_fom::flow::Flow;
use lumley_fom::motion::RigidVelocity;

/// A fixed grid and what is on it.
pub(super) struct View {
    transfer: PlanarTransfer,
    placed: bool,
    /// Pressure and vorticity at the dofs, for a picture.
    scalars: Option<(NodalFields, Vec<Point>)>,
}

impl View {
    /// By a transfer that knows where the mesh is; for a picture with the space of the velocity.
    pub fn new(transfer: PlanarTransfer, picture: Option<&NodalSpace>) -> Self {
        let scalars =
            picture.map(|space| (NodalFields::new(space), vec![[0.0; 2]; space.dofs().len()]));
        Self { transfer, placed: true, scalars }
    }

    pub fn is_of(&self, grid: &UniformGrid, picture: bool) -> bool {
        self.transfer.grid() == grid && self.scalars.is_some() == picture
    }

    /// The mesh is no longer where it was.
    pub fn forget(&mut self) {
        self.placed = false;
    }

    /// The velocity, and for a picture pressure and vorticity behind it; in each solid, its velocity.
    pub fn sample(
        &mut self,
        flow: &Flow,
        solids: &[RigidVelocity],
        out: &mut [f64],
    ) -> Result<(), TransferError> {
        if !self.placed || flow.moves() {
            self.transfer.update(flow.mesh());
            self.placed = true;
        }
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
