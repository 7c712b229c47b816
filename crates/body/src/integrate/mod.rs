//! The motion of bodies without a fluid.

mod error;
mod implicit;
mod rate_formula;
mod runge_kutta;

pub use error::DynamicsError;
pub use implicit::ImplicitScheme;
pub use rate_formula::RateFormula;
pub use runge_kutta::RungeKutta;

use crate::{Load, Tree};

/// Without a fluid every free coordinate needs an inertia.
fn check_tree(tree: &Tree) -> Result<(), DynamicsError> {
    match tree.massless_coordinate() {
        Some(k) => Err(DynamicsError::Massless { coordinate: tree.label(k) }),
        None => Ok(()),
    }
}

fn check_step(time: f64, step: f64) -> Result<(), DynamicsError> {
    if step > 0.0 && step.is_finite() { Ok(()) } else { Err(DynamicsError::Step { time, step }) }
}

fn check_loads(tree: &Tree, time: f64, loads: &[Load]) -> Result<(), DynamicsError> {
    for &Load { body, force, moment, .. } in loads {
        if !(force[0].is_finite() && force[1].is_finite() && moment.is_finite()) {
            let body = tree.bodies()[body].name.clone();
            return Err(DynamicsError::Load { body, time, force, moment });
        }
    }
    Ok(())
}
