use crate::agreement::{agreed, together};
use crate::ensemble::Ensemble;
use crate::partial::Partial;
use crate::reduction::Part;
use crate::{Execution, ModeStore, Pass, PodError};
use std::cell::Cell;
use std::io;

/// One decomposition under way: what is decomposed, who shares the work and where the modes go.
pub(crate) struct Run<'a> {
    pub ensemble: &'a Ensemble<'a>,
    pub execution: Execution<'a>,
    pub modes: &'a dyn ModeStore,
    passes: Cell<usize>,
}

impl<'a> Run<'a> {
    pub fn new(
        ensemble: &'a Ensemble<'a>,
        execution: Execution<'a>,
        modes: &'a dyn ModeStore,
    ) -> Self {
        Self { ensemble, execution, modes, passes: Cell::new(0) }
    }

    /// A pass over the snapshots: the sum of what each leaf contributes.
    pub fn over_snapshots(&self, name: &'static str, part: &Part<'_>) -> Result<Partial, PodError> {
        let pass = self.pass(name, self.ensemble.shape().1, true);
        let sync = || Ok(self.modes.sync()?);
        // Sums of columns that are gone would make wrong modes.
        let execution = if self.modes.is_lasting() { self.execution } else { self.unkept() };
        self.ensemble.reduction(execution).sum(&pass, part, &sync)
    }

    /// A pass over columns of the mode store, which are few: nothing of it is kept.
    pub fn over_modes(
        &self,
        name: &'static str,
        columns: usize,
        part: &Part<'_>,
    ) -> Result<Partial, PodError> {
        let pass = self.pass(name, columns, false);
        self.ensemble.reduction(self.unkept()).sum(&pass, part, &|| Ok(()))
    }

    fn unkept(&self) -> Execution<'a> {
        Execution { journal: &crate::NoJournal, ..self.execution }
    }

    /// Numbers that rank 0 finds for all.
    pub fn agreed(
        &self,
        find: impl FnOnce() -> Result<Vec<f64>, PodError>,
    ) -> Result<Vec<f64>, PodError> {
        agreed(self.execution.ranks, find)
    }

    /// Whether something holds, as rank 0 finds it for all.
    pub fn agree(&self, find: impl FnOnce() -> bool) -> Result<bool, PodError> {
        Ok(self.agreed(|| Ok(vec![f64::from(u8::from(find()))]))? == [1.0])
    }

    /// Whether all ranks may go on after what each has done to its files.
    pub fn all_or_none(&self, mine: io::Result<()>) -> Result<(), PodError> {
        together(self.execution.ranks, mine.map_err(PodError::from))
    }

    /// Passes over the snapshots so far.
    pub fn passes(&self) -> usize {
        self.passes.get()
    }

    fn pass(&self, name: &'static str, snapshots: usize, over_snapshots: bool) -> Pass {
        let number = self.passes.get() + usize::from(over_snapshots);
        self.passes.set(number);
        let partition = self.ensemble.partition;
        let ranks = self.execution.ranks;
        let mine = crate::partition::share(partition.leaves(), ranks.rank(), ranks.count());
        Pass { number, name, rows: partition.rows_of(mine).len(), snapshots, over_snapshots }
    }
}
