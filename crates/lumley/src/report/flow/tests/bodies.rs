//! What the page shows of bodies.

use super::super::sample::{Outcome, Sample};
use super::super::{
    BodiesReport, BodyMotion, BodyNumbers, CoordinateMotion, FinalState, FlowModes, FlowReport,
    FlowSettings,
};
use super::report_of;
use crate::report::checks::HOSTILE_TEXT;

/// Outlines at the first and the last snapshot in both components of four modes, and the rod in every view.
#[test]
fn pictures_show_the_bodies() -> Outcome {
    let page = report_of(Sample { moves: true, ..Sample::default() })?.render().page;
    let count = |class: &str| page.matches(&format!("class=\"{class}\"")).count();
    assert_eq!(count("solid link"), 3);
    assert_eq!(count("solid"), 3);
    assert_eq!((count("solid hollow dash"), count("solid hollow")), (8, 8));
    Ok(())
}

/// What the summary and the case say of bodies, in words and tables.
#[test]
fn the_page_tells_of_the_bodies() -> Outcome {
    let mut report = report_of(Sample { moves: true, ..Sample::default() })?;
    let page = report.render().page;
    let said = [
        "moves along <i>x</i> and <i>y</i> of the ground without turning; spring on <i>y</i> with 7.1 N/m",
        "hinge at (0.2, 0.2) m on rotor",
        "Gravity is (0, −9.81) m/s",
        "0.02001\u{a0}m",               // a headline
        "<td class=\"n\">0.20010</td>", // amplitude over the diameter
        "the amplitudes of its last 2 periods differ by 0.50 %",
        "<th class=\"n\">lift</th><th class=\"n\">turn</th>", // in the order of the coordinates
        "<td class=\"n\">0.0123400</td>",
        "<td class=\"n\">0.310</td><td class=\"n\">3.10</td><td class=\"n\">0</td><td class=\"n\">1.70</td>",
        "one in 5, 2 snapshots",
    ];
    for text in said {
        assert!(page.contains(text), "{text}");
    }
    report.bodies = BodiesReport::default();
    assert!(!report.render().page.contains("Bodies</h2>"));
    Ok(())
}

/// The paper's case: its table, and what an independent computation found at the same instants.
#[test]
fn the_pendulum_stands_beside_what_is_known_of_it() -> Outcome {
    let mut report = pendulum(report_of(Sample::default())?)?;
    let page = report.render().page;
    for text in [
        "reference −3.25",
        "<td class=\"n\">254</td><td class=\"n\">254.6</td><td class=\"n\">254.6</td>",
        "<td class=\"n\">1.56177</td>",
        "paper: under 1 % with four modes",
    ] {
        assert!(page.contains(text), "{text}");
    }
    report.bodies.bodies[1].setup.mass = Some(49.0);
    let page = report.render().page;
    assert!(!page.contains("Table 1") && !page.contains("reference −3.25"));
    Ok(())
}

/// A report as if it were of the paper's case.
fn pendulum(report: FlowReport) -> Result<FlowReport, Box<dyn std::error::Error>> {
    let body = |name: &str, mass, joint: &str| -> Result<BodyMotion, toml::de::Error> {
        let setup = format!("name = '{name}'\nmass = {mass}\ncentre = [7, 0]\njoint = {joint}");
        let position = vec![1.57, 1.514_3];
        let angle = CoordinateMotion { name: "angle".into(), position, ..Default::default() };
        let track = vec![[0.0; 3], [-0.3, 0.0, 0.1]];
        let (setup, coordinates) = (toml::from_str(&setup)?, vec![angle]);
        Ok(BodyMotion { setup, track, coordinates, numbers: BodyNumbers::default() })
    };
    let column = |name: &str, values: [f64; 2]| (name.to_string(), values.to_vec());
    let bodies = BodiesReport {
        times: vec![0.0, 5.55],
        bodies: vec![
            body("bar", 1, "{ kind = 'revolute', at = [7, 0] }")?,
            body("disc", 50, "{ kind = 'revolute', at = [7, 5], to = 'bar' }")?,
        ],
        instants: vec![column("time", [1.65, 1.7]), column("theta", [1.5618, 1.56])],
        ..BodiesReport::default()
    };
    let settings = FlowSettings {
        density: 1.0,
        viscosity: 0.01,
        boundaries: vec![("left".into(), "velocity (1, 0) m/s".into())],
        ..FlowSettings::default()
    };
    let modes = report.modes.map(|modes| FlowModes {
        eigenvalues: vec![254.6, 0.35],
        total_energy: 255.0,
        times: (1..=111).map(|k| 0.05 * f64::from(k)).collect(),
        ..modes
    });
    Ok(FlowReport { name: "pendulum".into(), settings, bodies, modes, ..report })
}

/// Data that no run writes.
pub(super) fn spoil(report: &mut BodiesReport, some: &mut impl FnMut() -> Vec<f64>) {
    report.times = some();
    report.gravity = [some()[0], some()[1]];
    report.instants = vec![(HOSTILE_TEXT.into(), some()), (HOSTILE_TEXT.into(), some())];
    for body in &mut report.bodies {
        body.track = vec![[some()[0], some()[1], some()[2]]; 7];
        body.setup.name = HOSTILE_TEXT.into();
        body.numbers.amplitude = Some(some()[3]);
        (body.numbers.periods, body.numbers.amplitudes) = (7, some());
        body.numbers.state = Some(FinalState { time: some()[0], ..FinalState::default() });
        for coordinate in &mut body.coordinates {
            (coordinate.position, coordinate.velocity) = (some(), some());
        }
    }
}
