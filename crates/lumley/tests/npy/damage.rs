use crate::sample::{Lcg, Outcome, file, header, npy};
use lumley::format::FormatError;
use lumley::format::npy::NpyMatrix;

/// Headers that lie, in files of a few hundred bytes: refused before anything is made for what they claim.
#[test]
fn claimed_sizes_do_not_allocate() -> Outcome {
    let folder = tempfile::tempdir()?;
    let shapes = [
        "(1000000000000000000,)",
        "(1000000000, 1000000000)",
        "(18446744073709551615,)",
        "(18446744073709551616,)",
        "(4294967296, 4294967296)", // the product is 2^64, which wraps to 0
        "(2305843009213693952, 1)", // times 8 bytes likewise
        "(2305843009213693976,)",   // times 8 bytes it wraps to the very 192 that there are
        "(9223372036854775808, 2, 2)",
        "(0, 1000000000000000000)",
        "(1000000000000000000, 0)",
        "()",
        "(-1,)",
        "(3.0,)",
        "(0x3,)",
        "(3",
        "3",
        "(24)(",
        "(24,,)",
        &format!("({})", "1,".repeat(30_000)),
    ];
    for shape in shapes {
        for dtype in ["<f8", "|u1"] {
            let path = file(folder.path(), &npy(&header(dtype, false, shape), &[0; 192]))?;
            let error = NpyMatrix::open(&path).expect_err(shape);
            let message = error.to_string();
            assert!(message.contains("x.npy") && message.len() < 500, "{shape}: {message}");
        }
    }
    Ok(())
}

/// Dictionaries that are not NumPy's.
#[test]
fn foreign_headers_are_refused() -> Outcome {
    let folder = tempfile::tempdir()?;
    let headers = [
        "",
        "{}",
        "{'descr': '<f8', 'fortran_order': False}",
        "{'descr': '<f8', 'fortran_order': False, 'shape': (1,), 'shape': (1,)}",
        "{'descr': '<f8', 'fortran_order': False, 'shape': (1,), 'more': 1}",
        "{'descr': '<f8', 'fortran_order': False, 'shape': (1,)} 7",
        "{'descr': '<f8', 'fortran_order': 0, 'shape': (1,)}",
        "{'descr': [('x', '<f8')], 'fortran_order': False, 'shape': (1,)}",
        "{'descr': '<f8, 'fortran_order': False, 'shape': (1,)}",
        "{'descr: ",
        "{'descr': '<f8', 'fortran_order': False, 'shape': (1,), 'größe': 1}",
        "{'descr': [[[[[[[['<f8'",
    ];
    for text in headers {
        let path = file(folder.path(), &npy(text, &[0; 8]))?;
        let error = NpyMatrix::open(&path).expect_err(text);
        assert!(matches!(error, FormatError::Bytes { .. }), "{text}: {error}");
    }
    let sound = npy(&header("<f8", false, "(1,)"), &[0; 8]);
    for (byte, value) in [(0, b'x'), (6, 4), (7, 1), (8, 255), (9, 255)] {
        let mut bytes = sound.clone();
        bytes[byte] = value;
        let error = NpyMatrix::open(file(folder.path(), &bytes)?).expect_err("a foreign byte");
        assert!(matches!(error, FormatError::Bytes { .. }), "byte {byte}: {error}");
    }
    let error = NpyMatrix::open(folder.path()).expect_err("a directory");
    assert!(matches!(error, FormatError::NotAFile { .. }), "{error}");
    Ok(())
}

/// Headers of versions 2 and 3 have a length of 32 bits.
#[test]
fn long_headers_are_refused() -> Outcome {
    let folder = tempfile::tempdir()?;
    for version in [2, 3] {
        for length in [u32::MAX, u32::MAX - 11, 1 << 31, 1 << 17, 189] {
            let first = [b"\x93NUMPY".as_slice(), &[version, 0], &length.to_le_bytes()].concat();
            let path = file(folder.path(), &[first, vec![b' '; 188]].concat())?;
            let error = NpyMatrix::open(&path).expect_err("a header beyond the file");
            assert!(matches!(error, FormatError::Bytes { offset: 8, .. }), "{error}");
        }
    }
    Ok(())
}

/// A file that shrinks while it is open: an error that names it.
#[test]
fn a_file_that_shrinks_is_named() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = file(folder.path(), &npy(&header("<f8", false, "(2, 3)"), &[0; 48]))?;
    let matrix = NpyMatrix::open(&path)?;
    let length = std::fs::metadata(&path)?.len();
    std::fs::OpenOptions::new().write(true).open(&path)?.set_len(length - 1)?;
    let error = matrix.read().expect_err("a number is missing");
    assert!(matches!(&error, FormatError::Io { path: named, .. } if *named == path), "{error}");
    Ok(())
}

/// To open a pipe would wait for ever.
#[cfg(unix)]
#[test]
fn a_pipe_is_refused() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("x.npy");
    assert!(std::process::Command::new("mkfifo").arg(&path).status()?.success());
    let error = NpyMatrix::open(&path).expect_err("a pipe");
    assert!(matches!(error, FormatError::NotAFile { .. }), "{error}");
    Ok(())
}

/// A file cut at every length, and one with a byte too much.
#[test]
fn truncated_files_are_found() -> Outcome {
    let folder = tempfile::tempdir()?;
    let whole = npy(&header("<f8", false, "(2, 3)"), &[0; 48]);
    assert_eq!(NpyMatrix::open(file(folder.path(), &whole)?)?.shape(), [2, 3]);
    for cut in 0..whole.len() {
        let error = NpyMatrix::open(file(folder.path(), &whole[..cut])?).expect_err("truncated");
        assert!(error.to_string().contains("x.npy"), "{error}");
    }
    let error = NpyMatrix::open(file(folder.path(), &[&whole[..], &[0]].concat())?);
    let error = error.expect_err("a byte too much");
    assert!(matches!(error, FormatError::Size { found: 49, .. }), "{error}");
    Ok(())
}

/// Thousands of files with a few bytes overwritten: an error or a matrix of the file's size, never a panic.
#[test]
fn mutations_do_no_harm() -> Outcome {
    let folder = tempfile::tempdir()?;
    let whole = npy(&header("<f8", true, "(2, 3)"), &[0; 48]);
    let mut lcg = Lcg(11);
    for _ in 0..5000 {
        let mut bytes = whole.clone();
        for _ in 0..=lcg.below(4) {
            let place = lcg.below(bytes.len() - 48);
            bytes[place] = match lcg.below(3) {
                0 => b"0123456789(),'{}: "[lcg.below(18)],
                _ => u8::try_from(lcg.below(256))?,
            };
        }
        if let Ok(matrix) = NpyMatrix::open(file(folder.path(), &bytes)?) {
            assert!(matrix.rows() * matrix.cols() <= 48);
            matrix.read()?;
        }
    }
    Ok(())
}
