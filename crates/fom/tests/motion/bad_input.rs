//! What cannot be meant is refused with its name and its value.

use crate::{Outcome, disc, disc_motion, moving};
use lumley_fem::generate::Channel;
use lumley_fem::{MeshDescription, MeshError, PlanarMesh};
use lumley_fom::motion::{
    MeshMotion, Motion, MotionError, MotionParameters, PrescribedMotion, RigidMotion, Stiffness,
};
use std::sync::Arc;

#[test]
fn parameters_out_of_range() -> Outcome {
    let mesh = disc()?;
    let (distance, sound) =
        (|scale, power| Stiffness::Distance { scale, power }, Stiffness::default());
    for (stiffness, zone, what) in [
        (distance(None, f64::NAN), 0.0, "power of the stiffness is NaN"),
        (distance(None, -1.0), 0.0, "power of the stiffness is -1"),
        (Stiffness::CellSize { power: 11.0 }, 0.0, "power of the stiffness is 11"),
        (distance(Some(0.0), 1.0), 0.0, "scale of the stiffness is 0 m"),
        (distance(Some(f64::INFINITY), 1.0), 0.0, "scale of the stiffness is inf m"),
        (sound, -0.1, "rigid zone is -0.1 m"),
        (sound, f64::NAN, "rigid zone is NaN m"),
    ] {
        let error = disc_motion(&mesh, stiffness, zone).expect_err(what).to_string();
        assert!(error.contains(what), "{error}");
    }
    Ok(())
}

#[test]
fn boundaries_that_cannot_move() -> Outcome {
    let (mesh, parameters) = (disc()?, MotionParameters::default());
    let error = |moving: &[_]| {
        MeshMotion::new(&mesh, moving, &parameters).expect_err("refused").to_string()
    };
    let (disc, at) = (moving("disc", [0.0; 2]), [0.0; 2]);
    assert!(error(&[]).contains("no boundary moves"));
    let unknown = error(&[moving("disk", at)]);
    assert!(unknown.contains("\"disk\"") && unknown.contains("top, disc"), "{unknown}");
    assert!(error(&[disc.clone(), disc]).contains("\"disc\" is named twice"));
    let lost = error(&[moving("disc", [0.0, f64::NAN])]);
    assert!(lost.contains("pivot of boundary \"disc\" is NaN m"), "{lost}");
    let touching = error(&[moving("top", at)]);
    assert!(touching.contains("on boundary \"left\" and on boundary \"top\""), "{touching}");
    Ok(())
}

/// The largest zone that the error names fits, and a little more does not.
fn check_largest(mesh: &PlanarMesh, bodies: &[&str], zone: f64, expected: [&str; 2]) -> Outcome {
    let moving: Vec<_> = bodies.iter().map(|name| moving(name, [0.0; 2])).collect();
    let new = |rigid_zone: f64| {
        let parameters = MotionParameters { rigid_zone, ..MotionParameters::default() };
        MeshMotion::new(mesh, &moving, &parameters)
    };
    let error = new(zone).expect_err("too wide");
    let MotionError::ZoneReaches { boundary, other, largest, .. } = &error else {
        panic!("{error}")
    };
    assert!(expected == [boundary, other] || expected == [other, boundary], "{error}");
    assert!(0.0 < *largest && *largest < zone, "{error}");
    new(*largest)?;
    new(1.001 * largest).expect_err("a little too wide");
    Ok(())
}

#[test]
fn zones_that_reach_too_far() -> Outcome {
    check_largest(&disc()?, &["disc"], 11.0, ["disc", "top"])?;
    let two: Channel = toml::from_str(
        "x = [-5, 10]\ny = [-4, 4]\nsize = 0.5
         [[bodies]]\nname = 'a'\nsize = 0.1\nshape = { kind = 'disc', centre = [0, 0], radius = 0.5 }
         [[bodies]]\nname = 'b'\nsize = 0.1\nshape = { kind = 'disc', centre = [0, 1.6], radius = 0.5 }",
    )?;
    check_largest(&PlanarMesh::new(two.mesh()?)?, &["a", "b"], 0.5, ["a", "b"])
}

#[test]
fn motions_that_are_none() -> Outcome {
    let mut mesh = disc()?;
    let motion = disc_motion(&mesh, Stiffness::default(), 0.0)?;
    let fails = |t: f64| RigidMotion { translation: [0.0, (1.0 - t).sqrt()], angle: 0.0 };
    let mut prescribed = PrescribedMotion::new(motion.clone(), vec![Arc::new(fails)])?;
    prescribed.carry(0.5, &mut mesh)?;
    let before = mesh.clone();
    let error = prescribed.carry(1.5, &mut mesh).expect_err("NaN").to_string();
    assert!(error.contains("\"disc\" at t = 1.5 s is [0.0, NaN] m"), "{error}");
    assert_eq!(mesh, before, "as it was");

    let error = PrescribedMotion::new(motion.clone(), vec![]).expect_err("no function");
    assert_eq!(error, MotionError::Positions { expected: 1, found: 0 });
    let error = motion.carry(&[RigidMotion::REST; 2], 0.0, &mut mesh).expect_err("two");
    assert_eq!(error, MotionError::Positions { expected: 1, found: 2 });
    let mut other = PlanarMesh::new(MeshDescription::structured([1, 1], |_| false, |p| p))?;
    let error = motion.carry(&[RigidMotion::REST], 0.0, &mut other).expect_err("another mesh");
    assert!(matches!(error, MotionError::OtherMesh { found: 9, .. }), "{error}");
    let far = RigidMotion { translation: [1e80, 0.0], angle: 0.0 };
    let error = motion.carry(&[far], 2.0, &mut mesh).expect_err("beyond all sense");
    let is_lost = matches!(error, MotionError::Lost { time: 2.0, error: MeshError::NotFinite(_) });
    assert!(is_lost, "{error}");
    Ok(())
}

#[test]
fn tables_of_a_case_file() -> Outcome {
    let read = |text: &str| toml::from_str::<MotionParameters>(text);
    let stiffness = |text: &str| Ok::<_, toml::de::Error>(read(text)?.stiffness);
    assert_eq!(stiffness("stiffness = { kind = 'distance' }")?, Stiffness::default());
    let given = stiffness("stiffness = { kind = 'distance', scale = 0.2, power = 2 }")?;
    assert_eq!(given, Stiffness::Distance { scale: Some(0.2), power: 2.0 });
    let cells = stiffness("stiffness = { kind = 'cell-size' }")?;
    assert_eq!(cells, Stiffness::CellSize { power: 1.0 });
    assert_eq!(read("rigid_zone = 0.1")?.rigid_zone, 0.1);
    for bad in [
        "stiffness = { kind = 'uniform', power = 1 }",
        "stiffness = { kind = 'distance', powr = 1 }",
        "stiffness = { kind = 'wool' }",
        "zone = 0.1",
    ] {
        assert!(read(bad).is_err(), "{bad}");
    }
    Ok(())
}
