use super::gmsh::GmshError;
use lumley_fem::MeshError;
use lumley_pod::InnerProductError;
use std::io;
use std::path::{Path, PathBuf};

/// Why a file could not be read or written.
///
/// ```
/// use lumley::format::{FormatError, npy::NpyMatrix};
/// let error = NpyMatrix::open("missing.npy").expect_err("there is no such file");
/// assert!(matches!(error, FormatError::Io { .. }));
/// assert!(error.to_string().contains("missing.npy"));
/// ```
#[derive(Debug, thiserror::Error)]
pub enum FormatError {
    /// The system refused.
    #[error("cannot {action} {}: {source}\n  help: check the path, its permissions and the free space", path.display())]
    Io {
        /// What was tried.
        action: &'static str,
        /// The file.
        path: PathBuf,
        /// The system's answer.
        source: io::Error,
    },
    /// A directory, a pipe or a device.
    #[error("{}: not a regular file\n  help: save the data to a file and name that", path.display())]
    NotAFile {
        /// What was named.
        path: PathBuf,
    },
    /// Some bytes are not what the format prescribes.
    #[error("{}: byte {offset}: expected {expected}, found {found}\n  help: the file is damaged or of another format; write it again", path.display())]
    Bytes {
        /// The file.
        path: PathBuf,
        /// Where, counted from the beginning of the file or of the archive's member.
        offset: u64,
        /// What stands there.
        found: String,
        /// What the format prescribes.
        expected: &'static str,
    },
    /// Numbers of a kind that is not read.
    #[error("{}: numbers of type {found}, expected floats of 4 or 8 bytes or integers\n  help: convert them with numpy.asarray(x, dtype=\"f8\")", path.display())]
    Dtype {
        /// The file.
        path: PathBuf,
        /// NumPy's name of the type.
        found: String,
    },
    /// The array is not of the shape that is needed.
    #[error("{}: an array of shape {shape:?}, expected {expected}\n  help: reshape it with NumPy and save it again", path.display())]
    Shape {
        /// The file.
        path: PathBuf,
        /// Its shape.
        shape: Vec<usize>,
        /// What is needed.
        expected: &'static str,
    },
    /// The header claims more or less than the file holds.
    #[error("{}: the header claims shape {shape:?} of {item} bytes each, but the data take {found} bytes\n  help: the file is truncated or damaged; write it again", path.display())]
    Size {
        /// The file.
        path: PathBuf,
        /// The shape claimed.
        shape: Vec<usize>,
        /// Bytes a number.
        item: usize,
        /// Bytes that there are.
        found: u64,
    },
    /// Weights that make no inner product.
    #[error("{}: {source}", path.display())]
    Weights {
        /// The file.
        path: PathBuf,
        /// What is wrong with them.
        source: InnerProductError,
    },
    /// A file of gmsh that holds no mesh of the plane with named boundaries.
    #[error("{}: {source}", path.display())]
    Gmsh {
        /// The file.
        path: PathBuf,
        /// What is wrong with the mesh.
        source: GmshError,
    },
    /// An archive that holds no mesh.
    #[error("{}: {source}\n  help: the file was changed or damaged; make the run again", path.display())]
    Mesh {
        /// The archive.
        path: PathBuf,
        /// What is wrong with the mesh.
        source: MeshError,
    },
    /// There is not one time for each snapshot.
    #[error("{}: {snapshots} snapshots, but {times} times\n  help: give one time for each snapshot", path.display())]
    TimeCount {
        /// The file of the snapshots.
        path: PathBuf,
        /// Snapshots in it.
        snapshots: usize,
        /// Times given.
        times: usize,
    },
    /// Times do not increase.
    #[error("{}: snapshot {snapshot}: time {time} s does not come after {previous} s\n  help: give finite, strictly increasing times", path.display())]
    TimeOrder {
        /// The file of the snapshots.
        path: PathBuf,
        /// The snapshot, counted from 0.
        snapshot: usize,
        /// Its time, in s.
        time: f64,
        /// The time before, in s.
        previous: f64,
    },
    /// A member of an archive is compressed or encrypted.
    #[error("{}: compressed or encrypted (ZIP method {method})\n  help: save it with numpy.savez instead of numpy.savez_compressed", path.display())]
    Compressed {
        /// Archive and member.
        path: PathBuf,
        /// ZIP's number of the method.
        method: u16,
    },
    /// An archive has no array of this name.
    #[error("{}: no array {name}; it holds {}\n  help: name one of these", path.display(), available.join(", "))]
    NoSuchArray {
        /// The archive.
        path: PathBuf,
        /// The name asked for.
        name: String,
        /// The names it has, the first of them.
        available: Vec<String>,
    },
    /// The bytes of a member do not have the checksum that the archive keeps.
    #[error("{}: CRC-32 {computed:08x}, the archive says {stored:08x}\n  help: the file is damaged; write it again", path.display())]
    Checksum {
        /// Archive and member.
        path: PathBuf,
        /// The checksum kept.
        stored: u32,
        /// The checksum of the bytes.
        computed: u32,
    },
    /// Processes that share an archive do not see one file.
    #[error("{}: {found} bytes of the {expected} that all processes wrote\n  help: put the results on a file system that they share", path.display())]
    NotShared {
        /// The archive.
        path: PathBuf,
        /// Bytes that this process sees.
        found: u64,
        /// Bytes that there must be.
        expected: u64,
    },
    /// A value that would make the file useless.
    #[error("{} is not written: value {place} of {field} is {value}, expected finite numbers\n  help: the computation has diverged; take shorter time steps or a finer mesh", path.display())]
    NotFinite {
        /// The file.
        path: PathBuf,
        /// The field.
        field: String,
        /// The number of the value, counted from 0.
        place: usize,
        /// The value.
        value: f64,
    },
    /// A line of a table is wrong.
    #[error("{}: line {line}: expected {expected}, found {text:?}", path.display())]
    Line {
        /// The file.
        path: PathBuf,
        /// The line, counted from 1.
        line: usize,
        /// What stands there.
        text: String,
        /// What was expected.
        expected: String,
    },
    /// A table is too long to be one.
    #[error("{}: larger than {limit} bytes\n  help: a table is short; give fields as NPY", path.display())]
    LongTable {
        /// The file.
        path: PathBuf,
        /// The limit.
        limit: u64,
    },
}

impl FormatError {
    /// For `map_err`: the system refused to `action` the file `path`.
    pub(crate) fn io<'a>(action: &'static str, path: &'a Path) -> impl Fn(io::Error) -> Self + 'a {
        move |source| Self::Io { action, path: path.to_owned(), source }
    }
}

/// The beginning of what stands in a file, fit for a message.
pub(super) fn excerpt(bytes: &[u8]) -> String {
    let shown = &bytes[..bytes.len().min(40)];
    let ellipsis = if bytes.len() > shown.len() { "..." } else { "" };
    format!("\"{}{ellipsis}\"", shown.escape_ascii())
}
