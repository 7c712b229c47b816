//! The piston as a moving field, and its transfer to a fixed grid, paper eqs. (27)-(30).

mod canonical;

use lumley_fem::transfer::{Transfer, TransferError};
use lumley_fem::{MovingField, UniformGrid};
use lumley_fom::{Piston, TimeScheme};

const INVERSE: Transfer = Transfer::InverseDistance { power: 2.0, neighbours: 4 };

/// The coupled piston in motion.
fn piston(cells: usize, degree: usize) -> Piston {
    let parameters = canonical::parameters(1.0);
    let mut piston = Piston::new(&parameters, cells, degree, TimeScheme::Bdf2).expect("good");
    for _ in 0..300 {
        piston.step(1e-3).expect("a good step");
    }
    piston
}

fn on_grid(
    method: Transfer,
    piston: &Piston,
    grid: &UniformGrid,
) -> Result<Vec<f64>, TransferError> {
    let mut v = vec![f64::NAN; grid.len()];
    method.transfer(piston, grid, &mut v)?;
    Ok(v)
}

#[test]
fn finite_elements_give_the_global_velocity() -> Result<(), TransferError> {
    let grid = UniformGrid::line(0.0, 1.1, 401);
    for degree in [1, 2] {
        let piston = piston(40, degree);
        for (k, v) in on_grid(Transfer::default(), &piston, &grid)?.into_iter().enumerate() {
            let x = grid.point(k)[0];
            assert_eq!(v, piston.velocity_at(x), "degree {degree}, x = {x}");
            if x >= piston.interface() {
                assert_eq!(v, piston.body().velocity[0]);
            }
        }
    }
    Ok(())
}

/// Against a mesh ten times finer: the error of the elements is the model's own, inverse distance
/// adds hundreds of times as much.
#[test]
fn inverse_distance_is_far_less_accurate() -> Result<(), TransferError> {
    let grid = UniformGrid::line(0.0, 1.1, 401);
    let exact = on_grid(Transfer::default(), &piston(1000, 2), &grid)?;
    let coarse = piston(100, 2);
    let worst = |method| -> Result<f64, TransferError> {
        let v = on_grid(method, &coarse, &grid)?;
        Ok(v.iter().zip(&exact).map(|(v, e)| (v - e).abs()).fold(0.0, f64::max))
    };
    let [elements, inverse] = [worst(Transfer::default())?, worst(INVERSE)?];
    assert!(elements < 2e-6, "{elements:e}");
    assert!((1e-4..1e-3).contains(&inverse), "{inverse:e}");
    Ok(())
}

#[test]
fn nodes_run_from_the_wall_to_the_interface() {
    for degree in [1, 2] {
        let piston = piston(15, degree);
        let nodes: Vec<(f64, f64)> = piston.nodes().zip(piston.velocities()).collect();
        assert_eq!(nodes.len(), MovingField::nodes(&piston));
        assert_eq!(
            (nodes[0], nodes[nodes.len() - 1]),
            ((0.0, 0.0), (1.0, piston.body().velocity[0]))
        );
        assert!(nodes.windows(2).all(|pair| pair[0].0 < pair[1].0), "degree {degree}");
        for (xi, u) in nodes {
            assert!((piston.velocity_at(xi * piston.interface()) - u).abs() < 1e-14, "at {xi}");
        }
    }
}
