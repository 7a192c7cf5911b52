//! Textures of the starter library from physical materials: simulated strokes, fitted models, labels and a picture.
//!
//! The grain is that of simulated strokes ([`stroked_grain`]): every stroke gives one AR model and one level. Directional
//! materials are stroked across and along their lay. The tap transient is that of a landing at [`REFERENCE_LANDING`].
//! Positions in the space are physical labels, scaled to the axes by [`places`]; roughness is that across the lay. They are
//! simulated, not human ratings, and any display of them must say so.

use crate::maths::rng::derive_seed;
use crate::space::SpacePoint;
use crate::surfaces::contact_model::landing::{REFERENCE_LANDING, landing};
use crate::surfaces::contact_model::{
    ACROSS, PEN, STARTER_PATH_M, StrokeError, Surface, hardness, prepare, roughness,
};
use crate::surfaces::height_field::{STARTER_TILE, synthesize};
use crate::surfaces::material::{Material, MaterialError, validate};
use crate::surfaces::shading::{Framing, Picture, shade};
use crate::surfaces::stroked_grain::{GrainError, prepare_strokes, stroked_grain};
use crate::texture::TextureModel;

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
    /// The strokes give no grain.
    #[error(transparent)]
    Grain(#[from] GrainError),
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
    let surface = prepare(material, &field, &PEN, STARTER_PATH_M, ACROSS, seed);
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
    let surfaces = prepare_strokes(material, &field, seed);
    let grain = stroked_grain(material, &surfaces, seed, &|| true)?;
    let model =
        grain.with_tap(Some(landing(material, &PEN, REFERENCE_LANDING))).with_stick_slip(material.stick_slip);
    let labels = labels(material, &surfaces.across, seed)?;
    Ok(StarterTexture { model, labels, picture: shade(&field, material, &FRAMING) })
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
        .map(|[rough_smooth, hard_soft]| SpacePoint::plane(rough_smooth, hard_soft))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::{Labels, StarterError, make, pictured, places};
    use crate::surfaces::contact_model::PEN;
    use crate::surfaces::material::Material;
    use crate::surfaces::material::tests::plain;
    use crate::texture::patterns::{STARTER_FORCES_N, STARTER_SPEEDS_MM_PER_S};
    use crate::texture::stick_slip::StickSlip;
    use crate::units::MetersPerSecond;

    #[test]
    fn the_roughest_and_the_hardest_are_at_zero() {
        let labels = |r, h| Labels { roughness_log10_mps2: r, hardness_log10_n_per_m: h };
        let at = places(&[labels(1.0, 3.0), labels(-1.0, 5.0), labels(0.0, 3.5)]);
        assert_eq!([at[0].x(), at[1].x(), at[2].x()], [0.0, 100.0, 50.0]);
        assert_eq!([at[0].y(), at[1].y(), at[2].y()], [100.0, 0.0, 75.0]);
        assert_eq!(places(&[labels(1.0, 3.0)])[0].x(), 50.0);
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
        assert_eq!(texture.model.along(), None);
    }

    #[test]
    fn a_directional_material_has_grain_along_its_lay() {
        let sticky = StickSlip { static_ratio: 1.3, stribeck_speed: MetersPerSecond(0.02) };
        let brushed = Material { stretch: 20.0, stick_slip: Some(sticky), ..plain() };
        let model = make(&brushed, 4).unwrap().model;
        assert_eq!(model.stick_slip(), Some(sticky));
        assert_eq!(model.friction(), Some(brushed.friction_coefficient));
        let along = model.along().unwrap();
        let power = |levels: Vec<f64>| levels.iter().map(|level| level * level).sum::<f64>();
        let across = power(model.nodes().iter().map(|node| node.level_mps2).collect());
        let along = power(along.iter().map(|node| node.level_mps2).collect());
        assert!(along < 0.25 * across, "{along} {across}");
    }

    #[test]
    fn the_pen_of_strokes_is_the_pen_that_sticks_and_slips() {
        assert_eq!(PEN.mass_kg as f32, shagreen_synth::stick_slip::MASS_KG);
    }

    #[test]
    fn nonsense_materials_are_refused() {
        let mut material = plain();
        material.hurst = f64::NAN;
        assert!(matches!(make(&material, 1), Err(StarterError::Material(_))));
    }
}
