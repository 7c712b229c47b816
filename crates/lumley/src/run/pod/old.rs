//! The basis in a file that new snapshots update.

use super::PodInput;
use super::open::Opened;
use crate::Error;
use crate::format::npy::NpyMatrix;
use crate::format::npz::NpzReader;
use crate::run::FileModes;
use crate::run::basis::{MEAN, MODES, misshapen, read_small};
use faer::MatMut;
use lumley_pod::{
    Decomposition, Execution, ModeSource, OldBasis, Options, PodError, Ranks, SnapshotSource,
    update,
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

    /// The old basis, where there is one.
    pub(super) fn open_old(&self, ranks: &dyn Ranks) -> Result<Option<OldFile>, Error> {
        let Some(path) = self.old_path() else { return Ok(None) };
        let refuse = |argument, value: &str, expected: &str| {
            Err(Error::Argument { argument, value: value.into(), expected: expected.into() })
        };
        if self.choice.method != "incremental" {
            return refuse("--method", &self.choice.method, "incremental, as --update is given");
        }
        let old = OldFile::open(&path, ranks)?;
        let update = path.display().to_string();
        if let Some(array) = old.damaged() {
            let expected = format!(
                "finite numbers in its array {array}, no negative energy or weight, and increasing times"
            );
            return refuse("--update", &update, &expected);
        }
        if self.choice.center && old.mean.is_none() {
            let expected = "a basis whose mean was subtracted, as --center is given";
            return refuse("--update", &update, expected);
        }
        Ok(Some(old))
    }

    /// Whether the new snapshots, at `times` of their own, come after the old ones.
    pub(super) fn check_order(&self, old: &OldFile, times: &[f64]) -> Result<(), Error> {
        let Some((first, last)) = times.first().zip(old.decomposition.times.last()) else {
            return Ok(());
        };
        if first > last {
            return Ok(());
        }
        let (argument, path) =
            self.times.as_ref().map_or(("snapshots", &self.path), |path| ("--times", path));
        Err(Error::Argument {
            argument,
            value: format!("{} from {first} s on", path.display()),
            expected: format!("times after those of the old basis, which ends at {last} s"),
        })
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

impl OldFile {
    fn open(path: &Path, ranks: &dyn Ranks) -> Result<Self, Error> {
        let npz = NpzReader::open(path)?;
        // Their checksum would take a pass over them; the update looks whether they are orthonormal.
        let modes = npz.unchecked(MODES)?;
        let has_mean = npz.names().any(|name| name == MEAN);
        // One rank reads all of the mean, for its checksum; the others read their rows alone.
        let open = if ranks.rank() == 0 { NpzReader::matrix } else { NpzReader::unchecked };
        let mean = if has_mean { Some(open(&npz, MEAN)?) } else { None };
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
        let times = &found.times;
        let ordered = times.iter().all(|t| t.is_finite()) && times.is_sorted_by(|a, b| a < b);
        first
            .or_else(|| (!found.coefficients.is_all_finite()).then_some("coefficients"))
            .or_else(|| (!ordered).then_some("times"))
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
            // Numbers in the place of times go on from the last old one; some may have been left out.
            let next = self.decomposition.times.last().map_or(0.0, |last| last + 1.0);
            for number in &mut found.times[self.snapshots()..] {
                *number += next;
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
