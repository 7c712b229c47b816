use crate::Error;
use crate::format::FormatError;
use crate::format::npy::NpyMatrix;
use crate::format::npz::{NpzReader, NpzWriter};
use faer::Mat;
use lumley_pod::{Decomposition, ReducedBasis};
use std::path::Path;

pub(super) const MODES: &str = "modes";
pub(super) const MEAN: &str = "mean";
const COEFFICIENTS: &str = "coefficients";
const ERROR_BOUND: &str = "error_bound";

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
    /// `coefficients`, `times`, `time_weights`, `spectrum`, `total_energy`, `noise_floor`, `mean` where it
    /// was subtracted, and `error_bound` of an approximation.
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
    npz.vector("spectrum", &found.spectrum)?;
    npz.vector("total_energy", &[found.total_energy])?;
    npz.vector("noise_floor", &[found.noise_floor])?;
    found.error_bound.map_or(Ok(()), |bound| npz.vector(ERROR_BOUND, &[bound]))
}

/// Reads what [`push_small`] wrote beside so many modes; a file keeps no words and no residuals.
pub(super) fn read_small(npz: &NpzReader, modes: usize) -> Result<Decomposition, FormatError> {
    let eigenvalues = sized(npz, "eigenvalues", modes, "one number for each mode")?;
    let singular_values = sized(npz, "singular_values", modes, "one number for each mode")?;
    let times = npz.vector("times")?;
    let time_weights = sized(npz, "time_weights", times.len(), "one number for each of the times")?;
    let coefficients = npz.matrix(COEFFICIENTS)?;
    if (coefficients.rows(), coefficients.cols()) != (modes, times.len()) {
        return Err(misshapen(&coefficients, "a row for each mode and a column for each time"));
    }
    let spectrum = npz.matrix("spectrum")?;
    if spectrum.rows() < modes {
        return Err(misshapen(&spectrum, "at least one number for each mode"));
    }
    let spectrum = spectrum.read_as_vector()?;
    let number = |name| Ok(sized(npz, name, 1, "one number")?[0]);
    let noise_floor = number("noise_floor")?;
    let bounded = npz.names().any(|name| name == ERROR_BOUND);
    Ok(Decomposition {
        algorithm: "",
        eigenvalues,
        singular_values,
        coefficients: coefficients.read()?,
        residuals: Vec::new(),
        rank: spectrum.iter().filter(|lambda| **lambda > noise_floor).count(),
        spectrum,
        total_energy: number("total_energy")?,
        error_bound: if bounded { Some(number(ERROR_BOUND)?) } else { None },
        noise_floor,
        times,
        time_weights,
        passes: 0,
        notes: Vec::new(),
    })
}

/// The vector `name`, which has this length.
fn sized(
    npz: &NpzReader,
    name: &str,
    length: usize,
    expected: &'static str,
) -> Result<Vec<f64>, FormatError> {
    let array = npz.matrix(name)?;
    let values = array.read_as_vector()?;
    if values.len() == length { Ok(values) } else { Err(misshapen(&array, expected)) }
}

/// The error that `array` is not of the shape that is `expected`.
pub(super) fn misshapen(array: &NpyMatrix, expected: &'static str) -> FormatError {
    let (path, shape) = (array.path().to_owned(), array.shape().to_vec());
    FormatError::Shape { path, shape, expected }
}
