use crate::case::CaseError;
use crate::case::ask::Ask;
use crate::case::formula::Variables;
use crate::case::term::{Scalar, Term};
use lumley_body::RigidBody;
use lumley_body::joint::{Drive, Joint, TimeFunction};

/// The bodies with functions in the place of formulas, finite at `times`, in s, and with a velocity at the first.
pub(super) fn functions(
    ask: &Ask,
    bodies: &[RigidBody],
    times: &[f64],
) -> Result<Vec<RigidBody>, CaseError> {
    let mut bodies = bodies.to_vec();
    for RigidBody { name, joint, .. } in &mut bodies {
        let Joint::Prescribed(joint) = joint else { continue };
        for (coordinate, unit, drive) in
            [("x", "m", &mut joint.x), ("y", "m", &mut joint.y), ("angle", "rad", &mut joint.angle)]
        {
            let key = format!("bodies.{name}.joint.{coordinate}");
            let term = match drive {
                Drive::Constant(value) => Term::Number(*value),
                Drive::Formula(formula) => Term::Formula(formula.clone()),
                Drive::Table(_) | Drive::Function(_) => continue,
            };
            *drive = Drive::Function(function(ask, &key, &term, unit, times)?);
        }
    }
    Ok(bodies)
}

fn function(
    ask: &Ask,
    key: &str,
    term: &Term,
    unit: &str,
    times: &[f64],
) -> Result<TimeFunction, CaseError> {
    let scalar = Scalar::read(ask, key, term, Variables::Time, unit)?;
    let function = TimeFunction::new(move |time| scalar.value([0.0; 2], time));
    let finite = |what: &str, time: f64, value: f64| {
        let expected = format!("finite values; at t = {time:?} s {what} {value}");
        ask.that(value.is_finite(), key, term, &expected)
    };
    times.iter().try_for_each(|&time| finite("it gives", time, function.at(time)))?;
    finite("its slope is", times[0], function.slope(times[0]))?;
    Ok(function)
}
