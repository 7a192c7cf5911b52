//! d′ from same-different answers: the discriminability of two stimuli in standard deviations of their perception.
//!
//! Three models of the observer give three values. [`d_prime`] is that of the yes-no question "different?", as in the
//! paper on the quality of compressed textures. In a trial with two stimuli, an observer can compare their difference with
//! a criterion ([`differencing`]), or classify each of the two by itself ([`independent_observation`]); both models need a
//! larger d′ for the same answers (Macmillan and Creelman, *Detection Theory*, chapter 9).

use std::f64::consts::SQRT_2;

use statrs::distribution::{ContinuousCDF as _, Normal};

/// Answer counts of a same-different experiment.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
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

/// Hit rate and false-alarm rate, 0 to 1, ends excluded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rates {
    /// Proportion of "different" answers to different pairs.
    pub hit: f64,
    /// Proportion of "different" answers to identical pairs.
    pub false_alarm: f64,
}

impl Counts {
    /// Returns both rates after the correction; `None` if one kind of trial is missing or there are more answers than
    /// trials.
    pub fn rates(self, correction: Correction) -> Option<Rates> {
        let Self { hits, n_different, false_alarms, n_same } = self;
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
        Some(Rates { hit: share(hits, n_different), false_alarm: share(false_alarms, n_same) })
    }
}

/// Returns `d′ = z(H) - z(F)` from hit rate H and false-alarm rate F.
///
/// `None` if one kind of trial is missing or there are more answers than trials.
pub fn d_prime(counts: Counts, correction: Correction) -> Option<f64> {
    counts.rates(correction).map(difference_of_z_scores)
}

fn difference_of_z_scores(rates: Rates) -> f64 {
    let normal = Normal::standard();
    normal.inverse_cdf(rates.hit) - normal.inverse_cdf(rates.false_alarm)
}

/// Largest d′ of the differencing model; an observer with it answers correctly in all trials that a study can have.
const MOST: f64 = 40.0;

/// Number of halvings of the interval of d′: more than a number of 64 bits resolves.
const N_HALVINGS: u32 = 64;

/// Returns the d′, 0 or more, of an observer who answers "different" if the difference of the two perceptions exceeds a
/// criterion `k`: `F = 2 Φ(-k/√2)` and `H = Φ((d′ - k)/√2) + Φ((-d′ - k)/√2)`.
///
/// It is 0 if the hit rate does not exceed the false-alarm rate.
pub fn differencing(rates: Rates) -> f64 {
    let normal = Normal::standard();
    let criterion = -SQRT_2 * normal.inverse_cdf(0.5 * rates.false_alarm);
    let hit_rate = |d: f64| normal.cdf((d - criterion) / SQRT_2) + normal.cdf((-d - criterion) / SQRT_2);
    if rates.hit <= rates.false_alarm {
        return 0.0;
    }
    // The hit rate rises with d′, so halving the interval finds it.
    let (mut low, mut high) = (0.0, MOST);
    for _ in 0..N_HALVINGS {
        let middle = 0.5 * (low + high);
        if hit_rate(middle) < rates.hit { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// Returns the d′, 0 or more, of an observer who classifies each of the two stimuli by itself and answers "different" if
/// the classes differ: `d′ = 2 z(½ + ½ √(2p - 1))`, where `p = Φ(½ (z(H) - z(F)))` is the proportion of correct answers
/// without bias.
///
/// It is 0 if the hit rate does not exceed the false-alarm rate.
pub fn independent_observation(rates: Rates) -> f64 {
    let normal = Normal::standard();
    let correct = normal.cdf(0.5 * difference_of_z_scores(rates));
    if correct <= 0.5 {
        return 0.0;
    }
    2.0 * normal.inverse_cdf(0.5 + 0.5 * (2.0 * correct - 1.0).sqrt())
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

#[cfg(test)]
mod tests;
