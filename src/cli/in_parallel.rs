//! Work of many like parts, on all processors.

use std::sync::atomic::{AtomicUsize, Ordering};

/// What comes of each part below `n`, in their order: which thread does which does not matter.
pub(crate) fn in_parallel<T: Send>(n: usize, work: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let next = AtomicUsize::new(0);
    let take = || {
        let mut done = Vec::new();
        while let Some(part) = Some(next.fetch_add(1, Ordering::Relaxed)).filter(|part| *part < n) {
            done.push((part, work(part)));
        }
        done
    };
    let n_threads = std::thread::available_parallelism().map_or(1, usize::from).min(n);
    let mut done: Vec<(usize, T)> = std::thread::scope(|scope| {
        let workers: Vec<_> = (0..n_threads).map(|_| scope.spawn(take)).collect();
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
    use super::in_parallel;

    #[test]
    fn every_part_is_done_once_and_stands_in_its_place() {
        for n in [0, 1, 7, 500] {
            assert_eq!(in_parallel(n, |part| 3 * part), (0..n).map(|part| 3 * part).collect::<Vec<_>>());
        }
    }
}
