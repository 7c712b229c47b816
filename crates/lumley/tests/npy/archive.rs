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

/// The directory's entries of [`archive`], from their signatures on.
fn entries(bytes: &[u8]) -> [usize; 2] {
    let marks = bytes.windows(4).enumerate().filter(|(_, mark)| mark == b"PK\x01\x02");
    let found: Vec<usize> = marks.map(|(at, _)| at).collect();
    found.try_into().expect("two arrays")
}

/// Members that begin anywhere: within another, in the directory, at the end, beyond everything.
#[test]
fn members_may_be_claimed_to_lie_anywhere() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = archive(folder.path())?;
    let whole = std::fs::read(&path)?;
    let [first, second] = entries(&whole);
    let end = u32::try_from(whole.len())?;
    let places = (1..end).chain([end, end + 1, u32::MAX - 1, u32::MAX]);
    for place in places {
        let mut bytes = whole.clone();
        bytes[first + 42..first + 46].copy_from_slice(&place.to_le_bytes());
        replace(&path, &bytes)?;
        let error = read(&path).expect_err("no such member there");
        let FormatError::Bytes { offset, .. } = error else { panic!("{place}: {error}") };
        let of_directory = place == u32::MAX && offset >= first as u64; // ZIP64 without its field
        assert!(of_directory || offset >= u64::from(place), "{place}: {error}");
    }
    // Both entries tell of the same bytes, under one name: the same array twice.
    let mut bytes = whole[..second].to_vec();
    bytes.extend_from_slice(&whole[first..second]);
    let size = u32::try_from(2 * (second - first))?;
    bytes.extend_from_slice(&whole[whole.len() - 22..]);
    let at = bytes.len() - 22;
    bytes[at + 12..at + 16].copy_from_slice(&size.to_le_bytes());
    replace(&path, &bytes)?;
    let npz = NpzReader::open(&path)?;
    assert_eq!(npz.names().collect::<Vec<_>>(), ["modes", "modes"]);
    assert_eq!(npz.read("modes")?.nrows(), 3);
    Ok(())
}

/// Sizes and places of 64 bits that reach beyond the file.
const CLAIMS: [u64; 5] = [u64::MAX, u64::MAX - 30, 1 << 63, 1 << 40, 1 << 20];

/// An archive of the entry alone whose fields at `places` stand as ZIP64 and claim what they claim.
fn claiming(whole: &[u8], places: &[usize], claim: u64) -> Vec<u8> {
    let [first, second] = entries(whole);
    let mut entry = whole[first..second].to_vec();
    for &at in places {
        entry[at..at + 4].fill(0xFF);
    }
    let fields = claim.to_le_bytes().repeat(places.len());
    let length = u16::try_from(fields.len()).expect("three fields at most");
    entry[30..32].copy_from_slice(&(length + 4).to_le_bytes());
    let extra = [&[1, 0], &length.to_le_bytes()[..], &fields].concat();
    let mut end = whole[whole.len() - 22..].to_vec();
    let size = u32::try_from(entry.len() + extra.len()).expect("a short entry");
    end[8..12].copy_from_slice(&[1, 0, 1, 0]);
    end[12..16].copy_from_slice(&size.to_le_bytes());
    [&whole[..first], &entry, &extra, &end].concat()
}

#[test]
fn zip64_sizes_and_places_do_not_allocate() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = archive(folder.path())?;
    let whole = std::fs::read(&path)?;
    let (packed, size, local) = (20, 24, 42);
    for claim in CLAIMS {
        for places in [&[packed, size][..], &[local], &[packed, size, local]] {
            replace(&path, &claiming(&whole, places, claim))?;
            let error = NpzReader::open(&path)?.read("modes").expect_err("a claim");
            assert!(matches!(error, FormatError::Bytes { .. }), "{claim}: {error}");
        }
    }
    let true_place = claiming(&whole, &[local], 0);
    replace(&path, &true_place)?;
    assert_eq!(NpzReader::open(&path)?.read("modes")?.nrows(), 3, "the claim alone is wrong");
    Ok(())
}

#[test]
fn zip64_directories_do_not_allocate() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = archive(folder.path())?;
    let whole = std::fs::read(&path)?;
    let before = &whole[..whole.len() - 22];
    let place = before.len() as u64;
    for claim in CLAIMS {
        for [count, size, start] in [[claim, 0, 0], [2, claim, 0], [2, 0, claim], [claim; 3]] {
            let directory = [count, size, start].map(u64::to_le_bytes).concat();
            let end64 = [b"PK\x06\x06".as_slice(), &[0; 28], &directory].concat();
            for place in [place, claim] {
                let locator =
                    [b"PK\x06\x07\0\0\0\0", &place.to_le_bytes()[..], &[1, 0, 0, 0]].concat();
                let end = [b"PK\x05\x06\0\0\0\0".as_slice(), &[0xFF; 12], &[0; 2]].concat();
                replace(&path, &[before, &end64, &locator, &end].concat())?;
                let error = NpzReader::open(&path).expect_err("a claim");
                assert!(matches!(error, FormatError::Bytes { .. }), "{claim}: {error}");
            }
        }
    }
    Ok(())
}

/// Names are listed as far as a message has room, and cannot play tricks on a terminal.
#[test]
fn unknown_names_make_a_short_message() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("pod.npz");
    let mut npz = NpzWriter::create(&path)?;
    for k in 0..100 {
        npz.vector(&format!("{k}\u{1b}[2J{}", "x".repeat(1000)), &[1.0])?;
    }
    npz.finish()?;
    let message = read(&path).expect_err("no modes").to_string();
    assert!(message.contains("pod.npz: no array modes; it holds \"0\\x1b"), "{message}");
    assert!(message.len() < 1000 && !message.contains('\u{1b}'), "{message}");
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
