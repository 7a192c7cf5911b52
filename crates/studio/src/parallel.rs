//! Parallel work on all processors.

use std::sync::atomic::{AtomicUsize, Ordering};

/// Returns `work(i)` for each `i` below `n`, in order; the result does not depend on the thread.
pub fn in_parallel<T: Send>(n: usize, work: impl Fn(usize) -> T + Sync) -> Vec<T> {
    in_parallel_by(n_processors(), n, work)
}

/// Returns the number of threads that run in parallel on this machine, at least 1.
pub fn n_processors() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// As [`in_parallel`], with at most `n_at_once` threads; must be at least 1.
pub fn in_parallel_by<T: Send>(n_at_once: usize, n: usize, work: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let next = AtomicUsize::new(0);
    let take = || {
        let mut done = Vec::new();
        while let Some(part) = Some(next.fetch_add(1, Ordering::Relaxed)).filter(|part| *part < n) {
            done.push((part, work(part)));
        }
        done
    };
    let mut done: Vec<(usize, T)> = std::thread::scope(|scope| {
        let workers: Vec<_> = (0..n_at_once.min(n)).map(|_| scope.spawn(take)).collect();
        workers
            .into_iter()
            .flat_map(|worker| worker.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
            .collect()
    });
    done.sort_by_key(|(part, _)| *part);
    done.into_iter().map(|(_, done)| done).collect()
}

#[cfg(test)]
mod tests {
    use super::{in_parallel, in_parallel_by};

    #[test]
    fn every_part_is_done_once_and_stands_in_its_place() {
        for n in [0, 1, 7, 500] {
            let expected: Vec<usize> = (0..n).map(|part| 3 * part).collect();
            assert_eq!(in_parallel(n, |part| 3 * part), expected);
            assert_eq!(in_parallel_by(1, n, |part| 3 * part), expected);
        }
    }
}
