//! A surface from a prompt: its material, a tile of its relief and a picture of that, which has no seam where it is laid
//! beside itself. What a prompt and a picture each say of an attribute becomes one.

use crate::gaussian_process::Estimate;
use crate::height_field::{HeightField, Tile, synthesize};
use crate::imagined::{Anchor, imagine};
use crate::material::Material;
use crate::prompt::{OPEN, Understood};
use crate::shading::{Picture, shade_tile};
use crate::space::SpacePoint;
use crate::starter::LabelSpan;
use crate::touch_words::ATTRIBUTES;

/// The tile of a generated surface: 20 mm, as large as the pictures of the starter library, and as fine.
pub const GENERATED_TILE: Tile = Tile { n_cells: 512, spacing_m: 40e-6 };

/// Name of this generator where a picture says what made it.
pub const GENERATOR: &str = "procedural generator";

/// What was made of a prompt.
#[derive(Clone, Debug)]
pub struct Generated {
    /// The material.
    pub material: Material,
    /// Its relief.
    pub field: HeightField,
    /// Its picture, of the whole tile.
    pub picture: Picture,
}

/// The surface that a prompt describes, the same for the same seed; `None` without anchors.
///
/// At [`GENERATED_TILE`] and 512 pixels it takes about a second.
pub fn generate(
    prompt: &str,
    understood: &Understood,
    anchors: &[Anchor],
    span: &LabelSpan,
    n_pixels: usize,
    seed: u64,
) -> Option<Generated> {
    let material = imagine(prompt, understood, anchors, span)?;
    let field = synthesize(&material, GENERATED_TILE, seed);
    let picture = shade_tile(&field, &material, n_pixels);
    Some(Generated { material, field, picture })
}

/// What two estimates of one attribute come to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Agreed {
    /// The attribute.
    pub estimate: Estimate,
    /// Whether they differ by more than they are unsure.
    pub differ: bool,
}

/// Deviations of their difference beyond which two estimates differ: one pair in twenty by chance.
const DIFFER: f64 = 2.0;

/// What a picture knows beside the words that it was made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Witness {
    /// Nothing: it was computed from what the words mean.
    OfTheWords,
    /// More: whoever made it knows what such words look like.
    OnItsOwn,
}

/// One estimate of two, each counting by its precision.
///
/// A picture is made after the words, so the two are no independent witnesses. One that was computed from the words makes them
/// no surer; one that knows more is as sure as it is itself, where that is surer. Where they are further apart than they are
/// unsure, both together are as much more unsure (R. Birge 1932).
pub fn agree(words: Estimate, picture: Estimate, witness: Witness) -> Agreed {
    let weights = [words, picture].map(|estimate| estimate.deviation.max(1e-6).powi(-2));
    let mean = (weights[0] * words.mean + weights[1] * picture.mean) / (weights[0] + weights[1]);
    let apart = (words.mean - picture.mean).abs() / words.deviation.hypot(picture.deviation).max(1e-6);
    let surest = match witness {
        Witness::OfTheWords => words.deviation,
        Witness::OnItsOwn => words.deviation.min(picture.deviation),
    };
    let deviation = (surest * apart.max(1.0)).min(OPEN.deviation);
    Agreed { estimate: Estimate { mean, deviation }, differ: apart > DIFFER }
}

/// Where something that was described and pictured lies.
#[derive(Clone, Debug, PartialEq)]
pub struct Placed {
    /// What words and picture come to on each axis, rough-smooth and hard-soft.
    pub axes: [Agreed; 2],
    /// The place.
    pub at: SpacePoint,
}

/// The place of what these words say, and this picture, on the first two of [`ATTRIBUTES`].
pub fn place(words: [Estimate; 2], picture: [Estimate; 2], witness: Witness) -> Placed {
    let axes = [0, 1].map(|axis| agree(words[axis], picture[axis], witness));
    let [rough_smooth, hard_soft] = axes.map(|agreed| agreed.estimate.mean.clamp(0.0, 100.0));
    Placed { axes, at: SpacePoint { rough_smooth, hard_soft } }
}

impl Placed {
    /// The axes on which the words and the picture disagree.
    pub fn disputed(&self) -> Vec<&'static str> {
        ATTRIBUTES.into_iter().zip(&self.axes).filter(|(_, of)| of.differ).map(|(name, _)| name).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::{GENERATED_TILE, Witness, agree, generate, place};
    use crate::gaussian_process::Estimate;
    use crate::imagined::Anchor;
    use crate::material::tests::plain;
    use crate::prompt::{Looks, OPEN, Understood};
    use crate::space::SpacePoint;
    use crate::starter::{LabelSpan, Labels};

    const SPAN: LabelSpan = LabelSpan {
        low: Labels { roughness_log10_mps2: -0.7, hardness_log10_n_per_m: 3.0 },
        high: Labels { roughness_log10_mps2: 0.8, hardness_log10_n_per_m: 5.6 },
    };

    #[test]
    fn a_seed_gives_the_same_surface_and_another_another() {
        let at = SpacePoint::new(50.0, 50.0).unwrap();
        let anchors = [Anchor { material: plain(), place: at }];
        let understood = Understood {
            attributes: [Estimate { mean: 40.0, deviation: 10.0 }; 5],
            looks: Looks { scale: 1.0, ..Looks::default() },
            words: Vec::new(),
            unknown: Vec::new(),
            disputed: Vec::new(),
            n_left_out: 0,
        };
        let made = |seed| generate("plain", &understood, &anchors, &SPAN, 32, seed).unwrap();
        let first = made(1);
        assert_eq!((first.picture.width, first.picture.rgb.len()), (32, 3 * 32 * 32));
        assert!((first.picture.millimeters - 1e3 * GENERATED_TILE.side_m()).abs() < 1e-9);
        assert_eq!(made(1).picture, first.picture);
        assert_ne!(made(2).picture, first.picture);
        assert!(generate("plain", &understood, &[], &SPAN, 32, 1).is_none());
    }

    #[test]
    fn the_surer_counts_more_and_a_quarrel_makes_unsure() {
        let of = |mean, deviation| Estimate { mean, deviation };
        let agreed = agree(of(40.0, 10.0), of(50.0, 5.0), Witness::OnItsOwn);
        assert!((agreed.estimate.mean - 48.0).abs() < 1e-12 && !agreed.differ);
        assert!((agreed.estimate.deviation - 5.0).abs() < 1e-12);
        let made_of_words = agree(of(50.0, 28.9), of(70.0, 5.0), Witness::OfTheWords);
        assert!((made_of_words.estimate.deviation - 28.9).abs() < 1e-12, "it knows no more than was said");
        let quarrel = agree(of(10.0, 3.0), of(60.0, 4.0), Witness::OfTheWords);
        assert!(quarrel.differ);
        // Ten times as far apart as unsure, which is all that there is to be unsure of.
        assert_eq!(quarrel.estimate.deviation, OPEN.deviation);
        // Twice as far apart.
        let apart = agree(of(40.0, 3.0), of(50.0, 4.0), Witness::OfTheWords);
        assert!((apart.estimate.deviation - 6.0).abs() < 1e-12 && !apart.differ, "{apart:?}");
        let placed =
            place([of(10.0, 3.0), of(80.0, 10.0)], [of(60.0, 4.0), of(90.0, 10.0)], Witness::OnItsOwn);
        assert_eq!(placed.disputed(), ["rough-smooth"]);
        assert!((placed.at.hard_soft - 85.0).abs() < 1e-9);
        assert_eq!(agree(of(20.0, 0.0), of(20.0, 0.0), Witness::OnItsOwn).estimate.mean, 20.0);
    }
}
