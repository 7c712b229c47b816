use super::Scalar;
use super::kernel;
use super::simd::vectorised;
use std::ops::Range;
use thiserror::Error;

/// Why the unknowns of the cells do not make a system.
///
/// ```
/// use lumley_fom::linear::{CellUnknowns, CellUnknownsError};
/// let error = CellUnknowns::new(2, &[vec![0, 2]]).unwrap_err();
/// assert_eq!(error, CellUnknownsError::Range { cell: 0, unknown: 2, count: 2 });
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum CellUnknownsError {
    /// A cell names an unknown that does not exist.
    #[error("cell {cell} names unknown {unknown}, but there are {count} unknowns")]
    Range {
        /// The cell.
        cell: usize,
        /// The unknown that it names.
        unknown: usize,
        /// Number of unknowns.
        count: usize,
    },
    /// A cell names an unknown twice.
    #[error("cell {cell} names unknown {unknown} twice: join the two rows and columns")]
    Repeated {
        /// The cell.
        cell: usize,
        /// The unknown.
        unknown: usize,
    },
    /// An unknown stands in no cell: its row of the matrix is empty.
    #[error("unknown {unknown} stands in no cell: leave it out of the numbering")]
    Unused {
        /// The unknown.
        unknown: usize,
    },
}

/// Which unknowns each cell has: the pattern of a matrix that is the sum of dense cell matrices.
///
/// The matrices themselves lie one after the other in a slice of length
/// [`matrix_len`](Self::matrix_len), each by columns: entry (i, j) of cell c, which has m unknowns, at
/// `matrix(c).start + i + m j`.
///
/// ```
/// use lumley_fom::linear::CellUnknowns;
/// // −u'' on two cells of length one with both ends free.
/// let line = CellUnknowns::new(3, &[vec![0, 1], vec![1, 2]])?;
/// let stiffness = [1.0, -1.0, -1.0, 1.0].repeat(2);
/// let mut y = [0.0; 3];
/// line.multiply(&stiffness, &[0.0, 1.0, 0.0], &mut y);
/// assert_eq!(y, [-1.0, 2.0, -1.0]);
/// # Ok::<(), lumley_fom::linear::CellUnknownsError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CellUnknowns {
    count: usize,
    unknowns: Vec<u32>,
    cells: Vec<usize>,
    matrices: Vec<usize>,
}

impl CellUnknowns {
    /// The unknowns 0..`count` of each cell.
    ///
    /// # Errors
    /// An unknown out of range, twice in one cell, or in no cell.
    ///
    /// # Panics
    /// If there are 2³² unknowns or more.
    pub fn new<C: AsRef<[usize]>>(count: usize, cells: &[C]) -> Result<Self, CellUnknownsError> {
        assert!(u32::try_from(count).is_ok(), "unknowns are numbered in 32 bits");
        let mut this = Self { count, unknowns: Vec::new(), cells: vec![0], matrices: vec![0] };
        let mut seen_in = vec![usize::MAX; count];
        for (cell, unknowns) in cells.iter().map(AsRef::as_ref).enumerate() {
            for &unknown in unknowns {
                let seen = seen_in.get_mut(unknown).ok_or(CellUnknownsError::Range {
                    cell,
                    unknown,
                    count,
                })?;
                if *seen == cell {
                    return Err(CellUnknownsError::Repeated { cell, unknown });
                }
                *seen = cell;
            }
            this.push(unknowns);
        }
        match seen_in.iter().position(|&cell| cell == usize::MAX) {
            Some(unknown) => Err(CellUnknownsError::Unused { unknown }),
            None => Ok(this),
        }
    }

    #[expect(clippy::cast_possible_truncation, reason = "the constructor bounds the number")]
    fn push(&mut self, unknowns: &[usize]) {
        self.unknowns.extend(unknowns.iter().map(|&u| u as u32));
        self.cells.push(self.unknowns.len());
        self.matrices.push(self.matrix_len() + unknowns.len() * unknowns.len());
    }

    /// Number of unknowns.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Number of cells.
    pub fn cells(&self) -> usize {
        self.cells.len() - 1
    }

    /// The unknowns of a cell.
    pub fn of(&self, cell: usize) -> &[u32] {
        &self.unknowns[self.of_range(cell)]
    }

    pub(super) fn of_range(&self, cell: usize) -> Range<usize> {
        self.cells[cell]..self.cells[cell + 1]
    }

    /// Where the matrix of a cell lies among the matrices of all.
    pub fn matrix(&self, cell: usize) -> Range<usize> {
        self.matrices[cell]..self.matrices[cell + 1]
    }

    /// Number of entries of all cell matrices together.
    pub fn matrix_len(&self) -> usize {
        self.matrices[self.matrices.len() - 1]
    }

    /// `y ← A x`, cell by cell in their order.
    ///
    /// # Panics
    /// If a slice has the wrong length.
    pub fn multiply<T: Scalar>(&self, matrices: &[T], x: &[T], y: &mut [T]) {
        assert_eq!(matrices.len(), self.matrix_len(), "the matrices of all cells");
        assert_eq!([x.len(), y.len()], [self.count; 2], "one entry for each unknown");
        y.fill(T::default());
        vectorised(
            #[inline(always)]
            || {
                for cell in 0..self.cells() {
                    kernel::add_cell_product(self.of(cell), &matrices[self.matrices[cell]..], x, y);
                }
            },
        );
    }
}
