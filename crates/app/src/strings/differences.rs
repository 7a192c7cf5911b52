//! Differences of two signals: their features and the predicted discriminability.

use shagreen_core::signals::quality::{Feature, MOST_D_PRIME, Relation};

use crate::choices::signals::Slot;
use crate::strings::digits::three_digits;

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
pub fn features_title(d_prime: f64, relation: Relation) -> String {
    match relation {
        Relation::Processed => format!("Features of A and B: predicted d' {}", shown(d_prime)),
        Relation::DifferentNoise => "Features of A and B: different noise, no predicted d'".to_owned(),
        Relation::Unrelated => "Features of A and B: different signals, no predicted d'".to_owned(),
    }
}

/// Source of the table of features: both signals and the model.
pub fn features_source([first, second]: [&str; 2], model: &str) -> String {
    format!("{}; {}; {model}", named(Slot::A, first), named(Slot::B, second))
}

/// Source of a prediction by an opened model with this name and origin.
pub fn predicted_by(name: &str, origin: &str) -> String {
    format!("predicted by {name} ({origin}), not rated by people")
}

pub const MODEL: &str = "Model of d'";
pub const MODEL_HELP: &str = "Model that predicts d' from the distances of the features. The built-in one has published weights, and lengths from simulated textures.";
pub const OPEN_MODEL: &str = "Open…";
/// Accessible name of the button that opens a model.
pub const OPEN_MODEL_NAME: &str = "Open a model of d'";
pub const OPEN_MODEL_HELP: &str = "Opens a model that `shagreen quality fit` has fitted to pairs of signals that people have rated (.json). The settings keep it.";
pub const BUILT_IN: &str = "Built-in";
/// Accessible name of the button that returns to the built-in model.
pub const BUILT_IN_NAME: &str = "Use the built-in model of d'";
pub const BUILT_IN_HELP: &str = "Returns to the built-in model, with published weights";
pub const OPEN_MODEL_TITLE: &str = "Open a model of d'";
/// Kind of file in the dialog of the system.
pub const OPEN_MODEL_KIND: &str = "Models of d'";
pub const OPEN_MODEL_HINT: &str = "Path of a model (.json) that `shagreen quality fit` wrote…";

/// Name of an opened model, and how it was fitted.
pub fn origin(name: &str, origin: &str) -> String {
    format!("{name}: {origin}")
}

/// Letter of a slot and the name of its signal.
pub fn named(slot: Slot, name: &str) -> String {
    format!("{}: {name}", slot.name())
}

/// Predicted d', or why there is none.
pub fn d_prime(d_prime: f64, relation: Relation) -> String {
    match relation {
        Relation::Processed => format!("d' {}", shown(d_prime)),
        Relation::DifferentNoise => "different noise".to_owned(),
        Relation::Unrelated => "no d'".to_owned(),
    }
}

/// Predicted d', as a number up to [`MOST_D_PRIME`].
fn shown(d_prime: f64) -> String {
    if d_prime > MOST_D_PRIME { format!("above {MOST_D_PRIME:.0}") } else { three_digits(d_prime) }
}

/// Sentences about the meaning of a predicted d'. They state no proportion of answers, because the size of d' is uncertain.
pub fn meaning(d_prime: f64, relation: Relation) -> &'static str {
    match relation {
        Relation::Processed if d_prime > MOST_D_PRIME => {
            "A and B are easy to tell apart. Predicted from the signals, not rated by people."
        }
        Relation::Processed if d_prime >= 1.0 => {
            "A and B can be told apart. Predicted from the signals, not rated by people."
        }
        Relation::Processed => {
            "A and B are hard to tell apart. Predicted from the signals, not rated by people."
        }
        Relation::DifferentNoise => {
            "The spectra agree, but the waveforms do not correlate, as for two renderings or strokes of one texture. The model compares waveforms, so it states no d'."
        }
        Relation::Unrelated => {
            "The waveforms do not correlate. The model states d' only for a signal and a processed version of it."
        }
    }
}

pub const D_PRIME_HELP: &str = "Predicted discriminability of A and B: d' = z(H) - z(F), in standard deviations, with the hit rate H and the false-alarm rate F of the yes-no question \"different?\". At d' = 1, an unbiased observer answers it correctly with probability Φ(d'/2) = 69 %. The model beside the tabs predicts d'; no one has rated these signals. It applies to a signal and a processed version of it. The order of d' values is more reliable than their size.";

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
    use super::{D_PRIME_HELP, Relation, d_prime, features_title, meaning};

    #[test]
    fn large_values_are_not_numbers_and_unlike_waveforms_have_none() {
        let processed = Relation::Processed;
        assert_eq!(
            (d_prime(1.234, processed), d_prime(37.3, processed)),
            ("d' 1.23".into(), "d' above 5".into())
        );
        assert!(features_title(37.3, processed).ends_with("d' above 5"));
        for relation in [Relation::DifferentNoise, Relation::Unrelated] {
            for text in
                [d_prime(6.2, relation), features_title(6.2, relation), meaning(6.2, relation).to_owned()]
            {
                assert!(!text.contains("6.2"), "{text}");
            }
        }
    }

    #[test]
    fn the_sentence_counts_no_answers() {
        for (value, begin) in
            [(0.2, "A and B are hard"), (3.0, "A and B can be"), (9.0, "A and B are easy to tell apart")]
        {
            let sentence = meaning(value, Relation::Processed);
            assert!(sentence.starts_with(begin) && sentence.ends_with("not rated by people."), "{sentence}");
            assert!(!sentence.contains("of 10"), "{sentence}");
        }
        assert!(D_PRIME_HELP.contains("yes-no"), "the task of the percentage is named");
    }
}
