//! Which pressures must wait: one of every edge-connected component of every subdomain.

use super::DelayedUnknowns;
use super::dissection::Dissection;
use crate::disjoint_sets::DisjointSets;

/// The unknowns that each subdomain leaves to the whole that it is a half of.
///
/// In a subdomain whose boundary velocities are not eliminated yet, the flow through the boundary of
/// each edge-connected component is prescribed: its pressures are determined up to a constant. The
/// block of all its interior unknowns is singular, that of all but one constant pressure is not.
pub(super) fn delayed(dissection: &Dissection, delay: &DelayedUnknowns<'_>) -> Vec<Vec<u32>> {
    let ranks = ranks(&dissection.order);
    let edges = edges_by_subdomain(dissection, delay.neighbours, &ranks);
    let mut components = Components::new(&ranks, delay.unknowns);
    let mut delayed: Vec<Vec<u32>> = Vec::with_capacity(edges.len());
    for (subdomain, edges) in dissection.subdomains.iter().zip(&edges) {
        for &[a, b] in edges {
            components.join(a, b);
        }
        let waiting: Vec<usize> = match subdomain.halves {
            Some(halves) => halves
                .into_iter()
                .flat_map(|half| &delayed[half])
                .filter_map(|u| components.cell_of(*u))
                .collect(),
            None => subdomain.cells.clone().collect(),
        };
        delayed.push(components.representatives(&waiting));
    }
    if let Some(root) = delayed.last_mut() {
        root.clear();
    }
    delayed
}

/// Place of each cell in the order of the leaves.
fn ranks(order: &[usize]) -> Vec<usize> {
    let mut ranks = vec![0; order.len()];
    for (rank, &cell) in order.iter().enumerate() {
        ranks[cell] = rank;
    }
    ranks
}

/// For each subdomain the pairs of neighbours, by rank, that it joins first.
fn edges_by_subdomain(
    dissection: &Dissection,
    neighbours: &[[usize; 2]],
    ranks: &[usize],
) -> Vec<Vec<[usize; 2]>> {
    let subdomains = &dissection.subdomains;
    let mut edges = vec![Vec::new(); subdomains.len()];
    for pair in neighbours {
        let pair = pair.map(|cell| ranks[cell]);
        let mut at = subdomains.len() - 1;
        while let Some(half) = subdomains[at].halves.and_then(|halves| {
            halves.into_iter().find(|&h| pair.iter().all(|rank| subdomains[h].cells.contains(rank)))
        }) {
            at = half;
        }
        edges[at].push(pair);
    }
    edges
}

/// Sets of edge-connected cells, each with the unknown that stands for it.
struct Components {
    sets: DisjointSets,
    unknown: Vec<Option<u32>>,
    cells: std::collections::HashMap<u32, usize>,
}

impl Components {
    #[expect(clippy::cast_possible_truncation, reason = "unknowns are numbered in 32 bits")]
    fn new(ranks: &[usize], delayed: &[[usize; 2]]) -> Self {
        let mut unknown = vec![None; ranks.len()];
        let mut cells = std::collections::HashMap::new();
        for &[u, cell] in delayed {
            unknown[ranks[cell]].get_or_insert(u as u32);
            cells.insert(u as u32, ranks[cell]);
        }
        Self { sets: DisjointSets::new(ranks.len()), unknown, cells }
    }

    fn cell_of(&self, unknown: u32) -> Option<usize> {
        self.cells.get(&unknown).copied()
    }

    fn join(&mut self, a: usize, b: usize) {
        let [first, second] = self.sets.join(a, b);
        self.unknown[first] = self.unknown[first].or(self.unknown[second]);
    }

    /// The unknowns of the components of these cells, each once.
    fn representatives(&mut self, cells: &[usize]) -> Vec<u32> {
        let mut unknowns: Vec<u32> = cells
            .iter()
            .filter_map(|&cell| {
                let root = self.sets.root(cell);
                self.unknown[root]
            })
            .collect();
        unknowns.sort_unstable();
        unknowns.dedup();
        unknowns
    }
}
