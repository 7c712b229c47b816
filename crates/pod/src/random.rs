//! Random numbers that are always the same, so that results are.

/// Number k of a sequence of random bits (SplitMix64: Steele, Lea and Flood, 2014).
pub(crate) fn random_bits(k: u64) -> u64 {
    let state = k.wrapping_mul(0x9E37_79B9_7F4A_7C15);
    let z = (state ^ (state >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}
