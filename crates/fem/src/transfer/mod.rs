//! From a moving mesh to a fixed grid: the global velocity, paper eqs. (27)-(30).

mod closest;
mod finite_element;
mod grid_error;
mod inverse_distance;
mod neighbours;
mod planar;

pub use grid_error::{GridError, grid_error};
pub use planar::{Bodies, BodyError, Coverage, Place, PlanarFlow, PlanarTransfer};

use crate::{MovingField, Point, UniformGrid};
use inverse_distance::InverseDistance;
use serde::{Deserialize, Serialize};

/// How the velocity of the fluid gets from the moving mesh to the fixed grid.
///
/// In a case file, `method = "finite-element"`, or `method = "inverse-distance"` with `power` and
/// `neighbours`.
///
/// ```
/// use lumley_fem::transfer::Transfer;
/// assert_eq!(Transfer::default(), Transfer::FiniteElement {});
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(tag = "method", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Transfer {
    /// The finite-element function itself, evaluated at the grid's nodes: as accurate as the mesh.
    FiniteElement {},
    /// Weights `d^-power` on the nearest mesh nodes at distances d: the paper's interpolation. It
    /// keeps bounds and is first order; only two neighbours with power 1 on a line are second order,
    /// being linear interpolation.
    InverseDistance {
        /// Exponent, positive; 2 unless given.
        #[serde(default = "default_power")]
        power: f64,
        /// How many of the nearest mesh nodes count, at least one; 4 unless given.
        #[serde(default = "default_neighbours")]
        neighbours: usize,
    },
}

fn default_power() -> f64 {
    2.0
}

fn default_neighbours() -> usize {
    4
}

impl Default for Transfer {
    fn default() -> Self {
        Self::FiniteElement {}
    }
}

/// Why a field cannot be brought to the grid.
///
/// ```
/// use lumley_fem::transfer::Transfer;
/// let method = Transfer::InverseDistance { power: -1.0, neighbours: 4 };
/// let error = method.check().unwrap_err();
/// assert_eq!(error.to_string(), "transfer power is -1, expected a finite number above 0");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum TransferError {
    /// The exponent of the inverse distance is not usable.
    #[error("transfer power is {0}, expected a finite number above 0")]
    Power(f64),
    /// No neighbour to take a value from.
    #[error("transfer neighbours is 0, expected at least 1")]
    NoNeighbours,
    /// More neighbours wanted than the mesh has nodes.
    #[error(
        "transfer neighbours is {wanted}, but the mesh has {nodes} nodes: take fewer neighbours or a finer mesh"
    )]
    TooFewNodes {
        /// Neighbours asked for.
        wanted: usize,
        /// Nodes of the mesh.
        nodes: usize,
    },
    /// A point of the fluid that no cell of the mesh covers.
    #[error(
        "the point ({}, {}) m is in the fluid but in no cell of the mesh: the mesh does not cover the fluid",
        .0[0],
        .0[1]
    )]
    NotCovered(Point),
}

impl Transfer {
    /// Whether the parameters make sense on some mesh.
    ///
    /// # Errors
    /// [`TransferError::Power`] and [`TransferError::NoNeighbours`].
    pub fn check(&self) -> Result<(), TransferError> {
        match *self {
            Self::InverseDistance { power, .. } if !(power.is_finite() && power > 0.0) => {
                Err(TransferError::Power(power))
            }
            Self::InverseDistance { neighbours: 0, .. } => Err(TransferError::NoNeighbours),
            _ => Ok(()),
        }
    }

    /// The global velocity `v = χ_F v_f + (1 − χ_F) v_s` on the nodes of a grid, paper eq. (30), in m/s.
    ///
    /// Component c at node i goes to `out[c * grid.len() + i]`. Memory is allocated once for the
    /// whole grid, not for each of its nodes.
    ///
    /// # Errors
    /// Every variant of [`TransferError`]; `out` is then half written.
    ///
    /// # Panics
    /// If `out` has not one entry for each component at each node.
    pub fn transfer(
        &self,
        field: &dyn MovingField,
        grid: &UniformGrid,
        out: &mut [f64],
    ) -> Result<(), TransferError> {
        self.check()?;
        match *self {
            Self::FiniteElement {} => {
                global_velocity(field, grid, out, |p, v| finite_element::interpolate(field, p, v))
            }
            Self::InverseDistance { power, neighbours } => {
                let mut method = InverseDistance::new(field, power, neighbours)?;
                global_velocity(field, grid, out, |p, v| {
                    method.interpolate(p, v);
                    Ok(())
                })
            }
        }
    }
}

/// Paper eq. (30) with `v_f` from `fluid`.
fn global_velocity(
    field: &dyn MovingField,
    grid: &UniformGrid,
    out: &mut [f64],
    mut fluid: impl FnMut(Point, &mut [f64]) -> Result<(), TransferError>,
) -> Result<(), TransferError> {
    assert_eq!(out.len(), field.components() * grid.len(), "one value per component and node");
    let mut v = vec![0.0; field.components()];
    for k in 0..grid.len() {
        let point = grid.point(k);
        if field.is_fluid(point) {
            fluid(point, &mut v)?;
        } else {
            field.solid_velocity(point, &mut v);
        }
        for (component, &v) in v.iter().enumerate() {
            out[component * grid.len() + k] = v;
        }
    }
    Ok(())
}
