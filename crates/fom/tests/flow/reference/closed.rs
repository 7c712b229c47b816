//! A domain without an outlet.

use super::assembly::Equations;
use super::conditions::{Hold, along};
use super::plain::{Instant, Plain};
use faer::sparse::Triplet;
use lumley_fom::flow::Condition;

impl Plain {
    /// Where no boundary is free, the mean of the pressure is zero, and what interpolation leaves of the given
    /// velocities' flux is spread over the domain.
    pub fn close(&self, now: &Instant, holds: &[Hold], equations: &mut Equations) {
        if self.conditions.iter().any(|condition| matches!(condition, Condition::TractionFree)) {
            return;
        }
        let first = 2 * holds.len();
        let moments: Vec<f64> = (0..now.mesh.topology().cells())
            .flat_map(|cell| self.moments(&now.mesh, cell))
            .collect();
        let area: f64 = moments.iter().step_by(3).sum();
        let divergence = self.flux(now, holds) / area;
        for (k, moment) in moments.iter().enumerate() {
            equations.right[first + k] += divergence * moment;
        }
        // The mass balance of the first cell follows from the others.
        equations.entries.retain(|entry| entry.row != first);
        equations.right[first] = 0.0;
        let mean = moments.iter().enumerate().map(|(k, &m)| Triplet::new(first, first + k, m));
        equations.entries.extend(mean);
    }

    /// The flux of the given velocities out of the domain, in m²/s.
    fn flux(&self, now: &Instant, holds: &[Hold]) -> f64 {
        let topology = now.mesh.topology();
        let points = topology.boundaries().iter().flat_map(|boundary| along(&now.mesh, boundary));
        let out = points.map(|(edge, at, phi)| {
            let dofs = self.space.dofs().on_edge(topology.edges()[edge].left);
            let parts = dofs.zip(phi).map(|(dof, f)| match holds[dof] {
                Hold::Velocity(u) => f * (u[0] * at.normal[0] + u[1] * at.normal[1]),
                Hold::Free | Hold::Slip(_) => 0.0,
            });
            at.weight * parts.sum::<f64>()
        });
        out.sum()
    }
}
