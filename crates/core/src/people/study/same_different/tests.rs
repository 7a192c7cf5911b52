use std::f64::consts::SQRT_2;

use proptest::prelude::{prop_assert, proptest};
use serde_json::Value;
use statrs::distribution::{ContinuousCDF as _, Normal};

use super::{Correction, Counts, Rates, d_prime, differencing, independent_observation, proportion_correct};
use crate::maths::rng::Random;

fn golden() -> Value {
    serde_json::from_str(include_str!("../../../../../../vectors/h_thresh/quality_vectors.json")).unwrap()
}

#[test]
fn golden_d_primes() {
    let v = golden();
    for (hits, false_alarms) in [(72, 72), (100, 44), (140, 10), (144, 0), (144, 5)] {
        let counts = Counts { hits, n_different: 144, false_alarms, n_same: 144 };
        let want = &v["dprime"][format!("h{hits}_f{false_alarms}")];
        for (correction, key) in [(Correction::LogLinear, "loglinear"), (Correction::Clipped, "clip")] {
            let got = d_prime(counts, correction).unwrap();
            assert!((got - want[key].as_f64().unwrap()).abs() < 1e-9, "{hits}, {false_alarms}: {got}");
        }
    }
    let none = Counts { hits: 0, n_different: 0, false_alarms: 0, n_same: 4 };
    let more = Counts { hits: 5, n_different: 4, false_alarms: 0, n_same: 4 };
    assert_eq!((d_prime(none, Correction::LogLinear), d_prime(more, Correction::Clipped)), (None, None));
}

/// Answers without bias: as many hits as correct rejections, so the share of hits is the proportion.
#[test]
fn the_proportion_of_correct_answers_is_that_of_an_observer_without_bias() {
    for (hits, share) in [(60, 0.6), (90, 0.9), (99, 0.99)] {
        let counts = Counts { hits, n_different: 100, false_alarms: 100 - hits, n_same: 100 };
        let got = proportion_correct(d_prime(counts, Correction::Clipped).unwrap());
        assert!((got - share).abs() < 1e-9, "{got} for {share}");
    }
    // Φ(1/2), from a table of the normal distribution.
    assert!((proportion_correct(1.0) - 0.691_462_461).abs() < 1e-9);
    assert!((proportion_correct(0.0) - 0.5).abs() < 1e-15);
}

/// Values from scipy 1.17: `norm.ppf` and `norm.cdf`, the differencing model solved by `brentq`.
#[test]
fn both_models_of_two_stimuli_are_those_of_scipy() {
    for (hit, false_alarm, of_differencing, of_independent) in [
        (0.8, 0.3, 2.646_808_273_845_750_6, 2.120_261_690_763_577_6),
        (0.55, 0.5, 0.700_924_417_367_722_4, 0.568_620_319_105_517_4),
        (0.95, 0.05, 5.097_981_776_093_409, 3.897_643_725_014_117_6),
        (0.99, 0.2, 5.102_313_489_685_695, 3.786_901_646_879_512),
        (0.3, 0.1, 1.572_666_384_041_567, 1.488_041_809_819_313_8),
    ] {
        let rates = Rates { hit, false_alarm };
        // The inverse normal distribution has about twelve digits.
        assert!((differencing(rates) - of_differencing).abs() < 1e-9, "{}", differencing(rates));
        let got = independent_observation(rates);
        assert!((got - of_independent).abs() < 1e-9, "{got}");
    }
}

#[test]
fn without_more_hits_than_false_alarms_both_are_zero() {
    for (hit, false_alarm) in [(0.5, 0.5), (0.2, 0.6)] {
        let rates = Rates { hit, false_alarm };
        assert_eq!((differencing(rates), independent_observation(rates)), (0.0, 0.0));
    }
}

/// Observers that act as the models say: their d′ comes back within the error of the counts.
#[test]
fn simulated_observers_of_both_models_have_their_d_prime() {
    const N: u32 = 200_000;
    let d = 2.0;
    let mut random = Random::new(4);
    let share = |n: u32| f64::from(n) / f64::from(N);
    let mut rate = |is_different: bool, decide: &dyn Fn(f64, f64) -> bool| {
        let n = (0..N).filter(|trial| {
            // Of identical pairs, half are the first stimulus twice, half the second.
            let one = if is_different || trial.is_multiple_of(2) { 0.0 } else { d };
            let other = if is_different { d } else { one };
            decide(one + random.normal(), other + random.normal())
        });
        share(n.count() as u32)
    };
    let by_difference = |one: f64, other: f64| (one - other).abs() > 1.5;
    let by_class = |one: f64, other: f64| (one > 0.5 * d) != (other > 0.5 * d);
    let rates = Rates { hit: rate(true, &by_difference), false_alarm: rate(false, &by_difference) };
    // Rates have a standard error of 0.0011, and d′ changes by about 4 for each unit of a rate.
    assert!((differencing(rates) - d).abs() < 0.03, "{}", differencing(rates));
    let rates = Rates { hit: rate(true, &by_class), false_alarm: rate(false, &by_class) };
    let got = independent_observation(rates);
    assert!((got - d).abs() < 0.03, "{got}");
}

proptest! {
    #[test]
    fn differencing_undoes_its_own_rates(d in 0.2..6.0_f64, criterion in 0.2..4.0_f64) {
        let normal = Normal::standard();
        let false_alarm = 2.0 * normal.cdf(-criterion / SQRT_2);
        let hit = normal.cdf((d - criterion) / SQRT_2) + normal.cdf((-d - criterion) / SQRT_2);
        let got = differencing(Rates { hit, false_alarm });
        // Near a hit rate of 1, a rate in 64 bits does not resolve d′ better.
        prop_assert!((got - d).abs() < 1e-5, "{got} for {d}");
    }

    #[test]
    fn the_yes_no_model_needs_the_least_d_prime(hits in 51_u64..100, false_alarms in 0_u64..50) {
        let counts = Counts { hits, n_different: 100, false_alarms, n_same: 100 };
        let rates = counts.rates(Correction::LogLinear).unwrap();
        let yes_no = d_prime(counts, Correction::LogLinear).unwrap();
        let independent = independent_observation(rates);
        prop_assert!(independent >= yes_no - 1e-9);
        prop_assert!(differencing(rates) >= yes_no - 1e-9);
    }
}
