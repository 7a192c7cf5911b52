//! d′ from answers: how many standard deviations two stimuli lie apart.

use statrs::distribution::{ContinuousCDF as _, Normal};

/// Answers to trials in which two signals were different, and in which they were the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Counts {
    /// "Different" where they were.
    pub hits: u64,
    /// Trials in which they were different.
    pub n_different: u64,
    /// "Different" where they were the same.
    pub false_alarms: u64,
    /// Trials in which they were the same.
    pub n_same: u64,
}

/// What becomes of nobody and everybody, whose z-scores are infinite.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Correction {
    /// Half an answer more of both kinds, always (log-linear, Hautus 1995): no bias against large counts.
    #[default]
    LogLinear,
    /// Half an answer where there would be none.
    Clipped,
}

/// `d′ = z(H) - z(F)` of the shares of hits and false alarms; `None` where there were no trials of one kind, or more answers
/// than trials.
pub fn d_prime(counts: Counts, correction: Correction) -> Option<f64> {
    let Counts { hits, n_different, false_alarms, n_same } = counts;
    if n_different == 0 || n_same == 0 || hits > n_different || false_alarms > n_same {
        return None;
    }
    let share = |n: u64, of: u64| {
        let (n, of) = (n as f64, of as f64);
        match correction {
            Correction::LogLinear => (n + 0.5) / (of + 1.0),
            Correction::Clipped => (n / of).clamp(0.5 / of, 1.0 - 0.5 / of),
        }
    };
    let normal = Normal::standard();
    Some(normal.inverse_cdf(share(hits, n_different)) - normal.inverse_cdf(share(false_alarms, n_same)))
}
