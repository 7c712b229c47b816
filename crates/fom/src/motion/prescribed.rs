use super::{MeshMotion, Motion, MotionError, RigidMotion};
use lumley_fem::{PlanarMesh, Point};
use std::fmt;
use std::sync::Arc;

/// Where a boundary is at a time, in s.
pub type MotionFunction = Arc<dyn Fn(f64) -> RigidMotion + Send + Sync>;

/// A mesh motion that follows given functions of time.
///
/// ```
/// use lumley_fem::{PlanarMesh, generate::Channel};
/// use lumley_fom::motion::*;
/// use std::sync::Arc;
/// let channel: Channel = toml::from_str(
///     "x = [-2, 4]\ny = [-2, 2]\nsize = 0.5
///      [[bodies]]\nname = 'disc'\nsize = 0.2\nshape = { kind = 'disc', centre = [0, 0], radius = 0.5 }",
/// )?;
/// let mut mesh = PlanarMesh::new(channel.mesh()?)?;
/// let disc = MovingBoundary { name: "disc".into(), pivot: [0.0, 0.0] };
/// let motion = MeshMotion::new(&mesh, &[disc], &MotionParameters::default())?;
/// let heave = |t: f64| RigidMotion { translation: [0.0, 0.5 * t.sin()], angle: 0.0 };
/// let mut prescribed = PrescribedMotion::new(motion, vec![Arc::new(heave)])?;
/// prescribed.carry(0.3, &mut mesh)?;
/// assert_eq!(prescribed.positions(), [heave(0.3)]);
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
}

impl Motion for PrescribedMotion {
    /// Allocates nothing; errors as [`MeshMotion::carry`].
    fn carry(&mut self, time: f64, mesh: &mut PlanarMesh) -> Result<(), MotionError> {
        for (position, function) in self.positions.iter_mut().zip(&self.functions) {
            *position = function(time);
        }
        self.motion.carry(&self.positions, time, mesh)
    }

    fn boundaries(&self) -> Vec<&str> {
        self.motion.boundaries().map(|boundary| boundary.name.as_str()).collect()
    }

    fn pivot(&self, k: usize) -> Point {
        let boundary = self.motion.boundaries().nth(k).expect("a boundary that moves");
        [0, 1].map(|d| boundary.pivot[d] + self.positions[k].translation[d])
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
