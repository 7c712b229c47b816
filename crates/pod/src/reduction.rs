//! Sums over rows: leaves of rows, computed by any number of threads and ranks, merged over one fixed
//! tree, and kept on the way.

use crate::PodError;
use crate::agreement::{Failure, decode, encode, from_first};
use crate::execution::{Execution, Pass};
use crate::partial::{Partial, integer};
use crate::partition::{Partition, full_subtree, middle, owner, share};
use crate::ranks::broadcast;
use faer::Par;
use std::num::NonZeroUsize;
use std::ops::Range;

/// How a sum is taken: over which leaves, by whom, how many leaves at a time.
#[derive(Clone, Copy)]
pub(crate) struct Reduction<'a> {
    pub partition: Partition,
    pub execution: Execution<'a>,
    pub par: Par,
    /// Leaves after which progress is told and a journal may be written; a power of two.
    pub group: usize,
}

/// The rows of a leaf give what they contribute.
pub(crate) type Part<'a> = dyn Fn(Range<usize>) -> Result<Partial, PodError> + Sync + 'a;

/// What came of some leaves: an error travels the tree as a sum does, so that no rank waits for one
/// that failed.
type Outcome = Result<Partial, Failure>;

/// A full subtree of leaves and its sum.
struct Node {
    first: usize,
    size: usize,
    sum: Partial,
}

impl Reduction<'_> {
    /// Sums `part` of every leaf, in an order that depends on the partition alone. `before_save` is
    /// called before a journal counts on what the parts have done besides.
    ///
    /// # Errors
    /// On a rank that failed its own failure; on the others [`PodError::Elsewhere`] with the first in the
    /// order of the rows.
    pub fn sum(
        &self,
        pass: &Pass,
        part: &Part<'_>,
        before_save: &dyn Fn() -> Result<(), PodError>,
    ) -> Result<Partial, PodError> {
        let Execution { ranks, journal, .. } = self.execution;
        let entry = format!("{}-{}", pass.number, pass.name);
        let known = from_first(
            ranks,
            || Ok(journal.load(&entry)?.unwrap_or_default()),
            |error: &PodError| Failure::new(ranks.rank(), error),
        )?;
        if let Some(sum) = Partial::decode(&mut known.as_slice()) {
            return Ok(sum);
        }
        let own = self.own_leaves(pass, &entry, part, before_save);
        let mut nodes = match &own {
            Ok(nodes) => Ok(nodes.iter()),
            Err(error) => Err(Failure::new(ranks.rank(), error)),
        };
        let mut outcome = self.merge_tree(0..self.partition.leaves(), &mut nodes);
        let mut unsaved = None;
        if let Some(Ok(sum)) = &outcome
            && let Err(error) = journal.save(&entry, &encoded(sum))
        {
            let error = PodError::from(error);
            outcome = Some(Err(Failure::new(ranks.rank(), &error)));
            unsaved = Some(error);
        }
        let told = broadcast(ranks, outcome.map(message).unwrap_or_default());
        match (heard(&told), own, unsaved) {
            (Ok(sum), ..) => Ok(sum),
            (Err(_), Err(error), _) | (Err(_), _, Some(error)) => Err(error),
            (Err(failure), ..) => Err(PodError::Elsewhere(failure)),
        }
    }

    /// Sums of the full subtrees that this rank's leaves make, in their order.
    fn own_leaves(
        &self,
        pass: &Pass,
        entry: &str,
        part: &Part<'_>,
        before_save: &dyn Fn() -> Result<(), PodError>,
    ) -> Result<Vec<Node>, PodError> {
        let Execution { ranks, journal, watch } = self.execution;
        let partition = self.partition;
        let mine = share(partition.leaves(), ranks.rank(), ranks.count());
        let entry = format!("{entry}-{}-of-{}", ranks.rank(), ranks.count());
        let kept = journal.load(&entry)?.unwrap_or_default();
        let mut nodes = decode_nodes(&kept);
        let mut next = nodes.last().map_or(mine.start, |node| node.first + node.size);
        let done = |next| partition.rows_of(mine.start..next).len();
        watch.begin(pass, done(next));
        while next < mine.end {
            let size = full_subtree(next, mine.end, self.group);
            let leaves = next..next + size;
            let sum = subtree(leaves, self.par, &|leaf| part(partition.leaf(leaf)))?;
            push(&mut nodes, Node { first: next, size, sum });
            next += size;
            watch.advance(pass, done(next));
            if next < mine.end && journal.is_due() {
                before_save()?;
                journal.save(&entry, &encode_nodes(&nodes))?;
            }
        }
        before_save()?;
        Ok(nodes)
    }

    /// The sum over a node of the tree, on the rank that owns its first leaf. The sends of all ranks
    /// go up the tree: none waits for a rank that waits for it.
    fn merge_tree<'n>(
        &self,
        node: Range<usize>,
        own: &mut Result<impl Iterator<Item = &'n Node> + Clone, Failure>,
    ) -> Option<Outcome> {
        let (leaves, ranks) = (self.partition.leaves(), self.execution.ranks);
        let mine = share(leaves, ranks.rank(), ranks.count());
        if node.start >= mine.end || node.end <= mine.start {
            return None;
        }
        let whole = mine.start <= node.start && node.end <= mine.end;
        match own {
            Err(failure) if whole => return Some(Err(failure.clone())),
            Ok(nodes) if whole && nodes.clone().next().is_some_and(|n| n.size == node.len()) => {
                return nodes.next().map(|node| Ok(node.sum.clone()));
            }
            _ => {}
        }
        let at = middle(&node);
        let above = self.merge_tree(node.start..at, own);
        let below = self.merge_tree(at..node.end, own);
        let owner_of = |leaf| owner(leaf, leaves, ranks.count());
        let (upper, lower) = (owner_of(node.start), owner_of(at));
        if upper != ranks.rank() {
            if lower == ranks.rank() {
                ranks.send(upper, &message(below.expect("its owner has it")));
            }
            return None;
        }
        let below = below.unwrap_or_else(|| heard(&ranks.receive(lower)));
        let above = above.expect("its owner has it");
        Some(above.and_then(|above| Ok(above.merge(&below?))))
    }
}

/// The sum over a full subtree on this machine.
fn subtree(
    leaves: Range<usize>,
    par: Par,
    part: &(impl Fn(usize) -> Result<Partial, PodError> + Sync),
) -> Result<Partial, PodError> {
    if leaves.len() == 1 {
        return part(leaves.start);
    }
    let at = middle(&leaves);
    let (above, below) = join(
        par,
        |par| subtree(leaves.start..at, par, part),
        |par| subtree(at..leaves.end, par, part),
    );
    Ok(above?.merge(&below?))
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

/// Appends a subtree and merges it with its neighbour while both are halves of a larger one.
fn push(nodes: &mut Vec<Node>, mut last: Node) {
    while let Some(before) = nodes.pop_if(|n| n.size == last.size && n.first % (2 * n.size) == 0) {
        let sum = before.sum.merge(&last.sum);
        last = Node { first: before.first, size: 2 * before.size, sum };
    }
    nodes.push(last);
}

fn encoded(sum: &Partial) -> Vec<u8> {
    let mut bytes = Vec::new();
    sum.encode(&mut bytes);
    bytes
}

fn message(outcome: Outcome) -> Vec<u8> {
    match outcome {
        Ok(sum) => encode(Ok(&encoded(&sum))),
        Err(failure) => encode(Err(failure)),
    }
}

fn heard(message: &[u8]) -> Outcome {
    let mut payload = decode(message)?;
    Ok(Partial::decode(&mut payload).expect("ranks send whole sums"))
}

fn encode_nodes(nodes: &[Node]) -> Vec<u8> {
    let mut bytes = Vec::new();
    for node in nodes {
        bytes.extend([node.first, node.size].map(|k| (k as u64).to_le_bytes()).concat());
        node.sum.encode(&mut bytes);
    }
    bytes
}

fn decode_nodes(mut bytes: &[u8]) -> Vec<Node> {
    let node = || {
        let (first, size) = (integer(&mut bytes)?, integer(&mut bytes)?);
        Some(Node { first, size, sum: Partial::decode(&mut bytes)? })
    };
    std::iter::from_fn(node).collect()
}
