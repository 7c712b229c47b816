//! A decomposition that is killed, at any point, goes on where it was and ends with the same bits.

mod common;

use common::{seen, times, with_singular_values};
use faer::{MatMut, MatRef, Par};
use lumley_pod::{
    ALGORITHMS, APPROXIMATIONS, Decomposition, Diagonal, Execution, InnerProduct, Journal,
    MemoryModes, MemorySnapshots, ModeStore, OldBasis, Options, PodError, SnapshotSource,
    Truncation, method_of_snapshots, svd, update,
};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::io;
use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Counts operations, and fails from one of them on: the process is dead.
struct Fuse {
    left: AtomicUsize,
    /// Rows of snapshots that were read.
    rows: AtomicUsize,
}

impl Fuse {
    fn new(operations: usize) -> Self {
        Self { left: AtomicUsize::new(operations), rows: AtomicUsize::new(0) }
    }

    fn burn(&self) -> io::Result<()> {
        let burn = |left: usize| Some(left.saturating_sub(1));
        match self.left.fetch_update(Ordering::Relaxed, Ordering::Relaxed, burn) {
            Ok(0) | Err(_) => Err(io::Error::other("no space left on device")),
            Ok(_) => Ok(()),
        }
    }

    /// `x`, of which each block that is read is an operation.
    fn source(&self, x: &MemorySnapshots) -> impl SnapshotSource {
        seen(x, |rows, _| {
            self.burn()?;
            self.rows.fetch_add(rows.len(), Ordering::Relaxed);
            Ok(())
        })
    }
}

/// What survives a death.
#[derive(Default)]
struct Disk {
    entries: RefCell<BTreeMap<String, Vec<u8>>>,
}

struct Record<'a> {
    disk: &'a Disk,
    fuse: &'a Fuse,
}

impl Journal for Record<'_> {
    fn load(&self, name: &str) -> io::Result<Option<Vec<u8>>> {
        Ok(self.disk.entries.borrow().get(name).cloned())
    }

    fn save(&self, name: &str, entry: &[u8]) -> io::Result<()> {
        self.fuse.burn()?;
        self.disk.entries.borrow_mut().insert(name.to_owned(), entry.to_vec());
        Ok(())
    }

    fn is_due(&self) -> bool {
        true
    }
}

/// Like files, one of columns and one of modes: what was reserved once stays.
#[derive(Default)]
struct Files {
    columns: MemoryModes,
    reserved: AtomicUsize,
    modes: MemoryModes,
}

struct Store<'a> {
    files: &'a Files,
    fuse: &'a Fuse,
}

impl ModeStore for Store<'_> {
    fn reserve(&self, rows: usize, columns: usize) -> io::Result<()> {
        self.fuse.burn()?;
        match self.files.reserved.swap(columns, Ordering::Relaxed) {
            before if before == columns => Ok(()),
            _ => self.files.columns.reserve(rows, columns),
        }
    }

    fn write(&self, rows: Range<usize>, columns: MatRef<'_, f64>) -> io::Result<()> {
        self.fuse.burn()?;
        self.files.columns.write(rows, columns)
    }

    fn read(&self, rows: Range<usize>, out: MatMut<'_, f64>) -> io::Result<()> {
        self.files.columns.read(rows, out)
    }

    fn sync(&self) -> io::Result<()> {
        self.fuse.burn()
    }

    fn begin(&self, rows: usize, modes: usize, mean: bool) -> io::Result<()> {
        self.fuse.burn()?;
        self.files.modes.begin(rows, modes, mean)
    }

    fn publish(
        &self,
        rows: Range<usize>,
        modes: MatRef<'_, f64>,
        mean: Option<&[f64]>,
    ) -> io::Result<()> {
        self.fuse.burn()?;
        self.files.modes.publish(rows, modes, mean)
    }
}

const N: usize = 160_000;

/// Rows between two entries: 4 leaves of 8192.
const GROUP: usize = 4 * 8192;

type Work<'a> = dyn Fn(
        &dyn SnapshotSource,
        &dyn InnerProduct,
        &Options,
        Execution<'_>,
        &dyn ModeStore,
    ) -> Result<Decomposition, PodError>
    + 'a;

fn weights() -> Diagonal {
    Diagonal::new((0..N).map(|i| 1.0 + (i % 3) as f64).collect()).expect("positive")
}

fn options() -> Options {
    Options { truncation: Truncation::Modes(5), center: true, par: Par::Seq, ..Options::default() }
}

fn field() -> MemorySnapshots {
    let sigma: Vec<f64> = (0..7).map(|k| 0.01_f64.powi(k)).collect();
    MemorySnapshots::new(with_singular_values(&sigma, (N, 9), &weights(), 3), times(9))
}

/// All that outlives a process.
#[derive(Default)]
struct Life {
    disk: Disk,
    files: Files,
}

impl Life {
    /// Runs until the fuse is burnt.
    fn run(
        &self,
        work: &Work<'_>,
        x: &MemorySnapshots,
        fuse: &Fuse,
    ) -> Result<Decomposition, PodError> {
        let journal = Record { disk: &self.disk, fuse };
        let execution = Execution { journal: &journal, ..Execution::default() };
        let store = Store { files: &self.files, fuse };
        work(&fuse.source(x), &weights(), &options(), execution, &store)
    }
}

fn survives(name: &str, work: &Work<'_>, x: &MemorySnapshots) {
    let (whole, fuse) = (Life::default(), Fuse::new(usize::MAX >> 1));
    let expected = whole.run(work, x, &fuse).expect("a decomposition");
    let published = whole.files.modes.into_parts();
    let operations = (usize::MAX >> 1) - fuse.left.into_inner();
    let rows = fuse.rows.into_inner();
    assert_eq!((operations > 60, rows), (true, expected.passes * N), "{name}, {operations}");
    for survived in (0..operations).step_by(7) {
        let (life, first, second) =
            (Life::default(), Fuse::new(survived), Fuse::new(usize::MAX >> 1));
        let dead = life.run(work, x, &first);
        assert!(matches!(dead, Err(PodError::Medium(_))), "{name}, {survived}: {dead:?}");
        let found = life.run(work, x, &second).expect("it goes on");
        assert_eq!(found, expected, "{name}, {survived}");
        assert_eq!(life.files.modes.into_parts(), published, "{name}, {survived}");
        let again = (first.rows.into_inner() + second.rows.into_inner()) - rows;
        assert!(again <= GROUP, "{name}, {survived}: {again} rows were read again");
    }
}

#[test]
fn death_at_any_operation_loses_nothing() {
    let x = field();
    let all = ALGORITHMS.iter().chain(APPROXIMATIONS);
    for algorithm in all.filter(|a| !["direct", "incremental"].contains(&a.name)) {
        survives(algorithm.name, &algorithm.stream, &x);
    }
}

#[test]
fn an_update_that_dies_goes_on() {
    let x = field();
    let part = |cols: Range<usize>| {
        let of_part = x.matrix().subcols(cols.start, cols.len()).to_owned();
        MemorySnapshots::new(of_part, times(9)[cols].to_vec())
    };
    let basis = svd(&part(0..4), &weights(), &options()).expect("a decomposition");
    let old = OldBasis { decomposition: &basis, modes: &basis };
    let work: &Work<'_> =
        &|x, w, options, execution, modes| update(old, x, w, options, execution, modes);
    survives("update", work, &part(4..9));
}

/// The columns of a dead process are gone: they are made anew, and only the sums before them are taken up.
#[test]
fn modes_in_memory_are_not_taken_up() {
    let (x, disk, fuse) = (field(), Disk::default(), Fuse::new(usize::MAX >> 1));
    let counted = Fuse::new(usize::MAX >> 1);
    let expected = method_of_snapshots(&counted.source(&x), &weights(), &options());
    let expected = expected.expect("a decomposition");
    let reads = (usize::MAX >> 1) - counted.left.into_inner();
    let read = |operations: usize| {
        let (dying, store) = (Fuse::new(operations), MemoryModes::default());
        let journal = Record { disk: &disk, fuse: &fuse };
        let execution = Execution { journal: &journal, ..Execution::default() };
        let run = ALGORITHMS[1].stream;
        let found = run(&dying.source(&x), &weights(), &options(), execution, &store);
        (found, store.into_parts(), dying.rows.into_inner())
    };
    let (dead, _, rows) = read(reads * 3 / 4);
    assert!(dead.is_err() && rows > N + 2 * GROUP && rows < 2 * N, "{rows} rows: {dead:?}");
    for _ in 0..2 {
        let (found, (modes, mean), rows) = read(usize::MAX >> 1);
        assert_eq!(found.expect("it goes on"), expected.decomposition);
        assert_eq!((modes, mean, rows), (expected.modes.clone(), expected.mean.clone(), N));
    }
}
