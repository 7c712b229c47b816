//! NPY and NPZ files: what is read is what was written, and no file does harm.

mod archive;
mod damage;
mod read;
mod sample;
