//! `loads.csv` and `probes.csv`, which have a column `time` and then `NAME.QUANTITY`, and `steps.csv`.

use crate::Error;
use crate::format::csv::read_columns;
use crate::report::{History, ProbeSeries};
use std::path::Path;

/// Column of the times, in s.
const TIME: &str = "time";

/// The times of a table and its columns.
#[derive(Debug, Default)]
pub(super) struct Table {
    pub times: Vec<f64>,
    columns: Vec<(String, Vec<f64>)>,
}

impl Table {
    /// The table in the file, empty where there is no file; of its columns those that are `wanted` by name and
    /// quantity.
    pub(super) fn read(path: &Path, wanted: impl Fn(&str, &str) -> bool) -> Result<Self, Error> {
        if !path.exists() {
            return Ok(Self::default());
        }
        let parts = |header: &str| header.rsplit_once('.').is_some_and(|(name, q)| wanted(name, q));
        let mut columns = read_columns(path, |header| header == TIME || parts(header))?;
        let time = columns.iter().position(|(header, _)| header == TIME);
        let times = time.map(|k| columns.remove(k).1).unwrap_or_default();
        Ok(Self { times, columns })
    }

    /// The column of a quantity, empty where there is none.
    pub(super) fn column(&self, name: &str, quantity: &str) -> Vec<f64> {
        // Separators cannot stand in a header.
        let header = format!("{}.{quantity}", name.replace([',', '"', '\n', '\r'], "_"));
        let found = self.columns.iter().find(|(column, _)| *column == header);
        found.map(|(_, values)| values.clone()).unwrap_or_default()
    }

    /// Names in the order of the columns.
    fn names(&self) -> Vec<&str> {
        let mut names: Vec<&str> = Vec::new();
        for (name, _) in self.columns.iter().filter_map(|(header, _)| header.rsplit_once('.')) {
            if !names.contains(&name) {
                names.push(name);
            }
        }
        names
    }
}

/// What was measured over time in the run in `folder`.
pub(super) fn history(folder: &Path) -> Result<History, Error> {
    let quantities = ["u", "v", "p"];
    let path = folder.join("probes.csv");
    let table = Table::read(&path, |_, quantity| quantities.contains(&quantity))?;
    let probe = |name: &str| {
        let [u, v, pressure] = quantities.map(|quantity| table.column(name, quantity));
        ProbeSeries { name: name.to_owned(), u, v, pressure }
    };
    let steps = columns(&folder.join("steps.csv"), [TIME, "cfl", "iterations"])?;
    let [step_times, cfl, iterations] = steps;
    let [pressure_difference] = columns(&path, ["pressure_difference"])?;
    Ok(History {
        probes: table.names().into_iter().map(probe).collect(),
        times: table.times,
        pressure_difference,
        step_times,
        cfl,
        iterations,
        ..History::default()
    })
}

/// The columns with these headers, empty where they are missing.
fn columns<const N: usize>(path: &Path, headers: [&str; N]) -> Result<[Vec<f64>; N], Error> {
    let mut found = if path.exists() {
        read_columns(path, |header| headers.contains(&header))?
    } else {
        Vec::new()
    };
    Ok(headers.map(|header| {
        let column = found.iter_mut().find(|(name, _)| name == header);
        column.map(|(_, values)| std::mem::take(values)).unwrap_or_default()
    }))
}
