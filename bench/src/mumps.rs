//! MUMPS (Amestoy, Duff, L'Excellent and Koster 2001, SIAM J. Matrix Anal. Appl. 23, 15-41), sequential.
//!
//! The one file with unsafe code: a C library is called.
#![allow(unsafe_code, reason = "calls a C library")]

use std::error::Error;
use std::ffi::{c_double, c_int, c_longlong};
use std::fmt;
use std::ptr::NonNull;

/// MUMPS's own structure, which only `mumps.c` looks into.
#[repr(C)]
struct Instance {
    _opaque: [u8; 0],
}

unsafe extern "C" {
    fn seam_new(ordering: c_int) -> *mut Instance;
    fn seam_free(id: *mut Instance);
    fn seam_analyse(
        id: *mut Instance,
        n: c_int,
        entries: c_longlong,
        rows: *mut c_int,
        columns: *mut c_int,
        values: *mut c_double,
    ) -> c_int;
    fn seam_factorise(id: *mut Instance, values: *mut c_double) -> c_int;
    fn seam_solve(id: *mut Instance, x: *mut c_double) -> c_int;
    fn seam_detail(id: *const Instance) -> c_int;
}

/// The order of elimination, MUMPS's ICNTL(7).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ordering {
    /// Approximate minimum degree.
    Amd = 0,
    /// Nested dissection by SCOTCH.
    Scotch = 3,
    /// Nested dissection by METIS.
    Metis = 5,
}

/// An error by MUMPS's numbers INFOG(1) and INFOG(2).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MumpsError {
    /// What MUMPS was asked for.
    pub job: &'static str,
    /// INFOG(1)
    pub code: c_int,
    /// INFOG(2)
    pub detail: c_int,
}

impl fmt::Display for MumpsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { job, code, detail } = self;
        write!(f, "MUMPS failed to {job}: INFOG(1) = {code}, INFOG(2) = {detail}; see its manual")
    }
}

impl Error for MumpsError {}

/// LU of a sparse matrix without symmetry.
pub struct Mumps {
    instance: NonNull<Instance>,
    order: usize,
    // MUMPS points into these from the analysis on.
    rows: Vec<c_int>,
    columns: Vec<c_int>,
    values: Vec<f64>,
}

impl Mumps {
    /// Analyses the matrix of this order with these entries, which are added where they share a place.
    ///
    /// # Errors
    /// [`MumpsError`].
    ///
    /// # Panics
    /// If an index is out of range, or beyond 2³¹ − 2.
    pub fn analyse(
        order: usize,
        entries: impl Iterator<Item = (usize, usize, f64)>,
        ordering: Ordering,
    ) -> Result<Self, MumpsError> {
        let from_one = |k: usize| {
            assert!(k < order, "an index of the matrix");
            c_int::try_from(k + 1).expect("MUMPS counts with 32 bits")
        };
        let (mut rows, mut columns, mut values) = (Vec::new(), Vec::new(), Vec::new());
        for (row, column, value) in entries {
            rows.push(from_one(row));
            columns.push(from_one(column));
            values.push(value);
        }
        // SAFETY: makes an instance of its own, or none.
        let instance = NonNull::new(unsafe { seam_new(ordering as c_int) });
        let instance = instance.ok_or(MumpsError { job: "start", code: 0, detail: 0 })?;
        let mut this = Self { instance, order, rows, columns, values };
        let size = c_int::try_from(order).expect("MUMPS counts with 32 bits");
        let entries = c_longlong::try_from(this.values.len()).expect("memory is smaller");
        // SAFETY: the instance is alive; the three lists have `entries` items and live, unmoved, as long as it does.
        let code = unsafe {
            seam_analyse(
                this.instance.as_ptr(),
                size,
                entries,
                this.rows.as_mut_ptr(),
                this.columns.as_mut_ptr(),
                this.values.as_mut_ptr(),
            )
        };
        this.check("analyse", code)?;
        Ok(this)
    }

    /// Factorises the matrix with the values that it has.
    ///
    /// # Errors
    /// [`MumpsError`].
    pub fn factorise(&mut self) -> Result<(), MumpsError> {
        // SAFETY: the instance is analysed, the values are as many as at the analysis.
        let code = unsafe { seam_factorise(self.instance.as_ptr(), self.values.as_mut_ptr()) };
        self.check("factorise", code)
    }

    /// Replaces the right-hand side by the solution; an error before [`factorise`](Self::factorise).
    ///
    /// # Errors
    /// [`MumpsError`].
    ///
    /// # Panics
    /// If the length of `x` is not the order of the matrix.
    pub fn solve(&mut self, x: &mut [f64]) -> Result<(), MumpsError> {
        assert_eq!(x.len(), self.order, "entries of the right-hand side");
        // SAFETY: MUMPS writes as many numbers as the matrix has rows, and forgets the pointer before the next call.
        let code = unsafe { seam_solve(self.instance.as_ptr(), x.as_mut_ptr()) };
        self.check("solve", code)
    }

    fn check(&self, job: &'static str, code: c_int) -> Result<(), MumpsError> {
        // SAFETY: the instance is alive.
        let detail = unsafe { seam_detail(self.instance.as_ptr()) };
        if code < 0 { Err(MumpsError { job, code, detail }) } else { Ok(()) }
    }
}

impl Drop for Mumps {
    fn drop(&mut self) {
        // SAFETY: the instance is alive, and used no more.
        unsafe { seam_free(self.instance.as_ptr()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_and_refuses() -> Result<(), MumpsError> {
        let entries = |last: f64| [(0, 1, 2.0), (1, 0, 1.0), (1, 1, 3.0), (1, 1, last)];
        for ordering in [Ordering::Amd, Ordering::Scotch, Ordering::Metis] {
            let mut lu = Mumps::analyse(2, entries(1.0).into_iter(), ordering)?;
            assert!(lu.solve(&mut [0.0; 2]).is_err(), "nothing is factorised yet");
            for _ in 0..2 {
                lu.factorise()?;
                let mut x = [4.0, 9.0];
                lu.solve(&mut x)?;
                let away = (x[0] - 1.0).hypot(x[1] - 2.0);
                assert!(away < 1e-14, "{ordering:?}: {x:?}");
            }
        }
        let singular = [(0, 0, 1.0), (1, 0, 2.0)];
        let found = Mumps::analyse(2, singular.into_iter(), Ordering::Amd)
            .and_then(|mut lu| lu.factorise());
        let message = found.expect_err("singular").to_string();
        assert!(message.contains("INFOG(1)"), "{message}");
        Ok(())
    }
}
