use super::{Outcome, PistonReport, Trajectory, sample};
use crate::report::checks::{Dice, HOSTILE_TEXT, assert_sound};

#[test]
fn a_run_of_full_size_makes_a_sound_page_of_bounded_size() {
    let report = sample::report(401, 201);
    let rendered = report.render();
    assert_sound(&rendered);
    assert!(rendered.page.len() < 600_000, "{} bytes", rendered.page.len());
    assert_eq!(rendered, report.render(), "the same data give the same bytes");

    let names: Vec<&str> = rendered.figures.iter().map(|(name, _)| name.as_str()).collect();
    let expected = [
        "profiles",
        "motion",
        "velocity",
        "residual",
        "modes",
        "mapped-modes",
        "coefficients",
        "mapped-coefficients",
        "cost",
    ];
    assert_eq!(names, expected.map(|name| format!("{name}.svg")));
}

#[test]
fn the_page_says_what_came_out() {
    let page = sample::report(41, 21).render().page;
    let said = [
        "blew up at 0.50 s",                 // the table of errors
        "|a| exceeds 1e6",                   // what the model said
        "18.255",                            // the paper's Table 2
        "mapped, <i>N</i> = 6",              // the best reduced model
        "100 cells, 0.002\u{a0}s",           // the full model that is as accurate
        "[piston]\nviscosity = 0.2",         // the case, verbatim
        "<code>lumley run case.toml</code>", // how to reproduce
    ];
    for text in said {
        assert!(page.contains(text), "{text}");
    }
}

#[test]
fn the_speed_is_compared_at_equal_accuracy() {
    let mut report = sample::report(11, 5);
    let best = report.best().expect("four models finish").clone();
    assert_eq!(best.name, "mapped");
    let ratio = super::cost::speed_ratio(&best).expect("it has a full model beside it");
    assert!((ratio - 1000.0 * 9.0 / (200.0 * 1.8)).abs() < 1e-9, "{ratio}");
    let page = report.render().page;
    assert!(page.contains("25 times as fast"), "the sentence");
    report.reduced.iter_mut().for_each(|model| model.equal = None);
    assert!(!report.render().page.contains("times as fast"), "nothing to compare with");
}

#[test]
fn an_empty_report_and_one_of_a_single_time_are_sound() {
    assert_sound(&PistonReport::default().render());
    let mut report = sample::report(3, 2);
    report.times.truncate(1);
    assert_sound(&report.render());
}

#[test]
fn hostile_text_stays_text() {
    let mut report = sample::report(5, 4);
    let text = || HOSTILE_TEXT.to_string();
    (report.name, report.parameters.initial_flow) = (text(), text());
    (report.provenance.command, report.provenance.case_file) = (text(), text());
    report.reduced[0].name = text();
    report.reduced[0].runs[4].outcome = Outcome::BlewUp { time: 0.1, message: text() };
    report.transfer[0].method = text();
    assert_sound(&report.render());
}

#[test]
fn hostile_numbers_never_reach_a_figure() {
    for seed in 0..100 {
        let mut dice = Dice(seed);
        let mut report = sample::report(4, 5);
        report.full = trajectory(&mut dice);
        report.times = dice.hostile(5);
        report.eigenvalues = dice.hostile(6);
        report.projection = dice.hostile(4);
        report.fixed_grid.nodes = dice.hostile(4);
        report.fixed_grid.modes = vec![dice.hostile(4), dice.hostile(2)];
        report.fixed_grid.projected = vec![dice.hostile(5), dice.hostile(3)];
        for model in &mut report.reduced {
            model.trajectory = trajectory(&mut dice);
            model.coefficients = vec![dice.hostile(5)];
            for run in &mut model.runs {
                run.step_us = dice.hostile(1)[0];
                run.outcome = Outcome::Finished { res_percent: dice.hostile(1)[0] };
            }
        }
        for full in &mut report.variants {
            (full.step_us, full.error_percent) = (dice.hostile(1)[0], dice.hostile(1)[0]);
        }
        report.parameters.stiffness = dice.hostile(1)[0];
        report.provenance.stages[0].1 = dice.hostile(1)[0];
        assert_sound(&report.render());
    }
}

fn trajectory(dice: &mut Dice) -> Trajectory {
    let frames = dice.below(6);
    Trajectory {
        position: dice.hostile(frames),
        velocity: dice.hostile(frames),
        traction: dice.hostile(frames),
        field: dice.hostile(4 * frames),
    }
}
