use crate::sample::{Lcg, Outcome, file, header, npy};
use faer::{Mat, MatMut, mat};
use lumley::format::FormatError;
use lumley::format::npy::{
    NpyMatrix, NpySnapshots, SnapshotLayout, read_vector, write_matrix, write_vector,
};
use lumley_pod::SnapshotSource;

fn little<T, const N: usize>(values: impl Iterator<Item = T>, bytes: fn(T) -> [u8; N]) -> Vec<u8> {
    values.flat_map(bytes).collect()
}

/// Blocks at random places, in both orders, narrow and wide, equal those of the matrix in memory.
#[test]
fn blocks_are_those_of_the_matrix() -> Outcome {
    let folder = tempfile::tempdir()?;
    let mut lcg = Lcg(5);
    for (rows, cols) in [(7, 5000), (5000, 7), (1, 1), (300, 200)] {
        let x = Mat::from_fn(rows, cols, |i, j| (i * 10_000 + j) as f64);
        let fortran = folder.path().join("fortran.npy");
        write_matrix(&fortran, x.as_ref())?;
        let data = little((0..rows * cols).map(|k| x[(k / cols, k % cols)]), f64::to_le_bytes);
        let c =
            file(folder.path(), &npy(&header("<f8", false, &format!("({rows}, {cols})")), &data))?;
        for path in [fortran, c] {
            let file = NpyMatrix::open(&path)?;
            assert_eq!(file.read()?, x);
            for _ in 0..50 {
                let (row, col) = (lcg.below(rows), lcg.below(cols));
                let (height, width) = (lcg.below(rows + 1 - row), lcg.below(cols + 1 - col));
                let mut out = Mat::zeros(height, width);
                file.read_block(row..row + height, col..col + width, out.as_mut())?;
                assert_eq!(out, x.submatrix(row, col, height, width));
            }
        }
    }
    Ok(())
}

/// All kinds of numbers, in both byte orders.
#[test]
fn kinds_of_numbers() -> Outcome {
    let folder = tempfile::tempdir()?;
    let v = [0_i8, 1, -2, 127, -128];
    let positive = || v.iter().map(|x| x.unsigned_abs());
    let kinds = [
        ("f4", true, little(v.into_iter(), |x| f32::from(x).to_le_bytes())),
        ("f8", true, little(v.into_iter(), |x| f64::from(x).to_le_bytes())),
        ("i1", true, little(v.into_iter(), i8::to_le_bytes)),
        ("i2", true, little(v.into_iter(), |x| i16::from(x).to_le_bytes())),
        ("i4", true, little(v.into_iter(), |x| i32::from(x).to_le_bytes())),
        ("i8", true, little(v.into_iter(), |x| i64::from(x).to_le_bytes())),
        ("u1", false, little(positive(), u8::to_le_bytes)),
        ("u2", false, little(positive(), |x| u16::from(x).to_le_bytes())),
        ("u4", false, little(positive(), |x| u32::from(x).to_le_bytes())),
        ("u8", false, little(positive(), |x| u64::from(x).to_le_bytes())),
    ];
    for (name, signed, data) in kinds {
        let expected: Vec<f64> = v.iter().map(|&x| f64::from(x)).collect();
        let expected: Vec<f64> =
            if signed { expected } else { expected.into_iter().map(f64::abs).collect() };
        let size = data.len() / v.len();
        let swapped: Vec<u8> = data.chunks(size).flat_map(|x| x.iter().rev().copied()).collect();
        for (order, data) in [("<", &data), (">", &swapped)] {
            let path =
                file(folder.path(), &npy(&header(&format!("{order}{name}"), false, "(5,)"), data))?;
            assert_eq!(NpyMatrix::open(&path)?.dtype(), name);
            assert_eq!(read_vector(&path)?, expected, "{order}{name}");
        }
    }
    for foreign in ["<c16", "|b1", "|O", "<U4", "<f2", "=f8", "|f8", "", "é8"] {
        let path = file(folder.path(), &npy(&header(foreign, false, "(5,)"), &[0; 40]))?;
        let error = NpyMatrix::open(&path).expect_err(foreign);
        assert!(matches!(error, FormatError::Dtype { .. }), "{foreign}: {error}");
    }
    Ok(())
}

/// Versions 2 and 3 differ in the length of the header's length; keys come in any order.
#[test]
fn versions_of_the_format() -> Outcome {
    let folder = tempfile::tempdir()?;
    let text = b" {\"shape\":(2 , 1),\n'fortran_order':False , 'descr':\t'<f8'} \n";
    let length = u32::try_from(text.len())?.to_le_bytes();
    for version in [2, 3] {
        let first = [b"\x93NUMPY".as_slice(), &[version, 0], &length, text].concat();
        let data = little([1.0, 2.0].into_iter(), f64::to_le_bytes);
        let path = file(folder.path(), &[first, data].concat())?;
        assert_eq!(NpyMatrix::open(&path)?.read()?, mat![[1.0], [2.0]]);
    }
    Ok(())
}

/// The axis that counts snapshots is the first or the last, whatever lies between.
#[test]
fn snapshots_of_several_axes() -> Outcome {
    let folder = tempfile::tempdir()?;
    let data = little((0..24).map(f64::from), f64::to_le_bytes);
    let path = file(folder.path(), &npy(&header("<f8", false, "(2, 3, 4)"), &data))?;
    for (layout, n, m, expected) in [
        (SnapshotLayout::Rows, 12, 2, Mat::from_fn(12, 2, |i, k| (k * 12 + i) as f64)),
        (SnapshotLayout::Columns, 6, 4, Mat::from_fn(6, 4, |i, k| (i * 4 + k) as f64)),
    ] {
        let snapshots = NpySnapshots::open(&path, layout)?;
        assert_eq!((snapshots.dim(), snapshots.times().len()), (n, m));
        let mut x = Mat::zeros(n, m);
        snapshots.block(0..n, 0..m, x.as_mut())?;
        assert_eq!(x, expected);
        let mut part = Mat::zeros(2, 1);
        snapshots.block(3..5, 1..2, part.as_mut())?;
        assert_eq!(part, expected.submatrix(3, 1, 2, 1));
    }
    let fortran = file(folder.path(), &npy(&header("<f8", true, "(2, 3, 4)"), &data))?;
    let error = NpyMatrix::open(&fortran).expect_err("three axes in Fortran order");
    assert!(error.to_string().contains("ascontiguousarray"), "{error}");
    let vector = folder.path().join("vector.npy");
    write_vector(&vector, &[1.0, 2.0])?;
    let error = NpySnapshots::open(&vector, SnapshotLayout::Rows).expect_err("one axis");
    assert!(matches!(error, FormatError::Shape { .. }), "{error}");
    Ok(())
}

/// Whatever the strides of the place that a block goes to, and also where a line of the file is longer
/// than what is read at a time.
#[test]
fn blocks_of_long_lines_and_other_strides() -> Outcome {
    let folder = tempfile::tempdir()?;
    let x = Mat::from_fn(3, 300_000, |i, j| (1000 * j + i) as f64);
    let fortran = folder.path().join("x.npy");
    write_matrix(&fortran, x.transpose())?; // in the file a line is a row of x
    let file = NpyMatrix::open(&fortran)?;
    assert_eq!(file.read()?, x.transpose());
    let mut spread = Mat::zeros(2 * 290_000, 3);
    let whole = MatMut::from_column_major_slice_with_stride_mut(
        spread.col_as_slice_mut(0),
        290_000,
        1,
        290_000,
    );
    file.read_block(5_000..295_000, 1..2, whole)?;
    assert!((0..290_000).all(|j| spread[(j, 0)] == x[(1, 5_000 + j)]));
    let mut wide = Mat::zeros(6, 2_000);
    let mut every_second = wide.as_mut().reverse_rows_mut();
    file.read_block(7..2_007, 0..3, every_second.as_mut().subrows_mut(3, 3).transpose_mut())?;
    assert!((0..2_000).all(|j| wide[(2, j)] == x[(0, 7 + j)] && wide[(0, j)] == x[(2, 7 + j)]));
    assert!((0..2_000).all(|j| wide[(3, j)] == 0.0), "nothing beside the block");
    Ok(())
}

/// A tile of rows for all snapshots, as POD reads it, from files of both orders and layouts.
#[test]
fn tiles_of_snapshots() -> Outcome {
    let folder = tempfile::tempdir()?;
    let (n, m) = (9_001, 37);
    let number = |i: usize, j: usize| ((i * m + j) % 30_011) as f64 - 15_000.0;
    let x = Mat::from_fn(n, m, number);
    let file_of = |outer: usize, inner: usize, at: &dyn Fn(usize, usize) -> f64, big: bool| {
        let numbers = (0..outer * inner).map(|k| at(k / inner, k % inner));
        // These integers are exact in 32 bits.
        #[expect(clippy::cast_possible_truncation)]
        let numbers = numbers.map(|x| x as f32);
        little(numbers, if big { f32::to_be_bytes } else { f32::to_le_bytes })
    };
    let rows = |big| file_of(m, n, &|j, i| number(i, j), big);
    let columns = |big| file_of(n, m, &number, big);
    for (layout, descr, fortran_order, data) in [
        (SnapshotLayout::Rows, "<f4", false, rows(false)),
        (SnapshotLayout::Rows, ">f4", true, columns(true)),
        (SnapshotLayout::Columns, ">f4", false, columns(true)),
        (SnapshotLayout::Columns, "<f4", true, rows(false)),
    ] {
        let shape = if layout == SnapshotLayout::Rows { (m, n) } else { (n, m) };
        let text = header(descr, fortran_order, &format!("{shape:?}"));
        let snapshots = NpySnapshots::open(file(folder.path(), &npy(&text, &data))?, layout)?;
        for first in (0..n).step_by(4_000) {
            let last = n.min(first + 4_000);
            let mut tile = Mat::zeros(4_000, m);
            let mut tile = tile.subrows_mut(0, last - first);
            snapshots.block(first..last, 0..m, tile.as_mut())?;
            assert_eq!(tile, x.subrows(first, last - first), "{layout:?}, {descr}");
        }
    }
    Ok(())
}

/// Times are one for each snapshot, finite and increasing.
#[test]
fn times_are_checked() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("x.npy");
    write_matrix(&path, mat![[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]].as_ref())?;
    let with = |times| NpySnapshots::open(&path, SnapshotLayout::Rows)?.with_times(times);
    assert_eq!(with(vec![0.0, 0.5, 2.0])?.times(), [0.0, 0.5, 2.0]);
    let error = with(vec![0.0, 0.5]).expect_err("too few");
    assert!(matches!(error, FormatError::TimeCount { snapshots: 3, times: 2, .. }), "{error}");
    for times in [vec![0.0, 0.0, 1.0], vec![0.0, f64::NAN, 1.0], vec![0.0, f64::INFINITY, 1.0]] {
        let error = with(times).expect_err("out of order");
        assert!(matches!(error, FormatError::TimeOrder { snapshot: 1, .. }), "{error}");
    }
    let error = read_vector(&path).expect_err("a matrix");
    assert!(matches!(error, FormatError::Shape { .. }), "{error}");
    Ok(())
}
