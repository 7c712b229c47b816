//! Disks that are full: an error that names the file, and earlier results intact.

use crate::{Outcome, ROWS, decomposition, mean, modes, publish};
use lumley::run::{BasisFile, FileModes};
use lumley_pod::{Alone, Identity, MemorySnapshots, ModeStore, Options, ReducedBasis, svd};
use std::path::Path;

/// Tells the test that a process runs under a limit what to do where.
const FOLDER: &str = "LUMLEY_TEST_FOLDER";

/// What stands in the folder before.
fn old_basis() -> ReducedBasis {
    let x = MemorySnapshots::new(faer::mat![[3.0, 0.0], [0.0, 4.0]], vec![0.0, 1.0]);
    svd(&x, &Identity::new(2), &Options::default()).expect("two snapshots")
}

/// Publishes everything, as far as the disk allows.
fn publish_all(folder: &Path) -> Result<(), lumley::Error> {
    let store = FileModes::new(folder);
    let failed = lumley_pod::PodError::from;
    let path = folder.join("x.npy");
    let pod = |source| lumley::Error::Pod { path: path.clone(), source };
    store.begin(ROWS, 3, true).map_err(failed).map_err(pod)?;
    publish(&store, 0..ROWS).map_err(failed).map_err(pod)?;
    store.finish(&Alone, &decomposition())
}

/// Not a test of its own: what [`limited`] starts.
#[test]
fn under_a_limit() {
    if let Some(folder) = std::env::var_os(FOLDER) {
        let error = publish_all(folder.as_ref()).expect_err("a full disk");
        eprintln!("error: {error}");
    }
}

/// What is said where files may have `kibibytes`.
fn limited(folder: &Path, kibibytes: usize) -> std::io::Result<String> {
    let this = std::env::current_exe()?;
    let run = "exec \"$0\" --exact faults::under_a_limit --nocapture";
    let limited = format!("trap '' XFSZ; ulimit -f {}; {run}", 2 * kibibytes);
    let mut shell = std::process::Command::new("sh");
    let output = shell.args(["-c", &limited]).arg(this).env(FOLDER, folder).output()?;
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{said}");
    Ok(said)
}

/// Full while the modes are written, and full when only the small arrays are missing.
#[test]
fn a_full_disk_leaves_the_older_modes() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("pod.npz");
    let old = old_basis();
    BasisFile::save(&path, &old)?;
    for (kibibytes, while_publishing) in [(300, true), (ROWS * 32 / 1024 + 2, false)] {
        let said = limited(folder.path(), kibibytes)?;
        assert_eq!(said.contains("x.npy"), while_publishing, "{said}");
        assert!(said.contains("cannot write") && said.contains("File too large"), "{said}");
        assert!(said.contains("pod.npz"), "{said}");
        assert_eq!(BasisFile::load(&path)?.modes, old.modes);
    }
    publish_all(folder.path())?;
    let new = BasisFile::load(&path)?;
    assert_eq!((new.modes, new.mean), (modes(), Some(mean())));
    Ok(())
}
