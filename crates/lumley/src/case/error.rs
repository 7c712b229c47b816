use crate::format::FormatError;
use lumley_body::TreeError;
use lumley_fem::generate::GenerateError;
use lumley_fem::{MeshError, Point};
use lumley_fom::motion::MotionError;
use std::fmt;
use std::path::PathBuf;

/// Where a value of a case was written.
///
/// ```
/// use lumley::case::Place;
/// let place = Place::Line("case.toml".into(), 12);
/// assert_eq!(place.to_string(), "case.toml, line 12");
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Place {
    /// A line of the case file, counted from 1.
    Line(PathBuf, usize),
    /// The command line: `--set key=value`.
    Setting(String),
    /// Nowhere: the default stands, or the value follows from others in this file.
    Default(PathBuf),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(path, line) => write!(f, "{}, line {line}", path.display()),
            Self::Setting(text) => write!(f, "--set {text}"),
            Self::Default(path) => write!(f, "{} (a default, not written there)", path.display()),
        }
    }
}

/// Why a case file was refused.
///
/// ```
/// use lumley::case::{Case, CaseError};
/// let error = Case::load("no/such/case.toml".as_ref(), false, &[]).unwrap_err();
/// assert!(matches!(error, CaseError::Read { .. }));
/// ```
#[derive(Debug, thiserror::Error)]
pub enum CaseError {
    /// The file cannot be read.
    #[error("cannot read the case file {}: {source}\n  help: `lumley cases` lists the cases that come with lumley", path.display())]
    Read {
        /// The case file.
        path: PathBuf,
        /// The system's answer.
        source: std::io::Error,
    },
    /// A directory, a device, or far too large.
    #[error("{}: expected a case file, a text of at most 1 MiB\n  help: name the file itself, such as cases/piston/case.toml", path.display())]
    NotAFile {
        /// What was named.
        path: PathBuf,
    },
    /// Not TOML, an unknown key or a value of the wrong type.
    #[error("{}{}: {message}\n  help: {help}", path.display(), line.map_or(String::new(), |l| format!(", line {l}")))]
    Syntax {
        /// The case file.
        path: PathBuf,
        /// Line, counted from 1.
        line: Option<usize>,
        /// What the parser found and expected, with the line itself.
        message: String,
        /// What to do.
        help: String,
    },
    /// The case file is right by itself; what is laid over it is not.
    #[error("{} with {overrides}: {message}\n  help: {help}", path.display())]
    Override {
        /// The case file.
        path: PathBuf,
        /// The overrides.
        overrides: String,
        /// What the parser found and expected.
        message: String,
        /// What to do.
        help: String,
    },
    /// `--set` without `key=value`.
    #[error(
        "--set {text}: expected KEY=VALUE with a key of the case, such as piston.mass\n  help: write --set piston.mass=0.5"
    )]
    Setting {
        /// What was given.
        text: String,
    },
    /// Neither or both of the sections that say what is computed.
    #[error("{}: {found} of [piston] and [flow]\n  help: a case has exactly one of them; `lumley cases piston` and `lumley cases cavity` print one of each", path.display())]
    Kind {
        /// The case file.
        path: PathBuf,
        /// How many of them there are.
        found: &'static str,
    },
    /// A case of one kind where another is needed.
    #[error("the case {name} is one of a {found}; this needs one of a {needed}")]
    OtherKind {
        /// Name of the case.
        name: String,
        /// What it is a case of.
        found: &'static str,
        /// What is needed.
        needed: &'static str,
    },
    /// A key that must be there is not.
    #[error("{place}: {key} is missing: expected {expected}")]
    Missing {
        /// Where it should stand.
        place: Place,
        /// The key, with its tables.
        key: String,
        /// What was expected, and what to do.
        expected: String,
    },
    /// No mesh can be made.
    #[error("{place}: {source}")]
    Generate {
        /// The section.
        place: Place,
        /// Why.
        source: Box<GenerateError>,
    },
    /// A mesh that was made or read cannot be computed with.
    #[error("{place}: {source}")]
    Mesh {
        /// The section.
        place: Place,
        /// Why.
        source: Box<MeshError>,
    },
    /// A mesh file cannot be read.
    #[error(
        "{place}: mesh.file: {source}\n  help: name a .msh file of gmsh, relative to the case file"
    )]
    MeshFile {
        /// Where the file is named.
        place: Place,
        /// Why.
        source: Box<FormatError>,
    },
    /// The mesh cannot move so.
    #[error("{place}: {source}")]
    Motion {
        /// The section.
        place: Place,
        /// Why.
        source: Box<MotionError>,
    },
    /// The bodies make no tree.
    #[error("{place}: {source}")]
    Bodies {
        /// The body, or what is wrong with it.
        place: Place,
        /// Why.
        source: Box<TreeError>,
    },
    /// A body that starts where another one or a wall is.
    #[error("{place}: at the start the body {body} meets {other} near ({:.6}, {:.6}) m: expected bodies apart from each other and within the walls\n  help: let it start elsewhere, or give it more room", near[0], near[1])]
    Meets {
        /// What says where it starts.
        place: Place,
        /// Its name.
        body: String,
        /// What is in its way.
        other: String,
        /// Where, in m.
        near: Point,
    },
    /// A setting goes into a list that has no such entry.
    #[error(
        "--set {key}: {list} has no entry of the name {name}\n  help: {list} has {}",
        one_of(known)
    )]
    Entry {
        /// What was to be set.
        key: String,
        /// The list.
        list: String,
        /// The name that was not found.
        name: String,
        /// The names of its entries.
        known: Vec<String>,
    },
    /// A value that no computation can use.
    #[error("{place}: {key} = {value}: expected {expected}")]
    Value {
        /// Where it was written.
        place: Place,
        /// The key, with its tables.
        key: String,
        /// The value found.
        value: String,
        /// What was expected, and what to do.
        expected: String,
    },
}

fn one_of(names: &[String]) -> String {
    if names.is_empty() { "none with a name".into() } else { names.join(", ") }
}
