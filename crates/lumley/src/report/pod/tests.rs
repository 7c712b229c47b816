use super::{DrawnModes, FieldGrid, PodReport};
use crate::report::checks::{Dice, HOSTILE_TEXT, assert_sound};
use faer::Mat;
use std::convert::Infallible;

fn drawn(grid: FieldGrid, modes: &Mat<f64>) -> DrawnModes {
    let Ok(drawn) = DrawnModes::sample(grid, modes.ncols(), |rows| {
        Ok::<_, Infallible>(modes.subrows(rows.start, rows.len()).to_owned())
    });
    drawn
}

/// Three modes of sines on a grid.
fn sample(nodes: [usize; 3], components: usize) -> PodReport {
    let grid = FieldGrid { nodes, components };
    let modes = Mat::from_fn(grid.len(), 3, |i, k| (0.1 * ((k + 1) * i) as f64).sin());
    PodReport {
        source: "wake.npy".into(),
        snapshots: 40,
        unknowns: grid.len(),
        inner_product: "identity".into(),
        method: "method of snapshots".into(),
        reason: "40 snapshots are fewer than the unknowns".into(),
        eigenvalues: vec![4.0, 1.0, 1e-5],
        total_energy: 5.1,
        modes: Some(drawn(grid, &modes)),
        coefficients: (1..=3).map(|k| (0..40).map(|t| f64::from(k * t).cos()).collect()).collect(),
        ..PodReport::default()
    }
}

fn names(report: &PodReport) -> Vec<String> {
    report.render().figures.into_iter().map(|(name, _)| name).collect()
}

#[test]
fn modes_are_drawn_on_grids_of_one_two_and_three_directions() {
    for (nodes, said) in [
        ([30, 1, 1], "The first modes on the grid."),
        ([12, 7, 1], "each with its own colours"),
        ([6, 5, 4], "the middle slice, 3 of 4 in the third direction"),
    ] {
        let report = sample(nodes, 2);
        let rendered = report.render();
        assert_sound(&rendered);
        assert!(rendered.page.contains(said), "{nodes:?}");
        assert_eq!(names(&report), ["spectrum.svg", "coefficients.svg", "modes.svg"]);
        assert_eq!(rendered, report.render());
    }
}

#[test]
fn without_a_grid_modes_are_not_drawn() {
    let report = PodReport { modes: None, ..sample([12, 7, 1], 1) };
    assert!(report.render().page.contains("option --grid"));
    assert_eq!(names(&report), ["spectrum.svg", "coefficients.svg"]);
}

/// The axes show the numbers of the true nodes.
#[test]
fn large_modes_make_small_figures() {
    for (nodes, size, tick) in
        [([500_000, 1, 1], 150_000, ">5.0<"), ([1500, 1200, 1], 300_000, ">1000<")]
    {
        let rendered = sample(nodes, 1).render();
        let (_, svg) = rendered.figures.last().expect("the modes");
        assert!(svg.len() < size, "{nodes:?}: {} bytes", svg.len());
        assert!(svg.contains(tick), "{nodes:?}");
    }
}

#[test]
fn the_projection_error_counts_the_modes_that_were_not_found() {
    let page = sample([30, 1, 1], 1).render().page;
    // (5.1 − 5.00001) / 5.1 is 1.96 %, its root 14 %.
    assert!(page.contains("<dd>14 %</dd>"));
    assert!(page.contains("less than 99.99 %"));
}

#[test]
fn many_snapshots_make_a_small_page() {
    let mut report = sample([30, 1, 1], 1);
    report.coefficients = vec![(0..200_000).map(|t| f64::from(t * t % 9973).sin()).collect(); 6];
    report.snapshots = 200_000;
    let page = report.render().page;
    assert!(page.len() < 300_000, "{} bytes", page.len());
}

#[test]
fn hostile_data_stay_harmless() {
    assert_sound(&PodReport::default().render());
    for seed in 0..100 {
        let mut dice = Dice(seed);
        let mut report = sample([4, 3, 1], 1);
        (report.source, report.reason) = (HOSTILE_TEXT.into(), HOSTILE_TEXT.into());
        report.warnings = vec![HOSTILE_TEXT.into()];
        let values = dice.hostile(24);
        let modes = Mat::from_fn(12, 2, |i, k| values[12 * k + i]);
        report.modes = Some(drawn(FieldGrid { nodes: [4, 3, 1], components: 1 }, &modes));
        let length = dice.below(9);
        report.coefficients = vec![dice.hostile(length), dice.hostile(5)];
        report.times = dice.hostile(length);
        report.eigenvalues = dice.hostile(3);
        report.total_energy = dice.hostile(1)[0];
        assert_sound(&report.render());
    }
}
