use super::basis::{MEAN, MODES, push_small};
use super::scratch::Scratch;
use crate::Error;
use crate::format::FormatError;
use crate::format::npz::{NpzReader, NpzRows};
use crate::ranks::together;
use crate::report::{DrawnModes, FieldGrid};
use faer::{Mat, MatMut, MatRef};
use lumley_pod::{Decomposition, ModeStore, Ranks};
use std::io;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::{PoisonError, RwLock};

/// Modes that go to `pod.npz` of a run as they are found: they may be larger than memory, and several
/// processes may write them, each its own rows.
///
/// On the way there are two files beside it. `modes.scratch` holds the columns that are yet to be made
/// orthonormal; what a killed run wrote into it is there when that run goes on. The archive itself
/// is `pod.npz.partial` until [`finish`](Self::finish). The scratch file stays: a journal counts on it, and must
/// go first. So a run takes twice the disk of its modes.
///
/// ```
/// use lumley::run::{BasisFile, FileModes};
/// use lumley_pod::{ALGORITHMS, Alone, Execution, Identity, MemorySnapshots, Options};
/// let folder = tempfile::tempdir()?;
/// let x = MemorySnapshots::new(faer::mat![[3.0, 0.0], [0.0, 4.0], [0.0, 0.0]], vec![0.0, 1.0]);
/// let (w, options, modes) = (Identity::new(3), Options::default(), FileModes::new(folder.path()));
/// let found = (ALGORITHMS[0].stream)(&x, &w, &options, Execution::default(), &modes)?;
/// modes.finish(&Alone, &found)?;
/// assert_eq!(BasisFile::load(&folder.path().join("pod.npz"))?.modes.shape(), (3, 2));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct FileModes {
    folder: PathBuf,
    scratch: Slot<Scratch>,
    archive: Slot<NpzRows>,
}

impl FileModes {
    /// Modes that will be in `folder`, which all processes see.
    pub fn new(folder: &Path) -> Self {
        Self { folder: folder.to_owned(), scratch: Slot::default(), archive: Slot::default() }
    }

    /// Completes `pod.npz` with all that `found` says of the modes.
    /// Every rank calls it once the modes are published; rank 0 completes the file.
    ///
    /// # Errors
    /// The failure of the disk, on this rank or another; an older `pod.npz` then stands as it was.
    ///
    /// # Panics
    /// If the modes were not published.
    pub fn finish(self, ranks: &dyn Ranks, found: &Decomposition) -> Result<(), Error> {
        let Self { folder, scratch, archive } = self;
        let archive = archive.into_inner().unwrap_or_else(PoisonError::into_inner);
        let archive = archive.expect("modes are published before they are finished");
        drop(scratch);
        together(ranks, archive.sync().map_err(Error::from))?;
        let done = if ranks.rank() == 0 {
            let others = 1..ranks.count();
            others.for_each(|rank| archive.add_checksums(&ranks.receive(rank)));
            complete(archive, &folder, found).map_err(Error::from)
        } else {
            ranks.send(0, &archive.checksums());
            Ok(())
        };
        together(ranks, done)
    }
}

/// Name of the file of the columns that are yet to be made orthonormal.
pub(super) const SCRATCH: &str = "modes.scratch";

fn scratch(folder: &Path) -> PathBuf {
    folder.join(SCRATCH)
}

/// Adds what is small to the modes and gives the archive its name.
fn complete(archive: NpzRows, folder: &Path, found: &Decomposition) -> Result<(), FormatError> {
    let mut npz = archive.complete(&folder.join("pod.npz"))?;
    push_small(&mut npz, found)?;
    npz.finish()
}

impl ModeStore for FileModes {
    fn reserve(&self, rows: usize, columns: usize) -> io::Result<()> {
        open(&self.scratch, Scratch::open(&scratch(&self.folder), rows, columns))
    }

    fn write(&self, rows: Range<usize>, columns: MatRef<'_, f64>) -> io::Result<()> {
        with(&self.scratch, |scratch| scratch.write(rows.start, columns))
    }

    fn read(&self, rows: Range<usize>, out: MatMut<'_, f64>) -> io::Result<()> {
        with(&self.scratch, |scratch| scratch.read(rows, out))
    }

    fn sync(&self) -> io::Result<()> {
        // A pass that writes no columns has nothing to bring to the disk.
        let slot = self.scratch.read().unwrap_or_else(PoisonError::into_inner);
        slot.as_ref().map_or(Ok(()), Scratch::sync).map_err(io::Error::other)
    }

    fn begin(&self, rows: usize, modes: usize, mean: bool) -> io::Result<()> {
        let arrays: [(&str, &[usize]); 2] = [(MODES, &[rows, modes]), (MEAN, &[rows])];
        let arrays = if mean { &arrays[..] } else { &arrays[..1] };
        open(&self.archive, NpzRows::open(&self.folder.join("pod.npz.partial"), arrays))
    }

    fn publish(
        &self,
        rows: Range<usize>,
        modes: MatRef<'_, f64>,
        mean: Option<&[f64]>,
    ) -> io::Result<()> {
        with(&self.archive, |archive| {
            archive.write(MODES, rows.clone(), modes)?;
            mean.map_or(Ok(()), |mean| {
                archive.write(MEAN, rows, MatRef::from_column_major_slice(mean, mean.len(), 1))
            })
        })
    }
}

/// A file that is there once room was made in it, for any thread.
type Slot<T> = RwLock<Option<T>>;

fn open<T>(slot: &Slot<T>, opened: Result<T, FormatError>) -> io::Result<()> {
    let opened = opened.map_err(io::Error::other)?;
    *slot.write().unwrap_or_else(PoisonError::into_inner) = Some(opened);
    Ok(())
}

fn with<T>(slot: &Slot<T>, work: impl FnOnce(&T) -> Result<(), FormatError>) -> io::Result<()> {
    let slot = slot.read().unwrap_or_else(PoisonError::into_inner);
    work(slot.as_ref().expect("room was made before")).map_err(io::Error::other)
}

/// What a report draws of the first modes in the file `path`: they are read by blocks, and where no grid
/// is given not at all.
pub(super) fn drawn(path: &Path, grid: Option<FieldGrid>) -> Result<Option<DrawnModes>, Error> {
    let Some(grid) = grid else { return Ok(None) };
    // Its checksum would take a pass over all modes.
    let all = NpzReader::open(path)?.unchecked(MODES)?;
    if all.rows() != grid.len() {
        let (path, shape) = (all.path().to_owned(), all.shape().to_vec());
        let expected = "one row for each number on the grid";
        return Err(FormatError::Shape { path, shape, expected }.into());
    }
    let modes = DrawnModes::COUNT.min(all.cols());
    let drawn = DrawnModes::sample(grid, modes, |rows| {
        let mut block = Mat::zeros(rows.len(), modes);
        all.read_block(rows, 0..modes, block.as_mut()).map(|()| block)
    });
    Ok(Some(drawn?))
}
