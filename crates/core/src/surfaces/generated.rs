//! A surface generated from a prompt: its material, a tile of its height field and a seamless picture of the tile.
//!
//! Also combines the attributes predicted from the prompt with those predicted from a picture. A picture that was computed
//! from the words adds no information, so the prediction from the words remains as it is.

use crate::maths::birge::{BirgeMean, birge_mean};
use crate::maths::gaussian_process::Estimate;
use crate::space::SpacePoint;
use crate::surfaces::height_field::{HeightField, Tile, synthesize};
use crate::surfaces::material::Material;
use crate::surfaces::prompt::{OPEN, PromptInterpretation};
use crate::surfaces::prompt_material::{Anchor, imagine};
use crate::surfaces::shading::{Picture, shade_tile};
use crate::surfaces::starter::LabelSpan;
use crate::surfaces::touch_words::ATTRIBUTES;

/// The tile of a generated surface without a pattern: 20 mm, the side length of starter library pictures, at the spacing of
/// the starter tile.
pub const GENERATED_TILE: Tile = Tile { n_cells: 512, spacing_m: 40e-6 };

/// Returns the tile of a generated surface: about as large as [`GENERATED_TILE`], and a whole number of repeats of the
/// material's pattern, so that the pattern has exactly the period of the material.
pub fn generated_tile(material: &Material) -> Tile {
    let Some(pattern) = &material.pattern else { return GENERATED_TILE };
    let repeat_m = f64::from(pattern.kind.n_periods()) * pattern.period_m;
    let n_repeats = (GENERATED_TILE.side_m() / repeat_m).round().max(1.0);
    let n_cells = GENERATED_TILE.n_cells;
    Tile { n_cells, spacing_m: n_repeats * repeat_m / n_cells as f64 }
}

/// Name of this generator in the provenance of a picture.
pub const GENERATOR: &str = "procedural generator";

/// A surface generated from a prompt.
#[derive(Clone, Debug)]
pub struct Generated {
    /// The material.
    pub material: Material,
    /// Height field of the material.
    pub field: HeightField,
    /// Picture of the whole tile.
    pub picture: Picture,
}

/// Returns the surface that a prompt describes, deterministic for a seed; `None` without anchors.
///
/// Takes about a second at 512 pixels. [`crate::surfaces::felt_material::felt`] gives the texture of the same surface, for
/// the tile of the field and the same seed.
pub fn generate(
    prompt: &str,
    understood: &PromptInterpretation,
    anchors: &[Anchor],
    span: &LabelSpan,
    n_pixels: usize,
    seed: u64,
) -> Option<Generated> {
    let material = imagine(prompt, understood, anchors, span)?;
    let field = synthesize(&material, generated_tile(&material), seed);
    let picture = shade_tile(&field, &material, n_pixels);
    Some(Generated { material, field, picture })
}

/// Combination of two estimates of one attribute.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CombinedEstimate {
    /// Combined estimate of the attribute.
    pub estimate: Estimate,
    /// Whether the two estimates differ by more than two standard deviations of their difference.
    pub differ: bool,
}

/// Threshold for a disagreement, in standard deviations of the difference: exceeded by chance in one pair of twenty.
const DIFFER: f64 = 2.0;

/// What a picture adds to the words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Witness {
    /// Nothing: the picture was computed from the meanings of the words. If its estimate differs, the picture does not show
    /// what the words mean.
    OfTheWords,
    /// Independent knowledge: a photo, or a picture by a generator that has learned what such words look like.
    OnItsOwn,
}

/// Returns the combination of two estimates of one attribute, from words and from a picture, and whether they differ.
///
/// A picture computed from the words changes neither mean nor standard deviation of the words. An independent picture is
/// combined with them as another measurement ([`birge_mean`]): weighted by its precision, and with a larger standard
/// deviation if the two disagree. It never exceeds that of [`OPEN`].
pub fn agree(words: Estimate, picture: Estimate, witness: Witness) -> CombinedEstimate {
    let Some(BirgeMean { estimate, ratio }) = birge_mean(&[words, picture]) else {
        return CombinedEstimate { estimate: words, differ: false };
    };
    let estimate = match witness {
        Witness::OfTheWords => words,
        Witness::OnItsOwn => Estimate { deviation: estimate.deviation.min(OPEN.deviation), ..estimate },
    };
    // The Birge ratio of two estimates is their distance in standard deviations of the difference.
    CombinedEstimate { estimate, differ: ratio > DIFFER }
}

/// Position in the texture space predicted from words and picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Placed {
    /// Combined estimate on each axis, rough-smooth and hard-soft.
    pub axes: [CombinedEstimate; 2],
    /// Predicted position.
    pub at: SpacePoint,
}

/// Returns the position predicted from words and picture on the first two of [`ATTRIBUTES`].
pub fn place(words: [Estimate; 2], picture: [Estimate; 2], witness: Witness) -> Placed {
    let axes = [0, 1].map(|axis| agree(words[axis], picture[axis], witness));
    let [rough_smooth, hard_soft] = axes.map(|agreed| agreed.estimate.mean.clamp(0.0, 100.0));
    Placed { axes, at: SpacePoint::plane(rough_smooth, hard_soft) }
}

impl Placed {
    /// Returns the names of the axes on which words and picture disagree.
    pub fn disputed(&self) -> Vec<&'static str> {
        ATTRIBUTES.into_iter().zip(&self.axes).filter(|(_, of)| of.differ).map(|(name, _)| name).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::{GENERATED_TILE, Witness, agree, generate, generated_tile, place};
    use crate::maths::gaussian_process::Estimate;
    use crate::space::SpacePoint;
    use crate::surfaces::material::tests::plain;
    use crate::surfaces::material::{Material, Pattern, PatternKind};
    use crate::surfaces::prompt::{Looks, OPEN, PromptInterpretation};
    use crate::surfaces::prompt_material::Anchor;
    use crate::surfaces::starter::{LabelSpan, Labels};
    use proptest::prelude::{prop_assert, prop_assert_eq, proptest};

    const SPAN: LabelSpan = LabelSpan {
        low: Labels { roughness_log10_mps2: -0.7, hardness_log10_n_per_m: 3.0 },
        high: Labels { roughness_log10_mps2: 0.8, hardness_log10_n_per_m: 5.6 },
    };

    #[test]
    fn a_seed_gives_the_same_surface_and_another_another() {
        let at = SpacePoint::new(50.0, 50.0).unwrap();
        let anchors = [Anchor { material: plain(), place: at }];
        let understood = PromptInterpretation {
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
    fn a_tile_holds_whole_periods_and_is_about_as_large_as_a_picture() {
        for kind in [PatternKind::Ridges, PatternKind::Twill, PatternKind::Domes] {
            for period_mm in [0.2, 0.9, 2.0, 3.3, 6.0, 8.0, 13.0, 20.0] {
                let pattern = Pattern { kind, period_m: 1e-3 * period_mm, amplitude_m: 1e-6, jitter: 0.1 };
                let tile = generated_tile(&Material { pattern: Some(pattern), ..plain() });
                let n_periods = tile.side_m() / pattern.period_m;
                assert!((n_periods - n_periods.round()).abs() < 1e-9, "{kind:?} {period_mm}");
                let repeat_mm = f64::from(kind.n_periods()) * period_mm;
                let off_mm = (1e3 * tile.side_m() - 20.48).abs();
                assert!(off_mm <= 0.5 * repeat_mm + 1e-9 || 1e3 * tile.side_m() <= repeat_mm + 1e-9);
            }
        }
        assert_eq!(generated_tile(&plain()), GENERATED_TILE);
    }

    fn of(mean: f64, deviation: f64) -> Estimate {
        Estimate { mean, deviation }
    }

    #[test]
    fn independent_estimates_are_weighted_and_a_disagreement_widens_them() {
        let agreed = agree(of(40.0, 10.0), of(50.0, 5.0), Witness::OnItsOwn);
        assert!((agreed.estimate.mean - 48.0).abs() < 1e-12 && !agreed.differ);
        // Surer than each of the two.
        assert!((agreed.estimate.deviation - 20.0_f64.sqrt()).abs() < 1e-12, "{agreed:?}");
        let apart = agree(of(40.0, 3.0), of(49.0, 4.0), Witness::OnItsOwn);
        // 1.8 standard deviations of the difference apart: 1.8 times 3 · 4 / 5.
        assert!((apart.estimate.deviation - 4.32).abs() < 1e-9 && !apart.differ, "{apart:?}");
        // Ten of them: 24. Twenty: the upper limit.
        let far = agree(of(10.0, 3.0), of(60.0, 4.0), Witness::OnItsOwn);
        assert!((far.estimate.deviation - 24.0).abs() < 1e-9 && far.differ, "{far:?}");
        let farther = agree(of(0.0, 3.0), of(100.0, 4.0), Witness::OnItsOwn);
        assert_eq!(farther.estimate.deviation, OPEN.deviation);
        assert_eq!(agree(of(20.0, 0.0), of(20.0, 0.0), Witness::OnItsOwn).estimate.mean, 20.0);
        let placed =
            place([of(10.0, 3.0), of(80.0, 10.0)], [of(60.0, 4.0), of(90.0, 10.0)], Witness::OnItsOwn);
        assert_eq!(placed.disputed(), ["rough-smooth"]);
        assert!((placed.at.y() - 85.0).abs() < 1e-9);
    }

    /// "Velvet" was understood as 84 and 87, and the picture of it moved that to 50 and 65.
    #[test]
    fn a_picture_made_from_the_words_does_not_overrule_them() {
        let words = [of(84.0, 9.0), of(87.0, 7.0)];
        let placed = place(words, [of(20.0, 4.0), of(40.0, 4.0)], Witness::OfTheWords);
        assert_eq!(placed.axes.map(|axis| axis.estimate), words);
        assert_eq!((placed.at.x(), placed.at.y()), (84.0, 87.0));
        // It is still said that the picture looks different.
        assert_eq!(placed.disputed(), ["rough-smooth", "hard-soft"]);
        let open = agree(OPEN, of(70.0, 5.0), Witness::OfTheWords);
        assert_eq!((open.estimate, open.differ), (OPEN, false));
    }

    proptest! {
        #[test]
        fn words_stay_as_they_are_beside_any_picture_of_them(
            (mean, deviation) in (0.0..=100.0_f64, 0.0..40.0_f64),
            (seen, seen_deviation) in (-50.0..=150.0_f64, 0.0..80.0_f64),
        ) {
            let (words, picture) = (of(mean, deviation), of(seen, seen_deviation));
            prop_assert_eq!(agree(words, picture, Witness::OfTheWords).estimate, words);
            let both = agree(words, picture, Witness::OnItsOwn);
            prop_assert_eq!(both.differ, agree(picture, words, Witness::OnItsOwn).differ);
            let (low, high) = (mean.min(seen), mean.max(seen));
            prop_assert!((low - 1e-9..=high + 1e-9).contains(&both.estimate.mean), "{both:?}");
            prop_assert!(both.estimate.deviation <= OPEN.deviation);
        }
    }
}
