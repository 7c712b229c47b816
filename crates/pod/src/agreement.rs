//! What ranks tell each other besides sums: one finds something out for all, and a failure of one is
//! a failure of all.

use crate::partial::integer;
use crate::ranks::broadcast;
use crate::{PodError, Ranks};
use std::fmt;

/// What went wrong on one rank, as the others hear of it.
///
/// ```
/// use lumley_pod::{Failure, PodError};
/// let failure = Failure::new(3, &PodError::NoModes);
/// assert_eq!(failure.to_string(), "rank 3: 0 modes were asked for: ask for at least 1");
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Failure {
    /// The rank, from 0.
    pub rank: usize,
    /// What it says.
    pub message: String,
    /// Whether the computation failed and not its input or the medium.
    pub of_computation: bool,
}

impl Failure {
    /// The failure of `rank`.
    pub fn new(rank: usize, error: &PodError) -> Self {
        match error {
            PodError::Elsewhere(failure) => failure.clone(),
            error => {
                Self { rank, message: error.to_string(), of_computation: error.is_of_computation() }
            }
        }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "rank {}: {}", self.rank, self.message)
    }
}

/// A message that tells what came of something.
pub(crate) fn encode(outcome: Result<&[u8], Failure>) -> Vec<u8> {
    match outcome {
        Ok(payload) => [&[0], payload].concat(),
        Err(failure) => {
            let kind = [1, u8::from(failure.of_computation)];
            let rank = (failure.rank as u64).to_le_bytes();
            [&kind, rank.as_slice(), failure.message.as_bytes()].concat()
        }
    }
}

/// What [`encode`] told.
pub(crate) fn decode(message: &[u8]) -> Result<&[u8], Failure> {
    match message {
        [0, payload @ ..] => Ok(payload),
        [1, of_computation, rest @ ..] => {
            let mut rest = rest;
            let rank = integer(&mut rest).expect("ranks send whole messages");
            let message = String::from_utf8_lossy(rest).into_owned();
            Err(Failure { rank, message, of_computation: *of_computation == 1 })
        }
        _ => unreachable!("ranks send whole messages"),
    }
}

/// What every rank has, if all have it: [`all_or_none`] for what decompositions do.
pub(crate) fn together<T>(ranks: &dyn Ranks, mine: Result<T, PodError>) -> Result<T, PodError> {
    all_or_none(ranks, mine, |error| Failure::new(ranks.rank(), error))
}

/// Gives every rank what rank 0 finds, or its failure. Every rank must call this at the same point.
///
/// * `tell`: what the others hear of a failure
///
/// # Errors
/// The failure itself on rank 0, what is made of a [`Failure`] on the others.
pub fn from_first<E: From<Failure>>(
    ranks: &dyn Ranks,
    find: impl FnOnce() -> Result<Vec<u8>, E>,
    tell: impl Fn(&E) -> Failure,
) -> Result<Vec<u8>, E> {
    if ranks.rank() > 0 {
        let message = broadcast(ranks, Vec::new());
        return decode(&message).map(<[u8]>::to_vec).map_err(E::from);
    }
    let found = find();
    if ranks.count() > 1 {
        broadcast(ranks, encode(found.as_deref().map_err(tell)));
    }
    found
}

/// Whether all ranks may go on: what failed on one of them has failed on all. Every rank must call
/// this at the same point.
///
/// * `tell`: what the others hear of a failure
///
/// # Errors
/// The failure itself on the first rank that has one, what is made of a [`Failure`] on the others.
///
/// # Panics
/// Never: rank 0 always has an outcome of its own.
pub fn all_or_none<T, E: From<Failure>>(
    ranks: &dyn Ranks,
    mine: Result<T, E>,
    tell: impl Fn(&E) -> Failure,
) -> Result<T, E> {
    if ranks.count() == 1 {
        return mine;
    }
    let outcome = encode(mine.as_ref().map(|_| &[][..]).map_err(tell));
    let told = if ranks.rank() > 0 {
        ranks.send(0, &outcome);
        broadcast(ranks, Vec::new())
    } else {
        // All of them are heard, also after the first failure: each sends once.
        let others: Vec<_> = (1..ranks.count()).map(|from| ranks.receive(from)).collect();
        let all = std::iter::once(outcome).chain(others);
        let first = all.reduce(|first, next| if decode(&first).is_err() { first } else { next });
        broadcast(ranks, first.expect("rank 0 has an outcome"))
    };
    match decode(&told) {
        Err(failure) if failure.rank != ranks.rank() => Err(failure.into()),
        _ => mine,
    }
}

/// Numbers that rank 0 finds for all: machines of different make round differently, and no two ranks may
/// decide differently.
pub(crate) fn agreed(
    ranks: &dyn Ranks,
    find: impl FnOnce() -> Result<Vec<f64>, PodError>,
) -> Result<Vec<f64>, PodError> {
    if ranks.count() == 1 {
        return find();
    }
    let told = from_first(
        ranks,
        || Ok(find()?.iter().flat_map(|x| x.to_le_bytes()).collect()),
        |error| Failure::new(0, error),
    )?;
    Ok(told.as_chunks().0.iter().map(|&number| f64::from_le_bytes(number)).collect())
}
