use super::wet::Wet;
use faer::{Mat, Side};
use lumley_body::{Equations, Kinematics, Tree};

/// The added mass of the bodies over their own: the largest `λ` of `M_a x = λ M x` with
///
/// ```text
/// M_a = ρ sum over wet bodies of area J_Gᵀ J_G,
/// ```
///
/// the mass of the fluid that each displaces, which is the added mass of a disc in an unbounded fluid. A load of the
/// step before changes velocities by −λ of how they changed in that step. Prescribed coordinates have no part in it.
pub(super) fn share(tree: &Tree, kinematics: &Kinematics, wet: &[Wet], density: f64) -> f64 {
    let mut equations = Equations::new(tree);
    equations.assemble(kinematics, &[]);
    let n = tree.coordinates().len();
    // The tangent with weight 1 has unit rows for what is prescribed; of it only the mass is wanted.
    let mut mass = equations.mass().clone();
    for (k, coordinate) in tree.coordinates().iter().enumerate() {
        if coordinate.prescribed {
            mass.unit_row(k);
        }
    }
    let mut rows = Vec::new();
    for wet in wet {
        let weight = (density * wet.area).sqrt();
        for d in 0..2 {
            let mut row = vec![0.0; n];
            for column in kinematics.jacobian(wet.body, wet.centroid) {
                if !tree.coordinates()[column.coordinate].prescribed {
                    row[column.coordinate] = weight * column.velocity[d];
                }
            }
            rows.push(row);
        }
    }
    let columns: Option<Vec<Vec<f64>>> = rows
        .iter()
        .map(|row| {
            let mut column = row.clone();
            mass.clone().solve(&mut column).ok().map(|()| column)
        })
        .collect();
    // Without inertia there is no limit to how much more the fluid has.
    let Some(columns) = columns else { return f64::INFINITY };
    let product =
        |i: usize, j: usize| -> f64 { rows[i].iter().zip(&columns[j]).map(|(a, b)| a * b).sum() };
    let matrix = Mat::from_fn(rows.len(), rows.len(), product);
    let eigenvalues = matrix.self_adjoint_eigenvalues(Side::Lower);
    eigenvalues.map_or(f64::INFINITY, |found| found.into_iter().fold(0.0, f64::max))
}
