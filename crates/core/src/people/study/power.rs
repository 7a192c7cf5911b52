//! Number of participants that a study needs, from simulated repetitions of it.
//!
//! A decision, such as "the two conditions differ", is made in many simulated studies. The power at a number of participants is
//! the share of these studies with a right decision. It depends on the simulated participants, so state their properties with it.

use crate::maths::rng::derive_seed;

/// Power at one number of participants.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Power {
    /// Number of participants of each study.
    pub n_participants: usize,
    /// Number of studies.
    pub n_studies: usize,
    /// Number of studies in which the decision holds.
    pub n_held: usize,
}

impl Power {
    /// Share of the studies in which the decision holds, 0 to 1; 0 without studies.
    pub fn share(self) -> f64 {
        if self.n_studies == 0 { 0.0 } else { self.n_held as f64 / self.n_studies as f64 }
    }

    /// Standard error of the share, from the number of studies.
    pub fn standard_error(self) -> f64 {
        if self.n_studies == 0 {
            return 0.0;
        }
        let share = self.share();
        (share * (1.0 - share) / self.n_studies as f64).sqrt()
    }
}

/// Power at each of these numbers of participants, from `n_studies` studies each. `decide` simulates a study with a number of
/// participants and a seed, and returns whether the decision holds in it. Studies have different seeds, which follow from
/// `seed`.
///
/// # Errors
/// The first error of `decide`.
pub fn power<E>(
    numbers: &[usize],
    n_studies: usize,
    seed: u64,
    mut decide: impl FnMut(usize, u64) -> Result<bool, E>,
) -> Result<Vec<Power>, E> {
    let mut all = Vec::with_capacity(numbers.len());
    for n_participants in numbers.iter().copied() {
        let mut n_held = 0;
        for study in 0..n_studies {
            let seed = derive_seed(seed, &format!("{n_participants} participants, study {study}"));
            n_held += usize::from(decide(n_participants, seed)?);
        }
        all.push(Power { n_participants, n_studies, n_held });
    }
    Ok(all)
}

/// Smallest of the numbers from which on the power stays at `wanted` (0 to 1) or above; `None` if the largest number is
/// too small.
pub fn participants_needed(powers: &[Power], wanted: f64) -> Option<usize> {
    let mut sorted = powers.to_vec();
    sorted.sort_by_key(|power| power.n_participants);
    let enough = sorted.iter().rev().take_while(|power| power.share() >= wanted);
    enough.last().map(|power| power.n_participants)
}

#[cfg(test)]
mod tests {
    use super::{Power, participants_needed, power};
    use crate::maths::rng::Random;
    use crate::maths::statistics::{mean, standard_deviation, t_quantile_two_sided};

    fn at(n_participants: usize, n_held: usize) -> Power {
        Power { n_participants, n_studies: 10, n_held }
    }

    /// Power of the one-sample t test with 6, 10 and 20 participants for an effect of 0.8 standard deviations, from the
    /// noncentral t distribution (`TTestPower` of statsmodels 0.15).
    const EXPECTED: [f64; 3] = [0.356_174, 0.616_233, 0.923_899];

    #[test]
    fn the_power_of_a_t_test_is_that_of_the_noncentral_distribution() {
        let decide = |n: usize, seed: u64| {
            let mut random = Random::new(seed);
            let values: Vec<f64> = (0..n).map(|_| 0.8 + random.normal()).collect();
            let t = mean(&values) / standard_deviation(&values) * (n as f64).sqrt();
            Ok::<bool, ()>(t.abs() > t_quantile_two_sided(0.05, (n - 1) as f64))
        };
        let powers = power(&[6, 10, 20], 4000, 3, decide).unwrap();
        for (power, expected) in powers.iter().zip(EXPECTED) {
            // Four standard errors of 4,000 studies.
            assert!(
                (power.share() - expected).abs() < 4.0 * power.standard_error(),
                "{power:?}, not {expected}"
            );
        }
        assert_eq!(powers, power(&[6, 10, 20], 4000, 3, decide).unwrap());
        assert_eq!(participants_needed(&powers, 0.8), Some(20));
    }

    #[test]
    fn the_number_needed_is_the_first_that_stays_enough() {
        let powers = [at(30, 9), at(10, 9), at(20, 7), at(40, 10)];
        assert_eq!(participants_needed(&powers, 0.8), Some(30));
        assert_eq!(participants_needed(&powers, 1.0), Some(40));
        assert_eq!(participants_needed(&[at(10, 2)], 0.8), None);
        assert_eq!(participants_needed(&[], 0.8), None);
    }

    #[test]
    fn an_error_ends_the_simulation() {
        let mut n = 0;
        let result = power(&[3], 10, 1, |_, _| {
            n += 1;
            if n == 4 { Err("it") } else { Ok(true) }
        });
        assert_eq!((result, n), (Err("it"), 4));
        let none = Power { n_participants: 3, n_studies: 0, n_held: 0 };
        assert_eq!((none.share(), none.standard_error()), (0.0, 0.0));
    }
}
