//! Comparison of a signal with a reference: features, predicted discriminability, and published measures.

use anyhow::ensure;
use shagreen_core::signals::quality::{
    Agreement, Distances, Features, PAPER_RATE, QualityMeter, QualityModel, SEGMENT_SECS, snr_db, spqi,
    st_sim,
};
use shagreen_formats::thresholds::ThresholdKind;

use crate::report::Reporter;

/// How a signal differs from its reference. Nothing of it was rated by people.
#[derive(Clone, Debug, PartialEq)]
pub struct SignalQuality {
    /// Features of the reference and of the other signal.
    pub features: [Features; 2],
    /// Distances between the features of both signals.
    pub distances: Distances,
    /// Predicted discriminability d', for signals whose waveforms correlate ([`SignalQuality::agreement`]).
    pub d_prime: f64,
    /// ST-SIM, 0 to 1; `None` if the signals are too short for it.
    pub st_sim: Option<f64>,
    /// SPQI; `None` if the signals are too short for it.
    pub spqi: Option<f64>,
    /// Signal-to-noise ratio in dB; infinite for equal signals.
    pub snr_db: f64,
    /// Agreement of waveforms and spectra.
    pub agreement: Agreement,
    /// Duration of the compared segments, in s.
    pub seconds: f64,
}

/// Compares a signal with a reference sample by sample; both are accelerations in m/s² at [`PAPER_RATE`]. Of signals with
/// different lengths, the common beginning is compared. `model` predicts d'.
///
/// # Errors
/// A signal is shorter than one segment, a sample is not finite, or the levels are far outside the range of touch.
pub fn compare_signals(
    reference: &[f64],
    other: &[f64],
    threshold: ThresholdKind,
    model: &QualityModel,
    reporter: &dyn Reporter,
) -> anyhow::Result<SignalQuality> {
    let rate = PAPER_RATE;
    let n_samples = reference.len().min(other.len());
    if reference.len() != other.len() {
        reporter.warn(&format!(
            "the signals have {} and {} samples; the first {n_samples} of both are compared",
            reference.len(),
            other.len()
        ));
    }
    let [reference, other] = [&reference[..n_samples], &other[..n_samples]];
    let threshold = threshold.read()?;
    let meter = QualityMeter::new(rate, &threshold)?;
    let distances = meter.distances(reference, other)?;
    let features = [meter.features(reference)?, meter.features(other)?];
    let d_prime = model.d_prime(&distances);
    ensure!(
        d_prime.is_finite(),
        "d' is not finite: the signal levels are too large or too small for the model; check their units (m/s²)"
    );
    let seconds = (n_samples / meter.n_segment()) as f64 * SEGMENT_SECS;
    if !n_samples.is_multiple_of(meter.n_segment()) {
        let whole = n_samples as f64 / rate.0;
        reporter.note(&format!(
            "{seconds:.1} s of {whole:.2} s are compared: only whole segments of {SEGMENT_SECS} s are used"
        ));
    }
    Ok(SignalQuality {
        features,
        distances,
        d_prime,
        st_sim: st_sim(reference, other, rate, &threshold),
        spqi: spqi(reference, other, rate, &threshold),
        snr_db: snr_db(reference, other),
        agreement: Agreement::of(reference, other, rate),
        seconds,
    })
}

#[cfg(test)]
mod tests {
    use super::{SignalQuality, compare_signals};
    use crate::report::Warnings;
    use shagreen_core::maths::rng::lcg_noise;
    use shagreen_core::signals::quality::Relation;
    use shagreen_formats::quality_model::built_in_quality_model;
    use shagreen_formats::thresholds::ThresholdKind;

    fn compared(reference: &[f64], other: &[f64]) -> (anyhow::Result<SignalQuality>, Vec<String>) {
        let reporter = Warnings::default();
        let model = built_in_quality_model().unwrap().model;
        let quality = compare_signals(reference, other, ThresholdKind::default(), &model, &reporter);
        (quality, reporter.into_vec())
    }

    #[test]
    fn the_common_beginning_of_two_signals_is_compared() {
        let noise = lcg_noise(4000, 3);
        let (same, warnings) = compared(&noise, &noise[..3300]);
        let same = same.unwrap();
        assert_eq!((same.d_prime, same.seconds, same.agreement.relation()), (0.0, 1.6, Relation::Processed));
        assert_eq!(same.features[0], same.features[1]);
        assert!(same.snr_db.is_infinite() && warnings[0].contains("4000 and 3300 samples"), "{warnings:?}");
        let (other, warnings) = compared(&noise, &lcg_noise(4000, 4));
        assert!(other.unwrap().d_prime > 0.0 && warnings.is_empty());
    }

    #[test]
    fn signals_that_cannot_be_compared_say_why() {
        let noise = lcg_noise(2000, 3);
        let failed = |other: &[f64]| compared(&noise, other).0.unwrap_err().to_string();
        assert!(failed(&noise[..100]).contains("one segment needs 1600"));
        let mut broken = noise.clone();
        broken[7] = f64::NAN;
        assert!(failed(&broken).contains("sample 7 is not a finite number"));
    }
}
