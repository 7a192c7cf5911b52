//! From a physical material to a texture of the starter library: simulated strokes, fitted models, labels, a picture.
//!
//! Every material is stroked at [`SPEEDS_MM_PER_S`] by [`FORCES_N`]; each stroke becomes a predictor and a level. The
//! positions of a library are its physical labels, spread over the axes by [`places`]: no person felt anything, and
//! whoever shows them says so.

use crate::ar::{ArError, order_by_bic, yule_walker};
use crate::contact_model::{
    PEN, STARTER_PATH_M, STROKE_RATE, StrokeError, Surface, drag, hardness, prepare, press, roughness,
};
use crate::height_field::{STARTER_TILE, synthesize};
use crate::lsf::lsf_from_ar;
use crate::material::{Material, MaterialError, validate};
use crate::rng::derive_seed;
use crate::shading::{Framing, Picture, shade};
use crate::space::SpacePoint;
use crate::spectrum::rms;
use crate::texture::{GrainNode, TextureModel, TextureModelError};
use crate::units::{MetersPerSecond, Newtons};

/// Speeds at which a material is stroked, in mm/s.
pub const SPEEDS_MM_PER_S: [f64; 5] = [30.0, 70.0, 120.0, 180.0, 250.0];
/// Forces with which a material is stroked, in N.
pub const FORCES_N: [f64; 5] = [0.15, 0.4, 0.8, 1.5, 3.0];
/// Length of each stroke, in seconds.
pub const STROKE_SECS: f64 = 1.0;
/// Lowest order of a predictor: fewer poles lose the shape of a real spectrum.
pub const MIN_ORDER: usize = 10;
/// Highest order of a predictor: more poles than that follow the noise of one second.
pub const MAX_ORDER: usize = 20;
/// How the picture of a material is framed.
pub const FRAMING: Framing = Framing { n_pixels: 256, millimeters: 20.0 };

/// A texture made from a material.
#[derive(Clone, Debug, PartialEq)]
pub struct StarterTexture {
    /// What the material does to a tip.
    pub model: TextureModel,
    /// Its labels.
    pub labels: Labels,
    /// What it looks like.
    pub picture: Picture,
}

/// The physical labels of a material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Labels {
    /// log₁₀ of the root mean square acceleration in m/s² at 100 mm/s and 1 N.
    pub roughness_log10_mps2: f64,
    /// log₁₀ of the Hertz stiffness in N/m at 1 N.
    pub hardness_log10_n_per_m: f64,
}

/// Why a material makes no texture.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StarterError {
    /// Its parameters have no meaning.
    #[error(transparent)]
    Material(#[from] MaterialError),
    /// A stroke could not be simulated.
    #[error(transparent)]
    Stroke(#[from] StrokeError),
    /// A stroke has no predictor.
    #[error("the stroke at {speed_mm_per_s} mm/s and {force_n} N has no predictor: {source}")]
    Fit {
        /// Speed of the stroke, in mm/s.
        speed_mm_per_s: f64,
        /// Force of the stroke, in N.
        force_n: f64,
        /// Why.
        source: ArError,
    },
    /// A predictor is on the edge of stability.
    #[error("the stroke at {speed_mm_per_s} mm/s and {force_n} N has a predictor that is not stable")]
    Unstable {
        /// Speed of the stroke, in mm/s.
        speed_mm_per_s: f64,
        /// Force of the stroke, in N.
        force_n: f64,
    },
    /// The fitted numbers make no model.
    #[error(transparent)]
    Model(#[from] TextureModelError),
}

/// The acceleration of one stroke.
struct Stroked {
    speed_mm_per_s: f64,
    force_n: f64,
    accel_mps2: Vec<f64>,
}

/// The labels and the picture of a material as [`make`] would give them, without all of its strokes: a small part of the
/// work.
///
/// # Errors
/// See [`StarterError`].
pub fn pictured(material: &Material, seed: u64) -> Result<(Labels, Picture), StarterError> {
    validate(material)?;
    let field = synthesize(material, STARTER_TILE, seed);
    let surface = prepare(material, &field, &PEN, STARTER_PATH_M, seed);
    Ok((labels(material, &surface, seed)?, shade(&field, material, &FRAMING)))
}

fn labels(material: &Material, surface: &Surface, seed: u64) -> Result<Labels, StarterError> {
    let seed = derive_seed(derive_seed(seed, &material.id), "roughness");
    Ok(Labels {
        roughness_log10_mps2: roughness(surface, seed)?,
        hardness_log10_n_per_m: hardness(material, &PEN),
    })
}

/// The texture of a material, the same for the same seed; takes some seconds.
///
/// # Errors
/// See [`StarterError`].
pub fn make(material: &Material, seed: u64) -> Result<StarterTexture, StarterError> {
    validate(material)?;
    let field = synthesize(material, STARTER_TILE, seed);
    let surface = prepare(material, &field, &PEN, STARTER_PATH_M, seed);
    let stroke_seed = |purpose: &str| derive_seed(derive_seed(seed, &material.id), purpose);
    let mut strokes = Vec::with_capacity(SPEEDS_MM_PER_S.len() * FORCES_N.len());
    for force_n in FORCES_N {
        let pressed = press(&surface, Newtons(force_n))?;
        for speed_mm_per_s in SPEEDS_MM_PER_S {
            let seed = stroke_seed(&format!("stroke at {speed_mm_per_s} mm/s and {force_n} N"));
            let accel_mps2 =
                drag(&pressed, MetersPerSecond::from_mm_per_s(speed_mm_per_s), STROKE_SECS, seed)?;
            strokes.push(Stroked { speed_mm_per_s, force_n, accel_mps2 });
        }
    }
    let labels = labels(material, &surface, seed)?;
    let model = fit(&strokes, material.friction_coefficient)?;
    Ok(StarterTexture { model, labels, picture: shade(&field, material, &FRAMING) })
}

/// A model of one order, the median of those that the strokes prefer, within [`MIN_ORDER`] to [`MAX_ORDER`].
fn fit(strokes: &[Stroked], friction: f64) -> Result<TextureModel, StarterError> {
    let predictor = |stroke: &Stroked, order: usize| {
        yule_walker(&stroke.accel_mps2, order).map_err(|source| StarterError::Fit {
            speed_mm_per_s: stroke.speed_mm_per_s,
            force_n: stroke.force_n,
            source,
        })
    };
    let mut orders = Vec::with_capacity(strokes.len());
    for stroke in strokes {
        let highest = predictor(stroke, MAX_ORDER)?;
        orders.push(order_by_bic(&highest, stroke.accel_mps2.len(), 1..=MAX_ORDER));
    }
    orders.sort_unstable();
    let order = orders.get(orders.len() / 2).map_or(MAX_ORDER, |median| (*median).max(MIN_ORDER));
    let node = |stroke: &Stroked| {
        let lsf = lsf_from_ar(&predictor(stroke, order)?.ar).ok_or(StarterError::Unstable {
            speed_mm_per_s: stroke.speed_mm_per_s,
            force_n: stroke.force_n,
        })?;
        Ok(GrainNode {
            speed: MetersPerSecond::from_mm_per_s(stroke.speed_mm_per_s),
            force: Newtons(stroke.force_n),
            lsf,
            level_mps2: rms(&stroke.accel_mps2),
        })
    };
    let nodes = strokes.iter().map(node).collect::<Result<Vec<_>, StarterError>>()?;
    Ok(TextureModel::new(STROKE_RATE, nodes, Some(friction))?)
}

/// What the labels of some textures span: the ends of the axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LabelSpan {
    /// Smallest of each label.
    pub low: Labels,
    /// Largest of each label.
    pub high: Labels,
}

impl LabelSpan {
    /// Of these labels.
    pub fn of(labels: &[Labels]) -> Self {
        let all = |pick: fn(f64, f64) -> f64, begin: f64| Labels {
            roughness_log10_mps2: labels.iter().map(|l| l.roughness_log10_mps2).fold(begin, pick),
            hardness_log10_n_per_m: labels.iter().map(|l| l.hardness_log10_n_per_m).fold(begin, pick),
        };
        Self { low: all(f64::min, f64::INFINITY), high: all(f64::max, f64::NEG_INFINITY) }
    }

    /// Decades from the smoothest to the roughest.
    pub fn roughness_decades(&self) -> f64 {
        self.high.roughness_log10_mps2 - self.low.roughness_log10_mps2
    }

    /// Decades from the softest to the hardest.
    pub fn hardness_decades(&self) -> f64 {
        self.high.hardness_log10_n_per_m - self.low.hardness_log10_n_per_m
    }

    /// Rough to smooth and hard to soft, 0 to 100 for what lies within; not finite where all labels are alike.
    pub fn axes(&self, labels: &Labels) -> [f64; 2] {
        let along = |value: fn(&Labels) -> f64| {
            let (low, high) = (value(&self.low), value(&self.high));
            100.0 * (high - value(labels)) / (high - low)
        };
        [along(|l| l.roughness_log10_mps2), along(|l| l.hardness_log10_n_per_m)]
    }
}

/// Positions by labels: the roughest of the textures at 0 and the smoothest at 100, the hardest at 0 and the softest at
/// 100, the others in proportion. An axis on which all are alike, or have a label that is not finite, is at 50.
pub fn places(labels: &[Labels]) -> Vec<SpacePoint> {
    let span = LabelSpan::of(labels);
    let within = |v: f64| if v.is_finite() { v.clamp(0.0, 100.0) } else { 50.0 };
    labels
        .iter()
        .map(|labels| span.axes(labels).map(within))
        .map(|[rough_smooth, hard_soft]| SpacePoint { rough_smooth, hard_soft })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::{
        FORCES_N, Labels, MAX_ORDER, MIN_ORDER, SPEEDS_MM_PER_S, StarterError, Stroked, fit, make, pictured,
        places,
    };
    use crate::ar::test_signals::from_resonances;
    use crate::material::tests::plain;
    use crate::rng::lcg_noise;
    use crate::spectrum::rms;
    use crate::units::Hertz;

    fn stroked(resonances: &[(Hertz, f64)], level: f64, seed: u64) -> Stroked {
        let ar = from_resonances(Hertz(1000.0), resonances);
        let mut x = lcg_noise(2000, seed);
        for n in 0..x.len() {
            x[n] -= (1..=ar.len().min(n)).map(|k| ar[k - 1] * x[n - k]).sum::<f64>();
        }
        let accel_mps2 = x.split_off(1000).into_iter().map(|v| level * v).collect();
        // Two measurements at one place would be refused.
        Stroked { speed_mm_per_s: 100.0 + seed as f64, force_n: 1.0, accel_mps2 }
    }

    #[test]
    fn order_is_common_and_within_its_range() {
        let two = [(Hertz(100.0), 0.95)];
        let simple: Vec<Stroked> = (0..5).map(|i| stroked(&two, 1.0, i)).collect();
        assert_eq!(fit(&simple, 0.3).unwrap().order(), MIN_ORDER);
        let fourteen: Vec<(Hertz, f64)> = (1..8).map(|i| (Hertz(60.0 * f64::from(i)), 0.97)).collect();
        let rich: Vec<Stroked> = (0..5).map(|i| stroked(&fourteen, 1.0, i)).collect();
        let order = fit(&rich, 0.3).unwrap().order();
        assert!((14..=MAX_ORDER).contains(&order), "{order}");
    }

    #[test]
    fn level_is_that_of_the_signal() {
        let stroke = stroked(&[(Hertz(100.0), 0.9)], 0.25, 3);
        let rms = rms(&stroke.accel_mps2);
        let model = fit(&[stroke], 0.3).unwrap();
        assert!((model.nodes()[0].level_mps2 - rms).abs() < 1e-12);
        assert_eq!(model.friction(), Some(0.3));
    }

    #[test]
    fn a_stroke_without_vibration_is_named() {
        let still = Stroked { speed_mm_per_s: 70.0, force_n: 0.4, accel_mps2: vec![0.0; 1000] };
        let message = fit(&[still], 0.3).unwrap_err().to_string();
        assert!(message.contains("70 mm/s and 0.4 N"), "{message}");
    }

    #[test]
    fn the_roughest_and_the_hardest_are_at_zero() {
        let labels = |r, h| Labels { roughness_log10_mps2: r, hardness_log10_n_per_m: h };
        let at = places(&[labels(1.0, 3.0), labels(-1.0, 5.0), labels(0.0, 3.5)]);
        assert_eq!([at[0].rough_smooth, at[1].rough_smooth, at[2].rough_smooth], [0.0, 100.0, 50.0]);
        assert_eq!([at[0].hard_soft, at[1].hard_soft, at[2].hard_soft], [100.0, 0.0, 75.0]);
        assert_eq!(places(&[labels(1.0, 3.0)])[0].rough_smooth, 50.0);
        assert!(places(&[]).is_empty());
    }

    #[test]
    fn a_material_becomes_a_texture_and_repeats() {
        let texture = make(&plain(), 4).unwrap();
        assert_eq!(texture.model.nodes().len(), SPEEDS_MM_PER_S.len() * FORCES_N.len());
        assert_eq!(texture.picture.rgb.len(), 3 * 256 * 256);
        let at_reference = texture.labels.roughness_log10_mps2;
        let near = texture.model.nodes().iter().find(|n| n.speed.0 == 0.12 && n.force.0 == 0.8).unwrap();
        // One second of a random surface: levels agree within some decibels, and speed and force differ a little.
        assert!((near.level_mps2.log10() - at_reference).abs() < 0.3);
        assert_eq!(make(&plain(), 4).unwrap().model, texture.model);
        assert_eq!(pictured(&plain(), 4).unwrap(), (texture.labels, texture.picture.clone()));
        assert_ne!(make(&plain(), 5).unwrap().model, texture.model);
    }

    #[test]
    fn nonsense_materials_are_refused() {
        let mut material = plain();
        material.hurst = f64::NAN;
        assert!(matches!(make(&material, 1), Err(StarterError::Material(_))));
    }
}
