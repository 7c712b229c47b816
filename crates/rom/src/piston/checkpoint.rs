use super::{PistonPhysics, ReducedPiston};
use crate::basis::Basis;
use crate::{Integrator, ModelChoice};
use std::fmt::Debug;
use std::io::{self, Read, Write};

/// First word of every checkpoint: the format and its version.
const MAGIC: u64 = u64::from_le_bytes(*b"lumrom-2");

/// What a checkpoint must agree with: a name and a word for each part of a model.
pub(super) type Identity = Vec<(&'static str, u64)>;

/// The identity of the model that these make.
pub(super) fn identity(
    physics: &PistonPhysics,
    model: &ModelChoice,
    integrator: Integrator,
    basis: &Basis,
) -> Identity {
    vec![
        ("format", MAGIC),
        ("number of modes", basis.modes() as u64),
        ("mean", basis.frozen() as u64),
        ("basis", values_of(basis)),
        ("projection", spelling_of(&model.projection)),
        ("closure", spelling_of(&model.closure)),
        ("integrator", spelling_of(&integrator)),
        ("viscosity", physics.viscosity.to_bits()),
        ("force factor", physics.force_factor.to_bits()),
        ("domain length", physics.domain_length.to_bits()),
        ("mass", physics.joint.mass.to_bits()),
        ("stiffness", physics.joint.stiffness.to_bits()),
        ("damping", physics.joint.damping.to_bits()),
        ("rest length", physics.joint.rest_length.to_bits()),
    ]
}

impl ReducedPiston {
    /// Writes a checkpoint: what a model of the same parameters and modes needs to go on from here, bit
    /// for bit.
    ///
    /// # Errors
    /// The failure of `to`.
    pub fn save(&self, to: &mut dyn Write) -> io::Result<()> {
        let mut words: Vec<u64> = self.identity.iter().map(|(_, word)| *word).collect();
        let scalars = [self.time, self.stepper.suggestion()];
        words.extend(scalars.iter().chain(&self.now.y).map(|value| value.to_bits()));
        words.push(checksum(words.iter().copied()));
        words.iter().try_for_each(|word| to.write_all(&word.to_le_bytes()))
    }

    /// Takes up a checkpoint of a model with the same parameters and modes; what follows is then the
    /// same bit for bit. On an error the model keeps its state.
    ///
    /// # Errors
    /// The failure of `from`; damaged data, or the checkpoint of another model.
    pub fn restore(&mut self, from: &mut dyn Read) -> io::Result<()> {
        let mut words = Vec::with_capacity(self.identity.len() + 2 + self.now.y.len());
        for &(name, own) in &self.identity {
            let word = read_word(from)?;
            if word != own {
                return Err(mismatch(name));
            }
            words.push(word);
        }
        for _ in 0..2 + self.now.y.len() {
            words.push(read_word(from)?);
        }
        if read_word(from)? != checksum(words.iter().copied()) {
            return Err(damaged("checksum"));
        }
        let state: Vec<f64> =
            words[self.identity.len()..].iter().map(|&word| f64::from_bits(word)).collect();
        self.take(&state)
    }

    /// Sets time, step suggestion and unknowns, if they are those of a model that can go on.
    fn take(&mut self, state: &[f64]) -> io::Result<()> {
        let (scalars, y) = state.split_at(2);
        if !state.iter().all(|value| value.is_finite()) {
            return Err(damaged("a value is not finite"));
        }
        if scalars.iter().any(|&value| value < 0.0) {
            return Err(damaged("a time is negative"));
        }
        if y[..self.basis.frozen()].iter().any(|&mean| mean != 1.0) {
            return Err(damaged("the coefficient of the mean is not 1"));
        }
        let position = y[y.len() - 2];
        if !(position > 0.0 && position < self.length) {
            return Err(damaged("the block is outside of the domain"));
        }
        self.time = scalars[0];
        self.stepper.resume(scalars[1]);
        self.now.y.copy_from_slice(y);
        self.evaluate();
        self.publish();
        Ok(())
    }
}

/// A word for the nodes of a basis and the values of its functions there.
fn values_of(basis: &Basis) -> u64 {
    let nodes = basis.nodes().iter();
    let values = (0..basis.nodes().len()).flat_map(|k| basis.row(k));
    checksum(nodes.chain(values).map(|value| value.to_bits()))
}

/// A word for a choice with its parameters, which are spelled so that no bit is lost.
fn spelling_of(choice: &dyn Debug) -> u64 {
    checksum(format!("{choice:?}").bytes().map(u64::from))
}

fn mismatch(name: &str) -> io::Error {
    invalid(match name {
        "format" => "this is not the checkpoint of a reduced model of this version".into(),
        _ => format!(
            "the checkpoint belongs to another reduced model, its {name} differs: restore it with the \
             case that wrote it"
        ),
    })
}

fn damaged(what: &str) -> io::Error {
    invalid(format!(
        "the reduced model's checkpoint is damaged ({what}): start again or take an older one"
    ))
}

fn invalid(message: String) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, message)
}

fn read_word(from: &mut dyn Read) -> io::Result<u64> {
    let mut bytes = [0; 8];
    from.read_exact(&mut bytes)?;
    Ok(u64::from_le_bytes(bytes))
}

/// Fowler-Noll-Vo hash (FNV-1a, 64 bits) of the words: finds any damage to a single word.
fn checksum(words: impl Iterator<Item = u64>) -> u64 {
    words.fold(0xcbf2_9ce4_8422_2325, |hash, word| (hash ^ word).wrapping_mul(0x0100_0000_01b3))
}
