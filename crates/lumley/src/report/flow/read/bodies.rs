//! `bodies.csv`: `time`, for each coordinate its label, `bar.angle`, and `bar.angle'`, its velocity, and behind them
//! for each body the place of its centre of mass and its angle.

use super::case::CaseView;
use super::numbers::Numbers;
use crate::Error;
use crate::format::csv::read_columns;
use crate::report::{BodiesReport, BodyMotion, CoordinateMotion};
use lumley_body::RigidBody;
use std::path::Path;

/// A header and the numbers below it.
type Column = (String, Vec<f64>);

/// The label of a coordinate, its values and its velocities.
type Coordinate = (String, Vec<f64>, Vec<f64>);

/// What is behind the label of a coordinate in the header of its velocity.
const RATE: char = '\'';

/// The bodies of the run in `folder`, none without bodies in its case; those that move without a table stay.
pub(super) fn read(
    folder: &Path,
    case: &CaseView,
    numbers: &Numbers,
) -> Result<BodiesReport, Error> {
    let path = folder.join("bodies.csv");
    let columns = if path.exists() { read_columns(&path, |_| true)? } else { Vec::new() };
    let mut columns = columns.into_iter();
    let times = columns.next().map(|(_, times)| times).unwrap_or_default();
    let (coordinates, places) = split(columns.collect());
    let mut places = places.chunks(3);
    let bodies = case.bodies.iter().map(|setup| BodyMotion {
        track: places.next().map(|place| track(setup, place)).unwrap_or_default(),
        coordinates: of_body(setup, &coordinates, numbers),
        numbers: numbers.of_body(&setup.name),
        setup: setup.clone(),
    });
    let labels: Vec<&str> = coordinates.iter().map(|(label, ..)| label.as_str()).collect();
    Ok(BodiesReport {
        gravity: case.motion.gravity,
        times,
        bodies: bodies.collect(),
        instants: numbers.instants(case.instants(), &labels),
    })
}

/// The coordinates, and the columns behind them.
fn split(columns: Vec<Column>) -> (Vec<Coordinate>, Vec<Column>) {
    let mut coordinates = Vec::new();
    let mut columns = columns.into_iter().peekable();
    let mut places = Vec::new();
    while let Some((label, position)) = columns.next() {
        let rate = columns.next_if(|(next, _)| next.strip_suffix(RATE) == Some(&label));
        match rate {
            Some((_, velocity)) => coordinates.push((label, position, velocity)),
            None => places.push((label, position)),
        }
    }
    (coordinates, places)
}

/// The coordinates of the joint of a body.
fn of_body(
    setup: &RigidBody,
    coordinates: &[Coordinate],
    numbers: &Numbers,
) -> Vec<CoordinateMotion> {
    // Separators cannot stand in a header.
    let name = setup.name.replace([',', '"', '\n', '\r'], "_");
    let of_it = coordinates.iter().filter_map(|(label, position, velocity)| {
        let (body, coordinate) = label.rsplit_once('.')?;
        (body == name).then(|| CoordinateMotion {
            name: coordinate.to_owned(),
            position: position.clone(),
            velocity: velocity.clone(),
            numbers: numbers.of_coordinate(&setup.name, coordinate),
        })
    });
    of_it.collect()
}

/// Displacements of the centre and turns, from the columns of x, y and the angle.
fn track(setup: &RigidBody, place: &[Column]) -> Vec<[f64; 3]> {
    let [(_, x), (_, y), (_, angle)] = place else { return Vec::new() };
    let [x0, y0] = setup.centre;
    let rows = x.iter().zip(y).zip(angle);
    rows.map(|((x, y), angle)| [x - x0, y - y0, angle - setup.angle]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn velocities_tell_coordinates_from_places() {
        let headers = ["a.x", "a.x'", "a.y", "a.y'", "a.centre_x", "a.centre_y", "a.orientation"];
        let columns = (0..).zip(headers).map(|(k, h)| (h.to_string(), vec![f64::from(k)]));
        let (coordinates, places) = split(columns.collect());
        assert_eq!(coordinates[1], ("a.y".into(), vec![2.0], vec![3.0]));
        assert_eq!(places.iter().map(|p| p.1[0]).collect::<Vec<_>>(), [4.0, 5.0, 6.0]);
    }
}
