use crate::joint::Spring;
use crate::{Displaced, Kinematics, Point};

/// What does not change as the bodies move. Points and directions are those of the placement as given.
#[derive(Debug)]
pub(crate) struct Skeleton {
    /// In the order in which the bodies were given.
    pub links: Vec<Link>,
    /// The links so that each comes after the one that holds it.
    pub order: Vec<usize>,
    pub coordinates: usize,
    pub gravity: Point,
    pub springs: Vec<Support>,
}

/// A body with the joint that holds it.
#[derive(Debug)]
pub(crate) struct Link {
    pub parent: Option<usize>,
    pub pivot: Point,
    pub centre: Point,
    pub angle: f64,
    pub mass: f64,
    pub inertia: f64,
    pub displaced: Option<Displaced>,
    /// Coordinates that move the body: those that move its parent, its slides, its turn.
    pub path: Vec<usize>,
    /// The turn of the body by each of them: 0 or 1.
    pub turns: Vec<f64>,
    /// Directions of its slides, in the parent.
    pub slides: Vec<Point>,
    pub turn: Option<OwnTurn>,
}

/// The coordinate by which a body turns.
#[derive(Debug, Clone, Copy)]
pub(crate) struct OwnTurn {
    pub coordinate: usize,
    /// Whether the turn is against the parent.
    pub beyond: bool,
}

/// A spring and damper on a coordinate, for an angle measured against a body.
#[derive(Debug)]
pub(crate) struct Support {
    pub coordinate: usize,
    pub against: Option<usize>,
    pub spring: Spring,
}

impl Skeleton {
    /// How the elongation of a spring depends on the coordinates: each coordinate with its factor.
    pub fn elongation<'a>(
        &'a self,
        support: &'a Support,
    ) -> impl Iterator<Item = (usize, f64)> + Clone + 'a {
        let against = support.against.map(|body| &self.links[body]);
        let turns = against.into_iter().flat_map(|link| link.path.iter().zip(&link.turns));
        std::iter::once((support.coordinate, 1.0))
            .chain(turns.filter(|(_, turn)| **turn != 0.0).map(|(&k, turn)| (k, -turn)))
    }
}

impl Support {
    /// What the spring's rest value is compared with, in m or rad.
    pub fn length(&self, kinematics: &Kinematics) -> f64 {
        let against = self.against.map_or(0.0, |body| kinematics.angle(body));
        kinematics.position[self.coordinate] - against
    }
}
