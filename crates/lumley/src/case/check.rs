use super::document::Document;
use super::raw::{CaseFile, FlowSection, PodSection, TransferMethod};
use super::{Case, CaseError, PodChoice, Schedule};
use crate::format::csv;
use lumley_body::joint::Prismatic;
use lumley_fem::UniformGrid;
use lumley_fem::transfer::Transfer;
use lumley_fom::{InitialFlow, PistonParameters};
use lumley_pod::{ALGORITHMS, Truncation};
use lumley_rom::ReducedError;
use std::fmt::{self, Display};
use std::path::Path;

/// Most snapshots, and most steps between two.
const MOST: f64 = 1e9;
/// Most cells of a line: beyond it, a slip of the pen is likelier than a wish.
const MOST_CELLS: usize = 1_000_000;

/// Turns what was written into what is meant.
pub(super) fn check(
    document: &Document,
    file: CaseFile,
    name: &str,
    folder: &Path,
) -> Result<Case, CaseError> {
    let ask = Ask(document);
    let piston = piston(&ask, &file, folder)?;
    let rom_schedule = schedule(&ask, &file, "rom.step", file.rom.step)?;
    let schedule = schedule(&ask, &file, "time.step", file.time.step)?;
    sizes(&ask, &file, &schedule)?;
    let inverse_distance = inverse_distance(&ask, &file)?;
    models(&ask, &file)?;
    Ok(Case {
        name: name.to_owned(),
        piston,
        scheme: file.time.scheme,
        cells: file.mesh.cells,
        degree: file.mesh.degree,
        schedule,
        grid: UniformGrid::line(0.0, file.piston.domain_length, file.grid.nodes),
        transfer: match file.transfer.method {
            TransferMethod::FiniteElement => Transfer::FiniteElement {},
            TransferMethod::InverseDistance => inverse_distance,
        },
        inverse_distance,
        pod: pod(&ask, &file.pod)?,
        rom_schedule,
        integrator: file.rom.integrator,
        models: file.rom.models.clone(),
        file,
    })
}

/// Questions to the document, so that a wrong value is refused with its place.
struct Ask<'a>(&'a Document);

impl Ask<'_> {
    fn refuse(&self, key: &str, value: impl Display, expected: &str) -> CaseError {
        CaseError::Value {
            place: self.0.place(key),
            key: key.to_owned(),
            value: value.to_string(),
            expected: expected.to_owned(),
        }
    }

    fn that(
        &self,
        ok: bool,
        key: &str,
        value: impl Display,
        expected: &str,
    ) -> Result<(), CaseError> {
        if ok { Ok(()) } else { Err(self.refuse(key, value, expected)) }
    }

    fn positive(&self, key: &str, value: f64, unit: &str) -> Result<(), CaseError> {
        let expected = format!("a positive, finite number in {unit}");
        self.that(value.is_finite() && value > 0.0, key, Number(value), &expected)
    }

    fn not_negative(&self, key: &str, value: f64, unit: &str) -> Result<(), CaseError> {
        let expected = format!("zero or a positive, finite number in {unit}");
        self.that(value.is_finite() && value >= 0.0, key, Number(value), &expected)
    }

    fn finite(&self, key: &str, value: f64, unit: &str) -> Result<(), CaseError> {
        self.that(value.is_finite(), key, Number(value), &format!("a finite number in {unit}"))
    }
}

/// A number in its shortest form: 1e300, not three hundred digits.
struct Number(f64);

impl Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?}", self.0)
    }
}

fn piston(ask: &Ask, file: &CaseFile, folder: &Path) -> Result<PistonParameters, CaseError> {
    let p = &file.piston;
    ask.positive("piston.viscosity", p.viscosity, "m²/s")?;
    ask.positive("piston.mass", p.mass, "kg")?;
    ask.not_negative("piston.stiffness", p.stiffness, "N/m")?;
    ask.not_negative("piston.damping", p.damping, "N s/m")?;
    ask.not_negative("piston.force_factor", p.force_factor, "kg/m")?;
    ask.finite("piston.spring_length", p.spring_length, "m")?;
    ask.finite("piston.initial_velocity", p.initial_velocity, "m/s")?;
    ask.positive("piston.domain_length", p.domain_length, "m")?;
    let inside = format!("the piston inside the domain: 0 < X(0) < {} m", p.domain_length);
    let x = p.initial_position;
    ask.that(x > 0.0 && x < p.domain_length, "piston.initial_position", Number(x), &inside)?;
    Ok(PistonParameters {
        viscosity: p.viscosity,
        domain_length: p.domain_length,
        force_factor: p.force_factor,
        joint: Prismatic {
            mass: p.mass,
            stiffness: p.stiffness,
            damping: p.damping,
            rest_length: p.spring_length,
        },
        initial_position: p.initial_position,
        initial_velocity: p.initial_velocity,
        initial_flow: initial_flow(ask, &p.initial_flow, folder)?,
    })
}

fn initial_flow(ask: &Ask, flow: &FlowSection, folder: &Path) -> Result<InitialFlow, CaseError> {
    let key = "piston.initial_flow";
    Ok(match flow {
        FlowSection::Zero => InitialFlow::Zero,
        FlowSection::Linear => InitialFlow::Linear,
        FlowSection::Sine(amplitude) => {
            ask.finite(key, *amplitude, "m/s")?;
            InitialFlow::Sine(*amplitude)
        }
        FlowSection::Table(name) => {
            let rows = csv::read_pairs(&folder.join(name));
            InitialFlow::Table(rows.map_err(|e| ask.refuse(key, name, &format!("a table: {e}")))?)
        }
    })
}

fn schedule(ask: &Ask, file: &CaseFile, key: &str, step: f64) -> Result<Schedule, CaseError> {
    let (end, interval) = (file.time.end, file.record.interval);
    ask.positive("record.interval", interval, "s")?;
    ask.positive("time.end", end, "s")?;
    ask.positive(key, step, "s")?;
    let most = format!("at most {MOST:e} times record.interval = {interval:?} s");
    ask.that(end / interval <= MOST, "time.end", Number(end), &most)?;
    let least = format!("at least {:e} times record.interval = {interval:?} s", 1.0 / MOST);
    ask.that(interval / step <= MOST, key, Number(step), &least)?;
    if Schedule::new(interval, interval, end).is_none() {
        let near = end / (end / interval).ceil();
        let expected = format!("a whole fraction of time.end = {end:?} s, such as {near:?}");
        return Err(ask.refuse("record.interval", Number(interval), &expected));
    }
    Schedule::new(step, interval, end).ok_or_else(|| {
        let near = interval / (interval / step).ceil();
        let expected =
            format!("a whole fraction of record.interval = {interval:?} s, such as {near:?}");
        ask.refuse(key, Number(step), &expected)
    })
}

fn models(ask: &Ask, file: &CaseFile) -> Result<(), CaseError> {
    let integrator = file.rom.integrator.validate();
    integrator.map_err(|e| ask.refuse("rom.integrator", "out of range", &e.to_string()))?;
    for (k, model) in file.rom.models.iter().enumerate() {
        model.validate().map_err(|error| match error {
            ReducedError::Parameter { name, value, unit, expected } => {
                let key = format!("rom.models.{k}.{name}");
                ask.refuse(&key, Number(value), &format!("a number in {unit}, {expected}"))
            }
            other => {
                ask.refuse(&format!("rom.models.{k}"), model.projection.name(), &other.to_string())
            }
        })?;
    }
    Ok(())
}

fn sizes(ask: &Ask, file: &CaseFile, schedule: &Schedule) -> Result<(), CaseError> {
    let (cells, degree, nodes) = (file.mesh.cells, file.mesh.degree, file.grid.nodes);
    ask.that((1..=2).contains(&degree), "mesh.degree", degree, "1 or 2")?;
    ask.that(
        (2..=MOST_CELLS).contains(&cells),
        "mesh.cells",
        cells,
        &format!("2 to {MOST_CELLS}"),
    )?;
    ask.that(nodes >= 3, "grid.nodes", nodes, "at least 3")?;
    // The record and two copies of it are in memory when models are compared.
    let memory = crate::manifest::memory();
    let fits = |count: usize| 24.0 * count as f64 * schedule.snapshots() as f64 <= memory;
    let most = format!("a record of at most a third of this machine's {:.0} GB", memory / 1e9);
    ask.that(fits(1), "record.interval", Number(schedule.interval), &most)?;
    ask.that(fits(cells.saturating_mul(degree)), "mesh.cells", cells, &most)?;
    ask.that(fits(nodes), "grid.nodes", nodes, &most)
}

/// The paper's inverse-distance weighting with the parameters of the case.
fn inverse_distance(ask: &Ask, file: &CaseFile) -> Result<Transfer, CaseError> {
    let (power, neighbours) = (file.transfer.power, file.transfer.neighbours);
    let nodes = file.mesh.cells.saturating_mul(file.mesh.degree).saturating_add(1);
    let number = "a positive, finite number";
    ask.that(power.is_finite() && power > 0.0, "transfer.power", Number(power), number)?;
    let expected = format!("at least 1 and at most the mesh's {nodes} nodes");
    ask.that((1..=nodes).contains(&neighbours), "transfer.neighbours", neighbours, &expected)?;
    Ok(Transfer::InverseDistance { power, neighbours })
}

fn pod(ask: &Ask, pod: &PodSection) -> Result<PodChoice, CaseError> {
    let names: Vec<&str> = ALGORITHMS.iter().map(|algorithm| algorithm.name).collect();
    let method = pod.method.as_str();
    ask.that(names.contains(&method), "pod.method", method, &names.join(", "))?;
    let truncation = match (pod.modes, pod.energy) {
        (Some(modes), Some(_)) => {
            return Err(ask.refuse("pod.modes", modes, "either pod.modes or pod.energy, not both"));
        }
        (Some(modes), None) => {
            ask.that(modes >= 1, "pod.modes", modes, "at least 1")?;
            Truncation::Modes(modes)
        }
        (None, energy) => {
            let share = energy.unwrap_or(0.9999);
            let expected = "a share of the energy above 0 and at most 1, such as 0.9999";
            ask.that(share > 0.0 && share <= 1.0, "pod.energy", Number(share), expected)?;
            Truncation::Energy(share)
        }
    };
    Ok(PodChoice { method: method.to_owned(), truncation, center: pod.center })
}
