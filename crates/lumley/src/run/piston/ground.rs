use super::compare::{Comparison, Snapshots};
use super::simulate::{fixed, full_order};
use crate::Error;
use crate::case::PistonCase;
use crate::model::{Frame, Model};
use crate::run::{BasisFile, grid_product};
use faer::{Mat, MatRef};
use lumley_pod::Kronecker;
use lumley_rom::{Basis, ModelChoice, PistonPhysics, PistonStart, ReducedPiston};
use std::path::Path;

/// Everything the reduced models of a case stand on.
pub(super) struct Ground<'a> {
    pub case: &'a PistonCase,
    /// Modes on the fixed grid.
    fixed: BasisFile,
    /// Modes in the reference frame, where a model needs them.
    reference: Option<BasisFile>,
    /// Reference coordinates of the full-order mesh.
    nodes: Vec<f64>,
    /// Initial global velocity on the fixed grid, and initial u on the reference nodes.
    initial: [Vec<f64>; 2],
    /// The full-order model to compare with.
    pub full: Option<Snapshots>,
    /// L2 on the fixed grid.
    pub product: Kronecker,
    /// Number of modes whose trajectory is kept.
    shown: usize,
}

/// Whether a model lives in the reference frame.
pub(super) fn is_mapped(choice: &ModelChoice) -> bool {
    choice.projection.reference_frame()
}

impl<'a> Ground<'a> {
    /// Takes the bases from `folder`/basis.
    pub(super) fn new(
        case: &'a PistonCase,
        folder: &Path,
        full: Option<Mat<f64>>,
        shown: usize,
    ) -> Result<Self, Error> {
        let folder = folder.join("basis");
        let mapped = case.models.iter().any(is_mapped);
        let reference = mapped.then(|| BasisFile::load(&folder.join("reference.npz")));
        let model = full_order(case)?;
        let product = grid_product(&case.grid, 1);
        let nodes: Vec<f64> = model.nodes().collect();
        let mut initial = [vec![0.0; case.grid.len()], vec![0.0; nodes.len()]];
        model.sample(&fixed(case), &mut initial[0])?;
        model.sample(&Frame::Reference, &mut initial[1])?;
        Ok(Self {
            case,
            fixed: BasisFile::load(&folder.join("fixed.npz"))?,
            reference: reference.transpose()?,
            nodes,
            initial,
            full: full.map(|full| Snapshots::new(full, &product)),
            product,
            shown,
        })
    }

    /// The comparison with the full-order model, if there is one to compare with.
    pub(super) fn comparison(&self) -> Option<Comparison<'_>> {
        let full = self.full.as_ref()?;
        Some(Comparison::new(full, fixed(self.case), &self.product))
    }

    /// Unknowns of the full-order velocity.
    pub(super) fn unknowns(&self) -> usize {
        self.nodes.len()
    }

    fn basis_of(&self, choice: &ModelChoice) -> &BasisFile {
        self.reference.as_ref().filter(|_| is_mapped(choice)).unwrap_or(&self.fixed)
    }

    /// Most modes that a model can have.
    pub(super) fn most_of(&self, choice: &ModelChoice) -> usize {
        self.basis_of(choice).modes.ncols()
    }

    /// Number of modes with which the model's trajectory is kept.
    pub(super) fn shown_of(&self, choice: &ModelChoice) -> usize {
        self.shown.min(self.most_of(choice))
    }

    /// The model with `modes` modes at its initial state.
    pub(super) fn build(&self, choice: &ModelChoice, modes: usize) -> Result<ReducedPiston, Error> {
        let piston = &self.case.piston;
        let basis = self.basis_of(choice);
        let (first, mean) = (basis.modes.as_ref().subcols(0, modes), basis.mean.as_deref());
        let (basis, coefficients) = self.start(choice, first, mean)?;
        let physics = PistonPhysics {
            viscosity: piston.viscosity,
            force_factor: piston.force_factor,
            domain_length: piston.domain_length,
            joint: piston.joint,
        };
        let (position, velocity) = (piston.initial_position, piston.initial_velocity);
        let start = PistonStart { coefficients, position, velocity };
        Ok(ReducedPiston::new(&physics, choice, self.case.integrator, &basis, &start)?)
    }

    /// The basis of the first modes, and the initial velocity projected on it.
    fn start(
        &self,
        choice: &ModelChoice,
        modes: MatRef<'_, f64>,
        mean: Option<&[f64]>,
    ) -> Result<(Basis, Vec<f64>), Error> {
        let [global, fluid] = &self.initial;
        if !is_mapped(choice) {
            let basis = Basis::on_grid(&self.case.grid, modes, mean)?;
            let coefficients = basis.project(global)?;
            return Ok((basis, coefficients));
        }
        let velocity = self.case.piston.initial_velocity;
        let lifted: Vec<f64> =
            self.nodes.iter().zip(fluid).map(|(xi, u)| u - velocity * xi).collect();
        let basis = Basis::on_reference(&self.nodes, self.case.degree, modes, mean)?;
        let coefficients = basis.project(&lifted)?;
        Ok((basis, coefficients))
    }
}
