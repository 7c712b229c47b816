//! The command in a process that may not take more than a little memory: what a file claims is not
//! allocated.

use crate::sample::{Outcome, header, npy};
use std::ffi::OsStr;
use std::path::Path;
use std::process::{Command, Output};

/// Address space of the process, in KiB; the files here have a few hundred bytes.
const LIMIT: &str = "60000";

/// The same for a decomposition, whose matrix products reserve 100 MB before they begin. Every claim here is
/// of more.
const LIMIT_OF_POD: &str = "200000";

fn lumley(limit: &str, arguments: &[&OsStr]) -> std::io::Result<Output> {
    let script = "ulimit -v \"$0\" && exec \"$@\"";
    let lumley = env!("CARGO_BIN_EXE_lumley");
    Command::new("sh").args(["-c", script, limit, lumley]).args(arguments).output()
}

fn info(path: &Path) -> std::io::Result<Output> {
    lumley(LIMIT, &["info".as_ref(), path.as_ref()])
}

/// `pod` with the sound snapshots beside `path`, and `path` as this argument.
fn pod(argument: &str, path: &Path) -> std::io::Result<Output> {
    let beside = |name| path.with_file_name(name).into_os_string();
    let (x, out) = (beside("sound.npy"), beside("out"));
    let plain = ["--threads", "1", "--modes", "1", "-o"].map(OsStr::new);
    let files = ["pod".as_ref(), x.as_ref(), argument.as_ref(), path.as_os_str()];
    lumley(LIMIT_OF_POD, &[&files[..], &plain, &[out.as_ref()]].concat())
}

fn refused(path: &Path, bytes: &[u8]) -> Outcome {
    std::fs::write(path, bytes)?;
    said_of(path, &info(path)?);
    let arguments: &[&str] = match path.extension().and_then(OsStr::to_str) {
        Some("npz") => &["--update"],
        _ => &["--weights", "--times"],
    };
    for argument in arguments {
        said_of(path, &pod(argument, path)?);
    }
    Ok(())
}

/// The command was refused, in few words, for this file.
fn said_of(path: &Path, output: &Output) {
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{said}");
    let name = path.file_name().map(|name| name.to_string_lossy()).unwrap_or_default();
    assert!(said.contains(&*name) && said.len() < 1000, "{said}");
}

#[test]
fn claims_are_not_allocated() -> Outcome {
    let folder = tempfile::tempdir()?;
    let array = folder.path().join("x.npy");
    std::fs::write(&array, npy(&header("<f8", false, "(3, 2)"), &[0; 48]))?;
    assert!(info(&array)?.status.success(), "what is sound is read in so little memory");
    let sound = npy(&header("|u1", false, "(3, 2)"), &[1, 2, 3, 4, 5, 7]);
    std::fs::write(folder.path().join("sound.npy"), sound)?;
    let times = folder.path().join("t.npy");
    std::fs::write(&times, npy(&header("|u1", false, "(3,)"), &[0, 1, 2]))?;
    let sound = pod("--times", &times)?;
    assert!(sound.status.success(), "{}", String::from_utf8_lossy(&sound.stderr));
    for shape in ["(100000000, 2)", "(1000000000000000000,)", "(4294967296, 4294967296)"] {
        refused(&array, &npy(&header("<f8", false, shape), &[0; 48]))?;
    }
    for length in [u32::MAX, 1 << 28] {
        let first = [b"\x93NUMPY\x02\x00".as_slice(), &length.to_le_bytes()].concat();
        refused(&array, &[first, vec![b' '; 300]].concat())?;
    }
    let archive = folder.path().join("x.npz");
    for (size, place) in [(0xF000_0000_u32, 0_u32), (u32::MAX, u32::MAX), (1 << 28, 0xF000_0000)] {
        let directory = [size, place].map(u32::to_le_bytes).concat();
        let end = [b"PK\x05\x06\0\0\0\0".as_slice(), &[1, 0, 1, 0], &directory, &[0; 2]].concat();
        refused(&archive, &[vec![0; 300], end].concat())?;
    }
    Ok(())
}
