//! A decomposition that is killed, at any point, goes on where it was and ends with the same bits.

mod common;

use common::{times, with_singular_values};
use faer::{Mat, MatMut, MatRef, Par};
use lumley_pod::{
    ALGORITHMS, APPROXIMATIONS, Algorithm, Decomposition, Diagonal, Execution, Journal,
    MemoryModes, MemorySnapshots, ModeStore, Options, PodError, SnapshotSource, Truncation,
};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::io;
use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Counts operations, and fails from one of them on: the process is dead.
struct Fuse {
    left: AtomicUsize,
}

impl Fuse {
    fn burn(&self) -> io::Result<()> {
        let burn = |left: usize| Some(left.saturating_sub(1));
        match self.left.fetch_update(Ordering::Relaxed, Ordering::Relaxed, burn) {
            Ok(0) | Err(_) => Err(io::Error::other("no space left on device")),
            Ok(_) => Ok(()),
        }
    }
}

/// What survives a death.
#[derive(Default)]
struct Disk {
    entries: RefCell<BTreeMap<String, Vec<u8>>>,
}

struct Burning<'a, T: ?Sized> {
    inner: &'a T,
    fuse: &'a Fuse,
}

impl Journal for Burning<'_, Disk> {
    fn load(&self, name: &str) -> io::Result<Option<Vec<u8>>> {
        Ok(self.inner.entries.borrow().get(name).cloned())
    }

    fn save(&self, name: &str, entry: &[u8]) -> io::Result<()> {
        self.fuse.burn()?;
        self.inner.entries.borrow_mut().insert(name.to_owned(), entry.to_vec());
        Ok(())
    }

    fn is_due(&self) -> bool {
        true
    }
}

impl SnapshotSource for Burning<'_, MemorySnapshots> {
    fn dim(&self) -> usize {
        self.inner.dim()
    }

    fn times(&self) -> &[f64] {
        self.inner.times()
    }

    fn block(
        &self,
        rows: Range<usize>,
        cols: Range<usize>,
        out: MatMut<'_, f64>,
    ) -> io::Result<()> {
        self.fuse.burn()?;
        self.inner.block(rows, cols, out)
    }
}

/// Like a file: what was reserved once stays.
struct Store<'a> {
    inner: &'a MemoryModes,
    reserved: &'a AtomicUsize,
    fuse: &'a Fuse,
}

impl ModeStore for Store<'_> {
    fn reserve(&self, rows: usize, columns: usize) -> io::Result<()> {
        self.fuse.burn()?;
        match self.reserved.swap(columns, Ordering::Relaxed) {
            before if before == columns => Ok(()),
            _ => self.inner.reserve(rows, columns),
        }
    }

    fn write(&self, rows: Range<usize>, columns: MatRef<'_, f64>) -> io::Result<()> {
        self.fuse.burn()?;
        self.inner.write(rows, columns)
    }

    fn read(&self, rows: Range<usize>, out: MatMut<'_, f64>) -> io::Result<()> {
        self.inner.read(rows, out)
    }

    fn sync(&self) -> io::Result<()> {
        self.fuse.burn()
    }

    fn begin(&self, rows: usize, modes: usize, mean: bool) -> io::Result<()> {
        self.fuse.burn()?;
        self.inner.begin(rows, modes, mean)
    }

    /// Published modes lie in another file than the columns they are made of.
    fn publish(&self, _: Range<usize>, _: MatRef<'_, f64>, _: Option<&[f64]>) -> io::Result<()> {
        self.fuse.burn()
    }
}

const N: usize = 160_000;

struct Life {
    disk: Disk,
    modes: MemoryModes,
    reserved: AtomicUsize,
}

impl Life {
    fn new() -> Self {
        let (disk, modes) = (Disk::default(), MemoryModes::default());
        Self { disk, modes, reserved: AtomicUsize::new(0) }
    }

    /// Runs until the fuse is burnt; returns how much of it was.
    fn run(
        &self,
        algorithm: &Algorithm,
        x: &MemorySnapshots,
        operations: usize,
    ) -> (Result<Decomposition, PodError>, usize) {
        let fuse = Fuse { left: AtomicUsize::new(operations) };
        let w = Diagonal::new((0..N).map(|i| 1.0 + (i % 3) as f64).collect()).expect("positive");
        let options = Options {
            truncation: Truncation::Modes(5),
            center: true,
            par: Par::Seq,
            ..Options::default()
        };
        let journal = Burning { inner: &self.disk, fuse: &fuse };
        let execution = Execution { journal: &journal, ..Execution::default() };
        let store = Store { inner: &self.modes, reserved: &self.reserved, fuse: &fuse };
        let source = Burning { inner: x, fuse: &fuse };
        let found = (algorithm.stream)(&source, &w, &options, execution, &store);
        (found, operations - fuse.left.load(Ordering::Relaxed))
    }

    /// The columns that the modes are made of.
    fn columns(&self) -> Mat<f64> {
        let mut columns = Mat::zeros(N, self.reserved.load(Ordering::Relaxed));
        self.modes.read(0..N, columns.as_mut()).expect("modes in memory");
        columns
    }
}

#[test]
fn death_at_any_operation_loses_nothing() {
    let sigma: Vec<f64> = (0..7).map(|k| 0.01_f64.powi(k)).collect();
    let w = Diagonal::new(vec![1.0; N]).expect("positive");
    let x = MemorySnapshots::new(with_singular_values(&sigma, (N, 9), &w, 3), times(9));
    let all = ALGORITHMS.iter().chain(APPROXIMATIONS);
    for algorithm in all.filter(|a| !["direct", "incremental"].contains(&a.name)) {
        let whole = Life::new();
        let (expected, operations) = whole.run(algorithm, &x, usize::MAX >> 1);
        let expected = expected.expect("a decomposition");
        assert!(operations > 60, "{operations}");
        for survived in (0..operations).step_by(7) {
            let life = Life::new();
            let (dead, _) = life.run(algorithm, &x, survived);
            assert!(matches!(dead, Err(PodError::Medium(_))), "{survived}: {dead:?}");
            let (found, again) = life.run(algorithm, &x, usize::MAX >> 1);
            assert_eq!(found.expect("it goes on"), expected, "{}, {survived}", algorithm.name);
            assert_eq!(life.columns(), whole.columns(), "{}, {survived}", algorithm.name);
            assert!(again <= operations, "{survived}: {again} of {operations}");
            // At most what lies between two entries is done again.
            assert!(again + survived < operations + operations / 2 || survived < operations / 2);
        }
    }
}
