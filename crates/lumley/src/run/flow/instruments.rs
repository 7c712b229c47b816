//! What is measured as a flow goes on: `loads.csv`, `steps.csv`, `bodies.csv`, `probes.csv`.

use super::bodies::{self, BODIES};
use super::points::Points;
use crate::case::{FlowCase, Reference};
use crate::format::FormatError;
use crate::format::table::GrowingTable;
use crate::model::{FlowModel, Model, StepReport};
use std::path::Path;

pub(super) const LOADS: &str = "loads.csv";
pub(super) const STEPS: &str = "steps.csv";
pub(super) const PROBES: &str = "probes.csv";
/// Columns of `steps.csv`.
const STEP_HEADERS: [&str; 6] = ["time", "step", "cfl", "iterations", "renewals", "error"];

/// The tables that grow with the run.
pub(super) struct Instruments {
    loads: GrowingTable,
    steps: GrowingTable,
    bodies: Option<GrowingTable>,
    probes: Option<GrowingTable>,
    points: Points,
    reference: Option<Reference>,
    /// Steps between rows.
    every: u64,
    /// Kept, so that a row takes no memory.
    row: Vec<f64>,
}

impl Instruments {
    /// The tables in `folder`: new ones, or cut to `lengths` in bytes to go on with.
    pub fn open(
        case: &FlowCase,
        points: Points,
        folder: &Path,
        lengths: Option<&[u64]>,
    ) -> Result<Self, FormatError> {
        let mut lengths = lengths.map(|lengths| lengths.iter().copied());
        let mut table = |name: &str, headers: &[String]| match &mut lengths {
            None => GrowingTable::create(&folder.join(name), headers),
            Some(lengths) => {
                GrowingTable::resume(&folder.join(name), lengths.next().unwrap_or_default())
            }
        };
        let bodies = case.bodies.as_ref().map(|choice| bodies::headers(&choice.tree));
        let probes = points.headers();
        Ok(Self {
            loads: table(LOADS, &load_headers(case))?,
            steps: table(STEPS, &STEP_HEADERS.map(str::to_owned))?,
            bodies: bodies.map(|headers| table(BODIES, &headers)).transpose()?,
            probes: if probes.len() > 1 { Some(table(PROBES, &probes)?) } else { None },
            points,
            reference: case.reference,
            every: case.loads_every as u64,
            row: Vec::new(),
        })
    }

    /// A row of each table after a step of `dt`, in s, if one is due.
    pub fn stepped(
        &mut self,
        model: &FlowModel,
        report: &StepReport,
        dt: f64,
    ) -> Result<(), FormatError> {
        if !model.flow().steps().is_multiple_of(self.every) {
            return Ok(());
        }
        let time = model.time();
        self.measure(model, time)?;
        self.follow(model)?;
        let (iterations, renewals) = (report.iterations as f64, report.renewals as f64);
        let error = model.last_step().extrapolation_error;
        self.steps.row(&[time, dt, model.courant_number(), iterations, renewals, error])
    }

    /// Loads and probes at `time`, in s.
    pub fn measure(&mut self, model: &FlowModel, time: f64) -> Result<(), FormatError> {
        let Self { row, reference, .. } = self;
        row.clear();
        row.push(time);
        for load in model.flow().loads() {
            row.extend([load.force[0], load.force[1], load.moment]);
            if let Some(reference) = reference {
                row.extend(reference.coefficients(load.force));
            }
        }
        self.loads.row(row)?;
        let Some(probes) = &mut self.probes else { return Ok(()) };
        row.clear();
        row.push(time);
        self.points.measure(model, row);
        probes.row(row)
    }

    /// Where the bodies are.
    pub fn follow(&mut self, model: &FlowModel) -> Result<(), FormatError> {
        let (Some(table), Some(bodies)) = (&mut self.bodies, model.flow().bodies()) else {
            return Ok(());
        };
        self.row.clear();
        self.row.push(model.time());
        bodies::measure(bodies, &mut self.row);
        table.row(&self.row)
    }

    /// Lengths in bytes, in the order in which [`open`](Self::open) takes them.
    pub fn lengths(&self) -> Vec<u64> {
        let tables = [&self.loads, &self.steps].into_iter();
        let tables = tables.chain(&self.bodies).chain(&self.probes);
        tables.map(GrowingTable::length).collect()
    }

    /// Hands everything to the system, and to the disk if it is to `stay`.
    pub fn flush(&mut self, stay: bool) -> Result<(), FormatError> {
        let tables = [&mut self.loads, &mut self.steps].into_iter();
        let mut tables = tables.chain(&mut self.bodies).chain(&mut self.probes);
        tables.try_for_each(|table| if stay { table.sync() } else { table.flush() })
    }
}

fn load_headers(case: &FlowCase) -> Vec<String> {
    let quantities: &[&str] = match case.reference {
        Some(_) => &["fx", "fy", "moment", "cd", "cl"],
        None => &["fx", "fy", "moment"],
    };
    let names = case.mesh.topology().boundaries().iter();
    let of = |name: &str| quantities.iter().map(|q| column(name, q)).collect::<Vec<_>>();
    std::iter::once("time".into()).chain(names.flat_map(|b| of(&b.name))).collect()
}

/// The header of a quantity, without what separates columns.
pub(super) fn column(name: &str, quantity: &str) -> String {
    format!("{}.{quantity}", name.replace([',', '"', '\n', '\r'], "_"))
}
