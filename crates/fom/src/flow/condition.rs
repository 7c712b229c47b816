use super::VectorField;
use std::fmt;
use std::sync::Arc;

/// What holds on a named boundary.
///
/// Where two boundaries meet, no slip counts more than a given velocity, which counts more than slip, and slip more
/// than a free boundary: nothing leaks along a wall. Of two given velocities the one counts whose boundary the mesh
/// names first.
///
/// ```
/// use lumley_fom::flow::Condition;
/// use std::sync::Arc;
/// let inlet = Condition::Velocity(Arc::new(|[_, y]: [f64; 2], _| [y * (1.0 - y), 0.0]));
/// assert_eq!(inlet.name(), "velocity");
/// ```
#[derive(Clone)]
pub enum Condition {
    /// The velocity is given, in m/s.
    Velocity(Arc<dyn VectorField>),
    /// The fluid has the velocity of the boundary, which is zero where it does not move.
    NoSlip,
    /// Nothing flows through and no shear acts: a symmetry line, or a wall far away. On a curved wall the Laplacian
    /// form leaves the shear `μ κ u` of its curvature κ; take the stress form there.
    Slip,
    /// No traction, in the sense of the [`ViscousForm`](super::ViscousForm): an outlet. Where the fluid comes back
    /// in, `ρ ((u − w)·n) u / 2` is taken off, without which the energy of the flow would grow (Bruneau and Fabrie
    /// 1994, Int. J. Numer. Methods Fluids 19, 693-705).
    TractionFree,
    /// The flow goes on at the boundary of that name, which is this one moved as a whole.
    Periodic {
        /// Name of the other boundary.
        with: String,
    },
}

impl Condition {
    /// Its name in a case file.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Velocity(_) => "velocity",
            Self::NoSlip => "no-slip",
            Self::Slip => "slip",
            Self::TractionFree => "traction-free",
            Self::Periodic { .. } => "periodic",
        }
    }

    /// Whether it holds the fluid, which then loads the boundary.
    pub(super) fn holds(&self) -> bool {
        !matches!(self, Self::TractionFree | Self::Periodic { .. })
    }
}

impl fmt::Debug for Condition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Periodic { with } => f.debug_struct("Periodic").field("with", with).finish(),
            other => f.write_str(other.name()),
        }
    }
}
