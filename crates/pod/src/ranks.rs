/// The processes that share a decomposition: the one seam by which POD meets other machines.
///
/// Each process runs the same algorithm on the rows that it owns; all of them meet in the sums over
/// rows. Only the thread that entered the algorithm sends and receives. A child of the tree of sums
/// sends to its parent, then rank 0 passes the result on: no two ranks ever wait for each other, also
/// where sending waits for the receiver.
///
/// ```
/// use lumley_pod::{Alone, Ranks};
/// assert_eq!((Alone.rank(), Alone.count()), (0, 1));
/// ```
pub trait Ranks {
    /// Number of this process, from 0.
    fn rank(&self) -> usize;
    /// Number of processes, at least 1.
    fn count(&self) -> usize;
    /// Sends a message; messages between two ranks keep their order.
    fn send(&self, to: usize, message: &[u8]);
    /// The next message of a rank.
    fn receive(&self, from: usize) -> Vec<u8>;
}

/// A process without others.
///
/// ```
/// use lumley_pod::{Alone, Ranks};
/// assert_eq!(Alone.count(), 1);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Alone;

impl Ranks for Alone {
    fn rank(&self) -> usize {
        0
    }

    fn count(&self) -> usize {
        1
    }

    fn send(&self, to: usize, _message: &[u8]) {
        unreachable!("a process alone sends to rank {to}")
    }

    fn receive(&self, from: usize) -> Vec<u8> {
        unreachable!("a process alone receives from rank {from}")
    }
}

/// Gives every rank the message of rank 0, along a binomial tree.
pub(crate) fn broadcast(ranks: &dyn Ranks, message: Vec<u8>) -> Vec<u8> {
    let (rank, count) = (ranks.rank(), ranks.count());
    // A rank hears from the one that differs in its highest bit, and tells those above that bit.
    let message = match rank.checked_ilog2() {
        None => message,
        Some(bit) => ranks.receive(rank - (1 << bit)),
    };
    let first = rank.checked_ilog2().map_or(0, |bit| bit + 1);
    // The far ones first: they have the most to tell.
    let bits = usize::BITS - count.leading_zeros();
    for bit in (first..bits).rev() {
        let to = rank + (1_usize << bit);
        if to < count {
            ranks.send(to, &message);
        }
    }
    message
}
