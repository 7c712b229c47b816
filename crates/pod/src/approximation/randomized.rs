use crate::algorithm::finish::{Parts, finish};
use crate::algorithm::orthonormal::{changed, orthonormal, publish};
use crate::algorithm::raw::{Lift, RawModes, Residual, raw_modes};
use crate::algorithm::svd::in_original_order;
use crate::algorithm::{in_memory, with_sums};
use crate::dense::{self, PivotedCholesky, product};
use crate::partial::Partial;
use crate::random::random_bits;
use crate::run::Run;
use crate::{
    Decomposition, Execution, InnerProduct, ModeStore, Options, PodError, ReducedBasis,
    SnapshotSource, Truncation,
};
use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatRef, Par, Scale};
use std::ops::Range;

/// Columns more than modes that are asked for.
pub(crate) const OVERSAMPLING: usize = 10;
/// Columns that are tried first where an energy is asked for.
const FIRST: usize = 32;
/// Passes that turn random columns towards the right singular vectors.
const ITERATIONS: usize = 2;

/// POD by randomized subspace iteration (Halko, Martinsson and Tropp, 2011), an approximation.
///
/// ```text
/// Omega <- orthonormal columns of (F X)ᵀ (F X) Omega     twice, from M x l random numbers
/// Y = F X Omega = U Sigma Tᵀ,   V = Omega T,   Phi = X V Sigma⁻¹,   A = Sigma Vᵀ,   E = X (I - V Vᵀ)
/// ```
///
/// `A Eᵀ = 0` and `F X V` has orthogonal columns: this is the Rayleigh-Ritz approximation of the
/// correlation in time by its compression to the columns of Omega, and the bound of
/// [`APPROXIMATIONS`](crate::APPROXIMATIONS) holds. Energies that decay are found much better than that:
/// the error of `lambda_n` falls like `(lambda_(l+1)/lambda_n)⁴ lambda_n`.
///
/// l is the number of modes asked for and 10 more. An energy asked for is tried with 32 columns
/// and then with twice as many each time, until they hold it. The random numbers are always the
/// same, so that the result is.
///
/// Cost 12 n M l flops and three passes over the snapshots (two more for each time that l grows):
/// less than [`svd`](crate::svd) where M is more than a few times l, else more. With a number of modes asked
/// for it holds sums of M l numbers where the exact algorithms hold M²; where the inner product
/// couples all rows, one weighted copy of the snapshots is held in memory.
///
/// # Errors
/// Every variant of [`PodError`] but those about other algorithms.
///
/// ```
/// use lumley_pod::{Identity, MemorySnapshots, Options, Truncation, randomized};
/// let x = faer::Mat::from_fn(500, 300, |i, j| 1.0 / (1 + i + j) as f64);
/// let snapshots = MemorySnapshots::new(x, (0..300).map(f64::from).collect());
/// let options = Options { truncation: Truncation::Modes(4), ..Options::default() };
/// let basis = randomized(&snapshots, &Identity::new(500), &options)?;
/// assert_eq!((basis.size(), basis.spectrum.len(), basis.passes), (4, 14, 3));
/// # Ok::<(), lumley_pod::PodError>(())
/// ```
pub fn randomized(
    x: &dyn SnapshotSource,
    w: &dyn InnerProduct,
    options: &Options,
) -> Result<ReducedBasis, PodError> {
    in_memory(stream, x, w, options)
}

pub(super) fn stream(
    x: &dyn SnapshotSource,
    w: &dyn InnerProduct,
    options: &Options,
    execution: Execution<'_>,
    modes: &dyn ModeStore,
) -> Result<Decomposition, PodError> {
    let width = match options.truncation {
        Truncation::Modes(modes) => columns_for(modes, [x.dim(), x.times().len()]),
        Truncation::Energy(_) => x.times().len(),
    };
    with_sums(x, w, options, execution, modes, width, &|run| {
        let omega = dominant(run)?;
        compressed(run, omega.as_ref())
    })
}

fn columns_for(modes: usize, [n, m]: [usize; 2]) -> usize {
    modes.saturating_add(OVERSAMPLING).min(n).min(m)
}

/// Orthonormal columns, M x l, close to the right singular vectors with the most energy.
fn dominant(run: &Run<'_>) -> Result<Mat<f64>, PodError> {
    let (n, m) = run.ensemble.shape();
    let (mut width, wanted) = match run.ensemble.options.truncation {
        Truncation::Modes(modes) => (columns_for(modes, [n, m]), 0.0),
        Truncation::Energy(fraction) => (FIRST.min(n).min(m), fraction),
    };
    loop {
        let (mut omega, mut held) = (random_columns(m, width), 0.0);
        for _ in 0..ITERATIONS {
            let image = Image::of(run, omega.as_ref())?;
            (omega, held) = image.directions(run, omega.as_ref())?;
        }
        // A further step, that to the modes, holds no less: Omegaᵀ C² Omega >= (Omegaᵀ C Omega)².
        if held >= wanted || width == n.min(m) {
            return Ok(omega);
        }
        width = (2 * width).min(n).min(m);
    }
}

/// Numbers in (-1, 1), always the same.
fn random_columns(rows: usize, columns: usize) -> Mat<f64> {
    let mut k = 0;
    Mat::from_fn(rows, columns, |_, _| {
        k += 1;
        (random_bits(k) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    })
}

/// `(F X)ᵀ (F X) Omega`, and `|F X|²`.
struct Image {
    columns: Mat<f64>,
    energy: f64,
}

impl Image {
    /// One pass over the snapshots.
    fn of(run: &Run<'_>, omega: MatRef<'_, f64>) -> Result<Self, PodError> {
        let (ensemble, (m, width)) = (run.ensemble, omega.shape());
        let block = ensemble.partition.block();
        let part = |rows: Range<usize>| {
            let mut sum = Partial::zeros(m * width + 1, 0);
            let mut y = Mat::zeros(block, width);
            ensemble.for_tiles(rows.clone(), &mut |mut tile| {
                tile.for_blocks(ensemble, &ensemble.every, &mut |_, z| {
                    let (z, mut y) = (z.as_ref(), y.subrows_mut(0, z.nrows()));
                    matmul(y.as_mut(), Accum::Replace, z, omega, 1.0, Par::Seq);
                    let image = sum.matrix_mut(m, width);
                    matmul(image, Accum::Add, z.transpose(), y.as_ref(), 1.0, Par::Seq);
                    sum.sums[m * width] += z.squared_norm_l2();
                })
            })?;
            // An entry that is not finite makes the energy so: no need to look at each.
            if sum.sums[m * width].is_finite() { Ok(sum) } else { Err(ensemble.not_finite(rows)) }
        };
        let sum = run.over_snapshots("subspace", &part)?;
        Ok(Self { columns: sum.matrix(m, width).to_owned(), energy: sum.sums[m * width] })
    }

    /// Share of the energy that columns hold, once they are orthonormal: the trace of `Omegaᵀ C Omega`.
    fn held(&self, omega: MatRef<'_, f64>) -> f64 {
        let pairs = omega.col_iter().zip(self.columns.col_iter());
        pairs.map(|(a, b)| a.transpose() * b).sum::<f64>() / self.energy
    }

    /// Orthonormal columns of the same span, those of the largest images first, and the share of the energy
    /// that `omega` held: no two ranks may go on differently.
    ///
    /// Left singular vectors from a QR factorisation: it works column by column and keeps the
    /// directions of small columns, which a singular value decomposition drowns in the round-off
    /// of the large ones.
    fn directions(
        self,
        run: &Run<'_>,
        omega: MatRef<'_, f64>,
    ) -> Result<(Mat<f64>, f64), PodError> {
        let (m, width) = self.columns.shape();
        let largest = self.columns.norm_max();
        if largest == 0.0 {
            let centred = run.ensemble.options.center;
            return Err(PodError::NoEnergy { snapshots: m, centred });
        }
        let found = run.agreed(|| {
            let held = self.held(omega);
            // Squares of squares: scaled, they stay within the range of numbers.
            let scaled = self.columns * Scale(1.0 / largest);
            let q = dense::orthonormal(scaled.as_ref());
            let r = product(q.transpose(), scaled.as_ref());
            let (_, left) = dense::right_svd(r.transpose())?;
            let vectors = product(q.as_ref(), left.as_ref());
            let entries = vectors.col_iter().flat_map(|v| v.iter().copied());
            Ok(entries.chain([held]).collect())
        })?;
        let (vectors, held) = found.split_at(m * width);
        Ok((MatRef::from_column_major_slice(vectors, m, width).to_owned(), held[0]))
    }
}

/// The POD of `X Omega Omegaᵀ`: a pass over the snapshots that stores `X Omega`, and passes over that.
fn compressed(run: &Run<'_>, omega: MatRef<'_, f64>) -> Result<Decomposition, PodError> {
    let (m, _) = omega.shape();
    let lift = Lift { to_modes: omega, coefficients: omega.transpose(), measured: true };
    let RawModes { columns, residual } = raw_modes(run, &lift)?;
    let (sigma, t) = singular_vectors(run, columns.gram.as_ref())?;
    let left_out: f64 = residual.left.iter().sum();
    let lambda: Vec<f64> = sigma.iter().map(|s| s * s / m as f64).collect();
    // The snapshots before their mean was subtracted have its energy besides.
    let held: f64 = (0..columns.gram.ncols()).map(|k| columns.gram[(k, k)]).sum();
    let steady = (residual.whole.iter().sum::<f64>() - held - left_out).max(0.0) / m as f64;
    let mut spectrum = run.ensemble.spectrum(lambda, steady, None)?;
    spectrum.left_out = Some(left_out / m as f64);
    let (kept, note) = spectrum.keep(run.ensemble.options.truncation);

    let to_columns = Mat::from_fn(t.nrows(), kept, |i, k| t[(i, k)] / sigma[k]);
    let change = orthonormal(run, &[to_columns.as_ref()], changed(run, &[to_columns.as_ref()])?)?;
    publish(run, &[to_columns.as_ref(), change.to_modes.as_ref()])?;

    let v = product(omega, t.as_ref());
    let a = Mat::from_fn(sigma.len(), m, |k, j| sigma[k] * v[(j, k)]);
    let residual = residual_of(run, residual, a.subrows(kept, a.nrows() - kept));
    let coefficients = product(change.of_coefficients.as_ref(), a.subrows(0, kept));
    let parts = Parts { coefficients, note, residual, passes: run.passes() };
    Ok(finish("randomized", run.ensemble, spectrum, parts))
}

/// Singular values and right singular vectors, l x k, of columns with this Gram matrix.
///
/// The columns are close to orthogonal, as Omega is close to singular vectors: squared, they lose
/// nothing.
fn singular_vectors(
    run: &Run<'_>,
    gram: MatRef<'_, f64>,
) -> Result<(Vec<f64>, Mat<f64>), PodError> {
    let width = gram.ncols();
    let found = run.agreed(|| {
        let cholesky = PivotedCholesky::new(gram, 8.0 * f64::EPSILON);
        let factor = in_original_order(cholesky.factor().as_ref(), &cholesky.order);
        let (sigma, vectors) = dense::right_svd(factor.as_ref())?;
        Ok(sigma.into_iter().chain(vectors.col_iter().flat_map(|v| v.iter().copied())).collect())
    })?;
    let (sigma, vectors) = found.split_at(found.len() / (width + 1));
    let vectors = MatRef::from_column_major_slice(vectors, width, sigma.len()).to_owned();
    Ok((sigma.to_vec(), vectors))
}

/// What the modes that are kept leave of each snapshot, if that is asked for.
///
/// * `discarded`: coefficients of the others
fn residual_of(run: &Run<'_>, mut all: Residual, discarded: MatRef<'_, f64>) -> Residual {
    if !run.ensemble.options.residuals {
        return Residual::default();
    }
    for (left, a) in all.left.iter_mut().zip(discarded.col_iter()) {
        *left += a.squared_norm_l2();
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ensemble::Ensemble;
    use crate::{Identity, MemoryModes, MemorySnapshots, Ranks};
    use std::sync::mpsc::{Receiver, Sender, channel};

    /// One of two ranks.
    struct Pair(usize, Sender<Vec<u8>>, Receiver<Vec<u8>>);

    impl Ranks for Pair {
        fn rank(&self) -> usize {
            self.0
        }

        fn count(&self) -> usize {
            2
        }

        fn send(&self, _: usize, message: &[u8]) {
            self.1.send(message.to_vec()).expect("the other rank listens");
        }

        fn receive(&self, _: usize) -> Vec<u8> {
            self.2.recv().expect("the other rank speaks")
        }
    }

    /// Machines that round differently take the same step: both hear what the first has found.
    #[test]
    fn ranks_that_round_differently_go_on_alike() {
        let (omega, image) = (random_columns(40, 3), random_columns(40, 3) * Scale(2.0));
        let found = |ranks: &Pair| {
            let x = MemorySnapshots::new(Mat::zeros(50, 40), vec![0.0; 40]);
            let (w, options, modes) =
                (Identity::new(50), Options::default(), MemoryModes::default());
            let ensemble = Ensemble::for_sums(&x, &w, &options, 3).expect("a plan");
            let run = Run::new(&ensemble, Execution { ranks, ..Execution::default() }, &modes);
            let rounding = 1.0 + ranks.rank() as f64 * f64::EPSILON;
            let image = Image { columns: &image * Scale(rounding), energy: 100.0 };
            image.directions(&run, omega.as_ref()).expect("directions")
        };
        let ((to_second, from_first), (to_first, from_second)) = (channel(), channel());
        let pair = [Pair(0, to_second, from_second), Pair(1, to_first, from_first)];
        let found = std::thread::scope(|scope| {
            let found = &found;
            pair.map(|rank| scope.spawn(move || found(&rank)))
                .map(|rank| rank.join().expect("no panic"))
        });
        let held = 2.0 * omega.squared_norm_l2() / 100.0;
        assert!((found[0].1 - held).abs() < 1e-14, "{} {held}", found[0].1);
        assert_eq!(found[0], found[1]);
    }
}
