use super::MotionError;
use lumley_fem::{PlanarMesh, Point};

/// How the nodes of a flow's mesh move in time.
///
/// ```
/// use lumley_fem::{PlanarMesh, Point};
/// use lumley_fom::motion::{Motion, MotionError};
/// /// A mesh that breathes, for a test.
/// struct Breathing(Vec<Point>);
/// impl Motion for Breathing {
///     fn carry(&mut self, time: f64, mesh: &mut PlanarMesh) -> Result<(), MotionError> {
///         for (node, reference) in mesh.nodes_mut().iter_mut().zip(&self.0) {
///             *node = reference.map(|x| x * (1.0 + 0.1 * time.sin()));
///         }
///         Ok(())
///     }
///     fn boundaries(&self) -> Vec<&str> {
///         Vec::new()
///     }
///     fn pivot(&self, _: usize) -> Point {
///         unreachable!("there are no boundaries that move")
///     }
/// }
/// ```
pub trait Motion: Send + Sync {
    /// Moves the nodes to where they are at `time`, in s, and makes sure that the cells survive it.
    ///
    /// # Errors
    /// [`MotionError`]; the mesh is then of no use.
    fn carry(&mut self, time: f64, mesh: &mut PlanarMesh) -> Result<(), MotionError>;

    /// The boundaries that move.
    fn boundaries(&self) -> Vec<&str>;

    /// Where the pivot of the k-th of them is, in m.
    fn pivot(&self, k: usize) -> Point;
}
