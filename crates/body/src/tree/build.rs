use super::skeleton::{Link, OwnTurn, Skeleton, Support};
use super::{Coordinate, Tree, TreeError, check, order};
use crate::joint::{Layout, Spring, TimeFunction, Turning};
use crate::planar::times;
use crate::{BodyState, Point, RigidBody};
use std::sync::Arc;

/// A coordinate that a function of time prescribes.
#[derive(Debug, Clone)]
pub(crate) struct Driven {
    pub coordinate: usize,
    pub function: TimeFunction,
}

/// The tree, as far as it is built.
struct Builder<'a> {
    bodies: &'a [RigidBody],
    layouts: Vec<Layout<'a>>,
    parents: Vec<Option<usize>>,
    coordinates: Vec<Coordinate>,
    /// Number of the first coordinate of each body's joint.
    firsts: Vec<usize>,
    springs: Vec<Support>,
    driven: Vec<Driven>,
    start: BodyState,
}

pub(super) fn build(bodies: &[RigidBody], gravity: Point) -> Result<Tree, TreeError> {
    if bodies.is_empty() {
        return Err(TreeError::Empty);
    }
    if !gravity.iter().all(|g| g.is_finite()) {
        return Err(TreeError::Gravity(gravity));
    }
    check::names(bodies)?;
    let layouts: Vec<Layout<'_>> = bodies.iter().map(|body| body.joint.layout()).collect();
    let mut checks = bodies.iter().zip(&layouts);
    checks.try_for_each(|(body, layout)| check::quantities(body, layout))?;
    let parents = order::parents(bodies, &layouts)?;
    let order = order::order(bodies, &parents)?;
    let mut builder = Builder {
        bodies,
        layouts,
        parents,
        coordinates: Vec::new(),
        firsts: Vec::new(),
        springs: Vec::new(),
        driven: Vec::new(),
        start: BodyState::default(),
    };
    (0..bodies.len()).try_for_each(|body| builder.add_coordinates(body))?;
    let links = builder.links(&order)?;
    let coordinates = builder.coordinates.len();
    let springs = builder.springs;
    let skeleton = Skeleton { links, order, coordinates, gravity, springs };
    Ok(Tree {
        skeleton: Arc::new(skeleton),
        bodies: bodies.to_vec(),
        coordinates: builder.coordinates,
        driven: builder.driven,
        start: builder.start,
    })
}

impl Builder<'_> {
    /// The coordinates of a body's joint, with their springs, drives and start.
    fn add_coordinates(&mut self, body: usize) -> Result<(), TreeError> {
        let first = self.coordinates.len();
        self.firsts.push(first);
        let mut add = |name, position, spring: Option<Spring>, against| {
            let coordinate = self.coordinates.len();
            self.springs.extend(spring.map(|spring| Support { coordinate, against, spring }));
            let prescribed = !self.layouts[body].drives.is_empty();
            self.coordinates.push(Coordinate { body, name, prescribed });
            self.start.position.push(position);
            self.start.velocity.push(0.0);
        };
        for slide in &self.layouts[body].slides {
            add(slide.name, 0.0, slide.spring, None);
        }
        match self.layouts[body].turn {
            Turning::With => {}
            Turning::Free(spring) => {
                add("angle", self.bodies[body].angle, spring, self.parents[body]);
            }
            Turning::Beyond => add("angle", 0.0, None, None),
        }
        self.add_drives(body, first)?;
        self.set_start(body, first)
    }

    fn add_drives(&mut self, body: usize, first: usize) -> Result<(), TreeError> {
        for (coordinate, drive) in (first..).zip(&self.layouts[body].drives) {
            let function = drive.function().map_err(|formula| TreeError::Formula {
                body: self.bodies[body].name.clone(),
                coordinate: self.coordinates[coordinate].name,
                formula: formula.to_owned(),
            })?;
            self.driven.push(Driven { coordinate, function });
        }
        Ok(())
    }

    fn set_start(&mut self, body: usize, first: usize) -> Result<(), TreeError> {
        let RigidBody { name, start, .. } = &self.bodies[body];
        let prescribed = self.layouts[body].drives.len();
        let expected = self.coordinates.len() - first - prescribed;
        for (what, unit, given, own) in [
            ("positions", "m or rad", &start.position, &mut self.start.position),
            ("velocities", "m/s or rad/s", &start.velocity, &mut self.start.velocity),
        ] {
            if given.is_empty() {
                continue;
            }
            if given.len() != expected {
                let found = given.len();
                return Err(TreeError::Start { body: name.clone(), what, expected, found });
            }
            if let Some(&value) = given.iter().find(|value| !value.is_finite()) {
                return Err(TreeError::Quantity {
                    body: name.clone(),
                    what: format!("one of the {what} of its start"),
                    value,
                    unit,
                    expected: "a finite number",
                });
            }
            own[first..].copy_from_slice(given);
        }
        Ok(())
    }

    /// The bodies with what carries them, in the order in which they were given.
    fn links(&self, order: &[usize]) -> Result<Vec<Link>, TreeError> {
        let mut links: Vec<Option<Link>> = self.bodies.iter().map(|_| None).collect();
        for &body in order {
            let parent = self.parents[body].and_then(|parent| links[parent].as_ref());
            links[body] = Some(self.link(body, parent)?);
        }
        Ok(links.into_iter().map(|link| link.expect("every body is in the order")).collect())
    }

    fn link(&self, body: usize, parent: Option<&Link>) -> Result<Link, TreeError> {
        let (given, layout) = (&self.bodies[body], &self.layouts[body]);
        let first = self.firsts[body];
        let slides: Vec<Point> = layout.slides.iter().map(|slide| unit(slide.direction)).collect();
        let mut path = parent.map_or(Vec::new(), |parent| parent.path.clone());
        let mut turns = parent.map_or(Vec::new(), |parent| parent.turns.clone());
        path.extend(first..first + slides.len());
        turns.resize(path.len(), 0.0);
        let beyond = matches!(layout.turn, Turning::Beyond);
        let own = !matches!(layout.turn, Turning::With);
        let turn = own.then_some(OwnTurn { coordinate: first + slides.len(), beyond });
        if let Some(turn) = turn {
            if !turn.beyond {
                turns.fill(0.0);
            }
            path.push(turn.coordinate);
            turns.push(1.0);
        }
        let free = |k: &usize| !self.coordinates[*k].prescribed;
        let moves = path.iter().any(free);
        let turned = path.iter().zip(&turns).any(|(k, turn)| *turn != 0.0 && free(k));
        let (mass, inertia) = check::inertia(given, moves, turned)?;
        Ok(Link {
            parent: self.parents[body],
            pivot: layout.at.unwrap_or(given.centre),
            centre: given.centre,
            angle: given.angle,
            mass,
            inertia,
            displaced: given.displaced,
            path,
            turns,
            slides,
            turn,
        })
    }
}

fn unit([x, y]: Point) -> Point {
    times(1.0 / x.hypot(y), [x, y])
}
