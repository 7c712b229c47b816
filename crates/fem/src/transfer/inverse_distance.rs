use super::TransferError;
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
        let found = self.nodes.nearest(point);
        let (closest, node) = found[0];
        if closest == 0.0 {
            return self.field.nodal_velocity(node, v);
        }
        v.fill(0.0);
        let mut sum = 0.0;
        for &(square, node) in found {
            // Relative to the closest node no weight overflows, however near that node is.
            let weight = (closest / square).powf(0.5 * self.power);
            self.field.nodal_velocity(node, &mut self.nodal);
            v.iter_mut().zip(&self.nodal).for_each(|(v, nodal)| *v += weight * nodal);
            sum += weight;
        }
        for v in v {
            *v /= sum;
        }
    }
}
