use crate::{BOX, DUCT, flow, with};
use lumley::case::{Case, March, Start};
use lumley::cases::BuiltIn;
use lumley_body::{RigidBody, Tree};
use lumley_fem::Point;
use lumley_fom::coupling::Coupling;
use lumley_fom::flow::{Condition, ViscousForm};
use lumley_fom::motion::Stiffness;

fn velocity(conditions: &[(String, Condition)], name: &str, at: Point, time: f64) -> Point {
    match conditions.iter().find(|(known, _)| known == name) {
        Some((_, Condition::Velocity(field))) => field.value(at, time),
        _ => panic!("{name} has no velocity"),
    }
}

#[test]
fn every_section_is_understood() {
    let case = flow(DUCT);
    let parameters = &case.parameters;
    assert_eq!((parameters.density, parameters.viscosity), (2.0, 0.01));
    assert_eq!(parameters.viscous_form, ViscousForm::Laplacian);
    let force = parameters.body_force.as_ref().expect("a body force");
    assert_eq!(force.value([0.0, 0.0], 2.0), [0.0, -19.62]);
    let Start::Velocity(start) = &case.start else { panic!("a velocity") };
    assert_eq!(start.value([0.0, 0.5], 0.0), [0.75, 0.0]);
    let names: Vec<&str> = case.conditions.iter().map(|(name, _)| name.as_str()).collect();
    let boundaries = case.mesh.topology().boundaries();
    assert_eq!(names, boundaries.iter().map(|b| b.name.as_str()).collect::<Vec<_>>());
    let reference = case.reference.expect("a reference");
    assert_eq!((reference.density, reference.velocity, reference.length), (2.0, 2.0, 0.2));
    assert_eq!(case.pressure_difference, Some([[0.4, 0.5], [1.6, 0.5]]));
    assert_eq!(case.probes[0].name, "wake");
    let time = *case.march.unsteady().expect("through time");
    assert_eq!((time.steps, time.step_at(0.25)), (Some(300), 25));
    let record = case.record.as_ref().expect("a record");
    assert_eq!((record.when.count, record.when.time(20)), (21, 3.0));
    assert_eq!(record.grid.bounds(), ([0.0, 0.0], [2.0, 1.0]));
    assert_eq!(case.paraview.expect("files").count, 13);
    assert!(case.pod.is_some() && case.loads_every == 1);
    let bodies = case.bodies.as_ref().expect("a body");
    let mut place = [0.0; 3];
    bodies.tree.prescribe(0.25, &mut place).expect("a finite motion");
    assert_eq!((bodies.tree.bodies()[0].centre, place), ([0.6, 0.5], [0.0, 0.05, 0.0]));
    assert_eq!((bodies.coupling, bodies.gravity), (Coupling::Monolithic, [0.0; 2]));
    assert_eq!((bodies.mesh.stiffness, bodies.mesh.rigid_zone), (Stiffness::Uniform {}, 0.05));
}

#[test]
fn a_ramp_starts_from_rest() {
    let case = flow(DUCT);
    let left = |time| velocity(&case.conditions, "left", [0.0, 0.5], time)[0];
    assert_eq!(left(0.0), 0.0);
    assert!((left(0.25) - 0.5 * 0.25 * 0.25_f64.sin()).abs() < 1e-16);
    assert_eq!(left(2.0), 0.25 * 2.0_f64.sin());
}

/// Into the domain, whichever side it is; zero at the walls.
#[test]
fn a_parabolic_profile_points_inwards() {
    let given = "kind = \"velocity\"\nvelocity = [\"y*(1 - y)*sin(t)\", 0]\nramp = 0.5";
    let profile = "kind = \"velocity\"\nprofile = \"parabolic\"\npeak = 1.5";
    let free = "kind = \"traction-free\"";
    let from_left = with(DUCT, given, profile);
    let from_right = with(&with(DUCT, free, profile), given, free);
    for (text, name, x, expected) in
        [(from_left, "left", 0.0, [1.5, 0.0]), (from_right, "right", 2.0, [-1.5, 0.0])]
    {
        let case = flow(&text);
        assert_eq!(velocity(&case.conditions, name, [x, 0.5], 1.0), expected);
        assert_eq!(velocity(&case.conditions, name, [x, 0.0], 1.0).map(f64::abs), [0.0, 0.0]);
    }
}

#[test]
fn defaults_are_the_papers_or_none() {
    let case = flow(BOX);
    assert_eq!(case.parameters.viscous_form, ViscousForm::Stress);
    assert!(matches!(case.start, Start::Rest) && matches!(case.march, March::Steady(_)));
    assert!(case.record.is_none() && case.pod.is_none() && case.reference.is_none());
    assert_eq!((case.mesh.topology().quadrilaterals().len(), case.mesh.topology().cells()), (8, 8));
    let cut = flow(&with(BOX, "cells = [2, 4]", "cells = [2, 4]\ncut = true"));
    assert_eq!(cut.mesh.topology().triangles().len(), 16);
    let clustered = flow(&with(BOX, "cells = [2, 4]", "cells = [4, 4]\nclustering = [2, 0]"));
    assert!((clustered.mesh.quality().area - 2.0).abs() < 1e-14);
    assert!(clustered.mesh.quality().shortest_edge.value < 0.2);
}

#[test]
fn adaptive_steps_have_no_count() {
    let adaptive = "step = 0.01\nadaptive = { tolerance = 1e-3, shortest = 1e-4, longest = 0.1 }";
    let case =
        flow(&with(&with(DUCT, "step = 0.01", adaptive), "interval = 0.1", "interval = 0.07"));
    let time = case.march.unsteady().expect("through time");
    assert_eq!((time.steps, time.adaptive.map(|a| a.longest)), (None, Some(0.1)));
    assert_eq!(case.record.expect("a record").when.count, 29);
}

/// What is written is read again as the same.
#[test]
fn a_kept_case_says_the_same() {
    for text in [DUCT, BOX] {
        let case = flow(text);
        let kept = case.kept();
        let again = flow(&kept.case);
        assert_eq!((again.file.clone(), again.kept()), (case.file, kept));
        assert_eq!(again.mesh, case.mesh);
    }
}

#[test]
fn the_cases_that_come_with_lumley_are_right_quick_and_whole() {
    let flows = lumley::cases::CASES.iter().filter(|case| case.name != "piston");
    for BuiltIn { name, text, .. } in flows {
        for quick in [false, true] {
            let path = format!("{name}/case.toml");
            let case = Case::parse(path.as_ref(), text, quick, &[]);
            assert!(matches!(case, Ok(Case::Flow(_))), "{name}: {case:?}");
        }
    }
}

#[test]
fn settings_reach_every_table() {
    let set = |setting: &str| Case::parse("case.toml".as_ref(), DUCT, false, &[setting.to_owned()]);
    for setting in [
        "flow.boundaries.top.kind=no-slip",
        "bodies.disc.joint.y=0.02*sin(t)",
        "mesh.bodies.disc.size=0.08",
        "flow.boundaries.left.velocity=[1, 0]",
        "mesh.size=0.3",
    ] {
        assert!(set(setting).is_ok(), "{setting}: {:?}", set(setting));
    }
    let error = set("flow.boundaries.top.kind=noslip").expect_err("no such kind").to_string();
    assert!(error.contains("did you mean `no-slip`?"), "{error}");
    let error = set("bodies.disc.joint.y=sin(x)").expect_err("no x").to_string();
    assert!(error.contains("--set bodies.disc.joint.y="), "{error}");
    let error = set("bodies.disk.joint.y=0").expect_err("no such body").to_string();
    assert!(error.contains("bodies has no entry of the name disk"), "{error}");
    assert!(error.ends_with("help: bodies has disc"), "{error}");
}

/// The k-th block of TOML of the page of all keys.
fn shown(k: usize) -> &'static str {
    let page = include_str!("../../../../docs/flow-case.md");
    let block = page.split("```toml").nth(1 + k).and_then(|rest| rest.split("```").next());
    block.expect("a block of TOML")
}

/// The page that shows every key is itself a case, and leaves none out.
#[test]
fn the_page_of_all_keys_is_right() {
    let text = shown(0);
    for quick in [false, true] {
        let case = Case::parse("page.toml".as_ref(), text, quick, &[]);
        assert!(matches!(case, Ok(Case::Flow(_))), "{case:?}");
    }
    for key in
        ["profile", "peak", "table", "with", "file", "cells", "clustering", "cut", "adaptive"]
    {
        assert!(text.contains(&format!("{key} = ")), "{key}");
    }
}

/// The page's pendulum is the paper's.
#[test]
fn the_page_of_all_keys_shows_a_tree() {
    #[derive(serde::Deserialize)]
    struct Bodies {
        bodies: Vec<RigidBody>,
    }
    let Bodies { bodies } = toml::from_str(shown(1)).expect("bodies");
    let tree = Tree::new(&bodies, [0.0; 2]).expect("a tree");
    assert_eq!([tree.label(0), tree.label(1)], ["bar.angle", "disc.angle"]);
}

/// What is finite when a case is checked may not be in between: then the flow stops, and the formula is named.
#[test]
fn a_formula_that_fails_on_the_way_is_named() {
    let late = flow(&with(DUCT, "y*(1 - y)*sin(t)", "1/(t - 1.5)"));
    assert_eq!(late.explain([0.0, 0.5], 1.0), None);
    let found = late.explain([0.0, 0.5], 1.5).expect("a division by zero");
    for word in
        ["flow.boundaries.left.velocity = [\"1/(t - 1.5)\", 0.0]", "inf", "y = 0.5 m, t = 1.5 s"]
    {
        assert!(found.contains(word), "{found}");
    }
    let force = flow(&with(DUCT, "-9.81*t", "sqrt(abs(t - 1.5) - 1e-3)"));
    let found = force.explain([0.1, 0.5], 1.5).expect("a root of a negative number");
    assert!(found.contains("flow.body_force = ") && found.contains("NaN"), "{found}");
    let motion = flow(&with(DUCT, "0.05*sin(2*pi*t)", "0.05/(t - 1.5)"));
    let found = motion.explain([0.6, 0.5], 1.5).expect("a division by zero");
    assert!(found.contains("bodies.disc.joint.y = \"0.05/(t - 1.5)\" gives (inf)"), "{found}");
}
