use crate::format::{FormatError, atomic};
use std::fmt::Write;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

const HEAD: &str =
    "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n<Collection>\n";
const TAIL: &str = "</Collection>\n</VTKFile>\n";

/// A series of files in time, which ParaView opens as one (`.pvd`).
///
/// It is written anew, whole or not at all, with every file that it takes: a run that is killed leaves
/// all that was complete.
///
/// ```
/// use lumley::format::vtu::Collection;
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("flow.pvd");
/// let mut series = Collection::new(&path);
/// for (time, file) in [(0.1, "flow-0.vtu"), (0.2, "flow-1.vtu"), (0.3, "flow-2.vtu")] {
///     series.push(time, file)?;
/// }
/// // A run that goes on from a checkpoint at 0.2 s.
/// let resumed = Collection::resume(&path, 0.2)?;
/// assert_eq!(resumed.entries(), [(0.1, "flow-0.vtu".to_string()), (0.2, "flow-1.vtu".into())]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Collection {
    path: PathBuf,
    entries: Vec<(f64, String)>,
}

impl Collection {
    /// An empty series; its file, and the place of an older one, are taken with the first entry.
    pub fn new(path: impl Into<PathBuf>) -> Self {
        Self { path: path.into(), entries: Vec::new() }
    }

    /// The series that stands in a file, without what is later than `until`, in s; empty if there is no file.
    ///
    /// What was dropped leaves the file with the next entry.
    ///
    /// # Errors
    /// [`FormatError`]: the file is not one that a `Collection` wrote, with the line.
    pub fn resume(path: impl Into<PathBuf>, until: f64) -> Result<Self, FormatError> {
        let path = path.into();
        let mut entries = match std::fs::read_to_string(&path) {
            Ok(text) => parse(&path, &text)?,
            Err(e) if e.kind() == ErrorKind::NotFound => Vec::new(),
            Err(e) => return Err(FormatError::io("read", &path)(e)),
        };
        entries.retain(|(time, _)| *time <= until);
        Ok(Self { path, entries })
    }

    /// Time, in s, and name of each file.
    pub fn entries(&self) -> &[(f64, String)] {
        &self.entries
    }

    /// Adds a file in the folder of the series, or in one below it, and writes the series.
    ///
    /// # Errors
    /// [`FormatError::TimeOrder`]; [`FormatError::Io`]: the older file then stands as it was, and the entry
    /// is in the next one.
    ///
    /// # Panics
    /// If the name is not made of letters, digits and `-_./`.
    pub fn push(&mut self, time: f64, file: &str) -> Result<(), FormatError> {
        assert!(file.chars().all(is_plain), "{file:?}: a name of letters, digits and -_./");
        let previous = self.entries.last().map_or(f64::NEG_INFINITY, |(time, _)| *time);
        if !(time.is_finite() && time > previous) {
            let (path, snapshot) = (self.path.clone(), self.entries.len());
            return Err(FormatError::TimeOrder { path, snapshot, time, previous });
        }
        self.entries.push((time, file.to_owned()));
        atomic::write(&self.path, self.text().as_bytes())
            .map_err(FormatError::io("write", &self.path))
    }

    fn text(&self) -> String {
        let mut text = String::from(HEAD);
        for (time, file) in &self.entries {
            writeln!(text, "<DataSet timestep=\"{time:?}\" file=\"{file}\"/>")
                .expect("a string takes what it is given");
        }
        text + TAIL
    }
}

fn is_plain(c: char) -> bool {
    c.is_ascii_alphanumeric() || "-_./".contains(c)
}

fn parse(path: &Path, text: &str) -> Result<Vec<(f64, String)>, FormatError> {
    let wrong = |line: usize, expected: &str| FormatError::Line {
        path: path.to_owned(),
        line,
        text: text.lines().nth(line - 1).unwrap_or_default().chars().take(60).collect(),
        expected: expected.to_owned(),
    };
    let body = text.strip_prefix(HEAD).ok_or_else(|| wrong(1, "the head of a series of lumley"))?;
    let lines = body.strip_suffix(TAIL);
    let lines = lines.ok_or_else(|| wrong(text.lines().count().max(1), "the end of the series"))?;
    let first = HEAD.lines().count() + 1;
    let mut entries: Vec<(f64, String)> = Vec::new();
    for (number, line) in (first..).zip(lines.lines()) {
        let found = entry(line).ok_or_else(|| wrong(number, "a time in s and a file"))?;
        if entries.last().is_some_and(|(previous, _)| found.0 <= *previous) {
            return Err(wrong(number, "a time after that of the line before"));
        }
        entries.push(found);
    }
    Ok(entries)
}

fn entry(line: &str) -> Option<(f64, String)> {
    let (time, rest) = line.strip_prefix("<DataSet timestep=\"")?.split_once("\" file=\"")?;
    let (time, file) = (time.parse::<f64>().ok()?, rest.strip_suffix("\"/>")?);
    (time.is_finite() && file.chars().all(is_plain)).then(|| (time, file.to_owned()))
}
