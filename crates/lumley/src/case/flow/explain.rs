use super::{BoundarySection, FlowCase};
use lumley_body::RigidBody;
use lumley_body::joint::{Drive, Joint};
use lumley_fem::Point;
use lumley_fom::flow::Condition;

impl FlowCase {
    /// Which formula of the case is not finite at a point in m and a time in s, as it is written, and what it
    /// gives: the rest of an error that a flow stopped with.
    ///
    /// ```
    /// use lumley::case::Case;
    /// let text = lumley::cases::find("cavity").expect("a case of lumley's own").text;
    /// let text = text.replace("[1, 0]", "['1/(y - 0.5)', 0]");
    /// let Case::Flow(case) = Case::parse("cavity/case.toml".as_ref(), &text, true, &[])? else {
    ///     panic!("it has a [flow]");
    /// };
    /// let found = case.explain([0.2, 0.5], 0.0).expect("a division by zero");
    /// assert!(found.starts_with("flow.boundaries.top.velocity = [\"1/(y - 0.5)\", 0.0] gives (inf, 0)"));
    /// assert_eq!(case.explain([0.2, 1.0], 0.0), None);
    /// # Ok::<(), lumley::case::CaseError>(())
    /// ```
    pub fn explain(&self, at: Point, time: f64) -> Option<String> {
        let [x, y] = at;
        let tell = |written: String, value: &[f64]| {
            let wrong = value.iter().any(|v| !v.is_finite());
            let values: Vec<String> = value.iter().map(f64::to_string).collect();
            let values = values.join(", ");
            wrong.then(|| {
                format!("{written} gives ({values}) at x = {x:?} m, y = {y:?} m, t = {time:?} s")
            })
        };
        let on_boundary = self.conditions.iter().find_map(|(name, condition)| {
            let Condition::Velocity(field) = condition else { return None };
            let section = self.file.flow.boundaries.get(name)?;
            tell(format!("flow.boundaries.{name}.{}", velocity(section)), &field.value(at, time))
        });
        let force = || {
            let terms = self.file.flow.body_force.as_ref()?;
            let value = self.parameters.body_force.as_ref()?.value(at, time);
            tell(format!("flow.body_force = {}", super::fields::written(terms)), &value)
        };
        let motion = || {
            let bodies = self.bodies.as_ref()?.tree.bodies().iter().zip(&self.file.bodies);
            bodies.flat_map(drives).find_map(|(key, drive, written)| {
                let (Drive::Function(function), Drive::Formula(formula)) = (drive, written) else {
                    return None;
                };
                tell(format!("{key} = \"{formula}\""), &[function.at(time)])
            })
        };
        on_boundary.or_else(force).or_else(motion)
    }
}

/// How a section gives its velocity.
fn velocity(section: &BoundarySection) -> String {
    match (&section.velocity, &section.table) {
        (Some(terms), _) => format!("velocity = {}", super::fields::written(terms)),
        (None, Some(table)) => format!("table = {table}"),
        (None, None) => "profile".into(),
    }
}

/// The keys of what prescribes a body's motion, with what it means and how it is written.
fn drives<'a>(
    (body, written): (&'a RigidBody, &'a RigidBody),
) -> impl Iterator<Item = (String, &'a Drive, &'a Drive)> {
    let drives = |joint: &'a Joint| match joint {
        Joint::Prescribed(joint) => vec![&joint.x, &joint.y, &joint.angle],
        _ => Vec::new(),
    };
    let keys = ["x", "y", "angle"].map(|key| format!("bodies.{}.joint.{key}", body.name));
    let both = drives(&body.joint).into_iter().zip(drives(&written.joint));
    keys.into_iter().zip(both).map(|(key, (drive, written))| (key, drive, written))
}
