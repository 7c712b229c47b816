use super::GenerateError;
use super::plane::{add, cross, scale};
use crate::mesh::bernstein::on_triangle;
use crate::{MeshDescription, Point};

/// Whether the reference cells are mapped with positive Jacobian determinants: on triangles everywhere, on
/// quadrilaterals at the nodes.
///
/// # Errors
/// [`GenerateError::Folded`].
pub(super) fn check(mesh: &MeshDescription) -> Result<(), GenerateError> {
    let point = |node: usize| mesh.points[node];
    let triangles = mesh.triangles.iter().map(|t| (on_triangle(&t.map(point)).least, &t[..3]));
    let quadrilaterals =
        mesh.quadrilaterals.iter().map(|q| (of_quadrilateral(q.map(point)), &q[..4]));
    for (least, corners) in triangles.chain(quadrilaterals) {
        let folded = least.is_nan() || least <= 0.0;
        if folded {
            let sum = corners.iter().map(|&node| point(node)).fold([0.0; 2], add);
            return Err(GenerateError::Folded { at: scale(1.0 / corners.len() as f64, sum) });
        }
    }
    Ok(())
}

/// The smallest determinant at the nodes.
fn of_quadrilateral(x: [Point; 9]) -> f64 {
    /// Nodes row by row.
    const ROWS: [[usize; 3]; 3] = [[0, 4, 1], [7, 8, 5], [3, 6, 2]];
    /// The derivative of a quadratic at its nodes.
    const SLOPES: [[f64; 3]; 3] = [[-3.0, 4.0, -1.0], [-1.0, 0.0, 1.0], [1.0, -4.0, 3.0]];
    let slope = |at: usize, nodes: [usize; 3]| {
        let terms = SLOPES[at].into_iter().zip(nodes).map(|(s, node)| scale(s, x[node]));
        terms.fold([0.0; 2], add)
    };
    let places = (0..3).flat_map(|j| (0..3).map(move |i| (i, j)));
    let determinants =
        places.map(|(i, j)| cross(slope(i, ROWS[j]), slope(j, ROWS.map(|row| row[i]))));
    determinants.fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::of_quadrilateral;

    /// Areas of the straight cells, and cells whose middles are pushed too far: past the quarter point the
    /// map of an edge turns back.
    #[test]
    fn determinants_of_simple_cells() {
        let square = |y| {
            [
                [0., 0.],
                [2., 0.],
                [2., 2.],
                [0., 2.],
                [1., y],
                [2., 1.],
                [1., 2.],
                [0., 1.],
                [1., 1.],
            ]
        };
        assert_eq!(of_quadrilateral(square(0.0)), 4.0);
        assert!(of_quadrilateral(square(0.49)) > 0.0 && of_quadrilateral(square(0.7)) < 0.0);
    }
}
