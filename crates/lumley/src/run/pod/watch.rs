use crate::progress::Progress;
use lumley_pod::{Pass, Watch};
use std::cell::{Cell, RefCell};
use std::time::Instant;

/// Shows a decomposition's passes over the data.
pub(super) struct Passes<'p> {
    progress: RefCell<&'p mut Progress>,
    /// Passes over the snapshots that are not counted with these.
    before: usize,
    /// When the pass began, and with how many rows.
    begun: Cell<(Instant, usize)>,
}

impl<'p> Passes<'p> {
    /// * `before`: passes over the snapshots that were made for something else
    pub fn new(progress: &'p mut Progress, before: usize) -> Self {
        Self { progress: RefCell::new(progress), before, begun: Cell::new((Instant::now(), 0)) }
    }
}

impl Watch for Passes<'_> {
    fn begin(&self, pass: &Pass, rows: usize) {
        self.begun.set((Instant::now(), rows));
        self.progress.borrow_mut().part(pass.rows, rows);
    }

    fn advance(&self, pass: &Pass, rows: usize) {
        let (begun, first) = self.begun.get();
        let rate = pass.bytes(rows - first) as f64 / 1e6 / begun.elapsed().as_secs_f64().max(1e-9);
        let data = if pass.over_snapshots {
            let number = self.before + pass.number;
            format!("pass {number} over the snapshots ({})", pass.name)
        } else {
            pass.name.to_owned()
        };
        self.progress.borrow_mut().advance(rows, &format!("{data}, {rate:.0} MB/s"));
    }
}
