//! Which boundaries belong together, and whether what comes in can go out.

use super::raw::FlowFile;
use crate::case::CaseError;
use crate::case::ask::Ask;
use crate::case::suggest::nearest;
use lumley_fem::PlanarMesh;
use lumley_fom::flow::Condition;

/// How far, relative to their length, two periodic boundaries may differ in it.
const SAME_LENGTH: f64 = 1e-9;
/// Largest net flux, relative to all that flows in and out, of a domain without an outlet.
const BALANCED: f64 = 1e-4;

/// Whether periodic boundaries name each other and have the same length and number of edges.
pub(super) fn check(ask: &Ask, file: &FlowFile, mesh: &PlanarMesh) -> Result<(), CaseError> {
    let boundaries = mesh.topology().boundaries();
    let with = |name: &str| file.flow.boundaries.get(name).and_then(|b| b.with.as_deref());
    for boundary in boundaries {
        let Some(other) = with(&boundary.name) else { continue };
        let key = format!("flow.boundaries.{}.with", boundary.name);
        let refuse = |expected: &str| Err(ask.refuse(&key, other, expected));
        if other == boundary.name {
            return refuse("another boundary: none is periodic with itself");
        }
        let Some(partner) = boundaries.iter().find(|b| b.name == other) else {
            let known: Vec<&str> = boundaries.iter().map(|b| b.name.as_str()).collect();
            let hint = nearest(other, &known).map_or(String::new(), |w| format!(", such as {w}"));
            return refuse(&format!("a boundary of the mesh{hint}"));
        };
        if with(other) != Some(&boundary.name) {
            let name = &boundary.name;
            return refuse(&format!("a boundary that is periodic with = \"{name}\" in turn"));
        }
        let [own, its] = [boundary, partner].map(|b| mesh.boundary_length(b));
        if (own - its).abs() > SAME_LENGTH * own {
            return refuse(&format!(
                "a boundary of the same length: {own:.10} m here, {its:.10} m there"
            ));
        }
        let [own, its] = [boundary, partner].map(|b| b.edges.len());
        if own != its {
            return refuse(&format!("a boundary of as many edges: {own} here, {its} there"));
        }
    }
    Ok(())
}

/// A domain without an outlet must let out what it lets in, at each of these times in s.
pub(super) fn check_balance(
    ask: &Ask,
    mesh: &PlanarMesh,
    conditions: &[(String, Condition)],
    times: &[f64],
) -> Result<(), CaseError> {
    if conditions.iter().any(|(_, condition)| matches!(condition, Condition::TractionFree)) {
        return Ok(());
    }
    for &time in times {
        let flux = |absolute: bool| outflow(mesh, conditions, time, absolute);
        let (net, whole) = (flux(false), flux(true));
        if net.abs() > BALANCED * whole {
            let out = if net > 0.0 { "out" } else { "in" };
            let expected = format!(
                "a boundary with kind = \"traction-free\", an outlet: at t = {time:?} s the velocities let \
                 {:.6} m²/s more {out} than {}",
                net.abs(),
                if net > 0.0 { "in" } else { "out" }
            );
            return Err(ask.refuse("flow.boundaries", "without an outlet", &expected));
        }
    }
    Ok(())
}

/// What the given velocities let out, by Simpson's rule on each edge, in m²/s; with `absolute` what flows either
/// way.
fn outflow(
    mesh: &PlanarMesh,
    conditions: &[(String, Condition)],
    time: f64,
    absolute: bool,
) -> f64 {
    let mut sum = 0.0;
    for (boundary, (_, condition)) in mesh.topology().boundaries().iter().zip(conditions) {
        let Condition::Velocity(field) = condition else { continue };
        for [a, b, middle] in boundary.edges.iter().map(|&edge| mesh.edge(edge)) {
            // The tangents of the quadratic edge at its start, middle and end.
            let slope = |weights: [f64; 3]| {
                [0, 1].map(|d| weights[0] * a[d] + weights[1] * b[d] + weights[2] * middle[d])
            };
            for (at, slope, weight) in [
                (a, slope([-3.0, -1.0, 4.0]), 1.0 / 6.0),
                (middle, slope([-1.0, 1.0, 0.0]), 4.0 / 6.0),
                (b, slope([1.0, 3.0, -4.0]), 1.0 / 6.0),
            ] {
                let [u, v] = field.value(at, time);
                let out = weight * (u * slope[1] - v * slope[0]);
                sum += if absolute { out.abs() } else { out };
            }
        }
    }
    sum
}
