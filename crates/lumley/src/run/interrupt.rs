use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;
use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Exit code of a program that was interrupted, as shells have it: 128 and the number of the signal.
pub const INTERRUPTED: u8 = 130;

/// Whether somebody wants the run to stop: Ctrl-C, or the system's wish that the process end.
///
/// While it is [held](Self::hold), the first such wish is noted; a second one, and any at another time, ends
/// the process at once.
///
/// ```
/// let interrupt = lumley::run::Interrupt::default();
/// let held = interrupt.hold();
/// assert!(!interrupt.wanted());
/// interrupt.raise();
/// assert!(interrupt.wanted());
/// drop(held);
/// ```
#[derive(Debug, Clone, Default)]
pub struct Interrupt {
    wanted: Arc<AtomicBool>,
    at_once: Arc<AtomicBool>,
}

/// Wishes that the run stop are noted as long as this lives.
///
/// ```
/// let interrupt = lumley::run::Interrupt::default();
/// let held: lumley::run::Held = interrupt.hold();
/// ```
#[derive(Debug)]
pub struct Held(Arc<AtomicBool>);

impl Interrupt {
    /// Listens to SIGINT and SIGTERM from now on.
    ///
    /// # Errors
    /// The system's.
    pub fn listen() -> io::Result<Self> {
        let interrupt = Self::default();
        interrupt.at_once.store(true, Ordering::Relaxed);
        for signal in [SIGINT, SIGTERM] {
            // In this order: what the first signal notes is what the second one finds.
            for end in [&interrupt.at_once, &interrupt.wanted] {
                flag::register_conditional_shutdown(signal, INTERRUPTED.into(), end.clone())?;
            }
            flag::register(signal, interrupt.wanted.clone())?;
        }
        Ok(interrupt)
    }

    /// Notes wishes instead of ending at once, as long as what it returns lives.
    #[must_use]
    pub fn hold(&self) -> Held {
        self.at_once.store(false, Ordering::Relaxed);
        Held(self.at_once.clone())
    }

    /// Whether it was asked for.
    pub fn wanted(&self) -> bool {
        self.wanted.load(Ordering::Relaxed)
    }

    /// Asks for it.
    pub fn raise(&self) {
        self.wanted.store(true, Ordering::Relaxed);
    }
}

impl Drop for Held {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}
