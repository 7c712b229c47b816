use super::{Flow, ViscousForm};
use crate::TimeScheme;
use crate::checkpoint::{self, CheckpointError};
use crate::coupling::BodyMotion;
use lumley_fem::Point;
use std::io::{self, Read, Write};

/// First word of every checkpoint: the format and its version.
const MAGIC: u64 = u64::from_le_bytes(*b"lumleyF1");

impl Flow {
    /// Writes a checkpoint: what a flow of the same setup needs to go on from here. The bits are the same if this
    /// flow calls [`forget_factor`](Self::forget_factor), too.
    ///
    /// # Errors
    /// The failure of the medium.
    pub fn save(&self, to: &mut dyn Write) -> io::Result<()> {
        checkpoint::write(to, &self.identity(), self.state())
    }

    /// Takes up a checkpoint; on an error the flow stays as it was.
    ///
    /// # Errors
    /// Every variant of [`CheckpointError`].
    pub fn restore(&mut self, from: &mut dyn Read) -> Result<(), CheckpointError> {
        let state = checkpoint::read(from, &self.identity(), self.state().count())?;
        self.take(&state);
        Ok(())
    }

    /// What a checkpoint must agree with.
    fn identity(&self) -> [(&'static str, u64); 10] {
        let p = &self.parameters;
        let topology = self.mesh.topology();
        [
            ("format", MAGIC),
            ("number of triangles", topology.triangles().len() as u64),
            ("number of quadrilaterals", topology.quadrilaterals().len() as u64),
            ("number of nodes", topology.nodes() as u64),
            ("number of unknowns", self.unknowns.count as u64),
            ("density", p.density.to_bits()),
            ("viscosity", p.viscosity.to_bits()),
            ("time scheme", u64::from(p.scheme == TimeScheme::Bdf2)),
            ("viscous form", u64::from(p.viscous_form == ViscousForm::Laplacian)),
            ("linearisation", p.linearisation as u64),
        ]
    }

    /// Everything that a step reads and a step changes; no step before is a step of zero.
    fn state(&self) -> impl Iterator<Item = f64> + '_ {
        let vectors = self.velocity.iter().chain(&self.nodes).chain([&self.mesh_velocity]);
        let pressures = self.pressure.iter().flatten().flatten();
        let loads = self.loads.iter().flat_map(|l| [l.force[0], l.force[1], l.moment]);
        let optional = |dt: Option<f64>| dt.unwrap_or(0.0);
        let scalars = [
            self.time,
            optional(self.previous),
            self.steps as f64,
            f64::from(self.forced_steps),
            optional(self.wanted_step),
        ];
        scalars
            .into_iter()
            .chain(vectors.flatten().flatten().copied())
            .chain(pressures.copied())
            .chain(loads)
            .chain(self.pivots.iter().flatten().copied())
            .chain(self.bodies.iter().flat_map(BodyMotion::state))
    }

    /// Sets what [`state`](Self::state) gives.
    fn take(&mut self, state: &[f64]) {
        let mut numbers = state.iter().copied();
        let mut next = || numbers.next().expect("as many as were written");
        self.time = next();
        self.previous = Some(next()).filter(|&dt| dt > 0.0);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "counts")]
        {
            self.steps = next() as u64;
            self.forced_steps = next() as u32;
        }
        self.wanted_step = Some(next()).filter(|&dt| dt > 0.0);
        let vectors =
            self.velocity.iter_mut().chain(&mut self.nodes).chain([&mut self.mesh_velocity]);
        for vector in vectors.flatten() {
            *vector = [next(), next()];
        }
        for pressure in self.pressure.iter_mut().flatten() {
            *pressure = [next(), next(), next()];
        }
        for load in &mut self.loads {
            let force: Point = [next(), next()];
            *load = super::Load { force, moment: next() };
        }
        for pivot in &mut self.pivots {
            *pivot = [next(), next()];
        }
        if self.moves() {
            self.mesh.nodes_mut().copy_from_slice(&self.nodes[0]);
            self.follow_slides();
        }
        if let Some(bodies) = &mut self.bodies {
            bodies.restore(self.time, next);
            bodies.show(&mut self.mesh);
        }
        self.places.spread(self.mesh.nodes(), &mut self.work.dof_points);
        self.forget_factor();
    }
}
