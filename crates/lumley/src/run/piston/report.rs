use super::full_order;
use crate::Error;
use crate::case::{InitialFlowSection, PistonCase};
use crate::format::npz::NpzReader;
use crate::record::Record;
use crate::report::{
    EqualAccuracy, Frame, ModeSet, Outcome, Parameters, PistonReport, Provenance, RomResults,
    RomRun, Trajectory, TransferError, Variant,
};
use crate::run::BasisFile;
use crate::run::decompose::whole;
use crate::run::report::columns;
use crate::run::stages::read_summary;
use crate::summary::{self, Reduced, Summary, TransferErrors};
use std::path::Path;

/// Reads everything that the report shows from the run in `folder`.
pub(in crate::run) fn report(folder: &Path, case: &PistonCase) -> Result<PistonReport, Error> {
    let (manifest, summary) = read_summary(folder)?;
    let record = folder.join("record");
    let record = if record.exists() { Some(Record::open(record)?) } else { None };
    let own_basis = summary.basis.is_none();
    let reduced = summary.rom.iter().map(|model| reduced(folder, case, model));
    let nodes = full_order(case)?.nodes().collect();
    let grid = (0..case.grid.len()).map(|k| case.grid.point(k)[0]).collect();
    let basis = folder.join("basis");
    Ok(PistonReport {
        name: manifest.case.clone(),
        parameters: parameters(case),
        times: (0..case.schedule.snapshots()).map(|k| case.schedule.time(k)).collect(),
        full: record.as_ref().map_or_else(|| Ok(Trajectory::default()), trajectory)?,
        eigenvalues: spectrum(&basis.join("fixed.npz"))?,
        fixed_grid: mode_set(&basis.join("fixed.npz"), grid, own_basis)?,
        reference: mode_set(&basis.join("reference.npz"), nodes, own_basis)?,
        projection: summary.projection.res_percent.clone(),
        reduced: reduced.collect::<Result<_, _>>()?,
        variants: variants(&summary),
        transfer: transfer(case, &summary),
        provenance: Provenance::of(&manifest, case.to_toml()),
    })
}

/// All eigenvalues that the decomposition saw, not only those of the modes that are kept.
fn spectrum(path: &Path) -> Result<Vec<f64>, Error> {
    Ok(NpzReader::open(path)?.vector("spectrum")?)
}

/// The modes in the file at `path`, if there is one; the coefficients in it are those of the snapshots
/// that made it, which are this run's own or not.
fn mode_set(path: &Path, nodes: Vec<f64>, own: bool) -> Result<ModeSet, Error> {
    if !path.exists() {
        return Ok(ModeSet::default());
    }
    let basis = BasisFile::load(path)?;
    let projected = if own { columns(basis.coefficients.transpose()) } else { Vec::new() };
    Ok(ModeSet { nodes, modes: columns(basis.modes.as_ref()), projected })
}

fn parameters(case: &PistonCase) -> Parameters {
    let p = &case.file.piston;
    let initial_flow = match &p.initial_flow {
        InitialFlowSection::Zero => "at rest".to_owned(),
        InitialFlowSection::Linear => "X'(0) x/X(0)".to_owned(),
        InitialFlowSection::Sine(amplitude) => format!("linear and {amplitude} m/s sin(pi x/X(0))"),
        InitialFlowSection::Table(name) => format!("the table {name}"),
    };
    let scheme =
        toml::Value::try_from(case.scheme).map_or_else(|_| String::new(), |v| v.to_string());
    Parameters {
        viscosity: p.viscosity,
        spring_length: p.spring_length,
        stiffness: p.stiffness,
        damping: p.damping,
        mass: p.mass,
        force_factor: p.force_factor,
        initial_position: p.initial_position,
        initial_velocity: p.initial_velocity,
        initial_flow,
        domain_length: p.domain_length,
        end: case.schedule.end(),
        discretisation: format!(
            "{}, {} cells of degree {}, step {} s",
            scheme.trim_matches('"'),
            case.cells,
            case.degree,
            case.schedule.step
        ),
    }
}

fn trajectory(record: &Record) -> Result<Trajectory, Error> {
    let entry = |name| Ok::<_, Error>(record.series(name)?.entry(0).collect());
    let field = whole(&record.frame("fixed")?)?;
    Ok(Trajectory {
        position: entry("position")?,
        velocity: entry("velocity")?,
        traction: entry("traction")?,
        field: field
            .col_iter()
            .flat_map(|column| column.iter().copied().collect::<Vec<_>>())
            .collect(),
    })
}

fn reduced(folder: &Path, case: &PistonCase, model: &Reduced) -> Result<RomResults, Error> {
    let record = Record::open(folder.join("rom").join(&model.label).join("record"))?;
    let shown = model.shown.unwrap_or_default();
    let run = |k: usize| RomRun {
        modes: model.modes[k],
        outcome: match (&model.failure[k], model.res_percent[k]) {
            (Some(failure), _) => {
                Outcome::BlewUp { time: failure.time, message: failure.message.clone() }
            }
            (None, res) => Outcome::Finished { res_percent: res.unwrap_or(f64::NAN) },
        },
        step_us: model.step_us[k].unwrap_or(f64::NAN),
    };
    let coefficients = record.series("coefficients")?;
    Ok(RomResults {
        name: model.label.clone(),
        runs: (0..model.modes.len()).map(run).collect(),
        shown,
        steps: case.rom_schedule.steps(),
        trajectory: trajectory(&record)?,
        equal: model.speedup.map(|speedup| EqualAccuracy {
            reduced: variant(&speedup.reduced),
            full: variant(&speedup.full),
        }),
        frame: if model.reference_frame { Frame::Reference } else { Frame::FixedGrid },
        coefficients: (0..shown).map(|n| coefficients.entry(n).collect()).collect(),
    })
}

fn variants(summary: &Summary) -> Vec<Variant> {
    summary.fom.iter().flat_map(|fom| fom.variants.iter().map(variant)).collect()
}

fn variant(variant: &summary::Variant) -> Variant {
    let &summary::Variant { size, step, steps, step_us, res_percent } = variant;
    Variant { size, step, steps, step_us, error_percent: res_percent }
}

fn transfer(case: &PistonCase, summary: &Summary) -> Vec<TransferError> {
    let Some(TransferErrors::Piston { finite_element_percent, inverse_distance_percent }) =
        summary.transfer
    else {
        return Vec::new();
    };
    let section = &case.file.transfer;
    let (power, neighbours) = (section.power, section.neighbours);
    let inverse = format!("inverse distance, power {power}, {neighbours} neighbours");
    vec![
        TransferError {
            method: "finite-element evaluation".into(),
            error_percent: finite_element_percent,
        },
        TransferError { method: inverse, error_percent: inverse_distance_percent },
    ]
}
