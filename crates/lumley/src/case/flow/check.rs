//! From what a flow's case file says to what it means.

use super::fields::{Given, check_finite, written};
use super::time::{instants, march};
use super::{
    FlowCase, FlowFile, InitialSection, Probe, RecordChoice, Reference, Start, TimeChoice, bodies,
    boundaries, mesh, periodic,
};
use crate::case::ask::{Ask, Transfers};
use crate::case::formula::Variables;
use crate::case::{CaseError, Document, PodChoice};
use crate::manifest::MANIFEST;
use lumley_fem::{PlanarMesh, Point, UniformGrid};
use lumley_fom::TimeScheme;
use lumley_fom::flow::{FlowParameters, VectorField};
use std::path::Path;
use std::sync::Arc;

/// Most nodes of the fixed grid.
const MOST_NODES: usize = 100_000_000;

/// Turns what was written into what is meant.
pub(in crate::case) fn check(
    document: &Document,
    file: FlowFile,
    name: &str,
    folder: &Path,
) -> Result<FlowCase, CaseError> {
    let ask = &Ask(document);
    let march = march(ask, &file)?;
    still(ask, &file)?;
    let times: &[f64] = &march.unsteady().map_or(vec![0.0], |time| vec![0.0, time.end]);
    let mesh = mesh::build(ask, &file.mesh, folder)?;
    let bodies = bodies::bodies(ask, &file, &mesh, &march, times)?;
    let conditions = boundaries::conditions(ask, &file, &mesh, folder, times)?;
    periodic::check_balance(ask, &mesh, &conditions, times)?;
    let record = record(ask, &file, &mesh, march.unsteady())?;
    Ok(FlowCase {
        name: name.to_owned(),
        parameters: parameters(ask, &file, &mesh, times)?,
        start: start(ask, &file, &mesh, folder)?,
        reference: reference(ask, &file)?,
        pressure_difference: pressure_difference(ask, &file, &mesh)?,
        probes: probes(ask, &file, &mesh)?,
        paraview: match (file.output.paraview, march.unsteady()) {
            (Some(interval), Some(time)) => {
                let key = "output.paraview";
                Some(instants(ask, time, (key, 0.0), (key, interval))?)
            }
            _ => None,
        },
        loads_every: loads(ask, &file)?,
        pod: pod(ask, &file, record.as_ref())?,
        bodies,
        mesh,
        conditions,
        march,
        record,
        folder: folder.to_owned(),
        file,
    })
}

/// A steady flow has no history to write.
fn still(ask: &Ask, file: &FlowFile) -> Result<(), CaseError> {
    let expected = "nothing: [steady] seeks one flow, which has no history";
    for (key, given) in [
        ("record", file.record.is_some()),
        ("pod", file.pod.is_some()),
        ("output.paraview", file.output.paraview.is_some()),
    ] {
        ask.that(file.steady.is_none() || !given, key, "given", expected)?;
    }
    Ok(())
}

fn parameters(
    ask: &Ask,
    file: &FlowFile,
    mesh: &PlanarMesh,
    times: &[f64],
) -> Result<FlowParameters, CaseError> {
    let flow = &file.flow;
    ask.positive("flow.density", flow.density, "kg/m³")?;
    ask.positive("flow.viscosity", flow.viscosity, "Pa s")?;
    let body_force = match &flow.body_force {
        None => None,
        Some(terms) => {
            let (key, text) = ("flow.body_force", written(terms));
            let force = Given::read(ask, key, terms, Variables::PlaceAndTime, "m/s²")?;
            let expected = "a force that does not change with time: [steady] seeks the steady flow";
            ask.that(file.steady.is_none() || !force.uses_time(), key, &text, expected)?;
            check_finite(ask, (key, &text), &force, mesh.nodes(), times)?;
            Some(Arc::new(force) as Arc<dyn VectorField>)
        }
    };
    Ok(FlowParameters {
        density: flow.density,
        viscosity: flow.viscosity,
        viscous_form: flow.viscous_form,
        linearisation: flow.linearisation,
        scheme: file.time.as_ref().map_or(TimeScheme::default(), |time| time.scheme),
        body_force,
    })
}

fn start(ask: &Ask, file: &FlowFile, mesh: &PlanarMesh, folder: &Path) -> Result<Start, CaseError> {
    let key = "flow.initial";
    Ok(match &file.flow.initial {
        InitialSection::Rest => Start::Rest,
        InitialSection::Stokes => Start::Stokes,
        InitialSection::Velocity(terms) => {
            let velocity = Given::read(ask, key, terms, Variables::Place, "m/s")?;
            check_finite(ask, (key, &written(terms)), &velocity, mesh.nodes(), &[0.0])?;
            Start::Velocity(Arc::new(velocity))
        }
        InitialSection::Run(run) => {
            let path = folder.join(run);
            let expected = "the directory of a complete run of a flow";
            ask.that(path.join(MANIFEST).is_file(), key, run, expected)?;
            Start::Run(path)
        }
    })
}

fn reference(ask: &Ask, file: &FlowFile) -> Result<Option<Reference>, CaseError> {
    let Some(section) = &file.flow.reference else { return Ok(None) };
    let (velocity, length) = (section.velocity, section.length);
    let density = section.density.unwrap_or(file.flow.density);
    ask.positive("flow.reference.velocity", velocity, "m/s")?;
    ask.positive("flow.reference.length", length, "m")?;
    ask.positive("flow.reference.density", density, "kg/m³")?;
    Ok(Some(Reference { velocity, length, density }))
}

fn pressure_difference(
    ask: &Ask,
    file: &FlowFile,
    mesh: &PlanarMesh,
) -> Result<Option<[Point; 2]>, CaseError> {
    let Some(section) = &file.flow.pressure_difference else { return Ok(None) };
    for at in section.points {
        within(ask, "flow.pressure_difference.points", at, mesh)?;
    }
    Ok(Some(section.points))
}

fn probes(ask: &Ask, file: &FlowFile, mesh: &PlanarMesh) -> Result<Vec<Probe>, CaseError> {
    let sections = &file.flow.probes;
    for (k, probe) in sections.iter().enumerate() {
        let key = format!("flow.probes.{k}.name");
        let name = &probe.name;
        let plain = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-' | '.');
        let ok = !name.is_empty() && name.chars().all(plain);
        ask.that(ok, &key, format!("\"{name}\""), "a name of letters, digits, -, _ and .")?;
        let taken = sections[..k].iter().any(|other| other.name == *name);
        ask.that(!taken, &key, name, "a name of its own")?;
        within(ask, &format!("flow.probes.{k}.at"), probe.at, mesh)?;
    }
    let probe = |p: &super::ProbeSection| Probe { name: p.name.clone(), at: p.at };
    Ok(sections.iter().map(probe).collect())
}

/// Refuses a point that cannot be in the domain.
fn within(ask: &Ask, key: &str, [x, y]: Point, mesh: &PlanarMesh) -> Result<(), CaseError> {
    let [lower, upper] = bounds(mesh);
    let ok = (lower[0]..=upper[0]).contains(&x) && (lower[1]..=upper[1]).contains(&y);
    let expected = format!("a point of the domain, which goes from {lower:?} to {upper:?} m");
    ask.that(ok, key, format!("[{x:?}, {y:?}]"), &expected)
}

/// Lower and upper corner of the mesh, in m.
fn bounds(mesh: &PlanarMesh) -> [Point; 2] {
    let corner = |start: f64, choose: fn(f64, f64) -> f64| {
        [0, 1].map(|d| mesh.nodes().iter().map(|node| node[d]).fold(start, choose))
    };
    [corner(f64::INFINITY, f64::min), corner(f64::NEG_INFINITY, f64::max)]
}

fn record(
    ask: &Ask,
    file: &FlowFile,
    mesh: &PlanarMesh,
    time: Option<&TimeChoice>,
) -> Result<Option<RecordChoice>, CaseError> {
    let (Some(section), Some(time)) = (&file.record, time) else { return Ok(None) };
    let Some(grid) = &file.grid else {
        let expected = "[grid] with nodes = [nx, ny]: snapshots are recorded on a fixed grid";
        return Err(ask.missing("grid", expected));
    };
    let [least, most] = bounds(mesh);
    let (lower, upper) = (grid.lower.unwrap_or(least), grid.upper.unwrap_or(most));
    for d in 0..2 {
        let ok = lower[d] < upper[d] && (upper[d] - lower[d]).is_finite();
        let expected = format!("a corner above and to the right of the lower one, {lower:?} m");
        ask.that(ok, "grid.upper", format!("{upper:?}"), &expected)?;
    }
    let nodes = grid.nodes;
    let count = nodes[0].checked_mul(nodes[1]).filter(|&count| count <= MOST_NODES);
    let ok = nodes.iter().all(|&n| n >= 2) && count.is_some();
    let expected = format!("at least 2 in x and in y, and at most {MOST_NODES:e} in all");
    ask.that(ok, "grid.nodes", format!("{nodes:?}"), &expected)?;
    let start = ("record.start", section.start);
    let when = instants(ask, time, start, ("record.interval", section.interval))?;
    let transfers = ask.transfer(&file.transfer, mesh.topology().nodes())?;
    let Transfers { chosen: transfer, inverse_distance } = transfers;
    let grid = UniformGrid::rectangle(lower, upper, nodes);
    Ok(Some(RecordChoice { grid, transfer, inverse_distance, when }))
}

fn loads(ask: &Ask, file: &FlowFile) -> Result<usize, CaseError> {
    let every = file.output.loads;
    ask.that(every >= 1, "output.loads", every, "at least 1 step between rows")?;
    Ok(every)
}

fn pod(
    ask: &Ask,
    file: &FlowFile,
    record: Option<&RecordChoice>,
) -> Result<Option<PodChoice>, CaseError> {
    let Some(section) = &file.pod else { return Ok(None) };
    let expected = "[record] with an interval in s: POD is made of recorded snapshots";
    let Some(record) = record else { return Err(ask.refuse("pod", "a table", expected)) };
    ask.pod(section, record.when.count).map(Some)
}
