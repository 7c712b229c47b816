//! Case files of flows: what they mean, and what is refused, with its place and what to do.

mod bad_bodies;
mod bad_input;
mod bodies;
mod files;
mod meaning;

use lumley::case::{Case, CaseError, FlowCase};
use std::path::Path;

/// A duct with a disc that moves, every section written.
const DUCT: &str = r#"title = "duct"

[flow]
density = 2.0
viscosity = 0.01
viscous_form = "laplacian"
body_force = [0, "-9.81*t"]
initial = { velocity = ["1 - y^2", 0] }

[flow.boundaries.left]
kind = "velocity"
velocity = ["y*(1 - y)*sin(t)", 0]
ramp = 0.5

[flow.boundaries.right]
kind = "traction-free"

[flow.boundaries.bottom]
kind = "no-slip"

[flow.boundaries.top]
kind = "slip"

[flow.boundaries.disc]
kind = "no-slip"

[flow.reference]
velocity = 2.0
length = 0.2

[flow.pressure_difference]
points = [[0.4, 0.5], [1.6, 0.5]]

[[flow.probes]]
name = "wake"
at = [1.5, 0.5]

[mesh]
x = [0, 2]
y = [0, 1]
size = 0.25

[[mesh.bodies]]
name = "disc"
shape = { kind = "disc", centre = [0.6, 0.5], radius = 0.1 }
size = 0.1

[motion]
stiffness = { kind = "uniform" }
rigid_zone = 0.05

[[bodies]]
name = "disc"
centre = [0.6, 0.5]
boundary = "disc"

[bodies.joint]
kind = "prescribed"
y = "0.05*sin(2*pi*t)"
angle = 0.0

[time]
end = 3.0
step = 0.01

[grid]
nodes = [41, 21]

[record]
start = 1.0
interval = 0.1

[output]
paraview = 0.25

[pod]
modes = 4
"#;

/// A square without an outlet.
const BOX: &str = r#"
[flow]
density = 1.0
viscosity = 0.01

[flow.boundaries.left]
kind = "no-slip"

[flow.boundaries.right]
kind = "no-slip"

[flow.boundaries.bottom]
kind = "no-slip"

[flow.boundaries.top]
kind = "velocity"
velocity = [1, 0]

[mesh]
x = [0, 1]
y = [0, 2]
cells = [2, 4]

[steady]
"#;

fn parse(text: &str) -> Result<Case, CaseError> {
    Case::parse("case.toml".as_ref(), text, false, &[])
}

/// The flow of a case file that is right.
fn flow(text: &str) -> FlowCase {
    flow_at("case.toml".as_ref(), text)
}

/// The flow of a case file that is right and stands at `path`.
fn flow_at(path: &Path, text: &str) -> FlowCase {
    match Case::parse(path, text, false, &[]) {
        Ok(Case::Flow(case)) => *case,
        Ok(Case::Piston(_)) => panic!("it has a [flow]"),
        Err(error) => panic!("{error}"),
    }
}

/// `text` with the first `right` replaced by `wrong`.
fn with(text: &str, right: &str, wrong: &str) -> String {
    assert!(text.contains(right), "no {right:?} in the case");
    text.replacen(right, wrong, 1)
}

/// The error says all of these.
fn refused(text: &str, words: &[&str]) {
    let error = parse(text).expect_err("it is wrong").to_string();
    for word in words {
        assert!(error.contains(word), "no {word:?} in: {error}");
    }
    assert!(error.len() < 800, "an error should be short: {error}");
}
