use super::archive::End;
use crate::Error;
use crate::case::{FlowCase, Start, TimeChoice};
use crate::error::OtherDomain;
use crate::model::{FlowModel, Stepping};
use lumley_fem::space::NodalSpace;
use lumley_fem::{PlanarMesh, Point};
use lumley_fom::flow::{Flow, FlowMotion, FlowSetup, FlowStart, VectorField};
use std::path::Path;
use std::sync::Arc;

/// The full-order model of `case`, at its initial state, on so many threads.
///
/// # Errors
/// What the model does not accept.
pub fn planar_flow(case: &FlowCase, threads: usize) -> Result<FlowModel, Error> {
    let bodies = case.bodies.as_ref();
    let motion = bodies.map_or(FlowMotion::Still, |choice| FlowMotion::Bodies(choice.setup()));
    let setup = FlowSetup {
        mesh: case.mesh.clone(),
        parameters: case.parameters.clone(),
        conditions: case.conditions.clone(),
        start: start(case)?,
        motion,
        parallel: threads > 1,
    };
    let flow = Flow::new(setup).map_err(Error::Flow)?;
    let time = case.march.unsteady().copied();
    Ok(FlowModel::new(flow, stepping(time)))
}

fn stepping(time: Option<TimeChoice>) -> Stepping {
    match time {
        Some(TimeChoice { step, adaptive: Some(control), .. }) => {
            Stepping::Adaptive { first: step, control }
        }
        Some(TimeChoice { step, .. }) => Stepping::Fixed { step },
        // A steady flow makes none.
        None => Stepping::Fixed { step: 1.0 },
    }
}

fn start(case: &FlowCase) -> Result<FlowStart, Error> {
    Ok(match &case.start {
        Start::Rest => FlowStart::Rest,
        Start::Stokes => FlowStart::Stokes,
        Start::Velocity(field) => FlowStart::Velocity(field.clone()),
        Start::Run(folder) => FlowStart::Velocity(end_of_run(case, folder)?),
    })
}

/// The velocity at the end of the run in `folder`, after it was found everywhere on the mesh of `case`.
fn end_of_run(case: &FlowCase, folder: &Path) -> Result<Arc<dyn VectorField>, Error> {
    let end = End::read(folder)?;
    let points = NodalSpace::velocity(case.mesh.topology()).points(&case.mesh);
    if let Some(&point) = points.iter().find(|point| end.velocity_at(**point).is_none()) {
        return Err(OtherDomain { path: folder.to_owned(), point }.into());
    }
    let nowhere = [f64::NAN; 2];
    Ok(Arc::new(move |point: Point, _: f64| end.velocity_at(point).unwrap_or(nowhere)))
}

/// How far a point may be outside of the mesh of another run, as a part of that mesh's size: the polygons of two
/// meshes on a curved wall differ by that.
pub(super) const OUTSIDE: f64 = 1e-3;

/// The longer side of the box round a mesh, in m.
pub(super) fn extent(mesh: &PlanarMesh) -> f64 {
    let side = |d: usize| {
        let along = mesh.nodes().iter().map(|node| node[d]);
        along.clone().fold(f64::NEG_INFINITY, f64::max) - along.fold(f64::INFINITY, f64::min)
    };
    side(0).max(side(1))
}
