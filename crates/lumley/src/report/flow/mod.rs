//! The report of a flow: one file per section of the page.

mod bodies;
mod data;
mod film;
mod fixed_grid;
mod history;
mod known;
mod loads;
mod mesh;
mod modes;
mod near;
mod outlines;
mod pictures;
mod projection;
mod read;
mod rings;
#[cfg(test)]
mod sample;
mod settings;
#[cfg(test)]
mod tests;

pub use bodies::{
    BodiesReport, BodyMotion, BodyNumbers, CoordinateMotion, CoordinateNumbers, FinalState,
};
pub use data::{
    BoundaryLoads, FlowModes, FlowReference, FlowSettings, FlowWork, History, LoadNumbers,
    ProbeSeries, Scene, ThinnedModes, TransferNumbers,
};
pub use film::{Film, View};

use super::html::{Page, Report};
use super::number::{count, duration, short, significant};
use super::{literal, provenance::Provenance};

/// Everything that the report of a flow shows; what is missing is left out.
///
/// ```
/// use lumley::report::FlowReport;
///
/// let report = FlowReport { name: "cavity".into(), ..FlowReport::default() }.render();
/// assert!(report.page.contains("<h1>cavity</h1>"));
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FlowReport {
    /// Name of the case.
    pub name: String,
    /// The fluid and how it was computed.
    pub settings: FlowSettings,
    /// What the flow looks like.
    pub scene: Scene,
    /// The bodies and how they moved.
    pub bodies: BodiesReport,
    /// Times of the loads, in s.
    pub load_times: Vec<f64>,
    /// The loads on the boundaries.
    pub loads: Vec<BoundaryLoads>,
    /// The pressure difference between the two points of the case at the end, in Pa.
    pub pressure_difference: Option<f64>,
    /// What was measured over time.
    pub history: History,
    /// The work of the run.
    pub work: FlowWork,
    /// The decomposition.
    pub modes: Option<FlowModes>,
    /// The ways to the fixed grid.
    pub transfer: Vec<TransferNumbers>,
    /// What the reader should know, in sentences.
    pub warnings: Vec<String>,
    /// Where the numbers come from.
    pub provenance: Provenance,
}

impl FlowReport {
    /// The page and its figures.
    pub fn render(&self) -> Report {
        let page = Page::new(&literal(&self.name), &self.summary()).facts(self.facts());
        let glance = self
            .warnings
            .iter()
            .fold(pictures::section(self), |section, warning| section.warning(&literal(warning)));
        let page = known::section(self).into_iter().fold(page.section(glance), Page::section);
        let page = bodies::section(self).into_iter().fold(page, Page::section);
        let page = page.section(loads::section(self));
        let page = history::probes(self).into_iter().fold(page, Page::section);
        let page = page.section(settings::section(self)).section(mesh::section(self));
        let page = modes::sections(self).into_iter().fold(page, Page::section);
        page.section(history::solver(self)).section(self.provenance.section()).render()
    }

    fn summary(&self) -> String {
        let steady = if self.settings.steady { ": the steady flow" } else { "" };
        match (self.settings.title.as_str(), self.settings.reynolds()) {
            ("", Some(re)) => {
                format!("Flow in the plane at Reynolds number {}{steady}.", short(re))
            }
            ("", None) => format!("Incompressible flow in the plane{steady}."),
            (title, _) => format!("{}{steady}.", literal(title)),
        }
    }

    /// The key numbers and what they are.
    fn facts(&self) -> Vec<(String, String)> {
        let mut facts = self
            .known_facts()
            .unwrap_or_else(|| bodies::facts(self).into_iter().chain(self.load_facts()).collect());
        if self.work.unknowns > 0 {
            facts.push((count(self.work.unknowns), "unknowns".into()));
        }
        if let Some(ms) = self.work.step_ms.filter(|_| self.work.steps > 0) {
            let what = if self.settings.steady { "an iteration" } else { "a step" };
            facts.push((
                duration(1e-3 * ms),
                format!("for {what}, {} of them", count(self.work.steps)),
            ));
        }
        let total = self.provenance.seconds();
        if total > 0.0 {
            facts.push((duration(total), "for the whole run".into()));
        }
        facts
    }

    /// The numbers that have references, with these.
    fn known_facts(&self) -> Option<Vec<(String, String)>> {
        let (all, _) = known::compared(self).filter(|(all, _)| !all.is_empty())?;
        let fact = |c: known::Compared| {
            (significant(c.value, 5), format!("{}; reference {}", c.name, c.reference.words()))
        };
        Some(all.into_iter().map(fact).collect())
    }

    /// The loads on the first body.
    fn load_facts(&self) -> Vec<(String, String)> {
        let Some(body) = self.loads.iter().find(|loads| loads.is_body) else { return Vec::new() };
        let n = &body.numbers;
        let all = [
            (n.drag_mean, "mean *C*_{D}"),
            (n.lift_max.filter(|_| !self.settings.steady), "largest *C*_{L}"),
            (n.strouhal, "Strouhal number"),
        ];
        let fact = |(value, meaning): (Option<f64>, &str)| {
            Some((significant(value?, 4), format!("{meaning} of {}", literal(&body.name))))
        };
        all.into_iter().filter_map(fact).collect()
    }
}
