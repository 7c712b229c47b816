//! Several processes, here threads with a store each, write one archive.

use crate::{Outcome, ROWS, decomposition, mean, modes, publish};
use lumley::Error;
use lumley::run::{BasisFile, FileModes};
use lumley_pod::{ModeStore, Ranks};
use std::fs;
use std::path::Path;
use std::sync::mpsc::{Receiver, Sender, channel};

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
        self.to[to].send(message.to_vec()).expect("the other rank listens");
    }

    fn receive(&self, from: usize) -> Vec<u8> {
        self.from[from].recv().expect("the other rank speaks")
    }
}

/// What each of `count` ranks makes of `work`.
fn on_ranks<T: Send>(count: usize, work: impl Fn(&Threads) -> T + Sync) -> Vec<T> {
    let mut ranks: Vec<_> =
        (0..count).map(|rank| Threads { rank, to: Vec::new(), from: Vec::new() }).collect();
    for from in 0..count {
        for to in 0..count {
            let (sender, receiver) = channel();
            ranks[from].to.push(sender);
            ranks[to].from.push(receiver);
        }
    }
    let work = &work;
    std::thread::scope(|scope| {
        let ranks = ranks.into_iter().map(|ranks| scope.spawn(move || work(&ranks)));
        let ranks: Vec<_> = ranks.collect();
        ranks.into_iter().map(|rank| rank.join().expect("no rank panics")).collect()
    })
}

/// Publishes the rows of a rank and finishes.
fn write(ranks: &Threads, folder: &Path) -> Result<(), Error> {
    let store = FileModes::new(folder);
    store.begin(ROWS, 3, true).expect("a file");
    let cut = |rank: usize| ROWS * rank / ranks.count();
    publish(&store, cut(ranks.rank)..cut(ranks.rank + 1)).expect("room on the disk");
    store.finish(ranks, &decomposition())
}

#[test]
fn any_number_of_ranks_makes_the_same_file() -> Outcome {
    let mut files = Vec::new();
    for count in [1, 2, 5] {
        let folder = tempfile::tempdir()?;
        on_ranks(count, |ranks| write(ranks, folder.path()))
            .into_iter()
            .collect::<Result<Vec<_>, _>>()?;
        let path = folder.path().join("pod.npz");
        let basis = BasisFile::load(&path)?;
        assert_eq!((basis.modes, basis.mean), (modes(), Some(mean())));
        assert_eq!(fs::read_dir(folder.path())?.count(), 1);
        files.push(fs::read(path)?);
    }
    assert!(files.iter().all(|file| *file == files[0]));
    Ok(())
}

/// What fails on rank 0 fails on all; none of them waits for ever.
#[test]
fn a_failure_of_one_rank_is_a_failure_of_all() -> Outcome {
    let folder = tempfile::tempdir()?;
    fs::create_dir(folder.path().join("pod.npz"))?;
    let outcomes = on_ranks(3, |ranks| write(ranks, folder.path()));
    for (rank, outcome) in outcomes.into_iter().enumerate() {
        let error = outcome.expect_err("a folder is in the place of the archive").to_string();
        assert!(error.contains("pod.npz"), "rank {rank}: {error}");
        assert!(rank == 0 || error.contains("rank 0"), "rank {rank}: {error}");
    }
    Ok(())
}

/// Ranks on machines that do not share a file system are told so.
#[test]
fn a_folder_that_is_not_shared_is_noticed() -> Outcome {
    let folders = [tempfile::tempdir()?, tempfile::tempdir()?];
    let outcomes = on_ranks(2, |ranks| write(ranks, folders[ranks.rank].path()));
    for outcome in outcomes {
        let error = outcome.expect_err("half of the rows are elsewhere").to_string();
        assert!(error.contains("file system that they share"), "{error}");
    }
    Ok(())
}
