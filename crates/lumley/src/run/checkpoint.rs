use super::Work;
use crate::Error;
use crate::directory::{DirectoryError, Workplace};
use crate::model::Model;
use std::fs;
use std::time::Duration;

/// Where a checkpoint stands in a run directory, until the run is complete.
const CHECKPOINT: &str = "checkpoint";
/// Bytes before the model's own: four numbers of eight bytes.
const HEADER: usize = 32;

/// How far a run had come: the snapshots before it and the work they took.
#[derive(Debug, Clone, Copy)]
pub(super) struct Progressed {
    pub snapshots: usize,
    pub work: Work,
}

/// Writes the state of `model`, whose record is on disk up to here.
pub(super) fn save<M: Model>(
    place: &Workplace,
    model: &M,
    progressed: &Progressed,
) -> Result<(), Error> {
    let Progressed { snapshots, work } = progressed;
    let nanoseconds = u64::try_from(work.time.as_nanos()).unwrap_or(u64::MAX);
    let counts = [*snapshots as u64, work.steps as u64, work.iterations as u64, nanoseconds];
    let mut bytes: Vec<u8> = counts.iter().flat_map(|count| count.to_le_bytes()).collect();
    let path = place.path().join(CHECKPOINT);
    let failed = |source| DirectoryError::Io { action: "write", path, source };
    model.save(&mut bytes).map_err(failed)?;
    Ok(place.write(CHECKPOINT, &bytes)?)
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
    let (header, mut state) =
        bytes.split_at_checked(HEADER).ok_or_else(|| damaged("it is too short".into()))?;
    let number = |k: usize| {
        let bytes = header[8 * k..][..8].try_into().expect("eight bytes");
        u64::from_le_bytes(bytes)
    };
    let count = |k: usize| {
        let count = usize::try_from(number(k)).ok();
        count.ok_or_else(|| damaged(format!("it counts {}", number(k))))
    };
    let time = Duration::from_nanos(number(3));
    let work = Work { steps: count(1)?, iterations: count(2)?, time };
    model.restore(&mut state).map_err(|e| damaged(e.to_string()))?;
    Ok(Some(Progressed { snapshots: count(0)?, work }))
}

/// Removes the checkpoint of a run that is complete.
pub(super) fn remove(place: &Workplace) -> Result<(), Error> {
    let path = place.path().join(CHECKPOINT);
    if path.exists() {
        let failed = |source| DirectoryError::Io { action: "remove", path: path.clone(), source };
        fs::remove_file(&path).map_err(failed)?;
    }
    Ok(())
}
