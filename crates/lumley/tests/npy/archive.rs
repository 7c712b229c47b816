use crate::sample::{Lcg, Outcome, replace};
use faer::{Mat, mat};
use lumley::format::FormatError;
use lumley::format::npz::{NpzReader, NpzWriter};
use std::path::{Path, PathBuf};

fn archive(folder: &Path) -> Result<PathBuf, FormatError> {
    let path = folder.join("pod.npz");
    let mut npz = NpzWriter::create(&path)?;
    npz.matrix("modes", mat![[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]].as_ref())?;
    npz.vector("eigenvalues", &[2.0, 1.0])?;
    npz.finish()?;
    Ok(path)
}

fn read(path: &Path) -> Result<(Mat<f64>, Vec<f64>), FormatError> {
    let npz = NpzReader::open(path)?;
    Ok((npz.read("modes")?, npz.vector("eigenvalues")?))
}

/// By blocks too, and a view with strides is written like a matrix of its own.
#[test]
fn what_is_read_is_what_was_written() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("x.npz");
    let x = Mat::from_fn(700, 300, |i, j| (i * 1000 + j) as f64);
    let mut npz = NpzWriter::create(&path)?;
    npz.matrix("x", x.as_ref())?;
    npz.matrix("transposed", x.transpose())?;
    npz.vector("empty", &[])?;
    assert!(!path.exists(), "nothing under that name before the end");
    npz.finish()?;
    let npz = NpzReader::open(&path)?;
    assert_eq!(npz.names().collect::<Vec<_>>(), ["x", "transposed", "empty"]);
    assert_eq!(npz.read("x")?, x);
    assert_eq!(npz.read("transposed")?, x.transpose());
    let mut block = Mat::zeros(3, 2);
    npz.matrix("x")?.read_block(10..13, 298..300, block.as_mut())?;
    assert_eq!(block, x.submatrix(10, 298, 3, 2));
    Ok(())
}

/// An archive that is given up leaves the older one, and nothing else.
#[test]
fn given_up_leaves_the_older_archive() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = archive(folder.path())?;
    let mut npz = NpzWriter::create(&path)?;
    npz.vector("new", &[1.0])?;
    drop(npz);
    assert_eq!(read(&path)?.1, [2.0, 1.0]);
    assert_eq!(std::fs::read_dir(folder.path())?.count(), 1);
    Ok(())
}

/// Cut at every length, or one bit flipped anywhere in an array: found, and the file named.
#[test]
fn damage_is_found() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = archive(folder.path())?;
    let whole = std::fs::read(&path)?;
    for cut in 0..whole.len() {
        replace(&path, &whole[..cut])?;
        let error = read(&path).expect_err("truncated");
        assert!(error.to_string().contains("pod.npz"), "{error}");
    }
    for bit in 0..8 * (30 + 9 + 128 + 48) {
        let mut bytes = whole.clone();
        bytes[bit / 8] ^= 1 << (bit % 8);
        replace(&path, &bytes)?;
        // Version, flags, date and sizes of the local header stand in the directory too and are taken from there.
        let unread = (4..26).contains(&(bit / 8));
        assert!(unread || read(&path).is_err(), "byte {}, bit {}", bit / 8, bit % 8);
    }
    Ok(())
}

/// Thousands of archives with a few bytes overwritten: an error or the same arrays, never a panic.
#[test]
fn mutations_do_no_harm() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = archive(folder.path())?;
    let whole = std::fs::read(&path)?;
    let arrays = read(&path)?;
    let mut lcg = Lcg(13);
    for _ in 0..5000 {
        let mut bytes = whole.clone();
        for _ in 0..=lcg.below(3) {
            // Half of them in the directory at the end.
            let place = lcg.below(whole.len() / 2) + lcg.below(2) * (whole.len() / 2);
            bytes[place] = [0, 0xFF, u8::try_from(lcg.below(256))?][lcg.below(3)];
        }
        replace(&path, &bytes)?;
        if let Ok(found) = read(&path) {
            assert_eq!(found, arrays);
        }
    }
    Ok(())
}

/// `numpy.savez_compressed` is told apart, with what to do.
#[test]
fn compressed_arrays_are_refused() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = archive(folder.path())?;
    let mut bytes = std::fs::read(&path)?;
    let entry = bytes.windows(4).position(|w| w == b"PK\x01\x02").expect("a directory");
    bytes[entry + 10] = 8;
    replace(&path, &bytes)?;
    let error = read(&path).expect_err("deflate");
    assert!(matches!(error, FormatError::Compressed { method: 8, .. }), "{error}");
    assert!(error.to_string().contains("numpy.savez "), "{error}");
    Ok(())
}

/// A directory that claims 8 MiB, in a file of some hundred bytes.
#[test]
fn claimed_sizes_do_not_allocate() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = archive(folder.path())?;
    let mut bytes = std::fs::read(&path)?;
    let end = bytes.len() - 22;
    bytes[end + 12..end + 16].copy_from_slice(&(1_u32 << 23).to_le_bytes());
    replace(&path, &bytes)?;
    let error = read(&path).expect_err("a directory beyond the file");
    assert!(matches!(error, FormatError::Bytes { .. }), "{error}");
    Ok(())
}
