use crate::{BOX, DUCT, parse, refused, with};

/// Every wrong value, the line that is told, and what the error must say.
#[test]
fn wrong_values_are_refused_with_their_line() {
    let table: [(&str, &str, &[&str]); 39] = [
        ("density = 2.0", "density = -2.0", &["flow.density = -2.0", "positive", "kg/m³"]),
        ("viscosity = 0.01", "viscosity = 0", &["flow.viscosity = 0.0", "Pa s"]),
        ("viscosity = 0.01", "viscosty = 0.01", &["did you mean `viscosity`?"]),
        ("viscous_form = \"laplacian\"", "viscous_form = \"laplace\"", &["`laplacian`"]),
        ("[0, \"-9.81*t\"]", "[0, \"-9.81*\"]", &["flow.body_force", "character 7"]),
        ("[0, \"-9.81*t\"]", "[0, \"1/(t - 3)\"]", &["finite values", "t = 3.0 s"]),
        ("[0, \"-9.81*t\"]", "[0, true]", &["a number or a formula"]),
        ("[\"1 - y^2\", 0]", "[\"1 - t\", 0]", &["flow.initial", "x, y", "\"t\""]),
        (
            "[\"1 - y^2\", 0]",
            "[\"1/y\", 0]",
            &["flow.initial", "0.0) m and t = 0.0 s it gives (inf, 0)"],
        ),
        ("kind = \"traction-free\"", "kind = \"outlet\"", &["`outlet`", "`traction-free`"]),
        (
            "kind = \"slip\"",
            "kind = \"slip\"\nvelocity = [1, 0]",
            &["boundaries.top.velocity", "goes with kind"],
        ),
        (
            "kind = \"slip\"",
            "kind = \"slip\"\nwith = \"left\"",
            &["boundaries.top.with", "periodic"],
        ),
        (
            "sin(t)\", 0]",
            "sin(t)\", 0]\ntable = \"x.csv\"",
            &["exactly one of velocity, profile and table"],
        ),
        ("sin(t)\", 0]", "sin(t)\", 0]\npeak = 1.0", &["boundaries.left.peak", "profile"]),
        (
            "velocity = [\"y*(1 - y)*sin(t)\", 0]",
            "profile = \"parabolic\"",
            &["boundaries.left.peak is missing", "m/s"],
        ),
        (
            "velocity = [\"y*(1 - y)*sin(t)\", 0]",
            "velocity = [\"ln(y)\", 0]",
            &["finite values", "-inf"],
        ),
        (
            "velocity = [\"y*(1 - y)*sin(t)\", 0]",
            "table = \"none.csv\"",
            &["boundaries.left.table", "none.csv"],
        ),
        ("ramp = 0.5", "ramp = 0", &["boundaries.left.ramp = 0.0", "positive", " s"]),
        ("ramp = 0.5", "ramp_shape = \"linear\"", &["ramp_shape", "goes with ramp"]),
        (
            "[flow.boundaries.top]",
            "[flow.boundaries.tip]",
            &["flow.boundaries.tip", "did you mean top?"],
        ),
        ("velocity = 2.0", "velocity = 0", &["flow.reference.velocity = 0.0", "m/s"]),
        ("[1.6, 0.5]", "[2.6, 0.5]", &["pressure_difference.points = [2.6, 0.5]", "[2.0, 1.0] m"]),
        ("at = [1.5, 0.5]", "at = [1.5, -0.5]", &["flow.probes.0.at", "a point of the domain"]),
        ("name = \"wake\"", "name = \"a, b\"", &["flow.probes.0.name", "letters"]),
        ("x = [0, 2]", "x = [2, 0]", &["mesh.x = [2.0, 0.0]", "the lower and the upper end in m"]),
        ("size = 0.25", "cells = [8, 4]", &["mesh.bodies", "mesh.cells"]),
        ("size = 0.25", "size = -0.25", &["size is -0.25"]),
        ("size = 0.25", "size = 0.25\nfile = \"x.msh\"", &["mesh.x", "mesh.file"]),
        ("kind = \"uniform\"", "kind = \"jelly\"", &["jelly", "uniform"]),
        ("rigid_zone = 0.05", "rigid_zone = -0.05", &["rigid zone is -0.05 m"]),
        ("step = 0.01", "step = 0.011", &["time.step = 0.011", "time.end = 3.0 s, such as"]),
        ("step = 0.01", "step = 0.01\nscheme = \"crank-nicolson\"", &["time.scheme", "bdf2"]),
        (
            "interval = 0.1",
            "interval = 0.015",
            &["record.interval = 0.015", "multiple of time.step", "such as 0.02"],
        ),
        ("start = 1.0", "start = 4.0", &["record.start = 4.0", "time.end = 3.0 s"]),
        ("nodes = [41, 21]", "nodes = [41, 1]", &["grid.nodes = [41, 1]", "at least 2"]),
        ("paraview = 0.25", "paraview = 0.005", &["output.paraview", "such as 0.01"]),
        ("modes = 4", "modes = 4\nenergy = 0.9", &["either pod.modes or pod.energy"]),
        ("at = [1.5, 0.5]", "at = [1.5, 0.5, 0]", &["length 3"]),
        ("modes = 4", "method = \"magic\"", &["pod.method = magic"]),
    ];
    for (right, wrong, words) in table {
        let text = with(DUCT, right, wrong);
        refused(&text, words);
        refused(&text, &["case.toml, line "]);
    }
}

/// The line is that of the value, not just some line.
#[test]
fn the_line_is_the_right_one() {
    for (right, wrong) in [
        ("viscosity = 0.01", "viscosity = -1"),
        ("ramp = 0.5", "ramp = -1"),
        ("velocity = 2.0", "velocity = -2.0"),
        ("step = 0.01", "step = -0.01"),
        ("nodes = [41, 21]", "nodes = [0, 21]"),
    ] {
        let text = with(DUCT, right, wrong);
        let line = 1 + text[..text.find(wrong).expect("it stands there")].matches('\n').count();
        refused(&text, &[&format!("case.toml, line {line}:")]);
    }
}

#[test]
fn piston_and_flow_exclude_each_other() {
    refused("title = \"nothing\"", &["case.toml: neither of [piston] and [flow]", "lumley cases"]);
    let both = format!("{BOX}\n[piston]\nmass = 1.0\n");
    refused(&both, &["both of [piston] and [flow]", "exactly one"]);
}

#[test]
fn every_boundary_needs_its_condition() {
    let none = with(BOX, "[flow.boundaries.left]\nkind = \"no-slip\"\n", "");
    refused(&none, &["flow.boundaries.left is missing", "a condition", "line "]);
}

#[test]
fn periodic_boundaries_must_fit() {
    let pair = |left: &str, right: &str| {
        let text = with(BOX, "left]\nkind = \"no-slip\"", &format!("left]\n{left}"));
        with(&text, "right]\nkind = \"no-slip\"", &format!("right]\n{right}"))
    };
    let to = |other: &str| format!("kind = \"periodic\"\nwith = \"{other}\"");
    assert!(parse(&pair(&to("right"), &to("left"))).is_ok());
    let wall = "kind = \"no-slip\"";
    refused(&pair(&to("left"), wall), &["left.with = left", "itself"]);
    refused(&pair(&to("right"), wall), &["left.with = right", "in turn"]);
    refused(&pair(&to("rihgt"), wall), &["left.with = rihgt", "such as right"]);
    refused(&pair("kind = \"periodic\"", &to("left")), &["left is missing", "with = "]);
    let corner = with(
        &pair(&to("bottom"), "kind = \"no-slip\""),
        "bottom]\nkind = \"no-slip\"",
        &format!("bottom]\n{}", to("left")),
    );
    refused(&corner, &["the same length", "1.0000000000 m here, 2.0000000000 m there"]);
}

#[test]
fn what_comes_in_must_go_out() {
    let lid = with(BOX, "velocity = [1, 0]", "velocity = [0, -1]");
    refused(&lid, &["flow.boundaries = without an outlet", "1.000000 m²/s more in than out"]);
    let through = with(
        &lid,
        "bottom]\nkind = \"no-slip\"",
        "bottom]\nkind = \"velocity\"\nvelocity = [0, \"-6*x*(1 - x)\"]",
    );
    assert!(parse(&through).is_ok(), "{:?}", parse(&through));
    let free = with(&lid, "bottom]\nkind = \"no-slip\"", "bottom]\nkind = \"traction-free\"");
    assert!(parse(&free).is_ok());
}

#[test]
fn a_steady_flow_has_no_time() {
    let unsteady = "[time]\nend = 1.0\nstep = 0.1\n";
    refused(&format!("{BOX}\n{unsteady}"), &["either [time] or [steady], not both"]);
    refused(&with(BOX, "[steady]", ""), &["[time]", "[steady]"]);
    refused(&format!("{BOX}\n[record]\ninterval = 0.1\n"), &["record = ", "no history"]);
    refused(&format!("{BOX}\n[output]\nparaview = 0.1\n"), &["output.paraview = ", "no history"]);
    let moving = "[[bodies]]\nname = \"lid\"\ncentre = [0, 0]\njoint = { kind = \"free\" }\n";
    refused(&format!("{BOX}\n{moving}"), &["bodies = 1", "on a mesh at rest"]);
    refused(
        &with(BOX, "velocity = [1, 0]", "velocity = [\"t\", 0]"),
        &["does not change with time"],
    );
    refused(
        &with(BOX, "velocity = [1, 0]", "velocity = [1, 0]\nramp = 1"),
        &["top.ramp", "steady"],
    );
    refused(
        &with(BOX, "viscosity = 0.01", "viscosity = 0.01\nbody_force = [\"t\", 0]"),
        &["body_force", "steady"],
    );
    refused(
        &with(BOX, "[steady]", "[steady]\ntolerance = 2.0"),
        &["steady.tolerance = 2.0", "1e-9"],
    );
    refused(&with(BOX, "[steady]", "[steady]\niterations = 0"), &["steady.iterations = 0"]);
}

#[test]
fn pod_needs_a_record_and_a_record_a_grid() {
    refused(&with(DUCT, "[record]\nstart = 1.0\ninterval = 0.1\n", ""), &["pod = ", "[record]"]);
    refused(
        &with(DUCT, "[grid]\nnodes = [41, 21]\n", ""),
        &["grid is missing", "nodes = [nx, ny]"],
    );
}

#[test]
fn adaptive_steps_stay_within_their_bounds() {
    let adaptive = |tolerance: &str, shortest: &str, longest: &str| {
        let text = format!(
            "step = 0.01\nadaptive = {{ tolerance = {tolerance}, shortest = {shortest}, longest = {longest} }}"
        );
        with(DUCT, "step = 0.01", &text)
    };
    assert!(parse(&adaptive("1e-3", "1e-3", "0.1")).is_ok());
    refused(&adaptive("2", "1e-3", "0.1"), &["time.adaptive.tolerance = 2.0"]);
    refused(&adaptive("1e-3", "0.2", "0.1"), &["time.adaptive.longest = 0.1", "at least"]);
    refused(&adaptive("1e-3", "0.02", "0.1"), &["time.step = 0.01", "0.02 to 0.1 s"]);
}
