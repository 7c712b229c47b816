use super::{RanksError, launched_processes};
use lumley_pod::Ranks;
use mpi::Threading;
use mpi::environment::{Universe, initialize_with_threading};
use mpi::topology::{Process, SimpleCommunicator};
use mpi::traits::{Communicator as _, Destination as _, Source as _};
use std::marker::PhantomData;

/// Bytes of one MPI message at most. MPI counts in a C `int`, so that a longer one must go in
/// pieces; this is far below that limit, and long enough for the full rate.
const PIECE: usize = 1 << 24;

/// The processes that `mpirun` started, joined by MPI.
///
/// A message is its length, then its bytes in pieces of at most 16 MiB; all ranks must be
/// processes of the same architecture. MPI keeps the order of messages between two ranks.
///
/// `send` may wait until the other rank receives. A reduction to the root of a tree, in which a
/// rank receives from its children and then sends to its parent, and the broadcast back down
/// cannot lock: every rank waits along the tree only, in the direction in which the messages come,
/// and a leaf (the root, on the way down) waits for no message. Two ranks that both send to each
/// other before they receive can lock.
///
/// MPI is asked for threads that leave it alone (`MPI_THREAD_FUNNELED`): this type stays on the
/// thread that initialised MPI (it is neither `Send` nor `Sync`), and the others compute.
///
/// # The end
/// An MPI error ends the whole job, and so does a rank that drops this without [`finalise`]: by a
/// panic, or by an error passed on. No rank is left waiting for one that is gone.
///
/// ```
/// use lumley::ranks::MpiRanks;
/// use lumley_pod::Ranks as _;
/// let ranks = MpiRanks::initialise()?;
/// assert!(ranks.rank() < ranks.count());
/// ranks.finalise();
/// # Ok::<(), lumley::ranks::RanksError>(())
/// ```
///
/// [`finalise`]: Self::finalise
pub struct MpiRanks {
    world: SimpleCommunicator,
    neighbours: usize,
    finished: bool,
    /// Finalises MPI when dropped.
    _universe: Universe,
    /// Neither `Send` nor `Sync`, also with an MPI whose communicators are numbers.
    one_thread: PhantomData<*const ()>,
}

impl MpiRanks {
    /// Joins the processes that were started together with this one; alone, it is rank 0 of 1.
    ///
    /// # Errors
    /// [`RanksError::AlreadyInitialised`], [`RanksError::NoThreads`], and [`RanksError::Launcher`]
    /// when MPI found another number of processes than were started. An MPI that cannot start at
    /// all says why itself and ends the process.
    pub fn initialise() -> Result<Self, RanksError> {
        let (universe, threading) =
            initialize_with_threading(Threading::Funneled).ok_or(RanksError::AlreadyInitialised)?;
        if threading < Threading::Funneled {
            return Err(RanksError::NoThreads);
        }
        let world = universe.world();
        let (started, joined) = (launched_processes(), from_mpi(world.size()));
        if started != joined {
            return Err(RanksError::Launcher { started, joined });
        }
        let neighbours = from_mpi(world.split_shared(world.rank()).size());
        let (finished, one_thread) = (false, PhantomData);
        Ok(Self { world, neighbours, finished, _universe: universe, one_thread })
    }

    /// How many ranks, this one among them, share the memory of one machine.
    pub fn neighbours(&self) -> usize {
        self.neighbours
    }

    /// Ends MPI; waits for every other rank to come here too.
    pub fn finalise(mut self) {
        self.finished = true;
    }

    /// Ends every rank's process at once; `mpirun` returns `status`, 1 to 255. What this rank has
    /// to say must be written before.
    pub fn abort(&self, status: u8) -> ! {
        self.world.abort(status.into())
    }

    fn peer(&self, rank: usize) -> Process<'_> {
        assert!(rank != self.rank(), "rank {rank} would wait for a message of its own");
        self.world.process_at_rank(i32::try_from(rank).expect("MPI counts ranks in an i32"))
    }
}

impl Ranks for MpiRanks {
    fn rank(&self) -> usize {
        from_mpi(self.world.rank())
    }

    fn count(&self) -> usize {
        from_mpi(self.world.size())
    }

    fn send(&self, to: usize, message: &[u8]) {
        let to = self.peer(to);
        to.send(&message.len());
        message.chunks(PIECE).for_each(|piece| to.send(piece));
    }

    fn receive(&self, from: usize) -> Vec<u8> {
        let from = self.peer(from);
        let (length, _) = from.receive::<usize>();
        let mut message = vec![0; length];
        for piece in message.chunks_mut(PIECE) {
            from.receive_into(piece);
        }
        message
    }
}

impl Drop for MpiRanks {
    fn drop(&mut self) {
        if !self.finished {
            self.abort(1);
        }
    }
}

fn from_mpi(count: i32) -> usize {
    usize::try_from(count).expect("MPI counts ranks from 0")
}
