//! Textures of the starter library from physical materials: simulated strokes, fitted models, labels and a picture.
//!
//! Every material is stroked at [`STARTER_SPEEDS_MM_PER_S`] and [`STARTER_FORCES_N`]. Each stroke gives one AR model
//! and one level. The tap transient is that of a landing at [`REFERENCE_LANDING`]. Positions in the space are physical
//! labels, scaled to the axes by [`places`]. They are simulated, not human ratings, and any display of them must say so.

use crate::dsp::ar::{ArError, order_by_bic, yule_walker};
use crate::dsp::lsf::lsf_from_ar;
use crate::dsp::spectrum::rms;
use crate::maths::rng::derive_seed;
use crate::space::SpacePoint;
use crate::surfaces::contact_model::landing::{REFERENCE_LANDING, landing};
use crate::surfaces::contact_model::{
    PEN, STARTER_PATH_M, STROKE_RATE, StrokeError, Surface, drag, hardness, prepare, press, roughness,
};
use crate::surfaces::height_field::{STARTER_TILE, synthesize};
use crate::surfaces::material::{Material, MaterialError, validate};
use crate::surfaces::shading::{Framing, Picture, shade};
use crate::texture::patterns::{STARTER_FORCES_N, STARTER_SPEEDS_MM_PER_S};
use crate::texture::{GrainNode, TextureModel, TextureModelError};
use crate::units::{MetersPerSecond, Newtons};

/// Duration of each stroke, in seconds.
pub const STROKE_SECS: f64 = 1.0;
/// Lowest AR order: fewer poles cannot follow the shape of a real spectrum.
pub const MIN_ORDER: usize = 10;
/// Highest AR order: more poles would fit the noise of a one-second stroke.
pub const MAX_ORDER: usize = 20;
/// Size of the picture of a material.
pub const FRAMING: Framing = Framing { n_pixels: 256, millimeters: 20.0 };

/// A texture computed from a material.
#[derive(Clone, Debug, PartialEq)]
pub struct StarterTexture {
    /// Texture model fitted to the simulated strokes.
    pub model: TextureModel,
    /// Physical labels.
    pub labels: Labels,
    /// Picture of the material.
    pub picture: Picture,
}

/// The physical labels of a material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Labels {
    /// log₁₀ of the RMS acceleration in m/s² at 100 mm/s and 1 N.
    pub roughness_log10_mps2: f64,
    /// log₁₀ of the Hertz contact stiffness in N/m at 1 N.
    pub hardness_log10_n_per_m: f64,
}

/// Reasons why a material gives no texture.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StarterError {
    /// A material parameter is invalid.
    #[error(transparent)]
    Material(#[from] MaterialError),
    /// A stroke could not be simulated.
    #[error(transparent)]
    Stroke(#[from] StrokeError),
    /// An AR model cannot be fitted to a stroke.
    #[error("no AR model fits the stroke at {speed_mm_per_s} mm/s and {force_n} N: {source}")]
    Fit {
        /// Speed of the stroke, in mm/s.
        speed_mm_per_s: f64,
        /// Force of the stroke, in N.
        force_n: f64,
        /// Cause.
        source: ArError,
    },
    /// An AR model is at the limit of stability.
    #[error("the AR model of the stroke at {speed_mm_per_s} mm/s and {force_n} N is not stable")]
    Unstable {
        /// Speed of the stroke, in mm/s.
        speed_mm_per_s: f64,
        /// Force of the stroke, in N.
        force_n: f64,
    },
    /// The fitted values do not form a texture model.
    #[error(transparent)]
    Model(#[from] TextureModelError),
}

/// Acceleration of one simulated stroke.
struct Stroked {
    speed_mm_per_s: f64,
    force_n: f64,
    accel_mps2: Vec<f64>,
}

/// Returns the labels and picture of a material as [`make`] gives them, without simulating all of its strokes.
///
/// Takes a small part of the time of [`make`].
///
/// # Errors
/// [`StarterError::Material`] and [`StarterError::Stroke`].
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

/// Returns the texture of a material, deterministic for a seed; takes some seconds.
///
/// # Errors
/// See the variants of [`StarterError`].
pub fn make(material: &Material, seed: u64) -> Result<StarterTexture, StarterError> {
    validate(material)?;
    let field = synthesize(material, STARTER_TILE, seed);
    let surface = prepare(material, &field, &PEN, STARTER_PATH_M, seed);
    let stroke_seed = |purpose: &str| derive_seed(derive_seed(seed, &material.id), purpose);
    let mut strokes = Vec::with_capacity(STARTER_SPEEDS_MM_PER_S.len() * STARTER_FORCES_N.len());
    for force_n in STARTER_FORCES_N {
        let pressed = press(&surface, Newtons(force_n))?;
        for speed_mm_per_s in STARTER_SPEEDS_MM_PER_S {
            let seed = stroke_seed(&format!("stroke at {speed_mm_per_s} mm/s and {force_n} N"));
            let accel_mps2 =
                drag(&pressed, MetersPerSecond::from_mm_per_s(speed_mm_per_s), STROKE_SECS, seed)?;
            strokes.push(Stroked { speed_mm_per_s, force_n, accel_mps2 });
        }
    }
    let labels = labels(material, &surface, seed)?;
    let model = fit(&strokes, material.friction_coefficient)?.with_tap(Some(landing(
        material,
        &PEN,
        REFERENCE_LANDING,
    )));
    Ok(StarterTexture { model, labels, picture: shade(&field, material, &FRAMING) })
}

/// Fits AR models of one common order: the median of the BIC orders of all strokes, within [`MIN_ORDER`] to
/// [`MAX_ORDER`].
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

/// Range of the labels of a set of textures: the ends of the axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LabelSpan {
    /// Smallest value of each label.
    pub low: Labels,
    /// Largest value of each label.
    pub high: Labels,
}

impl LabelSpan {
    /// Returns the span of these labels.
    pub fn of(labels: &[Labels]) -> Self {
        let all = |pick: fn(f64, f64) -> f64, begin: f64| Labels {
            roughness_log10_mps2: labels.iter().map(|l| l.roughness_log10_mps2).fold(begin, pick),
            hardness_log10_n_per_m: labels.iter().map(|l| l.hardness_log10_n_per_m).fold(begin, pick),
        };
        Self { low: all(f64::min, f64::INFINITY), high: all(f64::max, f64::NEG_INFINITY) }
    }

    /// Returns the decades of RMS acceleration from smoothest to roughest.
    pub fn roughness_decades(&self) -> f64 {
        self.high.roughness_log10_mps2 - self.low.roughness_log10_mps2
    }

    /// Returns the decades of contact stiffness from softest to hardest.
    pub fn hardness_decades(&self) -> f64 {
        self.high.hardness_log10_n_per_m - self.low.hardness_log10_n_per_m
    }

    /// Returns the rough-smooth and hard-soft coordinates: 0 to 100 within the span, not finite if all labels are
    /// equal.
    pub fn axes(&self, labels: &Labels) -> [f64; 2] {
        let along = |value: fn(&Labels) -> f64| {
            let (low, high) = (value(&self.low), value(&self.high));
            100.0 * (high - value(labels)) / (high - low)
        };
        [along(|l| l.roughness_log10_mps2), along(|l| l.hardness_log10_n_per_m)]
    }
}

/// Returns positions from labels: roughest 0 to smoothest 100, hardest 0 to softest 100, linear in between.
///
/// A coordinate is 50 if all labels of its axis are equal or a label is not finite.
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
        Labels, MAX_ORDER, MIN_ORDER, STARTER_FORCES_N, STARTER_SPEEDS_MM_PER_S, StarterError, Stroked, fit,
        make, pictured, places,
    };
    use crate::dsp::ar::test_signals::from_resonances;
    use crate::dsp::spectrum::rms;
    use crate::maths::rng::lcg_noise;
    use crate::surfaces::material::tests::plain;
    use crate::units::Hertz;

    fn stroked(resonances: &[(Hertz, f64)], level: f64, seed: u64) -> Stroked {
        let ar = from_resonances(Hertz(1000.0), resonances);
        let mut x = lcg_noise(2000, seed);
        for n in 0..x.len() {
            x[n] -= (1..=ar.len().min(n)).map(|k| ar[k - 1] * x[n - k]).sum::<f64>();
        }
        let accel_mps2 = x.split_off(1000).into_iter().map(|v| level * v).collect();
        // Two nodes at the same speed and force are an error.
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
        assert_eq!(texture.model.nodes().len(), STARTER_SPEEDS_MM_PER_S.len() * STARTER_FORCES_N.len());
        assert_eq!(texture.picture.rgb.len(), 3 * 256 * 256);
        let at_reference = texture.labels.roughness_log10_mps2;
        let near = texture.model.nodes().iter().find(|n| n.speed.0 == 0.12 && n.force.0 == 0.8).unwrap();
        // One second of a random surface: levels agree within some dB, and speed and force differ slightly.
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
