//! After the first step, which factorises, a step of the flow allocates nothing.

#[path = "../../fem/tests/counting/mod.rs"]
mod counting;
#[expect(dead_code, reason = "the tests of the flow use more of it")]
#[path = "flow/exact.rs"]
mod exact;
#[expect(dead_code, reason = "the tests of the flow use more of it")]
#[path = "flow/setups.rs"]
mod setups;

use counting::allocations;
use lumley_fom::TimeScheme;
use lumley_fom::flow::{Linearisation, ViscousForm};
use setups::{Kind, Wobble, enclosed, mesh, parameters};

#[test]
fn only_the_first_step_allocates() {
    let start = allocations();
    let grid = mesh(Kind::Both, 12);
    let motion = Wobble::of(&grid, 4.0);
    let parameters = parameters(TimeScheme::Bdf2, ViscousForm::Stress, Linearisation::Tangent);
    let mut flow = enclosed(grid, parameters, lumley_fom::flow::FlowMotion::Given(motion), false);
    flow.step(0.01).expect("a step");
    let built = allocations();
    assert!(built > start, "the counter counts");
    let mut renewals = 0;
    for _ in 0..12 {
        flow.forget_factor();
        renewals += flow.step(0.01).expect("a step").renewals;
    }
    assert!(renewals >= 12);
    assert_eq!(allocations(), built);
}
