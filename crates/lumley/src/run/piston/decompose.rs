use super::ground::is_mapped;
use crate::Error;
use crate::case::PistonCase;
use crate::directory::Workplace;
use crate::record::Record;
use crate::run::BasisFile;
use crate::run::decompose::{Decomposed, OnGrid, on_fixed_grid, whole};
use faer::Mat;
use lumley_fem::LineMesh;
use lumley_fem::element::{P1, P2};
use lumley_pod::{MemorySnapshots, SnapshotSource, SparseSpd};

/// The decompositions of a run.
pub(super) struct Decompositions {
    pub fixed: OnGrid,
    pub reference: Option<Decomposed>,
}

/// POD of the record's frames; the bases are written to `basis/`.
pub(super) fn decompose(
    case: &PistonCase,
    record: &Record,
    place: &Workplace,
    threads: usize,
) -> Result<Decompositions, Error> {
    let fixed = on_fixed_grid(&case.grid, &case.pod, record, place, threads)?;
    let mapped = case.models.iter().any(is_mapped);
    let reference = if mapped { Some(reference(case, record, place, threads)?) } else { None };
    if let Some(reference) = &reference {
        BasisFile::save(&place.path().join("basis/reference.npz"), &reference.basis)?;
    }
    Ok(Decompositions { fixed, reference })
}

/// POD of u - X' xi in L2(0, 1). It vanishes at both ends, and so do the modes, to the last bit: the end
/// nodes are no unknowns.
fn reference(
    case: &PistonCase,
    record: &Record,
    place: &Workplace,
    threads: usize,
) -> Result<Decomposed, Error> {
    let mesh = LineMesh::new(case.cells, if case.degree == 1 { &P1 } else { &P2 });
    let nodes = mesh.uniform(0.0, 1.0);
    let xi: Vec<f64> = mesh.left_to_right().map(|node| nodes[node]).collect();
    let u = record.frame("reference")?;
    let velocities = record.series("velocity")?;
    let mut x = whole(&u)?;
    for (k, column) in x.col_iter_mut().enumerate() {
        for (u, xi) in column.iter_mut().zip(&xi) {
            *u -= velocities.at(k)[0] * xi;
        }
    }
    let inside = x.subrows(1, x.nrows() - 2).to_owned();
    let x = MemorySnapshots::new(inside, u.times().to_vec());
    let found = Decomposed::with_sweep(&x, &inner_mass(&mesh, &nodes), &case.pod, threads);
    let mut found = found.map_err(Error::pod(&place.path().join("record")))?;
    let modes = &found.basis.modes;
    let mut padded = Mat::zeros(xi.len(), modes.ncols());
    padded.subrows_mut(1, modes.nrows()).copy_from(modes);
    found.basis.modes = padded;
    if let Some(mean) = &mut found.basis.mean {
        mean.insert(0, 0.0);
        mean.push(0.0);
    }
    Ok(found)
}

/// The mass matrix of all nodes but the first and the last, from left to right.
fn inner_mass(mesh: &LineMesh, nodes: &[f64]) -> SparseSpd {
    // Records list the nodes from left to right, meshes their vertices first.
    let mut place = vec![0; mesh.nodes()];
    mesh.left_to_right().enumerate().for_each(|(k, node)| place[node] = k);
    let inner = mesh.nodes() - 2;
    let inside = |node: usize| place[node].checked_sub(1).filter(|k| *k < inner);
    let mass = mesh.mass_matrix(nodes).into_iter();
    let mass = mass.filter_map(|(i, j, m)| Some((inside(i)?, inside(j)?, m)));
    let product = SparseSpd::from_triplets(inner, &mass.collect::<Vec<_>>());
    product.expect("a mass matrix is symmetric positive definite")
}
