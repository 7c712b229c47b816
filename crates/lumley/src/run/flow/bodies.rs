//! The bodies in a flow: their table `bodies.csv`, and what the summary says of it.

use super::columns::Columns;
use super::instruments::{LOADS, column};
use crate::Error;
use crate::case::{BodiesChoice, BodyProbes};
use crate::model::FlowModel;
use crate::summary::{BodyMotion, CoordinateMotion, FlowProbe, Oscillation, Probe, RigidState};
use lumley_body::{ImplicitScheme, Tree};
use lumley_fom::signal::{Periods, Signal};
use std::collections::BTreeMap;
use std::path::Path;

/// Name of the table.
pub(super) const BODIES: &str = "bodies.csv";
/// Columns of a body's centre of mass, in m, and of its angle, in rad.
const CENTRE: [&str; 2] = ["centre_x", "centre_y"];
const ANGLE: &str = "orientation";

/// The columns of the table, time first.
pub(super) fn headers(tree: &Tree) -> Vec<String> {
    let labels = (0..tree.coordinates().len()).map(|k| tree.label(k));
    let coordinates = labels.flat_map(|label| [label.clone(), format!("{label}'")]);
    let of = |name: &str| [CENTRE[0], CENTRE[1], ANGLE].map(|quantity| column(name, quantity));
    let bodies = tree.bodies().iter().flat_map(|body| of(&body.name));
    std::iter::once("time".into()).chain(coordinates).chain(bodies).collect()
}

/// Appends coordinates and velocities, then where each body is.
pub(super) fn measure(bodies: &ImplicitScheme, row: &mut Vec<f64>) {
    let pairs = bodies.position().iter().zip(bodies.velocity());
    row.extend(pairs.flat_map(|(position, velocity)| [*position, *velocity]));
    let kinematics = bodies.kinematics();
    for body in 0..bodies.tree().bodies().len() {
        let [x, y] = kinematics.centre(body);
        row.extend([x, y, kinematics.angle(body)]);
    }
}

/// How the bodies moved, from their table in `folder`, and where they are now.
pub(super) fn motions(
    model: &FlowModel,
    folder: &Path,
) -> Result<BTreeMap<String, BodyMotion>, Error> {
    let Some(bodies) = model.flow().bodies() else { return Ok(BTreeMap::new()) };
    let table = Columns::read(folder.join(BODIES))?;
    let names = bodies.tree().bodies().iter().map(|body| &body.name).enumerate();
    let time = crate::model::Model::time(model);
    let motion = |(body, name): (usize, &String)| {
        let [x, y] = CENTRE.map(|quantity| table.signal(&column(name, quantity)));
        let (x, y) = (oscillation(&x?), oscillation(&y?));
        // A drift may go further than an oscillation, but this is the motion.
        let size = |motion: &Oscillation| (motion.periods > 0, motion.amplitude);
        let (direction, motion) = if size(&x) > size(&y) { ("x", x) } else { ("y", y) };
        let (direction, state) = (direction.to_owned(), state(bodies, body, time));
        let coordinates = coordinates(bodies, body, &table)?;
        Ok((name.clone(), BodyMotion { direction, motion, state, coordinates }))
    };
    names.map(motion).collect()
}

fn state(bodies: &ImplicitScheme, body: usize, time: f64) -> RigidState {
    let kinematics = bodies.kinematics();
    RigidState {
        time,
        centre: kinematics.centre(body),
        angle: kinematics.angle(body),
        velocity: kinematics.velocity(body, bodies.tree().bodies()[body].centre),
        spin: kinematics.spin(body),
    }
}

/// Those of a body's joint.
fn coordinates(
    bodies: &ImplicitScheme,
    body: usize,
    table: &Columns,
) -> Result<BTreeMap<String, CoordinateMotion>, Error> {
    let tree = bodies.tree();
    let own = tree.coordinates().iter().enumerate().filter(|(_, found)| found.body == body);
    let motion = |(k, _)| {
        let label = tree.label(k);
        let Oscillation { amplitude, frequency, .. } = oscillation(&table.signal(&label)?);
        let (position, velocity) = (bodies.position()[k], bodies.velocity()[k]);
        Ok((label, CoordinateMotion { position, velocity, amplitude, frequency }))
    };
    own.map(motion).collect()
}

/// Over the last full periods, or, where there are none, over the later half.
fn oscillation(signal: &Signal<'_>) -> Oscillation {
    let periods = Periods::of(signal);
    let window = periods.window().unwrap_or(signal.last_half());
    let statistics = signal.statistics(window);
    let lengths = periods.instants().windows(2).map(|pair| pair[1] - pair[0]);
    Oscillation {
        amplitude: statistics.amplitude(),
        frequency: periods.frequency(),
        mean: statistics.mean,
        periods: periods.count(),
        window: [window.start, window.end],
        amplitudes: periods.amplitudes(signal),
        frequencies: lengths.map(f64::recip).collect(),
    }
}

/// The probes that a case asks for, from the tables of bodies and loads in `folder`; a load before its first row is
/// that of this row, and without any row there are no probes.
pub(super) fn probes(choice: Option<&BodiesChoice>, folder: &Path) -> Result<Vec<Probe>, Error> {
    let Some(BodiesChoice { tree, probes: Some(asked), .. }) = choice else {
        return Ok(Vec::new());
    };
    let bodies = Columns::read(folder.join(BODIES))?;
    let loads = Columns::read(folder.join(LOADS))?;
    if loads.is_empty() {
        return Ok(Vec::new());
    }
    let BodyProbes { times, body, coordinates } = asked;
    let boundary = tree.bodies()[*body].boundary.as_ref().expect("a probe is of a wet body");
    let load = |quantity| loads.signal(&column(boundary, quantity));
    let (fx, fy, moment) = (load("fx")?, load("fy")?, load("moment")?);
    let mut signals = Vec::new();
    for (name, k) in coordinates {
        signals.push((name, bodies.signal(&tree.label(*k))?));
    }
    let probe = |&time: &f64| FlowProbe {
        time,
        coordinates: signals.iter().map(|(name, q)| ((*name).clone(), q.at(time))).collect(),
        fx: fx.at(time),
        fy: fy.at(time),
        mg: moment.at(time),
    };
    Ok(times.iter().map(probe).map(Probe::Flow).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// An oscillation that grows to its limit: the lists show how, the amplitude is of the last ten periods.
    #[test]
    fn an_oscillation_shows_its_convergence() -> Result<(), Box<dyn std::error::Error>> {
        let times: Vec<f64> = (0..=6000).map(|k| 0.01 * f64::from(k)).collect();
        let values: Vec<f64> = times
            .iter()
            .map(|t| 3.0 + 0.4 * (1.0 - (-t / 5.0).exp()) * (TAU * 0.5 * t).sin())
            .collect();
        let found = oscillation(&Signal::new(&times, &values)?);
        assert_eq!((found.periods, found.amplitudes.len(), found.frequencies.len()), (10, 10, 10));
        assert!((found.amplitude - 0.4).abs() < 2e-4, "{}", found.amplitude);
        assert!((found.mean - 3.0).abs() < 1e-4, "{}", found.mean);
        assert!((found.frequency.ok_or("ten periods")? - 0.5).abs() < 1e-4);
        assert!(
            found.amplitudes.is_sorted()
                && found.frequencies.iter().all(|f| (f - 0.5).abs() < 1e-3)
        );
        Ok(())
    }

    #[test]
    fn what_does_not_oscillate_has_no_frequency() -> Result<(), Box<dyn std::error::Error>> {
        let found = oscillation(&Signal::new(&[0.0, 1.0, 2.0, 4.0], &[0.0, -1.0, -2.0, -4.0])?);
        assert_eq!((found.periods, found.frequency), (0, None));
        assert_eq!((found.window, found.amplitude, found.mean), ([2.0, 4.0], 1.0, -3.0));
        assert!(found.amplitudes.is_empty() && found.frequencies.is_empty());
        Ok(())
    }
}
