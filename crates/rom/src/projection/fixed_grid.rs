use super::prefix::PrefixTables;
use super::{Projection, Response, subtract_viscous};
use crate::ReducedError;
use crate::basis::Basis;
use crate::closure::ClosureKind;
use crate::interface::{Interface, Interfacial, ViscousForm};
use crate::piston::{Motion, PistonPhysics};

/// Galerkin system on modes of the global velocity, paper (36)-(38), closed by an interface condition.
///
/// ```text
/// a_n' + sum_mp B_nmp(X) a_m a_p + viscous_n = what the interface condition adds
/// B_nmp = int_0^X Φ_m Φ_p' Φ_n dx
/// ```
///
/// The operators depend on X: an evaluation takes O(N³) by [`PrefixTables`] and allocates nothing.
pub(crate) struct FixedGrid {
    physics: PistonPhysics,
    closure: ClosureKind,
    interface: Box<dyn Interface>,
    tables: PrefixTables,
    frozen: usize,
    at: Interfacial,
    viscous: Vec<f64>,
}

impl FixedGrid {
    /// # Errors
    /// A grid that is not that of the domain; tables too large.
    pub fn new(
        physics: PistonPhysics,
        closure: ClosureKind,
        interface: Box<dyn Interface>,
        basis: &Basis,
    ) -> Result<Self, ReducedError> {
        let upper = basis.nodes()[basis.nodes().len() - 1];
        if (upper - physics.domain_length).abs() > 1e-12 * upper {
            let expected = "a line from 0 to the domain length L";
            return Err(ReducedError::Grid { lower: 0.0, upper, dimension: 1, expected });
        }
        let tables = PrefixTables::new(basis)?;
        let n = basis.width();
        let at = Interfacial {
            mode: vec![0.0; n],
            solid: vec![0.0; n],
            whole: tables.whole_integral().to_vec(),
            velocity: 0.0,
            shear: 0.0,
            body: Motion::default(),
        };
        let mut system = Self {
            physics,
            closure,
            interface,
            tables,
            frozen: basis.frozen(),
            at,
            viscous: vec![0.0; n],
        };
        system.at.whole[..system.frozen].fill(0.0);
        Ok(system)
    }
}

impl Projection for FixedGrid {
    fn rates(&mut self, body: Motion, a: &[f64], rates: &mut [f64]) -> Response {
        self.at.body = body;
        let cut = self.tables.cut(body.position, a, &mut self.at);
        self.at.mode[..self.frozen].fill(0.0);
        self.at.solid[..self.frozen].fill(0.0);

        rates.fill(0.0);
        self.tables.subtract_convection(&cut, a, rates);
        let boundary = match self.interface.viscous_form() {
            ViscousForm::Whole => {
                self.tables.whole_dissipation(a, &mut self.viscous);
                0.0
            }
            ViscousForm::Fluid { boundary } => {
                self.tables.fluid_dissipation(&cut, a, &mut self.viscous);
                boundary * self.at.shear
            }
        };
        for (viscous, mode) in self.viscous.iter_mut().zip(&self.at.mode) {
            *viscous = self.physics.viscosity * (*viscous + boundary * mode);
        }
        subtract_viscous(self.closure, self.frozen, &mut self.viscous, rates);
        self.interface.couple(&self.at, &self.physics, rates)
    }
}
