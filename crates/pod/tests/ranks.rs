//! Ranks share the rows: the same bits as one, and a failure of one is a failure of all.

mod common;

use common::{grid, random_matrix, seen, snapshots, times, with_singular_values};
use faer::{Mat, MatMut, MatRef};
use lumley_pod::{
    ALGORITHMS, APPROXIMATIONS, Execution, Identity, MemorySnapshots, ModeStore, OldBasis, Options,
    PodError, Ranks, Truncation, all_or_none, finite_snapshots, svd, update,
};
use std::io;
use std::ops::Range;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Mutex, PoisonError};

/// Ranks that are threads of one process.
struct Threads {
    rank: usize,
    to: Vec<Sender<Vec<u8>>>,
    from: Vec<Receiver<Vec<u8>>>,
}

impl Ranks for Threads {
    fn rank(&self) -> usize {
        self.rank
    }

    fn count(&self) -> usize {
        self.to.len()
    }

    fn send(&self, to: usize, message: &[u8]) {
        assert_ne!(to, self.rank, "a message to oneself");
        self.to[to].send(message.to_vec()).expect("the other rank listens");
    }

    fn receive(&self, from: usize) -> Vec<u8> {
        self.from[from].recv().expect("the other rank speaks")
    }
}

/// What each of `count` ranks makes of `work`.
fn on_ranks<T: Send>(count: usize, work: impl Fn(&dyn Ranks) -> T + Sync) -> Vec<T> {
    let mut senders: Vec<Vec<_>> = (0..count).map(|_| Vec::new()).collect();
    let mut receivers: Vec<Vec<_>> = (0..count).map(|_| Vec::new()).collect();
    for sender in &mut senders {
        for receiver in &mut receivers {
            let (to, from) = channel();
            sender.push(to);
            receiver.push(from);
        }
    }
    let ranks = senders.into_iter().zip(receivers).enumerate();
    let ranks = ranks.map(|(rank, (to, from))| Threads { rank, to, from });
    let work = &work;
    std::thread::scope(|scope| {
        let handles: Vec<_> = ranks.map(|ranks| scope.spawn(move || work(&ranks))).collect();
        handles.into_iter().map(|handle| handle.join().expect("no rank panics")).collect()
    })
}

/// Modes in memory that several ranks write, as they would a file.
#[derive(Default)]
struct Shared(Mutex<Files>);

/// The columns as they come, and the modes made of them.
type Files = (Option<Mat<f64>>, Option<Mat<f64>>);

impl Shared {
    fn with<T>(&self, f: impl FnOnce(&mut Files) -> T) -> T {
        f(&mut self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

impl ModeStore for Shared {
    fn reserve(&self, rows: usize, columns: usize) -> io::Result<()> {
        self.with(|(raw, _)| raw.get_or_insert_with(|| Mat::zeros(rows, columns)).nrows());
        Ok(())
    }

    fn write(&self, rows: Range<usize>, columns: MatRef<'_, f64>) -> io::Result<()> {
        self.with(|(raw, _)| {
            let raw = raw.as_mut().expect("reserved");
            raw.subrows_mut(rows.start, rows.len()).copy_from(columns);
        });
        Ok(())
    }

    fn read(&self, rows: Range<usize>, mut out: MatMut<'_, f64>) -> io::Result<()> {
        self.with(|(raw, _)| {
            let raw = raw.as_ref().expect("reserved");
            out.copy_from(raw.submatrix(rows.start, 0, rows.len(), out.ncols()));
        });
        Ok(())
    }

    fn sync(&self) -> io::Result<()> {
        Ok(())
    }

    fn begin(&self, rows: usize, modes: usize, _mean: bool) -> io::Result<()> {
        self.with(|(_, found)| found.get_or_insert_with(|| Mat::zeros(rows, modes)).nrows());
        Ok(())
    }

    fn publish(
        &self,
        rows: Range<usize>,
        modes: MatRef<'_, f64>,
        _mean: Option<&[f64]>,
    ) -> io::Result<()> {
        self.with(|(_, found)| {
            let found = found.as_mut().expect("begun");
            found.subrows_mut(rows.start, rows.len()).copy_from(modes);
        });
        Ok(())
    }
}

const N: usize = 60_002;

#[test]
fn any_number_of_ranks_gives_the_same_bits() {
    let sigma: Vec<f64> = (0..9).map(|k| 0.1_f64.powi(k)).collect();
    let w = grid(N);
    let x = MemorySnapshots::new(with_singular_values(&sigma, (N, 12), &w, 7), times(12));
    let options = Options {
        truncation: Truncation::Modes(6),
        center: true,
        residuals: true,
        ..Options::default()
    };
    let on_ranks_too = ALGORITHMS.iter().chain(APPROXIMATIONS);
    for algorithm in on_ranks_too.filter(|a| !["direct", "incremental"].contains(&a.name)) {
        let run = |count| {
            let modes = Shared::default();
            let found = on_ranks(count, |ranks| {
                let execution = Execution { ranks, ..Execution::default() };
                (algorithm.stream)(&x, &w, &options, execution, &modes).expect("a decomposition")
            });
            (modes.with(|(_, found)| found.take()).expect("modes"), found)
        };
        let (modes, one) = run(1);
        assert_eq!(modes.ncols(), 6);
        for count in [2, 3, 4, 7, 40] {
            let (shared, all) = run(count);
            assert_eq!(shared, modes, "{}, {count} ranks", algorithm.name);
            assert!(all.iter().all(|found| *found == one[0]), "{}, {count} ranks", algorithm.name);
        }
    }
}

/// Fewer unknowns than snapshots: the correlation in space, which rank 0 takes for all.
#[test]
fn few_unknowns_give_the_same_bits_on_any_number_of_ranks() {
    let (n, m) = (60, 90);
    for (sigma, taken) in [(0.5_f64, "direct"), (1e-3, "svd")] {
        let sigma: Vec<f64> = (0..6).map(|k| sigma.powi(k)).collect();
        let x = MemorySnapshots::new(
            with_singular_values(&sigma, (n, m), &Identity::new(n), 7),
            times(m),
        );
        let truncation = Truncation::Modes(4);
        let options = Options { truncation, center: true, residuals: true, ..Options::default() };
        for algorithm in ALGORITHMS.iter().filter(|a| ["auto", "direct"].contains(&a.name)) {
            let run = |count| {
                let modes = Shared::default();
                let found = on_ranks(count, |ranks| {
                    let (execution, w) =
                        (Execution { ranks, ..Execution::default() }, Identity::new(n));
                    (algorithm.stream)(&x, &w, &options, execution, &modes)
                        .expect("a decomposition")
                });
                (modes.with(|(_, found)| found.take()).expect("modes"), found)
            };
            let (modes, one) = run(1);
            assert!(algorithm.name == "direct" || one[0].algorithm == taken);
            for count in [2, 3] {
                let (shared, all) = run(count);
                assert_eq!(shared, modes, "{}, {count} ranks", algorithm.name);
                assert!(all.iter().all(|found| *found == one[0]), "{}", algorithm.name);
            }
        }
    }
}

#[test]
fn a_basis_is_updated_on_any_number_of_ranks() {
    let (sigma, w): (Vec<f64>, _) = ((0..9).map(|k| 0.5_f64.powi(k)).collect(), grid(N));
    let x = with_singular_values(&sigma, (N, 40), &w, 7);
    let part = |cols: Range<usize>| {
        MemorySnapshots::new(x.subcols(cols.start, cols.len()).to_owned(), times(40)[cols].to_vec())
    };
    let truncation = Truncation::Modes(6);
    let options = Options { truncation, center: true, ..Options::default() };
    let basis = svd(&part(0..20), &w, &options).expect("a decomposition");
    let run = |count| {
        let modes = Shared::default();
        let found = on_ranks(count, |ranks| {
            let execution = Execution { ranks, ..Execution::default() };
            let old = OldBasis { decomposition: &basis, modes: &basis };
            update(old, &part(20..40), &w, &options, execution, &modes).expect("an update")
        });
        (modes.with(|(_, found)| found.take()).expect("modes"), found)
    };
    let (modes, one) = run(1);
    for count in [2, 3, 7] {
        let (shared, all) = run(count);
        assert_eq!(shared, modes, "{count} ranks");
        assert!(all.iter().all(|found| *found == one[0]), "{count} ranks");
    }
}

/// No rank waits for the one that failed, and all say what it was.
#[test]
fn a_rank_that_cannot_read_ends_all_with_its_reason() {
    let x = snapshots(random_matrix(N, 5, 1));
    let half = seen(&x, |rows, _| match rows.end {
        N => Err(io::Error::other(format!("half.npy: row {} cannot be read", rows.start))),
        _ => Ok(()),
    });
    let w = Identity::new(N);
    let modes = Shared::default();
    let errors = on_ranks(4, |ranks| {
        let execution = Execution { ranks, ..Execution::default() };
        let found = (ALGORITHMS[0].stream)(&half, &w, &Options::default(), execution, &modes);
        found.expect_err("the last rows cannot be read")
    });
    assert!(matches!(&errors[3], PodError::Medium(_)), "{:?}", errors[3]);
    for error in &errors[..3] {
        assert!(matches!(error, PodError::Elsewhere(_)), "{error:?}");
        assert!(error.to_string().starts_with("rank 3: half.npy: row"), "{error}");
    }
}

#[test]
fn whole_columns_are_for_one_rank() {
    let x = MemorySnapshots::new(random_matrix(40, 5, 1), times(5));
    for (name, w) in common::products(40) {
        let all = ALGORITHMS.iter().chain(APPROXIMATIONS).filter(|a| a.name != "direct");
        for algorithm in all.filter(|a| a.name == "incremental" || name == "sparse") {
            let errors = on_ranks(2, |ranks| {
                let execution = Execution { ranks, ..Execution::default() };
                let store = Shared::default();
                (algorithm.stream)(&x, &*w, &Options::default(), execution, &store)
                    .expect_err("two ranks")
            });
            let refused = |e: &PodError| matches!(e, PodError::WholeColumns { ranks: 2 });
            assert!(errors.iter().all(refused), "{}: {errors:?}", algorithm.name);
        }
    }
}

#[test]
fn the_first_failure_is_told_to_all() {
    for bad in [vec![0], vec![2], vec![1, 3]] {
        let told = on_ranks(4, |ranks| {
            let failed = bad.contains(&ranks.rank());
            let mine = if failed { Err(PodError::NoModes) } else { Ok(ranks.rank()) };
            all_or_none(ranks, mine, |e| lumley_pod::Failure::new(ranks.rank(), e))
        });
        for (rank, told) in told.iter().enumerate() {
            let error = told.as_ref().expect_err("one has failed");
            match error {
                PodError::NoModes => assert_eq!(rank, bad[0]),
                PodError::Elsewhere(failure) => assert_eq!(failure.rank, bad[0]),
                _ => panic!("{error}"),
            }
        }
    }
    let fine = on_ranks(3, |ranks| {
        all_or_none(ranks, Ok::<_, PodError>(ranks.rank()), |_| unreachable!("nothing fails"))
    });
    assert!(fine.into_iter().enumerate().all(|(rank, told)| told.expect("no failure") == rank));
}

#[test]
fn every_rank_learns_which_snapshots_are_finite() {
    let mut x = random_matrix(N, 5, 1);
    (x[(0, 1)], x[(N - 1, 3)]) = (f64::NAN, f64::INFINITY);
    let x = MemorySnapshots::new(x, times(5));
    let finite = on_ranks(4, |ranks| {
        let execution = Execution { ranks, ..Execution::default() };
        finite_snapshots(&x, &Options::default(), execution).expect("x is in memory")
    });
    assert!(finite.iter().all(|of_rank| *of_rank == [0, 2, 4]), "{finite:?}");
}

/// The machine of one rank has less memory than that of the other: both hear of it.
#[test]
fn a_rank_without_memory_stops_all() {
    let x = MemorySnapshots::new(random_matrix(4000, 20, 3), times(20));
    for poor in [0, 1] {
        let found = on_ranks(2, |ranks| {
            let memory_limit = if ranks.rank() == poor { 1000 } else { 1 << 30 };
            let options = Options { memory_limit, ..Options::default() };
            let execution = Execution { ranks, ..Execution::default() };
            let (w, modes) = (Identity::new(4000), Shared::default());
            let error = (ALGORITHMS[0].stream)(&x, &w, &options, execution, &modes);
            let checked = finite_snapshots(&x, &options, execution);
            [error.expect_err("no memory"), checked.expect_err("no memory")]
        });
        for (rank, errors) in found.iter().enumerate() {
            for error in errors {
                let own = matches!(error, PodError::Memory { limit: 1000, .. });
                let heard = matches!(error, PodError::Elsewhere(failure) if failure.rank == poor);
                assert!(if rank == poor { own } else { heard }, "rank {rank}: {error}");
            }
        }
    }
}
