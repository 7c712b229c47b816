use std::io;

/// Where a decomposition keeps what it has so far, so that a killed one goes on where it was.
///
/// Entries are whole: [`load`](Self::load) gives what the last completed [`save`](Self::save) of that
/// name was given, or nothing. They belong to one decomposition of one set of snapshots: whoever
/// hands over a journal sees to that.
///
/// ```
/// use lumley_pod::{Journal, NoJournal};
/// NoJournal.save("correlation", b"...")?;
/// assert_eq!(NoJournal.load("correlation")?, None);
/// # Ok::<(), std::io::Error>(())
/// ```
pub trait Journal {
    /// The entry of this name, if there is one.
    ///
    /// # Errors
    /// The failure of the medium, or a damaged entry.
    fn load(&self, name: &str) -> io::Result<Option<Vec<u8>>>;
    /// Replaces the entry of this name, all or nothing.
    ///
    /// # Errors
    /// The failure of the medium.
    fn save(&self, name: &str, entry: &[u8]) -> io::Result<()>;
    /// Whether the work since the last save is worth another one.
    fn is_due(&self) -> bool;
}

/// Keeps nothing.
///
/// ```
/// use lumley_pod::{Journal, NoJournal};
/// assert!(!NoJournal.is_due());
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NoJournal;

impl Journal for NoJournal {
    fn load(&self, _name: &str) -> io::Result<Option<Vec<u8>>> {
        Ok(None)
    }

    fn save(&self, _name: &str, _entry: &[u8]) -> io::Result<()> {
        Ok(())
    }

    fn is_due(&self) -> bool {
        false
    }
}
