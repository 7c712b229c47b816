use std::array;
use std::ops::{Add, AddAssign, Mul, Sub, SubAssign};

/// Cells that are computed at once.
pub const WIDTH: usize = 8;

/// One number for each of [`WIDTH`] cells. Inside of a dispatch over the instruction sets of the processor the
/// operations become single instructions on vectors.
#[derive(Debug, Clone, Copy, Default)]
#[repr(align(64))]
pub struct Lanes(pub [f64; WIDTH]);

impl Lanes {
    #[inline(always)]
    pub fn splat(value: f64) -> Self {
        Self([value; WIDTH])
    }

    #[inline(always)]
    pub fn recip(self) -> Self {
        Self(self.0.map(f64::recip))
    }

    #[inline(always)]
    pub fn sqrt(self) -> Self {
        Self(self.0.map(f64::sqrt))
    }
}

macro_rules! operation {
    ($trait:ident, $function:ident, $operator:tt) => {
        impl $trait for Lanes {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                Self(array::from_fn(|k| self.0[k] $operator other.0[k]))
            }
        }

        impl $trait<f64> for Lanes {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: f64) -> Self {
                Self(array::from_fn(|k| self.0[k] $operator other))
            }
        }
    };
}

operation!(Add, add, +);
operation!(Sub, sub, -);
operation!(Mul, mul, *);

impl AddAssign for Lanes {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl SubAssign for Lanes {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}
