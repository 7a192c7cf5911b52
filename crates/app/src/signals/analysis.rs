//! Analyses of signals. Background workers run them, since coding at five bit rates takes a second.

use std::borrow::Cow;
use std::sync::Arc;

use shagreen_core::signals::codec::CODEC_RATE;
use shagreen_core::signals::codec::bitrate::Bitrate;
use shagreen_core::signals::codec::coded::Coded;
use shagreen_core::signals::quality::{
    Agreement, Distances, Feature, Features, PAPER_RATE, QualityMeter, Relation, SEGMENT_SECS, snr_db,
};
use shagreen_core::signals::spatial_spectrogram::{
    Framing, PAPER_WINDOWS_M, ProfileFidelity, SpatialSpectrogram, Transform, fidelity_by_window, profile_of,
    refine,
};
use shagreen_formats::codec_tables::built_in_codebooks;
use shagreen_formats::thresholds::ThresholdKind;
use shagreen_studio::file::one_line;
use shagreen_studio::quality_model::{ChosenModel, load_quality_model};

use crate::state::bench_signal::BenchSignal;
use crate::strings::signals as strings;

/// Fidelity of a signal at one bit rate of the codec.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AtRate {
    /// Bit rate of the coded stream, in kbit/s.
    pub kbps: f64,
    /// Signal-to-noise ratio, in dB.
    pub snr_db: f64,
    /// Sensitivity index d'. It is predicted, not measured with people.
    pub d_prime: f64,
}

/// Fidelity of a signal at each bit rate of the codec, or why it cannot be computed.
pub type ByRate = Result<Vec<AtRate>, String>;

/// Difference between two signals.
#[derive(Clone, Debug, PartialEq)]
pub struct Compared {
    /// Features of the first and the second signal.
    pub features: [Features; 2],
    /// Distances between the features of both signals.
    pub distances: Distances,
    /// Contribution of each feature of the model to the predicted d'.
    pub parts: Vec<(Feature, f64)>,
    /// Sensitivity index d'. It is predicted, not measured with people.
    pub d_prime: f64,
    /// Whether the model of d' applies to these signals.
    pub relation: Relation,
    /// Signal-to-noise ratio of the second signal relative to the first, in dB. Infinite if both are equal, minus
    /// infinite if only the first is silent.
    pub snr_db: f64,
    /// Duration that was compared in both signals, in s.
    pub seconds: f64,
}

/// Windows of the paper that fit a signal, longest first: no longer than the signal, and at least four samples long.
fn windows_of(signal: &BenchSignal) -> Vec<Framing> {
    let (step_m, length_m) = (signal.profile.step_m(), signal.profile.length_m());
    let windows = PAPER_WINDOWS_M.into_iter().filter(|m| *m <= length_m && *m >= 3.99 * step_m);
    windows.map(|window_m| Framing::of_length(window_m, step_m)).collect()
}

/// Fidelity of the spatial spectrogram of a signal for each window length, longest first.
pub(super) fn by_window(signal: &BenchSignal) -> Vec<ProfileFidelity> {
    let (values, step_m) = (signal.profile.values(), signal.profile.step_m());
    // This cannot fail: the windows fit, and a profile contains finite numbers only.
    fidelity_by_window(values, step_m, &windows_of(signal)).unwrap_or_default()
}

/// Returns the fidelity of a signal at each bit rate of the codec, lowest bit rate first. `model` predicts d'; `None` is the
/// built-in one.
///
/// # Errors
/// A sentence: the signal is too short or cannot be encoded.
pub(super) fn by_rate(signal: &BenchSignal, model: Option<&ChosenModel>) -> ByRate {
    let samples = signal.at(CODEC_RATE);
    let chosen = model_or_built_in(model)?;
    let model = &chosen.file.model;
    let meter = meter(samples.len(), chosen.threshold())?;
    let books = Arc::new(built_in_codebooks().map_err(|error| error.to_string())?);
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

/// Compares two signals sample by sample from their beginnings, for the length of the shorter one. `model` predicts d'; `None`
/// is the built-in one.
///
/// # Errors
/// A sentence: the signals are too short, or their levels are far outside the range of touch.
pub(super) fn compare(
    first: &BenchSignal,
    second: &BenchSignal,
    model: Option<&ChosenModel>,
) -> Result<Compared, String> {
    let [mut a, mut b] = [first, second].map(|signal| signal.at(PAPER_RATE));
    let n_samples = a.len().min(b.len());
    a.truncate(n_samples);
    b.truncate(n_samples);
    let chosen = model_or_built_in(model)?;
    let model = &chosen.file.model;
    let meter = meter(n_samples, chosen.threshold())?;
    let distances = meter.distances(&a, &b).map_err(|error| error.to_string())?;
    let features = |samples: &[f64]| meter.features(samples).map_err(|error| error.to_string());
    let d_prime = model.d_prime(&distances);
    if !d_prime.is_finite() {
        return Err(strings::BEYOND_TOUCH.to_owned());
    }
    Ok(Compared {
        features: [features(&a)?, features(&b)?],
        parts: model.parts(&distances).collect(),
        distances,
        d_prime,
        relation: Agreement::of(&a, &b, PAPER_RATE).relation(),
        snr_db: snr_db(&a, &b),
        seconds: (n_samples / meter.n_segment()) as f64 * SEGMENT_SECS,
    })
}

fn model_or_built_in(model: Option<&ChosenModel>) -> Result<Cow<'_, ChosenModel>, String> {
    match model {
        Some(model) => Ok(Cow::Borrowed(model)),
        None => load_quality_model(None).map(Cow::Owned).map_err(|error| one_line(&error)),
    }
}

/// Quality meter, if the signal is long enough to be compared.
fn meter(n_samples: usize, threshold: ThresholdKind) -> Result<QualityMeter, String> {
    let threshold = threshold.read().map_err(|error| error.to_string())?;
    let meter = QualityMeter::new(PAPER_RATE, &threshold).map_err(|error| error.to_string())?;
    if n_samples < meter.n_segment() {
        return Err(strings::TOO_SHORT.to_owned());
    }
    Ok(meter)
}

/// Returns a signal after encoding and decoding at one bit rate.
///
/// # Errors
/// A sentence: the signal cannot be encoded.
pub(super) fn through_codec(signal: &BenchSignal, rate: Bitrate) -> Result<BenchSignal, String> {
    let samples = signal.at(CODEC_RATE);
    let books = Arc::new(built_in_codebooks().map_err(|error| error.to_string())?);
    let decoded = Coded::encode(&samples, rate, &books).map_err(|error| error.to_string())?.decode(&books);
    let name = strings::through_codec(&signal.name, rate.kbps());
    let made = BenchSignal::of_samples(&name, &decoded, CODEC_RATE, signal.speed, signal.force)?.value;
    // Restrictions on the original signal also apply to the signal made from it.
    Ok(BenchSignal { name, profile: made.profile, ..signal.clone() })
}

/// Returns the signal resynthesized from its spatial spectrogram, refined by `n_steps` Griffin-Lim iterations.
///
/// # Errors
/// A sentence: the window does not fit the signal.
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
    use crate::state::bench_signal::BenchSignal;
    use crate::state::bench_signal::tests::tone;
    use shagreen_core::signals::codec::bitrate::Bitrate;
    use shagreen_core::signals::quality::{QualityModel, Relation, Term};
    use shagreen_core::units::Hertz;
    use shagreen_studio::quality_model::load_quality_model;

    #[test]
    fn a_signal_against_itself_is_the_same_and_less_of_it_is_not() {
        let signal = tone(80.0, 4000.0, 1.7);
        let same = compare(&signal, &signal, None).unwrap();
        assert_eq!((same.d_prime, same.seconds), (0.0, 1.6));
        assert!(same.snr_db.is_infinite());
        let restricted = vec!["not to be given away".to_owned()];
        let licensed = BenchSignal { terms: vec!["CC-BY-4.0".to_owned()], restricted, ..signal.clone() };
        let coded = through_codec(&licensed, Bitrate::ALL[0]).unwrap();
        assert_eq!((&coded.terms, &coded.restricted), (&licensed.terms, &licensed.restricted));
        assert!(coded.seconds() > 1.69 && coded.name.contains("kbit/s"));
        let other = compare(&signal, &coded, None).unwrap();
        let sum: f64 = other.parts.iter().map(|(_, part)| part).sum();
        assert!((sum - other.d_prime).abs() < 1e-12 && other.d_prime > 0.0);
        assert!(other.snr_db.is_finite());
        assert_eq!((same.relation, other.relation), (Relation::Processed, Relation::Processed));
        assert!(compare(&signal, &tone(80.0, 4000.0, 0.5), None).is_err(), "too short");
        // A model with half the weights predicts half of d'.
        let mut half = load_quality_model(None).unwrap();
        let terms = half.file.model.terms().iter().map(|term| Term { weight: 0.5 * term.weight, ..*term });
        half.file.model = QualityModel::of_terms(terms.collect()).unwrap();
        let by_half = compare(&signal, &coded, Some(&half)).unwrap();
        assert!((by_half.d_prime / other.d_prime - 0.5).abs() < 1e-12);
        assert_eq!(by_half.distances, other.distances);
    }

    #[test]
    fn one_signal_has_all_rates_and_the_windows_that_fit() {
        let signal = tone(80.0, 4000.0, 1.0);
        let rates = by_rate(&signal, None).unwrap();
        assert_eq!(rates.iter().map(|at| at.kbps).collect::<Vec<_>>(), [1.75, 2.15, 2.45, 2.75, 3.15]);
        // At a step of 25 µm, the window of 0.2 mm is eight samples long.
        assert_eq!(by_window(&signal).len(), 7);
        let short = tone(80.0, 4000.0, 0.5);
        assert!(by_rate(&short, None).is_err() && by_window(&short).len() == 7);
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
