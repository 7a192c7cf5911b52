//! Differences of two signals: their features and the predicted discriminability.

use shagreen_core::signals::quality::Feature;

use crate::choices::signals::Slot;
use crate::strings::digits::three_digits;
use crate::strings::signals::PREDICTED;

/// Stands for a number that does not exist.
pub const NONE: &str = "\u{2013}";
pub const FEATURE_COLUMNS: [&str; 4] = ["A", "B", "distance", "d' contribution"];
pub const FEATURE_COLUMNS_HELP: [&str; 4] = [
    "Value for A; empty for features that only compare two signals",
    "Value for B; empty for features that only compare two signals",
    "Distance between A and B, mean over segments of 0.8 s",
    "Contribution of this distance to the predicted d'. Features without a value are not in the model.",
];

/// Title of the table of features.
pub fn features_title(d_prime: f64) -> String {
    format!("Features of A and B: predicted d' {}", three_digits(d_prime))
}

/// Source of the table of features: both signals and the model, one a line.
pub fn features_source([first, second]: [&str; 2]) -> String {
    format!("{}; {}; {PREDICTED}", named(Slot::A, first), named(Slot::B, second))
}

/// Letter of a slot and the name of its signal.
pub fn named(slot: Slot, name: &str) -> String {
    format!("{}: {name}", slot.name())
}

pub fn d_prime(d_prime: f64) -> String {
    format!("d' {}", three_digits(d_prime))
}

/// Sentence about the proportion of correct answers, 0.5 to 1.
pub fn answers(proportion: f64) -> String {
    // Rounded to tens of percent: the model is not more accurate.
    let n_of_10 = (10.0 * proportion).round();
    let predicted = "Predicted from the signals, not rated by people.";
    if n_of_10 >= 10.0 {
        format!("Nearly every answer to \"same or different?\" would be correct. {predicted}")
    } else if n_of_10 <= 5.0 {
        format!(
            "About 5 of 10 answers to \"same or different?\" would be correct, as many as by guessing. {predicted}"
        )
    } else {
        format!("About {n_of_10} of 10 answers to \"same or different?\" would be correct. {predicted}")
    }
}

pub const D_PRIME_HELP: &str = "Predicted discriminability of A and B: d' = z(H) - z(F), in standard deviations. At d' = 1, an unbiased observer answers 69 % correctly. A model with published weights predicts d'; no one has rated these signals. Use it for a signal and a processed version of it. Two strokes on the same texture give a large d' although they feel alike. The order of d' values is more reliable than their size.";

/// Duration and signal-to-noise ratio of the comparison.
pub fn compared(snr_db: f64, seconds: f64) -> String {
    let noise = if snr_db.is_finite() {
        format!("signal-to-noise ratio of B relative to A {} dB", three_digits(snr_db))
    } else if snr_db > 0.0 {
        "A and B are identical".to_owned()
    } else {
        "A is silent".to_owned()
    };
    format!("compared over {} s; {noise}", three_digits(seconds))
}

/// Name of a feature with the unit of its values and distances.
pub fn feature(feature: Feature) -> &'static str {
    match feature {
        Feature::Roughness => "roughness, log10 (m/s²)²",
        Feature::Brightness => "brightness, Hz",
        Feature::Regularity => "regularity, no unit",
        Feature::Asymmetry => "asymmetry, no unit",
        Feature::SpectralPower => "spectral power, no unit",
        Feature::SpectralAmplitude => "spectral amplitude, no unit",
        Feature::Envelope => "envelope, no unit",
    }
}

pub fn feature_help(feature: Feature) -> &'static str {
    match feature {
        Feature::Roughness => "Logarithm (base 10) of the mean power in (m/s²)²",
        Feature::Brightness => "Spectral centroid, in Hz",
        Feature::Regularity => "Largest normalized autocorrelation at lags of 2 to 50 ms, at most 1",
        Feature::Asymmetry => "Skewness of the samples",
        Feature::SpectralPower => {
            "Activation of frequency-tuned tactile channels, by power. Amplitudes are multiples of the detection threshold, so that it has no unit."
        }
        Feature::SpectralAmplitude => {
            "Activation of frequency-tuned tactile channels, by amplitude. Amplitudes are multiples of the detection threshold, so that it has no unit."
        }
        Feature::Envelope => {
            "Temporal envelope up to 20 Hz. The distance is 1 minus the largest cross-correlation."
        }
    }
}

#[cfg(test)]
mod tests {
    use super::answers;

    #[test]
    fn the_sentence_counts_correct_answers_of_ten() {
        for (proportion, begin) in [
            (
                0.5,
                "About 5 of 10 answers to \"same or different?\" would be correct, as many as by guessing.",
            ),
            (0.691, "About 7 of 10 answers"),
            (0.9, "About 9 of 10 answers"),
            (0.97, "Nearly every answer"),
        ] {
            let sentence = answers(proportion);
            assert!(sentence.starts_with(begin) && sentence.ends_with("not rated by people."), "{sentence}");
        }
    }
}
