//! The report of a piston run, paper section 4: one file per section of the page.

mod coefficients;
mod cost;
mod data;
mod energies;
mod fields;
mod model;
mod modes;
mod motion;
mod player;
mod residual;
#[cfg(test)]
mod sample;
#[cfg(test)]
mod tests;

pub use data::{
    EqualAccuracy, Frame, ModeSet, Outcome, Parameters, RomResults, RomRun, Trajectory,
    TransferError, Variant,
};

use super::figure::Series;
use super::html::{Page, Report};
use super::{energy, literal, number, provenance::Provenance};

/// Everything that the report of a piston run shows.
///
/// Vectors may be empty or shorter than the times (a model that blew up, a quick run): what is
/// missing is left out.
///
/// ```
/// use lumley::report::PistonReport;
///
/// let report = PistonReport { name: "piston".into(), ..PistonReport::default() }.render();
/// assert!(report.page.contains("<h1>piston</h1>"));
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PistonReport {
    /// Name of the case.
    pub name: String,
    /// The constants of the case.
    pub parameters: Parameters,
    /// Times of the snapshots, in s.
    pub times: Vec<f64>,
    /// The full model.
    pub full: Trajectory,
    /// λ of all modes, largest first, in m³/s².
    pub eigenvalues: Vec<f64>,
    /// Modes on the fixed grid, whose nodes are those of all fields.
    pub fixed_grid: ModeSet,
    /// Modes in the reference frame, empty if there is no mapped model.
    pub reference: ModeSet,
    /// Res(N) of the projection in %, N = 1, 2, ...
    pub projection: Vec<f64>,
    /// The reduced models.
    pub reduced: Vec<RomResults>,
    /// Coarser full models, each cheaper than all that are more accurate.
    pub variants: Vec<Variant>,
    /// Errors of the ways to the fixed grid.
    pub transfer: Vec<TransferError>,
    /// Where the numbers come from.
    pub provenance: Provenance,
}

impl PistonReport {
    /// The page and its figures.
    pub fn render(&self) -> Report {
        let page = Page::new(&literal(&self.name), &self.summary()).facts(self.facts());
        page.section(player::section(self))
            .section(model::section(self))
            .section(motion::section(self))
            .section(fields::section(self))
            .section(energies::section(self))
            .section(residual::section(self))
            .section(modes::section(self))
            .section(coefficients::section(self))
            .section(cost::section(self))
            .section(cost::transfer_section(self))
            .section(self.provenance.section())
            .render()
    }

    fn summary(&self) -> String {
        let coupling = match self.parameters.force_factor {
            0.0 => "driven by",
            _ => "coupled with",
        };
        format!(
            "Burgers flow {coupling} a block on a spring over {} s: the full-order model, its \
             proper orthogonal decomposition, and reduced-order models of it, compared.",
            number::exact(self.parameters.end)
        )
    }

    /// The key numbers and what they are.
    fn facts(&self) -> Vec<(String, String)> {
        let mut facts = Vec::new();
        if let Some(modes) = energy::modes_for_target(&self.shares()) {
            let meaning = "hold 99.99 % of the energy".into();
            facts.push((
                number::count(modes) + if modes == 1 { " mode" } else { " modes" },
                meaning,
            ));
        }
        if let Some((best, res)) = self.best().and_then(|best| Some((best, best.shown_res()?))) {
            let meaning = format!("Res of the best reduced model: {}", named(best));
            facts.push((number::significant(res, 2) + " %", meaning));
            if let Some(ratio) = cost::speed_ratio(best) {
                let meaning = "as fast as the cheapest full model that is no less accurate".into();
                facts.push((number::significant(ratio, 2) + " ×", meaning));
            }
        }
        let total = self.provenance.seconds();
        if total > 0.0 {
            facts.push((number::duration(total), "for the whole run".into()));
        }
        facts
    }

    fn shares(&self) -> Vec<energy::Share> {
        energy::shares(&self.eigenvalues, self.eigenvalues.iter().sum())
    }

    /// The reduced model whose shown run is the most accurate.
    fn best(&self) -> Option<&RomResults> {
        let finished = self.reduced.iter().filter_map(|model| Some((model, model.shown_res()?)));
        finished.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(model, _)| model)
    }

    /// The modes of a frame.
    fn mode_set(&self, frame: Frame) -> &ModeSet {
        match frame {
            Frame::FixedGrid => &self.fixed_grid,
            Frame::Reference => &self.reference,
        }
    }

    /// One curve over time for the full model and for each reduced model's shown run.
    fn compare(&self, quantity: impl Fn(&Trajectory) -> &[f64]) -> Vec<Series> {
        let full = Series::reference("full model", &self.times, quantity(&self.full));
        let reduced = self.reduced.iter().enumerate().map(|(k, model)| {
            Series::line(&named(model), &self.times, quantity(&model.trajectory)).colour(k)
        });
        std::iter::once(full).chain(reduced).collect()
    }
}

/// Name of a reduced model with the number of modes shown, in markup.
fn named(model: &RomResults) -> String {
    format!("{}, *N* = {}", literal(&model.name), model.shown)
}
