//! The cases of bodies in a flow: each as a coarse run, beside a number that is known.

use crate::Desk;
use serde_json::Value;

/// What a coarse run of a case says.
struct Found(Value);

impl Found {
    fn of(desk: &Desk, case: &str, settings: &[&str], run: &str) -> Self {
        let answer = desk.quick(case, settings, run).good();
        Self(serde_json::from_str(&answer.stdout).expect("one JSON object and nothing else"))
    }

    fn number(&self, at: &str) -> f64 {
        self.0.pointer(at).and_then(Value::as_f64).unwrap_or_else(|| panic!("no number {at}"))
    }

    fn near(&self, at: &str, expected: f64, share: f64) {
        let value = self.number(at);
        assert!((value / expected - 1.0).abs() <= share, "{at}: {value}, expected {expected}");
    }
}

/// Rows of the reference, Table 1 of the paper, and its claim of four modes, which holds for every fifth snapshot.
#[test]
fn pendulum() {
    let desk = Desk::new();
    let found = Found::of(&desk, "pendulum", &[], "run");
    let theta = found.number("/probes/5/theta");
    let excursion = (std::f64::consts::FRAC_PI_2 - theta) / 0.0559;
    assert!((excursion - 1.0).abs() < 0.01, "theta = {theta}");
    found.near("/probes/5/fx", 0.5689, 0.01);
    found.near("/probes/0/fx", 0.7161, 0.01);
    found.near("/probes/0/mg", 7.3e-5, 0.1);
    for (k, lambda) in [254.575, 0.352_63, 0.061_12].into_iter().enumerate() {
        found.near(&format!("/pod/eigenvalues/{k}"), lambda, 0.05);
    }
    found.near("/pod_every/snapshots", 22.0, 0.0);
    found.near("/pod_every/eigenvalues/1", 0.346_92, 0.05);
    let [all, some] = ["/projection/res_percent/3", "/pod_every/res_percent/3"];
    assert!(
        found.number(all) > 1.0 && found.number(some) < 1.0,
        "under 1 % with four modes: the paper's claim"
    );
}

/// Where the fluid that goes with the disc is heavier than the bodies, only the monolithic coupling stands.
#[test]
fn added_mass_ends_the_explicit_coupling_alone() {
    let desk = Desk::new();
    let heavy = ["flow.density=1000", "flow.viscosity=10", "time.end=1", "output.probes.times=[1]"];
    let explicit = [&heavy[..], &["motion.coupling=explicit"]].concat();
    desk.quick("pendulum", &explicit, "explicit")
        .refused(1, &["share", "monolithic", "kept: everything up to here"]);
    let found = Found::of(&desk, "pendulum", &heavy, "monolithic");
    assert!((found.number("/probes/0/theta") - 1.404).abs() < 0.005);
}

/// Amplitude, frequency and drag of Shiels' cylinder.
#[test]
fn viv() {
    let desk = Desk::new();
    let found = Found::of(&desk, "viv", &[], "run");
    found.near("/bodies/cylinder/amplitude", 0.4445, 0.03);
    found.near("/bodies/cylinder/frequency", 0.154, 0.01);
    found.near("/loads/cylinder/drag_coefficient_mean", 1.721, 0.02);
}

/// Let go three diameters aside, it swings back and the mesh with it.
#[test]
fn three_diameters_tangle_no_mesh() {
    let desk = Desk::new();
    let far = [
        "bodies.cylinder.start={ position = [3], velocity = [0] }",
        "time.end=6",
        "record.start=6",
        "record.interval=6",
        "pod.center=false",
    ];
    desk.quick("viv", &far, "run").good();
    let table = desk.table("run/bodies.csv");
    let (_, across) = table.iter().find(|(name, _)| name == "cylinder.distance").expect("a column");
    let least = across.iter().copied().fold(f64::INFINITY, f64::min);
    assert!(across[0] == 3.0 && least < -1.0, "from {} to {least} m", across[0]);
}

/// Nothing can take up a force, and none is there; it swings all the same.
#[test]
fn massless_cylinder() {
    let desk = Desk::new();
    let found = Found::of(&desk, "massless-cylinder", &[], "run");
    assert!(found.number("/loads/cylinder/lift_coefficient_rms") < 1e-6);
    found.near("/bodies/cylinder/amplitudes/9", 0.422, 0.04);
    found.near("/bodies/cylinder/frequency", 0.15, 0.01);
    found.near("/loads/cylinder/drag_coefficient_mean", 1.665, 0.03);
}

/// The rear tube is in the wake of the front one.
#[test]
fn tube_pair() {
    let desk = Desk::new();
    let found = Found::of(&desk, "tube-pair", &["time.end=80", "record.start=70"], "run");
    let drag = |tube: &str| found.number(&format!("/loads/{tube}/drag_coefficient_mean"));
    assert!(drag("rear") < 0.8 * drag("front"), "{} {}", drag("rear"), drag("front"));
    let amplitude = |tube: &str| found.number(&format!("/bodies/{tube}/amplitude"));
    assert!(amplitude("rear") > 1.2 * amplitude("front"));
    // Springs hold what the stream pushes.
    let pushed = found.number("/loads/front/force_mean/0") / 2.2;
    found.near("/bodies/front/coordinates/front.x/position", pushed, 0.1);
}

/// Without inertia the disc sinks at Faxén's velocity between walls, and with it at that which finer meshes have.
#[test]
fn falling_disc() {
    let desk = Desk::new();
    let found = Found::of(&desk, "falling-disc", &[], "run");
    found.near("/bodies/disc/state/velocity/1", -0.054_56, 2e-3);
    let slow = Found::of(&desk, "falling-disc", &["flow.viscosity=1", "time.end=0.1"], "slow");
    slow.near("/bodies/disc/state/velocity/1", -1.1403e-3, 5e-3);
    // Nobody turns it, and the walls are equally far.
    assert!(slow.number("/bodies/disc/state/angle").abs() < 1e-6);
}
