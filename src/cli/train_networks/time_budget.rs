//! Division of a time budget among networks.

use std::time::{Duration, Instant};

/// Time for all networks together.
#[derive(Clone, Copy, Debug)]
pub(super) struct TimeBudget {
    end: Instant,
}

impl TimeBudget {
    /// Returns a budget that starts now.
    pub(super) fn starting(now: Instant, minutes: f64) -> Self {
        Self { end: now + Duration::from_secs_f64(60.0 * minutes) }
    }

    /// Returns when a network that starts now must stop: the time left is divided evenly among the rounds of networks
    /// that are trained one after the other, of which its own is the first. Time that an earlier network did not need
    /// is divided among the later ones.
    pub(super) fn deadline(self, now: Instant, n_rounds: usize) -> Instant {
        let n_rounds = u32::try_from(n_rounds.max(1)).unwrap_or(u32::MAX);
        now + self.end.saturating_duration_since(now) / n_rounds
    }
}

/// Returns the number of rounds of `n` networks of which `n_jobs` are trained at a time.
pub(super) fn n_rounds(n: usize, n_jobs: usize) -> usize {
    n.div_ceil(n_jobs.max(1))
}

#[cfg(test)]
mod tests {
    use super::{TimeBudget, n_rounds};
    use std::time::{Duration, Instant};

    #[test]
    fn networks_of_equal_rounds_get_equal_times() {
        let begin = Instant::now();
        let budget = TimeBudget::starting(begin, 2.0);
        let (n, n_jobs) = (25, 2);
        let n_rounds = n_rounds(n, n_jobs);
        assert_eq!(n_rounds, 13);
        let mut now = begin;
        for round in 0..n_rounds {
            let until = budget.deadline(now, n_rounds - round);
            let share = (until - now).as_secs_f64();
            assert!((share - 120.0 / 13.0).abs() < 1e-6, "round {round}: {share}");
            now = until;
        }
        assert!(((now - begin).as_secs_f64() - 120.0).abs() < 1e-6);
    }

    #[test]
    fn time_that_is_left_over_goes_to_later_networks_and_no_time_is_none() {
        let begin = Instant::now();
        let budget = TimeBudget::starting(begin, 1.0);
        let early = begin + Duration::from_secs(10);
        assert_eq!(budget.deadline(early, 2), early + Duration::from_secs(25));
        let late = begin + Duration::from_secs(70);
        assert_eq!(budget.deadline(late, 3), late);
        assert_eq!((n_rounds(0, 2), n_rounds(3, 0), n_rounds(4, 4)), (0, 3, 1));
    }
}
