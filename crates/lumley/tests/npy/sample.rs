use std::path::{Path, PathBuf};

pub type Outcome = Result<(), Box<dyn std::error::Error>>;

/// Knuth's linear congruential generator: the same numbers in each run of the tests.
pub struct Lcg(pub u64);

impl Lcg {
    pub fn below(&mut self, bound: usize) -> usize {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(self.0 >> 33).expect("31 bits") % bound
    }
}

/// An NPY file of version 1 with the header `dictionary`, written as other programs may do it.
pub fn npy(dictionary: &str, data: &[u8]) -> Vec<u8> {
    let length = u16::try_from(dictionary.len()).expect("a short header").to_le_bytes();
    [b"\x93NUMPY\x01\x00", &length[..], dictionary.as_bytes(), data].concat()
}

pub fn header(descr: &str, fortran_order: bool, shape: &str) -> String {
    let order = if fortran_order { "True" } else { "False" };
    format!("{{'descr': '{descr}', 'fortran_order': {order}, 'shape': {shape}, }}\n")
}

pub fn file(folder: &Path, bytes: &[u8]) -> std::io::Result<PathBuf> {
    let path = folder.join("x.npy");
    replace(&path, bytes)?;
    Ok(path)
}

/// A new file in the place of the old one: to cut and refill the old one makes some systems wait for the disk.
pub fn replace(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    if path.exists() {
        std::fs::remove_file(path)?;
    }
    std::fs::write(path, bytes)
}
