//! What a picture predictor says about a picture.

use shagreen_core::maths::gaussian_process::Estimate;
use shagreen_core::surfaces::picture_doubts::PictureDoubt;

/// Attributes and materials predicted from a picture, with reasons to doubt them.
#[derive(Clone, Debug, PartialEq)]
pub struct PicturePrediction {
    /// Predicted attributes, each 0 to 100, in the order of the attributes of the model.
    pub attributes: Vec<Estimate>,
    /// Likely materials, the most likely first: at most [`MOST_MATERIALS`], each with a probability of at least
    /// [`LEAST_PROBABILITY`]. Empty if the model was not trained on labelled photos.
    pub materials: Vec<LikelyMaterial>,
    /// Reasons to doubt the prediction; the standard deviations already contain them.
    pub doubts: Vec<PictureDoubt>,
}

/// Material that a picture may show.
#[derive(Clone, Debug, PartialEq)]
pub struct LikelyMaterial {
    /// Name of its class, such as "carpet" or "roofing tile".
    pub name: String,
    /// Probability, 0 to 1.
    pub probability: f64,
}

/// Largest number of likely materials.
pub const MOST_MATERIALS: usize = 5;
/// Smallest probability of a likely material.
pub const LEAST_PROBABILITY: f64 = 0.05;

/// Returns the likely materials of classes with these names and probabilities.
pub(crate) fn likely_materials(
    of_all: impl Iterator<Item = (impl Into<String>, f64)>,
) -> Vec<LikelyMaterial> {
    let mut likely: Vec<LikelyMaterial> = of_all
        .filter(|(_, probability)| *probability >= LEAST_PROBABILITY)
        .map(|(name, probability)| LikelyMaterial { name: name.into(), probability })
        .collect();
    likely.sort_by(|a, b| b.probability.total_cmp(&a.probability));
    likely.truncate(MOST_MATERIALS);
    likely
}

#[cfg(test)]
mod tests {
    use super::likely_materials;

    #[test]
    fn the_most_likely_materials_come_first_and_unlikely_ones_not_at_all() {
        let of = [("brick", 0.04), ("wood", 0.2), ("carpet", 0.7), ("cork", 0.06)];
        let likely = likely_materials(of.into_iter());
        let names: Vec<&str> = likely.iter().map(|of| of.name.as_str()).collect();
        assert_eq!(names, ["carpet", "wood", "cork"]);
        assert_eq!(likely[0].probability, 0.7);
        let many = likely_materials((0..12).map(|_| ("paper", 1.0 / 12.0)));
        assert_eq!(many.len(), 5);
        assert!(likely_materials(std::iter::empty::<(&str, f64)>()).is_empty());
    }
}
