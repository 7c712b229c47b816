use crate::sample::{self, Lcg, Outcome, append, description, files, matrix, time};
use faer::Mat;
use lumley::record::{Quantity, Record, RecordError, RecordWriter, Snapshot, Support};
use lumley_pod::SnapshotSource;
use std::path::Path;

fn check(path: &Path, nodes: [usize; 2], count: usize) -> Outcome {
    let record = Record::open(path)?;
    assert_eq!(record.len(), count);
    assert_eq!(record.times(), (0..count).map(time).collect::<Vec<_>>());
    let vectors = record.description().series.clone();
    for (which, series) in vectors.iter().enumerate() {
        let expected = matrix(which, series.entries.len(), count);
        for k in 0..count {
            assert_eq!(record.series(&series.name)?.at(k), expected.col_as_slice(k));
        }
    }
    for (which, (name, rows)) in
        [("fixed", 2 * nodes[0] * nodes[1]), ("reference", 3)].iter().enumerate()
    {
        let frame = record.frame(name)?;
        let mut x = Mat::zeros(*rows, count);
        frame.block(0..*rows, 0..count, x.as_mut())?;
        assert_eq!(x, matrix(vectors.len() + which, *rows, count), "{name}");
    }
    record.verify()?;
    Ok(())
}

/// Bit for bit, over several chunks in both directions, and the description with it.
#[test]
fn what_is_read_is_what_was_written() -> Outcome {
    let folder = tempfile::tempdir()?;
    for (case, (nodes, count)) in
        [([5, 4], 0), ([5, 4], 1), ([5, 4], 600), ([40, 30], 257)].into_iter().enumerate()
    {
        let path = folder.path().join(case.to_string());
        let written = sample::record(&path, nodes, count)?;
        assert_eq!(*Record::open(&path)?.description(), written);
        check(&path, nodes, count)?;
    }
    Ok(())
}

/// Blocks at random places equal those of the matrix in memory, also into a transposed target.
#[test]
fn blocks_are_those_of_the_matrix() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("record");
    sample::record(&path, [40, 30], 300)?;
    let frame = Record::open(&path)?.frame("fixed")?;
    let x = matrix(2, 2400, 300);
    let mut lcg = Lcg(1);
    for _ in 0..200 {
        let (row, col) = (lcg.below(2400), lcg.below(300));
        let (rows, cols) = (lcg.below(2401 - row), lcg.below(301 - col));
        let expected = x.submatrix(row, col, rows, cols);
        let mut out = Mat::zeros(rows, cols);
        frame.block(row..row + rows, col..col + cols, out.as_mut())?;
        assert_eq!(out, expected);
        let mut out = Mat::zeros(cols, rows);
        frame.block(row..row + rows, col..col + cols, out.as_mut().transpose_mut())?;
        assert_eq!(out.transpose(), expected);
    }
    Ok(())
}

/// Threads that share a reader see the same numbers.
#[test]
fn threads_share_a_reader() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("record");
    sample::record(&path, [40, 30], 300)?;
    let frame = Record::open(&path)?.frame("fixed")?;
    let x = matrix(2, 2400, 300);
    std::thread::scope(|scope| {
        for k in 0..4 {
            let (frame, x) = (&frame, &x);
            scope.spawn(move || {
                for first in (k * 20..2400 - 100).step_by(80) {
                    let mut out = Mat::zeros(100, 300);
                    frame.block(first..first + 100, 0..300, out.as_mut()).expect("a sound record");
                    assert_eq!(out, x.subrows(first, 100));
                }
            });
        }
    });
    Ok(())
}

/// A record made in pieces is the record made at once, file by file.
#[test]
fn pieces_make_the_same_files() -> Outcome {
    let folder = tempfile::tempdir()?;
    let (whole, pieces) = (folder.path().join("whole"), folder.path().join("pieces"));
    let description = sample::record(&whole, [5, 4], 600)?;
    drop(RecordWriter::create(&pieces, &description)?);
    for range in [0..3, 3..256, 256..257, 257..512, 512..600] {
        let mut writer = RecordWriter::open(&pieces)?;
        assert_eq!(writer.len(), range.start);
        assert_eq!(writer.last_time(), range.start.checked_sub(1).map(time));
        append(&mut writer, &description, range)?;
        writer.finish()?;
    }
    assert_eq!(contents(&whole)?, contents(&pieces)?);
    Ok(())
}

/// Cut back to any length and grown again, it is the record that never was longer.
#[test]
fn truncated_and_grown_again() -> Outcome {
    let folder = tempfile::tempdir()?;
    let whole = folder.path().join("whole");
    let description = sample::record(&whole, [5, 4], 600)?;
    for count in [0, 1, 255, 256, 257, 512, 599, 600] {
        let path = folder.path().join(count.to_string());
        let mut writer = RecordWriter::create(&path, &description)?;
        append(&mut writer, &description, 0..600)?;
        writer.truncate(count)?;
        check(&path, [5, 4], count)?;
        assert_eq!((writer.len(), writer.last_time()), (count, count.checked_sub(1).map(time)));
        append(&mut writer, &description, count..600)?;
        writer.finish()?;
        assert_eq!(contents(&whole)?, contents(&path)?, "cut at {count}");
    }
    let error = RecordWriter::open(&whole)?.truncate(601).expect_err("there are 600");
    assert!(matches!(error, RecordError::TooFew { count: 601, len: 600 }), "{error}");
    Ok(())
}

/// Killed between chunks and commit: what was committed stands, the rest and half-written files count for nothing.
#[test]
fn killed_before_the_commit() -> Outcome {
    let folder = tempfile::tempdir()?;
    let (path, whole) = (folder.path().join("record"), folder.path().join("whole"));
    let description = sample::record(&path, [5, 4], 250)?;
    let committed = std::fs::read(path.join("zarr.json"))?;
    let mut writer = RecordWriter::open(&path)?;
    append(&mut writer, &description, 250..600)?;
    writer.finish()?;
    std::fs::write(path.join("zarr.json"), committed)?;
    for stray in
        ["time/c/.0.1-1.tmp", "frames/fixed/values/c/0/.0.1-2.tmp", "time/.zarr.json.1-3.tmp"]
    {
        std::fs::write(path.join(stray), b"half")?;
    }
    check(&path, [5, 4], 250)?;
    let mut writer = RecordWriter::open(&path)?;
    assert_eq!(writer.len(), 250);
    append(&mut writer, &description, 250..300)?;
    writer.finish()?;
    check(&path, [5, 4], 300)?;
    sample::record(&whole, [5, 4], 300)?;
    assert_eq!(contents(&whole)?, contents(&path)?);
    Ok(())
}

/// Readers see nothing that was not flushed, and no more than whole snapshots.
#[test]
fn visible_when_committed() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("record");
    let description = description([5, 4]);
    let mut writer = RecordWriter::create(&path, &description)?;
    append(&mut writer, &description, 0..10)?;
    check(&path, [5, 4], 0)?;
    writer.flush()?;
    check(&path, [5, 4], 10)?;
    append(&mut writer, &description, 10..257)?;
    check(&path, [5, 4], 256)?;
    Ok(())
}

/// Thousands of loads, whose names make long descriptions.
#[test]
fn long_series() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("record");
    let mut description = description([2, 2]);
    description.series.truncate(1);
    description.series[0].entries =
        (0..4000).map(|k| Quantity::new(format!("load {k}"), "N")).collect();
    let mut writer = RecordWriter::create(&path, &description)?;
    append(&mut writer, &description, 0..2)?;
    writer.finish()?;
    let record = Record::open(&path)?;
    assert_eq!(
        (record.description(), record.series("position")?.at(1).len()),
        (&description, 4000)
    );
    Ok(())
}

/// A refused snapshot leaves the writer as it was.
#[test]
fn impossible_snapshots_are_refused() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("record");
    let description = description([5, 4]);
    let mut writer = RecordWriter::create(&path, &description)?;
    append(&mut writer, &description, 0..3)?;
    let (mut field, nodes) = (vec![0.0; 40], [0.0; 3]);
    let angles: &[&[f64]] = &[&[0.0, 0.0], &[1.0]];
    field[7] = f64::INFINITY;
    let mut refuse = |time, series, fields: &[&[f64]]| {
        writer.append(&Snapshot { time, series, fields }).expect_err("must be refused")
    };
    let error = refuse(1.0, angles, &[&field, &nodes]);
    assert!(matches!(error, RecordError::NonFinite { snapshot: 3, index: 7, .. }), "{error}");
    assert!(error.to_string().contains("frames/fixed") && error.to_string().contains("at 1 s"));
    let error = refuse(1.0, &[&[0.0, f64::NAN], &[1.0]], &[&field, &nodes]);
    assert!(error.to_string().contains("series/position"), "{error}");
    for time in [time(2), f64::NAN, f64::INFINITY, -1.0] {
        let error = refuse(time, angles, &[&field, &nodes]);
        assert!(matches!(error, RecordError::TimeOrder { snapshot: 3, .. }), "{error}");
    }
    let error = refuse(1.0, angles, &[&field[1..], &nodes]);
    assert!(matches!(error, RecordError::Shape { found: 39, expected: 40, .. }), "{error}");
    let error = refuse(1.0, angles, &[&nodes]);
    assert!(matches!(error, RecordError::Shape { found: 1, expected: 2, .. }), "{error}");
    append(&mut writer, &description, 3..5)?;
    writer.finish()?;
    check(&path, [5, 4], 5)
}

/// What stands in the way is not touched, and names that are paths make no record.
#[test]
fn impossible_records_are_refused() -> Outcome {
    let folder = tempfile::tempdir()?;
    std::fs::write(folder.path().join("thesis.txt"), b"precious")?;
    let sound = description([5, 4]);
    for taken in [folder.path().to_owned(), folder.path().join("thesis.txt")] {
        let error = RecordWriter::create(&taken, &sound).expect_err("it is taken");
        assert!(matches!(error, RecordError::Exists { .. }), "{error}");
    }
    let path = folder.path().join("record");
    for name in ["", "..", "a/b", "a b", "ä", &"a".repeat(65)] {
        let mut description = sound.clone();
        name.clone_into(&mut description.frames[0].name);
        let error = RecordWriter::create(&path, &description).expect_err("a wrong name");
        assert!(matches!(error, RecordError::Invalid { .. }), "{error}");
    }
    let mut twice = sound.clone();
    twice.frames[1].name = "fixed".into();
    let mut nowhere = sound.clone();
    nowhere.frames[1].support = Support::Nodes(vec![[0.0, f64::NAN]]);
    let mut nothing = sound.clone();
    nothing.series[0].entries.clear();
    let mut empty = sound;
    empty.frames.clear();
    for description in [twice, nowhere, nothing, empty] {
        let error = RecordWriter::create(&path, &description).expect_err("impossible");
        assert!(matches!(error, RecordError::Invalid { .. }), "{error}");
    }
    assert!(!path.exists());
    assert_eq!(std::fs::read(folder.path().join("thesis.txt"))?, b"precious");
    Ok(())
}

/// A file that cannot be written is named, what was committed stays, and the call can be repeated.
#[test]
fn failed_writes_lose_nothing() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("record");
    let description = sample::record(&path, [5, 4], 10)?;
    let mut writer = RecordWriter::open(&path)?;
    append(&mut writer, &description, 10..20)?;
    // A directory in the place of a chunk fails the rename, for any user.
    let (chunk, aside) = (path.join("frames/fixed/values/c/0/0"), folder.path().join("aside"));
    std::fs::rename(&chunk, &aside)?;
    std::fs::create_dir(&chunk)?;
    let error = writer.flush().expect_err("the chunk cannot be written");
    assert!(matches!(error, RecordError::Write { committed: 10, .. }), "{error}");
    assert!(error.to_string().contains("frames/fixed/values/c/0/0"), "{error}");
    std::fs::remove_dir(&chunk)?;
    std::fs::rename(&aside, &chunk)?;
    check(&path, [5, 4], 10)?;
    writer.flush()?;
    check(&path, [5, 4], 20)
}

/// Names of the files of a record and what stands in them.
fn contents(path: &Path) -> std::io::Result<Vec<(String, Vec<u8>)>> {
    let name = |file: &Path| file.strip_prefix(path).unwrap_or(file).display().to_string();
    files(path).iter().map(|file| Ok((name(file), std::fs::read(file)?))).collect()
}
