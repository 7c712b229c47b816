//! NPY and NPZ files: what is read is what was written, and no file does harm.

mod archive;
mod damage;
#[cfg(target_os = "linux")]
mod memory;
mod read;
mod sample;
mod weights;
