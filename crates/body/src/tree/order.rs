use super::TreeError;
use crate::RigidBody;
use crate::joint::Layout;

/// The body that holds each body; none for the ground.
pub(super) fn parents(
    bodies: &[RigidBody],
    layouts: &[Layout<'_>],
) -> Result<Vec<Option<usize>>, TreeError> {
    let find = |(body, layout): (&RigidBody, &Layout<'_>)| {
        let Some(to) = layout.to else { return Ok(None) };
        let found = bodies.iter().position(|other| other.name == to);
        found.map(Some).ok_or_else(|| {
            let others = bodies.iter().filter(|other| other.name != body.name);
            TreeError::Unknown {
                body: body.name.clone(),
                to: to.to_owned(),
                others: others.map(|other| other.name.clone()).collect(),
            }
        })
    };
    bodies.iter().zip(layouts).map(find).collect()
}

/// The bodies so that each comes after its parent.
pub(super) fn order(
    bodies: &[RigidBody],
    parents: &[Option<usize>],
) -> Result<Vec<usize>, TreeError> {
    let mut order: Vec<usize> = Vec::with_capacity(parents.len());
    let mut placed = vec![false; parents.len()];
    while order.len() < parents.len() {
        let before = order.len();
        for body in 0..parents.len() {
            if !placed[body] && parents[body].is_none_or(|parent| placed[parent]) {
                placed[body] = true;
                order.push(body);
            }
        }
        if order.len() == before {
            return Err(TreeError::Loop(a_loop(bodies, parents, &placed)));
        }
    }
    Ok(order)
}

/// The names along a loop from its first body on, which is named once more at the end.
fn a_loop(bodies: &[RigidBody], parents: &[Option<usize>], placed: &[bool]) -> Vec<String> {
    let step = |body: &usize| parents[*body];
    let start = placed.iter().position(|&done| !done);
    // After as many steps as there are bodies the walk is in the loop.
    let walk = std::iter::successors(start, step).skip(bodies.len());
    let first = walk.take(bodies.len()).min();
    let rest = std::iter::successors(first, step).skip(1).take_while(|&body| Some(body) != first);
    let closed = first.into_iter().chain(rest).chain(first);
    closed.map(|body| bodies[body].name.clone()).collect()
}
