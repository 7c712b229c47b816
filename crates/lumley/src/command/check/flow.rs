use super::{bodies, bytes, duration};
use crate::Error;
use crate::case::{FlowCase, March, Start, TimeChoice};
use crate::command::say;
use crate::run::planar_flow;
use lumley_fem::space::NodalSpace;
use lumley_fom::flow::Condition;

/// Time of a step for each unknown, in s, on one core: `docs/benchmarks.md`.
const STEP_PER_UNKNOWN: f64 = 6e-7;
/// Time of an iteration to the steady flow for each unknown, in s, on one core: each has a factor of its own.
const ITERATION_PER_UNKNOWN: f64 = 6e-6;
/// Memory of a run for each unknown, in bytes: two factors and the cell matrices.
const MEMORY_PER_UNKNOWN: f64 = 1600.0;
/// Numbers at a node of a file for ParaView: place, velocity, mesh velocity, pressure, vorticity, cells.
const PARAVIEW_NUMBERS: f64 = 14.0;
/// Characters of a number in a table.
const CHARACTERS: f64 = 20.0;

/// Says what the case would do.
pub(super) fn tell(case: &FlowCase) -> Result<(), Error> {
    // Whether the mesh can follow the bodies to their start is known only then.
    let model = case.bodies.as_ref().map(|_| planar_flow(case, 1)).transpose()?;
    say(&format!("case            {}: {}", case.name, case.file.title))?;
    mesh(case)?;
    conditions(case)?;
    if let (Some(choice), Some(model)) = (&case.bodies, &model) {
        bodies::tell(choice, model)?;
    }
    let velocity = NodalSpace::velocity(case.mesh.topology()).dofs().len();
    let unknowns = 2 * velocity + 3 * case.mesh.topology().cells();
    say(&format!("full-order      {unknowns} unknowns, {}", march(case)))?;
    let rows = match &case.march {
        March::Steady(_) => 1.0,
        March::Unsteady(time) => steps(time).1 / case.loads_every as f64,
    };
    let moving = case.bodies.as_ref().map_or(0, |choice| bodies::columns(&choice.tree));
    let columns = 4 * case.conditions.len() + 3 * case.probes.len() + moving;
    let tables = CHARACTERS * rows * columns as f64;
    let disk = record(case)? + paraview(case, velocity)? + tables;
    if let Some(pod) = &case.pod {
        say(&format!("pod             {}", pod.method))?;
    }
    say(&format!("time            about {} on one core", time(case, unknowns as f64)))?;
    say(&format!("disk            about {}", bytes(disk)))?;
    say(&format!("memory          about {}", bytes(MEMORY_PER_UNKNOWN * unknowns as f64)))
}

fn mesh(case: &FlowCase) -> Result<(), Error> {
    let quality = case.mesh.quality();
    say(&format!(
        "mesh            {} triangles and {} quadrilaterals on {:.6} m², edges of {:.3e} to {:.3e} m",
        quality.triangles,
        quality.quadrilaterals,
        quality.area,
        quality.shortest_edge.value,
        quality.longest_edge.value
    ))?;
    for (what, extreme) in [
        ("scaled Jacobian (1 is best, 0 folded)", quality.scaled_jacobian),
        ("aspect ratio (1 is best)", quality.aspect),
    ] {
        let [x, y] = case.mesh.centre(extreme.cell);
        let value = extreme.value;
        say(&format!("                worst {what}: {value:.3} near ({x:.4}, {y:.4}) m"))?;
    }
    Ok(())
}

fn conditions(case: &FlowCase) -> Result<(), Error> {
    for (name, condition) in &case.conditions {
        let what = match condition {
            Condition::Periodic { with } => format!("periodic with {with}"),
            other => other.name().to_owned(),
        };
        let mut bodies = case.bodies.iter().flat_map(|choice| choice.tree.bodies());
        let of = bodies.find(|body| body.boundary.as_ref() == Some(name));
        let of = of.map_or(String::new(), |body| format!(", of the body {}", body.name));
        say(&format!("boundary        {name}: {what}{of}"))?;
    }
    let outlet = case.conditions.iter().any(|(_, c)| matches!(c, Condition::TractionFree));
    if !outlet {
        say("                no outlet: the mean pressure is set to zero")?;
    }
    if let Some(reference) = &case.reference {
        let velocity = reference.velocity * reference.length;
        let reynolds = case.parameters.density * velocity / case.parameters.viscosity;
        say(&format!("reference       Re = {reynolds:.3}"))?;
    }
    Ok(())
}

fn march(case: &FlowCase) -> String {
    let start = match &case.start {
        Start::Rest => "rest".to_owned(),
        Start::Stokes => "the creeping flow".to_owned(),
        Start::Velocity(_) => "a given velocity".to_owned(),
        Start::Run(path) => format!("the end of {}", path.display()),
    };
    match &case.march {
        March::Steady(steady) => {
            format!("from {start} to the steady flow in at most {} iterations", steady.iterations)
        }
        March::Unsteady(time) => match (time.steps, &time.adaptive) {
            (Some(steps), _) => format!("from {start}, {steps} steps of {} s", time.step),
            (None, adaptive) => {
                let (shortest, longest) =
                    adaptive.map_or((time.step, time.step), |a| (a.shortest, a.longest));
                format!("from {start}, steps of {shortest} to {longest} s to {} s", time.end)
            }
        },
    }
}

/// Fewest and most steps.
fn steps(time: &TimeChoice) -> (f64, f64) {
    let count = |step: f64| (time.end / step).ceil();
    match &time.adaptive {
        Some(adaptive) => (count(adaptive.longest), count(adaptive.shortest)),
        None => (count(time.step), count(time.step)),
    }
}

fn time(case: &FlowCase, unknowns: f64) -> String {
    match &case.march {
        March::Steady(_) => format!("{} an iteration", duration(ITERATION_PER_UNKNOWN * unknowns)),
        March::Unsteady(time) => {
            let (fewest, most) = steps(time);
            let [least, longest] =
                [fewest, most].map(|count| duration(STEP_PER_UNKNOWN * unknowns * count));
            if least == longest { least } else { format!("{least} to {longest}") }
        }
    }
}

/// Says what is recorded, and how many bytes it takes.
fn record(case: &FlowCase) -> Result<f64, Error> {
    let Some(record) = &case.record else { return Ok(0.0) };
    let ([nx, ny], when) = (record.grid.nodes(), &record.when);
    let (first, last) = (when.time(0), when.time(when.count - 1));
    let count = when.count;
    say(&format!(
        "record          {count} snapshots on {nx} x {ny} nodes, t = {first} to {last:.6} s"
    ))?;
    Ok((2 * size_of::<f64>() * record.grid.len()) as f64 * count as f64)
}

/// Says what is written for ParaView, and how many bytes it takes.
fn paraview(case: &FlowCase, velocity: usize) -> Result<f64, Error> {
    let files = case.paraview.as_ref().map_or(1, |when| when.count);
    say(&format!("paraview        {files} files"))?;
    let numbers = PARAVIEW_NUMBERS * velocity as f64;
    Ok(size_of::<f64>() as f64 * numbers * files as f64)
}
