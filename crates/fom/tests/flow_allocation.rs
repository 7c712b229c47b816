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
use lumley_fom::coupling::{BodySetup, Coupling};
use lumley_fom::flow::{
    Condition, Flow, FlowMotion, FlowSetup, FlowStart, Linearisation, ViscousForm,
};
use setups::{Kind, Wobble, enclosed, fluid, mesh, parameters, ring};

fn on_a_moving_mesh() -> Flow {
    let grid = mesh(Kind::Both, 12);
    let motion = Wobble::of(&grid, 4.0);
    let parameters = parameters(TimeScheme::Bdf2, ViscousForm::Stress, Linearisation::Tangent);
    enclosed(grid, parameters, FlowMotion::Given(motion), false)
}

fn round_a_body(coupling: Coupling) -> Flow {
    let disc = toml::from_str(
        "name = 'disc'\nmass = 9\ninertia = 1\ncentre = [0, 0]\njoint = { kind = 'free' }\nboundary = 'bottom'",
    );
    let bodies = vec![disc.expect("a body")];
    let setup = BodySetup { bodies, gravity: [1.0, 0.5], coupling, ..BodySetup::default() };
    Flow::new(FlowSetup {
        mesh: ring(4),
        parameters: fluid(ViscousForm::Laplacian),
        conditions: ["bottom", "top"].map(|name| (name.into(), Condition::NoSlip)).into(),
        start: FlowStart::Rest,
        motion: FlowMotion::Bodies(setup),
        parallel: false,
    })
    .expect("a flow")
}

#[test]
fn only_the_first_step_allocates() {
    let flows: [fn() -> Flow; 3] = [
        on_a_moving_mesh,
        || round_a_body(Coupling::Monolithic),
        || round_a_body(Coupling::Explicit),
    ];
    for (number, flow) in flows.into_iter().enumerate() {
        let start = allocations();
        let mut flow = flow();
        flow.step(0.01).expect("a step");
        let built = allocations();
        assert!(built > start, "the counter counts");
        let mut renewals = 0;
        for _ in 0..12 {
            flow.forget_factor();
            renewals += flow.step(0.01).expect("a step").renewals;
        }
        assert!(renewals >= 12);
        assert_eq!(allocations(), built, "flow {number}");
    }
}
