use super::Work;
use crate::Error;
use crate::directory::{DirectoryError, Workplace};
use crate::model::Model;
use std::fs;
use std::time::Duration;

/// Where a checkpoint stands in a run directory, until the run is complete.
const CHECKPOINT: &str = "checkpoint";

/// How far a run had come: the stops before it, the work they took, and how long the tables were that
/// grow with every step.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) struct Progressed {
    pub stops: usize,
    pub work: Work,
    pub lengths: Vec<u64>,
}

impl Progressed {
    /// As numbers of eight bytes: how many lengths there are, then everything.
    fn encode(&self) -> Vec<u8> {
        let Work { steps, iterations, renewals, time } = self.work;
        let nanoseconds = u64::try_from(time.as_nanos()).unwrap_or(u64::MAX);
        let counts = [self.lengths.len(), self.stops, steps, iterations, renewals];
        let counts = counts.into_iter().map(|count| count as u64);
        let numbers = counts.chain([nanoseconds]).chain(self.lengths.iter().copied());
        numbers.flat_map(u64::to_le_bytes).collect()
    }

    /// What [`encode`](Self::encode) wrote, and what comes behind it.
    fn decode(bytes: &[u8]) -> Option<(Self, &[u8])> {
        let (counts, mut rest) = bytes.split_first_chunk::<48>()?;
        let mut counts = counts.as_chunks().0.iter().map(|bytes| u64::from_le_bytes(*bytes));
        let mut count = || usize::try_from(counts.next()?).ok();
        let (lengths, stops) = (count()?, count()?);
        let (steps, iterations, renewals) = (count()?, count()?, count()?);
        let time = Duration::from_nanos(counts.next()?);
        let mut progressed =
            Self { stops, work: Work { steps, iterations, renewals, time }, lengths: Vec::new() };
        for _ in 0..lengths {
            let (length, behind) = rest.split_first_chunk()?;
            progressed.lengths.push(u64::from_le_bytes(*length));
            rest = behind;
        }
        Some((progressed, rest))
    }
}

/// The state of a model in memory, with how far its run had come.
#[derive(Debug, Default)]
pub(super) struct Checkpoint {
    bytes: Vec<u8>,
}

impl Checkpoint {
    /// Takes the place of the checkpoint before, in the same memory.
    pub fn take<M: Model>(&mut self, model: &M, progressed: &Progressed) -> Result<(), Error> {
        self.bytes.clear();
        self.bytes.extend(progressed.encode());
        let failed = |source| {
            let path = CHECKPOINT.into();
            DirectoryError::Io { action: "make", path, source }
        };
        Ok(model.save(&mut self.bytes).map_err(failed)?)
    }

    /// Brings it to the disk; everything that it counts must be there.
    pub fn write(&self, place: &Workplace) -> Result<(), Error> {
        Ok(place.write(CHECKPOINT, &self.bytes)?)
    }
}

/// Restores `model` from the checkpoint of the unfinished run that goes on, if there is one.
pub(super) fn restore<M: Model>(
    place: &Workplace,
    model: &mut M,
) -> Result<Option<Progressed>, Error> {
    let path = place.path().join(CHECKPOINT);
    if !place.resumed() || !path.exists() {
        return Ok(None);
    }
    let failed = |source| DirectoryError::Io { action: "read", path: path.clone(), source };
    let damaged = |message: String| Error::Damaged { path: path.clone(), message };
    let bytes = fs::read(&path).map_err(failed)?;
    let (progressed, mut state) =
        Progressed::decode(&bytes).ok_or_else(|| damaged("it is too short".into()))?;
    model.restore(&mut state).map_err(|e| damaged(e.to_string()))?;
    Ok(Some(progressed))
}

/// Removes the checkpoint of a run that is complete.
pub(super) fn remove(place: &Workplace) -> Result<(), Error> {
    Ok(place.remove(CHECKPOINT)?)
}

#[cfg(test)]
mod tests {
    use super::Progressed;
    use crate::run::Work;
    use std::time::Duration;

    #[test]
    fn what_is_decoded_is_what_was_encoded() {
        let time = Duration::from_nanos(5);
        let work = Work { steps: 2, iterations: 3, renewals: 4, time };
        for lengths in [vec![], vec![6, 7]] {
            let progressed = Progressed { stops: 1, work, lengths };
            let mut bytes = progressed.encode();
            bytes.extend(b"state");
            assert_eq!(Progressed::decode(&bytes), Some((progressed, b"state".as_slice())));
        }
    }

    #[test]
    fn what_is_cut_short_is_refused() {
        let whole = Progressed { lengths: vec![6, 7], ..Progressed::default() }.encode();
        for length in 0..whole.len() {
            assert_eq!(Progressed::decode(&whole[..length]), None);
        }
        assert_eq!(Progressed::decode(&[u8::MAX; 48]), None);
    }
}
