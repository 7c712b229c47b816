use crate::sample::{self, Outcome, replace};
use lumley::record::{Record, RecordError, RecordWriter};
use lumley_pod::{Execution, Identity, Options, PodError, finite_snapshots, svd};
use serde_json::{Value, json};
use std::path::Path;
#[cfg(target_os = "linux")]
use std::process::Command;

const HUGE: u64 = 1 << 60;

/// Changes the record's description and sets its checksum right, as an attacker would.
fn forge(path: &Path, change: impl Fn(&mut Value)) -> std::io::Result<()> {
    let file = path.join("zarr.json");
    let mut group: Value = serde_json::from_slice(&std::fs::read(&file)?)?;
    change(&mut group["attributes"]["lumley"]);
    let checksum = checksum(&group["attributes"]["lumley"]);
    group["attributes"]["lumley_crc32c"] = json!(checksum);
    replace(&file, group.to_string().as_bytes())
}

/// CRC-32C of the description as JSON without blanks, its keys in the order in which lumley writes them.
fn checksum(lumley: &Value) -> String {
    let keys = ["format", "snapshots", "chunk_snapshots", "frames", "series", "provenance"];
    format!("{:08x}", crc32c::crc32c(object(lumley, &keys).as_bytes()))
}

fn object(value: &Value, keys: &[&str]) -> String {
    let members = keys.iter().map(|key| format!("\"{key}\":{}", member(key, &value[*key])));
    format!("{{{}}}", members.collect::<Vec<_>>().join(","))
}

fn member(key: &str, value: &Value) -> String {
    let keys: &[&str] = match key {
        "frames" => &["name", "length_unit", "components", "support", "chunk_rows"],
        "series" => &["name", "entries"],
        "components" | "entries" => &["name", "unit"],
        _ => return value.to_string(),
    };
    let elements = value.as_array().into_iter().flatten().map(|value| object(value, keys));
    format!("[{}]", elements.collect::<Vec<_>>().join(","))
}

/// Sizes beyond everything, with a right checksum: refused before anything is made for them.
#[test]
fn claimed_sizes_do_not_allocate() -> Outcome {
    type Change = fn(&mut Value);
    let changes: [(&str, &str, Change); 16] = [
        ("snapshots", "shape", |d| d["snapshots"] = json!(HUGE)),
        ("all snapshots", "shape", |d| d["snapshots"] = json!(u64::MAX)),
        ("chunk", "chunk_snapshots", |d| d["chunk_snapshots"] = json!(HUGE)),
        ("long chunk", "chunk_snapshots", |d| d["chunk_snapshots"] = json!(1 << 24)),
        ("no chunk", "chunk_snapshots", |d| d["chunk_snapshots"] = json!(0)),
        ("rows of a chunk", "chunk_rows", |d| d["frames"][0]["chunk_rows"] = json!(HUGE)),
        ("no rows", "chunk_rows", |d| d["frames"][0]["chunk_rows"] = json!(0)),
        ("grid", "Grid", |d| d["frames"][0]["support"]["grid"] = json!([HUGE, HUGE])),
        ("long grid", "shape", |d| d["frames"][0]["support"]["grid"] = json!([HUGE, 2])),
        ("no grid", "Grid", |d| d["frames"][0]["support"]["grid"] = json!([0, 0])),
        ("nodes", "nodes/c/0", |d| d["frames"][1]["support"]["nodes"] = json!(HUGE)),
        ("name", "zarr.json", |d| d["frames"][0]["name"] = json!("../../etc")),
        ("negative", "line 1", |d| d["snapshots"] = json!(-1)),
        ("negative chunk", "line 1", |d| d["frames"][0]["chunk_rows"] = json!(-1)),
        ("long name", "name in frames", |d| d["frames"][0]["name"] = json!("x".repeat(10_000))),
        ("no frames", "frames", |d| d["frames"] = json!([])),
    ];
    let folder = tempfile::tempdir()?;
    for (name, place, change) in changes {
        let path = folder.path().join(name);
        sample::record(&path, [2, 2], 3)?;
        forge(&path, change)?;
        let message = Record::open(&path).expect_err(name).to_string();
        assert!(message.contains(&path.display().to_string()), "{name}: {message}");
        assert!(message.contains(place) && message.len() < 1000, "{name}: {message}");
        RecordWriter::open(&path).expect_err(name);
    }
    let sound = folder.path().join("sound");
    sample::record(&sound, [2, 2], 3)?;
    forge(&sound, |_| ())?;
    assert_eq!(Record::open(&sound)?.len(), 3, "the forger knows the checksum");
    Ok(())
}

/// All descriptions agree on more snapshots than there are blocks for: the first missing one ends it.
#[test]
fn claimed_snapshots_need_blocks() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("record");
    let description = sample::record(&path, [2, 2], 3)?;
    forge(&path, |d| d["snapshots"] = json!(HUGE))?;
    let series = description.series.iter().map(|series| format!("series/{}", series.name));
    let frames = description.frames.iter().map(|frame| format!("frames/{}/values", frame.name));
    for array in series.chain(frames).chain(["time".to_owned()]) {
        let file = path.join(array).join("zarr.json");
        let mut metadata: Value = serde_json::from_slice(&std::fs::read(&file)?)?;
        metadata["shape"][0] = json!(HUGE);
        replace(&file, metadata.to_string().as_bytes())?;
    }
    let error = Record::open(&path).expect_err("there are three");
    assert!(error.to_string().contains("time/c/1: damaged block"), "{error}");
    Ok(())
}

/// A number changed by hand, and no new checksum.
#[test]
fn edited_descriptions_are_found() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("record");
    sample::record(&path, [2, 2], 3)?;
    let text = std::fs::read_to_string(path.join("zarr.json"))?;
    replace(
        &path.join("zarr.json"),
        text.replace("\"snapshots\": 3", "\"snapshots\": 2").as_bytes(),
    )?;
    let error = Record::open(&path).expect_err("another number");
    assert!(matches!(error, RecordError::MetadataChecksum { .. }), "{error}");
    Ok(())
}

/// A record of tomorrow is told apart from a damaged one.
#[test]
fn another_version_is_named() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("record");
    sample::record(&path, [2, 2], 3)?;
    forge(&path, |d| *d = json!({ "format": 2, "shards": true }))?;
    let error = Record::open(&path).expect_err("version 2");
    assert!(matches!(error, RecordError::Version { found: 2, supported: 1, .. }), "{error}");
    Ok(())
}

/// Arrays that are described as something else than the record says, and descriptions that are no JSON.
#[test]
fn foreign_descriptions_are_refused() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("record");
    sample::record(&path, [2, 2], 3)?;
    let file = path.join("frames/fixed/values/zarr.json");
    let sound: Value = serde_json::from_slice(&std::fs::read(&file)?)?;
    let edits = [
        ("/shape/0", json!(2)),
        ("/shape/1", json!(HUGE)),
        ("/shape", json!([])),
        ("/data_type", json!("float32")),
        ("/chunk_grid/configuration/chunk_shape/0", json!(0)),
        ("/codecs/0/configuration/endian", json!("big")),
        ("/codecs/1", json!({ "name": "gzip" })),
        ("/zarr_format", json!(2)),
    ];
    for (place, value) in edits {
        let mut edited = sound.clone();
        *edited.pointer_mut(place).expect("an entry of the description") = value;
        replace(&file, edited.to_string().as_bytes())?;
        let error = Record::open(&path).expect_err(place);
        assert!(matches!(error, RecordError::Invalid { .. }), "{place}: {error}");
        assert!(error.to_string().contains("values/zarr.json"), "{error}");
    }
    let deep = "[".repeat(100_000);
    for text in ["", "null", "[]", "{}", "{\"shape\": 7}", &deep] {
        for file in [&file, &path.join("zarr.json")] {
            let whole = std::fs::read(file)?;
            replace(file, text.as_bytes())?;
            let error = Record::open(&path).expect_err("no description");
            assert!(error.to_string().contains("zarr.json"), "{error}");
            replace(file, &whole)?;
        }
    }
    Ok(())
}

/// A file of brackets would take a hundred times its length as a tree: it is refused before it is one, in a
/// process of little memory.
#[cfg(target_os = "linux")]
#[test]
fn descriptions_take_no_more_memory_than_their_files() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("record");
    sample::record(&path, [2, 2], 3)?;
    let info = || {
        let lumley = env!("CARGO_BIN_EXE_lumley");
        let script = "ulimit -v 60000 && exec \"$1\" info \"$2\"";
        Command::new("sh").args(["-c", script, "sh", lumley]).arg(&path).output()
    };
    assert!(info()?.status.success(), "what is sound is read in so little memory");
    let [record, array] = ["zarr.json", "frames/fixed/values/zarr.json"].map(|f| path.join(f));
    let objects = |length: usize| format!("[{}0]", "{\"\":0},".repeat(length / 7));
    let attributes = format!("{{\"attributes\":{{\"lumley\":{}}}}}", objects(1_040_000));
    let name = "\\u001b[2J".repeat(100_000);
    let key = format!("{{\"attributes\":{{\"lumley\":{{\"{name}\":1}}}}}}");
    let huge = objects(60_000_000);
    for (file, text) in [
        (&record, &objects(1_040_000)),
        (&record, &attributes),
        (&record, &key),
        (&record, &huge),
        (&array, &huge),
        (&array, &objects(1_500)),
    ] {
        let whole = std::fs::read(file)?;
        replace(file, text.as_bytes())?;
        let output = info()?;
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains("zarr.json") && said.len() < 1000, "{said}");
        assert!(!said.contains('\u{1b}'), "no tricks on a terminal: {said}");
        replace(file, &whole)?;
    }
    Ok(())
}

/// Directories in the place of files, and files in the place of directories.
#[test]
fn other_things_than_files_are_named() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("record");
    sample::record(&path, [2, 2], 3)?;
    for file in sample::files(&path) {
        let whole = std::fs::read(&file)?;
        std::fs::remove_file(&file)?;
        std::fs::create_dir(&file)?;
        let message = Record::open(&path).expect_err("a directory").to_string();
        assert!(message.contains(&file.display().to_string()), "{message}");
        std::fs::remove_dir(&file)?;
        std::fs::write(&file, whole)?;
    }
    let chunks = path.join("frames/fixed/values/c");
    std::fs::remove_dir_all(&chunks)?;
    std::fs::write(&chunks, b"")?;
    let message = Record::open(&path).expect_err("a file").to_string();
    assert!(message.contains("frames/fixed/values/c/0"), "{message}");
    Ok(())
}

/// Blocks that are longer than they should be by a little or by much, and the one behind the last.
#[test]
fn blocks_of_another_length_are_named() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("record");
    sample::record(&path, [2, 2], 3)?;
    let file = path.join("frames/fixed/values/c/0/0");
    let whole = std::fs::read(&file)?;
    for excess in [1, 8, whole.len(), 1 << 40] {
        std::fs::OpenOptions::new()
            .write(true)
            .open(&file)?
            .set_len((whole.len() + excess) as u64)?;
        let message = Record::open(&path).expect_err("a long block").to_string();
        assert!(message.contains("values/c/0/0: damaged block"), "{message}");
    }
    replace(&file, &whole)?;
    std::fs::write(path.join("frames/fixed/values/c/0/1"), b"not of this record")?;
    assert_eq!(Record::open(&path)?.len(), 3, "what is not committed counts for nothing");
    Ok(())
}

/// Numbers that are not finite, in a chunk with a right checksum: a decomposition names snapshot and row.
#[test]
fn numbers_that_are_not_finite_are_named() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("record");
    let rows = sample::record(&path, [2, 2], 3)?.frames[0].rows();
    let file = path.join("frames/fixed/values/c/0/0");
    let mut bytes = std::fs::read(&file)?;
    let (end, place) = (bytes.len() - 4, 8 * (2 * rows + 5));
    bytes[place..place + 8].copy_from_slice(&f64::NAN.to_le_bytes());
    let checksum = crc32c::crc32c(&bytes[..end]);
    bytes[end..].copy_from_slice(&checksum.to_le_bytes());
    replace(&file, &bytes)?;
    let snapshots = Record::open(&path)?.frame("fixed")?;
    let options = Options::default();
    let error = svd(&snapshots, &Identity::new(rows), &options).expect_err("NaN");
    assert!(matches!(error, PodError::NonFinite { snapshot: 2, row: 5, .. }), "{error}");
    assert_eq!(finite_snapshots(&snapshots, &options, Execution::default())?, [0, 1]);
    Ok(())
}

/// Times that do not increase, in a chunk with a right checksum.
#[test]
fn times_out_of_order_are_refused() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("record");
    sample::record(&path, [2, 2], 3)?;
    let file = path.join("time/c/0");
    let mut bytes = std::fs::read(&file)?;
    let end = bytes.len() - 4;
    bytes.copy_within(0..8, 16);
    let checksum = crc32c::crc32c(&bytes[..end]);
    bytes[end..].copy_from_slice(&checksum.to_le_bytes());
    replace(&file, &bytes)?;
    let error = Record::open(&path).expect_err("time goes back");
    assert!(error.to_string().contains("snapshot 2"), "{error}");
    Ok(())
}
