//! Meshes as NPZ archives: what a run keeps of its own.
//!
//! `points` (n x 2, in m), `triangles` (6 nodes each: corners, middles of the edges), `quadrilaterals` (9: and
//! the centre), `boundaries/NAME` (3 nodes for each edge: ends and middle); an array of nothing is left out.

use super::FormatError;
use super::npz::{NpzReader, NpzWriter};
use faer::Mat;
use lumley_fem::{MeshDescription, NamedBoundary, PlanarMesh, Point};
use std::path::Path;

/// What the names of the arrays of boundaries begin with.
const BOUNDARIES: &str = "boundaries/";

/// Writes the mesh as it stands.
///
/// ```
/// use lumley::format::mesh;
/// use lumley_fem::{MeshDescription, PlanarMesh};
/// let square = PlanarMesh::new(MeshDescription::structured([2, 2], |[i, _]| i == 1, |p| p))?;
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("mesh.npz");
/// mesh::write(&path, &square)?;
/// assert_eq!(mesh::read(&path)?, square);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`FormatError::Io`].
pub fn write(path: &Path, mesh: &PlanarMesh) -> Result<(), FormatError> {
    let topology = mesh.topology();
    let mut npz = NpzWriter::create(path)?;
    write_points(&mut npz, "points", mesh.nodes())?;
    if !topology.triangles().is_empty() {
        npz.integers("triangles", topology.triangles())?;
    }
    if !topology.quadrilaterals().is_empty() {
        npz.integers("quadrilaterals", topology.quadrilaterals())?;
    }
    for boundary in topology.boundaries() {
        let edges = boundary.edges.iter().map(|&edge| topology.edges()[edge].nodes);
        npz.integers(&format!("{BOUNDARIES}{}", boundary.name), &edges.collect::<Vec<_>>())?;
    }
    npz.finish()
}

/// Reads the mesh that [`write()`] wrote, and checks it.
///
/// # Errors
/// [`FormatError`], naming the file and what is wrong with it.
pub fn read(path: &Path) -> Result<PlanarMesh, FormatError> {
    let npz = NpzReader::open(path)?;
    let names = npz.names().filter_map(|name| name.strip_prefix(BOUNDARIES));
    let boundary = |name: &str| {
        let edges = npz.integers(&format!("{BOUNDARIES}{name}"))?;
        Ok::<_, FormatError>(NamedBoundary { name: name.to_owned(), edges })
    };
    let description = MeshDescription {
        points: read_points(&npz, "points")?,
        triangles: cells(&npz, "triangles")?,
        quadrilaterals: cells(&npz, "quadrilaterals")?,
        boundaries: names.map(boundary).collect::<Result<_, _>>()?,
    };
    PlanarMesh::new(description)
        .map_err(|source| FormatError::Mesh { path: path.to_owned(), source })
}

fn cells<const N: usize>(npz: &NpzReader, name: &str) -> Result<Vec<[usize; N]>, FormatError> {
    if npz.names().any(|known| known == name) { npz.integers(name) } else { Ok(Vec::new()) }
}

/// Writes points, or vectors, as the rows of a matrix.
pub(crate) fn write_points(
    npz: &mut NpzWriter,
    name: &str,
    points: &[Point],
) -> Result<(), FormatError> {
    npz.matrix(name, Mat::from_fn(points.len(), 2, |i, d| points[i][d]).as_ref())
}

/// Reads what [`write_points`] wrote.
pub(crate) fn read_points(npz: &NpzReader, name: &str) -> Result<Vec<Point>, FormatError> {
    let array = npz.matrix(name)?;
    if array.cols() != 2 {
        let (path, shape) = (array.path().to_owned(), array.shape().to_vec());
        return Err(FormatError::Shape { path, shape, expected: "rows of x and y" });
    }
    let x = array.read()?;
    Ok((0..x.nrows()).map(|i| [x[(i, 0)], x[(i, 1)]]).collect())
}

#[cfg(test)]
mod tests {
    use super::{read, write};
    use crate::format::FormatError;
    use crate::format::npz::NpzWriter;
    use lumley_fem::{MeshDescription, PlanarMesh};

    type Outcome = Result<(), Box<dyn std::error::Error>>;

    #[test]
    fn meshes_of_one_kind_of_cells_are_read_back() -> Outcome {
        let folder = tempfile::tempdir()?;
        let path = folder.path().join("mesh.npz");
        for cut in [true, false] {
            let bend = |[x, y]: [f64; 2]| [x + 0.1 * y * y, y];
            let mesh = PlanarMesh::new(MeshDescription::structured([3, 2], |_| cut, bend))?;
            write(&path, &mesh)?;
            assert_eq!(read(&path)?, mesh);
        }
        Ok(())
    }

    #[test]
    fn what_is_no_mesh_is_refused() -> Outcome {
        let folder = tempfile::tempdir()?;
        let path = folder.path().join("mesh.npz");
        let archive = |cell: [usize; 6]| -> Outcome {
            let mut npz = NpzWriter::create(&path)?;
            npz.matrix("points", faer::mat![[0.0, 0.0], [1.0, 0.0]].as_ref())?;
            npz.integers("triangles", &[cell])?;
            Ok(npz.finish()?)
        };
        archive([0, 1, 2, 3, 4, 5])?;
        assert!(matches!(read(&path), Err(FormatError::Mesh { .. })));
        let mut npz = NpzWriter::create(&path)?;
        npz.matrix("points", faer::mat![[0.0, 0.0], [1.0, 0.0]].as_ref())?;
        npz.matrix("triangles", faer::mat![[0.0, 1.5, 2.0, 3.0, 4.0, 5.0]].as_ref())?;
        npz.finish()?;
        assert!(matches!(read(&path), Err(FormatError::Shape { .. })));
        Ok(())
    }
}
