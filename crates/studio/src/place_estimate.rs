//! Position of a new texture, predicted from the textures of a library that have one.

use shagreen_core::maths::gaussian_process::Estimate;
use shagreen_core::space::attribute_predictor::{predict, quantities, without_features};
use shagreen_core::space::{LabelSource, SpacePoint};
use shagreen_formats::attribute_table::attribute_table;
use shagreen_formats::library::{Library, Place, TextureEntry};
use shagreen_formats::text_limits::{MAX_NOTES, begin_and_end};

/// Smallest number of textures with a position for a prediction.
const LEAST_KNOWN: usize = 5;
/// Largest standard deviation that a library stores.
const MOST_DEVIATION: f64 = 100.0;

/// Prediction on both axes.
struct Predicted {
    axes: [OnAxis; 2],
    /// Training labels, in words.
    labels: String,
}

/// Prediction on one axis.
#[derive(Clone, Copy)]
struct OnAxis {
    /// The prediction, or the mean and standard deviation of the labels if the texture does not determine it.
    estimate: Estimate,
    /// Whether the prediction is more certain than the labels of any texture.
    is_told: bool,
}

/// Places a texture at its predicted position, with its standard deviation, and states both and the training labels in
/// its description. On an axis that its features do not determine, it lies at the mean of the labels. Without any
/// prediction the texture stays unchanged.
pub fn place_by_estimate(entry: &mut TextureEntry, library: &Library) {
    let Some(Predicted { axes, labels }) = predicted(entry, library) else { return };
    let [rough_smooth, hard_soft] = axes.map(|axis| axis.estimate.mean.clamp(0.0, 100.0));
    let deviation = axes.map(|axis| axis.estimate.deviation.clamp(0.0, MOST_DEVIATION));
    let at = SpacePoint { rough_smooth, hard_soft };
    entry.place = Some(Place { deviation: Some(deviation), ..Place::new(at, LabelSource::Estimated) });
    let names = library.axis_names();
    let described = [0, 1].map(|axis| in_words(names[axis], axes[axis]));
    let said = format!(
        "Estimated position (mean ± standard deviation): {}; predicted from {labels}; nobody rated it.",
        described.join(", ")
    );
    entry.description = begin_and_end(&entry.description, &said, MAX_NOTES);
}

/// Whether a library has enough textures with positions for the prediction of another one.
pub fn can_estimate(library: &Library) -> bool {
    attribute_table(library).is_ok_and(|table| table.textures.len() >= LEAST_KNOWN)
}

fn in_words(name: &str, OnAxis { estimate: Estimate { mean, deviation }, is_told }: OnAxis) -> String {
    if is_told {
        format!("{name} {mean:.0} ± {deviation:.0}")
    } else {
        format!(
            "{name} cannot be told from this recording (placed at the mean of the labels, {mean:.0} ± {deviation:.0})"
        )
    }
}

/// Returns the predictions on both axes; `None` if the library has too few textures with positions.
fn predicted(entry: &TextureEntry, library: &Library) -> Option<Predicted> {
    let table = attribute_table(library).ok()?; // A library without positions has no axes.
    if table.textures.len() < LEAST_KNOWN {
        return None;
    }
    let indices = library.axis_names().map(|axis| table.names.iter().position(|name| name == axis));
    let [Some(across), Some(up)] = indices else { return None };
    let known = table.known(library);
    // A texture without a feature in common with the others cannot be compared.
    let estimates = predict(&known, &quantities(&entry.model)).ok()?;
    let labels = without_features(&known);
    let axes = [across, up].map(|axis| told(estimates[axis], labels[axis]));
    Some(Predicted { axes, labels: table.of_library(&library.name) })
}

/// The prediction, or the estimate from the labels alone if it is as uncertain.
fn told(estimate: Estimate, labels: Estimate) -> OnAxis {
    let is_told = estimate.deviation < labels.deviation;
    OnAxis { estimate: if is_told { estimate } else { labels }, is_told }
}

#[cfg(test)]
mod tests {
    use super::{MAX_NOTES, can_estimate, in_words, place_by_estimate, told};
    use shagreen_core::maths::gaussian_process::Estimate;
    use shagreen_core::space::LabelSource;
    use shagreen_formats::starter::starter_library;

    #[test]
    fn a_texture_lands_near_where_it_lay() {
        let library = starter_library().unwrap();
        let mut mistakes = Vec::new();
        for index in 0..library.textures.len() {
            let mut others = library.clone();
            let mut entry = others.textures.remove(index);
            let before = entry.place.take().unwrap().at;
            place_by_estimate(&mut entry, &others);
            let place = entry.place.unwrap();
            assert_eq!(place.source, LabelSource::Estimated);
            assert!(entry.description.contains("±"), "{}", entry.description);
            assert!(entry.description.contains("24 textures of"), "{}", entry.description);
            assert!(entry.description.contains("physical labels"), "{}", entry.description);
            let [across, up] = place.deviation.unwrap();
            // A library stores deviations from 0 to 100.
            assert!((0.1..=100.0).contains(&across) && (0.1..=100.0).contains(&up), "{across} {up}");
            mistakes.push((place.at.rough_smooth - before.rough_smooth).abs());
        }
        // A description at its limit stays within it, with the statement.
        let mut others = library.clone();
        let mut entry = others.textures.remove(0);
        entry.description = "x".repeat(MAX_NOTES);
        place_by_estimate(&mut entry, &others);
        assert_eq!(entry.description.chars().count(), MAX_NOTES);
        assert!(entry.description.ends_with("nobody rated it."));
        let mean = mistakes.iter().sum::<f64>() / mistakes.len() as f64;
        assert!(mean < 10.0, "{mean}");
        let mut few = library.clone();
        let mut entry = few.textures.remove(0);
        few.textures.truncate(3);
        assert!(can_estimate(&library) && !can_estimate(&few));
        entry.place = None;
        place_by_estimate(&mut entry, &few);
        assert_eq!(entry.place, None);
    }

    #[test]
    fn a_prediction_as_uncertain_as_the_labels_is_none() {
        let labels = Estimate { mean: 48.0, deviation: 31.0 };
        let vague = told(Estimate { mean: 100.0, deviation: 72.1 }, labels);
        assert_eq!((vague.is_told, vague.estimate), (false, labels));
        let text = in_words("hard-soft", vague);
        assert!(text.contains("cannot be told from this recording") && text.contains("48 ± 31"), "{text}");
        assert!(!text.contains("100"), "{text}");
        let good = told(Estimate { mean: 65.7, deviation: 9.6 }, labels);
        assert_eq!(in_words("rough-smooth", good), "rough-smooth 66 ± 10");
    }
}
