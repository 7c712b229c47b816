use super::Piston;
use lumley_fem::{MovingField, Point};

impl Piston {
    /// The global velocity at `x`, in m/s, paper eq. (29): that of the fluid up to the interface, that of
    /// the block beyond; at the wall and before it, that of the wall.
    pub fn velocity_at(&self, x: f64) -> f64 {
        let xi = (x / self.now.interface).max(0.0);
        let fluid = self.mesh.evaluate(&self.reference, &self.now.u, xi);
        fluid.unwrap_or(self.now.velocity())
    }
}

impl MovingField for Piston {
    fn components(&self) -> usize {
        1
    }

    fn nodes(&self) -> usize {
        self.mesh.nodes()
    }

    fn position(&self, node: usize) -> Point {
        [self.reference[node] * self.now.interface, 0.0]
    }

    fn nodal_velocity(&self, node: usize, v: &mut [f64]) {
        v[0] = self.now.u[node];
    }

    fn is_fluid(&self, point: Point) -> bool {
        point[0] <= self.now.interface
    }

    fn fluid_velocity(&self, point: Point, v: &mut [f64]) -> Option<()> {
        let xi = point[0] / self.now.interface;
        v[0] = self.mesh.evaluate(&self.reference, &self.now.u, xi)?;
        Some(())
    }

    fn solid_velocity(&self, _: Point, v: &mut [f64]) {
        v[0] = self.now.velocity();
    }
}
