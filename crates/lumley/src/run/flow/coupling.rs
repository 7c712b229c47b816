use lumley_fom::coupling::Coupling;

/// What to know of an explicit coupling whose share of added mass is over half of its limit.
pub(crate) fn warning(share: f64) -> Option<String> {
    let limit = Coupling::EXPLICIT_LIMIT;
    let what = if share < limit { "may" } else { "will" };
    let words = format!(
        "the fluid that the bodies take with them has {share:.3} of their own inertia: the explicit coupling {what} become unstable, \
         as it is, whatever the step, from a share of about {limit} on; motion.coupling = \"monolithic\" has no limit"
    );
    (share > 0.5 * limit).then_some(words)
}
