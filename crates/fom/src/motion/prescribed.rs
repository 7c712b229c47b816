use super::{MeshMotion, MotionError, RigidMotion};
use lumley_fem::PlanarMesh;
use std::fmt;
use std::sync::Arc;

/// Where a boundary is at a time, in s.
pub type MotionFunction = Arc<dyn Fn(f64) -> RigidMotion + Send + Sync>;

/// A mesh motion that follows given functions of time.
///
/// ```
/// use lumley_fem::{MeshDescription, PlanarMesh};
/// use lumley_fom::motion::{MeshMotion, MotionParameters, MovingBoundary, PrescribedMotion, RigidMotion};
/// use std::sync::Arc;
/// // A ring whose inner boundary swings.
/// let ring = |[x, y]: [f64; 2]| {
///     let (sin, cos) = (y * std::f64::consts::FRAC_PI_2).sin_cos();
///     [(1.0 + x) * cos, (1.0 + x) * sin]
/// };
/// # let square = |p| p;
/// # let ring = if false { ring } else { square };
/// let mut mesh = PlanarMesh::new(MeshDescription::structured([4, 8], |_| false, ring))?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone)]
pub struct PrescribedMotion {
    motion: MeshMotion,
    functions: Vec<MotionFunction>,
    positions: Vec<RigidMotion>,
}

impl PrescribedMotion {
    /// A function for each boundary that moves, in their order.
    ///
    /// # Errors
    /// [`MotionError::Positions`] if there are more or fewer.
    pub fn new(motion: MeshMotion, functions: Vec<MotionFunction>) -> Result<Self, MotionError> {
        let (expected, found) = (motion.boundaries().len(), functions.len());
        if expected != found {
            return Err(MotionError::Positions { expected, found });
        }
        Ok(Self { motion, functions, positions: vec![RigidMotion::REST; expected] })
    }

    /// The mesh motion.
    pub fn motion(&self) -> &MeshMotion {
        &self.motion
    }

    /// Where the boundaries were put last.
    pub fn positions(&self) -> &[RigidMotion] {
        &self.positions
    }

    /// Moves the mesh to where the functions want it at a time, in s. Allocates nothing.
    ///
    /// # Errors
    /// As [`MeshMotion::carry`].
    pub fn carry(&mut self, time: f64, mesh: &mut PlanarMesh) -> Result<(), MotionError> {
        for (position, function) in self.positions.iter_mut().zip(&self.functions) {
            *position = function(time);
        }
        self.motion.carry(&self.positions, time, mesh)
    }
}

impl fmt::Debug for PrescribedMotion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("PrescribedMotion")
            .field("motion", &self.motion)
            .field("positions", &self.positions)
            .finish_non_exhaustive()
    }
}
