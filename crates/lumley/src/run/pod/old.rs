//! The basis in a file that new snapshots update.

use super::PodInput;
use super::open::Opened;
use crate::Error;
use crate::directory::partial;
use crate::format::npy::NpyMatrix;
use crate::format::npz::NpzReader;
use crate::run::FileModes;
use crate::run::basis::{MEAN, MODES, misshapen, read_small};
use faer::MatMut;
use lumley_pod::{
    Decomposition, Execution, ModeSource, OldBasis, Options, PodError, SnapshotSource, update,
};
use std::io;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// An old basis: its modes, which may be larger than memory, stay in the file.
pub(super) struct OldFile {
    decomposition: Decomposition,
    modes: NpyMatrix,
    mean: Option<NpyMatrix>,
}

impl PodInput {
    /// The file of the old basis, where there is one.
    pub(super) fn old_path(&self) -> Option<PathBuf> {
        let path = self.update.as_ref()?;
        Some(if path.is_dir() { path.join("pod.npz") } else { path.clone() })
    }

    /// The old basis, which the run at `target` does not replace.
    pub(super) fn open_old(&self, target: &Path) -> Result<Option<OldFile>, Error> {
        let Some(path) = self.old_path() else { return Ok(None) };
        let refuse = |argument, value: &str, expected: &str| {
            Err(Error::Argument { argument, value: value.into(), expected: expected.into() })
        };
        if self.choice.method != "incremental" {
            return refuse("--method", &self.choice.method, "incremental, as --update is given");
        }
        let old = OldFile::open(&path)?;
        let update = path.display().to_string();
        if is_part_of(&path, target) {
            return refuse("--update", &update, "a basis outside of the run that it makes");
        }
        if let Some(array) = old.damaged() {
            let expected =
                format!("finite numbers in its array {array}, and no negative energy or weight");
            return refuse("--update", &update, &expected);
        }
        if self.choice.center && old.mean.is_none() {
            let expected = "a basis whose mean was subtracted, as --center is given";
            return refuse("--update", &update, expected);
        }
        Ok(Some(old))
    }

    /// Whether the mean is subtracted: where it was from old snapshots, it is from these.
    pub(super) fn is_centred(&self, opened: &Opened) -> bool {
        self.choice.center || opened.old.as_ref().is_some_and(|old| old.mean.is_some())
    }

    /// Where the snapshots come from, in words.
    pub(super) fn source(&self) -> String {
        let new = self.path.display();
        self.old_path()
            .map_or_else(|| new.to_string(), |old| format!("{} and {new}", old.display()))
    }
}

/// Whether `file` lies in the run at `target`, finished or not, by whatever name.
fn is_part_of(file: &Path, target: &Path) -> bool {
    let Ok(file) = file.canonicalize() else { return false };
    let folders = [target.to_owned(), partial(target)];
    folders.iter().filter_map(|path| path.canonicalize().ok()).any(|path| file.starts_with(path))
}

impl OldFile {
    fn open(path: &Path) -> Result<Self, Error> {
        let npz = NpzReader::open(path)?;
        // Their checksum would take a pass over them; the update looks whether they are orthonormal.
        let modes = npz.unchecked(MODES)?;
        let has_mean = npz.names().any(|name| name == MEAN);
        let mean = if has_mean { Some(npz.matrix(MEAN)?) } else { None };
        if let Some(mean) = mean.as_ref().filter(|m| (m.rows(), m.cols()) != (modes.rows(), 1)) {
            return Err(misshapen(mean, "one number for each row of the modes").into());
        }
        Ok(Self { decomposition: read_small(&npz, modes.cols())?, modes, mean })
    }

    /// The first array whose numbers cannot be what it is called.
    fn damaged(&self) -> Option<&'static str> {
        let found = &self.decomposition;
        let bound: Vec<f64> = found.error_bound.into_iter().collect();
        let arrays = [
            ("eigenvalues", &found.eigenvalues),
            ("spectrum", &found.spectrum),
            ("time_weights", &found.time_weights),
            ("error_bound", &bound),
        ];
        let sound = |values: &[f64]| values.iter().all(|x| x.is_finite() && *x >= 0.0);
        let first = arrays.into_iter().find(|(_, values)| !sound(values)).map(|(name, _)| name);
        first.or_else(|| (!found.coefficients.is_all_finite()).then_some("coefficients"))
    }

    /// The decomposition of the old snapshots and of `x`, which are those opened, or some of them.
    pub fn updated(
        &self,
        x: &dyn SnapshotSource,
        opened: &Opened,
        options: &Options,
        execution: Execution<'_>,
        modes: &FileModes,
    ) -> Result<Decomposition, PodError> {
        let old = OldBasis { decomposition: &self.decomposition, modes: self };
        let mut found = update(old, x, opened.product.as_ref(), options, execution, modes)?;
        if !opened.timed {
            // Numbers in the place of times go on from the old snapshots.
            for number in &mut found.times[self.snapshots()..] {
                *number += self.snapshots() as f64;
            }
        }
        Ok(found)
    }

    /// Number of old snapshots.
    pub fn snapshots(&self) -> usize {
        self.decomposition.times.len()
    }
}

impl ModeSource for OldFile {
    fn dim(&self) -> usize {
        self.modes.rows()
    }

    fn block(&self, rows: Range<usize>, out: MatMut<'_, f64>) -> io::Result<()> {
        self.modes.read_block(rows, 0..out.ncols(), out).map_err(io::Error::other)
    }

    fn mean_of(&self, rows: Range<usize>) -> io::Result<Option<Vec<f64>>> {
        let Some(mean) = &self.mean else { return Ok(None) };
        let mut part = vec![0.0; rows.len()];
        let out = MatMut::from_column_major_slice_mut(&mut part, rows.len(), 1);
        mean.read_block(rows, 0..1, out).map_err(io::Error::other)?;
        if part.iter().all(|u| u.is_finite()) {
            return Ok(Some(part));
        }
        let message = format!("{}: expected finite numbers", mean.path().display());
        Err(io::Error::new(io::ErrorKind::InvalidData, message))
    }
}
