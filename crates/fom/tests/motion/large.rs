//! How far bodies can go before cells fold.

use crate::{Outcome, disc, disc_motion};
use lumley_fem::PlanarMesh;
use lumley_fom::motion::{MeshMotion, MotionError, RigidMotion, Stiffness};

/// By distance and by cell size.
const STIFF: [Stiffness; 2] =
    [Stiffness::Distance { scale: None, power: 1.0 }, Stiffness::CellSize { power: 1.0 }];

/// The scaled Jacobian of the worst cell after `steps` steps of a motion.
fn worst(
    mesh: &PlanarMesh,
    motion: &MeshMotion,
    steps: u32,
    position: impl Fn(f64) -> RigidMotion,
) -> Result<f64, MotionError> {
    let mut moved = mesh.clone();
    for step in 1..=steps {
        motion.carry(&[position(f64::from(step))], f64::from(step), &mut moved)?;
    }
    Ok(moved.quality().scaled_jacobian.value)
}

fn up(distance: f64) -> RigidMotion {
    RigidMotion { translation: [0.0, distance], angle: 0.0 }
}

fn turn(degrees: f64) -> RigidMotion {
    RigidMotion { translation: [0.0; 2], angle: degrees.to_radians() }
}

#[test]
fn three_diameters() -> Outcome {
    let mesh = disc()?;
    for stiffness in STIFF {
        for zone in [0.0, 0.25] {
            let motion = disc_motion(&mesh, stiffness, zone)?;
            let quality = worst(&mesh, &motion, 3, up)?;
            assert!(quality > 0.6, "{stiffness:?}, zone {zone} m: {quality}");
        }
    }
    Ok(())
}

/// A share that fades with the logarithm, `log(R/r)/log(R/a)`, folds at the disc after `a log(R/a)`: 1.5 m
/// for R about 10 m.
#[test]
fn uniform_stiffness_tangles_after_three_radii() -> Outcome {
    let mesh = disc()?;
    let motion = disc_motion(&mesh, Stiffness::Uniform {}, 0.0)?;
    worst(&mesh, &motion, 13, |step| up(0.1 * step))?;
    let error = worst(&mesh, &motion, 17, |step| up(0.1 * step)).expect_err("tangled");
    let MotionError::Tangled { time, cell, quality, determinant } = error else {
        panic!("{error}")
    };
    assert!((14.0..=17.0).contains(&time), "at step {time}");
    assert!(quality < 0.1 && determinant <= 0.0, "{quality}, {determinant}");
    let [x, y] = cell.place;
    let from_disc = x.hypot(y - 0.1 * time) - 0.5;
    assert!(y > 0.0 && (-1e-3..0.1).contains(&from_disc), "ahead of the disc and at it: {cell}");
    Ok(())
}

#[test]
fn turning() -> Outcome {
    let mesh = disc()?;
    for stiffness in STIFF {
        for (zone, quarters) in [(0.25, 1), (0.0, 2)] {
            let motion = disc_motion(&mesh, stiffness, zone)?;
            let quality = worst(&mesh, &motion, quarters, |step| turn(90.0 * step))?;
            assert!(quality > 0.3, "{stiffness:?}, zone {zone} m: {quality}");
        }
    }
    Ok(())
}

/// Three diameters up while turning by half a circle.
#[test]
fn going_and_turning() -> Outcome {
    let mesh = disc()?;
    let motion = disc_motion(&mesh, Stiffness::default(), 0.0)?;
    let both = |step: f64| RigidMotion { angle: turn(60.0 * step).angle, ..up(step) };
    let quality = worst(&mesh, &motion, 3, both)?;
    assert!(quality > 0.1, "{quality}");
    Ok(())
}
