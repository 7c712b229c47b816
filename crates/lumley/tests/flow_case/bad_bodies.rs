//! Bodies that cannot be computed with are refused, with the line, what is wrong and what to do.

use crate::bodies::{PENDULUM, held};
use crate::{DUCT, refused, with};

/// The line of the case in which `words` stand first.
fn line(text: &str, words: &str) -> String {
    let before = &text[..text.find(words).expect("it stands there")];
    format!("case.toml, line {}:", 1 + before.matches('\n').count())
}

/// What is changed in the pendulum, and what the error must say beside the line of the change.
type Slip<'a> = (&'a str, &'a str, &'a [&'a str]);

#[test]
fn wrong_quantities_and_joints_are_refused_with_their_line() {
    let table: [Slip<'_>; 14] = [
        ("mass = 50", "mass = -50", &["body \"disc\": mass is -50 kg/m", "0 or a finite number"]),
        ("inertia = 1.5", "inertia = -1.5", &["inertia is -1.5 kg m"]),
        ("inertia = 1.5", "inertia = nan", &["inertia is NaN kg m"]),
        (
            "shape = { kind = \"bar\", length = 1.5 }",
            "shape = { kind = \"bar\", length = 0 }",
            &["body \"bar\": length is 0 m"],
        ),
        ("centre = [2, 1.25]", "centre = [inf, 1.25]", &["body \"bar\": centre is inf m"]),
        (
            "joint = { kind = \"revolute\", at = [2, 2], to = \"bar\" }",
            "joint = { kind = \"revolute\", at = [2, 2], to = \"baar\" }",
            &["its joint is to \"baar\", which is no body", "the others are \"bar\""],
        ),
        (
            "joint = { kind = \"revolute\", at = [2, 0.5] }",
            "joint = { kind = \"revolute\", at = [2, 0.5], to = \"disc\" }",
            &["the joints form a loop: bar to disc to bar", "by the ground"],
        ),
        (
            "joint = { kind = \"revolute\", at = [2, 0.5] }",
            "joint = { kind = \"revolute\", at = [2, 0.5], spring = { stiffness = -1 } }",
            &["stiffness of the spring on its angle is -1 N/rad"],
        ),
        (
            "start = { position = [0.1], velocity = [0] }",
            "start = { position = [0.1, 0], velocity = [0] }",
            &["its start has 2 positions, expected 1"],
        ),
        ("gravity = [0, -9.81]", "gravity = [0, inf]", &["gravity is [0.0, inf] m/s²"]),
        (
            "boundary = \"disc\"",
            "boundary = \"disk\"",
            &["bodies.disc.boundary = disk", "left", "did you mean disc?", "[[mesh.bodies]]"],
        ),
        (
            "boundary = \"disc\"",
            "boundary = \"bottom\"",
            &["bodies.disc.boundary = bottom", "closed outline", "another boundary begins"],
        ),
        ("rigid_zone = 0.1", "rigid_zone = -0.1", &["rigid zone is -0.1 m"]),
        ("coupling = \"explicit\"", "coupling = \"implicit\"", &["`implicit`", "`monolithic`"]),
    ];
    for (right, wrong, words) in table {
        let text = with(PENDULUM, right, wrong);
        refused(&text, words);
        refused(&text, &[&line(&text, wrong)]);
    }
}

#[test]
fn names_are_plain_and_each_bodys_own() {
    for name in ["", "the disc", "disc.1", "2nd"] {
        let text = with(PENDULUM, "name = \"bar\"", &format!("name = \"{name}\""));
        let told = format!("bodies.0.name = \"{name}\"");
        refused(&text, &[&told, "a letter first", &line(&text, &format!("name = \"{name}\""))]);
    }
    let twice = with(PENDULUM, "name = \"bar\"", "name = \"disc\"");
    refused(&twice, &["two bodies are called \"disc\""]);
    let shared = with(PENDULUM, "angle = 1.5", "boundary = \"disc\"");
    refused(&shared, &["both have the boundary \"disc\"", "case.toml, line "]);
}

/// What a joint may have is said by the joint that was named.
#[test]
fn slips_in_keys_are_named() {
    for (right, wrong, words) in [
        ("mass = 50", "maas = 50", ["unknown field `maas`", "did you mean `mass`?"]),
        ("at = [2, 2], to", "at = [2, 2], too", ["unknown field `too`", "did you mean `to`?"]),
        ("kind = \"revolute\", at = [2, 2]", "kind = \"hinge\"", ["`hinge`", "`revolute`"]),
        ("centre = [2, 2.25]\nb", "b", ["missing field `centre`", "help: "]),
        ("gravity = [0, -9.81]", "gravity = -9.81", ["gravity", "expected an array of length 2"]),
    ] {
        refused(&with(PENDULUM, right, wrong), &words);
        refused(&with(PENDULUM, right, wrong), &["case.toml, line "]);
    }
    let alone = held("kind = \"free\"", "mass = 0").replace("[[bodies]]", "[bodies]");
    refused(&alone, &["one table, expected a list of tables", "[[ ]]", &line(&alone, "[bodies]")]);
}

#[test]
fn the_fluid_sticks_to_bodies() {
    let given = with(PENDULUM, "disc]\nkind = \"no-slip\"", "disc]\nkind = \"slip\"");
    refused(&given, &["flow.boundaries.disc.kind", "\"no-slip\"", "the body disc"]);
    let dry = with(PENDULUM, "boundary = \"disc\"\n", "");
    refused(&dry, &["bodies.bar.boundary is missing", "no body has one"]);
}

/// Nothing would say how such bodies accelerate.
#[test]
fn massless_coordinates_that_no_fluid_reaches_are_refused() {
    let loose =
        "[[bodies]]\nname = \"loose\"\nmass = 0\ncentre = [1, 1]\njoint = { kind = \"free\" }";
    let text = held("kind = \"free\"", &format!("mass = 0\n{loose}"));
    refused(&text, &["bodies.loose.mass = 0 kg/m", "that of the fluid", "loose.x has none"]);
    let point =
        with(&text, "name = \"loose\"\nmass = 0", "name = \"loose\"\nmass = 1\ninertia = 0");
    refused(&point, &["bodies.loose.inertia = 0 kg m", "loose.angle has none"]);
    let explicit = "mass = 0\n[motion]\ncoupling = \"explicit\"";
    let text = held("kind = \"cartesian\"", explicit);
    refused(&text, &["bodies.disc.mass = 0 kg/m", "coupling = \"monolithic\"", "disc.x has none"]);
    let none = held("kind = \"cartesian\"", "");
    refused(&none, &["body \"disc\" has no mass", "which may be 0"]);
    let point = held("kind = \"free\"", "mass = 1");
    refused(&point, &["body \"disc\" has no inertia", "shape"]);
}

#[test]
fn motions_are_finite_and_their_tables_run_forwards() {
    let prescribed = |y: &str| held(&format!("kind = \"prescribed\", y = {y}"), "");
    for (y, words) in [
        ("\"sin(x)\"", ["bodies.disc.joint.y = \"sin(x)\"", "t or a function"]),
        ("\"1/t\"", ["bodies.disc.joint.y = \"1/t\"", "t = 0.0 s it gives inf"]),
        ("\"sqrt(0.5 - t)\"", ["finite values", "t = 1.0 s it gives NaN"]),
        ("nan", ["bodies.disc.joint.y = NaN", "a finite number in m"]),
        ("true", ["expected a number, a formula of t, or a table", "case.toml"]),
        (
            "{ times = [0, 2, 1], values = [0, 0, 0] }",
            ["time 3 is 1 s after 2 s", "sort the rows by time"],
        ),
        ("{ times = [0, 1], values = [0] }", ["2 times and 1 values", "motion table"]),
        ("{ times = [0, 1], values = [0, inf] }", ["row 2 is inf at 1 s", "finite numbers"]),
    ] {
        let text = prescribed(y);
        refused(&text, &words);
        refused(&text, &[&line(&text, "joint = {")]);
    }
}

/// As the mesh has them, the generator keeps bodies apart; where they start, this does.
#[test]
fn bodies_that_meet_are_refused() {
    let two = "[[mesh.bodies]]\nname = \"other\"\nshape = { kind = \"disc\", centre = [3.5, 2.25], radius = 0.25 }\nsize = 0.2\n\n[flow.boundaries.other]\nkind = \"no-slip\"\n\n[time]";
    let two = |joint: &str, others: &str| with(&held(joint, others), "[time]", two);
    let at = |x: f64, y: f64| format!("mass = 1\nstart = {{ position = [{x}, {y}] }}");
    let cartesian = "kind = \"cartesian\"";
    for (x, y, with) in [
        (0.0, 1.6, "the boundary top"),
        (0.0, 20.0, "the boundary top"),
        (-1.75, 0.0, "the boundary left"),
        (-9.0, 0.0, "the boundary left"),
        (1.2, 0.1, "the boundary other"),
        (1.5, 0.0, "the boundary other"),
    ] {
        let text = two(cartesian, &at(x, y));
        refused(
            &text,
            &["at the start the body disc meets ", with, "help: let it start elsewhere"],
        );
        refused(&text, &[&line(&text, "start = {")]);
    }
    // A body within another one crosses nothing.
    let start = two(cartesian, &at(1.5, 0.0));
    for which in ["[2, 2.25]", "[3.5, 2.25]"] {
        let [large, small] =
            ["0.25 }\nsize = 0.2", "0.1 }\nsize = 0.1"].map(|r| format!("{which}, radius = {r}"));
        let within = with(&start, &large, &small);
        refused(&within, &["the body disc meets the boundary other"]);
    }
    let small = with(&start, "radius = 0.25 }\nsize = 0.2", "radius = 0.1 }\nsize = 0.1");
    let body = "[[bodies]]\nname = \"ring\"\nmass = 1\ncentre = [3.5, 2.25]\nboundary = \"other\"\njoint = { kind = \"cartesian\" }\n";
    let small = with(&small, "[[bodies]]", &format!("{body}[[bodies]]"));
    refused(&small, &["meets the body "]);
    let prescribed = held("kind = \"prescribed\", y = \"2*cos(t)\"", "");
    refused(
        &prescribed,
        &["the body disc meets the boundary top", &line(&prescribed, "joint = {")],
    );
    // The bar carries the disc to the wall.
    let lying = with(
        PENDULUM,
        "angle = 1.5\n",
        "angle = 1.5\nstart = { position = [-1.57], velocity = [0] }\n",
    );
    refused(&lying, &["the body disc meets the boundary bottom"]);
    let overlap =
        with(&two(cartesian, &at(0.0, 0.0)), "centre = [3.5, 2.25]", "centre = [2.3, 2.25]");
    refused(&overlap, &["bodies disc and other", "overlap near", "move them apart"]);
    let wall = with(PENDULUM, "centre = [2, 2.25], radius", "centre = [2, 3.9], radius");
    refused(&wall, &["body disc", "beyond the top"]);
}

#[test]
fn what_goes_with_bodies_needs_them() {
    let start = DUCT.find("[[bodies]]").expect("a body");
    let end = DUCT.find("[time]").expect("a time");
    let none = format!("{}{}", &DUCT[..start], &DUCT[end..]);
    refused(&none, &["motion = a table", "[[bodies]] with name, centre, joint and boundary"]);
    let probes = "[output]\nprobes = { times = [1], body = \"disc\" }";
    let motion = none.find("[motion]").expect("a table");
    let end = none.find("[time]").expect("a time");
    let probed = format!("{}{}", &none[..motion], with(&none[end..], "[output]", probes));
    refused(&probed, &["output.probes = a table", "[[bodies]]"]);
}

#[test]
fn probes_are_of_what_there_is() {
    for (right, wrong, words) in [
        ("[0.25, 0.5]", "[]", ["output.probes.times = []", "one or more times"]),
        ("[0.25, 0.5]", "[0.25, 1.5]", ["output.probes.times = 1.5", "time.end = 1.0 s"]),
        ("[0.25, 0.5]", "[0.25, nan]", ["output.probes.times = NaN", "time.end = 1.0 s"]),
        ("[0.25, 0.5]", "[0.5, 0.25]", ["output.probes.times = 0.25", "after 0.5 s"]),
        ("body = \"disc\"", "body = \"bar\"", ["output.probes.body = bar", "a boundary: disc"]),
        ("body = \"disc\"", "body = \"dics\"", ["output.probes.body = dics", "mean disc?"]),
        (
            "\"bar.angle\", phi",
            "\"bar.angel\", phi",
            ["coordinates.theta = bar.angel", "did you mean bar.angle?"],
        ),
        ("{ theta", "{ fx", ["coordinates.fx = bar.angle", "time, fx, fy, mg"]),
        ("times = [0.25", "time = [0.25", ["unknown field `time`", "did you mean `times`?"]),
    ] {
        let text = with(PENDULUM, right, wrong);
        refused(&text, &words);
        refused(&text, &["case.toml, line "]);
    }
}
