//! Sums over rows: blocks of rows, computed by any number of threads and merged over one fixed tree.

use faer::Par;
use std::num::NonZeroUsize;
use std::ops::Range;

/// The fixed partition of `0..rows` into blocks of `size` rows; the last may be shorter.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Blocks {
    rows: usize,
    size: usize,
}

impl Blocks {
    /// Blocks that fit the second-level cache beside the product they enter.
    pub fn for_products(rows: usize, columns: usize) -> Self {
        const CACHED: usize = (1 << 20) / size_of::<f64>();
        Self { rows, size: (CACHED / columns.max(1)).clamp(256, 8192) }
    }

    /// Blocks tall enough that merging their triangular factors costs little.
    pub fn for_factors(rows: usize, columns: usize) -> Self {
        Self { rows, size: (8 * columns).max(2048) }
    }

    pub fn count(self) -> usize {
        self.rows.div_ceil(self.size)
    }

    pub fn rows(self, block: usize) -> Range<usize> {
        let first = block * self.size;
        first..(first + self.size).min(self.rows)
    }

    /// Sums `part` of every block with `merge`, in an order that depends on the partition alone.
    ///
    /// # Panics
    /// If there are no rows.
    pub fn reduce<T: Send, E: Send>(
        self,
        par: Par,
        part: &(impl Fn(Range<usize>) -> Result<T, E> + Sync),
        merge: &(impl Fn(T, T) -> T + Sync),
    ) -> Result<T, E> {
        assert!(self.rows > 0, "a sum over no rows");
        tree(0..self.count(), par, &|block| part(self.rows(block)), merge)
    }
}

/// The left subtree takes the largest power of two of blocks, so that its shape does not change
/// when rows are appended.
fn tree<T: Send, E: Send>(
    blocks: Range<usize>,
    par: Par,
    part: &(impl Fn(usize) -> Result<T, E> + Sync),
    merge: &(impl Fn(T, T) -> T + Sync),
) -> Result<T, E> {
    if blocks.len() == 1 {
        return part(blocks.start);
    }
    let middle = blocks.start + blocks.len().next_power_of_two() / 2;
    let (left, right) = join(
        par,
        |par| tree(blocks.start..middle, par, part, merge),
        |par| tree(middle..blocks.end, par, part, merge),
    );
    Ok(merge(left?, right?))
}

/// Does both, side by side when there are threads for it; each side gets its share of them.
pub(crate) fn join<A: Send, B: Send>(
    par: Par,
    a: impl FnOnce(Par) -> A + Send,
    b: impl FnOnce(Par) -> B + Send,
) -> (A, B) {
    match par {
        Par::Rayon(threads) if threads.get() > 1 => {
            let half = threads.get() / 2;
            let share = |k| NonZeroUsize::new(k).map_or(Par::Seq, Par::Rayon);
            rayon::join(|| a(share(threads.get() - half)), || b(share(half)))
        }
        _ => (a(Par::Seq), b(Par::Seq)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tree_does_not_depend_on_threads() {
        for rows in [1, 5, 6, 31, 40] {
            let blocks = Blocks { rows, size: 6 };
            let show = |par| {
                let part = |r: Range<usize>| Ok::<_, ()>(format!("{}-{}", r.start, r.end));
                blocks.reduce(par, &part, &|a, b| format!("({a} {b})"))
            };
            assert_eq!(show(Par::Seq), show(Par::rayon(3)));
        }
        let blocks = Blocks { rows: 31, size: 6 };
        let part = |r: Range<usize>| Ok::<_, ()>(r.start.to_string());
        let order = blocks.reduce(Par::rayon(4), &part, &|a, b| format!("({a} {b})"));
        assert_eq!(order, Ok("(((0 6) (12 18)) (24 30))".to_owned()));
    }

    #[test]
    fn the_first_failure_in_order_is_reported() {
        let blocks = Blocks { rows: 40, size: 6 };
        let part = |r: Range<usize>| if r.start < 12 { Ok(()) } else { Err(r.start) };
        assert_eq!(blocks.reduce(Par::rayon(2), &part, &|(), ()| ()), Err(12));
    }
}
