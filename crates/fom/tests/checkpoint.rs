//! A checkpoint continues bit for bit, and damage to it does not pass.

mod canonical;

use lumley_fom::{CheckpointError, Piston, TimeScheme};
use std::error::Error;

const SCHEMES: [TimeScheme; 3] =
    [TimeScheme::ImplicitEuler, TimeScheme::CrankNicolson, TimeScheme::Bdf2];

fn piston(degree: usize, scheme: TimeScheme) -> Piston {
    Piston::new(&canonical::parameters(1.0), 12, degree, scheme).expect("the canonical piston")
}

fn advance(piston: &mut Piston, steps: usize) {
    for step in 0..steps {
        piston.step(if step % 3 == 0 { 1e-3 } else { 8e-4 }).expect("a good step");
    }
}

fn saved(piston: &Piston) -> Vec<u8> {
    let mut bytes = Vec::new();
    piston.save(&mut bytes).expect("memory takes it");
    bytes
}

/// Everything that can be seen of a piston, bit for bit.
fn seen(piston: &Piston) -> Vec<u64> {
    let body = piston.body();
    let scalars = [piston.time(), piston.interface(), piston.traction(), piston.acceleration()];
    let body = [body.position[0], body.velocity[0]];
    scalars.into_iter().chain(body).chain(piston.velocities()).map(f64::to_bits).collect()
}

#[test]
fn continues_bit_for_bit() -> Result<(), Box<dyn Error>> {
    for scheme in SCHEMES {
        for degree in [1, 2] {
            for steps in [0, 1, 7] {
                let mut original = piston(degree, scheme);
                advance(&mut original, steps);
                let mut restored = piston(degree, scheme);
                advance(&mut restored, 3);
                restored.restore(&mut saved(&original).as_slice())?;
                assert_eq!(seen(&restored), seen(&original), "{scheme:?}, {degree}, {steps}");
                advance(&mut original, 20);
                advance(&mut restored, 20);
                assert_eq!(seen(&restored), seen(&original), "{scheme:?}, {degree}, {steps}");
            }
        }
    }
    Ok(())
}

/// It reads no further than what was written, so that others can follow in the same stream.
#[test]
fn leaves_what_follows() -> Result<(), CheckpointError> {
    let mut bytes = saved(&piston(1, TimeScheme::Bdf2));
    bytes.extend(b"next");
    let mut rest = bytes.as_slice();
    piston(1, TimeScheme::Bdf2).restore(&mut rest)?;
    assert_eq!(rest, b"next");
    Ok(())
}

#[test]
fn any_damage_is_an_error_and_changes_nothing() {
    let mut original = piston(2, TimeScheme::Bdf2);
    advance(&mut original, 5);
    let bytes = saved(&original);
    let mut other = piston(2, TimeScheme::Bdf2);
    advance(&mut other, 2);
    let before = seen(&other);
    for place in 0..bytes.len() {
        let mut damaged = bytes.clone();
        damaged[place] ^= 0x10;
        assert!(other.restore(&mut damaged.as_slice()).is_err(), "byte {place}");
        assert!(other.restore(&mut &bytes[..place]).is_err(), "cut at {place}");
    }
    assert_eq!(seen(&other), before);
}

#[test]
fn errors_say_what_is_wrong() {
    let bytes = saved(&piston(1, TimeScheme::Bdf2));
    let refusal =
        |mut into: Piston| into.restore(&mut bytes.as_slice()).expect_err("another piston");
    assert!(matches!(refusal(piston(2, TimeScheme::Bdf2)), CheckpointError::Mismatch("degree")));
    let scheme = piston(1, TimeScheme::CrankNicolson);
    assert!(matches!(refusal(scheme), CheckpointError::Mismatch("time scheme")));
    let mut heavier = canonical::parameters(1.0);
    heavier.joint.mass = 0.6;
    let heavier = Piston::new(&heavier, 12, 1, TimeScheme::Bdf2).expect("a good piston");
    assert!(matches!(refusal(heavier), CheckpointError::Mismatch("mass")));
    let text = b"this is no checkpoint";
    let error = piston(1, TimeScheme::Bdf2).restore(&mut text.as_slice()).expect_err("text");
    assert!(matches!(error, CheckpointError::Damaged(_)), "{error}");
}
