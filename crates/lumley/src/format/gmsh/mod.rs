//! Meshes of gmsh: `.msh` files, ASCII or binary, of the versions 2.2 and 4.1, of first and second order.
//!
//! Physical groups of lines are the boundaries. Cells of first order are raised to second with straight
//! edges; quadrilaterals of eight nodes get their centre.

mod assemble;
mod cursor;
mod elements;
mod error;
mod raw;
mod version2;
mod version4;

pub use error::GmshError;

use super::FormatError;
use super::region::Region;
use cursor::Cursor;
use lumley_fem::MeshDescription;
use std::path::Path;

/// Reads a mesh of the plane from a `.msh` file.
///
/// Nodes that no cell uses are dropped; clockwise cells are turned round; groups of lines within the domain
/// are no boundaries and left out. Lengths are taken to be in m. The geometry is not checked further.
///
/// ```
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("triangle.msh");
/// std::fs::write(
///     &path,
///     "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n1 7 \"rim\"\n$EndPhysicalNames\n\
///      $Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n\
///      $Elements\n4\n1 2 2 1 1 1 2 3\n2 1 2 7 1 1 2\n3 1 2 7 1 2 3\n4 1 2 7 1 3 1\n$EndElements\n",
/// )?;
/// let mesh = lumley::format::gmsh::read(&path)?;
/// assert_eq!((mesh.points.len(), mesh.triangles.len()), (6, 1));
/// assert_eq!(mesh.boundaries[0].name, "rim");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`FormatError`]: what stands in the file is not what the format prescribes, with the line or the byte;
/// [`FormatError::Gmsh`]: it is a mesh, but not one of the plane whose rim has names.
pub fn read(path: impl AsRef<Path>) -> Result<MeshDescription, FormatError> {
    let file = Region::open(path.as_ref())?;
    let length = usize::try_from(file.len()).map_err(|_| FormatError::Gmsh {
        path: path.as_ref().to_owned(),
        source: GmshError::TooLong { bytes: file.len() },
    })?;
    let mut bytes = vec![0; length];
    file.read(0, &mut bytes)?;
    let raw = raw::read(&mut Cursor::new(file.path(), &bytes))?;
    drop(bytes);
    assemble::assemble(&raw)
        .map_err(|source| FormatError::Gmsh { path: file.path().to_owned(), source })
}
