//! What a basis must be: finite, orthonormal, zero where its frame says so.

use super::Basis;
use crate::ReducedError;

/// Largest departure of `(Φ_i, Φ_j)` from `δ_ij` that is put down to round-off in POD.
const ORTHONORMALITY: f64 = 1e-6;
/// Largest value at an end of the reference frame, over the function's largest value, that is put down to
/// round-off.
const HOMOGENEITY: f64 = 1e-8;
/// Largest departure of a reference node from its place.
const PLACE: f64 = 1e-12;

/// There are as many nodal values as nodes, all finite; `at` gives those of one node.
pub(super) fn field<I: Iterator<Item = f64>>(
    what: &'static str,
    expected: usize,
    found: usize,
    at: impl Fn(usize) -> I,
) -> Result<(), ReducedError> {
    if found != expected {
        return Err(ReducedError::Count { what, found, expected });
    }
    let bad = (0..found).find_map(|node| at(node).find(|v| !v.is_finite()).map(|v| (node, v)));
    bad.map_or(Ok(()), |(node, value)| Err(ReducedError::NotFinite { what, node, value }))
}

/// The nodes rise from 0 to 1 and make cells of this degree.
pub(super) fn reference_nodes(nodes: &[f64], degree: usize) -> Result<(), ReducedError> {
    if !(1..=2).contains(&degree) {
        let (name, value) = ("degree of the reference elements", degree as f64);
        return Err(ReducedError::Parameter { name, value, unit: "", expected: "1 or 2" });
    }
    let cells = (nodes.len().saturating_sub(1) / degree).max(1);
    let (what, expected) = ("nodes of the reference frame", cells * degree + 1);
    if nodes.len() != expected {
        return Err(ReducedError::Count { what, found: nodes.len(), expected });
    }
    let last = nodes.len() - 1;
    let in_place = |k: usize| match k {
        0 => nodes[0] == 0.0,
        k if k == last => (nodes[k] - 1.0).abs() < PLACE && nodes[k] > nodes[k - 1],
        k if k % degree == 1 => (2.0 * nodes[k] - nodes[k - 1] - nodes[k + 1]).abs() < PLACE,
        k => nodes[k] > nodes[k - 1],
    };
    match (0..=last).find(|&k| !in_place(k)) {
        Some(node) => Err(ReducedError::Node { node, position: nodes[node] }),
        None => Ok(()),
    }
}

/// The modes are orthonormal in L2, (6).
pub(super) fn orthonormal(basis: &Basis) -> Result<(), ReducedError> {
    let frozen = basis.frozen();
    for i in frozen..basis.width() {
        for j in frozen..=i {
            let product: f64 =
                (0..basis.nodes().len()).map(|k| basis.row(k)[i] * basis.dual_row(k)[j]).sum();
            let expected = f64::from(u8::from(i == j));
            if (product - expected).abs() > ORTHONORMALITY {
                let [first, second] = [j, i].map(|n| n + 1 - frozen);
                return Err(ReducedError::NotOrthonormal { first, second, product });
            }
        }
    }
    Ok(())
}

/// All functions vanish at both ends.
pub(super) fn homogeneous(basis: &Basis) -> Result<(), ReducedError> {
    let ends = [basis.order[0], basis.order[basis.order.len() - 1]];
    for (end, node) in ends.into_iter().enumerate() {
        for (n, &value) in basis.row(node).iter().enumerate() {
            let largest =
                (0..basis.nodes().len()).fold(0.0, |max, k| basis.row(k)[n].abs().max(max));
            if value.abs() > HOMOGENEITY * largest {
                let what = if n < basis.frozen() { "the mean" } else { "a mode" };
                return Err(ReducedError::NotHomogeneous { what, end, value });
            }
        }
    }
    Ok(())
}
