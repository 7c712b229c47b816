//! The CRC-32 of ZIP: the remainder of the bytes, as a polynomial over GF(2), divided by P of degree 32.
//!
//! Bits are reflected: bit 31 of a word is the coefficient of `x^0`, bit 0 that of `x^31`.

/// P less its `x^32`, 0x04C11DB7 reflected.
const POLYNOMIAL: u32 = 0xEDB8_8320;

/// Tables for eight bytes at a time.
static TABLES: [[u32; 256]; 8] = tables();

/// The checksum of bytes that follow others whose checksum is `crc`, or 0.
pub(super) fn crc32(crc: u32, bytes: &[u8]) -> u32 {
    let (eights, rest) = bytes.as_chunks::<8>();
    let mut crc = !crc;
    for eight in eights {
        let word = u64::from_le_bytes(*eight) ^ u64::from(crc);
        let folded = word.to_le_bytes().into_iter().zip(TABLES.iter().rev());
        crc = folded.fold(0, |sum, (byte, table)| sum ^ table[usize::from(byte)]);
    }
    for byte in rest {
        crc = TABLES[0][usize::from(crc.to_le_bytes()[0] ^ byte)] ^ (crc >> 8);
    }
    !crc
}

/// The checksum of A followed by B, from those of A and of the `length` bytes B.
///
/// With F the polynomial of 32 ones that a checksum begins with and is added to at its end,
/// `crc(A) = F x^(8|A|) + A x^32 + F` modulo P. Put for AB, this is `crc(A) x^(8|B|) + crc(B)`, the F
/// in between cancelling.
pub(super) fn joined(first: u32, second: u32, length: u64) -> u32 {
    product(first, power(length)) ^ second
}

/// `x^(8 bytes)` modulo P, by repeated squaring.
fn power(mut bytes: u64) -> u32 {
    let (mut power, mut square) = (1 << 31, 1 << 23);
    while bytes > 0 {
        if bytes & 1 == 1 {
            power = product(power, square);
        }
        square = product(square, square);
        bytes >>= 1;
    }
    power
}

/// `a b` modulo P.
fn product(a: u32, mut b: u32) -> u32 {
    let mut sum = 0;
    for power in 0..32 {
        sum ^= b & 0_u32.wrapping_sub(a >> (31 - power) & 1);
        b = times_x(b);
    }
    sum
}

/// `a x` modulo P.
const fn times_x(a: u32) -> u32 {
    (a >> 1) ^ (POLYNOMIAL & 0_u32.wrapping_sub(a & 1))
}

const fn tables() -> [[u32; 256]; 8] {
    let mut tables = [[0; 256]; 8];
    let mut index = 0;
    let mut value = 0_u32;
    while index < 256 {
        let mut crc = value;
        let mut bit = 0;
        while bit < 8 {
            crc = times_x(crc);
            bit += 1;
        }
        tables[0][index] = crc;
        index += 1;
        value += 1;
    }
    let mut k = 1;
    while k < 8 {
        let mut index = 0;
        while index < 256 {
            let crc = tables[k - 1][index];
            tables[k][index] = tables[0][(crc & 0xFF) as usize] ^ (crc >> 8);
            index += 1;
        }
        k += 1;
    }
    tables
}

#[cfg(test)]
mod tests {
    use super::{crc32, joined, power, product};

    /// The check value of the catalogue of CRC algorithms: in one piece, in two, and joined of two.
    #[test]
    fn check_value() {
        assert_eq!(crc32(0, b"123456789"), 0xCBF4_3926);
        for split in 0..=9 {
            let (first, second) = b"123456789".split_at(split);
            assert_eq!(crc32(crc32(0, first), second), 0xCBF4_3926);
            let length = second.len() as u64;
            assert_eq!(joined(crc32(0, first), crc32(0, second), length), 0xCBF4_3926);
        }
    }

    #[test]
    fn joined_pieces_have_the_checksum_of_the_whole() {
        let bytes: Vec<u8> =
            (0..100_003_u32).map(|k| (k.wrapping_mul(k) >> 5).to_le_bytes()[0]).collect();
        for length in [1, 7, 4096, 99_999] {
            let pieces = bytes.chunks(length).map(|piece| (crc32(0, piece), piece.len() as u64));
            let whole = pieces.fold(0, |crc, (next, length)| joined(crc, next, length));
            assert_eq!(whole, crc32(0, &bytes), "pieces of {length}");
        }
    }

    /// P is primitive: x has the order 2^32 - 1, so that `x^(8 k)` is 1 for this k and not for its parts.
    #[test]
    fn powers_of_lengths_beyond_all_files() {
        let order = u64::from(u32::MAX);
        assert_eq!(power(order), 1 << 31);
        for prime in [3, 5, 17, 257, 65537] {
            assert_ne!(power(order / prime), 1 << 31, "{prime}");
        }
        assert_eq!(power(u64::MAX), product(power(u64::MAX - 12_345), power(12_345)));
    }
}
