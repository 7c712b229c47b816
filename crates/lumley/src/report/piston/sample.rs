//! Data with the shape of a real run, from formulas, for tests.

use std::f64::consts::PI;

use super::{
    EqualAccuracy, Frame, ModeSet, Outcome, Parameters, PistonReport, RomResults, RomRun,
    Trajectory, TransferError, Variant,
};
use crate::report::Provenance;

/// A damped oscillation of the block with a boundary layer before it, and five reduced models of
/// which the first blows up.
pub(super) fn report(nodes: usize, times: usize) -> PistonReport {
    let grid: Vec<f64> = (0..nodes).map(|i| 1.1 * i as f64 / (nodes - 1) as f64).collect();
    let times: Vec<f64> = (0..times).map(|k| 2.0 * k as f64 / (times - 1) as f64).collect();
    let names = ["as printed", "corrected", "multiplier", "penalty", "mapped"];
    let model = |(k, name): (usize, &&str)| reduced(name, k, &grid, &times);
    PistonReport {
        name: "piston".into(),
        parameters: parameters(),
        full: trajectory(&grid, &times, 1.0),
        eigenvalues: (0..12).map(|i| 0.006 * (-2.0 * f64::from(i)).exp()).collect(),
        reference: modes(grid.iter().map(|x| x / 1.1).collect(), &times),
        projection: (1..=10).map(|n| 40.0 * (-0.6 * f64::from(n)).exp()).collect(),
        reduced: names.iter().enumerate().map(model).collect(),
        variants: vec![
            Variant { size: 25, step: 1e-2, steps: 200, step_us: 3.0, error_percent: 4.0 },
            hundred_cells(),
        ],
        transfer: vec![TransferError { method: "inverse distance".into(), error_percent: 0.3 }],
        provenance: Provenance {
            version: "0.1.0".into(),
            command: "lumley run case.toml".into(),
            machine: "two cores".into(),
            stages: vec![("full-order model".into(), 0.4), ("report".into(), 0.04)],
            case_file: "[piston]\nviscosity = 0.2\n".into(),
        },
        fixed_grid: modes(grid, &times),
        times,
    }
}

fn hundred_cells() -> Variant {
    Variant { size: 100, step: 2e-3, steps: 1000, step_us: 9.0, error_percent: 0.5 }
}

fn parameters() -> Parameters {
    Parameters {
        viscosity: 0.2,
        spring_length: 0.95,
        stiffness: 39.5,
        damping: 0.1,
        mass: 0.5,
        force_factor: 1.0,
        initial_position: 0.9,
        initial_velocity: 0.0,
        initial_flow: "zero".into(),
        domain_length: 1.1,
        end: 2.0,
        discretisation: "800 cells".into(),
    }
}

fn trajectory(grid: &[f64], times: &[f64], gain: f64) -> Trajectory {
    let position: Vec<f64> =
        times.iter().map(|t| 0.95 - 0.05 * gain * (-t).exp() * (8.9 * t).cos()).collect();
    let velocity: Vec<f64> =
        times.iter().map(|t| 0.445 * gain * (-t).exp() * (8.9 * t).sin()).collect();
    let field = position
        .iter()
        .zip(&velocity)
        .flat_map(|(face, v)| grid.iter().map(move |x| v * (x / face).min(1.0).powi(6)));
    Trajectory { field: field.collect(), traction: velocity.clone(), position, velocity }
}

fn modes(nodes: Vec<f64>, times: &[f64]) -> ModeSet {
    let mode = |n: u32| nodes.iter().map(|x| (f64::from(n) * PI * x).sin()).collect();
    let coefficient =
        |n: u32| times.iter().map(|t| (f64::from(n) * 8.9 * t).sin() / f64::from(n)).collect();
    ModeSet {
        modes: (1..=4).map(mode).collect(),
        projected: (1..=4).map(coefficient).collect(),
        nodes,
    }
}

fn reduced(name: &str, k: usize, grid: &[f64], times: &[f64]) -> RomResults {
    let message = "|a| exceeds 1e6".to_string();
    let run = |n: u32| RomRun {
        modes: n as usize,
        outcome: match k {
            0 if n > 2 => Outcome::BlewUp { time: 0.5, message: message.clone() },
            _ => Outcome::Finished { res_percent: 60.0 * (-0.2 * f64::from(n) * k as f64).exp() },
        },
        step_us: 0.3 * f64::from(n),
    };
    let reached = if k == 0 { times.len() / 4 } else { times.len() };
    RomResults {
        name: name.into(),
        runs: (1..=10).map(run).collect(),
        frame: if k == 4 { Frame::Reference } else { Frame::FixedGrid },
        shown: 6,
        steps: 8000,
        equal: (k == 4).then(|| EqualAccuracy {
            reduced: Variant { size: 6, step: 1e-2, steps: 200, step_us: 1.8, error_percent: 0.5 },
            full: hundred_cells(),
        }),
        trajectory: trajectory(grid, &times[..reached], 1.0 + 0.1 / (k + 1) as f64),
        coefficients: modes(Vec::new(), &times[..reached]).projected,
    }
}
