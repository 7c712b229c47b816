use super::ReducedPiston;
use std::io::{self, Read, Write};

/// First bytes of a checkpoint; the digit is its version.
const MAGIC: &[u8; 8] = b"lumrom-1";

impl ReducedPiston {
    /// Writes a checkpoint: time, state and step suggestion, with a checksum.
    ///
    /// # Errors
    /// The failure of `to`.
    pub fn save(&self, to: &mut dyn Write) -> io::Result<()> {
        let mut bytes = MAGIC.to_vec();
        bytes.extend((self.now.y.len() as u64).to_le_bytes());
        for value in [self.time, self.stepper.suggestion()].iter().chain(&self.now.y) {
            bytes.extend(value.to_le_bytes());
        }
        bytes.extend(checksum(&bytes).to_le_bytes());
        to.write_all(&bytes)
    }

    /// Takes up a checkpoint of a model with the same parameters; what follows is then the same bit for
    /// bit. On an error the model keeps its state.
    ///
    /// # Errors
    /// The failure of `from`; damaged data, or the checkpoint of a model of another size.
    pub fn restore(&mut self, from: &mut dyn Read) -> io::Result<()> {
        let size = self.now.y.len();
        let mut bytes = vec![0; MAGIC.len() + 8 * (size + 4)];
        from.read_exact(&mut bytes[..16])?;
        if &bytes[..8] != MAGIC {
            return Err(invalid("this is not the checkpoint of a reduced model".into()));
        }
        let found = u64::from_le_bytes(word(&bytes, 1));
        if found != size as u64 {
            let expected = format!("the checkpoint has {found} unknowns, the model {size}");
            return Err(invalid(expected));
        }
        from.read_exact(&mut bytes[16..])?;
        let (content, sum) = bytes.split_at(bytes.len() - 8);
        if checksum(content).to_le_bytes() != sum {
            return Err(invalid("the checkpoint is damaged: its checksum does not fit".into()));
        }
        let value = |k| f64::from_le_bytes(word(content, k));
        self.time = value(2);
        self.stepper.resume(value(3));
        for (k, y) in self.now.y.iter_mut().enumerate() {
            *y = value(4 + k);
        }
        self.evaluate();
        self.publish();
        Ok(())
    }
}

/// The eight bytes at place `k`.
fn word(bytes: &[u8], k: usize) -> [u8; 8] {
    std::array::from_fn(|i| bytes[8 * k + i])
}

fn invalid(message: String) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, message)
}

/// FNV-1a, 64 bits.
fn checksum(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, &byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}
