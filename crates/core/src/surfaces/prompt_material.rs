//! A material generated from a prompt, to be pictured and felt.
//!
//! One of the known materials is changed toward the appearance and physical labels that the prompt describes.

use crate::space::SpacePoint;
use crate::surfaces::material::{Bumps, Material, Pattern};
use crate::surfaces::prompt::PromptInterpretation;
use crate::surfaces::starter::LabelSpan;
use crate::surfaces::touch_words::Shade;

/// A material with a known position in the texture space.
#[derive(Clone, Debug, PartialEq)]
pub struct Anchor {
    /// The material.
    pub material: Material,
    /// Position from its physical labels.
    pub place: SpacePoint,
}

/// Limits of the factor that scales heights: beyond them the surface would become another material.
const HEIGHTS: (f64, f64) = (0.05, 20.0);
/// Hertz contact stiffness grows with the modulus to the power of 2/3, so the modulus grows with stiffness to 3/2.
const MODULUS_OF_STIFFNESS: f64 = 1.5;
/// Limits of Young's modulus, in Pa.
const MODULI_PA: (f64, f64) = (1e5, 2e11);
/// Largest height of any part of the surface, in m.
const HIGHEST_M: f64 = 2e-3;
/// Limits of a pattern's period, in m: those a stylus can resolve.
const PERIODS_M: (f64, f64) = (2e-4, 2e-2);
/// Pattern amplitude for a surface without a pattern: in m at the flattest, and decades more at the bumpiest.
const FLAT_M: f64 = 2e-6;
const BUMPY_DECADES: f64 = 1.4;
/// Irregularity of a pattern that the prompt asks for, if the surface has no pattern of this kind, and the largest one. A
/// phase that wanders by more than a tenth of a period would blur the period that a hand and an eye find.
const USUAL_JITTER: f64 = 0.08;
const MOST_JITTER: f64 = 0.1;
/// The largest irregularity of a pattern with a stated period: a person who states a number means a regular pattern.
const MOST_STATED_JITTER: f64 = 0.02;
/// Color of a surface whose color is unknown.
const GRAY: [u8; 3] = [150, 148, 144];

/// Returns the material that a prompt describes, with `name` as its name; `None` without anchors.
///
/// It starts from the anchor that the prompt names, or else from the nearest anchor. Heights are scaled by the change in
/// roughness that the prompt asks for, and the modulus by the change in hardness, both within limits. The resulting
/// labels are not simulated. `span` is the label range that the axes of the anchors' positions cover.
pub fn imagine(
    name: &str,
    understood: &PromptInterpretation,
    anchors: &[Anchor],
    span: &LabelSpan,
) -> Option<Material> {
    let [rough, hard, bumpy, ..] = understood.attributes;
    let looks = &understood.looks;
    let named =
        looks.like.as_ref().and_then(|like| anchors.iter().find(|anchor| anchor.material.id == *like));
    let off = |anchor: &Anchor| {
        let [rs, hs] = [anchor.place.x(), anchor.place.y()];
        ((rs - rough.mean) / rough.deviation).powi(2) + ((hs - hard.mean) / hard.deviation).powi(2)
    };
    let anchor = named.or_else(|| anchors.iter().min_by(|a, b| off(a).total_cmp(&off(b))))?;
    let mut material = anchor.material.clone();
    "imagined".clone_into(&mut material.id);
    name.clone_into(&mut material.name);
    material.tags.clear();

    let decades = (anchor.place.x() - rough.mean) / 100.0 * span.roughness_decades();
    let higher = 10.0_f64.powf(decades).clamp(HEIGHTS.0, HEIGHTS.1);
    let decades = (anchor.place.y() - hard.mean) / 100.0 * span.hardness_decades();
    let stiffer = 10.0_f64.powf(decades * MODULUS_OF_STIFFNESS);
    material.youngs_modulus_pa = (material.youngs_modulus_pa * stiffer).clamp(MODULI_PA.0, MODULI_PA.1);
    material.height_rms_m = (material.height_rms_m * higher).min(HIGHEST_M);
    // Friction heterogeneity scales with the square root of the height factor.
    material.friction_heterogeneity = (material.friction_heterogeneity * higher.sqrt()).clamp(0.01, 1.0);
    material.roll_off_m = (material.roll_off_m * looks.scale).clamp(1e-4, 2e-2);
    for bumps in &mut material.bumps {
        *bumps = scaled(*bumps, higher, looks.scale);
    }
    let before = material.pattern;
    material.pattern = match (looks.pattern, before) {
        (Some((kind, period_m)), _) => {
            let flat = FLAT_M * 10.0_f64.powf(BUMPY_DECADES * bumpy.mean / 100.0);
            let amplitude_m = before.map_or(flat, |before| (before.amplitude_m * higher).max(flat));
            let same = before.filter(|before| before.kind == kind);
            let (most, scale) =
                if looks.is_period_stated { (MOST_STATED_JITTER, 1.0) } else { (MOST_JITTER, looks.scale) };
            let jitter = same.map_or(USUAL_JITTER, |before| before.jitter).min(most);
            Some(pattern(Pattern { kind, period_m, amplitude_m, jitter }, scale))
        }
        (None, Some(before)) => {
            Some(pattern(Pattern { amplitude_m: before.amplitude_m * higher, ..before }, looks.scale))
        }
        (None, None) => None,
    };
    color(&mut material, understood, named.is_some());
    if let Some(gloss) = looks.gloss {
        material.gloss = gloss;
    }
    if let Some(mottle) = looks.mottle {
        material.mottle = mottle;
    }
    Some(material)
}

fn scaled(bumps: Bumps, higher: f64, wider: f64) -> Bumps {
    let radius_m = (bumps.radius_m * wider).clamp(1e-5, 2e-3);
    let widened = radius_m / bumps.radius_m;
    let height_m = (bumps.height_m * higher).clamp(-HIGHEST_M, HIGHEST_M);
    // Keeps the covered fraction of the surface.
    Bumps { height_m, radius_m, density_per_m2: bumps.density_per_m2 / (widened * widened).max(1.0), ..bumps }
}

fn pattern(pattern: Pattern, wider: f64) -> Pattern {
    let period_m = (pattern.period_m * wider).clamp(PERIODS_M.0, PERIODS_M.1);
    // Limits the steepness to a stud half as high as it is wide.
    let amplitude_m = pattern.amplitude_m.min(0.25 * period_m).min(HIGHEST_M);
    Pattern { period_m, amplitude_m, ..pattern }
}

/// Applies the requested colors; the ratio of valley to peak luma is kept.
fn color(material: &mut Material, understood: &PromptInterpretation, is_named: bool) {
    let looks = &understood.looks;
    let wanted = match looks.color_srgb {
        Some(color) => Some(color),
        // The color of an anchor that is only near is not informative.
        None if is_named => None,
        None => Some(GRAY),
    };
    if let Some(wanted) = wanted {
        let darker = (luma(material.valley_srgb) / luma(material.peak_srgb).max(1.0)).clamp(0.2, 1.0);
        material.peak_srgb = wanted;
        material.valley_srgb = wanted.map(|channel| (f64::from(channel) * darker).round() as u8);
        if material.metallic < 0.5 {
            material.metallic = material.metallic.min(0.2);
        }
    }
    if let Some(second) = looks.second_srgb {
        material.valley_srgb = second;
    }
    material.peak_srgb = shaded(material.peak_srgb, looks.shade);
    material.valley_srgb = shaded(material.valley_srgb, looks.shade);
}

/// Rec. 601 luma, 0 to 255.
fn luma(srgb: [u8; 3]) -> f64 {
    let [r, g, b] = srgb.map(f64::from);
    0.299 * r + 0.587 * g + 0.114 * b
}

fn shaded(srgb: [u8; 3], shade: Shade) -> [u8; 3] {
    let middle = luma(srgb);
    srgb.map(|channel| {
        let vivid = middle + (1.0 + shade.saturation) * (f64::from(channel) - middle);
        let end = if shade.lightness < 0.0 { 0.0 } else { 255.0 };
        (vivid + shade.lightness.abs() * (end - vivid)).round().clamp(0.0, 255.0) as u8
    })
}

#[cfg(test)]
mod tests {
    use super::{Anchor, imagine};
    use crate::maths::gaussian_process::Estimate;
    use crate::space::SpacePoint;
    use crate::surfaces::material::tests::plain;
    use crate::surfaces::material::{Bumps, Material, Pattern, PatternKind, validate};
    use crate::surfaces::prompt::{Looks, PromptInterpretation};
    use crate::surfaces::starter::{LabelSpan, Labels};
    use crate::surfaces::touch_words::Shade;
    use proptest::prelude::{prop_assert, proptest};

    const SPAN: LabelSpan = LabelSpan {
        low: Labels { roughness_log10_mps2: -0.5, hardness_log10_n_per_m: 3.0 },
        high: Labels { roughness_log10_mps2: 1.0, hardness_log10_n_per_m: 5.6 },
    };

    fn anchors() -> Vec<Anchor> {
        let bumps =
            Bumps { height_m: 5e-6, radius_m: 1e-4, elongation: 2.0, spread_rad: 1.0, density_per_m2: 9e6 };
        let pattern = Pattern { kind: PatternKind::Loops, period_m: 2e-3, amplitude_m: 6e-5, jitter: 0.1 };
        let carpet = Material {
            id: "carpet".to_owned(),
            youngs_modulus_pa: 1e6,
            bumps: vec![bumps],
            pattern: Some(pattern),
            ..plain()
        };
        let at = |rs, hs| SpacePoint::new(rs, hs).unwrap();
        vec![
            Anchor { material: plain(), place: at(80.0, 5.0) },
            Anchor { material: carpet, place: at(30.0, 90.0) },
        ]
    }

    fn understood(rs: f64, hs: f64, looks: Looks) -> PromptInterpretation {
        let estimate = |mean| Estimate { mean, deviation: 10.0 };
        PromptInterpretation {
            attributes: [rs, hs, 50.0, 50.0, 50.0].map(estimate),
            looks,
            words: Vec::new(),
            unknown: Vec::new(),
            disputed: Vec::new(),
            n_left_out: 0,
        }
    }

    fn looks() -> Looks {
        Looks { scale: 1.0, ..Looks::default() }
    }

    #[test]
    fn a_material_that_is_asked_for_as_it_is_stays_as_it_is() {
        let like = Looks { like: Some("carpet".to_owned()), ..looks() };
        let made = imagine("Carpet", &understood(30.0, 90.0, like), &anchors(), &SPAN).unwrap();
        let mut expected = anchors()[1].material.clone();
        (expected.id, expected.name) = ("imagined".to_owned(), "Carpet".to_owned());
        assert_eq!(made, expected);
    }

    #[test]
    fn what_is_rougher_is_higher_and_what_is_harder_stiffer() {
        let made = |rs, hs| imagine("x", &understood(rs, hs, looks()), &anchors(), &SPAN).unwrap();
        let (known, rough) = (made(80.0, 5.0), made(60.0, 5.0));
        // A fifth of the axis: 0.3 decades.
        assert!((rough.height_rms_m / known.height_rms_m - 10.0_f64.powf(0.3)).abs() < 1e-9);
        let soft = made(80.0, 25.0);
        assert!((known.youngs_modulus_pa / soft.youngs_modulus_pa).log10() - 0.2 * 2.6 * 1.5 < 1e-9);
        assert_eq!(made(31.0, 88.0).pattern.unwrap().kind, PatternKind::Loops, "not the nearest");
        assert_eq!(made(31.0, 88.0).peak_srgb, super::GRAY);
        assert_eq!(imagine("x", &understood(1.0, 1.0, looks()), &[], &SPAN), None);
    }

    #[test]
    fn looks_are_those_that_were_asked_for() {
        let wanted = Looks {
            like: Some("plain".to_owned()),
            color_srgb: Some([200, 20, 20]),
            shade: Shade { lightness: -0.5, saturation: 0.0 },
            gloss: Some(0.9),
            mottle: Some(0.4),
            pattern: Some((PatternKind::Ridges, 3e-3)),
            scale: 0.5,
            ..Looks::default()
        };
        let made = imagine("x", &understood(80.0, 5.0, wanted), &anchors(), &SPAN).unwrap();
        assert_eq!((made.peak_srgb, made.gloss, made.mottle), ([100, 10, 10], 0.9, 0.4));
        assert!(made.valley_srgb[0] < 60);
        let pattern = made.pattern.unwrap();
        assert_eq!((pattern.kind, pattern.period_m), (PatternKind::Ridges, 1.5e-3));
    }

    #[test]
    fn a_period_that_is_stated_is_kept() {
        let wanted = Looks {
            like: Some("carpet".to_owned()),
            pattern: Some((PatternKind::Ridges, 3e-3)),
            is_period_stated: true,
            scale: 0.5,
            ..Looks::default()
        };
        let made = imagine("x", &understood(30.0, 90.0, wanted), &anchors(), &SPAN).unwrap();
        let pattern = made.pattern.unwrap();
        // Neither its jitter, which is that of loops, nor its scale is used.
        assert_eq!((pattern.period_m, pattern.jitter), (3e-3, super::MOST_STATED_JITTER));
    }

    proptest! {
        #[test]
        fn whatever_is_asked_for_is_a_material(
            (rs, hs, bumpy) in (0.0..=100.0_f64, 0.0..=100.0_f64, 0.0..=100.0_f64),
            (scale, period_m, kind) in (0.1..10.0_f64, 1e-4..2e-2_f64, 0..3_usize),
            (lightness, saturation) in (-1.0..=1.0_f64, -1.0..=1.0_f64),
        ) {
            let kinds = [None, Some((PatternKind::Cells, period_m)), Some((PatternKind::PlainWeave, period_m))];
            for like in [None, Some("plain".to_owned()), Some("carpet".to_owned())] {
                let shade = Shade { lightness, saturation };
                let wanted = Looks { like, scale, pattern: kinds[kind], shade, ..Looks::default() };
                let mut understood = understood(rs, hs, wanted);
                understood.attributes[2].mean = bumpy;
                let made = imagine("x", &understood, &anchors(), &SPAN).unwrap();
                prop_assert!(validate(&made).is_ok(), "{:?}", validate(&made));
            }
        }
    }
}
