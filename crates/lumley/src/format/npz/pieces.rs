use super::crc32::joined;
use std::collections::BTreeMap;

/// Checksums of the pieces of an array that are written so far, neighbours joined: few, however many
/// pieces there were.
#[derive(Debug, Default)]
pub(super) struct Pieces {
    by_place: BTreeMap<u64, Piece>,
}

#[derive(Debug, Clone, Copy)]
struct Piece {
    length: u64,
    crc: u32,
}

/// Bytes of a piece in a message: place, length and checksum.
const MESSAGE: usize = 8 + 8 + 4;

impl Pieces {
    /// Adds `length` bytes with the checksum `crc` that stand at `place` of the array.
    pub fn add(&mut self, mut place: u64, length: u64, crc: u32) {
        let mut piece = Piece { length, crc };
        let before = self.by_place.range(..place).next_back();
        let before = before.map(|(at, before)| (*at, *before));
        if let Some((at, before)) = before.filter(|(at, before)| at + before.length == place) {
            self.by_place.remove(&at);
            (place, piece) = (at, before.followed_by(piece));
        }
        if let Some(after) = self.by_place.remove(&(place + piece.length)) {
            piece = piece.followed_by(after);
        }
        self.by_place.insert(place, piece);
    }

    /// Adds the pieces that another process wrote and tells of by [`to_bytes`](Self::to_bytes).
    pub fn add_told(&mut self, told: &[u8]) {
        let (pieces, rest) = told.as_chunks::<MESSAGE>();
        assert!(rest.is_empty(), "ranks send whole messages");
        for piece in pieces {
            let (place, rest) = piece.split_first_chunk().expect("as long as a message");
            let (length, crc) = rest.split_first_chunk().expect("as long as a message");
            let crc = u32::from_le_bytes(crc.try_into().expect("as long as a message"));
            self.add(u64::from_le_bytes(*place), u64::from_le_bytes(*length), crc);
        }
    }

    pub fn to_bytes(&self) -> Vec<u8> {
        let told = |(place, piece): (&u64, &Piece)| {
            let mut bytes = [place.to_le_bytes(), piece.length.to_le_bytes()].concat();
            bytes.extend(piece.crc.to_le_bytes());
            bytes
        };
        self.by_place.iter().flat_map(told).collect()
    }

    /// The checksum of the `length` bytes of the array behind others whose checksum is `crc`.
    ///
    /// # Panics
    /// If bytes are missing or were written twice.
    pub fn whole(&self, crc: u32, length: u64) -> u32 {
        let mut pieces = self.by_place.iter();
        let only = pieces.next().filter(|_| pieces.next().is_none());
        let only = only.filter(|(place, piece)| (**place, piece.length) == (0, length));
        let (_, piece) = only.expect("every row is written once");
        joined(crc, piece.crc, length)
    }
}

impl Piece {
    fn followed_by(self, next: Self) -> Self {
        let crc = joined(self.crc, next.crc, next.length);
        Self { length: self.length + next.length, crc }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::format::npz::crc32::crc32;

    /// Pieces of different lengths, in three orders and told by three processes: one piece in the end.
    #[test]
    fn pieces_in_any_order_make_the_whole() {
        let bytes: Vec<u8> = (0..5000_u32).map(|k| ((k * k) >> 3).to_le_bytes()[0]).collect();
        let cuts: Vec<usize> = (0..=100).map(|k| k * k / 2).collect();
        for step in [1, 37, 99] {
            let mut processes = [Pieces::default(), Pieces::default(), Pieces::default()];
            for k in 0..100 {
                let piece = k * step % 100;
                let (from, bytes) = (cuts[piece] as u64, &bytes[cuts[piece]..cuts[piece + 1]]);
                processes[k % 3].add(from, bytes.len() as u64, crc32(0, bytes));
            }
            let [mut all, second, third] = processes;
            all.add_told(&second.to_bytes());
            all.add_told(&third.to_bytes());
            let expected = crc32(0, &[b"header", &bytes[..]].concat());
            assert_eq!(all.whole(crc32(0, b"header"), 5000), expected);
            assert_eq!(all.to_bytes().len(), MESSAGE);
        }
    }

    #[test]
    #[should_panic(expected = "every row is written once")]
    fn a_missing_piece_is_noticed() {
        let mut pieces = Pieces::default();
        pieces.add(0, 3, 1);
        pieces.add(5, 3, 1);
        pieces.whole(0, 8);
    }
}
