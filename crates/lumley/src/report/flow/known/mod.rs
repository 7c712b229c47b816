//! Reference values of cases that are known.

mod pendulum;

pub(super) use pendulum::{EVERY, Mode, add_paper_table, instants, modes};

use super::bodies::springs;
use super::{BodyMotion, FlowReport, LoadNumbers, ProbeSeries};
use crate::report::html::{Section, Table};
use crate::report::number::{exact, fixed, significant};
use lumley_body::joint::Spring;

/// What is known of a quantity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Reference {
    Value(f64),
    Between(f64, f64),
}

/// A quantity of a run beside its reference.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Compared {
    /// In markup.
    pub name: &'static str,
    pub value: f64,
    pub reference: Reference,
}

/// Its name in markup, where it is in a report, and what it should be.
type Quantity = (&'static str, fn(&FlowReport) -> Option<f64>, Reference);

/// A case with reference values: its name, and what must not have been changed of it.
struct Known {
    name: &'static str,
    /// Kinematic viscosity, in m²/s.
    viscosity: f64,
    /// A boundary, and words that stand in what holds there.
    driven: [&'static str; 2],
    bodies: &'static [KnownBody],
    quantities: &'static [Quantity],
    source: &'static str,
}

/// A body of such a case: its name, mass in kg/m, and the stiffness and the damping of all of its springs.
struct KnownBody {
    name: &'static str,
    mass: f64,
    springs: [f64; 2],
}

const SCHAEFER_TUREK: &str = "M. Schäfer and S. Turek, Benchmark computations of laminar flow around a \
    cylinder, Notes on Numerical Fluid Mechanics 52 (1996) 547–566, and later computations of the same case \
    with more digits";

const BOTELLA_PEYRET: &str = "O. Botella and R. Peyret, Benchmark spectral results on the lid-driven cavity \
    flow, Computers & Fluids 27 (1998) 421–433";

const SHIELS: &str = "D. Shiels, A. Leonard and A. Roshko, Flow-induced vibration of a circular cylinder at \
    limiting structural parameters, Journal of Fluids and Structures 15 (2001) 3–21; the ranges hold its values \
    and those of independent computations";

const KNOWN: [Known; 6] = [
    Known {
        name: "cavity",
        viscosity: 1e-3,
        driven: ["top", "velocity (1, 0)"],
        bodies: &[],
        quantities: &[
            ("smallest *u*", |r| last(r, "u-min", |p| &p.u), Reference::Value(-0.388_569_8)),
            ("largest *v*", |r| last(r, "v-max", |p| &p.v), Reference::Value(0.376_944_7)),
            ("smallest *v*", |r| last(r, "v-min", |p| &p.v), Reference::Value(-0.527_077_1)),
        ],
        source: BOTELLA_PEYRET,
    },
    Known {
        name: "cylinder-2d1",
        viscosity: 1e-3,
        driven: ["left", "peak 0.3 m/s"],
        bodies: &[],
        quantities: &[
            ("*C*_{D}", |r| cylinder(r)?.drag_mean, Reference::Value(5.57954)),
            ("*C*_{L}", |r| cylinder(r)?.lift_max, Reference::Value(0.010_619)),
            ("Δ*p* (Pa)", |r| r.pressure_difference, Reference::Value(0.11752)),
        ],
        source: SCHAEFER_TUREK,
    },
    Known {
        name: "cylinder-2d2",
        viscosity: 1e-3,
        driven: ["left", "peak 1.5 m/s"],
        bodies: &[],
        quantities: &[
            ("largest *C*_{D}", |r| periodic(r)?.drag_max, Reference::Value(3.2277)),
            ("largest *C*_{L}", |r| periodic(r)?.lift_max, Reference::Value(0.9869)),
            ("Strouhal number", |r| cylinder(r)?.strouhal, Reference::Between(0.295, 0.305)),
        ],
        source: SCHAEFER_TUREK,
    },
    Known {
        name: "viv",
        viscosity: 1e-2,
        driven: ["left", "velocity (1, 0)"],
        bodies: &[KnownBody { name: "cylinder", mass: 2.5, springs: [2.37, 0.0] }],
        quantities: &[
            ("amplitude (m)", |r| swinging(r)?.numbers.amplitude, Reference::Between(0.435, 0.475)),
            (
                "frequency (Hz)",
                |r| swinging(r)?.numbers.frequency,
                Reference::Between(0.152, 0.158),
            ),
        ],
        source: SHIELS,
    },
    Known {
        name: "massless-cylinder",
        viscosity: 1e-2,
        driven: ["left", "velocity (1, 0)"],
        bodies: &[KnownBody { name: "cylinder", mass: 0.0, springs: [0.0; 2] }],
        quantities: &[
            ("amplitude (m)", |r| swinging(r)?.numbers.amplitude, Reference::Value(0.437)),
            ("frequency (Hz)", |r| swinging(r)?.numbers.frequency, Reference::Value(0.153)),
        ],
        source: "an independent computation of the same case",
    },
    pendulum::KNOWN,
];

/// The numbers of the run that have references, and where these come from; none of a case that was changed.
pub(super) fn compared(report: &FlowReport) -> Option<(Vec<Compared>, &'static str)> {
    let known = KNOWN.iter().find(|known| known.is_of(report))?;
    let all = known.quantities.iter().filter_map(|(name, value, reference)| {
        Some(Compared { name, value: value(report)?, reference: *reference })
    });
    Some((all.collect(), known.source))
}

/// The section of these numbers, where there are any.
pub(super) fn section(report: &FlowReport) -> Option<Section> {
    let (all, source) = compared(report).filter(|(all, _)| !all.is_empty())?;
    let row = |c: &Compared| {
        let difference = match c.reference {
            Reference::Value(v) => fixed(100.0 * (c.value / v - 1.0), 2),
            Reference::Between(lo, hi) if (lo..=hi).contains(&c.value) => "inside".into(),
            Reference::Between(..) => "outside".into(),
        };
        vec![c.name.to_string(), significant(c.value, 6), c.reference.words(), difference]
    };
    let table = Table::new(&["", "this run", "reference", "difference (%)"]);
    let section = Section::new("Reference values").table(&table.rows(all.iter().map(row)));
    Some(section.paragraph(&format!("References: {source}.")))
}

impl Reference {
    pub(super) fn words(self) -> String {
        match self {
            Self::Value(v) => exact(v),
            Self::Between(lo, hi) => format!("{} to {}", exact(lo), exact(hi)),
        }
    }
}

impl Known {
    fn is_of(&self, report: &FlowReport) -> bool {
        let settings = &report.settings;
        let [boundary, words] = self.driven;
        let driven = |(name, text): &(String, String)| name == boundary && text.contains(words);
        let viscosity = settings.viscosity / settings.density;
        report.name == self.name
            && (viscosity / self.viscosity - 1.0).abs() < 1e-9
            && settings.boundaries.iter().any(driven)
            && self.bodies.len() == report.bodies.bodies.len()
            && self.bodies.iter().all(|body| body.is_in(report))
    }
}

impl KnownBody {
    fn is_in(&self, report: &FlowReport) -> bool {
        let same = |BodyMotion { setup, .. }: &BodyMotion| {
            let springs = springs(&setup.joint);
            let all = |[stiffness, damping]: [f64; 2], (_, spring): &(&str, Spring)| {
                [stiffness + spring.stiffness, damping + spring.damping]
            };
            setup.mass == Some(self.mass) && springs.iter().fold([0.0; 2], all) == self.springs
        };
        report.bodies.named(self.name).is_some_and(same)
    }
}

fn cylinder(report: &FlowReport) -> Option<&LoadNumbers> {
    report.loads.iter().find(|loads| loads.name == "cylinder").map(|loads| &loads.numbers)
}

/// The cylinder's numbers once the vortex street is there.
fn periodic(report: &FlowReport) -> Option<&LoadNumbers> {
    cylinder(report).filter(|numbers| numbers.strouhal.is_some())
}

/// The cylinder on its spring once it swings.
fn swinging(report: &FlowReport) -> Option<&BodyMotion> {
    report.bodies.named("cylinder").filter(|body| body.numbers.periods > 0)
}

/// The last value of a probe.
fn last(report: &FlowReport, probe: &str, values: fn(&ProbeSeries) -> &[f64]) -> Option<f64> {
    let found = report.history.probes.iter().find(|series| series.name == probe)?;
    values(found).last().copied()
}
