//! Checkpoints: words that say what the state belongs to, the state, and a checksum.

use std::io::{self, Read, Write};

/// Why a checkpoint cannot be taken up.
///
/// ```
/// use lumley_fom::CheckpointError;
/// let error = CheckpointError::Damaged("checksum");
/// assert_eq!(error.to_string(), "the checkpoint is damaged (checksum): start again or take an older one");
/// ```
#[derive(Debug, thiserror::Error)]
pub enum CheckpointError {
    /// The medium failed, or the data end too early.
    #[error("the checkpoint cannot be read: {0}")]
    Io(#[from] io::Error),
    /// The data are not what was written.
    #[error("the checkpoint is damaged ({0}): start again or take an older one")]
    Damaged(&'static str),
    /// The data belong to a model with other parameters, mesh or scheme.
    #[error(
        "the checkpoint belongs to another model, its {0} differs: restore it with the case that wrote it"
    )]
    Mismatch(&'static str),
}

/// What a checkpoint must agree with, by name; the first is its format.
pub(crate) type Identity<'a> = &'a [(&'static str, u64)];

/// Writes the state of the model that this is.
pub(crate) fn write(
    to: &mut dyn Write,
    identity: Identity<'_>,
    state: impl Iterator<Item = f64>,
) -> io::Result<()> {
    let mut words: Vec<u64> = identity.iter().map(|(_, word)| *word).collect();
    words.extend(state.map(f64::to_bits));
    words.push(checksum(&words));
    words.iter().try_for_each(|word| to.write_all(&word.to_le_bytes()))
}

/// Reads the `count` numbers of a state and nothing beyond.
pub(crate) fn read(
    from: &mut dyn Read,
    identity: Identity<'_>,
    count: usize,
) -> Result<Vec<f64>, CheckpointError> {
    let mut words = Vec::new();
    for &(name, own) in identity {
        let word = read_word(from)?;
        if word != own {
            return Err(match name {
                "format" => CheckpointError::Damaged("not a checkpoint of this version"),
                _ => CheckpointError::Mismatch(name),
            });
        }
        words.push(word);
    }
    let header = words.len();
    for _ in 0..count {
        words.push(read_word(from)?);
    }
    if read_word(from)? != checksum(&words) {
        return Err(CheckpointError::Damaged("checksum"));
    }
    let state: Vec<f64> = words[header..].iter().map(|&word| f64::from_bits(word)).collect();
    if !state.iter().all(|value| value.is_finite()) {
        return Err(CheckpointError::Damaged("a value is not finite"));
    }
    Ok(state)
}

fn read_word(from: &mut dyn Read) -> io::Result<u64> {
    let mut bytes = [0; 8];
    from.read_exact(&mut bytes)?;
    Ok(u64::from_le_bytes(bytes))
}

/// Fowler-Noll-Vo hash (FNV-1a, 64 bits) of the words: finds any damage to a single word.
pub(crate) fn checksum(words: &[u64]) -> u64 {
    let mix = |hash: u64, word: &u64| (hash ^ word).wrapping_mul(0x0100_0000_01b3);
    words.iter().fold(0xcbf2_9ce4_8422_2325, mix)
}
