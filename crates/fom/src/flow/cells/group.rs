use super::condense::{Dense, INTERIOR, recovery};
use super::integrals::{Fields, ReferencePoint, Terms, integrate};
use super::lanes::{Lanes, WIDTH};
use crate::linear::vectorised;
use lumley_fem::Point;
use rayon::prelude::*;
use std::ops::Range;

/// Batches that one thread takes at once.
const SHARE: usize = 8;

/// Fields on the whole mesh, as the integrals take them.
#[derive(Clone, Copy)]
pub struct NodalFields<'a> {
    /// Geometry nodes, in m.
    pub nodes: &'a [Point],
    /// Convecting velocity relative to the mesh at the velocity dofs, in m/s.
    pub wind: &'a [Point],
    /// Body force less the known part of the rate at the velocity dofs, in m/s².
    pub source: &'a [Point],
    /// The velocity about which Newton's method linearises at the velocity dofs, in m/s.
    pub base: &'a [Point],
}

/// What the integrals of a group of cells give, cell after cell.
pub struct Output<'a> {
    /// Condensed matrices, by columns.
    pub matrices: &'a mut [f64],
    /// Condensed right-hand sides.
    pub right: &'a mut [f64],
    /// What recovers the interior unknowns.
    pub recoveries: &'a mut [f64],
}

/// Cells of one kind that lie one after the other in the system: N velocities, G geometry nodes and M = 2 N + 3
/// unknowns each.
#[derive(Debug, Clone)]
pub struct Group<const N: usize, const G: usize, const M: usize> {
    points: Vec<ReferencePoint<N, G>>,
    dofs: Vec<[usize; N]>,
    nodes: Vec<[usize; G]>,
}

impl<const N: usize, const G: usize, const M: usize> Group<N, G, M> {
    /// Unknowns of a cell that are not eliminated in it.
    pub const RIM: usize = M - INTERIOR;

    /// The cells with these velocity dofs and geometry nodes.
    pub fn new(
        points: Vec<ReferencePoint<N, G>>,
        dofs: Vec<[usize; N]>,
        nodes: Vec<[usize; G]>,
    ) -> Self {
        Self { points, dofs, nodes }
    }

    /// Number of cells.
    pub fn len(&self) -> usize {
        self.dofs.len()
    }

    /// Integrates and condenses all cells. The bits do not depend on `parallel`.
    pub fn assemble(
        &self,
        terms: &Terms,
        fields: &NodalFields<'_>,
        output: Output<'_>,
        parallel: bool,
    ) {
        let rim = Self::RIM;
        let share = SHARE * WIDTH;
        let sizes = [rim * rim, rim, recovery(rim)].map(|size| size * share);
        let Output { matrices, right, recoveries } = output;
        let run = |k: usize, matrices: &mut [f64], right: &mut [f64], recoveries: &mut [f64]| {
            let cells = k * share..((k + 1) * share).min(self.len());
            self.assemble_share(terms, fields, cells, Output { matrices, right, recoveries });
        };
        if parallel {
            let pieces = matrices.par_chunks_mut(sizes[0]).zip(right.par_chunks_mut(sizes[1]));
            let pieces = pieces.zip(recoveries.par_chunks_mut(sizes[2])).enumerate();
            pieces.for_each(|(k, ((a, b), c))| run(k, a, b, c));
        } else {
            let pieces = matrices.chunks_mut(sizes[0]).zip(right.chunks_mut(sizes[1]));
            let pieces = pieces.zip(recoveries.chunks_mut(sizes[2])).enumerate();
            pieces.for_each(|(k, ((a, b), c))| run(k, a, b, c));
        }
    }

    fn assemble_share(
        &self,
        terms: &Terms,
        fields: &NodalFields<'_>,
        cells: Range<usize>,
        mut output: Output<'_>,
    ) {
        vectorised(
            #[inline(always)]
            || {
                if terms.stress || terms.newton {
                    self.batches::<N>(terms, fields, &cells, &mut output);
                } else {
                    self.batches::<0>(terms, fields, &cells, &mut output);
                }
            },
        );
    }

    #[inline(always)]
    fn batches<const C: usize>(
        &self,
        terms: &Terms,
        fields: &NodalFields<'_>,
        cells: &Range<usize>,
        output: &mut Output<'_>,
    ) {
        let rim = Self::RIM;
        let matrices = output.matrices.chunks_mut(WIDTH * rim * rim);
        let right = output.right.chunks_mut(WIDTH * rim);
        let recoveries = output.recoveries.chunks_mut(WIDTH * recovery(rim));
        let outputs = matrices.zip(right).zip(recoveries);
        for (first, ((matrices, right), recoveries)) in cells.clone().step_by(WIDTH).zip(outputs) {
            let fields =
                self.gather(fields, terms.newton, |lane| (first + lane).min(cells.end - 1));
            let sums = integrate::<N, G, C>(&self.points, terms, &fields);
            let mut dense = Dense::<M>::new(&sums, terms);
            dense.condense();
            dense.store(matrices, right, recoveries);
        }
    }

    #[inline(always)]
    fn gather(
        &self,
        fields: &NodalFields<'_>,
        newton: bool,
        cell: impl Fn(usize) -> usize,
    ) -> Fields<N, G> {
        let dofs: [&[usize; N]; WIDTH] = std::array::from_fn(|lane| &self.dofs[cell(lane)]);
        let nodes: [&[usize; G]; WIDTH] = std::array::from_fn(|lane| &self.nodes[cell(lane)]);
        let zero = [[Lanes::default(); 2]; N];
        Fields {
            nodes: at(fields.nodes, &nodes),
            wind: at(fields.wind, &dofs),
            source: at(fields.source, &dofs),
            base: if newton { at(fields.base, &dofs) } else { zero },
        }
    }
}

/// The vectors at these places, one list of places for each lane.
#[inline(always)]
fn at<const K: usize>(vectors: &[Point], places: &[&[usize; K]; WIDTH]) -> [[Lanes; 2]; K] {
    let mut found = [[Lanes::default(); 2]; K];
    for (lane, places) in places.iter().enumerate() {
        for (k, &place) in places.iter().enumerate() {
            let [x, y] = vectors[place];
            found[k][0].0[lane] = x;
            found[k][1].0[lane] = y;
        }
    }
    found
}
