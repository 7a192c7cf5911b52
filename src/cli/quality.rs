//! `shagreen quality`: predicts how well two signals can be told apart.

use std::path::PathBuf;

use anyhow::{Context as _, ensure};
use serde_json::{Value, json};
use shagreen_core::signals::quality::{
    Agreement, Feature, Features, MOST_D_PRIME, PAPER_RATE, QualityMeter, Relation, SEGMENT_SECS, snr_db,
    spqi, st_sim,
};
use shagreen_formats::quality_model::built_in_quality_model;
use shagreen_formats::thresholds::ThresholdKind;

use crate::cli::output;
use crate::cli::progress::Progress;
use crate::cli::signal_source::SignalArgs;
use crate::cli::words::words;
use shagreen_studio::file;

/// Compares a signal with a reference by perceptual features and predicts their discriminability d'.
///
/// Both are WAV files in m/s², compared sample by sample at 2000 Hz in segments of 0.8 s. d' = z(H) - z(F), with the
/// hit rate H and the false-alarm rate F of the yes-no question "different?": at d' = 1 an unbiased observer gives
/// Φ(d'/2) = 69 % correct answers. (In a two-alternative forced choice, the proportion would be Φ(d'/√2) = 76 %.)
///
/// The prediction is for a signal and a processed version of it, whose waveforms correlate. Two strokes on one texture,
/// or two renderings of it, feel alike, but the model would give them a large d'. The command therefore prints no d' for
/// signals whose waveforms do not correlate. No person rated these signals: a model with published weights predicts d', and
/// its feature distances are scaled on a corpus of simulated textures. Use d' to rank signals.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Reference signal.
    #[arg(value_name = "REF.wav")]
    reference: PathBuf,
    /// Signal to compare with the reference.
    #[arg(value_name = "TEST.wav")]
    test: PathBuf,
    #[command(flatten)]
    signals: SignalArgs,
    /// Detection threshold over frequency: held-tool for vibration felt through a held tool, pacinian or composite for
    /// bare skin on a large contactor. The curves are approximate. pacinian and composite differ only below 40 Hz,
    /// outside the frequency channels of d'.
    #[arg(long, value_name = "THRESHOLD", value_parser = words(ThresholdKind::ALL, ThresholdKind::id),
        default_value = ThresholdKind::default().id())]
    threshold: ThresholdKind,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let rate = PAPER_RATE;
    let progress = Progress::endless("comparing the signals");
    let mut reference = args.signals.load_at(&args.reference, rate)?;
    let mut test = args.signals.load_at(&args.test, rate)?;
    let n_samples = reference.len().min(test.len());
    if reference.len() != test.len() {
        output::warn(&format!(
            "the signals have {} and {} samples; the first {n_samples} of both are compared",
            reference.len(),
            test.len()
        ));
    }
    reference.truncate(n_samples);
    test.truncate(n_samples);
    let threshold = args.threshold.read()?;
    let meter = QualityMeter::new(rate, &threshold)?;
    let distances = meter.distances(&reference, &test).with_context(|| file::in_file(&args.test))?;
    let (a, b) = (meter.features(&reference)?, meter.features(&test)?);
    let d_prime = built_in_quality_model()?.d_prime(&distances);
    ensure!(
        d_prime.is_finite(),
        "d' is not finite: the signal levels are too large or too small for the model; check their units (m/s²)"
    );
    let seconds = (n_samples / meter.n_segment()) as f64 * SEGMENT_SECS;
    if n_samples % meter.n_segment() > 0 {
        let whole = n_samples as f64 / rate.0;
        output::note(&format!(
            "{seconds:.1} s of {whole:.2} s are compared: only whole segments of {SEGMENT_SECS} s are used"
        ));
    }
    let similarities =
        [st_sim(&reference, &test, rate, &threshold), spqi(&reference, &test, rate, &threshold)];
    let snr = snr_db(&reference, &test);
    let agreement = Agreement::of(&reference, &test, rate);

    let mut answer = json!({
        "d_power": distances.by(Feature::SpectralPower),
        "d_amplitude": distances.by(Feature::SpectralAmplitude),
        "dprime": d_prime,
        "dprime_applies": agreement.relation() == Relation::Processed,
        "waveform_correlation": agreement.correlation,
        "octave_levels_differ_db": agreement.spectra_db,
        "spectra_gfc": agreement.spectra_gfc,
        "st_sim": similarities[0],
        "spqi": similarities[1],
        // Infinite for identical signals.
        "snr_db": snr.is_finite().then_some(snr),
        "rate_hz": rate.0,
        "seconds": seconds,
        "threshold": args.threshold.id(),
    });
    for feature in Feature::ALL {
        let distance = distances.by(feature);
        answer[feature.id()] = match own(&a, feature).zip(own(&b, feature)) {
            Some((a, b)) => {
                json!({"reference": a, "test": b, "distance": distance, "unit": feature.unit()})
            }
            None => json!({"distance": distance, "unit": feature.unit()}),
        };
    }
    progress.finish();
    output::print(args.json, &answer, || text(&answer, &d_prime_text(d_prime, seconds, &agreement)));
    Ok(())
}

/// States the predicted d' and its limits, or why it does not apply.
fn d_prime_text(d_prime: f64, seconds: f64, agreement: &Agreement) -> String {
    let Agreement { correlation, spectra_db, spectra_gfc } = agreement;
    match agreement.relation() {
        Relation::Processed => {
            let value = if d_prime > MOST_D_PRIME {
                format!("above {MOST_D_PRIME:.0} (easy to tell apart)")
            } else {
                format!("{d_prime:.2}")
            };
            format!(
                "d' {value}, predicted by a model over {seconds:.1} s, not rated by people\nd' ranks processed versions of one signal; its absolute value is uncertain"
            )
        }
        Relation::DifferentNoise => format!(
            "no d': different noise. The spectra agree (octave levels differ by {spectra_db:.1} dB), but the waveforms do not correlate (r = {correlation:.2}), as for two renderings or strokes of one texture. The model compares waveforms, and would count the noise as a perceptible difference. Not rated by people"
        ),
        Relation::Unrelated => format!(
            "no d': the waveforms do not correlate (r = {correlation:.2}), and the spectra differ (octave levels by {spectra_db:.1} dB; goodness of fit in steps of 10 Hz {spectra_gfc:.2}). The model predicts d' only for a signal and a processed version of it. Not rated by people"
        ),
    }
}

/// Returns a feature of one signal; activations and envelopes exist only as distances.
fn own(features: &Features, feature: Feature) -> Option<f64> {
    match feature {
        Feature::Roughness => Some(features.roughness),
        Feature::Brightness => Some(features.brightness_hz),
        Feature::Regularity => Some(features.regularity),
        Feature::Asymmetry => Some(features.asymmetry),
        Feature::SpectralPower | Feature::SpectralAmplitude | Feature::Envelope => None,
    }
}

fn text(answer: &Value, d_prime: &str) -> String {
    let number = |value: &Value| value.as_f64().map_or_else(|| "\u{2013}".to_owned(), |x| format!("{x:.4}"));
    let mut lines = vec![format!("{:20} {:>12} {:>12} {:>12}", "", "reference", "test", "distance")];
    for feature in Feature::ALL {
        let of = &answer[feature.id()];
        let [reference, test, distance] = ["reference", "test", "distance"].map(|key| number(&of[key]));
        let line = format!(
            "{:20} {reference:>12} {test:>12} {distance:>12} {}",
            feature.id().replace('_', " "),
            feature.unit()
        );
        lines.push(line.trim_end().to_owned());
    }
    lines.push(d_prime.to_owned());
    lines.push(format!(
        "ST-SIM {}, SPQI {}, signal-to-noise ratio {} dB",
        number(&answer["st_sim"]),
        number(&answer["spqi"]),
        number(&answer["snr_db"])
    ));
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::{Agreement, d_prime_text};

    #[test]
    fn a_d_prime_is_stated_up_to_5_and_only_where_it_applies() {
        let processed = Agreement { correlation: 0.9, spectra_db: 1.0, spectra_gfc: 1.0 };
        assert!(d_prime_text(1.234, 0.8, &processed).starts_with("d' 1.23, predicted"));
        assert!(d_prime_text(37.3, 0.8, &processed).starts_with("d' above 5 (easy to tell apart)"));
        let noise =
            d_prime_text(6.2, 0.8, &Agreement { correlation: 0.05, spectra_db: 0.4, spectra_gfc: 0.9 });
        assert!(noise.starts_with("no d': different noise") && !noise.contains("6.2"), "{noise}");
        let other =
            d_prime_text(57.7, 0.8, &Agreement { correlation: 0.05, spectra_db: 12.0, spectra_gfc: 0.2 });
        assert!(other.starts_with("no d': the waveforms") && other.contains("12.0 dB"), "{other}");
        for text in [noise, other, d_prime_text(1.0, 0.8, &processed)] {
            assert!(text.to_lowercase().contains("not rated by people"), "{text}");
        }
    }
}
