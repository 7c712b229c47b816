use super::Tolerance::{Absolute, AtLeast, Relative};
use super::{Row, Tolerance, res};
use crate::summary::{PistonProbe, Probe, Summary};

/// What is compared, its unit, the references of cases A and B, the tolerance, and where it stands.
type Line = (&'static str, &'static str, [f64; 2], Tolerance, fn(&Summary) -> Option<f64>);

/// Settings laid over the canonical case file for case A and case B.
pub(super) const CASES: [(&str, &[&str]); 2] = [("A", &["piston.force_factor=0"]), ("B", &[])];

const TABLE: &[Line] = &[
    ("X(1)", "m", [0.988_610_1, 0.951_241_1], Absolute(5e-6), |s| Some(at(s, 1.0)?.body.position)),
    ("X'(1)", "m/s", [0.205_772, 0.177_792], Absolute(5e-5), |s| Some(at(s, 1.0)?.body.velocity)),
    ("u(0.5, 1)", "m/s", [0.039_826_5, 0.003_237_8], Absolute(5e-6), |s| {
        Some(at(s, 1.0)?.velocity_mid)
    }),
    ("nu u_x(X-, 1)", "m2/s2", [-0.167_003, 0.110_525], Absolute(1e-4), |s| {
        Some(at(s, 1.0)?.traction)
    }),
    ("X(2)", "m", [0.930_904_7, 0.959_638_1], Absolute(5e-6), |s| Some(at(s, 2.0)?.body.position)),
    ("X'(2)", "m/s", [-0.319_938, -0.018_564], Absolute(5e-5), |s| Some(at(s, 2.0)?.body.velocity)),
    ("max_t ||v||", "m3/2/s", [0.219_908, 0.183_928], Absolute(1e-5), |s| s.record.max_norm),
    ("sum of lambda", "m3/s2", [0.021_555_7, 0.007_038_91], Relative(1e-3), |s| {
        Some(s.pod.total_energy)
    }),
    ("energy of mode 1", "%", [89.567, 88.080], Absolute(0.02), |s| energy(s, 1)),
    ("energy of mode 2", "%", [9.830, 11.219], Absolute(0.02), |s| energy(s, 2)),
    ("energy of mode 3", "%", [0.3227, 0.5717], Relative(0.01), |s| energy(s, 3)),
    ("energy of mode 4", "%", [0.2575, 0.1109], Relative(0.01), |s| energy(s, 4)),
    ("energy of mode 5", "%", [0.013_55, 0.012_05], Relative(0.03), |s| energy(s, 5)),
    ("energy of mode 6", "%", [0.004_83, 0.005_12], Relative(0.03), |s| energy(s, 6)),
    ("projection, Res(6)", "%", [0.873, 0.716], Absolute(0.02), |s| projection(s, 6)),
    ("projection, Res(8)", "%", [0.614, 0.529], Absolute(0.02), |s| projection(s, 8)),
    ("multiplier (c2), Res(6)", "%", [3.72, 1.65], Absolute(0.05), |s| res(s, "multiplier", 6)),
    ("penalty (c3), Res(6)", "%", [3.06, 1.37], Absolute(0.05), |s| res(s, "penalty", 6)),
    ("penalty (c3), Res(8)", "%", [0.88, 0.65], Absolute(0.05), |s| res(s, "penalty", 8)),
    ("mapped, Res(4)", "%", [0.32, 0.29], Absolute(0.02), |s| res(s, "mapped", 4)),
    ("mapped, Res(6)", "%", [0.019, 0.022], Absolute(0.005), |s| res(s, "mapped", 6)),
    ("corrected, Res(6)", "%", [115.0, 61.0], Relative(0.02), |s| res(s, "corrected", 6)),
    ("printed, Res(6): blows up", "%", [100.0, 100.0], AtLeast, |s| res(s, "printed", 6)),
];

/// The table for one case, computed numbers from `summary`; `case` is 0 for A and 1 for B.
pub(super) fn rows(case: usize, summary: &Summary) -> Vec<Row> {
    let row = |&(quantity, unit, references, tolerance, computed): &Line| Row {
        case: CASES[case].0,
        quantity: quantity.to_owned(),
        unit,
        reference: references[case],
        tolerance,
        computed: computed(summary),
    };
    TABLE.iter().map(row).collect()
}

fn at(summary: &Summary, time: f64) -> Option<PistonProbe> {
    let mut probes = summary.probes.iter().filter_map(Probe::piston);
    probes.find(|probe| (probe.time - time).abs() < 1e-9)
}

fn energy(summary: &Summary, mode: usize) -> Option<f64> {
    summary.pod.energy_percent.get(mode - 1).copied()
}

fn projection(summary: &Summary, modes: usize) -> Option<f64> {
    summary.projection.res_percent.get(modes - 1).copied()
}
