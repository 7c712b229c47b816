//! lumley: proper orthogonal decomposition (POD) and reduced-order models (ROM) of flows with moving
//! bodies.
//!
//! This crate carries a case from its file to its report: [`case`] files, [`model`]s that can be run, the
//! [`run`] loop and its stages, the [`record`] of snapshots, file [`mod@format`]s, the [`report`], and the
//! [`command`] line. It holds no formula: those are in `lumley-fem`, `-body`, `-pod`, `-fom` and `-rom`.
//!
//! ```
//! use lumley::{case::Case, directory::Existing, progress::Progress, run};
//! let text = lumley::cases::find("piston").expect("it comes with lumley").text;
//! let case = Case::parse("piston/case.toml".as_ref(), text, true, &[])?;
//! let folder = tempfile::tempdir()?;
//! let task = run::Task::new(&folder.path().join("piston"), Existing::default());
//! let (directory, summary) = run::run(&case, &task, &mut Progress::silent())?;
//! assert!(directory.join("report.html").exists());
//! assert!(summary.pod.cumulative_percent[5] > 99.99);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod case;
pub mod cases;
pub mod command;
pub mod directory;
mod error;
pub mod format;
pub mod manifest;
pub mod model;
pub mod progress;
pub mod ranks;
pub mod record;
pub mod report;
pub mod run;
pub mod summary;
pub mod verify;

pub use error::{Error, Kept, OtherDomain};
