//! Where something is taken to lie, and how sure that is.

use std::sync::Arc;

use shagreen_core::gaussian_process::Estimate;
use shagreen_core::generated::{Witness, agree};
use shagreen_core::prompt::{OPEN, Understood};
use shagreen_core::space::SpacePoint;
use shagreen_core::touch_words::ATTRIBUTES;
use shagreen_formats::picture::Picture;

use crate::strings::prompt as strings;

/// What something was taken for.
#[derive(Clone, Debug, PartialEq)]
pub struct Guess {
    /// The authored texture that was made of it.
    pub key: Option<u32>,
    /// What it was made of.
    pub origin: Origin,
    /// What made the picture.
    pub made_by: String,
    /// The picture.
    pub picture: Arc<Picture>,
    /// What it is called.
    pub name: String,
    /// The two axes of the space, 0..100.
    pub axes: [Estimate; 2],
    /// What there is to say of it, in sentences; the first are the most important.
    pub said: Vec<String>,
    /// Whether its words and its picture disagree.
    pub is_disputed: bool,
}

/// What a guess was made of.
#[derive(Clone, Debug, PartialEq)]
pub enum Origin {
    /// Words, and a seed.
    Words {
        /// The words.
        prompt: String,
        /// Of what was drawn.
        seed: u64,
    },
    /// A photo of this name.
    Photo(String),
}

impl Guess {
    /// The place.
    pub fn at(&self) -> SpacePoint {
        let [rough_smooth, hard_soft] = self.axes.map(|axis| axis.mean.clamp(0.0, 100.0));
        SpacePoint { rough_smooth, hard_soft }
    }

    /// The authored texture that was made of it, with its picture.
    pub(super) fn replaced(&self) -> Option<(u32, Arc<Picture>)> {
        Some((self.key?, Arc::clone(&self.picture)))
    }

    /// What is noted of the texture that is made of it.
    pub(crate) fn notes(&self) -> String {
        match &self.origin {
            Origin::Words { prompt, seed } => strings::note_of_words(&self.made_by, *seed, prompt),
            Origin::Photo(name) => strings::note_of_photo(name),
        }
    }
}

/// What words and a picture say of the axes of a space, by their names, and on which of them they disagree. Pictures tell the
/// first two of [`ATTRIBUTES`] only; an axis of which nothing is known is open.
pub(super) fn on_axes<'a>(
    axes: &'a [String; 2],
    words: Option<&Understood>,
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
    use shagreen_core::gaussian_process::Estimate;
    use shagreen_core::generated::Witness;
    use shagreen_core::prompt::{OPEN, understand};
    use shagreen_formats::lexicon_toml::built_in_lexicon;

    #[test]
    fn axes_are_told_by_their_names() {
        let words = understand("a very bumpy, rough stone", built_in_lexicon().unwrap());
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
