//! What case files say of bodies.

use crate::fixtures::{bodies, five_bodies};
use lumley_body::RigidBody;
use lumley_body::joint::{Drive, Joint, Table};

/// A resolved case file says the same bodies as the one that was written.
#[test]
fn bodies_are_written_as_they_were_read() {
    #[derive(serde::Serialize)]
    struct Case {
        bodies: Vec<RigidBody>,
    }
    let mut written = five_bodies().bodies().to_vec();
    // The fluid says what a body displaces, not the case file.
    written[3].displaced = None;
    written[0].start.velocity = vec![0.5];
    written.extend(bodies(
        "
        [[bodies]]
        name = 'wing'
        centre = [0, 1]
        [bodies.joint]
        kind = 'prescribed'
        at = [0, 0.5]
        x = '0.2 * sin(t)'
        y = 1
        angle = { times = [0, 1, 3], values = [0.0, 0.5, 0.2] }
        [[bodies]]
        name = 'tip'
        mass = 1
        centre = [0, 2]
        joint = { kind = 'cartesian', spring_x = { stiffness = 2 }, to = 'wing' }
        [[bodies]]
        name = 'end'
        mass = 1
        centre = [0, 3]
        joint = { kind = 'fixed', to = 'tip' }
        ",
    ));
    let Joint::Prescribed(wing) = &written[5].joint else { panic!("another joint") };
    assert_eq!(wing.x, Drive::Formula("0.2 * sin(t)".into()));
    assert_eq!(wing.y, Drive::Constant(1.0));
    let text = toml::to_string(&Case { bodies: written.clone() }).expect("bodies can be written");
    assert_eq!(bodies(&text), written, "{text}");
}

/// Between its times a table of a sine is as exact as cubic polynomials with slopes of parabolas are, and its slope
/// has no jumps at them.
#[test]
fn tables_are_smooth_and_of_third_order() {
    let table = |n: u32| {
        let times: Vec<f64> = (0..=n).map(|k| 3.0 * f64::from(k) / f64::from(n)).collect();
        let values = times.iter().map(|t| t.sin()).collect();
        Table::new(times, values).expect("times that increase")
    };
    let errors = [20, 40, 80].map(|n| {
        let error = |t: f64| (table(n).at(t) - t.sin()).abs();
        (0..=1000).map(|k| error(3e-3 * f64::from(k))).fold(0.0, f64::max)
    });
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((order - 3.0).abs() < 0.1, "errors {errors:?}, order {order}");
    }
    let (table, step) = (table(20), 1e-6);
    for k in 1..20 {
        let t = 0.15 * f64::from(k);
        let [before, at, after] = [-step, 0.0, step].map(|shift| table.at(t + shift));
        let jump = (after - 2.0 * at + before) / step;
        assert!(jump.abs() < 1e-5, "slope jumps by {jump} at {t} s");
    }
}
