//! The motion of meshes: exact solutions, large motions, bad input.

mod bad_input;
#[path = "../../../fem/tests/counting/mod.rs"]
mod counting;
mod exact;
mod large;
mod ring;

use lumley_fem::generate::Channel;
use lumley_fem::{PlanarMesh, Point};
use lumley_fom::motion::{MeshMotion, MotionError, MotionParameters, MovingBoundary, Stiffness};

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// A disc of diameter 1 m with four rows of quadrilaterals round it, in 30 m x 20 m.
fn disc() -> Result<PlanarMesh, Box<dyn std::error::Error>> {
    let channel: Channel = toml::from_str(
        "x = [-10, 20]\ny = [-10, 10]\nsize = 1.2
         [[bodies]]\nname = 'disc'\nsize = 0.17
         shape = { kind = 'disc', centre = [0, 0], radius = 0.5 }
         layers = { first = 0.04, growth = 1.3, count = 4 }",
    )?;
    Ok(PlanarMesh::new(channel.mesh()?)?)
}

fn moving(name: &str, pivot: Point) -> MovingBoundary {
    MovingBoundary { name: name.into(), pivot }
}

/// The motion of a mesh with the boundary `disc` about the origin.
fn disc_motion(
    mesh: &PlanarMesh,
    stiffness: Stiffness,
    rigid_zone: f64,
) -> Result<MeshMotion, MotionError> {
    let parameters = MotionParameters { stiffness, rigid_zone };
    MeshMotion::new(mesh, &[moving("disc", [0.0; 2])], &parameters)
}
