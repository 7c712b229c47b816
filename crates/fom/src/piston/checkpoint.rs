use super::Piston;
use crate::{CheckpointError, TimeScheme, checkpoint};
use std::io::{self, Read, Write};

/// First word of every checkpoint: the format and its version.
const MAGIC: u64 = u64::from_le_bytes(*b"lumleyP1");

impl Piston {
    /// Writes a checkpoint: what a piston of the same parameters, mesh and scheme needs to go on from
    /// here, bit for bit.
    ///
    /// # Errors
    /// The failure of the medium.
    pub fn save(&self, to: &mut dyn Write) -> io::Result<()> {
        checkpoint::write(to, &self.identity(), self.state())
    }

    /// Takes up a checkpoint; on an error the piston stays as it was.
    ///
    /// Reads what [`save`](Self::save) wrote and nothing beyond. Forcing is not part of it.
    ///
    /// # Errors
    /// Every variant of [`CheckpointError`].
    pub fn restore(&mut self, from: &mut dyn Read) -> Result<(), CheckpointError> {
        let state = checkpoint::read(from, &self.identity(), self.state().count())?;
        self.take(&state);
        Ok(())
    }

    /// What a checkpoint must agree with.
    fn identity(&self) -> [(&'static str, u64); 11] {
        let p = &self.parameters;
        let scheme = match self.scheme {
            TimeScheme::ImplicitEuler => 0,
            TimeScheme::CrankNicolson => 1,
            TimeScheme::Bdf2 => 2,
        };
        [
            ("format", MAGIC),
            ("number of cells", self.mesh.cells() as u64),
            ("degree", self.mesh.element().degree() as u64),
            ("time scheme", scheme),
            ("viscosity", p.viscosity.to_bits()),
            ("domain length", p.domain_length.to_bits()),
            ("force factor", p.force_factor.to_bits()),
            ("mass", p.joint.mass.to_bits()),
            ("stiffness", p.joint.stiffness.to_bits()),
            ("damping", p.joint.damping.to_bits()),
            ("rest length", p.joint.rest_length.to_bits()),
        ]
    }

    /// Everything that a step reads and a step changes; no step before is a step of zero.
    fn state(&self) -> impl Iterator<Item = f64> + '_ {
        let scalars = [
            self.now.time,
            self.now.interface,
            self.before.interface,
            self.previous_step.unwrap_or(0.0),
            self.traction,
        ];
        let fields = [&self.now.u, &self.now.rate, &self.before.u];
        scalars.into_iter().chain(fields.into_iter().flatten().copied())
    }

    /// Sets what [`state`](Self::state) gives.
    fn take(&mut self, state: &[f64]) {
        let (scalars, fields) = state.split_at(5);
        self.now.time = scalars[0];
        self.now.interface = scalars[1];
        self.before.interface = scalars[2];
        self.previous_step = Some(scalars[3]).filter(|&dt| dt > 0.0);
        self.traction = scalars[4];
        let targets = [&mut self.now.u, &mut self.now.rate, &mut self.before.u];
        for (target, field) in targets.into_iter().zip(fields.chunks(self.mesh.nodes())) {
            target.copy_from_slice(field);
        }
        self.show_body();
    }
}
