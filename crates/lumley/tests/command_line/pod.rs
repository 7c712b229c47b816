//! `pod`: snapshots that lumley did not make.

use crate::Desk;
use faer::Mat;
use lumley::format::npy::{write_matrix, write_vector};
use lumley::format::npz::NpzReader;
use lumley::summary::Summary;
use std::f64::consts::PI;

/// 40 snapshots in rows of 60 unknowns, of rank 3: standing waves of falling size.
pub(super) fn waves() -> Mat<f64> {
    Mat::from_fn(40, 60, |k, i| {
        let (t, x) = (k as f64 / 40.0, i as f64 / 59.0);
        let wave = |n: f64| (n * PI * x).sin() * (2.0 * n * PI * t).cos() / n.powi(3);
        wave(1.0) + wave(2.0) + wave(3.0)
    })
}

pub(super) fn desk_with_waves() -> Desk {
    let desk = Desk::new();
    write_matrix(desk.path("x.npy"), waves().as_ref()).expect("a file");
    desk
}

pub(super) fn summary(desk: &Desk, arguments: &[&str]) -> Summary {
    let answer = desk.lumley(&[&["pod", "x.npy", "--json"], arguments].concat()).good();
    serde_json::from_str(&answer.stdout).expect("a summary")
}

#[test]
fn the_archive_holds_an_orthonormal_basis_that_rebuilds_the_snapshots() {
    let desk = desk_with_waves();
    summary(&desk, &["--modes", "3", "--grid", "60", "-o", "out"]);
    let npz = NpzReader::open(desk.path("out/pod.npz")).expect("an archive");
    let read = |name: &str| npz.read(name).expect("an array");
    let (modes, a) = (read("modes"), read("coefficients"));
    assert_eq!((modes.nrows(), modes.ncols(), a.nrows(), a.ncols()), (60, 3, 3, 40));
    let defect = (modes.transpose() * &modes - Mat::<f64>::identity(3, 3)).norm_max();
    assert!(defect < 1e-13, "defect {defect:e}");
    let error = (waves().transpose() - &modes * &a).norm_max();
    assert!(error < 1e-13, "error {error:e}");
    let sigma = npz.vector("singular_values").expect("an array");
    let lambda = npz.vector("eigenvalues").expect("an array");
    for (sigma, lambda) in sigma.iter().zip(lambda) {
        assert!((sigma * sigma - 40.0 * lambda).abs() < 1e-12 * sigma * sigma);
    }
    assert!(desk.path("out/report.html").is_file() && desk.path("out/figures").is_dir());
}

/// Rows or columns, any method: the same singular values.
#[test]
fn layouts_and_methods_agree() {
    let desk = desk_with_waves();
    write_matrix(desk.path("columns.npy"), waves().transpose()).expect("a file");
    let expected = summary(&desk, &["--modes", "3", "-o", "rows"]).pod.singular_values;
    for method in ["snapshots", "direct", "svd"] {
        let found = summary(&desk, &["--modes", "3", "--method", method, "-o", method]);
        for (a, b) in found.pod.singular_values.iter().zip(&expected) {
            assert!((a - b).abs() < 1e-12 * expected[0], "{method}: {a} and {b}");
        }
    }
    let columns = ["pod", "columns.npy", "--snapshots", "columns", "--modes", "3", "--json"];
    let answer = desk.lumley(&columns).good();
    let found: Summary = serde_json::from_str(&answer.stdout).expect("a summary");
    assert_eq!(found.record.snapshots, 40);
    assert!((found.pod.singular_values[0] - expected[0]).abs() < 1e-12);
}

/// Weights of two are snapshots times sqrt 2; the weights of nodes serve every component.
#[test]
fn weights_scale_the_energy() {
    let desk = desk_with_waves();
    write_vector(desk.path("w.npy"), &[2.0; 60]).expect("a file");
    write_vector(desk.path("nodes.npy"), &[2.0; 30]).expect("a file");
    let plain = summary(&desk, &["--modes", "3", "-o", "plain"]).pod.total_energy;
    let weighted = summary(&desk, &["--modes", "3", "--weights", "w.npy", "-o", "weighted"]);
    assert!((weighted.pod.total_energy - 2.0 * plain).abs() < 1e-12);
    let nodes = ["--weights", "nodes.npy", "--components", "2", "-o", "nodes", "--grid", "6,5"];
    assert_eq!(summary(&desk, &nodes).pod.total_energy, weighted.pod.total_energy);
}

/// Unequal steps are weighed by the trapezoid rule, equal ones all alike.
#[test]
fn times_weigh_the_snapshots() {
    let desk = desk_with_waves();
    let equal: Vec<f64> = (0..40).map(|k| 0.25 * f64::from(k)).collect();
    let unequal: Vec<f64> = (0..40).map(|k| f64::from(k * k)).collect();
    write_vector(desk.path("equal.npy"), &equal).expect("a file");
    write_vector(desk.path("unequal.npy"), &unequal).expect("a file");
    let weights = |times: &str| {
        summary(&desk, &["--modes", "3", "--times", times, "-o", &format!("{times}-out")]);
        let npz = NpzReader::open(desk.path(&format!("{times}-out/pod.npz"))).expect("an archive");
        npz.vector("time_weights").expect("an array")
    };
    assert!(weights("equal.npy").iter().all(|w| (w - 1.0 / 40.0).abs() < 1e-15));
    let found = weights("unequal.npy");
    // Half the first step, half of both steps round snapshot 5, over the whole time.
    assert!((found[0] - 0.5 / 1521.0).abs() < 1e-15, "{}", found[0]);
    assert!((found[5] - 10.0 / 1521.0).abs() < 1e-15, "{}", found[5]);
}

#[test]
fn approximations_run_by_name() {
    let desk = desk_with_waves();
    let exact = summary(&desk, &["--modes", "3", "--method", "svd", "-o", "exact"]);
    for method in ["randomized", "incremental"] {
        let found = summary(&desk, &["--modes", "3", "--method", method, "-o", method]);
        assert_eq!(found.pod.method, method);
        let bound = found.pod.error_bound.expect("an approximation");
        assert!((0.0..1e-20).contains(&bound), "{method}: {bound:e}");
        for (a, b) in found.pod.eigenvalues.iter().zip(&exact.pod.eigenvalues) {
            assert!((a - b).abs() < 1e-13, "{method}: {a} and {b}");
        }
        assert_eq!(found.projection.res_percent.len(), 3);
    }
}

#[test]
fn more_modes_than_the_rank_are_the_ranks_with_a_warning() {
    let desk = desk_with_waves();
    let answer =
        desk.lumley(&["pod", "x.npy", "--modes", "30", "--method", "svd", "-o", "out"]).good();
    assert!(
        answer.stderr.contains("warning") && answer.stderr.contains("rank 3"),
        "{}",
        answer.stderr
    );
    assert!(answer.stdout.contains("3 modes"), "{}", answer.stdout);
}

#[test]
fn a_run_and_its_record_are_snapshots_too() {
    let desk = Desk::new();
    desk.quick_run();
    let text = std::fs::read_to_string(desk.path("run/summary.json")).expect("a summary");
    let run: Summary = serde_json::from_str(&text).expect("a summary");
    for (source, out) in [("run", "a"), ("run/record", "b")] {
        let answer = desk.lumley(&["pod", source, "--modes", "6", "--json", "-o", out]).good();
        let found: Summary = serde_json::from_str(&answer.stdout).expect("a summary");
        let relative = found.pod.eigenvalues[0] / run.pod.eigenvalues[0] - 1.0;
        assert!(relative.abs() < 1e-12, "{source}: {relative:e}");
    }
}

#[test]
fn bad_snapshots_are_refused() {
    let desk = desk_with_waves();
    let mut x = waves();
    x[(7, 11)] = f64::NAN;
    write_matrix(desk.path("nan.npy"), x.as_ref()).expect("a file");
    write_matrix(desk.path("zero.npy"), Mat::<f64>::zeros(4, 5).as_ref()).expect("a file");
    let constant = Mat::from_fn(4, 5, |_, i| i as f64);
    write_matrix(desk.path("constant.npy"), constant.as_ref()).expect("a file");
    write_matrix(desk.path("none.npy"), Mat::<f64>::zeros(0, 5).as_ref()).expect("a file");
    write_vector(desk.path("negative.npy"), &[-1.0; 60]).expect("a file");
    write_vector(desk.path("short.npy"), &[1.0; 7]).expect("a file");
    let table: [(&[&str], &[&str]); 14] = [
        (&["x.npy", "--components", "7"], &["--components 7", "divisor"]),
        (&["x.npy", "--components", "0"], &["--components 0", "divisor"]),
        (&["x.npy", "--grid", "6,5,2,1"], &["--grid 6,5,2,1", "one to three"]),
        (&["nan.npy"], &["nan.npy", "snapshot 7", "row 11", "NaN"]),
        (&["zero.npy"], &["zero.npy", "no energy"]),
        (&["constant.npy", "--center"], &["constant.npy", "constant in time"]),
        (&["none.npy"], &["none.npy"]),
        (&["missing.npy"], &["missing.npy"]),
        (&["x.npy", "--weights", "negative.npy"], &["negative.npy", "-1"]),
        (&["x.npy", "--weights", "short.npy"], &["short.npy", "60"]),
        (&["x.npy", "--times", "short.npy"], &["x.npy", "40 snapshots", "7 times"]),
        (&["x.npy", "--grid", "7,8"], &["--grid", "60"]),
        (&["x.npy", "--energy", "1.5"], &["--energy 1.5", "0.9999"]),
        (&["x.npy", "--modes", "0"], &["--modes 0", "at least 1"]),
    ];
    for (arguments, words) in table {
        desk.lumley(&[&["pod"], arguments, &["-o", "out"]].concat()).refused(2, words);
        assert!(!desk.path("out").exists(), "{arguments:?}");
        assert!(!desk.path("out.partial").exists(), "{arguments:?}");
    }
}

#[test]
fn a_pod_directory_is_no_run() {
    let desk = desk_with_waves();
    desk.lumley(&["pod", "x.npy", "-o", "out"]).good();
    desk.lumley(&["report", "out"]).refused(2, &["out", "lumley pod"]);
    desk.lumley(&["rom", "out"]).refused(2, &["out", "lumley run"]);
    assert!(desk.lumley(&["info", "out/pod.npz"]).good().stdout.contains("modes"));
}

/// A run is named after its snapshots, also where these have no name of their own.
#[test]
fn a_run_has_the_name_of_the_snapshots() {
    let desk = Desk::new();
    desk.quick_run();
    for (source, name) in [(".", "run-pod"), ("record", "record-pod"), ("record/..", "run-pod-2")] {
        let mut command = desk.command(&["pod", source, "--modes", "2"]);
        let output = command.current_dir(desk.path("run")).output().expect("lumley starts");
        crate::Answer::of(&output).good();
        assert!(desk.path(&format!("run/runs/{name}/pod.npz")).is_file(), "{source}");
    }
}

/// A header that claims 10^18 numbers in a file of 200 bytes.
#[test]
fn a_hostile_header_is_refused() {
    let desk = Desk::new();
    let dictionary =
        "{'descr': '<f8', 'fortran_order': False, 'shape': (1000000000, 1000000000), }";
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend(118_u16.to_le_bytes());
    bytes.extend(format!("{dictionary:<117}\n").as_bytes());
    bytes.extend([0; 72]);
    desk.write("bomb.npy", &bytes);
    desk.lumley(&["pod", "bomb.npy"]).refused(2, &["bomb.npy", "1000000000", "truncated"]);
}
