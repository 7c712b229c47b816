//! What is no tree of bodies is refused, with names, values and what to do.

use crate::fixtures::bodies;
use lumley_body::joint::{Drive, Joint, Prescribed, TimeFunction};
use lumley_body::{DynamicsError, ImplicitScheme, Load, RateFormula, RigidBody, RungeKutta, Tree};

const DISC: &str = "
    [[bodies]]
    name = 'disc'
    mass = 1
    inertia = 0.5
    centre = [0, 0]
    joint = { kind = 'revolute', at = [0, 1], spring = { stiffness = 1 } }
";

/// The refusal of the disc with one thing changed.
fn refusal(change: impl FnOnce(&mut RigidBody)) -> String {
    let mut disc = bodies(DISC);
    change(&mut disc[0]);
    Tree::new(&disc, [0.0, -9.81]).expect_err("bad input").to_string()
}

fn refusal_of(text: &str) -> String {
    Tree::new(&bodies(text), [0.0; 2]).expect_err("bad input").to_string()
}

fn refusal_to_read(text: &str) -> String {
    #[derive(Debug, serde::Deserialize)]
    struct Case {
        #[allow(dead_code, reason = "only whether it can be read matters")]
        bodies: Vec<RigidBody>,
    }
    toml::from_str::<Case>(text).expect_err("bad input").message().to_owned()
}

fn spring(disc: &mut RigidBody) -> &mut lumley_body::joint::Spring {
    let Joint::Revolute(hinge) = &mut disc.joint else { panic!("another joint") };
    hinge.spring.as_mut().expect("a spring")
}

#[test]
fn quantities_out_of_range_are_named() {
    for (bad, shown) in [(-1.0, "-1"), (f64::NAN, "NaN"), (f64::INFINITY, "inf")] {
        let range = "expected 0 or a finite number above";
        let named =
            |what: &str, unit: &str| format!("body \"disc\": {what} is {shown} {unit}, {range}");
        assert_eq!(refusal(|d| d.mass = Some(bad)), named("mass", "kg/m"));
        assert_eq!(refusal(|d| d.inertia = Some(bad)), named("inertia", "kg m"));
        let on_its_angle = "of the spring on its angle";
        let stiffness = named(&format!("stiffness {on_its_angle}"), "N/rad");
        assert_eq!(refusal(|d| spring(d).stiffness = bad), stiffness);
        let damping = named(&format!("damping {on_its_angle}"), "N s/rad");
        assert_eq!(refusal(|d| spring(d).damping = bad), damping);
    }
    for (found, what) in [
        (refusal(|d| d.centre[1] = f64::NAN), "centre is NaN m"),
        (refusal(|d| d.angle = f64::NAN), "angle is NaN rad"),
        (
            refusal(|d| spring(d).rest = f64::INFINITY),
            "rest value of the spring on its angle is inf rad",
        ),
        (
            refusal(|d| d.start.velocity = vec![f64::NAN]),
            "one of the velocities of its start is NaN",
        ),
    ] {
        assert!(found.starts_with(&format!("body \"disc\": {what}")), "{found}");
    }
}

#[test]
fn directions_shapes_and_gravity_out_of_range_are_named() {
    let along = |x: &str| {
        refusal_of(&format!(
            "[[bodies]]\nname = 'a'\nmass = 1\ncentre = [0, 0]\njoint = {{ kind = 'prismatic', along = [{x}, 0] }}"
        ))
    };
    assert!(along("0").contains("length of `along` is 0 m"), "{}", along("0"));
    assert!(along("nan").contains("length of `along` is NaN m"), "{}", along("nan"));
    let shape = DISC.replace("inertia = 0.5", "shape = { kind = 'disc', radius = 0 }");
    assert_eq!(
        refusal_of(&shape),
        "body \"disc\": radius is 0 m, expected a finite number above 0"
    );
    let gravity = Tree::new(&bodies(DISC), [0.0, f64::NAN]).expect_err("bad input").to_string();
    assert_eq!(gravity, "gravity is [0.0, NaN] m/s², expected two finite numbers");
}

#[test]
fn a_body_that_can_move_says_what_its_inertia_is() {
    assert!(refusal(|d| d.mass = None).starts_with("body \"disc\" has no mass"));
    assert!(refusal(|d| d.inertia = None).starts_with("body \"disc\" has no inertia"));
    let both = DISC.replace("inertia", "shape = { kind = 'bar', length = 1 }\ninertia");
    assert!(refusal_of(&both).starts_with("body \"disc\" has both"));
    // What cannot turn, or has no mass, needs none.
    for joint in ["{ kind = 'cartesian' }", "{ kind = 'prescribed' }", "{ kind = 'fixed' }"] {
        let text = format!("[[bodies]]\nname = 'a'\nmass = 1\ncentre = [0, 0]\njoint = {joint}");
        Tree::new(&bodies(&text), [0.0; 2]).expect("it does not turn");
    }
    let massless = DISC.replace("mass = 1\n    inertia = 0.5", "mass = 0");
    Tree::new(&bodies(&massless), [0.0; 2]).expect("it has no mass");
}

#[test]
fn names_are_unique_and_joints_lead_to_the_ground() {
    assert!(refusal_of("bodies = []").starts_with("no bodies"));
    assert!(refusal(|d| d.name.clear()).starts_with("body 1 has no name"));
    assert_eq!(
        refusal_of(&DISC.repeat(2)),
        "two bodies are called \"disc\": give each its own name"
    );
    let two = |to_a: &str, to_b: &str| {
        let body = |name, to| {
            format!(
                "[[bodies]]\nname = '{name}'\nmass = 1\ncentre = [0, 0]\njoint = {{ kind = 'fixed', to = '{to}' }}\n"
            )
        };
        refusal_of(&[DISC.to_owned(), body("a", to_a), body("b", to_b)].concat())
    };
    assert_eq!(
        two("c", "disc"),
        "body \"a\": its joint is to \"c\", which is no body; the others are \"disc\", \"b\"; leave `to` out for the ground"
    );
    assert!(
        two("b", "a").starts_with("the joints form a loop: a to b to a: "),
        "{}",
        two("b", "a")
    );
    assert!(
        two("a", "disc").starts_with("the joints form a loop: a to a: "),
        "{}",
        two("a", "disc")
    );
    // The body that leads into the loop is not in it.
    assert!(two("b", "b").starts_with("the joints form a loop: b to b: "), "{}", two("b", "b"));
    let mut shared = bodies(&[DISC, &DISC.replace("'disc'", "'ring'")].concat());
    for body in &mut shared {
        body.boundary = Some("wall".into());
    }
    let shared = Tree::new(&shared, [0.0; 2]).expect_err("one boundary").to_string();
    assert!(shared.starts_with("bodies \"disc\" and \"ring\" both have the boundary \"wall\""));
}

#[test]
fn a_start_has_as_many_numbers_as_free_coordinates() {
    let two = refusal(|d| d.start.position = vec![0.0; 2]);
    assert!(two.starts_with("body \"disc\": its start has 2 positions, expected 1"), "{two}");
    let prescribed = refusal(|d| {
        d.joint = Joint::Prescribed(Prescribed::default());
        d.start.velocity = vec![1.0; 3];
    });
    assert!(prescribed.contains("its start has 3 velocities, expected 0"), "{prescribed}");
}

#[test]
fn case_files_are_strict() {
    let joint = |joint: &str| {
        format!("[[bodies]]\nname = 'a'\nmass = 1\ncentre = [0, 0]\njoint = {{ {joint} }}")
    };
    for (text, expected) in [
        (DISC.replace("mass", "maas"), "unknown field `maas`"),
        (joint("kind = 'revolute', to = 'bar'"), "missing field `at`"),
        (joint("kind = 'ball'"), "unknown variant `ball`"),
        (joint("kind = 'fixed', spring = {}"), "unknown field `spring`"),
        (DISC.replace("stiffness", "stifness"), "unknown field `stifness`"),
        (joint("kind = 'prescribed', y = true"), "expected a number, a formula of t, or a table"),
    ] {
        let message = refusal_to_read(&text);
        assert!(message.contains(expected), "{message}");
    }
    let table = |times: &str, values: &str| {
        let table = format!(
            "joint = {{ kind = 'prescribed', y = {{ times = {times}, values = {values} }} }}"
        );
        refusal_to_read(&format!("[[bodies]]\nname = 'a'\ncentre = [0, 0]\n{table}"))
    };
    let backwards = table("[0, 2, 1]", "[0, 0, 0]");
    assert!(
        backwards.contains("motion table: time 3 is 1 s after 2 s, expected times that increase"),
        "{backwards}"
    );
    assert!(table("[0, 1]", "[0]").contains("2 times and 1 values"));
    assert!(table("[]", "[]").contains("0 times and 0 values"));
    assert!(table("[0, 1]", "[0, nan]").contains("row 2 is NaN at 1 s"));
    assert!(table("[0, 0]", "[0, 1]").contains("time 2 is 0 s after 0 s"));
}

/// The disc, moved by a function.
fn driven(y: Drive) -> Vec<RigidBody> {
    let mut disc = bodies(DISC);
    disc[0].joint = Joint::Prescribed(Prescribed { y, ..Prescribed::default() });
    disc
}

#[test]
fn functions_that_are_not_finite_are_named_with_the_time() {
    let sqrt = Drive::Function(TimeFunction::new(|t: f64| (0.25 - t).sqrt()));
    let tree = Tree::new(&driven(sqrt), [0.0; 2]).expect("a tree");
    let mut scheme = ImplicitScheme::new(tree.clone(), 0.0).expect("finite at the start");
    let euler = RateFormula { new: 10.0, now: -10.0, before: 0.0 };
    let run = (0..5).try_for_each(|_| scheme.step(0.1, euler, &[]).map(drop));
    let message = run.expect_err("NaN after 0.25 s").to_string();
    assert!(message.starts_with("the prescribed motion disc.y is NaN at t = 0.3"), "{message}");
    assert!((scheme.time() - 0.2).abs() < 1e-15, "the failed step is not made");
    assert!((scheme.position()[1] - 0.05_f64.sqrt()).abs() < 1e-15);
    assert!(tree.start(1.0).is_err());
    let explicit = RungeKutta::new(tree).expect_err("prescribed").to_string();
    assert!(explicit.starts_with("disc.x is prescribed"), "{explicit}");

    let formula = Tree::new(&driven(Drive::Formula("sin(t)".into())), [0.0; 2]);
    let message = formula.expect_err("a formula").to_string();
    assert!(
        message.starts_with("body \"disc\": y is the formula \"sin(t)\", expected a number"),
        "{message}"
    );
}

#[test]
fn steps_and_loads_that_are_not_finite_are_refused() {
    let tree = Tree::new(&bodies(DISC), [0.0; 2]).expect("a tree");
    let mut scheme = ImplicitScheme::new(tree, 0.0).expect("a body with inertia");
    let euler = RateFormula { new: 10.0, now: -10.0, before: 0.0 };
    for step in [0.0, -0.1, f64::NAN, f64::INFINITY] {
        let refused = scheme.step(step, euler, &[]);
        assert!(matches!(refused, Err(DynamicsError::Step { .. })), "{step}: {refused:?}");
    }
    let load = Load { body: 0, at: [0.0; 2], force: [f64::NAN, 0.0], moment: 0.0 };
    let message = scheme.step(0.1, euler, &[load]).expect_err("NaN").to_string();
    assert!(message.starts_with("the load on body \"disc\" after t = 0 s is [NaN, 0.0] N/m"));
}
