//! d′ from same-different answers: the discriminability of two stimuli in standard deviations.

use statrs::distribution::{ContinuousCDF as _, Normal};

/// Answer counts of a same-different experiment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Counts {
    /// "Different" answers to different pairs.
    pub hits: u64,
    /// Number of trials with different pairs.
    pub n_different: u64,
    /// "Different" answers to identical pairs.
    pub false_alarms: u64,
    /// Number of trials with identical pairs.
    pub n_same: u64,
}

/// Correction of rates of 0 and 1, whose z-scores are infinite.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Correction {
    /// Always adds half an answer of each kind (log-linear, Hautus 1995): no bias against large counts.
    #[default]
    LogLinear,
    /// Replaces a rate of 0 or 1 by half an answer off that end.
    Clipped,
}

/// Returns `d′ = z(H) - z(F)` from hit rate H and false-alarm rate F.
///
/// `None` if one kind of trial is missing or there are more answers than trials.
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

/// Returns the proportion of correct answers to the yes-no question "different?", 0.5 to 1, of an observer without bias
/// whose discriminability is `d_prime`, 0 or more. It is 69 % at a d′ of 1.
///
/// It is not that of a two-alternative forced choice, in which the observer feels both signals and names one of them:
/// Φ(d′/√2), 76 % at a d′ of 1. Without bias, F = 1 - H, so that `d′ = z(H) - z(F)` gives z(H) = d′/2. With as many identical
/// as different pairs, the proportion is Φ(d′/2), where Φ is the cumulative distribution function of the standard normal
/// distribution.
pub fn proportion_correct(d_prime: f64) -> f64 {
    Normal::standard().cdf(0.5 * d_prime)
}
