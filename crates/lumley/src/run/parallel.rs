use crate::Error;
use crate::progress::Progress;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// `work` on every job by `threads` threads; results in the order of the jobs.
pub(super) fn in_parallel<J: Sync, R: Send>(
    jobs: &[J],
    threads: usize,
    progress: &mut Progress,
    work: &(dyn Fn(&J) -> Result<R, Error> + Sync),
) -> Result<Vec<R>, Error> {
    let (next, done) = (AtomicUsize::new(0), Mutex::new((0, progress)));
    let worker = || {
        let mut results = Vec::new();
        loop {
            let k = next.fetch_add(1, Ordering::Relaxed);
            let Some(job) = jobs.get(k) else { return results };
            results.push((k, work(job)));
            if let Ok(mut guard) = done.lock() {
                guard.0 += 1;
                let count = guard.0;
                guard.1.advance(count, "");
            }
        }
    };
    let mut results: Vec<(usize, Result<R, Error>)> = std::thread::scope(|scope| {
        let handles: Vec<_> = (1..threads.max(1)).map(|_| scope.spawn(worker)).collect();
        let mine = worker();
        let others = handles.into_iter().flat_map(|h| h.join().expect("a worker does not panic"));
        mine.into_iter().chain(others).collect()
    });
    results.sort_by_key(|(k, _)| *k);
    results.into_iter().map(|(_, result)| result).collect()
}
