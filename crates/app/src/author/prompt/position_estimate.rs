//! Position estimated from a prompt or photo, with its uncertainty.

use std::sync::Arc;

use shagreen_core::maths::gaussian_process::Estimate;
use shagreen_core::space::SpacePoint;
use shagreen_core::surfaces::generated::{Witness, agree};
use shagreen_core::surfaces::prompt::{OPEN, PromptInterpretation};
use shagreen_core::surfaces::touch_words::ATTRIBUTES;
use shagreen_formats::picture::Picture;
use shagreen_studio::felt::GeneratedSurface;

use crate::strings::prompt as strings;

/// Estimate made from a prompt or photo.
#[derive(Clone, Debug, PartialEq)]
pub struct PositionEstimate {
    /// Key of the authored texture that was made from the estimate.
    pub key: Option<u32>,
    /// Prompt or photo that the estimate was made from.
    pub origin: Origin,
    /// Name of the generator that made the picture.
    pub made_by: String,
    /// Generated picture or photo.
    pub picture: Arc<Picture>,
    /// Surface that a procedural picture shows.
    pub surface: Option<GeneratedSurface>,
    /// Name of the texture.
    pub name: String,
    /// Estimates along the two axes of the space (0 to 100), with standard deviations.
    pub axes: [Estimate; 2],
    /// Explanations as sentences, the most important ones first.
    pub said: Vec<String>,
    /// Whether words and picture lead to different estimates on an axis.
    pub is_disputed: bool,
}

/// Source of an estimate.
#[derive(Clone, Debug, PartialEq)]
pub enum Origin {
    /// Prompt, and the seed of its picture.
    Words {
        /// Text of the prompt.
        prompt: String,
        /// Seed of the picture generator.
        seed: u64,
    },
    /// Photo with this file name.
    Photo(String),
}

impl PositionEstimate {
    /// Estimated position, limited to the space (0 to 100 on both axes).
    pub fn at(&self) -> SpacePoint {
        let [rough_smooth, hard_soft] = self.axes.map(|axis| axis.mean.clamp(0.0, 100.0));
        SpacePoint { rough_smooth, hard_soft }
    }

    /// Key of the authored texture that was made from the estimate, and its picture.
    pub(super) fn replaced(&self) -> Option<(u32, Arc<Picture>)> {
        Some((self.key?, Arc::clone(&self.picture)))
    }

    /// Notes for the texture that is made from the estimate.
    pub(crate) fn notes(&self) -> String {
        match &self.origin {
            Origin::Words { prompt, seed } => strings::note_of_words(&self.made_by, *seed, prompt),
            Origin::Photo(name) => strings::note_of_photo(name),
        }
    }
}

/// Returns the estimates along the `axes`, combined from words and picture, and the names of axes on which both
/// disagree.
/// A picture yields estimates for the first two of [`ATTRIBUTES`] only. An axis without an estimate is [`OPEN`].
pub(super) fn on_axes<'a>(
    axes: &'a [String; 2],
    words: Option<&PromptInterpretation>,
    picture: &[Estimate],
    witness: Witness,
) -> ([Estimate; 2], Vec<&'a str>) {
    let mut disputed = Vec::new();
    let estimates = [0, 1].map(|axis| {
        let index = ATTRIBUTES.iter().position(|name| *name == axes[axis]);
        let said = index.and_then(|index| words.map(|words| words.attributes[index]));
        let seen = index.and_then(|index| picture.get(index).copied());
        match (said, seen) {
            (Some(said), Some(seen)) => {
                let agreed = agree(said, seen, witness);
                if agreed.differ {
                    disputed.push(axes[axis].as_str());
                }
                agreed.estimate
            }
            (Some(one), None) | (None, Some(one)) => one,
            (None, None) => OPEN,
        }
    });
    (estimates, disputed)
}

#[cfg(test)]
mod tests {
    use super::on_axes;
    use shagreen_core::maths::gaussian_process::Estimate;
    use shagreen_core::surfaces::generated::Witness;
    use shagreen_core::surfaces::prompt::{OPEN, interpret};
    use shagreen_formats::lexicon_toml::built_in_lexicon;

    #[test]
    fn axes_are_told_by_their_names() {
        let words = interpret("a very bumpy, rough stone", built_in_lexicon().unwrap());
        let picture = [Estimate { mean: 95.0, deviation: 2.0 }, Estimate { mean: 10.0, deviation: 5.0 }];
        let axes = |names: [&str; 2]| names.map(str::to_owned);
        let usual = axes(["rough-smooth", "hard-soft"]);
        let (both, disputed) = on_axes(&usual, Some(&words), &picture, Witness::OnItsOwn);
        assert_eq!(disputed, ["rough-smooth"]);
        assert!(both[1].mean < 25.0 && both[0].deviation > 2.0);
        let other = axes(["warm-cold", "flat-bumpy"]);
        let (open, disputed) = on_axes(&other, Some(&words), &picture, Witness::OnItsOwn);
        assert_eq!((open[0], disputed.len()), (OPEN, 0));
        assert!(open[1].mean > 70.0, "{open:?}");
        assert_eq!(on_axes(&usual, None, &picture, Witness::OnItsOwn).0, picture);
        assert_eq!(on_axes(&other, None, &picture, Witness::OnItsOwn).0, [OPEN; 2]);
    }
}
