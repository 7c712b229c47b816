//! The energy of the bodies over time.

use super::super::FlowReport;
use super::super::rings::{Ring, rings};
use crate::report::figure::{Axis, Figure, LineChart, Series};
use crate::report::html::spread;
use lumley_body::{Displaced, Energy, Kinematics, RigidBody, Tree};

/// Most times at which it is computed.
const TIMES: usize = 2000;

/// Energy of the bodies where the fluid moves all of them and they have any.
pub(super) fn figure(report: &FlowReport) -> Option<Figure> {
    let tree = tree(report)?;
    let (times, energies) = energies(report, &tree)?;
    let of = |part: fn(&Energy) -> f64| energies.iter().map(part).collect::<Vec<f64>>();
    let parts = [
        ("motion", of(|energy| energy.kinetic)),
        ("springs", of(|energy| energy.elastic)),
        ("weight", of(|energy| energy.weight)),
    ];
    let parts = parts.iter().enumerate().filter(|(_, (_, e))| e.iter().any(|e| *e != 0.0));
    let parts: Vec<_> = parts.collect();
    let chart = LineChart::new(Axis::new("time *t*", "s"), Axis::new("energy", "J/m"))
        .series(Series::reference("all", &times, &of(Energy::total)));
    let chart = parts.iter().fold(chart, |chart, (k, (name, energy))| {
        chart.series(Series::line(name, &times, energy).colour(*k))
    });
    let caption = "Energy of the bodies. What all of it gains is the work of the fluid less what dampers take.";
    (!parts.is_empty()).then(|| chart.draw(230.0).figure("energy", caption))
}

/// The bodies with their joints; none where a motion is prescribed, which has what energy it needs.
fn tree(report: &FlowReport) -> Option<Tree> {
    let bodies: Vec<RigidBody> = report.bodies.bodies.iter().map(|b| b.setup.clone()).collect();
    let displaced = |body: RigidBody| RigidBody { displaced: displaced(report, &body), ..body };
    let bodies: Vec<RigidBody> = bodies.into_iter().map(displaced).collect();
    let tree = Tree::new(&bodies, report.bodies.gravity).ok()?;
    (!tree.coordinates().iter().any(|coordinate| coordinate.prescribed)).then_some(tree)
}

/// The fluid that a body displaces, from its outline in the mesh.
fn displaced(report: &FlowReport, body: &RigidBody) -> Option<Displaced> {
    let (mesh, wet) = (report.scene.mesh.as_ref()?, body.boundary.as_ref()?);
    let boundaries = mesh.topology().boundaries();
    let is_it = |ring: &Ring| ring.boundaries.iter().any(|&k| boundaries[k].name == *wet);
    let ring = rings(mesh).into_iter().find(|ring| ring.is_body() && is_it(ring))?;
    let mass = -ring.area() * report.settings.density;
    Some(Displaced { mass, centre: ring.centroid() })
}

/// Times and energies.
fn energies(report: &FlowReport, tree: &Tree) -> Option<(Vec<f64>, Vec<Energy>)> {
    let coordinates: Vec<_> = report.bodies.bodies.iter().flat_map(|b| &b.coordinates).collect();
    let rows = coordinates.iter().map(|c| c.position.len().min(c.velocity.len())).min()?;
    let rows = rows.min(report.bodies.times.len());
    if rows < 2 || coordinates.len() != tree.coordinates().len() {
        return None;
    }
    let mut kinematics = Kinematics::new(tree);
    let zeros = vec![0.0; coordinates.len()];
    let mut at = |k: &usize| {
        let position: Vec<f64> = coordinates.iter().map(|c| c.position[*k]).collect();
        let velocity: Vec<f64> = coordinates.iter().map(|c| c.velocity[*k]).collect();
        kinematics.update(&position, &velocity, &zeros);
        Energy::of(&kinematics)
    };
    let taken = spread(rows, TIMES);
    let energies = taken.iter().map(&mut at).collect();
    Some((taken.iter().map(|&k| report.bodies.times[k]).collect(), energies))
}
