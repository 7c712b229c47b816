use crate::sample::{self, Outcome, replace};
use lumley::record::{Record, RecordError, RecordWriter};
use serde_json::{Value, json};
use std::path::Path;

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
    let changes: [(&str, &str, Change); 13] = [
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
        ("no frames", "frames", |d| d["frames"] = json!([])),
    ];
    let folder = tempfile::tempdir()?;
    for (name, place, change) in changes {
        let path = folder.path().join(name);
        sample::record(&path, [2, 2], 3)?;
        forge(&path, change)?;
        let message = Record::open(&path).expect_err(name).to_string();
        assert!(message.contains(&path.display().to_string()), "{name}: {message}");
        assert!(message.contains(place), "{name}: {message}");
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
    let deep = "[".repeat(60_000);
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
