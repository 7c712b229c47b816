//! The command in a process that may not take more than a little memory: what a file claims is not
//! allocated.

use crate::sample::{Outcome, header, npy};
use std::path::Path;
use std::process::{Command, Output};

/// Address space of the process, in KiB; the files here have a few hundred bytes.
const LIMIT: &str = "60000";

fn info(path: &Path) -> std::io::Result<Output> {
    let script = "ulimit -v \"$1\" && exec \"$2\" info \"$3\"";
    let lumley = env!("CARGO_BIN_EXE_lumley");
    Command::new("sh").args(["-c", script, "sh", LIMIT, lumley]).arg(path).output()
}

fn refused(path: &Path, bytes: &[u8]) -> Outcome {
    std::fs::write(path, bytes)?;
    let output = info(path)?;
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{said}");
    let name = path.file_name().map(|name| name.to_string_lossy()).unwrap_or_default();
    assert!(said.contains(&*name) && said.len() < 1000, "{said}");
    Ok(())
}

#[test]
fn claims_are_not_allocated() -> Outcome {
    let folder = tempfile::tempdir()?;
    let array = folder.path().join("x.npy");
    std::fs::write(&array, npy(&header("<f8", false, "(3, 2)"), &[0; 48]))?;
    assert!(info(&array)?.status.success(), "what is sound is read in so little memory");
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
