//! `shagreen quality`: predicts how well two signals can be told apart.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use serde_json::{Value, json};
use shagreen_core::signals::quality::{
    Agreement, Feature, Features, MOST_D_PRIME, PAPER_RATE, Relation, SEGMENT_SECS,
};
use shagreen_formats::thresholds::ThresholdKind;

use crate::cli::output::{self, Printed, Usage};
use crate::cli::progress::Progress;
use crate::cli::quality_fit;
use crate::cli::quality_model_args::{ModelArgs, model_json};
use crate::cli::signal_source::SignalArgs;
use crate::cli::words::words;
use shagreen_studio::file;
use shagreen_studio::quality_model::ChosenModel;
use shagreen_studio::signal_quality::{SignalQuality, compare_signals};

/// Compares a signal with a reference by perceptual features and predicts their discriminability d'.
///
/// Both are WAV files in m/s², compared sample by sample at 2000 Hz in segments of 0.8 s. d' = z(H) - z(F), with the
/// hit rate H and the false-alarm rate F of the yes-no question "different?": at d' = 1 an unbiased observer gives
/// Φ(d'/2) = 69 % correct answers. (In a two-alternative forced choice, the proportion would be Φ(d'/√2) = 76 %.)
///
/// The prediction is for a signal and a processed version of it, whose waveforms correlate. Two strokes on one texture,
/// or two renderings of it, feel alike, but the model would give them a large d'. The command therefore prints no d' for
/// signals whose waveforms do not correlate. No person rated these signals: a model with published weights predicts d', and
/// its feature distances are scaled on a corpus of simulated textures. Use d' to rank signals. `shagreen quality fit` fits a
/// model to pairs that people have rated; --model uses it.
#[derive(clap::Args)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub(crate) struct Args {
    #[command(subcommand)]
    command: Option<Command>,
    /// Reference signal.
    #[arg(value_name = "REF.wav", required = true)]
    reference: Option<PathBuf>,
    /// Signal to compare with the reference.
    #[arg(value_name = "TEST.wav", required = true)]
    test: Option<PathBuf>,
    #[command(flatten)]
    signals: SignalArgs,
    #[command(flatten)]
    model: ModelArgs,
    /// Detection threshold over frequency: held-tool for vibration felt through a held tool, pacinian or composite for
    /// bare skin on a large contactor. The curves are approximate. pacinian and composite differ only below 40 Hz,
    /// outside the frequency channels of d'. Default: that of the model; held-tool for the built-in one.
    #[arg(long, value_name = "THRESHOLD", value_parser = words(ThresholdKind::ALL, ThresholdKind::id))]
    threshold: Option<ThresholdKind>,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

#[derive(clap::Subcommand)]
enum Command {
    Fit(Box<quality_fit::Args>),
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    match (&args.command, &args.reference, &args.test) {
        (Some(Command::Fit(args)), ..) => quality_fit::run(args),
        (None, Some(reference), Some(test)) => compare(args, reference, test),
        // The parser requires both.
        (None, ..) => bail!(Usage("name the reference and the signal to compare with it".to_owned())),
    }
}

fn compare(args: &Args, reference_file: &Path, test_file: &Path) -> anyhow::Result<()> {
    let model = args.model.load()?;
    let threshold = args.threshold.unwrap_or(model.threshold());
    let is_own = model.sha256.is_some();
    if let Some(fitted) = model.file.threshold.filter(|fitted| is_own && *fitted != threshold) {
        output::warn(&format!(
            "the model {} was fitted with the threshold {}; with {}, the size of d' is another one",
            model.name,
            fitted.id(),
            threshold.id()
        ));
    }
    let progress = Progress::endless("comparing the signals");
    let reference = args.signals.load_at(reference_file, PAPER_RATE)?;
    let test = args.signals.load_at(test_file, PAPER_RATE)?;
    let is_short = (reference.len() as f64) < SEGMENT_SECS * PAPER_RATE.0;
    let quality = compare_signals(&reference, &test, threshold, &model.file.model, &Printed)
        .with_context(|| file::in_file(if is_short { reference_file } else { test_file }))?;
    let SignalQuality { features: [a, b], distances, d_prime, snr_db, agreement, seconds, .. } = quality;

    let mut answer = json!({
        "d_power": distances.by(Feature::SpectralPower),
        "d_amplitude": distances.by(Feature::SpectralAmplitude),
        "dprime": d_prime,
        "dprime_applies": agreement.relation() == Relation::Processed,
        "waveform_correlation": agreement.correlation,
        "octave_levels_differ_db": agreement.spectra_db,
        "spectra_gfc": agreement.spectra_gfc,
        "st_sim": quality.st_sim,
        "spqi": quality.spqi,
        // Infinite for identical signals.
        "snr_db": snr_db.is_finite().then_some(snr_db),
        "rate_hz": PAPER_RATE.0,
        "seconds": seconds,
        "threshold": threshold.id(),
        "model": model_json(&model),
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
    output::print(args.json, &answer, || text(&answer, &d_prime_text(d_prime, seconds, &agreement, &model)));
    Ok(())
}

/// States the predicted d' and its limits, or why it does not apply.
fn d_prime_text(d_prime: f64, seconds: f64, agreement: &Agreement, model: &ChosenModel) -> String {
    let Agreement { correlation, spectra_db, spectra_gfc } = agreement;
    match agreement.relation() {
        Relation::Processed => {
            let value = if d_prime > MOST_D_PRIME {
                format!("above {MOST_D_PRIME:.0} (easy to tell apart)")
            } else {
                format!("{d_prime:.2}")
            };
            let by = match model.sha256 {
                Some(_) => format!("the model {} ({})", model.name, model.origin()),
                None => "a model".to_owned(),
            };
            format!(
                "d' {value}, predicted by {by} over {seconds:.1} s, not rated by people\nd' ranks processed versions of one signal; its absolute value is uncertain"
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
    use shagreen_studio::quality_model::load_quality_model;

    #[test]
    fn a_d_prime_is_stated_up_to_5_and_only_where_it_applies() {
        let model = load_quality_model(None).unwrap();
        let d_prime_text = |d_prime, agreement: &Agreement| d_prime_text(d_prime, 0.8, agreement, &model);
        let processed = Agreement { correlation: 0.9, spectra_db: 1.0, spectra_gfc: 1.0 };
        assert!(d_prime_text(1.234, &processed).starts_with("d' 1.23, predicted"));
        assert!(d_prime_text(37.3, &processed).starts_with("d' above 5 (easy to tell apart)"));
        let noise = d_prime_text(6.2, &Agreement { correlation: 0.05, spectra_db: 0.4, spectra_gfc: 0.9 });
        assert!(noise.starts_with("no d': different noise") && !noise.contains("6.2"), "{noise}");
        let other = d_prime_text(57.7, &Agreement { correlation: 0.05, spectra_db: 12.0, spectra_gfc: 0.2 });
        assert!(other.starts_with("no d': the waveforms") && other.contains("12.0 dB"), "{other}");
        for text in [noise, other, d_prime_text(1.0, &processed)] {
            assert!(text.to_lowercase().contains("not rated by people"), "{text}");
        }
    }
}
