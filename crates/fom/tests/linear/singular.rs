//! Singular and broken matrices are refused.

use crate::oseen::{Grid, Oseen, System, noise};
use faer::Par;
use lumley_fom::linear::{
    Analysis, CellUnknowns, CellUnknownsError, DelayedUnknowns, Multifrontal, Scalar,
    SingularMatrix,
};

fn cavity(cells: usize, viscosity: f64, rate: f64, pin: bool) -> System {
    let wind = |[x, y]: [f64; 2]| [0.5 - y, x - 0.5];
    let grid = Grid { cells: [cells; 2], map: |x| x, periodic: false, outlet: false };
    grid.assemble(&Oseen { viscosity, rate, wind, condensed: true }, pin)
}

fn factorise<T: Scalar>(system: &System) -> Result<(), SingularMatrix> {
    let cells = system.unknowns.clone();
    let analysis = Analysis::new(cells, &system.centroids, &system.delay());
    Multifrontal::<T>::new(analysis, Par::Seq).factorise(&system.matrices)
}

#[test]
fn an_enclosed_flow_needs_a_pinned_pressure() {
    for cells in [2, 5, 16, 33] {
        for (viscosity, rate) in [(1e6, 1e-3), (1.0, 0.0), (1e-3, 1e3), (1e-3, 1e6)] {
            let at = format!("{cells} cells, ν = {viscosity}, 1/dt = {rate}");
            let free = cavity(cells, viscosity, rate, false);
            let error = factorise::<f64>(&free).expect_err(&at);
            assert!(error.pivot <= error.least, "{at}: {error}");
            let pinned = cavity(cells, viscosity, rate, true);
            factorise::<f64>(&pinned).unwrap_or_else(|error| panic!("{at}: {error}"));
            factorise::<f32>(&pinned).unwrap_or_else(|error| panic!("{at}: {error}"));
        }
    }
}

/// A line of springs with both ends free, and one with a row that repeats another.
#[test]
fn dependent_rows_are_found_wherever_they_are() {
    let cells: Vec<_> = (0..200).map(|c| [c, c + 1]).collect();
    let centroids: Vec<_> = (0..200).map(|c| [f64::from(c), 0.0]).collect();
    let line = CellUnknowns::new(201, &cells).expect("a sound numbering");
    let analysis = Analysis::new(line, &centroids, &DelayedUnknowns::default());
    let mut lu = Multifrontal::<f64>::new(analysis, Par::Seq);
    let stiffness = noise(200).into_iter().flat_map(|k| {
        let k = k + 1.0;
        [k, -k, -k, k]
    });
    let mut matrices: Vec<f64> = stiffness.collect();
    let error = lu.factorise(&matrices).expect_err("both ends are free");
    assert!(error.pivot <= error.least && error.unknown <= 200, "{error}");
    matrices[0] += 1.0;
    lu.factorise(&matrices).expect("one end is held");
    for broken in [0.0, f64::NAN, f64::INFINITY] {
        let mut matrices = matrices.clone();
        matrices[4 * 57..4 * 59].fill(broken);
        let error = lu.factorise(&matrices).expect_err("an unknown without equation");
        assert!(error.pivot.is_nan() || error.pivot <= error.least, "{error}");
    }
    lu.factorise(&matrices).expect("a failure leaves no trace");
}

#[test]
#[should_panic(expected = "successful factorisation")]
fn there_is_no_solution_after_a_failure() {
    let one = CellUnknowns::new(1, &[[0]]).expect("a sound numbering");
    let analysis = Analysis::new(one, &[[0.0; 2]], &DelayedUnknowns::default());
    let mut lu = Multifrontal::<f64>::new(analysis, Par::Seq);
    assert!(lu.factorise(&[0.0]).is_err());
    lu.solve(&mut [1.0]);
}

#[test]
fn unsound_numberings_are_refused() {
    let refused = |count, cells: &[&[usize]]| CellUnknowns::new(count, cells).expect_err("unsound");
    assert_eq!(
        refused(2, &[&[0, 1], &[2]]),
        CellUnknownsError::Range { cell: 1, unknown: 2, count: 2 }
    );
    assert_eq!(refused(2, &[&[0, 1, 0]]), CellUnknownsError::Repeated { cell: 0, unknown: 0 });
    assert_eq!(refused(3, &[&[0, 2]]), CellUnknownsError::Unused { unknown: 1 });
}
