//! Case files, formats, runs, records and reports around the models of lumley, and its command line.

pub mod format;
pub mod record;
pub mod report;
