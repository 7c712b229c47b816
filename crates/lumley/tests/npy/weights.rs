use crate::sample::{Outcome, file, header, npy};
use faer::Mat;
use lumley::format::FormatError;
use lumley::format::npy::{NpyWeights, write_matrix, write_vector};
use lumley_pod::{
    Diagonal, InnerProduct, InnerProductError, MemorySnapshots, Options, Truncation, svd,
};

const NODES: usize = 20_000;

fn weight(node: usize) -> f64 {
    1.0 + (0.37 * node as f64).sin().powi(2)
}

fn entry(i: usize, j: usize) -> f64 {
    (0.011 * (i * (j + 1)) as f64).cos() + j as f64
}

type Operation = fn(&dyn InnerProduct, &mut Mat<f64>) -> std::io::Result<()>;

/// The same bits as with the weights in memory, for all rows and for some of them.
#[test]
fn weights_in_a_file_are_those_in_memory() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("w.npy");
    let weights: Vec<f64> = (0..NODES).map(weight).collect();
    write_vector(&path, &weights)?;
    for components in [1, 3] {
        let in_file = NpyWeights::open(&path)?.repeated(components);
        let in_memory = Diagonal::new(weights.repeat(components))?;
        let n = components * NODES;
        assert_eq!((in_file.dim(), in_file.reach()), (n, in_memory.reach()));
        assert_eq!(in_file.diagonal()?, in_memory.diagonal()?);
        let x = Mat::from_fn(n, 2, entry);
        let operations: [Operation; 2] =
            [|w, x| w.apply(x.as_mut()), |w, x| w.unfactor(x.as_mut())];
        for operation in operations {
            let (mut a, mut b) = (x.clone(), x.clone());
            operation(&in_file, &mut a)?;
            operation(&in_memory, &mut b)?;
            assert_eq!(a, b);
        }
        for rows in [0..n, 0..0, 7..8, 8_000..17_000, n - 12_345..n] {
            let mut a = Mat::from_fn(rows.len(), 2, |i, j| x[(rows.start + i, j)]);
            let mut b = a.clone();
            in_file.factor(rows.clone(), a.as_mut())?;
            in_memory.factor(rows, b.as_mut())?;
            assert_eq!(a, b);
        }
    }
    Ok(())
}

#[test]
fn a_decomposition_takes_them() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("w.npy");
    let weights: Vec<f64> = (0..NODES).map(weight).collect();
    write_vector(&path, &weights)?;
    let times = (0..5).map(f64::from).collect();
    let x = MemorySnapshots::new(Mat::from_fn(NODES, 5, entry), times);
    let options = Options { truncation: Truncation::Modes(3), ..Options::default() };
    let in_file = svd(&x, &NpyWeights::open(&path)?, &options)?;
    let in_memory = svd(&x, &Diagonal::new(weights)?, &options)?;
    assert_eq!(in_file.modes, in_memory.modes);
    assert_eq!(in_file.eigenvalues, in_memory.eigenvalues);
    Ok(())
}

/// The first weight that cannot be is named, also behind many good ones.
#[test]
fn impossible_weights_are_named() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("w.npy");
    for (at, bad) in [(0, 0.0), (9_999, -1.0), (19_999, f64::NAN), (8_192, f64::INFINITY)] {
        let mut weights = vec![1.0; NODES];
        weights[at] = bad;
        write_vector(&path, &weights)?;
        let error = NpyWeights::open(&path).expect_err("an impossible weight");
        let FormatError::Weights { path: named, source } = &error else { panic!("{error}") };
        let InnerProductError::Weight { index, value } = source else { panic!("{error}") };
        assert_eq!((named, *index, value.to_bits()), (&path, at, bad.to_bits()));
        assert!(error.to_string().contains(&format!("w.npy: weight {at}")), "{error}");
    }
    write_matrix(&path, Mat::<f64>::ones(3, 2).as_ref())?;
    let error = NpyWeights::open(&path).expect_err("a matrix");
    assert!(matches!(error, FormatError::Shape { .. }), "{error}");
    Ok(())
}

/// Integers, a row, and a file that is gone when it is read again.
#[test]
fn other_files_of_weights() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = file(folder.path(), &npy(&header("|u1", false, "(1, 4)"), &[1, 4, 9, 16]))?;
    let w = NpyWeights::open(&path)?;
    let mut x = Mat::<f64>::ones(2, 1);
    w.factor(2..4, x.as_mut())?;
    assert_eq!(x, faer::mat![[3.0], [4.0]]);
    std::fs::OpenOptions::new().write(true).open(&path)?.set_len(20)?;
    let error = w.factor(2..4, x.as_mut()).expect_err("the weights are cut off");
    assert!(error.to_string().contains("x.npy"), "{error}");
    Ok(())
}
