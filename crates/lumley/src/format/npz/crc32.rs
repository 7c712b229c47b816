/// Tables for eight bytes at a time of the CRC-32 of ZIP, polynomial 0x04C11DB7 reflected.
static TABLES: [[u32; 256]; 8] = tables();

/// The CRC-32 of ZIP of bytes that follow others whose checksum is `crc`, or 0.
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

const fn tables() -> [[u32; 256]; 8] {
    let mut tables = [[0; 256]; 8];
    let mut index = 0;
    let mut value = 0_u32;
    while index < 256 {
        let mut crc = value;
        let mut bit = 0;
        while bit < 8 {
            crc = (crc >> 1) ^ (0xEDB8_8320 * (crc & 1));
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
    use super::crc32;

    /// The check value of the catalogue of CRC algorithms, in one piece and in two.
    #[test]
    fn check_value() {
        assert_eq!(crc32(0, b"123456789"), 0xCBF4_3926);
        for split in 0..9 {
            let (first, second) = b"123456789".split_at(split);
            assert_eq!(crc32(crc32(0, first), second), 0xCBF4_3926);
        }
    }
}
