use std::ops::Range;

/// The fixed partition of the rows: what is summed with what depends on it alone, so that the bits
/// of a sum depend on neither threads nor ranks nor memory.
///
/// Rows are cut into leaves, the units of the tree of sums; a leaf is worked through in blocks that
/// stay in the cache.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Partition {
    rows: usize,
    leaf: usize,
    block: usize,
}

impl Partition {
    /// The partition for a matrix of this shape.
    ///
    /// Leaves are few enough that their partial sums cost little and many enough to share.
    pub fn new(rows: usize, columns: usize) -> Self {
        let block = crate::kernel::rows_per_block(columns);
        let leaf = (rows / 16).clamp(1024, 8192).next_multiple_of(block);
        Self { rows, leaf, block }
    }

    /// Number of rows.
    pub fn rows(self) -> usize {
        self.rows
    }

    /// Number of leaves.
    pub fn leaves(self) -> usize {
        self.rows.div_ceil(self.leaf)
    }

    /// The rows of a leaf.
    pub fn leaf(self, index: usize) -> Range<usize> {
        self.rows_of(index..index + 1)
    }

    /// The rows of neighbouring leaves.
    pub fn rows_of(self, leaves: Range<usize>) -> Range<usize> {
        (leaves.start * self.leaf).min(self.rows)..(leaves.end * self.leaf).min(self.rows)
    }

    /// Rows in a block.
    pub fn block(self) -> usize {
        self.block
    }

    /// Rows that are weighted at a time: whole blocks, and enough for what is read after them to be little.
    pub fn piece(self, reach: usize) -> usize {
        (8 * reach).next_multiple_of(self.block).max(self.block)
    }

    /// `rows` in pieces of at most `size`.
    pub fn pieces(rows: Range<usize>, size: usize) -> impl Iterator<Item = Range<usize>> {
        rows.clone().step_by(size).map(move |first| first..(first + size).min(rows.end))
    }
}

/// The leaves of rank `rank` of `count`. The first leaf is always that of rank 0.
pub(crate) fn share(leaves: usize, rank: usize, count: usize) -> Range<usize> {
    let cut = |k: usize| {
        let leaf = (leaves as u128 * k as u128).div_ceil(count as u128);
        usize::try_from(leaf).expect("at most all leaves")
    };
    cut(rank)..cut(rank + 1)
}

/// The rank that owns a leaf.
pub(crate) fn owner(leaf: usize, leaves: usize, count: usize) -> usize {
    usize::try_from(leaf as u128 * count as u128 / leaves as u128).expect("fewer than all ranks")
}

/// Where a node of the tree over `leaves` divides: its left part is the largest power of two, so that
/// the shape of the tree does not change when rows are appended.
pub(crate) fn middle(leaves: &Range<usize>) -> usize {
    leaves.start + leaves.len().next_power_of_two() / 2
}

/// The largest full subtree that begins at `first`, has at most `most` leaves and ends by `end`.
pub(crate) fn full_subtree(first: usize, end: usize, most: usize) -> usize {
    let aligned = if first == 0 { usize::MAX } else { 1 << first.trailing_zeros() };
    let bound = most.min(end - first).min(aligned);
    1 << bound.ilog2()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_leaf_has_one_owner() {
        for (leaves, count) in [(1, 1), (1, 4), (7, 3), (100, 7), (5, 8)] {
            assert!(share(leaves, 0, count).contains(&0));
            let shares: Vec<_> = (0..count).flat_map(|r| share(leaves, r, count)).collect();
            assert_eq!(shares, (0..leaves).collect::<Vec<_>>());
            for leaf in 0..leaves {
                assert!(share(leaves, owner(leaf, leaves, count), count).contains(&leaf));
            }
        }
    }

    #[test]
    fn full_subtrees_are_nodes_of_the_tree() {
        fn nodes(range: Range<usize>, found: &mut Vec<Range<usize>>) {
            if range.len() > 1 {
                let at = middle(&range);
                nodes(range.start..at, found);
                nodes(at..range.end, found);
            }
            found.push(range);
        }
        for leaves in [1, 2, 7, 12, 31] {
            let mut all = Vec::new();
            nodes(0..leaves, &mut all);
            for first in 0..leaves {
                for most in [1, 2, 5, 16] {
                    let size = full_subtree(first, leaves, most);
                    assert!(size <= most && all.contains(&(first..first + size)));
                }
            }
        }
    }
}
