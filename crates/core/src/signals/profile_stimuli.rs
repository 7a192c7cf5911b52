//! Stimulus profiles of a perception study on the window length of spatial spectrograms (Meyer, Peshkin & Colgate).
//!
//! The study reconstructed four textures. It also compared noise with gaps against gap-free noise with the same
//! amplitude spectrum. Profile values are 0 to 1, the range of a variable-friction display.

use std::f64::consts::TAU;

use realfft::RealFftPlanner;
use rustfft::num_complex::Complex;

use crate::maths::rng::{Random, lcg_noise};

/// Sample spacing used here, in m; not specified by the study.
pub const STEP_M: f64 = 10e-6;

/// Longest and shortest wavelength of the noise, in m.
pub const BAND_M: (f64, f64) = (5e-3, 25e-6);

/// Phase offset that keeps samples of a square wave off the zeros of its sine.
const NUDGE: f64 = 1e-9;

/// Bumps of texture C: position and standard deviation in m, and height (dimensionless).
const BUMPS: [(f64, f64, f64); 6] = [
    (8e-3, 1.5e-3, 0.5),
    (19e-3, 3e-3, 0.7),
    (33e-3, 0.8e-3, 0.4),
    (46e-3, 4e-3, 0.6),
    (60e-3, 2e-3, 0.8),
    (71e-3, 1e-3, 0.5),
];

/// Textures of the second experiment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PaperTexture {
    /// 1/f noise with 70 % amplitude modulation by a 13 mm sine.
    A,
    /// A 13 mm square wave.
    B,
    /// Large bumps plus 1/f noise.
    C,
    /// A 0.4 mm square wave with 100 % amplitude modulation by a 6 mm sine.
    D,
}

impl PaperTexture {
    /// All four textures.
    pub const ALL: [Self; 4] = [Self::A, Self::B, Self::C, Self::D];

    /// Letter of the texture.
    pub fn name(self) -> &'static str {
        match self {
            Self::A => "A",
            Self::B => "B",
            Self::C => "C",
            Self::D => "D",
        }
    }

    /// Returns `n_samples` samples of the profile, [`STEP_M`] apart.
    ///
    /// The noise of A and C has a period of `n_samples`.
    pub fn profile(self, n_samples: usize) -> Vec<f64> {
        let wave = |x: f64, wavelength_m: f64| (TAU * x / wavelength_m).sin();
        let square = |x: f64, wavelength_m: f64| (TAU * x / wavelength_m + NUDGE).sin().signum();
        let noise = match self {
            Self::A => noise(&lcg_noise(n_samples, 11), STEP_M),
            Self::C => noise(&lcg_noise(n_samples, 12), STEP_M),
            Self::B | Self::D => Vec::new(),
        };
        let at = |i: usize| {
            let x = i as f64 * STEP_M;
            match self {
                Self::A => 0.5 + 0.5 * noise[i] * (1.0 + 0.7 * wave(x, 13e-3)) / 1.7,
                Self::B => 0.5 + 0.4 * square(x, 13e-3),
                Self::C => {
                    let bump = |(at, width, height): (f64, f64, f64)| {
                        height * (-0.5 * ((x - at) / width).powi(2)).exp()
                    };
                    (0.15 + 0.7 * BUMPS.map(bump).iter().sum::<f64>() + 0.1 * noise[i]).max(0.0)
                }
                Self::D => 0.5 + 0.45 * square(x, 0.4e-3) * (0.5 + 0.5 * wave(x, 6e-3)),
            }
        };
        (0..n_samples).map(at).collect()
    }
}

/// Noise with gaps, and a distractor with the same amplitude spectrum.
#[derive(Clone, Debug, PartialEq)]
pub struct GapPair {
    /// 1/f noise gated by a square wave: gaps and noise sections have equal width.
    pub gapped: Vec<f64>,
    /// Same amplitude spectrum with random phases: no gaps.
    pub distractor: Vec<f64>,
}

/// Returns noise with gaps of width `gap_m` and its distractor, on samples `step_m` apart; deterministic for a seed.
///
/// One common scale factor fits both into 0 to 1.
pub fn gap_pair(gap_m: f64, n_samples: usize, step_m: f64, seed: u64) -> GapPair {
    let mut random = Random::new(seed);
    let white: Vec<f64> = (0..n_samples).map(|_| random.normal()).collect();
    let is_gap = |i: usize| ((i as f64 * step_m / gap_m) as u64) % 2 == 1;
    let gapped: Vec<f64> =
        noise(&white, step_m).into_iter().enumerate().map(|(i, x)| if is_gap(i) { 0.0 } else { x }).collect();
    let distractor = with_bins(&gapped, |_, bin| Complex::from_polar(bin.norm(), TAU * random.uniform()));
    let highest = gapped.iter().chain(&distractor).fold(f64::MIN_POSITIVE, |most, x| most.max(x.abs()));
    let scaled = |profile: Vec<f64>| profile.into_iter().map(|x| 0.5 + 0.5 * x / highest).collect();
    GapPair { gapped: scaled(gapped), distractor: scaled(distractor) }
}

/// Returns noise filtered from white noise: power falls as 1/f within [`BAND_M`], peak amplitude 1.
fn noise(white: &[f64], step_m: f64) -> Vec<f64> {
    let length_m = white.len() as f64 * step_m;
    let (longest_m, shortest_m) = BAND_M;
    let colored = with_bins(white, |k, bin| {
        let per_m = k as f64 / length_m;
        let is_within = (1.0 / longest_m..=1.0 / shortest_m).contains(&per_m);
        // In 1/mm; the unit does not matter, as the amplitude is normalized below.
        if is_within { bin / (1e-3 * per_m).sqrt() } else { Complex::ZERO }
    });
    let highest = colored.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    if highest > 0.0 { colored.into_iter().map(|x| x / highest).collect() } else { colored }
}

/// Returns a profile with each spectral bin changed by a function.
///
/// The DC and Nyquist bins stay unchanged if they would become complex.
fn with_bins(profile: &[f64], mut change: impl FnMut(usize, Complex<f64>) -> Complex<f64>) -> Vec<f64> {
    let n = profile.len();
    if n < 2 {
        return vec![0.0; n];
    }
    let mut planner = RealFftPlanner::new();
    let (forward, inverse) = (planner.plan_fft_forward(n), planner.plan_fft_inverse(n));
    let mut bins = forward.make_output_vec();
    let mut out = profile.to_vec();
    let there = forward.process(&mut out, &mut bins);
    let last = bins.len() - 1;
    for (k, bin) in bins.iter_mut().enumerate() {
        let before = *bin;
        *bin = change(k, before);
        if (k == 0 || (k == last && n.is_multiple_of(2))) && bin.im != 0.0 {
            *bin = before;
        }
    }
    let back = inverse.process(&mut bins, &mut out);
    debug_assert!(there.is_ok() && back.is_ok(), "buffer lengths must come from the plan");
    out.into_iter().map(|x| x / n as f64).collect()
}

#[cfg(test)]
mod tests {
    use super::{PaperTexture, STEP_M, gap_pair, with_bins};

    #[test]
    fn textures_keep_within_what_can_be_shown() {
        for texture in PaperTexture::ALL {
            let profile = texture.profile(8000);
            let (low, high) =
                profile.iter().fold((f64::MAX, f64::MIN), |(low, high), x| (low.min(*x), high.max(*x)));
            assert!(low >= 0.0 && high <= 1.0 && high - low > 0.5, "{}: {low} to {high}", texture.name());
        }
    }

    #[test]
    fn a_distractor_has_the_spectrum_and_not_the_gaps() {
        let pair = gap_pair(5e-3, 6000, STEP_M, 3);
        let sizes = |profile: &[f64]| {
            let mut sizes = Vec::new();
            with_bins(profile, |_, bin| {
                sizes.push(bin.norm());
                bin
            });
            sizes
        };
        for (a, b) in sizes(&pair.gapped).iter().zip(sizes(&pair.distractor)).skip(1) {
            assert!((a - b).abs() < 1e-9 * 6000.0, "{a} and {b}");
        }
        let gap = 500..1000;
        let is_flat = |profile: &[f64]| profile[gap.clone()].iter().all(|x| (x - 0.5).abs() < 1e-9);
        assert!(is_flat(&pair.gapped) && !is_flat(&pair.distractor));
        assert_eq!(pair, gap_pair(5e-3, 6000, STEP_M, 3));
        assert_ne!(pair, gap_pair(5e-3, 6000, STEP_M, 4));
    }
}
