use super::InnerProductError;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::{LltError, LltRegularization};
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMat, SymbolicSparseColMat};
use faer::{Par, Side, Spec};

/// The sparse Cholesky factor L, each column starting with its diagonal, and the order in which it
/// takes the unknowns: `P W Pᵀ = L Lᵀ`, `(P x)_i = x[order[i]]`.
pub(super) fn cholesky(
    matrix: &SparseColMat<usize, f64>,
) -> Result<(SparseColMat<usize, f64>, Vec<usize>), InnerProductError> {
    let size = matrix.nrows();
    if size == 0 {
        return Ok((matrix.clone(), Vec::new()));
    }
    let symbolic = analyse(matrix).ok_or(InnerProductError::Memory { size })?;
    let order = symbolic.perm().map_or_else(|| (0..size).collect(), |p| p.arrays().0.to_vec());
    let mut values = vec![0.0; symbolic.len_val()];
    let scratch = symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Spec::default());
    let mut buffer = MemBuffer::try_new(scratch).map_err(|_| InnerProductError::Memory { size })?;
    symbolic
        .factorize_numeric_llt(
            &mut values,
            matrix.as_ref(),
            Side::Upper,
            LltRegularization::default(),
            Par::Seq,
            MemStack::new(&mut buffer),
            Spec::default(),
        )
        // faer counts this pivot from 1.
        .map_err(|LltError::NonPositivePivot { index }| InnerProductError::NotPositiveDefinite {
            index: order[index - 1],
        })?;
    let lower = lower_factor(&symbolic, values);
    check_pivots(matrix, &lower, &order)?;
    Ok((lower, order))
}

/// In the simplicial form, which stores L column by column as the products here read it.
fn analyse(matrix: &SparseColMat<usize, f64>) -> Option<SymbolicCholesky<usize>> {
    let params = CholeskySymbolicParams {
        supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SIMPLICIAL,
        ..Default::default()
    };
    let amd = SymmetricOrdering::Amd;
    factorize_symbolic_cholesky(matrix.symbolic(), Side::Upper, amd, params).ok()
}

fn lower_factor(symbolic: &SymbolicCholesky<usize>, values: Vec<f64>) -> SparseColMat<usize, f64> {
    let SymbolicCholeskyRaw::Simplicial(l) = symbolic.raw() else {
        unreachable!("the simplicial form was asked for");
    };
    let n = l.nrows();
    let (columns, rows) = (l.col_ptr().to_vec(), l.row_idx().to_vec());
    SparseColMat::new(SymbolicSparseColMat::new_checked(n, n, columns, None, rows), values)
}

/// A singular matrix may pass the factorisation by rounding: its last pivots are round-off.
fn check_pivots(
    matrix: &SparseColMat<usize, f64>,
    lower: &SparseColMat<usize, f64>,
    order: &[usize],
) -> Result<(), InnerProductError> {
    let round_off = order.len() as f64 * f64::EPSILON;
    for (j, &index) in order.iter().enumerate() {
        let pivot = lower.val_of_col(j)[0].powi(2);
        let diagonal = matrix.get(index, index).copied().unwrap_or(0.0);
        if pivot <= round_off * diagonal || !pivot.is_finite() {
            return Err(InnerProductError::NotPositiveDefinite { index });
        }
    }
    Ok(())
}
