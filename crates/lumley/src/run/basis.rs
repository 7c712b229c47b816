use crate::Error;
use crate::format::FormatError;
use crate::format::npz::{NpzReader, NpzWriter};
use faer::Mat;
use lumley_pod::{Decomposition, ReducedBasis};
use std::path::Path;

pub(super) const MODES: &str = "modes";
pub(super) const MEAN: &str = "mean";
const COEFFICIENTS: &str = "coefficients";

/// A basis on disk: what a reduced model and a report need of it.
///
/// ```
/// use lumley::run::BasisFile;
/// use lumley_pod::{Identity, MemorySnapshots, Options, auto};
/// let snapshots = MemorySnapshots::new(faer::mat![[1.0, 2.0], [0.0, 1.0], [0.0, 0.0]], vec![0.0, 0.1]);
/// let basis = auto(&snapshots, &Identity::new(3), &Options::default())?;
/// # let folder = tempfile::tempdir()?;
/// # let file = folder.path().join("pod.npz");
/// BasisFile::save(&file, &basis)?;
/// assert_eq!(BasisFile::load(&file)?.modes, basis.modes);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct BasisFile {
    /// Modes, n x r.
    pub modes: Mat<f64>,
    /// Coefficients of the snapshots, r x M.
    pub coefficients: Mat<f64>,
    /// The mean, where it was subtracted.
    pub mean: Option<Vec<f64>>,
}

impl BasisFile {
    /// Writes `basis` to `path`, an NPZ file with `modes`, `eigenvalues`, `singular_values`,
    /// `coefficients`, `times`, `time_weights`, `spectrum`, and `mean` where it was subtracted.
    ///
    /// # Errors
    /// The failure of the disk.
    pub fn save(path: &Path, basis: &ReducedBasis) -> Result<(), Error> {
        let mut npz = NpzWriter::create(path)?;
        npz.matrix(MODES, basis.modes.as_ref())?;
        if let Some(mean) = &basis.mean {
            npz.vector(MEAN, mean)?;
        }
        push_small(&mut npz, basis)?;
        Ok(npz.finish()?)
    }

    /// Reads a basis that [`save`](Self::save) or [`FileModes`](super::FileModes) wrote, into memory.
    ///
    /// # Errors
    /// A file that is damaged or holds something else.
    pub fn load(path: &Path) -> Result<Self, Error> {
        let npz = NpzReader::open(path)?;
        let has_mean = npz.names().any(|name| name == MEAN);
        Ok(Self {
            modes: npz.read(MODES)?,
            coefficients: npz.read(COEFFICIENTS)?,
            mean: if has_mean { Some(npz.vector(MEAN)?) } else { None },
        })
    }
}

/// Adds to the modes all that does not grow with them.
pub(super) fn push_small(npz: &mut NpzWriter, found: &Decomposition) -> Result<(), FormatError> {
    npz.vector("eigenvalues", &found.eigenvalues)?;
    npz.vector("singular_values", &found.singular_values)?;
    npz.matrix(COEFFICIENTS, found.coefficients.as_ref())?;
    npz.vector("times", &found.times)?;
    npz.vector("time_weights", &found.time_weights)?;
    npz.vector("spectrum", &found.spectrum)
}
