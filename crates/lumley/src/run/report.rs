use super::piston;
use super::stages::{CASE, check_is_of_a_case};
use crate::Error;
use crate::case::Case;
use crate::directory;
use crate::report::{FlowReport, Report};
use faer::MatRef;
use std::path::Path;

/// Writes `report.html` and `figures/` of the run in `folder`.
///
/// # Errors
/// A file of the run that is missing or damaged, or the failure of the disk.
pub fn write(folder: &Path) -> Result<(), Error> {
    check_is_of_a_case(folder)?;
    let page = match Case::load(&folder.join(CASE), false, &[])? {
        Case::Piston(case) => piston::report(folder, &case)?.render(),
        Case::Flow(_) => FlowReport::of_run(folder)?.render(),
    };
    save(folder, &page)
}

/// Writes a page and its figures into `folder`.
pub(super) fn save(folder: &Path, report: &Report) -> Result<(), Error> {
    directory::write(folder, "report.html", report.page.as_bytes())?;
    for (file, svg) in &report.figures {
        directory::write(folder, &format!("figures/{file}"), svg.as_bytes())?;
    }
    Ok(())
}

pub(super) fn columns(x: MatRef<'_, f64>) -> Vec<Vec<f64>> {
    x.col_iter().map(|column| column.iter().copied().collect()).collect()
}
