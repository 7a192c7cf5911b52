//! The sentence on label sources in the origin text of a library, and positions that change it.

use shagreen_core::space::LabelSource;

use crate::axis_sources::is_predicted_from_ratings;
use crate::library::{Library, Place, is_usual};

/// Text in the origin of built-in libraries that human ratings make false. Saved libraries contain it, so it must not
/// change.
const NOBODY_RATED: &str = " and nobody rated one";
/// Source of positions that models trained on ratings predicted. Saved libraries contain it, so it must not change.
const PREDICTED: &str = "predictions from vibration features (models trained on human ratings)";
/// Start of the sentence on positions. Saved libraries contain it, so it must not change.
const POSITIONS: &str = "Positions come from ";

impl Library {
    /// Returns the library with other positions, indexed as [`Library::textures`], on the axes with these names. The origin text
    /// of the library states the label sources. The positions have as many coordinates as there are names.
    #[must_use]
    pub fn with_places(mut self, places: Vec<Option<Place>>, axes: Vec<String>) -> Self {
        for (texture, place) in self.textures.iter_mut().zip(places) {
            texture.place = place;
        }
        self.axes = (!is_usual(&axes)).then_some(axes);
        state_origin_of_places(&mut self);
        self
    }
}

/// Makes the origin of a library state the label sources of its positions; replaces an earlier such sentence.
pub(crate) fn state_origin_of_places(library: &mut Library) {
    let sources = library.label_sources();
    let report = library.space_report.as_ref();
    let is_predicted = report.is_some_and(is_predicted_from_ratings);
    if sources.contains(&LabelSource::HumanRatings)
        || (is_predicted && sources.contains(&LabelSource::Estimated))
    {
        let texts = library.textures.iter_mut().map(|texture| &mut texture.origin);
        for text in texts.chain([&mut library.origin, &mut library.description]) {
            if text.contains(NOBODY_RATED) {
                *text = text.replace(NOBODY_RATED, "");
            }
        }
    }
    // The program writes this sentence last.
    if let Some(at) = library.origin.rfind(POSITIONS).filter(|at| is_ours(&library.origin[*at..])) {
        library.origin.truncate(at);
    }
    let rest = library.origin.trim_end();
    let stop = if rest.ends_with(char::is_alphanumeric) { "." } else { "" };
    let space = if rest.is_empty() { "" } else { " " };
    let label = |source: LabelSource| match source {
        LabelSource::Estimated if is_predicted => PREDICTED,
        source => source.label(),
    };
    let labels: Vec<&str> = sources.into_iter().map(label).collect();
    library.origin = match &labels[..] {
        [] => rest.to_owned(),
        labels => format!("{rest}{stop}{space}{POSITIONS}{}.", labels.join(" and ")),
    };
}

/// Returns whether this is a sentence of [`state_origin_of_places`] with nothing after it.
fn is_ours(sentence: &str) -> bool {
    let labels = sentence.strip_prefix(POSITIONS).and_then(|rest| rest.strip_suffix('.'));
    let is_label =
        |label: &str| label == PREDICTED || LabelSource::ALL.iter().any(|source| source.label() == label);
    labels.is_some_and(|labels| labels.split(" and ").all(is_label))
}

#[cfg(test)]
mod tests {
    use super::state_origin_of_places;
    use crate::library::Library;
    use crate::starter::starter_library;
    use shagreen_core::space::LabelSource;

    fn placed_by(library: &mut Library, sources: &[LabelSource]) -> String {
        for (i, texture) in library.textures.iter_mut().enumerate() {
            if let Some(place) = &mut texture.place {
                place.source = sources[i % sources.len()];
            }
        }
        state_origin_of_places(library);
        library.origin.clone()
    }

    #[test]
    fn the_origin_follows_the_positions() {
        const MADE: &str = "Simulated from physical parameters by Shagreen: no surface was recorded";
        let (human, physical, simulated) =
            (LabelSource::HumanRatings, LabelSource::PhysicalLabels, LabelSource::SimulatedRaters);
        let mut library = starter_library().unwrap();
        library.textures[3].origin = library.origin.clone();
        let origin = placed_by(&mut library, &[simulated]);
        assert_eq!(origin, format!("{MADE} and nobody rated one. Positions come from simulated raters."));
        let origin = placed_by(&mut library, &[human]);
        assert_eq!(origin, format!("{MADE}. Positions come from human ratings."));
        assert_eq!(library.textures[3].origin, format!("{MADE}."));
        let origin = placed_by(&mut library, &[physical, human]);
        assert_eq!(origin, format!("{MADE}. Positions come from physical labels and human ratings."));
        // A report of predicted positions states what their models were trained on.
        library.space_report = Some(serde_json::json!({
            "label_source": "human",
            "axes": [{"name": "rough-smooth", "placed_by": "predicted"}],
        }));
        let origin = placed_by(&mut library, &[LabelSource::Estimated]);
        assert_eq!(
            origin,
            format!(
                "{MADE}. Positions come from predictions from vibration features (models trained on human ratings)."
            )
        );
        library.space_report = None;
        library.textures.iter_mut().for_each(|texture| texture.place = None);
        assert_eq!(placed_by(&mut library, &[human]), format!("{MADE}."));
    }

    #[test]
    fn what_others_wrote_stays() {
        let mut library = starter_library().unwrap();
        for (before, after) in [
            ("", "Positions come from human ratings."),
            (
                "Fitted to recordings: a.csv",
                "Fitted to recordings: a.csv. Positions come from human ratings.",
            ),
            ("Positions come from a map.", "Positions come from a map. Positions come from human ratings."),
        ] {
            before.clone_into(&mut library.origin);
            assert_eq!(placed_by(&mut library, &[LabelSource::HumanRatings]), after);
        }
    }
}
