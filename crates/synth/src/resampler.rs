//! Sample-rate conversion from model rate to device rate: images at least 70 dB down, a delay of a few milliseconds.
//!
//! The first of two stages doubles the rate with an elliptic low-pass. It is flat up to 0.92 of the model's Nyquist
//! frequency and 70 dB down from the Nyquist frequency, so that it rejects *every* image of the model's band. A
//! linear-phase filter as steep would delay by 20 ms; this one delays by 1.6 ms at low frequencies. The second stage
//! interpolates between the doubled samples with a short windowed sinc, for any ratio of rates. Its images lie above
//! three times the model's Nyquist frequency and are at least as far down.

use core::f64::consts::PI;

use libm::{fabs, sin, sqrt};

/// Second-order sections `b0 b1 b2 a1 a2` of `ellip(10, 0.05 dB, 70 dB, 0.462)`; derived in `vectors/n_resample`.
const DOUBLER: [[f64; 5]; 5] = [
    [
        0.011_103_254_476_361_459,
        0.020_134_642_477_861_203,
        0.011_103_254_476_361_46,
        -0.839_972_883_085_390_2,
        0.232_141_033_383_883_87,
    ],
    [
        1.0,
        0.953_408_722_937_445_4,
        0.999_999_999_999_999_9,
        -0.618_939_274_882_773_2,
        0.471_049_462_386_523_9,
    ],
    [
        1.0,
        0.366_103_097_825_567_2,
        0.999_999_999_999_999_8,
        -0.393_994_875_092_829_16,
        0.717_895_383_805_027_7,
    ],
    [
        1.0,
        0.101_562_710_457_740_35,
        1.000_000_000_000_000_2,
        -0.261_155_341_830_057_34,
        0.874_333_826_295_479,
    ],
    [
        1.0,
        0.004_882_751_314_197_504,
        0.999_999_999_999_999_8,
        -0.207_908_754_106_664_26,
        0.964_801_976_048_081_9,
    ],
];
/// Delay of the doubler at low frequencies, in samples of the doubled rate; derived in `vectors/n_resample`.
const DOUBLER_DELAY: f32 = 3.154;

const TAPS: usize = 10;
const PHASES: usize = 128;
/// Kaiser window for 75 dB, 5 dB more than the 70 dB of the first stage.
const KAISER_BETA: f64 = 0.1102 * (75.0 - 8.7);

/// A stateful sample-rate converter to a rate at least as high.
#[derive(Clone, Debug)]
pub struct Resampler {
    table: [[f32; TAPS]; PHASES + 1],
    sections: [[f64; 2]; DOUBLER.len()],
    /// The newest doubled samples, oldest first.
    history: [f32; TAPS],
    /// Second of a pair of doubled samples, not yet in `history`.
    pending: Option<f32>,
    /// Position between the two middle samples of `history`, 0..1, as a 32-bit fraction.
    phase: u64,
    step: u64,
}

const ONE: u64 = 1 << 32;

impl Resampler {
    /// A converter from `model_rate_hz` to `device_rate_hz`, which must be at least as high. If it is lower, or if a
    /// rate is not a positive finite number, the output runs at the model's rate.
    pub fn new(model_rate_hz: f32, device_rate_hz: f32) -> Self {
        let ratio = 2.0 * f64::from(model_rate_hz) / f64::from(device_rate_hz);
        let ratio = if ratio.is_finite() && ratio > 0.0 && ratio <= 2.0 { ratio } else { 2.0 };
        let middle = TAPS as f64 / 2.0;
        let tap = |phase: usize, i: usize| {
            // Distance from tap i to the point that lies phase/PHASES of the way from tap middle-1 to tap middle.
            let t = i as f64 - (middle - 1.0) - phase as f64 / PHASES as f64;
            let sinc = if t == 0.0 { 1.0 } else { sin(PI * t) / (PI * t) };
            let r = t / middle;
            let window = bessel_i0(KAISER_BETA * sqrt((1.0 - r * r).max(0.0))) / bessel_i0(KAISER_BETA);
            (sinc * window) as f32
        };
        Self {
            table: core::array::from_fn(|phase| core::array::from_fn(|i| tap(phase, i))),
            sections: [[0.0; 2]; DOUBLER.len()],
            history: [0.0; TAPS],
            pending: None,
            phase: ONE,
            step: (ratio * ONE as f64 + 0.5) as u64,
        }
    }

    /// Delay of the output at low frequencies, in samples of the model's rate.
    pub fn delay_model_samples() -> f32 {
        0.5 * (DOUBLER_DELAY + (TAPS / 2) as f32)
    }

    /// Returns the next device sample; calls `pull` for each model sample that it needs.
    #[inline]
    pub fn next(&mut self, mut pull: impl FnMut() -> f32) -> f32 {
        // At most two iterations, because the step is at most two doubled samples.
        while self.phase >= ONE {
            self.phase -= ONE;
            let doubled = if let Some(sample) = self.pending.take() {
                sample
            } else {
                // Zero-stuffing halves the level, hence the factor of two.
                let first = self.double(2.0 * f64::from(pull()));
                self.pending = Some(self.double(0.0));
                first
            };
            self.history.copy_within(1.., 0);
            self.history[TAPS - 1] = doubled;
        }
        let position = self.phase as f32 * (PHASES as f32 / ONE as f32);
        let index = (position as usize).min(PHASES - 1);
        let between = position - index as f32;
        let (low, high) = (&self.table[index], &self.table[index + 1]);
        let mut out = 0.0;
        for i in 0..TAPS {
            out += (low[i] + between * (high[i] - low[i])) * self.history[i];
        }
        self.phase += self.step;
        out
    }

    /// Filters one sample with the doubler, sections in transposed direct form II.
    #[inline]
    fn double(&mut self, mut x: f64) -> f32 {
        for ([b0, b1, b2, a1, a2], z) in DOUBLER.iter().zip(&mut self.sections) {
            let y = b0 * x + z[0];
            z[0] = b1 * x - a1 * y + z[1];
            z[1] = b2 * x - a2 * y;
            // The filter has rung out: clear the state to avoid slow subnormal arithmetic.
            if fabs(z[0]) < 1e-25 && fabs(z[1]) < 1e-25 {
                *z = [0.0; 2];
            }
            x = y;
        }
        x as f32
    }
}

/// Returns the modified Bessel function of the first kind, order zero, by its power series (relative error below 1e-15
/// here).
pub fn bessel_i0(x: f64) -> f64 {
    let (mut term, mut sum) = (1.0, 1.0);
    for k in 1..60 {
        let half = x / (2.0 * f64::from(k));
        term *= half * half;
        sum += term;
    }
    sum
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::Resampler;
    use realfft::RealFftPlanner;
    use std::vec::Vec;

    /// Amplitude spectrum of `n` device samples after the start-up, through a Blackman-Harris window.
    fn spectrum(model_rate_hz: f32, device_rate_hz: f32, tone_hz: f64, n: usize) -> Vec<f64> {
        let mut resampler = Resampler::new(model_rate_hz, device_rate_hz);
        let mut i = 0.0;
        let mut pull = || {
            i += 1.0;
            (core::f64::consts::TAU * tone_hz * i / f64::from(model_rate_hz)).sin() as f32
        };
        for _ in 0..n {
            resampler.next(&mut pull);
        }
        let mut x: Vec<f64> = (0..n).map(|_| f64::from(resampler.next(&mut pull))).collect();
        for (k, v) in x.iter_mut().enumerate() {
            let p = core::f64::consts::TAU * k as f64 / n as f64;
            *v *= 0.35875 - 0.48829 * p.cos() + 0.14128 * (2.0 * p).cos() - 0.01168 * (3.0 * p).cos();
        }
        let fft = RealFftPlanner::<f64>::new().plan_fft_forward(n);
        let mut bins = fft.make_output_vec();
        fft.process(&mut x, &mut bins).unwrap();
        bins.iter().map(|c| c.norm() / (0.35875 * n as f64 / 2.0)).collect()
    }

    #[test]
    fn tones_keep_their_level_and_lose_their_images() {
        let n = 1 << 15;
        for (model_hz, device_hz) in [
            (1000.0, 48_000.0),
            (1000.0, 44_100.0),
            (1000.0, 8_000.0),
            (2000.0, 48_000.0),
            (4000.0, 48_000.0),
        ] {
            for share in [0.02, 0.1, 0.3, 0.5, 0.7, 0.9] {
                // A whole number of periods puts the peak into one bin.
                let bin = f64::from(device_hz) / n as f64;
                let tone = (share * f64::from(model_hz) / 2.0 / bin).round() * bin;
                let s = spectrum(model_hz, device_hz, tone, n);
                let peak = s.iter().fold(0.0_f64, |m, v| m.max(*v));
                assert!((20.0 * peak.log10()).abs() < 0.1, "{tone} Hz at {device_hz}: {peak}");
                let elsewhere = s
                    .iter()
                    .enumerate()
                    .filter(|(k, _)| (*k as f64 * bin - tone).abs() > 5.0 * bin)
                    .fold(0.0_f64, |m, (_, v)| m.max(*v));
                let rejection = -20.0 * (elsewhere / peak).log10();
                // The documented limit is 70 dB; the worst of these tones has 70.6 dB.
                assert!(
                    rejection > 70.0,
                    "image of {tone} Hz, {model_hz} to {device_hz}: {rejection} dB down"
                );
            }
        }
    }

    #[test]
    fn the_stated_delay_is_the_delay() {
        // For a unit step, the output crosses one half near the group delay.
        let mut resampler = Resampler::new(1000.0, 48_000.0);
        let mut pulled = 0;
        let mut crossing = None;
        for i in 0..4800 {
            let y = resampler.next(|| {
                pulled += 1;
                if pulled > 20 { 1.0 } else { 0.0 }
            });
            if y > 0.5 && crossing.is_none() {
                crossing = Some(f64::from(i) / 48.0 - 20.0);
            }
        }
        let delay = f64::from(Resampler::delay_model_samples());
        // The stated delay holds at low frequencies, but a step has all frequencies. Through this filter, which is not
        // linear-phase, the step crosses one half 0.39 model samples earlier (measured). A lost half sample in either
        // stage would exceed the remaining tolerance.
        assert!((crossing.unwrap() - delay).abs() < 0.45, "{crossing:?} for {delay}");
    }

    #[test]
    fn the_table_of_the_doubler_is_the_one_designed() {
        let vectors = include_str!("../../../vectors/n_resample/resample_vectors.json");
        for section in super::DOUBLER {
            for coefficient in section {
                // The literals have the same digits as the reference.
                let printed = std::format!("{coefficient:?}");
                assert!(vectors.contains(&printed), "{printed} is not in the reference");
            }
        }
    }

    #[test]
    fn rates_that_cannot_be_are_the_models_own() {
        for device_hz in [0.0, -1.0, f32::NAN, 10.0] {
            let mut resampler = Resampler::new(1000.0, device_hz);
            let mut pulled = 0;
            for _ in 0..100 {
                resampler.next(|| {
                    pulled += 1;
                    0.0
                });
            }
            assert_eq!(pulled, 100);
        }
    }
}
