use super::TransferError;
use super::closest::shepard;
use super::neighbours::Neighbours;
use crate::{MovingField, Point};

/// Inverse-distance weighting (Shepard, 1968) over the nearest mesh nodes:
/// `v_f = Σ w_j v_j / Σ w_j` with `w_j = d_j^-power`.
pub(super) struct InverseDistance<'a> {
    field: &'a dyn MovingField,
    nodes: Neighbours,
    power: f64,
    nodal: Vec<f64>,
}

impl<'a> InverseDistance<'a> {
    pub(super) fn new(
        field: &'a dyn MovingField,
        power: f64,
        neighbours: usize,
    ) -> Result<Self, TransferError> {
        if neighbours > field.nodes() {
            return Err(TransferError::TooFewNodes { wanted: neighbours, nodes: field.nodes() });
        }
        let positions = (0..field.nodes()).map(|node| field.position(node));
        let nodes = Neighbours::new(positions, neighbours);
        Ok(Self { field, nodes, power, nodal: vec![0.0; field.components()] })
    }

    pub(super) fn interpolate(&mut self, point: Point, v: &mut [f64]) {
        v.fill(0.0);
        let Self { field, nodes, power, nodal } = self;
        let sum = shepard(nodes.nearest(point), *power, |node, weight| {
            field.nodal_velocity(node, nodal);
            v.iter_mut().zip(&*nodal).for_each(|(v, nodal)| *v += weight * nodal);
        });
        for v in v {
            *v /= sum;
        }
    }
}
