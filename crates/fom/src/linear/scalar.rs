use faer::traits::RealField;
use std::fmt::Debug;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

/// The numbers of a factorisation: [`f64`], or [`f32`] for half the memory and twice the speed.
///
/// ```
/// use lumley_fom::linear::Scalar;
/// assert!(<f32 as Scalar>::SINGULAR > <f64 as Scalar>::SINGULAR);
/// assert_eq!(<f32 as Scalar>::from_f64(0.5).to_f64(), 0.5);
/// ```
pub trait Scalar:
    RealField
    + Copy
    + Default
    + Debug
    + PartialOrd
    + Add<Output = Self>
    + AddAssign
    + Sub<Output = Self>
    + SubAssign
    + Mul<Output = Self>
    + MulAssign
    + Div<Output = Self>
    + DivAssign
    + Neg<Output = Self>
{
    /// Pivots below this share of their row and column count as round-off. Singular saddle points leave up to
    /// 3000 times the distance from 1 to the next number at 40,000 unknowns. In double precision regular ones
    /// stay far above this value. In single precision it is near the round-off itself: a factorisation that
    /// serves as preconditioner is checked by the iteration.
    const SINGULAR: f64;
    /// The nearest number.
    fn from_f64(x: f64) -> Self;
    /// The same number.
    fn to_f64(self) -> f64;
    /// Its absolute value.
    #[must_use]
    fn magnitude(self) -> Self;
}

impl Scalar for f64 {
    const SINGULAR: f64 = 1e-11;
    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        x
    }
    #[inline(always)]
    fn to_f64(self) -> f64 {
        self
    }
    #[inline(always)]
    fn magnitude(self) -> Self {
        self.abs()
    }
}

impl Scalar for f32 {
    const SINGULAR: f64 = 1e-5;
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "single precision is what is asked for")]
    fn from_f64(x: f64) -> Self {
        x as f32
    }
    #[inline(always)]
    fn to_f64(self) -> f64 {
        f64::from(self)
    }
    #[inline(always)]
    fn magnitude(self) -> Self {
        self.abs()
    }
}
