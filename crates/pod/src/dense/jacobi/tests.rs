use super::*;
use crate::dense::right_svd;
use faer::Scale;

/// Well conditioned (2.8), not orthogonal; like the scales below exact in binary.
fn coupled(i: usize, j: usize) -> f64 {
    f64::from(i == j) + ((7 * i + 3 * j + i * j) % 11) as f64 / 32.0 - 5.0 / 32.0
}

/// 1 to 2^-66 = 1e-20, out of order.
fn scale(k: usize) -> f64 {
    (-6.0 * (5 * k % 12) as f64).exp2()
}

/// 1 to 2^-55, in another order.
fn other_scale(k: usize) -> f64 {
    (-5.0 * ((7 * k + 3) % 12) as f64).exp2()
}

/// Numbers in (-1, 1) without structure.
fn noise(size: usize, seed: u64) -> Mat<f64> {
    let mut state = seed;
    Mat::from_fn(size, size, |_, _| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    })
}

fn orthogonal(size: usize, seed: u64) -> Mat<f64> {
    noise(size, seed).qr().compute_Q()
}

/// `U Sigma Vᵀ` with these singular values.
fn with_values(values: &[f64]) -> Mat<f64> {
    let u = orthogonal(values.len(), 1);
    let u_sigma = Mat::from_fn(values.len(), values.len(), |i, k| u[(i, k)] * values[k]);
    u_sigma * orthogonal(values.len(), 2).transpose()
}

/// Decomposes and checks what holds for every matrix: values in order, V orthonormal, the columns
/// of `A V` orthogonal and as long as the values say to round-off of the first value.
fn decompose(a: &Mat<f64>) -> Result<(Vec<f64>, Mat<f64>), PodError> {
    let (values, v) = graded_svd(a.as_ref())?;
    let (size, unit) = (a.ncols(), 1.0 / values[0]);
    assert!(values.is_sorted_by(|s, t| s >= t), "{values:?}");
    let round_off = 1e-15 * (size as f64).sqrt().max(4.0);
    let defect = (v.transpose() * &v - Mat::<f64>::identity(size, size)).norm_max();
    assert!(defect < round_off, "size {size}: |VᵀV - I| = {defect:e}");
    let av = a * &v * Scale(unit);
    let diagonal = |i: usize, j| if i == j { (values[i] * unit).powi(2) } else { 0.0 };
    let defect = (av.transpose() * &av - Mat::from_fn(size, size, diagonal)).norm_max();
    assert!(defect < 5.0 * round_off, "size {size}: |(AV)ᵀ(AV) - Sigma²| = {defect:e}");
    Ok((values, v))
}

fn assert_relative(values: &[f64], exact: &[f64], tolerance: f64) {
    assert_eq!(values.len(), exact.len());
    for (value, exact) in values.iter().zip(exact) {
        let error = (value / exact - 1.0).abs();
        assert!(error < tolerance, "{value:e} is not {exact:e}: relative error {error:e}");
    }
}

/// Columns graded, rows graded, and both; the references were computed with 160 digits.
#[test]
fn every_graded_value_is_right_to_all_digits() -> Result<(), PodError> {
    let columns = Mat::from_fn(12, 12, |i, j| coupled(i, j) * scale(j));
    let rows = Mat::from_fn(12, 12, |i, j| coupled(i, j) * scale(i));
    let both = Mat::from_fn(12, 12, |i, j| coupled(i, j) * scale(i) * other_scale(j));
    for (a, exact) in [(columns, COLUMNS_GRADED), (rows, ROWS_GRADED), (both, BOTH_GRADED)] {
        assert_relative(&decompose(&a)?.0, &exact, 1e-14);
    }
    Ok(())
}

const COLUMNS_GRADED: [f64; 12] = [
    0.905_173_044_369_806,
    1.814_766_416_585_777_3e-2,
    2.348_021_391_029_477_7e-4,
    3.980_489_503_722_944e-6,
    5.130_266_706_255_825e-8,
    8.154_525_458_876_33e-10,
    1.548_777_061_470_538_3e-11,
    1.698_912_533_966_174_7e-13,
    3.241_437_038_025_358e-15,
    5.239_248_693_740_203_6e-17,
    7.721_896_939_637_703e-19,
    1.437_884_396_414_410_8e-20,
];

const ROWS_GRADED: [f64; 12] = [
    0.905_173_073_166_603_3,
    1.819_872_649_866_101_7e-2,
    2.322_740_306_010_420_5e-4,
    4.012_015_726_484_021e-6,
    5.365_132_038_731_048e-8,
    8.131_884_733_678_231e-10,
    1.556_933_521_325_670_8e-11,
    1.692_143_018_609_561_2e-13,
    3.049_982_341_122_393e-15,
    5.458_550_813_757_183_4e-17,
    7.689_670_943_966_365e-19,
    1.410_739_766_700_024_7e-20,
];

const BOTH_GRADED: [f64; 12] = [
    0.125_035_292_766_568_13,
    2.081_824_840_038_538_8e-5,
    4.931_869_081_860_677e-6,
    9.255_911_924_174_04e-10,
    5.285_602_555_109_311e-15,
    3.375_630_433_213_82e-18,
    1.060_107_771_881_708_4e-21,
    3.993_060_867_704_062e-24,
    7.514_097_880_350_202e-27,
    6.134_123_344_809_861_5e-30,
    1.319_362_389_834_023e-32,
    2.669_556_375_433_923_4e-36,
];

/// The singular values of an orthogonal matrix times a diagonal one are the diagonal.
#[test]
fn graded_orthogonal_columns_keep_their_lengths() -> Result<(), PodError> {
    let q = orthogonal(100, 5);
    for power in [-0.5, -1.0, -3.0] {
        let a = Mat::from_fn(100, 100, |i, j| q[(i, j)] * (power * (37 * j % 100) as f64).exp2());
        let exact: Vec<f64> = (0..100).map(|k| (power * f64::from(k)).exp2()).collect();
        assert_relative(&decompose(&a)?.0, &exact, 1e-14);
    }
    Ok(())
}

/// Upper triangular, every trailing block like the whole: pivoting changes nothing, yet the last
/// value is 5000 times smaller than the last pivot. The references were computed with 160 digits.
#[test]
fn kahan_matrix() -> Result<(), PodError> {
    let a = Mat::from_fn(20, 20, |i, j| {
        let entry = [0.0, 1.0, -0.625][usize::from(i <= j) + usize::from(i < j)];
        entry * (0..i).map(|_| 0.75).product::<f64>()
    });
    let (values, _) = decompose(&a)?;
    let exact = [3.859_424_207_724_201_6, 7.134_403_454_410_289e-3, 7.578_044_823_006_983e-7];
    assert_relative(&[values[0], values[18], values[19]], &exact, 1e-12);
    Ok(())
}

/// Where rows and columns are mixed, round-off of the first value is all that can be had.
#[test]
fn prescribed_values_are_right_to_round_off_of_the_first() -> Result<(), PodError> {
    let sixty = |f: fn(f64) -> f64| -> Vec<f64> { (0..60).map(|k| f(f64::from(k))).collect() };
    let graded = sixty(|k| 10.0_f64.powf(-0.5 * k));
    let clustered = sixty(|k| 3.0 - (k / 20.0).floor() - 1e-11 * k);
    let repeated = sixty(|k| if k < 30.0 { 2.0 } else { 1e-9 });
    for exact in [graded, clustered, repeated, vec![1.0; 60], vec![5.0], vec![2.0, 1e-7]] {
        let (values, _) = decompose(&with_values(&exact))?;
        for (value, sigma) in values.iter().zip(&exact) {
            let error = (value - sigma).abs() / exact[0];
            assert!(error < 1e-14, "{value:e} is not {sigma:e}: {error:e} of the first");
        }
    }
    Ok(())
}

/// Larger than a tile; against another algorithm.
#[test]
fn a_matrix_without_structure() -> Result<(), PodError> {
    let a = noise(300, 9);
    let reference = a.singular_values().expect("the reference converges");
    for (value, exact) in decompose(&a)?.0.iter().zip(reference) {
        assert!((value - exact).abs() < 1e-12, "{value:e} is not {exact:e}");
    }
    Ok(())
}

#[test]
fn zero_rows_and_columns_leave_zeros_and_complete_vectors() -> Result<(), PodError> {
    let mut columns = noise(50, 4);
    for j in [0, 7, 20, 49] {
        columns.col_mut(j).fill(0.0);
    }
    let mut rows = noise(50, 4);
    for i in 20..50 {
        rows.row_mut(i).fill(0.0);
    }
    for (a, rank) in [(columns, 46), (rows, 20)] {
        let (values, _) = decompose(&a)?;
        assert!(values[rank - 1] > 1e-3 && values[rank..].iter().all(|&s| s == 0.0), "{values:?}");
    }
    Ok(())
}

#[test]
fn dependent_columns_leave_round_off() -> Result<(), PodError> {
    let base = noise(50, 4);
    let twice = Mat::from_fn(50, 50, |i, j| base[(i, j % 25)]);
    for (a, rank) in [(twice, 25), (Mat::from_fn(50, 50, |_, _| 1.0), 1)] {
        let (values, _) = decompose(&a)?;
        assert!(values[rank - 1] > 1e-3 && values[rank] < 1e-14 * values[0], "{values:?}");
    }
    Ok(())
}

/// What round-off leaves of the copies, 1e-16, disturbs the smaller ones by its square only.
#[test]
fn copies_of_a_column_leave_smaller_ones_alone() -> Result<(), PodError> {
    let q = orthogonal(40, 7);
    let a = Mat::from_fn(40, 40, |i, j| if j < 10 { q[(i, 0)] } else { 1e-8 * q[(i, j)] });
    let (values, _) = decompose(&a)?;
    assert_relative(&values[..31], &[vec![10.0_f64.sqrt()], vec![1e-8; 30]].concat(), 1e-14);
    assert!(values[31] < 1e-15, "{values:?}");
    Ok(())
}

/// Squares of these entries overflow and underflow.
#[test]
fn a_power_of_two_changes_no_bit() -> Result<(), PodError> {
    let a = Mat::from_fn(12, 12, |i, j| coupled(i, j) * scale(j));
    let (values, v) = decompose(&a)?;
    for factor in [1000.0_f64.exp2(), (-940.0_f64).exp2()] {
        let (scaled_values, scaled_v) = graded_svd((&a * Scale(factor)).as_ref())?;
        assert!(scaled_values.iter().zip(&values).all(|(scaled, value)| *scaled == value * factor));
        assert_eq!(scaled_v, v);
    }
    Ok(())
}

#[test]
fn the_ends_of_the_range() -> Result<(), PodError> {
    let single = |value| graded_svd(faer::mat![[0.0, value], [0.0, 0.0]].as_ref());
    for value in [f64::MAX, f64::MIN_POSITIVE, 5e-324] {
        assert_eq!(single(value)?.0, [value, 0.0]);
    }
    let (values, v) = graded_svd(faer::mat![[1.0, 0.0], [0.0, f64::MIN_POSITIVE]].as_ref())?;
    assert_eq!((values, v), (vec![1.0, 0.0], Mat::identity(2, 2)));
    assert_eq!(graded_svd(Mat::full(2, 2, f64::MAX).as_ref())?.0[0], f64::INFINITY);
    Ok(())
}

#[test]
fn nothing_to_decompose() -> Result<(), PodError> {
    assert_eq!(graded_svd(Mat::zeros(3, 3).as_ref())?, (vec![0.0; 3], Mat::identity(3, 3)));
    assert_eq!(graded_svd(Mat::zeros(0, 0).as_ref())?, (vec![], Mat::zeros(0, 0)));
    Ok(())
}

#[test]
fn entries_that_are_not_finite_are_refused() {
    for value in [f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
        let mut a = noise(3, 1);
        a[(2, 1)] = value;
        for scale in [1.0, 1e-9] {
            a.col_mut(0).iter_mut().for_each(|x| *x *= scale);
            let error = right_svd(a.as_ref()).expect_err("the entry is refused");
            assert!(matches!(error, PodError::Overflow), "{error}");
        }
    }
}

#[test]
fn tiles_hold_every_pair_once() {
    for size in [1, 2, 7, 400] {
        let mut met: Vec<_> = pairs(size).collect();
        met.sort_unstable();
        let all = (0..size).flat_map(|p| (p + 1..size).map(move |q| (p, q)));
        assert!(met.into_iter().eq(all), "order {size}");
    }
}
