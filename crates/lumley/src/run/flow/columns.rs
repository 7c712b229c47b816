use crate::Error;
use crate::format::FormatError;
use crate::format::csv::read_columns;
use lumley_fom::signal::{Signal, SignalError};
use std::path::PathBuf;

/// A table of a run, by its headers.
pub(super) struct Columns {
    path: PathBuf,
    columns: Vec<(String, Vec<f64>)>,
}

impl Columns {
    pub fn read(path: PathBuf) -> Result<Self, FormatError> {
        Ok(Self { columns: read_columns(&path, |_| true)?, path })
    }

    pub fn of(&self, header: &str) -> Result<&[f64], Error> {
        let found = self.columns.iter().find(|(name, _)| name == header);
        found.map(|(_, values)| &values[..]).ok_or_else(|| {
            let message = format!("it has no column {header}");
            Error::Damaged { path: self.path.clone(), message }
        })
    }

    /// Whether there is no row yet.
    pub fn is_empty(&self) -> bool {
        self.columns.first().is_none_or(|(_, values)| values.is_empty())
    }

    /// A column over the times.
    pub fn signal(&self, header: &str) -> Result<Signal<'_>, Error> {
        let damaged =
            |e: SignalError| Error::Damaged { path: self.path.clone(), message: e.to_string() };
        Signal::new(self.of("time")?, self.of(header)?).map_err(damaged)
    }
}
