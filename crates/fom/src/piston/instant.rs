/// Everything that moves, at one instant. The block's velocity is that of the interface node.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Instant {
    /// Time, in s.
    pub time: f64,
    /// Position X of the interface, in m.
    pub interface: f64,
    /// Nodal velocities of the fluid, in m/s, in the order of the mesh.
    pub u: Vec<f64>,
    /// Their time derivatives at fixed xi, in m/s².
    pub rate: Vec<f64>,
    /// Number of the interface node: the last vertex.
    pub last: usize,
}

impl Instant {
    /// Velocity X' of the block, in m/s.
    pub fn velocity(&self) -> f64 {
        self.u[self.last]
    }

    /// Acceleration X'' of the block, in m/s².
    pub fn acceleration(&self) -> f64 {
        self.rate[self.last]
    }
}

/// How u', u and X follow a correction δ of the unknowns: `u' += rate δ`, `u += state δ`,
/// `X += (state/rate) δV`.
///
/// In a step of time, where `u'₊ = c u₊ + ...` and `V₊ = c X₊ + ...`, the two are c and 1; for the
/// accelerations of a given state, 1 and 0.
#[derive(Debug, Clone, Copy)]
pub(super) struct Variation {
    pub rate: f64,
    pub state: f64,
}

impl Variation {
    /// Of X with V.
    pub fn position(self) -> f64 {
        self.state / self.rate
    }
}
