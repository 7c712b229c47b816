//! The direct solvers that are timed, behind one trait.

use crate::oseen::System;
use faer::prelude::Solve;
use faer::sparse::linalg::solvers::{Lu, SymbolicLu};
use faer::sparse::{SparseColMat, Triplet};
use faer::{Col, Par};
#[cfg(feature = "mumps")]
use lumley_bench::mumps::{Mumps, Ordering};
use lumley_fom::linear::{Analysis, Multifrontal, Scalar};
use std::error::Error;

type Done = Result<(), Box<dyn Error>>;

/// A direct solver whose analysis is done.
pub trait Direct {
    fn factorise(&mut self) -> Done;
    /// Replaces the right-hand side by the solution.
    fn solve(&mut self, x: &mut [f64]) -> Done;
}

/// The analysis of a solver.
pub type Analyse<'a> = Box<dyn Fn() -> Result<Box<dyn Direct + 'a>, Box<dyn Error>> + 'a>;

/// All solvers that this build has, by name.
pub fn all<'a>(
    system: &'a System,
    matrix: &'a SparseColMat<usize, f64>,
) -> Vec<(String, Analyse<'a>)> {
    faer::set_global_parallelism(Par::Seq);
    #[cfg_attr(not(feature = "mumps"), expect(unused_mut, reason = "there is no more to add"))]
    let mut solvers: Vec<(String, Analyse<'a>)> = vec![
        ("f64".into(), Box::new(|| Ok(own::<f64>(system)))),
        ("f32".into(), Box::new(|| Ok(own::<f32>(system)))),
        ("faer".into(), Box::new(|| sparse(matrix))),
    ];
    #[cfg(feature = "mumps")]
    for ordering in [Ordering::Amd, Ordering::Scotch, Ordering::Metis] {
        let name = format!("mumps-{ordering:?}").to_lowercase();
        solvers.push((name, Box::new(move || mumps(matrix, ordering))));
    }
    solvers
}

/// The sum of the cell matrices.
pub fn assembled(system: &System) -> Result<SparseColMat<usize, f64>, Box<dyn Error>> {
    let mut triplets = Vec::new();
    for cell in 0..system.unknowns.cells() {
        let unknowns = system.unknowns.of(cell);
        let matrix = &system.matrices[system.unknowns.matrix(cell)];
        for (column, &j) in matrix.chunks_exact(unknowns.len()).zip(unknowns) {
            let entry = |(&i, &a): (&u32, &f64)| Triplet::new(i as usize, j as usize, a);
            triplets.extend(unknowns.iter().zip(column).map(entry));
        }
    }
    let n = system.unknowns.count();
    Ok(SparseColMat::try_new_from_triplets(n, n, &triplets)?)
}

struct Own<'a, T: Scalar> {
    lu: Multifrontal<T>,
    matrices: &'a [f64],
}

fn own<'a, T: Scalar + 'a>(system: &'a System) -> Box<dyn Direct + 'a> {
    let analysis = Analysis::new(system.unknowns.clone(), &system.centroids, &system.delay());
    Box::new(Own::<T> { lu: Multifrontal::new(analysis, Par::Seq), matrices: &system.matrices })
}

impl<T: Scalar> Direct for Own<'_, T> {
    fn factorise(&mut self) -> Done {
        Ok(self.lu.factorise(self.matrices)?)
    }

    fn solve(&mut self, x: &mut [f64]) -> Done {
        self.lu.solve(x);
        Ok(())
    }
}

/// faer's sparse LU; its column order is COLAMD.
struct Sparse<'a> {
    symbolic: SymbolicLu<usize>,
    matrix: &'a SparseColMat<usize, f64>,
    lu: Option<Lu<usize, f64>>,
}

fn sparse(matrix: &SparseColMat<usize, f64>) -> Result<Box<dyn Direct + '_>, Box<dyn Error>> {
    let symbolic = SymbolicLu::try_new(matrix.symbolic())?;
    Ok(Box::new(Sparse { symbolic, matrix, lu: None }))
}

impl Direct for Sparse<'_> {
    fn factorise(&mut self) -> Done {
        self.lu = Some(Lu::try_new_with_symbolic(self.symbolic.clone(), self.matrix.as_ref())?);
        Ok(())
    }

    fn solve(&mut self, x: &mut [f64]) -> Done {
        let lu = self.lu.as_ref().ok_or("nothing is factorised yet")?;
        let solution = lu.solve(&Col::from_fn(x.len(), |i| x[i]));
        x.iter_mut().zip(solution.iter()).for_each(|(x, s)| *x = *s);
        Ok(())
    }
}

#[cfg(feature = "mumps")]
fn mumps(
    matrix: &SparseColMat<usize, f64>,
    ordering: Ordering,
) -> Result<Box<dyn Direct + '_>, Box<dyn Error>> {
    let entries = matrix.triplet_iter().map(|entry| (entry.row, entry.col, *entry.val));
    Ok(Box::new(Mumps::analyse(matrix.nrows(), entries, ordering)?))
}

#[cfg(feature = "mumps")]
impl Direct for Mumps {
    fn factorise(&mut self) -> Done {
        Ok(Self::factorise(self)?)
    }

    fn solve(&mut self, x: &mut [f64]) -> Done {
        Ok(Self::solve(self, x)?)
    }
}
