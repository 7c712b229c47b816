//! Checkpoints and threads: the same bits.

use super::setups::{Kind, Wobble, enclosed, mesh, parameters};
use lumley_fom::flow::{Flow, FlowMotion, Linearisation, ViscousForm};
use lumley_fom::{CheckpointError, TimeScheme};

fn moving(parallel: bool) -> Flow {
    let grid = mesh(Kind::Both, 12);
    let motion = Wobble::of(&grid, 4.0);
    let parameters = parameters(TimeScheme::Bdf2, ViscousForm::Stress, Linearisation::Tangent);
    enclosed(grid, parameters, FlowMotion::Given(motion), parallel)
}

fn bits(flow: &Flow) -> Vec<u64> {
    let mut state = Vec::new();
    flow.save(&mut state).expect("memory does not fail");
    state.as_chunks().0.iter().map(|bytes| u64::from_le_bytes(*bytes)).collect()
}

#[test]
fn a_restart_makes_the_same_bits() {
    let mut whole = moving(false);
    let mut saved = Vec::new();
    for k in 0..12 {
        if k == 5 {
            whole.forget_factor();
            whole.save(&mut saved).expect("memory does not fail");
        }
        whole.step(0.03).expect("a step");
    }
    let mut resumed = moving(false);
    resumed.restore(&mut saved.as_slice()).expect("a sound checkpoint");
    for _ in 5..12 {
        resumed.step(0.03).expect("a step");
    }
    assert_eq!(bits(&whole), bits(&resumed));
}

#[test]
fn two_threads_make_the_same_bits() {
    let [one, two] = [false, true].map(|parallel| {
        let mut flow = moving(parallel);
        for _ in 0..4 {
            flow.step(0.03).expect("a step");
        }
        bits(&flow)
    });
    assert_eq!(one, two);
}

#[test]
fn damaged_and_foreign_checkpoints_are_refused() {
    let flow = moving(false);
    let mut saved = Vec::new();
    flow.save(&mut saved).expect("memory does not fail");
    let mut other = {
        let parameters = parameters(TimeScheme::Bdf2, ViscousForm::Stress, Linearisation::Newton);
        let grid = mesh(Kind::Both, 12);
        enclosed(grid, parameters, FlowMotion::Still, false)
    };
    let before = bits(&other);
    let foreign = other.restore(&mut saved.as_slice());
    assert!(matches!(foreign, Err(CheckpointError::Mismatch(_))), "{foreign:?}");
    for at in [0, saved.len() / 2, saved.len() - 3] {
        let mut damaged = saved.clone();
        damaged[at] ^= 1;
        let mut flow = moving(false);
        assert!(flow.restore(&mut damaged.as_slice()).is_err(), "byte {at}");
    }
    assert!(other.restore(&mut &saved[..saved.len() - 9]).is_err());
    assert_eq!(before, bits(&other), "a refused checkpoint changes nothing");
}
