//! What a coordinate of a joint is.

use super::super::FlowReport;
use super::BodyMotion;
use lumley_body::joint::Joint;

/// Symbol and units of a coordinate, in markup.
pub(super) struct Quantity {
    pub symbol: &'static str,
    pub unit: &'static str,
    pub rate: &'static str,
    pub rate_unit: &'static str,
    pub stiffness_unit: &'static str,
    pub damping_unit: &'static str,
}

/// The ways that joints have.
const LENGTH: Quantity = Quantity {
    symbol: "*s*",
    unit: "m",
    rate: "velocity",
    rate_unit: "m/s",
    stiffness_unit: "N/m^{2}",
    damping_unit: "N s/m^{2}",
};

impl Quantity {
    /// Of the coordinate of this name.
    pub(super) fn of(name: &str) -> Self {
        match name {
            "angle" => Self {
                symbol: "angle",
                unit: "rad",
                rate: "angular velocity",
                rate_unit: "rad/s",
                stiffness_unit: "N/rad",
                damping_unit: "N s/rad",
            },
            "x" => Self { symbol: "*x*", ..LENGTH },
            "y" => Self { symbol: "*y*", ..LENGTH },
            _ => LENGTH,
        }
    }
}

/// The load of the fluid along a coordinate.
pub(super) struct LoadAlong {
    /// In markup.
    pub name: &'static str,
    pub unit: &'static str,
    pub values: Vec<f64>,
}

/// The load of the fluid on a body along its coordinate `name`: none on a dry body, nor along a way that turns.
pub(super) fn load_along(report: &FlowReport, body: &BodyMotion, name: &str) -> Option<LoadAlong> {
    let wet = body.setup.boundary.as_ref()?;
    let boundary = report.loads.iter().find(|loads| loads.name == *wet)?;
    let [x, y] = match (name, &body.setup.joint) {
        ("angle", _) => {
            let values = boundary.moment.clone();
            return Some(LoadAlong { name: "moment *M*_{G}", unit: "N", values });
        }
        ("x", _) => [1.0, 0.0],
        ("y", _) => [0.0, 1.0],
        (_, Joint::Prismatic(slider)) if slider.to.is_none() => {
            let length = slider.along[0].hypot(slider.along[1]);
            slider.along.map(|c| c / length)
        }
        _ => return None,
    };
    let values = boundary.drag.iter().zip(&boundary.lift).map(|(fx, fy)| x * fx + y * fy);
    let values = values.collect();
    let has_coefficients = report.settings.reference.is_some();
    let name = match ([x, y], has_coefficients) {
        ([1.0, 0.0], true) => "drag coefficient *C*_{D}",
        ([1.0, 0.0], false) => "force *F*_{x}",
        ([0.0, 1.0], true) => "lift coefficient *C*_{L}",
        ([0.0, 1.0], false) => "force *F*_{y}",
        (_, true) => "force coefficient along *s*",
        (_, false) => "force along *s*",
    };
    let unit = if has_coefficients { "" } else { "N/m" };
    Some(LoadAlong { name, unit, values })
}
