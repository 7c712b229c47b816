use crate::PodError;
use crate::partition::Partition;

/// How much is held at a time, within the memory that may be taken. It changes no bit of the result.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Plan {
    /// Rows that are read at a time: whole blocks.
    pub tile: usize,
    /// Leaves that are summed before the next ones are begun: a power of two.
    pub group: usize,
}

/// What a decomposition must hold.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Demand {
    pub partition: Partition,
    pub snapshots: usize,
    /// Modes that are made at most.
    pub modes: usize,
    /// Numbers in one sum over the rows.
    pub sum: usize,
    pub threads: usize,
    /// Rows after a block that its factor needs.
    pub reach: usize,
    /// Bytes that one read should have.
    pub read: usize,
}

impl Plan {
    /// The largest steps that fit into `limit` bytes.
    pub fn new(demand: &Demand, limit: u64) -> Result<Self, PodError> {
        // Whole pieces, so that the rows after a piece do not depend on the tile.
        let piece = demand.partition.piece(demand.reach);
        let wanted = (demand.read / (8 * demand.snapshots)).next_multiple_of(piece).max(piece);
        let tiles = std::iter::successors(Some(wanted), |tile| {
            (*tile > piece).then(|| (tile / 2).next_multiple_of(piece))
        });
        // Enough groups for a journal to be worth while, enough leaves in each to share.
        let threads = demand.threads.next_power_of_two();
        let leaves = demand.partition.leaves() / 16;
        let shares = [32, 16, 8, 4, 2, 1].map(|share| share * threads);
        let few = shares.into_iter().filter(|group| *group <= leaves.max(4 * threads));
        let mut plans = tiles.flat_map(|tile| few.clone().map(move |group| Self { tile, group }));
        let fits = |plan: &Self| plan.bytes(demand) <= u128::from(limit);
        plans.find(fits).ok_or_else(|| PodError::Memory {
            what: "the correlation of the snapshots, block by block",
            bytes: Self { tile: piece, group: threads }.bytes(demand),
            limit,
            remedy: "raise the limit, take fewer threads or fewer snapshots, or one of the approximations",
        })
    }

    /// Bytes held at once: tiles, what is made of them and their sums for each thread, sums on their way up
    /// the tree and twice more where a journal keeps them, and the dense problems of the size of a sum.
    fn bytes(self, demand: &Demand) -> u128 {
        const DENSE: usize = 8;
        let Demand { partition, snapshots, modes, sum, threads, reach, .. } = *demand;
        let sum = 8 * sum as u128;
        let [tile, piece] =
            [self.tile, partition.piece(reach)].map(|rows| rows.min(partition.rows()) + reach);
        let snapshots = 8 * (tile + piece) as u128 * snapshots as u128;
        let modes = 8 * (tile + 2 * piece) as u128 * (modes as u128 + 1);
        let depth = |leaves: usize| u128::from(leaves.max(1).ilog2()) + 2;
        let of_thread = snapshots + modes + depth(self.group / threads) * sum;
        let tree = 3 * depth(partition.leaves().div_ceil(self.group));
        threads as u128 * of_thread + (tree + DENSE as u128) * sum
    }
}

/// What is left of the `limit` beside so many bytes.
pub(crate) fn memory_left(
    limit: u64,
    bytes: u128,
    what: &'static str,
    remedy: &'static str,
) -> Result<u64, PodError> {
    let left = u64::try_from(bytes).ok().and_then(|bytes| limit.checked_sub(bytes));
    left.ok_or(PodError::Memory { what, bytes, limit, remedy })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn demand(threads: usize) -> Demand {
        let partition = Partition::new(1_000_000, 200);
        Demand {
            partition,
            snapshots: 200,
            modes: 20,
            sum: 200 * 200,
            threads,
            reach: 0,
            read: 16 << 20,
        }
    }

    #[test]
    fn less_memory_makes_smaller_steps_until_there_is_none() {
        let wide = Plan::new(&demand(2), 1 << 32).expect("plenty");
        let tight = Plan::new(&demand(2), 20 << 20).expect("enough");
        assert!(tight.tile < wide.tile, "{tight:?} {wide:?}");
        assert!(tight.bytes(&demand(2)) <= 20 << 20);
        let error = Plan::new(&demand(2), 1 << 20);
        assert!(matches!(error, Err(PodError::Memory { limit: 1_048_576, .. })), "{error:?}");
    }

    #[test]
    fn tiles_are_whole_blocks_and_groups_full_subtrees() {
        for threads in 1..5 {
            let plan = Plan::new(&demand(threads), 1 << 30).expect("plenty");
            assert_eq!(plan.tile % demand(threads).partition.block(), 0);
            assert!(plan.group.is_power_of_two() && plan.group >= threads);
        }
    }
}
