use crate::Error;
use crate::format::npz::{NpzReader, NpzWriter};
use faer::Mat;
use lumley_pod::ReducedBasis;
use std::path::Path;

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
        npz.matrix("modes", basis.modes.as_ref())?;
        npz.vector("eigenvalues", &basis.eigenvalues)?;
        npz.vector("singular_values", &basis.singular_values)?;
        npz.matrix("coefficients", basis.coefficients.as_ref())?;
        npz.vector("times", &basis.times)?;
        npz.vector("time_weights", &basis.time_weights)?;
        npz.vector("spectrum", &basis.spectrum)?;
        if let Some(mean) = &basis.mean {
            npz.vector("mean", mean)?;
        }
        Ok(npz.finish()?)
    }

    /// Reads a basis that [`save`](Self::save) wrote.
    ///
    /// # Errors
    /// A file that is damaged or holds something else.
    pub fn load(path: &Path) -> Result<Self, Error> {
        let npz = NpzReader::open(path)?;
        let has_mean = npz.names().any(|name| name == "mean");
        Ok(Self {
            modes: npz.read("modes")?,
            coefficients: npz.read("coefficients")?,
            mean: if has_mean { Some(npz.vector("mean")?) } else { None },
        })
    }
}
