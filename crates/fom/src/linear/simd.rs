use pulp::{Arch, Simd, WithSimd};

/// Runs loops with the vector instructions of this processor. `work` must be marked `#[inline(always)]`.
#[inline(always)]
pub(crate) fn vectorised<R>(work: impl FnMut() -> R) -> R {
    Arch::new().dispatch(Inlined(work))
}

/// A closure that is called by reference. Called by value it would pass through a function of its own,
/// which is compiled for the oldest processor.
struct Inlined<F>(F);

impl<R, F: FnMut() -> R> WithSimd for Inlined<F> {
    type Output = R;

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, _: S) -> R {
        (self.0)()
    }
}
