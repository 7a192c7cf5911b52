//! What is worked out of signals: by workers, since the codec at five rates takes a second.

use std::sync::Arc;

use shagreen_core::codec::CODEC_RATE;
use shagreen_core::codec::bitrate::Bitrate;
use shagreen_core::codec::coded::Coded;
use shagreen_core::quality::{Distances, Feature, Features, PAPER_RATE, QualityMeter, SEGMENT_SECS, snr_db};
use shagreen_core::spatial_spectrogram::{
    Framing, PAPER_WINDOWS_M, ProfileFidelity, SpatialSpectrogram, Transform, fidelity_by_window, profile_of,
    refine,
};
use shagreen_formats::codec_tables::built_in_codebooks;
use shagreen_formats::quality_model::built_in_quality_model;
use shagreen_formats::thresholds::ThresholdKind;

use super::bench_signal::BenchSignal;
use crate::strings::signals as strings;

/// What becomes of a signal at a rate of the codec.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AtRate {
    /// Of the stream, in kbit/s.
    pub kbps: f64,
    /// Signal to noise, in dB.
    pub snr_db: f64,
    /// Predicted: nobody was asked.
    pub d_prime: f64,
}

/// What the codec keeps of a signal at its rates, or why that is not known.
pub type ByRate = Result<Vec<AtRate>, String>;

/// How two signals differ.
#[derive(Clone, Debug, PartialEq)]
pub struct Compared {
    /// Of the first and the second.
    pub features: [Features; 2],
    /// From one to the other.
    pub distances: Distances,
    /// What each feature of the model adds to the predicted d'.
    pub parts: Vec<(Feature, f64)>,
    /// Predicted: nobody was asked.
    pub d_prime: f64,
    /// Of the second against the first, in dB; infinite where they are equal, minus infinite where only the first is silent.
    pub snr_db: f64,
    /// How much of both was compared, in s.
    pub seconds: f64,
}

/// The windows of the paper that fit a signal, widest first: no wider than it, and of four samples at least.
fn windows_of(signal: &BenchSignal) -> Vec<Framing> {
    let (step_m, length_m) = (signal.profile.step_m(), signal.profile.length_m());
    let windows = PAPER_WINDOWS_M.into_iter().filter(|m| *m <= length_m && *m >= 3.99 * step_m);
    windows.map(|window_m| Framing::of_length(window_m, step_m)).collect()
}

/// What windows of each width keep of a signal, widest first.
pub(super) fn by_window(signal: &BenchSignal) -> Vec<ProfileFidelity> {
    let (values, step_m) = (signal.profile.values(), signal.profile.step_m());
    // The windows fit, and a profile holds finite numbers only.
    fidelity_by_window(values, step_m, &windows_of(signal)).unwrap_or_default()
}

/// What the codec keeps of a signal, lowest rate first.
///
/// # Errors
/// In words: it is too short, or cannot be encoded.
pub(super) fn by_rate(signal: &BenchSignal) -> ByRate {
    let samples = signal.at(CODEC_RATE);
    let meter = meter(samples.len())?;
    let books = Arc::new(built_in_codebooks().map_err(|error| error.to_string())?);
    let model = built_in_quality_model().map_err(|error| error.to_string())?;
    let at = |rate: Bitrate| {
        let coded = Coded::encode(&samples, rate, &books).map_err(|error| error.to_string())?;
        let decoded = coded.decode(&books);
        let distances = meter.distances(&samples, &decoded).map_err(|error| error.to_string())?;
        Ok(AtRate {
            kbps: rate.kbps(),
            snr_db: snr_db(&samples, &decoded),
            d_prime: model.d_prime(&distances),
        })
    };
    let mut all = Bitrate::ALL.into_iter().map(at).collect::<Result<Vec<_>, String>>()?;
    all.sort_by(|a, b| a.kbps.total_cmp(&b.kbps));
    Ok(all)
}

/// Compares two signals, sample beside sample from their beginnings.
///
/// # Errors
/// In words: they are too short, or far from any touch.
pub(super) fn compare(first: &BenchSignal, second: &BenchSignal) -> Result<Compared, String> {
    let [mut a, mut b] = [first, second].map(|signal| signal.at(PAPER_RATE));
    let n_samples = a.len().min(b.len());
    a.truncate(n_samples);
    b.truncate(n_samples);
    let meter = meter(n_samples)?;
    let distances = meter.distances(&a, &b).map_err(|error| error.to_string())?;
    let features = |samples: &[f64]| meter.features(samples).map_err(|error| error.to_string());
    let model = built_in_quality_model().map_err(|error| error.to_string())?;
    let d_prime = model.d_prime(&distances);
    if !d_prime.is_finite() {
        return Err(strings::BEYOND_TOUCH.to_owned());
    }
    Ok(Compared {
        features: [features(&a)?, features(&b)?],
        parts: model.parts(&distances).collect(),
        distances,
        d_prime,
        snr_db: snr_db(&a, &b),
        seconds: (n_samples / meter.n_segment()) as f64 * SEGMENT_SECS,
    })
}

/// The meter, where there is enough to compare.
fn meter(n_samples: usize) -> Result<QualityMeter, String> {
    let threshold = ThresholdKind::default().read().map_err(|error| error.to_string())?;
    let meter = QualityMeter::new(PAPER_RATE, &threshold).map_err(|error| error.to_string())?;
    if n_samples < meter.n_segment() {
        return Err(strings::TOO_SHORT.to_owned());
    }
    Ok(meter)
}

/// What the codec leaves of a signal at a rate.
///
/// # Errors
/// In words: it cannot be encoded.
pub(super) fn through_codec(signal: &BenchSignal, rate: Bitrate) -> Result<BenchSignal, String> {
    let samples = signal.at(CODEC_RATE);
    let books = Arc::new(built_in_codebooks().map_err(|error| error.to_string())?);
    let decoded = Coded::encode(&samples, rate, &books).map_err(|error| error.to_string())?.decode(&books);
    let name = strings::through_codec(&signal.name, rate.kbps());
    let made = BenchSignal::of_samples(&name, &decoded, CODEC_RATE, signal.speed, signal.force)?.value;
    // The terms that it came under hold for what is made of it.
    Ok(BenchSignal { name, profile: made.profile, ..signal.clone() })
}

/// What a spatial spectrogram leaves of a signal, made to fit it better by so many steps.
///
/// # Errors
/// In words: the window does not fit.
pub(super) fn remade(signal: &BenchSignal, window_m: f64, n_steps: usize) -> Result<BenchSignal, String> {
    let framing = signal.framing(window_m);
    let transform = Transform::new(framing);
    let spectrogram =
        SpatialSpectrogram::of(signal.profile.values(), &transform).map_err(|error| error.to_string())?;
    let made = profile_of(&spectrogram, &transform);
    let made = refine(&spectrogram, &made, n_steps).map_err(|error| error.to_string())?;
    signal.with_values(strings::remade(&signal.name, 1e3 * signal.window_m(framing), n_steps), made)
}

#[cfg(test)]
mod tests {
    use super::{by_rate, by_window, compare, remade, through_codec};
    use crate::signals::bench_signal::BenchSignal;
    use crate::signals::bench_signal::tests::tone;
    use shagreen_core::codec::bitrate::Bitrate;
    use shagreen_core::units::Hertz;

    #[test]
    fn a_signal_against_itself_is_the_same_and_less_of_it_is_not() {
        let signal = tone(80.0, 4000.0, 1.7);
        let same = compare(&signal, &signal).unwrap();
        assert_eq!((same.d_prime, same.seconds), (0.0, 1.6));
        assert!(same.snr_db.is_infinite());
        let restricted = vec!["not to be given away".to_owned()];
        let licensed = BenchSignal { terms: vec!["CC-BY-4.0".to_owned()], restricted, ..signal.clone() };
        let coded = through_codec(&licensed, Bitrate::ALL[0]).unwrap();
        assert_eq!((&coded.terms, &coded.restricted), (&licensed.terms, &licensed.restricted));
        assert!(coded.seconds() > 1.69 && coded.name.contains("kbit/s"));
        let other = compare(&signal, &coded).unwrap();
        let sum: f64 = other.parts.iter().map(|(_, part)| part).sum();
        assert!((sum - other.d_prime).abs() < 1e-12 && other.d_prime > 0.0);
        assert!(other.snr_db.is_finite());
        assert!(compare(&signal, &tone(80.0, 4000.0, 0.5)).is_err(), "too short");
    }

    #[test]
    fn one_signal_has_all_rates_and_the_windows_that_fit() {
        let signal = tone(80.0, 4000.0, 1.0);
        let rates = by_rate(&signal).unwrap();
        assert_eq!(rates.iter().map(|at| at.kbps).collect::<Vec<_>>(), [1.75, 2.15, 2.45, 2.75, 3.15]);
        // Steps of 25 µm: 0.2 mm are eight of them.
        assert_eq!(by_window(&signal).len(), 7);
        let short = tone(80.0, 4000.0, 0.5);
        assert!(by_rate(&short).is_err() && by_window(&short).len() == 7);
        let coarse = by_window(&tone(80.0, 400.0, 1.0));
        assert!(coarse.len() < 7 && coarse.len() > 2);
    }

    #[test]
    fn narrow_windows_keep_a_signal() {
        let signal = tone(80.0, 4000.0, 1.0);
        let made = remade(&signal, 0.2e-3, 4).unwrap();
        let (a, b) = (signal.at(Hertz(2000.0)), made.at(Hertz(2000.0)));
        let difference: f64 = a.iter().zip(&b).map(|(a, b)| (a - b).powi(2)).sum();
        assert!(difference < 0.05 * a.iter().map(|a| a * a).sum::<f64>(), "{difference}");
    }
}
