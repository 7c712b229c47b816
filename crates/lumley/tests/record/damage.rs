use crate::sample::{self, Lcg, Outcome, files, replace};
use lumley::record::{Damage, Record, RecordError};
use std::path::Path;

/// Opens a record and reads everything.
fn read(path: &Path) -> Result<usize, RecordError> {
    Record::open(path)?.verify()
}

/// Every file of a record, the descriptions cut at every length: found, and the file named.
#[test]
fn truncated_files_are_found() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("record");
    sample::record(&path, [2, 2], 3)?;
    let blocks = read(&path)?;
    assert_eq!(blocks, 1 + 2 + 2 + 2);
    let mut cuts = 0;
    for file in files(&path) {
        let whole = std::fs::read(&file)?;
        // The last byte of a description is a line break, which may be missing.
        let length = whole.len() - usize::from(file.ends_with("zarr.json"));
        for cut in (0..length).step_by(if file.ends_with("zarr.json") { 1 } else { 37 }) {
            replace(&file, &whole[..cut])?;
            let error = read(&path).expect_err("a truncated file");
            let message = error.to_string();
            assert!(message.contains(&file.display().to_string()), "{message}");
            cuts += 1;
        }
        std::fs::remove_file(&file)?;
        let message = read(&path).expect_err("a missing file").to_string();
        let parent = file.parent().unwrap_or(&path);
        assert!(message.contains(&parent.display().to_string()), "{message}");
        replace(&file, &whole)?;
    }
    assert!(cuts > 4000, "{cuts} cuts");
    assert_eq!(read(&path)?, blocks);
    Ok(())
}

/// A single bit that flips, in any file, is found; in a chunk, the message says what it covers.
#[test]
fn flipped_bits_are_found() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("record");
    sample::record(&path, [40, 30], 20)?;
    let mut lcg = Lcg(7);
    for file in files(&path) {
        let whole = std::fs::read(&file)?;
        for _ in 0..15 {
            let (byte, bit) = (lcg.below(whole.len()), lcg.below(8));
            let mut flipped = whole.clone();
            flipped[byte] ^= 1 << bit;
            if file.ends_with("zarr.json") && flipped[byte].is_ascii_whitespace() {
                continue; // space to line break or the like: JSON does not mind
            }
            replace(&file, &flipped)?;
            let Err(error) = read(&path) else {
                panic!("{}: byte {byte}, bit {bit} went unseen", file.display());
            };
            assert!(error.to_string().contains(&file.display().to_string()), "{error}");
        }
        replace(&file, &whole)?;
    }
    Ok(())
}

/// The second chunk along the rows of the fixed frame: named with all that it covers.
#[test]
fn damage_is_located() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("record");
    sample::record(&path, [40, 30], 300)?;
    let file = path.join("frames/fixed/values/c/1/2");
    let mut bytes = std::fs::read(&file)?;
    bytes[1000] ^= 4;
    replace(&file, &bytes)?;
    let error = read(&path).expect_err("a flipped bit");
    let RecordError::DamagedBlock(block) = &error else { panic!("{error}") };
    assert_eq!((&block.path, block.array.as_str()), (&file, "frames/fixed/values"));
    assert_eq!((block.first.clone(), block.second.clone()), (256..512, 1024..1536));
    assert!(matches!(block.damage, Damage::Checksum { .. }));
    let message = error.to_string();
    assert!(message.contains("snapshots 256..512, rows 1024..1536"), "{message}");
    Ok(())
}

/// Thousands of records with a few bytes overwritten: an error or the same snapshots, never a panic.
#[test]
fn mutations_do_no_harm() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("record");
    let description = sample::record(&path, [2, 2], 3)?;
    let files: Vec<_> = files(&path).into_iter().filter(|f| f.ends_with("zarr.json")).collect();
    let mut lcg = Lcg(3);
    for case in 0..2500 {
        let file = &files[lcg.below(files.len())];
        let whole = std::fs::read(file)?;
        let mut bytes = whole.clone();
        for _ in 0..=lcg.below(3) {
            mutate(&mut bytes, &mut lcg);
        }
        replace(file, &bytes)?;
        if let Ok(record) = Record::open(&path) {
            record.verify()?;
            assert_eq!((record.len(), record.description()), (3, &description), "case {case}");
        }
        replace(file, &whole)?;
    }
    Ok(())
}

fn mutate(bytes: &mut Vec<u8>, lcg: &mut Lcg) {
    let place = lcg.below(bytes.len().max(1)).min(bytes.len().saturating_sub(1));
    let token =
        [&b"9"[..], b"-", b"[", b"}", b"\"", b",", b"1e99", b"18446744073709551615", b"null"];
    match lcg.below(3) {
        0 if !bytes.is_empty() => bytes[place] = u8::try_from(lcg.below(256)).expect("a byte"),
        1 => drop(bytes.splice(place..place, token[lcg.below(token.len())].iter().copied())),
        _ => {
            let end = (place + lcg.below(20)).min(bytes.len());
            bytes.drain(place..end);
        }
    }
}
