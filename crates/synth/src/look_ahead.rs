//! Look-ahead limiter: reduces the gain before a peak arrives instead of distorting the peak.

use crate::limiter::bend;

/// Longest look-ahead, in samples: 2 ms at 192 kHz (384 samples) with a margin.
pub const MAX_LOOK_AHEAD: usize = 512;
/// Release time constant of the gain, in seconds.
const RELEASE_SECS: f64 = 0.05;
/// Fixed-point representation of gain 1. Sums of integers do not drift.
const ONE: u32 = 1 << 30;
/// A gain within this distance of 1 is rounded to 1.
const NEARLY: f64 = 1e-5;

/// Delays the signal by the look-ahead and multiplies it by a smooth gain of at most 1. For each sample, the gain is at
/// most the gain that brings the sample to the soft-knee curve.
///
/// The gain that each sample requires passes through a release with a time constant of 50 ms. The result is replaced by
/// its minimum over the look-ahead, then averaged over the look-ahead. Every mean that applies to a sample is thus a
/// mean of minima that include the sample's own required gain. Below the knee, and after the release ends, samples are
/// unchanged. Cost: a few comparisons per sample, amortized.
#[derive(Clone, Debug)]
pub struct LookAhead {
    knee: f32,
    ceiling: f32,
    release: f64,
    /// Delay in samples; the minimum and the mean each span `delay + 1` samples.
    delay: usize,
    samples: [f32; MAX_LOOK_AHEAD],
    minima: [u32; MAX_LOOK_AHEAD],
    sum: u64,
    /// Candidates for the minimum as a ring, lowest first: gain and start time.
    candidates: [(u32, u64); MAX_LOOK_AHEAD],
    first: usize,
    n_candidates: usize,
    now: u64,
    envelope: f64,
    limited_samples: u64,
}

impl LookAhead {
    /// A limiter with output between `-ceiling` and `ceiling`, linear up to the fraction `knee_share` of the ceiling,
    /// with a look-ahead of `delay` samples (clamped to [`MAX_LOOK_AHEAD`] − 1).
    pub fn new(ceiling: f32, knee_share: f32, delay: usize, rate_hz: f32) -> Self {
        let delay = delay.min(MAX_LOOK_AHEAD - 1);
        Self {
            knee: ceiling * knee_share,
            ceiling,
            release: 1.0 / (RELEASE_SECS * f64::from(rate_hz)).max(1.0),
            delay,
            samples: [0.0; MAX_LOOK_AHEAD],
            minima: [ONE; MAX_LOOK_AHEAD],
            sum: (delay as u64 + 1) * u64::from(ONE),
            candidates: [(ONE, 0); MAX_LOOK_AHEAD],
            first: 0,
            n_candidates: 0,
            now: 0,
            envelope: 1.0,
            limited_samples: 0,
        }
    }

    /// Delay of the output in samples.
    pub fn delay(&self) -> usize {
        self.delay
    }

    /// Number of nonzero samples that were attenuated since the start.
    pub fn limited_samples(&self) -> u64 {
        self.limited_samples
    }

    /// Takes a sample and returns the limited sample of `delay` samples ago. A non-finite sample stays non-finite.
    pub fn next(&mut self, sample: f32) -> f32 {
        let needed = f64::from(self.needed(sample));
        self.envelope = if needed < self.envelope {
            needed
        } else {
            self.envelope + self.release * (needed - self.envelope)
        };
        if self.envelope > 1.0 - NEARLY {
            self.envelope = 1.0;
        }
        let minimum = self.lowest((self.envelope * f64::from(ONE)) as u32);
        let slot = (self.now % (self.delay as u64 + 1)) as usize;
        self.now += 1;
        self.sum = self.sum + u64::from(minimum) - u64::from(self.minima[slot]);
        self.minima[slot] = minimum;
        let next_slot = if slot == self.delay { 0 } else { slot + 1 };
        self.samples[slot] = sample;
        // With zero delay this is the slot that was just filled.
        let delayed = self.samples[next_slot];
        let whole = (self.delay as u64 + 1) * u64::from(ONE);
        if self.sum == whole {
            return delayed;
        }
        self.limited_samples += u64::from(delayed != 0.0);
        delayed * (self.sum as f64 / whole as f64) as f32
    }

    /// Clears the delayed samples and the gain history.
    pub fn reset(&mut self) {
        self.samples = [0.0; MAX_LOOK_AHEAD];
        self.minima = [ONE; MAX_LOOK_AHEAD];
        self.sum = (self.delay as u64 + 1) * u64::from(ONE);
        self.n_candidates = 0;
        self.envelope = 1.0;
    }

    /// Gain that brings a sample to the soft-knee curve, 0..1.
    fn needed(&self, sample: f32) -> f32 {
        let magnitude = sample.abs();
        if magnitude <= self.knee {
            return 1.0;
        }
        let gain = bend(magnitude, self.knee, self.ceiling) / magnitude;
        // Infinity divided by infinity is NaN; a non-finite sample gets gain 0.
        if gain.is_finite() { gain } else { 0.0 }
    }

    /// Lowest gain of this and the last `delay` samples.
    fn lowest(&mut self, gain: u32) -> u32 {
        let place = |first: usize, i: usize| (first + i) % MAX_LOOK_AHEAD;
        while self.n_candidates > 0 && self.candidates[place(self.first, self.n_candidates - 1)].0 >= gain {
            self.n_candidates -= 1;
        }
        if self.n_candidates > 0 && self.candidates[self.first].1 + (self.delay as u64) < self.now {
            self.first = place(self.first, 1);
            self.n_candidates -= 1;
        }
        self.candidates[place(self.first, self.n_candidates)] = (gain, self.now);
        self.n_candidates += 1;
        self.candidates[self.first].0
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::{LookAhead, MAX_LOOK_AHEAD, bend};
    use proptest::prelude::{any, prop_assert, proptest};
    use std::vec::Vec;

    const RATE_HZ: f32 = 48_000.0;

    fn limiter(delay: usize) -> LookAhead {
        LookAhead::new(0.9, 0.8, delay, RATE_HZ)
    }

    /// Reference implementation: minima and means computed from their definitions, in `f64`.
    fn oracle(input: &[f32], delay: usize) -> Vec<f64> {
        let release = 1.0 / (0.05 * f64::from(RATE_HZ));
        let mut envelope = 1.0_f64;
        let needs: Vec<f64> = input
            .iter()
            .map(|x| {
                let x = x.abs();
                let need = if x <= 0.72 { 1.0 } else { f64::from(bend(x, 0.9 * 0.8, 0.9) / x) };
                envelope = if need < envelope { need } else { envelope + release * (need - envelope) };
                if envelope > 1.0 - 1e-5 {
                    envelope = 1.0;
                }
                envelope
            })
            .collect();
        let back = |values: &[f64], i: usize, k: usize| if k > i { 1.0 } else { values[i - k] };
        let minima: Vec<f64> =
            (0..needs.len()).map(|i| (0..=delay).map(|k| back(&needs, i, k)).fold(1.0, f64::min)).collect();
        (0..input.len())
            .map(|i| {
                let gain = (0..=delay).map(|k| back(&minima, i, k)).sum::<f64>() / (delay as f64 + 1.0);
                if i < delay { 0.0 } else { gain * f64::from(input[i - delay]) }
            })
            .collect()
    }

    fn bursts() -> Vec<f32> {
        (0..6000)
            .map(|i| {
                let loud = if i / 700 % 3 == 1 { 2.5 } else { 0.6 };
                loud * ((i * i % 1013) as f32 / 506.0 - 1.0)
            })
            .collect()
    }

    #[test]
    fn does_what_its_definition_says() {
        for delay in [0, 1, 5, 96, MAX_LOOK_AHEAD - 1] {
            let mut limiter = limiter(delay);
            assert_eq!(limiter.delay(), delay);
            let input = bursts();
            for (i, (x, expected)) in input.iter().zip(oracle(&input, delay)).enumerate() {
                let out = f64::from(limiter.next(*x));
                // The gain is rounded to f32 before it is multiplied with the sample.
                assert!((out - expected).abs() < 1e-6, "{out} for {expected} at {i}, delay {delay}");
            }
        }
    }

    #[test]
    fn what_stays_below_the_knee_comes_out_as_it_went_in() {
        let mut limiter = limiter(96);
        let input: Vec<f32> = bursts().iter().map(|x| 0.28 * x).collect();
        let out: Vec<f32> = input.iter().map(|x| limiter.next(*x)).collect();
        assert_eq!(out[96..], input[..input.len() - 96]);
        assert_eq!(limiter.limited_samples(), 0);
        // The same holds after a peak has passed and the release has ended.
        limiter.next(5.0);
        for _ in 0..48_000 {
            limiter.next(0.5);
        }
        let n_limited = limiter.limited_samples();
        assert!(n_limited > 0);
        assert_eq!(limiter.next(0.1), 0.5);
        assert_eq!(limiter.limited_samples(), n_limited);
    }

    #[test]
    fn a_peak_is_turned_down_without_a_jump() {
        let mut limiter = limiter(96);
        let mut last = 0.0_f32;
        for i in 0_u16..20_000 {
            // The loud part starts and ends at zeros of the sine.
            let loud = if (5027..9111).contains(&i) { 2.0 } else { 0.7 };
            let out = limiter.next(loud * (f32::from(i) * 0.01).sin());
            // The unattenuated sine itself moves by at most 2 × 0.01 per sample; the gain moves by a fraction of 1/97.
            assert!((out - last).abs() < 0.02 + 2.0 * 2.0 / 97.0, "{last} to {out} at {i}");
            last = out;
        }
    }

    #[test]
    fn what_is_not_finite_comes_out_not_finite() {
        for bad in [f32::NAN, f32::INFINITY] {
            let mut limiter = limiter(10);
            limiter.next(bad);
            let out: Vec<f32> = (0..10).map(|_| limiter.next(0.1)).collect();
            assert!(!out[9].is_finite() && out[..9].iter().all(|x| x.is_finite()), "{out:?}");
            limiter.reset();
            assert!((0..200).all(|_| limiter.next(0.1).is_finite()));
        }
    }

    proptest! {
        #[test]
        fn nothing_exceeds_the_ceiling(input in proptest::collection::vec(any::<f32>(), 1..400), delay in 0_usize..120) {
            let mut limiter = limiter(delay);
            for x in input.into_iter().chain([0.0; 120]) {
                let out = limiter.next(if x.is_finite() { x } else { 1.0 });
                // The margin is one rounding.
                prop_assert!(out.abs() <= 0.9 * 1.000_001, "{out}");
            }
        }
    }
}
