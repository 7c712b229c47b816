//! Files of other programs: NumPy arrays ([`npy`], [`npz`]), tables ([`csv`]) and meshes of gmsh ([`gmsh`]),
//! read strictly; files of lumley are written whole or not at all ([`atomic`]), fields for ParaView ([`vtu`]), tables that grow row by row
//! ([`table`]).
//!
//! A size that a file claims is checked against the file before anything is allocated for it.

pub mod atomic;
pub mod csv;
mod error;
pub mod gmsh;
pub mod mesh;
pub mod npy;
pub mod npz;
pub(crate) mod positioned;
mod region;
pub mod table;
pub mod vtu;

pub use error::FormatError;
