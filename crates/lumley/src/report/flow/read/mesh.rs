//! `mesh.npz`.

use crate::Error;
use crate::format::mesh;
use lumley_fem::PlanarMesh;
use std::path::Path;

/// The mesh in the file; `None` where there is no file.
pub(super) fn read(path: &Path) -> Result<Option<PlanarMesh>, Error> {
    if !path.exists() {
        return Ok(None);
    }
    Ok(Some(mesh::read(path)?))
}
