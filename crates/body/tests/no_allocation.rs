//! A step of the bodies allocates nothing.

#[path = "../../fem/tests/counting/mod.rs"]
mod counting;
#[path = "suite/fixtures.rs"]
#[allow(dead_code, reason = "the suite uses the rest")]
mod fixtures;

use counting::allocations;
use fixtures::{bdf2, five_bodies, two_loads, with_a_wing};
use lumley_body::{Energy, ImplicitScheme, RungeKutta};

#[test]
fn steps_allocate_nothing() {
    let loads = two_loads();
    let mut implicit = ImplicitScheme::new(with_a_wing(), 0.0).expect("bodies with inertia");
    let mut explicit = RungeKutta::new(five_bodies()).expect("bodies with inertia");
    let before = allocations();
    let mut sum = 0.0;
    for step in 0..20 {
        let iterations = implicit.step(0.01, bdf2(0.01, step == 0), &loads).expect("a step");
        assert!(iterations > 0);
        explicit.step(0.01, &loads).expect("a step");
        let columns = implicit.kinematics().jacobian(3, [1.9, 0.3]);
        sum += columns.map(|column| column.spin).sum::<f64>();
        sum += Energy::of(implicit.kinematics()).total();
    }
    assert_eq!(allocations() - before, 0);
    assert!(sum.is_finite());
}
