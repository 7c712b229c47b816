//! Some snapshots of many, and which of them are finite.

mod common;

use common::{random_matrix, seen, snapshots, times};
use faer::{Mat, Par};
use lumley_pod::{
    Execution, Identity, MemorySnapshots, Options, PodError, Selection, SnapshotSource,
    finite_snapshots, svd,
};
use std::io;
use std::num::NonZeroUsize;
use std::sync::Mutex;

#[test]
fn neighbours_are_read_together() -> io::Result<()> {
    let x = random_matrix(30, 10, 1);
    let (all, asked) = (snapshots(x.clone()), Mutex::new(Vec::new()));
    let watched = seen(&all, |_, cols| {
        asked.lock().expect("no panic").push(cols.clone());
        Ok(())
    });
    let columns = vec![0, 1, 2, 5, 6, 9, 3, 4];
    let some = Selection::new(&watched, columns.clone());
    let expected: Vec<f64> = columns.iter().map(|&j| all.times()[j]).collect();
    assert_eq!(some.times(), expected);
    let mut y = Mat::zeros(7, 6);
    some.block(20..27, 1..7, y.as_mut())?;
    assert_eq!(y, Mat::from_fn(7, 6, |i, j| x[(20 + i, columns[1 + j])]));
    assert_eq!(*asked.lock().expect("no panic"), [1..3, 5..7, 9..10, 3..4]);
    Ok(())
}

/// Bad entries in the first and the last row, in several leaves; entries too large to be squared are finite.
#[test]
fn finite_snapshots_are_found() -> Result<(), PodError> {
    let mut x = random_matrix(20_000, 7, 2);
    x[(0, 6)] = f64::NAN;
    x[(19_999, 0)] = f64::NEG_INFINITY;
    (x[(9_000, 3)], x[(15_000, 3)]) = (f64::INFINITY, f64::NEG_INFINITY);
    x[(5, 4)] = f64::MAX;
    let x = snapshots(x);
    for center in [false, true] {
        let par = Par::Rayon(NonZeroUsize::new(2).expect("two"));
        let time_weights = Some(vec![1e-30; 3]);
        let options = Options { center, par, time_weights, ..Options::default() };
        let finite = finite_snapshots(&x, &options, Execution::default())?;
        assert_eq!(finite, [1, 2, 4, 5]);
    }
    Ok(())
}

/// The rest decomposes as if the bad ones had never been.
#[test]
fn the_rest_is_decomposed() -> Result<(), PodError> {
    let mut x = random_matrix(300, 5, 3);
    x[(17, 2)] = f64::NAN;
    let bad = snapshots(x.clone());
    let finite = finite_snapshots(&bad, &Options::default(), Execution::default())?;
    let kept = Mat::from_fn(300, 4, |i, j| x[(i, finite[j])]);
    let kept = MemorySnapshots::new(kept, finite.iter().map(|&j| times(5)[j]).collect());
    let w = Identity::new(300);
    let of = |x: &dyn SnapshotSource| svd(x, &w, &Options::default());
    let (selected, copied) = (of(&Selection::new(&bad, finite))?, of(&kept)?);
    assert_eq!(selected.modes, copied.modes);
    assert_eq!(selected.eigenvalues, copied.eigenvalues);
    assert_eq!(selected.times, copied.times);
    let none = of(&Selection::new(&bad, Vec::new()));
    assert!(matches!(none, Err(PodError::Empty { unknowns: 300 })), "{none:?}");
    Ok(())
}
