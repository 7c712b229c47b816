//! Times steps of the flow past the cylinder of Schäfer and Turek (1996), case 2D-2, on one thread.
//!
//! ```text
//! flow_timing SIZE STEP END [moving|free]
//! ```
//!
//! SIZE scales the cells of the mesh, STEP and END are in s; with `moving` the cylinder swings across the channel, so
//! that the mesh moves and every matrix differs; with `free` it is a body on springs that the flow moves. Prints a line of JSON: unknowns, cells, CPU ms of a step (mean over all
//! but the first two), peak memory, and over the last half of the run the largest coefficients of drag and
//! lift and the Strouhal number.

use lumley_fem::PlanarMesh;
use lumley_fem::generate::Channel;
use lumley_fom::TimeScheme;
use lumley_fom::coupling::BodySetup;
use lumley_fom::flow::{
    Condition, Flow, FlowMotion, FlowParameters, FlowSetup, FlowStart, Linearisation, ViscousForm,
};
use lumley_fom::motion::{
    MeshMotion, MotionParameters, MovingBoundary, PrescribedMotion, RigidMotion,
};
use rustix::time::{ClockId, clock_gettime};
use serde_json::json;
use std::env;
use std::error::Error;
use std::sync::Arc;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let number = |k: usize| -> Result<f64, Box<dyn Error>> {
        Ok(arguments.get(k).ok_or("flow_timing SIZE STEP END [moving|free]")?.parse()?)
    };
    let (size, dt, end) = (number(0)?, number(1)?, number(2)?);
    let motion = arguments.get(3).map_or("still", String::as_str);
    let mut flow = flow(size, motion)?;
    let steps = (end / dt).round();
    let mut series = Vec::new();
    let mut counts = [0; 2];
    let mut begun = cpu();
    while series.len() < steps as usize {
        let step = flow.step(dt)?;
        if series.len() == 1 {
            begun = cpu();
        }
        counts = [counts[0] + step.iterations, counts[1] + step.renewals];
        let cylinder = flow.loads()[4].coefficients(1.0, 1.0, 0.1);
        series.push((flow.time(), cylinder));
    }
    let ms = (cpu() - begun) / (steps - 2.0) * 1e3;
    let late = &series[series.len() / 2..];
    let most = |d: usize| late.iter().map(|(_, c)| c[d]).fold(f64::MIN, f64::max);
    let ups: Vec<f64> = late
        .windows(2)
        .filter(|w| w[0].1[1] < 0.0 && w[1].1[1] >= 0.0)
        .map(|w| w[0].0 - (w[1].0 - w[0].0) * w[0].1[1] / (w[1].1[1] - w[0].1[1]))
        .collect();
    let periods = ups.len() as f64 - 1.0;
    let strouhal = (periods > 0.0).then(|| 0.1 * periods / (ups[ups.len() - 1] - ups[0]));
    println!(
        "{}",
        json!({
            "unknowns": flow.unknowns(), "cells": flow.mesh().topology().cells(), "step": dt, "ms": ms,
            "iterations": counts[0] as f64 / steps, "renewals": counts[1], "peak_mb": peak_mb(),
            "drag": most(0), "lift": most(1), "strouhal": strouhal, "courant": flow.courant_number(dt),
            "surface": flow.surface_load("cylinder").map(|load| load.coefficients(1.0, 1.0, 0.1)),
            "last": series[series.len() - 1].1,
        })
    );
    Ok(())
}

fn flow(size: f64, motion: &str) -> Result<Flow, Box<dyn Error>> {
    let channel = serde_json::from_value::<Channel>(json!({
        "x": [0, 2.2], "y": [0, 0.41], "size": 0.06 * size, "growth": 0.05,
        "bodies": [{
            "name": "cylinder",
            "shape": { "kind": "disc", "centre": [0.2, 0.2], "radius": 0.05 },
            "size": 0.01 * size,
            "layers": { "first": 0.004 * size, "growth": 1.3, "count": 3 },
        }],
    }))?;
    let mesh = PlanarMesh::new(channel.mesh()?)?;
    let inflow = |[_, y]: [f64; 2], _| [6.0 * y * (0.41 - y) / (0.41 * 0.41), 0.0];
    let motion = match motion {
        "still" => FlowMotion::Still,
        "moving" => swinging(&mesh)?,
        "free" => FlowMotion::Bodies(BodySetup {
            bodies: vec![serde_json::from_value(json!({
                "name": "cylinder", "mass": 0.02, "centre": [0.2, 0.2], "boundary": "cylinder",
                "joint": {
                    "kind": "cartesian",
                    "spring_x": { "stiffness": 40.0, "damping": 0.5 }, "spring_y": { "stiffness": 10.0, "damping": 0.1 }
                }
            }))?],
            ..BodySetup::default()
        }),
        other => return Err(format!("{other}: expected moving or free").into()),
    };
    Ok(Flow::new(FlowSetup {
        mesh,
        parameters: FlowParameters {
            density: 1.0,
            viscosity: 1e-3,
            viscous_form: ViscousForm::Laplacian,
            linearisation: Linearisation::Tangent,
            scheme: TimeScheme::Bdf2,
            body_force: None,
        },
        conditions: vec![
            ("left".into(), Condition::Velocity(Arc::new(inflow))),
            ("right".into(), Condition::TractionFree),
            ("bottom".into(), Condition::NoSlip),
            ("top".into(), Condition::NoSlip),
            ("cylinder".into(), Condition::NoSlip),
        ],
        start: FlowStart::Stokes,
        motion,
        parallel: false,
    })?)
}

/// A cylinder that swings across the channel.
fn swinging(mesh: &PlanarMesh) -> Result<FlowMotion, Box<dyn Error>> {
    let cylinder = MovingBoundary { name: "cylinder".into(), pivot: [0.2, 0.2] };
    let motion = MeshMotion::new(mesh, &[cylinder], &MotionParameters::default())?;
    let swing = |t: f64| RigidMotion { translation: [0.0, 0.03 * (12.0 * t).sin()], angle: 0.0 };
    Ok(FlowMotion::Given(Box::new(PrescribedMotion::new(motion, vec![Arc::new(swing)])?)))
}

/// CPU time of this process, in s.
fn cpu() -> f64 {
    let time = clock_gettime(ClockId::ProcessCPUTime);
    time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9
}

/// Most memory that this process had, in MB.
fn peak_mb() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    Some(line.split_whitespace().nth(1)?.parse::<f64>().ok()? / 1024.0)
}
