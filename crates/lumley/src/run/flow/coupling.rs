use lumley_fom::coupling::Coupling;

/// What to know of an explicit coupling whose share of added mass is over half of its limit.
pub(crate) fn warning(share: Option<f64>) -> Option<String> {
    let limit = Coupling::EXPLICIT_LIMIT;
    let share = share.filter(|share| *share > 0.5 * limit)?;
    let what = if share < limit { "may" } else { "will" };
    Some(format!(
        "the fluid that the bodies take with them has {share:.3} of their own inertia: the explicit coupling {what} become unstable, \
         as it is, whatever the step, from a share of about {limit} on; motion.coupling = \"monolithic\" has no limit"
    ))
}
