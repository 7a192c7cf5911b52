//! Relation of two signals: whether one can be a processed version of the other, which is what the model of d′ is made
//! for.
//!
//! The model compares waveforms: its largest term for two noises of one texture is the distance of their envelopes,
//! which are unrelated. It then predicts a d′ of 6 for signals that feel alike. Such pairs are recognized here, so that
//! no d′ is stated for them.

use realfft::RealFftPlanner;

use crate::dsp::spectrum::{goodness_of_fit, welch};
use crate::maths::statistics::{centered, dot, mean};
use crate::signals::quality::correlation::Correlator;
use crate::signals::quality::features::LEAST_POWER;
use crate::signals::quality::real_transform::bins_of;
use crate::units::Hertz;

/// Longest delay of a processed signal, in s.
const DELAY_SECS: f64 = 0.05;
/// Correlation from which one signal can be a processed version of the other. Two noises of one texture reach 0.30 over
/// 0.8 s, and the codec at its lowest bit rate keeps 0.82 (25 textures of the starter library).
const LEAST_CORRELATION: f64 = 0.5;
/// Spectral difference up to which two signals can be the same texture, in dB. Two noises of one texture differ by up to
/// 2.7 dB over 0.8 s, and by 0.5 dB over 8 s (25 textures of the starter library).
const SAME_SPECTRUM_DB: f64 = 3.0;
/// Goodness of fit of the spectra from which two signals can be the same texture. Octave levels alone do not tell two
/// tones of one octave apart. The spectra of two noises of 0.8 s, in windows of 0.1 s, have about 0.9.
const SAME_SPECTRUM_GFC: f64 = 0.7;
/// Window of these spectra, in s.
const WINDOW_SECS: f64 = 0.1;
/// Edges of the compared bands, in Hz: octaves, up to the band limit of the model.
const EDGES_HZ: [f64; 7] = [20.0, 40.0, 80.0, 160.0, 320.0, 640.0, 1000.0];
const N_BANDS: usize = EDGES_HZ.len() - 1;
/// Power of a band below which its level is not compared, relative to the louder signal.
const LEAST_SHARE: f64 = 1e-4;

/// What two signals have in common.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relation {
    /// The waveforms correlate: one signal can be a processed version of the other. The model is made for such pairs.
    Processed,
    /// The spectra agree, but the waveforms do not correlate: two noises or two strokes of one texture. The model does
    /// not apply; people are likely to feel no difference.
    DifferentNoise,
    /// Neither the waveforms correlate nor the spectra agree: two textures. The model does not apply.
    Unrelated,
}

/// Agreement of two signals in waveform and spectrum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Agreement {
    /// Largest normalized correlation of the waveforms over delays up to 50 ms and both polarities, 0 to 1.
    pub correlation: f64,
    /// Root-mean-square difference of the levels in octave bands from 20 to 1000 Hz, in dB.
    pub spectra_db: f64,
    /// Goodness of fit of the power spectral densities in steps of 10 Hz, 0 to 1; 1 for signals that are too short for it.
    pub spectra_gfc: f64,
}

impl Agreement {
    /// Compares two signals in m/s² from their beginnings, for the length of the shorter one. The means are removed.
    /// Two silent signals agree.
    pub fn of(reference: &[f64], other: &[f64], rate: Hertz) -> Self {
        let n = reference.len().min(other.len());
        let [a, b] = [centered(&reference[..n]), centered(&other[..n])];
        let (power_a, power_b) = (dot(&a, &a), dot(&b, &b));
        if power_a.max(power_b) <= LEAST_POWER * n as f64 {
            return Self { correlation: 1.0, spectra_db: 0.0, spectra_gfc: 1.0 };
        }
        let norm = (power_a * power_b).sqrt();
        let correlation = if norm > 0.0 {
            let correlator = Correlator::new(n, ((DELAY_SECS * rate.0) as usize).min(n - 1));
            let inverted: Vec<f64> = a.iter().map(|x| -x).collect();
            correlator.highest(&a, &b).max(correlator.highest(&inverted, &b)) / norm
        } else {
            0.0
        };
        let (bands_a, bands_b) = (band_powers(&a, rate), band_powers(&b, rate));
        let least = LEAST_SHARE * bands_a.iter().sum::<f64>().max(bands_b.iter().sum());
        let squares = bands_a.iter().zip(&bands_b).map(|(a, b)| level_difference_db(*a, *b, least).powi(2));
        Self {
            correlation: correlation.min(1.0),
            spectra_db: mean(&squares.collect::<Vec<_>>()).sqrt(),
            spectra_gfc: spectra_gfc(&a, &b, rate),
        }
    }

    /// Relation that this agreement indicates.
    pub fn relation(&self) -> Relation {
        if self.correlation >= LEAST_CORRELATION {
            Relation::Processed
        } else if self.spectra_db <= SAME_SPECTRUM_DB && self.spectra_gfc >= SAME_SPECTRUM_GFC {
            Relation::DifferentNoise
        } else {
            Relation::Unrelated
        }
    }
}

/// Goodness of fit of the power spectral densities of two signals; 1 if they are shorter than a window.
fn spectra_gfc(a: &[f64], b: &[f64], rate: Hertz) -> f64 {
    let window = (WINDOW_SECS * rate.0) as usize;
    let density = |signal: &[f64]| -> Vec<f64> {
        welch(signal, rate, window).into_iter().map(|(_, density)| density).collect()
    };
    let (a, b) = (density(a), density(b));
    if a.is_empty() { 1.0 } else { goodness_of_fit(&a, &b) }
}

/// Difference of two powers in dB, where smaller powers than `least` count as `least`; 0 if both are zero.
fn level_difference_db(a: f64, b: f64, least: f64) -> f64 {
    let (a, b) = (a.max(least), b.max(least));
    if a > 0.0 && b > 0.0 { 10.0 * (a / b).log10() } else { 0.0 }
}

/// Power in each band, not normalized.
fn band_powers(signal: &[f64], rate: Hertz) -> [f64; N_BANDS] {
    let n = signal.len();
    let forward = RealFftPlanner::<f64>::new().plan_fft_forward(n);
    let mut powers = [0.0; N_BANDS];
    for (k, bin) in bins_of(&*forward, signal).iter().enumerate() {
        let hz = k as f64 * rate.0 / n as f64;
        let bands = powers.iter_mut().zip(EDGES_HZ.windows(2));
        for (power, _) in bands.filter(|(_, edges)| hz >= edges[0] && hz < edges[1]) {
            *power += bin.norm_sqr();
        }
    }
    powers
}

#[cfg(test)]
mod tests {
    use super::{Agreement, Relation};
    use crate::maths::rng::lcg_noise;
    use crate::units::Hertz;

    const RATE: Hertz = Hertz(2000.0);

    fn of(a: &[f64], b: &[f64]) -> Agreement {
        Agreement::of(a, b, RATE)
    }

    fn scaled(signal: &[f64], gain: f64) -> Vec<f64> {
        signal.iter().map(|x| gain * x).collect()
    }

    /// A gain of 4 is 12 dB in every band, and changes no correlation.
    #[test]
    fn a_gain_changes_the_spectra_by_its_level_and_no_waveform() {
        let signal = lcg_noise(1600, 1);
        for gain in [4.0, -4.0] {
            let agreement = of(&signal, &scaled(&signal, gain));
            assert!((agreement.correlation - 1.0).abs() < 1e-9, "{agreement:?}");
            assert!((agreement.spectra_db - 20.0 * 4.0_f64.log10()).abs() < 1e-9, "{agreement:?}");
            assert_eq!(agreement.relation(), Relation::Processed);
        }
        assert_eq!(of(&signal, &signal).spectra_db, 0.0);
    }

    /// White noise of 1.6 s: the standard error of the octave bands is about 1 dB, that of the correlation 0.02.
    #[test]
    fn two_noises_of_one_texture_are_recognized() {
        for seed in 0..8 {
            let (a, b) = (lcg_noise(3200, 2 * seed + 1), lcg_noise(3200, 2 * seed + 2));
            let agreement = of(&a, &b);
            assert!(agreement.correlation < 0.2, "{agreement:?}");
            assert_eq!(agreement.relation(), Relation::DifferentNoise, "{agreement:?}");
            assert_eq!(of(&a, &scaled(&b, 2.0)).relation(), Relation::Unrelated, "6 dB louder");
        }
    }

    /// Before, two tones of one octave were taken for two noises of one texture.
    #[test]
    fn two_tones_of_one_octave_are_two_signals() {
        let tone = |hz: f64| -> Vec<f64> {
            (0..8000).map(|i| (std::f64::consts::TAU * hz * f64::from(i) / RATE.0).sin()).collect()
        };
        for hz in [110.0, 125.0, 150.0] {
            let agreement = of(&tone(100.0), &tone(hz));
            assert!(agreement.spectra_db < 0.1 && agreement.spectra_gfc < 0.5, "{agreement:?}");
            assert_eq!(agreement.relation(), Relation::Unrelated, "{hz} Hz");
        }
        assert!((of(&tone(100.0), &tone(100.0)).spectra_gfc - 1.0).abs() < 1e-12);
    }

    /// Equal parts of signal and noise have a correlation of 1/√2.
    #[test]
    fn noise_and_a_delay_leave_a_processed_signal() {
        let (signal, noise) = (lcg_noise(3200, 3), lcg_noise(3200, 4));
        let noisy: Vec<f64> = signal.iter().zip(&noise).map(|(x, y)| x + y).collect();
        let agreement = of(&signal, &noisy);
        assert!((agreement.correlation - 0.5_f64.sqrt()).abs() < 0.05, "{agreement:?}");
        assert_eq!(agreement.relation(), Relation::Processed);
        // 35 ms, the delay of the codec.
        let delayed: Vec<f64> = [&[0.0; 70][..], &signal[..3130]].concat();
        assert_eq!(of(&signal, &delayed).relation(), Relation::Processed);
    }

    #[test]
    fn silence_agrees_with_silence_only() {
        let silence = vec![0.0; 1600];
        assert_eq!(of(&silence, &[0.3; 1600]).relation(), Relation::Processed, "constants are silent");
        assert_eq!(of(&silence, &lcg_noise(1600, 1)).relation(), Relation::Unrelated);
        assert_eq!(of(&[], &[]).relation(), Relation::Processed);
        assert_eq!(of(&[1.0], &[-1.0]).relation(), Relation::Processed, "one sample is a constant");
    }
}
