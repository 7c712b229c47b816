mod bodies;

use super::sample::{CASE, Outcome, Sample, summary};
use super::{BoundaryLoads, FlowReport, FlowSettings, History, LoadNumbers};
use crate::report::Report;
use crate::report::checks::{Dice, HOSTILE_TEXT, assert_sound};
use crate::report::number::significant;
use std::fs;

fn report_of(sample: Sample) -> Result<FlowReport, Box<dyn std::error::Error>> {
    let folder = tempfile::tempdir()?;
    sample.write(folder.path())?;
    Ok(FlowReport::of_run(folder.path())?)
}

fn names(report: &Report) -> Vec<&str> {
    report.figures.iter().map(|(name, _)| name.trim_end_matches(".svg")).collect()
}

const PICTURES: [&str; 3] = ["speed", "pressure", "vorticity"];
const BODIES: [&str; 4] = ["motion-1", "motion-2", "periods", "energy"];
const MEASURED: [&str; 5] = ["loads", "lift-spectrum", "probes", "mesh", "quality"];
const MODES: [&str; 4] = ["spectrum", "projection", "modes", "coefficients"];

#[test]
fn a_run_makes_a_sound_page_with_every_figure() -> Outcome {
    for moves in [false, true] {
        let report = report_of(Sample { moves, ..Sample::default() })?;
        let rendered = report.render();
        assert_sound(&rendered);
        let all = if moves {
            [&PICTURES[..], &BODIES, &MEASURED, &MODES, &["divergence", "solver"]].concat()
        } else {
            [&PICTURES[..], &MEASURED, &MODES, &["solver"]].concat()
        };
        assert_eq!(names(&rendered), all);
        assert_eq!(rendered, report.render(), "the same data give the same bytes");
        assert_eq!(rendered.page.contains("the way of its centre"), moves);
    }
    Ok(())
}

/// A picture of many nodes at many times.
#[test]
fn a_large_run_makes_a_page_of_bounded_size() -> Outcome {
    let sample = Sample { picture: [320, 200], snapshots: 24, moves: true };
    let page = report_of(sample)?.render().page;
    assert!((200_000..5_000_000).contains(&page.len()), "{} bytes", page.len());
    Ok(())
}

/// The numbers of the page are those of the summary, in the digits that are shown.
#[test]
fn the_page_says_what_the_summary_says() -> Outcome {
    let page = report_of(Sample::default())?.render().page;
    let summary = summary();
    let cylinder = &summary["loads"]["cylinder"];
    for key in [
        "drag_coefficient_max",
        "drag_coefficient_mean",
        "lift_coefficient_max",
        "lift_coefficient_rms",
        "strouhal",
    ] {
        let value = cylinder[key].as_f64().ok_or(key)?;
        assert!(page.contains(&format!("<td class=\"n\">{}</td>", significant(value, 5))), "{key}");
    }
    let difference = summary["pressure_difference"].as_f64().ok_or("none")?;
    let said = [
        &significant(difference, 6),
        "<dd>3.2219</dd>",             // the headline
        "reference 3.2277",            // beside its reference
        "<td class=\"n\">inside</td>", // the Strouhal number
        "40\u{202f}321",               // unknowns
        "600 of them",                 // steps
        "<td>100</td>",                // the Reynolds number
        "velocity: peak 1.5 m/s, profile parabolic",
        "St = 0.3001",
        "lumley run cases/cylinder-2d2/case.toml",
    ];
    for text in said {
        assert!(page.contains(text), "{text}");
    }
    Ok(())
}

#[test]
fn references_belong_to_the_case_as_it_is() -> Outcome {
    let mut report = report_of(Sample::default())?;
    assert!(report.render().page.contains("reference 3.2277"));
    let changed = FlowReport {
        settings: FlowSettings { boundaries: vec![], ..report.settings.clone() },
        ..report.clone()
    };
    assert!(!changed.render().page.contains("reference 3"));
    report.settings.viscosity *= 2.0;
    assert!(!report.render().page.contains("reference 3"));
    Ok(())
}

/// The frames as the script reads them.
#[test]
fn the_slider_has_every_time_and_the_place_of_the_body() -> Outcome {
    let page = report_of(Sample { moves: true, ..Sample::default() })?.render().page;
    let (_, json) = page.split_once("id=\"frames\">").ok_or("no frames")?;
    let (json, _) = json.split_once("</script>").ok_or("no end")?;
    let frames: serde_json::Value = serde_json::from_str(json)?;
    assert_eq!(frames["t"].as_array().map(Vec::len), Some(12));
    assert_eq!(frames["start"], 11);
    for view in frames["views"].as_array().ok_or("views")? {
        let pictures = view["pictures"].as_array().ok_or("pictures")?;
        assert_eq!(pictures.len(), 12);
        assert!(pictures.iter().all(|p| p.as_str().is_some_and(|p| p.starts_with("iVBOR"))));
    }
    let [rod, body] = [&frames["bodies"][0], &frames["bodies"][1]];
    assert_eq!(rod[0], serde_json::json!([0.3, 0.2, 0.0]));
    assert_eq!(rod[11][2], serde_json::json!(85.944));
    assert_eq!(body[0], serde_json::json!([0.2, 0.2, 0.0]));
    let y = 0.2 + 0.02 * (std::f64::consts::TAU * 3.0 * 3.0 / 11.0).sin();
    assert!((body[1][1].as_f64().ok_or("y")? - y).abs() < 1e-5);
    Ok(())
}

/// One snapshot: pictures without a slider, no modes. None: a page that says so.
#[test]
fn short_runs_make_sensible_pages() -> Outcome {
    let one = report_of(Sample { snapshots: 1, ..Sample::default() })?.render();
    assert_sound(&one);
    assert!(one.page.contains("id=\"speed\"") && !one.page.contains("id=\"frames\""));
    let none = report_of(Sample { snapshots: 0, ..Sample::default() })?.render();
    assert_sound(&none);
    assert!(none.page.contains("There are no pictures of this flow"));
    assert_sound(&FlowReport::default().render());
    Ok(())
}

/// All that may be missing is.
#[test]
fn a_run_of_numbers_alone_has_a_page() -> Outcome {
    let folder = tempfile::tempdir()?;
    let at = |name: &str| folder.path().join(name);
    Sample::default().write(folder.path())?;
    fs::write(at("summary.json"), "{}")?;
    fs::write(at("case.toml"), CASE.replace("[time]", "[steady]"))?;
    for file in ["mesh.npz", "loads.csv", "probes.csv", "steps.csv"] {
        fs::remove_file(at(file))?;
    }
    for directory in ["record", "pictures", "basis"] {
        fs::remove_dir_all(at(directory))?;
    }
    let rendered = FlowReport::of_run(folder.path())?.render();
    assert_sound(&rendered);
    assert!(rendered.figures.is_empty() && rendered.page.contains("steady flow"));
    for (file, text) in [("mesh.npz", "PK"), ("case.toml", "[flow]"), ("summary.json", "{")] {
        fs::write(at(file), text)?;
        let error = FlowReport::of_run(folder.path()).err().ok_or("an error")?;
        assert!(error.to_string().contains(file), "{error}");
    }
    Ok(())
}

fn spoil(history: &mut History, some: &mut impl FnMut() -> Vec<f64>) {
    history.times = some();
    history.pressure_difference = some();
    (history.step_times, history.cfl) = (some(), some());
    history.residuals = some();
    for probe in &mut history.probes {
        probe.name = HOSTILE_TEXT.into();
        (probe.u, probe.pressure) = (some(), some());
    }
}

#[test]
fn hostile_data_stay_harmless() -> Outcome {
    let sound = report_of(Sample { snapshots: 2, moves: true, ..Sample::default() })?;
    for seed in 0..12 {
        let mut dice = Dice(seed);
        let mut report = sound.clone();
        (report.name, report.settings.title) = (HOSTILE_TEXT.into(), HOSTILE_TEXT.into());
        report.warnings = vec![HOSTILE_TEXT.into()];
        report.settings.boundaries = vec![(HOSTILE_TEXT.into(), HOSTILE_TEXT.into())];
        report.settings.viscosity = dice.hostile(1)[0];
        report.load_times = dice.hostile(7);
        let mut some = || dice.hostile(7);
        report.loads = vec![BoundaryLoads {
            name: HOSTILE_TEXT.into(),
            is_body: true,
            numbers: LoadNumbers {
                drag_max: Some(some()[0]),
                frequency: Some(some()[1]),
                window: Some([some()[0], some()[1]]),
                ..LoadNumbers::default()
            },
            drag: some(),
            lift: some(),
            moment: some(),
            spectrum: Some((some(), some())),
        }];
        spoil(&mut report.history, &mut some);
        bodies::spoil(&mut report.bodies, &mut some);
        let modes = report.modes.as_mut().ok_or("modes")?;
        (modes.eigenvalues, modes.coefficients) = (some(), vec![some(), some()]);
        modes.total_energy = some()[3];
        modes.divergence = some().into_iter().map(Some).collect();
        assert_sound(&report.render());
    }
    Ok(())
}
