use crate::case::CaseError;
use crate::case::ask::Ask;
use crate::case::flow::boundaries::stray;
use crate::case::flow::{BoundaryKind, FlowFile};
use lumley_body::RigidBody;
use lumley_fem::PlanarMesh;
use lumley_fem::transfer::{Bodies, BodyError};

/// Whether the boundary of each body is the outline of a hole in the mesh, to which the fluid sticks.
pub(super) fn check(ask: &Ask, file: &FlowFile, mesh: &PlanarMesh) -> Result<(), CaseError> {
    if file.bodies.iter().all(|body| body.boundary.is_none()) {
        let key = format!("bodies.{}.boundary", file.bodies[0].name);
        let expected = "the name of a boundary of the mesh: no body has one, so that the flow would not feel them";
        return Err(ask.missing(&key, expected));
    }
    file.bodies.iter().try_for_each(|body| check_body(ask, file, mesh, body))
}

fn check_body(
    ask: &Ask,
    file: &FlowFile,
    mesh: &PlanarMesh,
    body: &RigidBody,
) -> Result<(), CaseError> {
    let Some(boundary) = &body.boundary else { return Ok(()) };
    let key = format!("bodies.{}.boundary", body.name);
    if let Some(expected) = stray(boundary, mesh) {
        let made = "; [[mesh.bodies]] makes one round a body";
        let made = if file.mesh.size.is_some() { made } else { "" };
        return Err(ask.refuse(&key, boundary, &format!("{expected}{made}")));
    }
    Bodies::new(mesh, &[boundary])
        .map_err(|error| ask.refuse(&key, boundary, &no_body(mesh, &error)))?;
    let kind = file.flow.boundaries.get(boundary).map(|section| section.kind);
    let expected = format!(
        "\"no-slip\": it is the boundary of the body {}, and the fluid at it has the body's velocity",
        body.name
    );
    let ok = kind.is_none_or(|kind| kind == BoundaryKind::NoSlip);
    ask.that(ok, &format!("flow.boundaries.{boundary}.kind"), "another", &expected)
}

/// What is expected instead of a boundary that is no body's.
fn no_body(mesh: &PlanarMesh, error: &BodyError) -> String {
    match error {
        BodyError::Open { node, .. } => {
            let [x, y] = mesh.nodes()[*node];
            format!(
                "the closed outline of a body; it ends at ({x:?}, {y:?}) m, where another boundary begins"
            )
        }
        BodyError::RoundTheFluid(_) => {
            "the outline of a body in the flow; this one goes round the flow".into()
        }
        other => other.to_string(),
    }
}
