//! `pod --update`: snapshots that come after a basis was made.

use crate::Desk;
use crate::pod::{desk_with_waves, summary, waves};
use faer::Mat;
use lumley::format::npy::{write_matrix, write_vector};
use lumley::format::npz::{NpzReader, NpzWriter};
use lumley::summary::Summary;
use std::ops::Range;

/// Rows of the waves in a file of their own.
fn part(desk: &Desk, name: &str, rows: Range<usize>) {
    let part = waves().subrows(rows.start, rows.len()).to_owned();
    write_matrix(desk.path(name), part.as_ref()).expect("a file");
}

/// A second file, to a basis of all modes, makes the POD of both files, with the mean as it was before.
#[test]
fn a_basis_is_updated_by_another_file() {
    let desk = desk_with_waves();
    part(&desk, "a.npy", 0..25);
    part(&desk, "b.npy", 25..40);
    for (mean, name) in [(&["--center"][..], "centred"), (&[], "plain")] {
        let [whole, old, new] = ["whole", "old", "new"].map(|run| format!("{name}-{run}"));
        let exact = ["--method", "svd", "--modes", "3", "-o", &whole];
        let exact = summary(&desk, &[mean, &exact].concat());
        assert_eq!(exact.pod.error_bound, None);
        let first = ["pod", "a.npy", "--method", "svd", "--modes", "3", "-o", &old];
        desk.lumley(&[&first, mean].concat()).good();
        let second = ["pod", "b.npy", "--update", &old, "--modes", "3", "--json", "-o", &new];
        let found: Summary =
            serde_json::from_str(&desk.lumley(&second).good().stdout).expect("a summary");
        assert!(found.pod.error_bound.expect("an approximation") < 1e-25, "{name}");
        assert_eq!((found.pod.method.as_str(), found.record.snapshots), ("incremental", 40));
        assert!(found.projection.res_percent.is_empty(), "the old snapshots are not at hand");
        let archive = |run: &str| NpzReader::open(desk.path(run).join("pod.npz")).expect("a file");
        let (npz, expected) = (archive(&new), archive(&whole));
        for array in ["modes", "coefficients", "eigenvalues", "singular_values", "time_weights"] {
            let [a, b] = [&npz, &expected].map(|npz| npz.read(array).expect("an array"));
            assert!((a - b).norm_max() < 1e-12, "{name}: {array}");
        }
        assert_eq!(npz.vector("times").expect("times"), expected.vector("times").expect("times"));
        assert_eq!(npz.names().any(|array| array == "mean"), name == "centred");
        let read = |file: &str| std::fs::read_to_string(desk.path(&new).join(file)).expect("text");
        assert!(read("manifest.json").contains(&format!("{old}/pod.npz")));
        assert!(read("report.html").contains("error bound"));
    }
}

/// What a truncated basis left out is the bound, from file to file; every eigenvalue keeps to it.
#[test]
fn what_was_truncated_is_the_error_bound() {
    let desk = desk_with_waves();
    for (name, rows) in [("a.npy", 0..20), ("b.npy", 20..30), ("c.npy", 30..40)] {
        part(&desk, name, rows);
    }
    let exact = summary(&desk, &["--method", "svd", "--modes", "3", "-o", "exact"]).pod.eigenvalues;
    let run = |arguments: &[&str]| -> Summary {
        let answer =
            desk.lumley(&[&["pod"], arguments, &["--modes", "2", "--json"]].concat()).good();
        serde_json::from_str(&answer.stdout).expect("a summary")
    };
    let left = |found: &Summary| found.pod.total_energy - found.pod.eigenvalues.iter().sum::<f64>();
    let close = |a: f64, b: f64| (a - b).abs() < 1e-13;
    let a = run(&["a.npy", "--method", "svd", "-o", "a"]);
    assert!(left(&a) > 1e-4, "something is left out: {:e}", left(&a));
    let b = run(&["b.npy", "--update", "a/pod.npz", "-o", "b"]);
    let bound = b.pod.error_bound.expect("an approximation");
    assert!(close(bound, left(&a) * 20.0 / 30.0), "{bound:e} of {:e}", left(&a));
    let c = run(&["c.npy", "--update", "b", "--method", "incremental", "-o", "c"]);
    let bound = c.pod.error_bound.expect("an approximation");
    assert!(close(bound, left(&b) * 30.0 / 40.0), "{bound:e} of {:e}", left(&b));
    for (found, exact) in c.pod.eigenvalues.iter().zip(&exact) {
        assert!(*found <= exact + 1e-14 && exact - found <= bound, "{found} and {exact}");
    }
    let again = ["pod", "c.npy", "--update", "b", "--modes", "2", "-o", "again"];
    let said = desk.lumley(&again).good().stdout;
    assert!(said.contains(&format!("error bound {bound:.1e}")), "{said}");
}

#[test]
fn a_basis_that_does_not_fit_is_refused() {
    let desk = desk_with_waves();
    desk.lumley(&["pod", "x.npy", "--modes", "3", "-o", "old"]).good();
    write_matrix(desk.path("short.npy"), waves().subcols(0, 50)).expect("a file");
    write_vector(desk.path("w.npy"), &[2.0; 60]).expect("a file");
    let forged = |name: &str, lambda: &[f64], rows: usize, times: [f64; 2]| {
        let mut npz = NpzWriter::create(desk.path(name)).expect("a file");
        npz.matrix("modes", Mat::<f64>::identity(60, 2).as_ref()).expect("written");
        npz.matrix("coefficients", Mat::<f64>::zeros(rows, 2).as_ref()).expect("written");
        for array in ["eigenvalues", "singular_values", "spectrum"] {
            npz.vector(array, lambda).expect("written");
        }
        for (array, values) in [("times", times), ("time_weights", [0.5, 0.5])] {
            npz.vector(array, &values).expect("written");
        }
        for array in ["noise_floor", "total_energy"] {
            npz.vector(array, &[0.0]).expect("written");
        }
        npz.finish().expect("written");
    };
    forged("negative.npz", &[1.0, -1.0], 2, [0.0, 1.0]);
    forged("three.npz", &[2.0, 1.0, 0.5], 2, [0.0, 1.0]);
    forged("rows.npz", &[2.0, 1.0], 3, [0.0, 1.0]);
    forged("never.npz", &[2.0, 1.0], 2, [0.0, f64::NAN]);
    forged("back.npz", &[2.0, 1.0], 2, [1.0, 1.0]);
    let times: Vec<f64> = (0..40).map(|k| 0.01 * f64::from(k)).collect();
    write_vector(desk.path("t.npy"), &times).expect("a file");
    let table: [(&[&str], &[&str]); 14] = [
        (&["x.npy", "--update", "never.npz"], &["never.npz", "array times", "increasing"]),
        (&["x.npy", "--update", "back.npz"], &["back.npz", "array times", "increasing"]),
        (
            &["x.npy", "--update", "old", "--times", "t.npy"],
            &["--times t.npy from 0 s on", "after those of the old basis, which ends at 39 s"],
        ),
        (&["short.npy", "--update", "old"], &["short.npy", "50 unknowns", "modes have 60"]),
        (&["x.npy", "--update", "x.npy"], &["x.npy", "NPZ archive"]),
        (&["x.npy", "--update", "none"], &["none"]),
        (&["x.npy", "--update", "."], &["pod.npz"]),
        (&["x.npy", "--update", "negative.npz"], &["negative.npz", "eigenvalues", "no negative"]),
        (&["x.npy", "--update", "three.npz"], &["three.npz/eigenvalues", "one number for each"]),
        (&["x.npy", "--update", "rows.npz"], &["rows.npz/coefficients", "a row for each mode"]),
        (&["x.npy", "--update", "old", "--center"], &["old/pod.npz", "--center"]),
        (&["x.npy", "--update", "old", "--method", "svd"], &["--method svd", "incremental"]),
        (&["x.npy", "--update", "old", "--weights", "w.npy"], &["old basis", "inner product"]),
        (&["x.npy", "--update", "old", "-o", "old", "--force"], &["--update old", "outside"]),
    ];
    for (arguments, words) in table {
        let output: &[&str] = if arguments.contains(&"-o") { &[] } else { &["-o", "out"] };
        desk.lumley(&[&["pod"], arguments, output].concat()).refused(2, words);
        assert!(!desk.path("out").exists(), "{arguments:?}");
        assert!(!desk.path("out.partial").exists(), "{arguments:?}");
    }
    assert!(desk.path("old/pod.npz").is_file());
}

/// Numbers stand in the place of times: none comes twice, also where an old snapshot was left out.
#[test]
fn times_go_on_from_the_last_old_one() {
    let desk = desk_with_waves();
    part(&desk, "b.npy", 25..40);
    let mut a = waves().subrows(0, 25).to_owned();
    a[(3, 7)] = f64::INFINITY;
    write_matrix(desk.path("a.npy"), a.as_ref()).expect("a file");
    desk.lumley(&["pod", "a.npy", "--skip-non-finite", "--modes", "3", "-o", "old"]).good();
    desk.lumley(&["pod", "b.npy", "--update", "old", "--modes", "3", "-o", "new"]).good();
    let npz = NpzReader::open(desk.path("new/pod.npz")).expect("a file");
    let expected: Vec<f64> = (0..40).filter(|k| *k != 3).map(f64::from).collect();
    assert_eq!(npz.vector("times").expect("times"), expected);
}

/// An unfinished update goes on with the old basis that it was begun with, and with no other.
#[test]
fn the_old_basis_is_an_input() {
    let desk = desk_with_waves();
    for (old, modes) in [("one", "1"), ("two", "2")] {
        desk.lumley(&["pod", "x.npy", "--modes", modes, "-o", old]).good();
    }
    let update = |old: &str, resume: &[&str]| {
        desk.lumley(&[&["pod", "x.npy", "--update", old, "-o", "out"], resume].concat())
    };
    update("one", &[]).good();
    let whole = std::fs::read(desk.path("out/pod.npz")).expect("modes");
    std::fs::rename(desk.path("out"), desk.path("out.partial")).expect("as if it were unfinished");
    update("two", &["--resume"]).refused(2, &["was begun with other snapshots"]);
    update("one", &["--resume"]).good();
    assert!(std::fs::read(desk.path("out/pod.npz")).expect("modes") == whole);
}
