//! What is published is what is read.

use crate::{BLOCK, Outcome, ROWS, blocks, decomposition, mean, modes, publish, rows_of};
use faer::Mat;
use lumley::format::npz::NpzReader;
use lumley::run::{BasisFile, FileModes};
use lumley_pod::{Alone, ModeStore};
use std::fs;
use std::io;

/// Three threads publish blocks in disorder; the file is what a basis in memory makes of it.
#[test]
fn blocks_in_any_order_make_the_archive() -> Outcome {
    let folder = tempfile::tempdir()?;
    let (store, found) = (FileModes::new(folder.path()), decomposition());
    store.begin(ROWS, 3, true)?;
    let third = ROWS / 3;
    std::thread::scope(|scope| {
        let shares = [0..third, third..2 * third, 2 * third..ROWS];
        let threads = shares.map(|rows| scope.spawn(|| publish(&store, rows)));
        threads.into_iter().try_for_each(|thread| thread.join().expect("no thread panics"))
    })?;
    store.finish(&Alone, &found)?;
    let path = folder.path().join("pod.npz");
    let basis = BasisFile::load(&path)?;
    assert_eq!(basis.modes, modes());
    assert_eq!(basis.mean, Some(mean()));
    assert_eq!(basis.coefficients, found.coefficients);
    let npz = NpzReader::open(&path)?;
    let vectors = [
        ("eigenvalues", &found.eigenvalues),
        ("singular_values", &found.singular_values),
        ("times", &found.times),
        ("time_weights", &found.time_weights),
        ("spectrum", &found.spectrum),
    ];
    for (name, expected) in vectors {
        assert_eq!(&npz.vector(name)?, expected, "{name}");
    }
    let names: Vec<_> = fs::read_dir(folder.path())?.collect::<io::Result<_>>()?;
    assert_eq!(names.len(), 1, "{names:?}");
    Ok(())
}

/// Columns that a killed run wrote are there when it goes on, and gone when it is done.
#[test]
fn a_resumed_run_finds_its_columns() -> Outcome {
    let folder = tempfile::tempdir()?;
    let columns = modes();
    let (first, rest): (Vec<_>, Vec<_>) =
        blocks(0..ROWS).into_iter().partition(|rows| rows.start < 700 * BLOCK);
    let killed = FileModes::new(folder.path());
    killed.reserve(ROWS, 3)?;
    first.iter().try_for_each(|rows| killed.write(rows.clone(), rows_of(&columns, rows)))?;
    killed.sync()?;
    killed.begin(ROWS, 2, false)?;
    killed.publish(9..10, rows_of(&Mat::from_fn(1, 2, |_, _| f64::NAN), &(0..1)), None)?;
    drop(killed);

    let store = FileModes::new(folder.path());
    store.reserve(ROWS, 3)?;
    rest.iter().try_for_each(|rows| store.write(rows.clone(), rows_of(&columns, rows)))?;
    let mut found = Mat::zeros(ROWS, 3);
    store.read(0..ROWS, found.as_mut())?;
    assert_eq!(found, columns);
    store.begin(ROWS, 1, false)?;
    store.publish(0..ROWS, columns.subcols(1, 1), None)?;
    store.finish(&Alone, &decomposition())?;
    let basis = BasisFile::load(&folder.path().join("pod.npz"))?;
    assert_eq!((basis.modes.as_ref(), basis.mean), (columns.subcols(1, 1), None));
    Ok(())
}

/// A file that cannot be made is named.
#[test]
fn a_file_in_the_way_is_named() -> Outcome {
    let folder = tempfile::tempdir()?;
    let store = FileModes::new(folder.path());
    fs::create_dir(folder.path().join("modes.scratch"))?;
    fs::create_dir(folder.path().join("pod.npz.partial"))?;
    let reserved = store.reserve(2, 1).expect_err("a folder is in the way").to_string();
    let begun = store.begin(2, 1, false).expect_err("a folder is in the way").to_string();
    assert!(reserved.contains("modes.scratch"), "{reserved}");
    assert!(begun.contains("pod.npz.partial"), "{begun}");
    Ok(())
}
