//! Which singular values and modes each algorithm resolves, on spectra with known answers.

mod common;

use common::{inner, orthonormal, products, snapshots, with_singular_values};
use faer::Mat;
use lumley_pod::{
    Identity, InnerProduct, Note, Options, ReducedBasis, Truncation, auto, direct,
    method_of_snapshots, svd,
};

const N: usize = 500;
const M: usize = 29;

/// Spectra from 1 to 1e-14.
fn spectra() -> [(&'static str, Vec<f64>); 3] {
    let steps = |k: usize| 10_f64.powf(-0.5 * k as f64);
    let clustered = |k: usize| [1.0, 1e-5, 1e-9, 1e-13][k / 8] * (1.0 + 1e-3 * (k % 8) as f64);
    let mixed = |k: usize| if k < 15 { 1.0 / (1 + k) as f64 } else { steps(2 * (k - 15) + 2) };
    let descending = |f: &dyn Fn(usize) -> f64| {
        let mut sigma: Vec<f64> = (0..M).map(f).filter(|s| *s >= 1e-14).collect();
        sigma.sort_by(|a, b| b.total_cmp(a));
        sigma
    };
    [
        ("graded", descending(&steps)),
        ("clustered", descending(&clustered)),
        ("mixed", descending(&mixed)),
    ]
}

fn ask(modes: usize) -> Options {
    Options { truncation: Truncation::Modes(modes), ..Options::default() }
}

fn orthonormality_defect(basis: &ReducedBasis, w: &dyn InnerProduct) -> f64 {
    let phi = basis.modes.as_ref();
    (inner(w, phi, phi) - Mat::<f64>::identity(basis.size(), basis.size())).norm_max()
}

#[test]
fn svd_resolves_every_spectrum_to_round_off_of_the_first_value() {
    // That of H1 amplifies the round-off of these snapshots: see the tests of noise.
    for (product, w) in products(N).into_iter().filter(|(name, _)| *name != "H1") {
        for (spectrum, sigma) in spectra() {
            let x = with_singular_values(&sigma, (N, M), &*w, 21);
            let basis = svd(&snapshots(x.clone()), &*w, &ask(M)).expect("a decomposition");
            let name = format!("{spectrum}, {product}");
            let resolved = sigma.iter().filter(|s| **s > 6e-15).count();
            assert!(basis.size() >= resolved, "{name}: {} modes of {resolved}", basis.size());
            for (k, (got, known)) in basis.singular_values.iter().zip(&sigma).enumerate() {
                let error = (got - known).abs();
                // The snapshots themselves, products of matrices, have these to about 7 eps.
                let bound = 16.0 * f64::EPSILON;
                assert!(error < bound, "{name}: sigma_{k} = {known:e} is off by {error:e}");
            }
            let defect = orthonormality_defect(&basis, &*w);
            assert!(defect < 1e-12, "{name}: {defect:e}");
            let back = basis.reconstruct(basis.coefficients.as_ref()) - &x;
            let error = inner(&*w, back.as_ref(), back.as_ref()).norm_max().sqrt();
            assert!(error < 2e-14, "{name}: |X - Phi a| = {error:e}");
        }
    }
}

/// Snapshots of a decaying transient: graded columns that are not orthogonal to each other.
#[test]
fn svd_reconstructs_a_decaying_transient() {
    let mut x = common::random_matrix(N, M, 3);
    for (j, column) in x.col_iter_mut().enumerate() {
        column.iter_mut().for_each(|x| *x *= 10_f64.powf(-0.5 * j as f64));
    }
    let w = Identity::new(N);
    let basis = svd(&snapshots(x.clone()), &w, &ask(M)).expect("a decomposition");
    assert!(orthonormality_defect(&basis, &w) < 1e-12);
    let error = (basis.reconstruct(basis.coefficients.as_ref()) - &x).norm_l2();
    let bound = 1e-14 * basis.singular_values[0];
    assert!(error < bound, "{error:e} > {bound:e}");
}

/// A decaying transient whose columns are graded over 15 orders of magnitude, in exact numbers, and its
/// singular values to 20 digits (mpmath, 80 digits): each is right to itself, whatever the order of the
/// snapshots and whatever route the exact one takes to it.
#[test]
fn graded_columns_are_resolved_relative_to_themselves() {
    const EXACT: [f64; 8] = [
        34.669_909_054_708_558,
        0.227_705_463_459_848_44,
        0.001_981_267_453_039_116,
        0.000_013_832_086_593_392_603,
        1.038_200_385_187_812_7e-7,
        9.246_034_534_627_657e-10,
        6.459_573_194_812_127e-12,
        5.086_978_848_255_884e-14,
    ];
    let entry = |i: usize, j: usize| {
        (((i * i * 7 + i * j * 5 + j * 3) % 23) as f64 - 11.0) / (1_u64 << (7 * j)) as f64
    };
    let w = Identity::new(24);
    for order in [[0, 1, 2, 3, 4, 5, 6, 7], [7, 6, 5, 4, 3, 2, 1, 0], [3, 7, 0, 5, 1, 6, 2, 4]] {
        let x = snapshots(Mat::from_fn(24, 8, |i, j| entry(i, order[j])));
        for run in [svd, auto] {
            let basis = run(&x, &w, &ask(8)).expect("a decomposition");
            let resolved =
                basis.singular_values.iter().zip(EXACT).filter(|(_, known)| *known > 3e-14);
            assert!(basis.size() >= 7, "{} modes", basis.size());
            for (got, known) in resolved {
                let error = (got / known - 1.0).abs();
                assert!(error < 1e-13, "{known:e} is off by {error:e}");
            }
            assert!(orthonormality_defect(&basis, &w) < 1e-12);
        }
    }
}

/// The Gram routes see nothing under sqrt(M eps): they say so and return no such mode.
#[test]
fn gram_routes_refuse_modes_under_their_noise() {
    let sigma: Vec<f64> = (0..M).map(|k| 10_f64.powf(-0.5 * k as f64)).collect();
    for (product, w) in products(N) {
        let x = with_singular_values(&sigma, (N, M), &*w, 21);
        for (name, run, order) in
            [("snapshots", method_of_snapshots as fn(&_, &_, &_) -> _, M), ("direct", direct, N)]
        {
            let basis = run(&snapshots(x.clone()), &*w, &ask(M)).expect("a decomposition");
            let kept = basis.size();
            assert!((12..=16).contains(&kept), "{name}, {product}: {kept} modes");
            assert!(matches!(
                basis.notes[..],
                [Note::NoiseFloor { requested: M, kept: k, floor }]
                    if k == kept && floor == basis.noise_floor
            ));
            let noise = order as f64 * f64::EPSILON;
            for (got, known) in basis.singular_values.iter().zip(&sigma) {
                let error = (got / known - 1.0).abs();
                assert!(error < 2.0 * noise / known.powi(2), "{name}: {known:e} off by {error:e}");
            }
            let defect = orthonormality_defect(&basis, &*w);
            assert!(defect < 1e-12, "{name}, {product}: {defect:e}");
        }
    }
}

#[test]
fn auto_takes_the_gram_matrix_while_it_is_exact() {
    let sigma: Vec<f64> = (0..M).map(|k| 10_f64.powf(-0.5 * k as f64)).collect();
    let (_, w) = &products(N)[1];
    let x = snapshots(with_singular_values(&sigma, (N, M), &**w, 21));
    let mut taken = Vec::new();
    for modes in 1..=M {
        let basis = auto(&x, &**w, &ask(modes)).expect("a decomposition");
        let Note::Chosen { algorithm, smallest, bound } = basis.notes[0] else {
            panic!("{:?}", basis.notes)
        };
        assert_eq!(algorithm, basis.algorithm);
        assert_eq!(algorithm == "svd", smallest < bound);
        for (got, known) in basis.singular_values.iter().zip(&sigma) {
            let error = (got / known - 1.0).abs();
            let exact = 1e-6_f64.max(1e-15 / known);
            assert!(error < exact, "{modes} modes: {known:e} is off by {error:e}");
        }
        assert!(orthonormality_defect(&basis, &**w) < 1e-12);
        taken.push(basis.algorithm);
    }
    let first_svd = taken.iter().position(|name| *name == "svd").expect("small modes need svd");
    assert!((6..12).contains(&first_svd), "svd from mode {first_svd}");
    assert!(taken[first_svd..].iter().all(|name| *name == "svd"));
}

/// The same with few unknowns, where the correlation in space is the smaller one.
#[test]
fn auto_takes_the_smaller_correlation() {
    let w = Identity::new(M);
    let sigma: Vec<f64> = (0..M).map(|k| 10_f64.powf(-0.5 * k as f64)).collect();
    let x = snapshots(with_singular_values(&sigma, (M, N), &w, 21));
    for (modes, expected) in [(4, "direct"), (26, "svd")] {
        let basis = auto(&x, &w, &ask(modes)).expect("a decomposition");
        assert_eq!((basis.algorithm, basis.size()), (expected, modes));
        for (got, known) in basis.singular_values.iter().zip(&sigma) {
            let error = (got / known - 1.0).abs();
            assert!(error < 1e-6_f64.max(1e-15 / known), "{known:e} is off by {error:e}");
        }
    }
}

/// Three waves and nothing else: the others asked for are not invented.
#[test]
fn more_modes_than_the_rank_gives_the_rank() {
    let (u, v) = (orthonormal(N, 3, 1), orthonormal(M, 3, 2));
    let x = snapshots(u * v.transpose());
    let w = Identity::new(N);
    for run in [svd, auto] {
        let basis = run(&x, &w, &ask(10)).expect("a decomposition");
        assert_eq!((basis.size(), basis.rank), (3, 3));
        assert_eq!(basis.notes.last(), Some(&Note::Rank { requested: 10, rank: 3 }));
    }
    for run in [method_of_snapshots, direct] {
        let basis = run(&x, &w, &ask(10)).expect("a decomposition");
        assert_eq!(basis.size(), 3);
        assert!(matches!(basis.notes[..], [Note::NoiseFloor { requested: 10, kept: 3, .. }]));
    }
    let few = snapshots(common::random_matrix(N, 4, 1));
    let basis = method_of_snapshots(&few, &w, &ask(10)).expect("a decomposition");
    assert_eq!(basis.notes, [Note::Rank { requested: 10, rank: 4 }]);
}

/// The energy asked for is met by the fewest modes.
#[test]
fn energy_chooses_the_fewest_modes() {
    let x = snapshots(with_singular_values(&[3.0, 2.0, 1.0], (N, M), &Identity::new(N), 2));
    let modes = |fraction: f64| {
        let options = Options { truncation: Truncation::Energy(fraction), ..Options::default() };
        svd(&x, &Identity::new(N), &options).expect("a decomposition").size()
    };
    // Energies 9, 4 and 1 of 14.
    assert_eq!([modes(0.1), modes(0.64), modes(0.65), modes(0.92)], [1, 1, 2, 2]);
    assert_eq!([modes(0.93), modes(0.9999), modes(1.0)], [3, 3, 3]);
}
