//! The snapshot store: what is read is what was written, and damage is found and named.

mod damage;
mod hostile;
mod round_trip;
mod sample;
