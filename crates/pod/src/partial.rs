use crate::contiguous::columns;
use faer::{MatMut, MatRef};

/// An entry this many times another is larger than it, and not by round-off.
const CLEARLY: f64 = 1.0 + 1e-6;

/// Rows among which an extreme is sought at once; blocks are multiples of it.
const RUN: usize = 512;

/// What a set of rows contributes to a pass: sums over the rows, and an entry of largest magnitude
/// of each column.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Partial {
    pub sums: Vec<f64>,
    pub extremes: Vec<f64>,
}

impl Partial {
    pub fn zeros(sums: usize, extremes: usize) -> Self {
        Self { sums: vec![0.0; sums], extremes: vec![0.0; extremes] }
    }

    /// The contribution of these rows and of those below them.
    pub fn merge(mut self, below: &Self) -> Self {
        self.sums.iter_mut().zip(&below.sums).for_each(|(a, b)| *a += b);
        self.extremes.iter_mut().zip(&below.extremes).for_each(|(a, b)| *a = extreme(*a, *b));
        self
    }

    /// Some rows of the columns whose extremes are sought.
    pub fn add_extremes(&mut self, rows: MatRef<'_, f64>) {
        for (extreme, column) in self.extremes.iter_mut().zip(columns(rows)) {
            *extreme = extreme_of(*extreme, column);
        }
    }

    /// The first of the sums as a matrix.
    pub fn matrix(&self, rows: usize, columns: usize) -> MatRef<'_, f64> {
        MatRef::from_column_major_slice(&self.sums[..rows * columns], rows, columns)
    }

    /// The first of the sums as a matrix.
    pub fn matrix_mut(&mut self, rows: usize, columns: usize) -> MatMut<'_, f64> {
        MatMut::from_column_major_slice_mut(&mut self.sums[..rows * columns], rows, columns)
    }

    /// Bytes that [`decode`](Self::decode) reads.
    pub fn encode(&self, out: &mut Vec<u8>) {
        for numbers in [&self.sums, &self.extremes] {
            out.extend((numbers.len() as u64).to_le_bytes());
            out.extend(numbers.iter().flat_map(|x| x.to_le_bytes()));
        }
    }

    /// Takes a contribution from the front of `bytes`; nothing where there is none.
    pub fn decode(bytes: &mut &[u8]) -> Option<Self> {
        Some(Self { sums: numbers(bytes)?, extremes: numbers(bytes)? })
    }
}

/// Of two entries the one of larger magnitude; the first where they differ by less than 1e-6, so that
/// round-off does not decide between equal entries of opposite sign.
pub(crate) fn extreme(first: f64, second: f64) -> f64 {
    if second.abs() > first.abs() * CLEARLY { second } else { first }
}

/// The extreme of an entry and those of a column: of entries that differ by less than 1e-6 the first in
/// each run of rows, which are the same wherever a column is cut between runs.
pub(crate) fn extreme_of(first: f64, column: &[f64]) -> f64 {
    column.chunks(RUN).fold(first, |found, run| {
        let largest = largest_of(run);
        if extreme(found, largest) == found {
            return found;
        }
        run.iter().copied().find(|x| x.abs() * CLEARLY >= largest).unwrap_or(found)
    })
}

/// The largest magnitude, by eight maxima that do not wait for each other.
fn largest_of(run: &[f64]) -> f64 {
    let (eights, rest) = run.as_chunks::<8>();
    let mut largest = [0.0_f64; 8];
    for eight in eights {
        for (largest, x) in largest.iter_mut().zip(eight) {
            *largest = if x.abs() > *largest { x.abs() } else { *largest };
        }
    }
    largest.iter().chain(rest).fold(0.0, |a, b| a.max(b.abs()))
}

/// Takes an integer from the front of `bytes`.
pub(crate) fn integer(bytes: &mut &[u8]) -> Option<usize> {
    let (first, rest) = bytes.split_first_chunk::<8>()?;
    *bytes = rest;
    usize::try_from(u64::from_le_bytes(*first)).ok()
}

fn numbers(bytes: &mut &[u8]) -> Option<Vec<f64>> {
    let count = integer(bytes)?;
    let (mine, rest) = bytes.split_at_checked(count.checked_mul(8)?)?;
    *bytes = rest;
    Some(mine.as_chunks().0.iter().map(|&number| f64::from_le_bytes(number)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read() {
        let partial = Partial { sums: vec![1.5, -2.0], extremes: vec![f64::MIN_POSITIVE] };
        let mut bytes = Vec::new();
        partial.encode(&mut bytes);
        bytes.extend(b"rest");
        let mut rest = bytes.as_slice();
        assert_eq!(Partial::decode(&mut rest), Some(partial));
        assert_eq!(rest, b"rest");
        for length in 0..bytes.len() - 4 {
            assert_eq!(Partial::decode(&mut &bytes[..length]), None, "{length} bytes");
        }
        assert_eq!(Partial::decode(&mut [0xFF; 16].as_slice()), None, "a claimed length of 2^64");
    }

    #[test]
    fn equal_entries_of_opposite_sign_do_not_fight() {
        assert_eq!(extreme(1.0, -1.0 - 1e-9), 1.0);
        assert_eq!(extreme(1.0, -1.1), -1.1);
        assert_eq!(extreme(0.0, -1e-300), -1e-300);
    }
}
