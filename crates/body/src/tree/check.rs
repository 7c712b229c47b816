use super::TreeError;
use crate::RigidBody;
use crate::joint::{Layout, Spring, Turning};

const NOT_NEGATIVE: &str = "0 or a finite number above";
const POSITIVE: &str = "a finite number above 0";
const FINITE: &str = "a finite number";

/// Whether names and boundaries are each a body's own.
pub(super) fn names(bodies: &[RigidBody]) -> Result<(), TreeError> {
    for (k, body) in bodies.iter().enumerate() {
        if body.name.is_empty() {
            return Err(TreeError::NoName(k + 1));
        }
        if bodies[..k].iter().any(|other| other.name == body.name) {
            return Err(TreeError::Twice(body.name.clone()));
        }
        let Some(boundary) = &body.boundary else { continue };
        let mut others = bodies[..k].iter();
        if let Some(other) = others.find(|other| other.boundary.as_ref() == Some(boundary)) {
            let bodies = [other.name.clone(), body.name.clone()];
            return Err(TreeError::SharedBoundary { boundary: boundary.clone(), bodies });
        }
    }
    Ok(())
}

/// Whether every number of a body and of its joint is in its range.
pub(super) fn quantities(body: &RigidBody, layout: &Layout<'_>) -> Result<(), TreeError> {
    let ask = Ask(body);
    for (what, mass) in [("mass", body.mass), ("displaced mass", body.displaced.map(|d| d.mass))] {
        ask.that(mass.is_none_or(not_negative), what, mass, "kg/m", NOT_NEGATIVE)?;
    }
    ask.that(body.inertia.is_none_or(not_negative), "inertia", body.inertia, "kg m", NOT_NEGATIVE)?;
    if let Some((what, size)) = body.shape.map(|shape| shape.size()) {
        ask.that(not_negative(size) && size > 0.0, what, Some(size), "m", POSITIVE)?;
    }
    ask.finite("angle", body.angle, "rad")?;
    let points = [
        ("centre", Some(body.centre)),
        ("at", layout.at),
        ("centre of the displaced fluid", body.displaced.map(|d| d.centre)),
    ];
    for (what, point) in points {
        point.into_iter().flatten().try_for_each(|x| ask.finite(what, x, "m"))?;
    }
    joint(&ask, layout)
}

fn joint(ask: &Ask<'_>, layout: &Layout<'_>) -> Result<(), TreeError> {
    for slide in &layout.slides {
        let [x, y] = slide.direction;
        let length = x.hypot(y);
        let expected = "a direction: two finite numbers that are not both 0";
        ask.that(
            length > 0.0 && length.is_finite(),
            "length of `along`",
            Some(length),
            "m",
            expected,
        )?;
        ask.spring(slide.spring, slide.name, ["N/m²", "m", "N s/m²"])?;
    }
    match layout.turn {
        Turning::Free(spring) => ask.spring(spring, "angle", ["N/rad", "rad", "N s/rad"]),
        Turning::With | Turning::Beyond => Ok(()),
    }
}

fn not_negative(value: f64) -> bool {
    value.is_finite() && value >= 0.0
}

/// Refusals in the name of a body.
struct Ask<'a>(&'a RigidBody);

impl Ask<'_> {
    fn that(
        &self,
        ok: bool,
        what: &str,
        value: Option<f64>,
        unit: &'static str,
        expected: &'static str,
    ) -> Result<(), TreeError> {
        match value {
            Some(value) if !ok => Err(TreeError::Quantity {
                body: self.0.name.clone(),
                what: what.to_owned(),
                value,
                unit,
                expected,
            }),
            _ => Ok(()),
        }
    }

    fn finite(&self, what: &str, value: f64, unit: &'static str) -> Result<(), TreeError> {
        self.that(value.is_finite(), what, Some(value), unit, FINITE)
    }

    /// Units for each m of span: of the stiffness, the coordinate and the damping.
    fn spring(
        &self,
        spring: Option<Spring>,
        coordinate: &str,
        units: [&'static str; 3],
    ) -> Result<(), TreeError> {
        let Some(Spring { stiffness, rest, damping }) = spring else { return Ok(()) };
        let what = |name| format!("{name} of the spring on its {coordinate}");
        for (name, value, unit) in
            [("stiffness", stiffness, units[0]), ("damping", damping, units[2])]
        {
            self.that(not_negative(value), &what(name), Some(value), unit, NOT_NEGATIVE)?;
        }
        self.finite(&what("rest value"), rest, units[1])
    }
}

/// Mass and inertia of a body; what no load can move or turn needs none.
pub(super) fn inertia(body: &RigidBody, moves: bool, turns: bool) -> Result<(f64, f64), TreeError> {
    if body.inertia.is_some() && body.shape.is_some() {
        return Err(TreeError::TwoInertias(body.name.clone()));
    }
    if body.mass.is_none() && moves {
        return Err(TreeError::NoMass(body.name.clone()));
    }
    let mass = body.mass.unwrap_or(0.0);
    let inertia = body.inertia.or_else(|| body.shape.map(|shape| shape.inertia(mass)));
    if inertia.is_none() && turns && mass > 0.0 {
        return Err(TreeError::NoInertia(body.name.clone()));
    }
    Ok((mass, inertia.unwrap_or(0.0)))
}
