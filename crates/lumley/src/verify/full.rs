use super::Tolerance::{AtMost, Relative};
use super::flow::{Benchmark, Expected};
use super::{Row, Tolerance, res};
use crate::Error;
use crate::case::{Case, PistonCase};
use crate::cases;
use crate::directory::Existing;
use crate::progress::Progress;
use crate::record::Record;
use crate::run::{self, Task};
use crate::summary::Summary;
use lumley_pod::trajectory_residual;
use std::path::{Path, PathBuf};

/// Largest growth of a reduced model's error when parameters or the time change.
const GROWTH: f64 = 1.25;

/// Relative max-L2 error of a time scheme at a step of 0.01 s, in percent.
const SCHEMES: [(&str, &str, [f64; 2]); 3] = [
    ("implicit-euler", "implicit Euler, step 0.01 s", [43.0, 13.0]),
    ("bdf2", "BDF2, step 0.01 s", [3.2, 0.8]),
    ("crank-nicolson", "Crank-Nicolson, step 0.01 s", [0.8, 0.2]),
];

/// Models with an interface condition, and their lines in the table.
const MODELS: [(&str, [&str; 4]); 3] = [
    ("multiplier", ["c2, T = 10 s", "c2, K + 20 %", "c2, b + 20 %", "c2, m + 20 %"]),
    ("penalty", ["c3, T = 10 s", "c3, K + 20 %", "c3, b + 20 %", "c3, m + 20 %"]),
    ("mapped", ["mapped, T = 10 s", "mapped, K + 20 %", "mapped, b + 20 %", "mapped, m + 20 %"]),
];
/// The changes, in the order of those lines.
const CHANGES: [&str; 4] =
    ["time.end=10", "piston.stiffness=47.4", "piston.damping=0.12", "piston.mass=0.6"];

/// A place for runs that are looked at and thrown away.
pub(super) struct Bench<'a> {
    folder: PathBuf,
    progress: &'a mut Progress,
}

impl<'a> Bench<'a> {
    pub(super) fn new(folder: &Path, progress: &'a mut Progress) -> Self {
        Self { folder: folder.to_owned(), progress }
    }

    /// The canonical case with `settings`, run into the folder `name`.
    pub(super) fn run(
        &mut self,
        name: &str,
        settings: &[String],
    ) -> Result<(PistonCase, Summary), Error> {
        let text = cases::find("piston").map_or("", |case| case.text);
        let case = Case::parse("piston/case.toml".as_ref(), text, false, settings)?;
        let (_, summary) = run::run(&case, &self.task(name), self.progress)?;
        Ok((case.piston()?, summary))
    }

    /// The rows of a flow. That the computation fails is an error unless it is what must come out.
    pub(super) fn flow(&mut self, benchmark: &Benchmark) -> Result<Vec<Row>, Error> {
        let Benchmark { name, case, settings, coarse, expected, .. } = benchmark;
        let text = cases::find(case).map_or("", |case| case.text);
        let settings: Vec<String> = settings.iter().map(|&s| s.to_owned()).collect();
        let path = format!("{case}/case.toml");
        let case = Case::parse(path.as_ref(), text, *coarse, &settings)?;
        let folder = name.replace(['/', ' '], "-");
        match run::run(&case, &self.task(&folder), self.progress) {
            Ok((_, summary)) => Ok(benchmark.rows(Some(&summary))),
            Err(Error::Stopped { .. }) if matches!(expected, Expected::BlowUp(_)) => {
                Ok(benchmark.rows(None))
            }
            Err(error) => Err(error),
        }
    }

    fn task(&self, name: &str) -> Task {
        Task::new(&self.folder.join(name), Existing { replace: true, resume: false })
    }

    /// The lines that take longer, for case number `case` with its `settings`, whose run stands in `name`.
    pub(super) fn rows(
        &mut self,
        case: usize,
        name: &'static str,
        settings: &[String],
        summary: &Summary,
    ) -> Result<Vec<Row>, Error> {
        let mut rows = Vec::new();
        for (scheme, quantity, references) in SCHEMES {
            let computed = self.time_error(name, scheme, settings)?;
            // The references are given to one or two digits.
            rows.push(row(name, quantity, references[case], Relative(0.15), Some(computed)));
        }
        for (k, change) in CHANGES.into_iter().enumerate() {
            let source = self.folder.join(name);
            let task = self.task("changed");
            let (_, changed) = run::rerun(&source, &[change.into()], true, &task, self.progress)?;
            for (label, quantities) in MODELS {
                let limit = GROWTH * res(summary, label, 6).unwrap_or_default();
                rows.push(row(name, quantities[k], limit, AtMost, res(&changed, label, 6)));
            }
        }
        let long = [settings, &["rom.step=5e-4".into()]].concat();
        let (_, long) = self.run("long-step", &long)?;
        let quantity = "c3, Res(8) with step 5e-4 s: blows up";
        rows.push(row(name, quantity, 100.0, Tolerance::AtLeast, res(&long, "penalty", 8)));
        Ok(rows)
    }

    /// How far the velocity with a step of 0.01 s is from that of the run in `name`, in percent.
    fn time_error(&mut self, name: &str, scheme: &str, settings: &[String]) -> Result<f64, Error> {
        let coarse =
            ["time.step=0.01".into(), format!("time.scheme={scheme}"), "rom.models=[]".into()];
        let (case, _) = self.run("coarse", &[settings, &coarse].concat())?;
        let path = |name: &str| self.folder.join(name).join("record");
        let (fine, coarse) = (Record::open(path(name))?, Record::open(path("coarse"))?);
        let product = run::grid_product(&case.grid, 1);
        let error = trajectory_residual(&fine.frame("fixed")?, &coarse.frame("fixed")?, &product);
        Ok(100.0 * error.map_err(Error::pod(&path("coarse")))?)
    }
}

fn row(
    case: &'static str,
    quantity: &'static str,
    reference: f64,
    tolerance: Tolerance,
    computed: Option<f64>,
) -> Row {
    Row { case, quantity: quantity.to_owned(), unit: "%", reference, tolerance, computed }
}
