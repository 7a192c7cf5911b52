//! Position of a new texture, predicted from the textures of a library that have one.

use shagreen_core::maths::gaussian_process::Estimate;
use shagreen_core::space::attribute_predictor::{Known, Quantities, predict, quantities, without_features};
use shagreen_core::space::signal_axes::SignalAxis;
use shagreen_core::space::{LabelSource, SpacePoint, with_local_means};
use shagreen_formats::attribute_table::attribute_table;
use shagreen_formats::library::{Library, Place, TextureEntry};
use shagreen_formats::text_limits::{MAX_NOTES, begin_and_end};

/// Smallest number of textures with a position for a prediction.
const LEAST_KNOWN: usize = 5;
/// Largest standard deviation that a library stores.
const MOST_DEVIATION: f64 = 100.0;
/// Number of axes on which a texture needs a prediction to get a position; it may lie at the local mean on further ones.
const N_NEEDED: usize = 2;

/// Prediction on all axes of a library.
struct Predicted {
    /// One for each axis, in their order.
    axes: Vec<OnAxis>,
    /// Training labels, in words.
    labels: String,
}

/// Coordinate on one axis.
#[derive(Clone, Copy, Debug, PartialEq)]
struct OnAxis {
    /// The coordinate with its standard deviation; zero if there is none.
    estimate: Estimate,
    basis: Basis,
}

/// What a coordinate follows from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Basis {
    /// Predicted from the features of the texture.
    Features,
    /// Mean and standard deviation of the labels: the prediction is not more certain.
    Labels,
    /// Computed from the vibration of the texture, because the axis is such a feature.
    Vibration,
    /// Local mean of the other textures.
    Neighbors,
}

/// Places a texture at its predicted position, with its standard deviation on the first two axes, and states both and the training
/// labels in its description. On an axis that its features do not determine, it lies at the mean of the labels. On an axis
/// that is computed from the vibration, it lies where its own vibration is. On an axis from the third on that cannot be predicted,
/// it lies at the local mean of the textures. Without any prediction the texture stays unchanged.
pub fn place_by_estimate(entry: &mut TextureEntry, library: &Library) {
    let Some(Predicted { axes, labels }) = predicted(entry, library) else { return };
    let coordinates: Vec<f64> = axes.iter().map(|axis| axis.estimate.mean.clamp(0.0, 100.0)).collect();
    // A library has at least one axis, and no more than a point.
    let Ok(at) = SpacePoint::of(&coordinates) else { return };
    let deviation = [0, 1].map(|axis| {
        axes.get(axis).map_or(0.0, |on: &OnAxis| on.estimate.deviation.clamp(0.0, MOST_DEVIATION))
    });
    entry.place = Some(Place { deviation: Some(deviation), ..Place::new(at, LabelSource::Estimated) });
    let names = library.axis_names();
    let described: Vec<String> =
        names.into_iter().zip(&axes).map(|(name, axis)| in_words(name, *axis)).collect();
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

fn in_words(name: &str, OnAxis { estimate: Estimate { mean, deviation }, basis }: OnAxis) -> String {
    match basis {
        Basis::Features => format!("{name} {mean:.0} ± {deviation:.0}"),
        Basis::Labels => format!(
            "{name} cannot be told from this recording (placed at the mean of the labels, {mean:.0} ± {deviation:.0})"
        ),
        Basis::Vibration => format!("{name} {mean:.0} (computed from its vibration)"),
        Basis::Neighbors => format!("{name} {mean:.0} (local mean of the other textures)"),
    }
}

/// Returns the coordinates on all axes; `None` if the library has too few textures with positions, or if nothing predicts one of
/// the first two coordinates.
fn predicted(entry: &TextureEntry, library: &Library) -> Option<Predicted> {
    let table = attribute_table(library).ok()?; // A library without positions has no axes.
    if table.textures.len() < LEAST_KNOWN {
        return None;
    }
    let known = table.known(library);
    let features = quantities(&entry.model);
    // A texture without a feature in common with the others cannot be compared.
    let estimates = predict(&known, &features).ok()?;
    let labels = without_features(&known);
    let on_axis = |(axis, name): (usize, &str)| {
        let in_table = table.names.iter().position(|known| known == name);
        let predicted = in_table.map(|column| told(estimates[column], labels[column]));
        let further = || if axis < N_NEEDED { None } else { from_positions(&features, library, axis) };
        predicted.or_else(|| computed(entry, name)).or_else(further)
    };
    let axes: Vec<Option<OnAxis>> = library.axis_names().into_iter().enumerate().map(on_axis).collect();
    if axes.iter().take(N_NEEDED).any(Option::is_none) {
        return None;
    }
    Some(Predicted { axes: completed(&axes, library), labels: table.of_library(&library.name) })
}

/// The prediction, or the estimate from the labels alone if it is as uncertain.
fn told(estimate: Estimate, labels: Estimate) -> OnAxis {
    if estimate.deviation < labels.deviation {
        OnAxis { estimate, basis: Basis::Features }
    } else {
        OnAxis { estimate: labels, basis: Basis::Labels }
    }
}

/// The coordinate of a texture on an axis that is computed from the vibration.
fn computed(entry: &TextureEntry, name: &str) -> Option<OnAxis> {
    let mean = SignalAxis::from_name(name)?.of(&entry.model)?;
    Some(OnAxis { estimate: Estimate { mean, deviation: 0.0 }, basis: Basis::Vibration })
}

/// Prediction of the coordinate on an axis from the positions of the library, of which the table of attributes does not have it.
fn from_positions(features: &Quantities, library: &Library, axis: usize) -> Option<OnAxis> {
    let known = |texture: &TextureEntry| {
        let place = texture.place.filter(|place| place.source != LabelSource::Estimated)?;
        Some(Known { quantities: quantities(&texture.model), attributes: vec![place.at.get(axis)?] })
    };
    let known: Vec<Known> = library.textures.iter().filter_map(known).collect();
    if known.len() < LEAST_KNOWN {
        return None;
    }
    let estimate = predict(&known, features).ok()?.into_iter().next()?;
    Some(told(estimate, without_features(&known).into_iter().next()?))
}

/// The coordinates on all axes; those without a prediction are the local mean of the textures.
fn completed(axes: &[Option<OnAxis>], library: &Library) -> Vec<OnAxis> {
    let known: Vec<Option<f64>> =
        axes.iter().map(|on| on.map(|on| on.estimate.mean.clamp(0.0, 100.0))).collect();
    let near = |mean: f64| OnAxis { estimate: Estimate { mean, deviation: 0.0 }, basis: Basis::Neighbors };
    let means = with_local_means(&library.positions(), &known);
    axes.iter().zip(means).map(|(on, mean)| on.unwrap_or_else(|| near(mean))).collect()
}

#[cfg(test)]
mod tests {
    use super::{Basis, MAX_NOTES, OnAxis, can_estimate, completed, in_words, place_by_estimate, told};
    use crate::axes::placed_on;
    use shagreen_core::maths::gaussian_process::Estimate;
    use shagreen_core::space::signal_axes::SignalAxis;
    use shagreen_core::space::{LabelSource, SpacePoint};
    use shagreen_formats::library::{Attribute, Attributes, Library, TextureEntry};
    use shagreen_formats::starter::{simulated_library, starter_library};

    fn named(names: &[&str]) -> Vec<String> {
        names.iter().map(|name| (*name).to_owned()).collect()
    }

    /// The first texture of a library, placed among the others.
    fn first_placed_again(library: &Library) -> TextureEntry {
        let mut others = library.clone();
        let mut entry = others.textures.remove(0);
        (entry.place, entry.attributes) = (None, None);
        place_by_estimate(&mut entry, &others);
        entry
    }

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
            mistakes.push((place.at.x() - before.x()).abs());
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
    fn every_axis_has_a_coordinate() {
        let library = simulated_library().unwrap();
        let plane = first_placed_again(&library);
        let axes = named(&["rough-smooth", "hard-soft", "flat-bumpy", "centroid"]);
        let entry = first_placed_again(&placed_on(&library, &axes).unwrap());
        let place = entry.place.unwrap();
        // The first two axes are predicted as without further ones.
        assert_eq!((place.at.on(2), place.deviation), (plane.at().unwrap(), plane.place.unwrap().deviation));
        assert_eq!(place.at.get(3), SignalAxis::Centroid.of(&entry.model));
        assert!(place.at.get(2).is_some_and(|bumpy| (0.0..=100.0).contains(&bumpy)), "{}", place.at);
        let words = ["hard-soft", "flat-bumpy", "centroid", "(computed from its vibration)"];
        assert!(words.iter().all(|words| entry.description.contains(words)), "{}", entry.description);
        // One axis is enough, also one that is computed.
        let entry = first_placed_again(&placed_on(&library, &named(&["hard-soft"])).unwrap());
        assert_eq!(entry.at().unwrap(), SpacePoint::of(&[plane.at().unwrap().y()]).unwrap());
        let entry = first_placed_again(&placed_on(&library, &named(&["centroid"])).unwrap());
        assert_eq!(entry.at().unwrap().get(0), SignalAxis::Centroid.of(&entry.model));
    }

    #[test]
    fn an_axis_that_the_attributes_lack_follows_from_positions_or_neighbors() {
        let mut library = starter_library().unwrap();
        library.axes = Some(named(&["rough-smooth", "hard-soft", "warm-cold"]));
        for (index, texture) in library.textures.iter_mut().enumerate() {
            let place = texture.place.as_mut().unwrap();
            place.at = place.at.on(3).with(2, 0.5 * place.at.x());
            let value = |name: &str, value: f64| Attribute { name: name.to_owned(), value };
            let values = vec![value("rough-smooth", place.at.x()), value("hard-soft", place.at.y())];
            texture.attributes = Some(Attributes { source: LabelSource::HumanRatings, values });
            // Estimated positions train no prediction.
            if index % 8 != 0 {
                place.source = LabelSource::Estimated;
            }
        }
        let entry = first_placed_again(&library);
        assert!(entry.description.contains("local mean"), "{}", entry.description);
        let warm = entry.at().unwrap().get(2).unwrap();
        assert!((warm - 0.5 * entry.at().unwrap().x()).abs() < 5.0, "{}", entry.at().unwrap());
        for texture in &mut library.textures {
            texture.place.as_mut().unwrap().source = LabelSource::HumanRatings;
        }
        let entry = first_placed_again(&library);
        assert!(!entry.description.contains("local mean"), "{}", entry.description);
        let unknown = completed(&[None, None], &Library::default());
        assert!(
            unknown.iter().all(|on| (on.estimate.mean, on.basis) == (50.0, Basis::Neighbors)),
            "{unknown:?}"
        );
    }

    #[test]
    fn a_prediction_as_uncertain_as_the_labels_is_none() {
        let labels = Estimate { mean: 48.0, deviation: 31.0 };
        let vague = told(Estimate { mean: 100.0, deviation: 72.1 }, labels);
        assert_eq!(vague, OnAxis { estimate: labels, basis: Basis::Labels });
        let text = in_words("hard-soft", vague);
        assert!(text.contains("cannot be told from this recording") && text.contains("48 ± 31"), "{text}");
        assert!(!text.contains("100"), "{text}");
        let good = told(Estimate { mean: 65.7, deviation: 9.6 }, labels);
        assert_eq!(in_words("rough-smooth", good), "rough-smooth 66 ± 10");
    }
}
