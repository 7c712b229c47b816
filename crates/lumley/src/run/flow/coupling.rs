use crate::case::FlowCase;
use lumley_fom::TimeScheme;

/// Added mass over own mass at which the explicit coupling is unstable, whatever the step.
fn limit(scheme: TimeScheme) -> f64 {
    match scheme {
        TimeScheme::Bdf2 => 0.3,
        TimeScheme::ImplicitEuler | TimeScheme::CrankNicolson => 1.0,
    }
}

/// What to know of an explicit coupling whose share of added mass is over half of its limit.
pub(crate) fn warning(case: &FlowCase, share: Option<f64>) -> Option<String> {
    let limit = limit(case.parameters.scheme);
    let share = share.filter(|share| *share > 0.5 * limit)?;
    let what = if share < limit {
        "may become unstable: it is, whatever the step, from a share of"
    } else {
        "will become unstable, as it is, whatever the step, from a share of"
    };
    Some(format!(
        "the fluid that the bodies take with them has {share:.2} of their own inertia: the explicit coupling {what} \
         about {limit}; motion.coupling = \"monolithic\" has no limit"
    ))
}
