use lumley_fem::space::{NodalSpace, Recovery};
use lumley_fom::flow::Flow;

/// Pressure and vorticity of a flow at the dofs of its velocity, for files and pictures.
#[derive(Debug)]
pub(crate) struct NodalFields {
    recovery: Recovery,
    /// In Pa.
    pub pressure: Vec<f64>,
    /// In 1/s.
    pub vorticity: Vec<f64>,
}

impl NodalFields {
    pub fn new(space: &NodalSpace) -> Self {
        let zeros = vec![0.0; space.dofs().len()];
        Self { recovery: Recovery::new(space), pressure: zeros.clone(), vorticity: zeros }
    }

    /// Takes the fields of the flow as it is. Allocates nothing.
    pub fn update(&mut self, flow: &Flow) {
        let (mesh, space) = (flow.mesh(), flow.space());
        self.recovery.pressure(mesh, space, flow.pressure(), &mut self.pressure);
        self.recovery.vorticity(mesh, space, flow.velocity(), &mut self.vorticity);
    }
}
