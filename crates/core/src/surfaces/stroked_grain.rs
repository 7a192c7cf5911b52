//! Grain of a material from simulated strokes: one AR model and one level for each speed and force.
//!
//! A material is stroked across its lay at [`STARTER_SPEEDS_MM_PER_S`] and [`STARTER_FORCES_N`]. A directional material
//! ([`Material::is_directional`]) is stroked along its lay as well, at the same speeds and forces. All AR models have one
//! common order.

use crate::dsp::ar::{ArError, ArFit, order_by_bic, yule_walker};
use crate::dsp::lsf::lsf_from_ar;
use crate::dsp::spectrum::rms;
use crate::maths::rng::derive_seed;
use crate::surfaces::contact_model::{
    ACROSS, ALONG, PEN, STARTER_PATH_M, STROKE_RATE, StrokeError, Surface, drag, prepare, press,
};
use crate::surfaces::height_field::HeightField;
use crate::surfaces::material::Material;
use crate::texture::patterns::{STARTER_FORCES_N, STARTER_SPEEDS_MM_PER_S};
use crate::texture::{GrainNode, TextureModel, TextureModelError};
use crate::units::{MetersPerSecond, Newtons};

/// Duration of each stroke, in seconds.
pub const STROKE_SECS: f64 = 1.0;
/// Lowest AR order: fewer poles cannot follow the shape of a real spectrum.
pub const MIN_ORDER: usize = 10;
/// Highest AR order: more poles would fit the noise of a one-second stroke.
pub const MAX_ORDER: usize = 20;

/// Number of strokes in one direction.
const N_STROKES: usize = STARTER_SPEEDS_MM_PER_S.len() * STARTER_FORCES_N.len();

/// Surfaces of a material under the pen.
#[derive(Clone, Debug)]
pub struct StrokedSurfaces {
    /// For strokes across the lay.
    pub across: Surface,
    /// For strokes along the lay; `None` if the material has no direction.
    pub along: Option<Surface>,
}

/// Reasons why simulated strokes give no grain.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GrainError {
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
    /// The caller stopped the simulation.
    #[error("the simulation was stopped")]
    Stopped,
}

/// Acceleration of one simulated stroke.
struct Stroked {
    speed_mm_per_s: f64,
    force_n: f64,
    accel_mps2: Vec<f64>,
}

/// Returns the number of strokes over a material.
pub fn n_strokes(material: &Material) -> usize {
    if material.is_directional() { 2 * N_STROKES } else { N_STROKES }
}

/// Returns the surfaces of a material under the pen; `field` must be the tile of the same material.
pub fn prepare_strokes(material: &Material, field: &HeightField, seed: u64) -> StrokedSurfaces {
    let at = |angle| prepare(material, field, &PEN, STARTER_PATH_M, angle, seed);
    StrokedSurfaces { across: at(ACROSS), along: material.is_directional().then(|| at(ALONG)) }
}

/// Returns a texture with the grain and the friction coefficient of a material, deterministic for a seed; takes some
/// seconds. `step` is called after each of the [`n_strokes`] and returns whether to continue.
///
/// # Errors
/// See the variants of [`GrainError`].
pub fn stroked_grain(
    material: &Material,
    surfaces: &StrokedSurfaces,
    seed: u64,
    step: &dyn Fn() -> bool,
) -> Result<TextureModel, GrainError> {
    let across = strokes(material, &surfaces.across, seed, step)?;
    let along = surfaces.along.as_ref().map(|along| strokes(material, along, seed, step)).transpose()?;
    fit(&across, along.as_deref(), material.friction_coefficient)
}

/// Simulates the strokes over one surface. Both directions have the same start positions.
fn strokes(
    material: &Material,
    surface: &Surface,
    seed: u64,
    step: &dyn Fn() -> bool,
) -> Result<Vec<Stroked>, GrainError> {
    let seed = derive_seed(seed, &material.id);
    let mut strokes = Vec::with_capacity(N_STROKES);
    for force_n in STARTER_FORCES_N {
        let pressed = press(surface, Newtons(force_n))?;
        for speed_mm_per_s in STARTER_SPEEDS_MM_PER_S {
            let seed = derive_seed(seed, &format!("stroke at {speed_mm_per_s} mm/s and {force_n} N"));
            let accel_mps2 =
                drag(&pressed, MetersPerSecond::from_mm_per_s(speed_mm_per_s), STROKE_SECS, seed)?;
            strokes.push(Stroked { speed_mm_per_s, force_n, accel_mps2 });
            if !step() {
                return Err(GrainError::Stopped);
            }
        }
    }
    Ok(strokes)
}

/// Fits AR models of one common order: the median of the BIC orders of the strokes across the lay, within [`MIN_ORDER`]
/// to [`MAX_ORDER`]. So the grain across does not depend on whether a texture has a direction.
fn fit(across: &[Stroked], along: Option<&[Stroked]>, friction: f64) -> Result<TextureModel, GrainError> {
    let mut orders = Vec::with_capacity(N_STROKES);
    for stroke in across {
        let highest = predictor(stroke, MAX_ORDER)?;
        orders.push(order_by_bic(&highest, stroke.accel_mps2.len(), 1..=MAX_ORDER));
    }
    orders.sort_unstable();
    let order = orders.get(orders.len() / 2).map_or(MAX_ORDER, |median| (*median).max(MIN_ORDER));
    let model = TextureModel::new(STROKE_RATE, nodes(across, order)?, Some(friction))?;
    Ok(model.with_along(along.map(|along| nodes(along, order)).transpose()?)?)
}

fn nodes(strokes: &[Stroked], order: usize) -> Result<Vec<GrainNode>, GrainError> {
    strokes.iter().map(|stroke| node(stroke, order)).collect()
}

/// Returns the node of a stroke, with an AR model of this order.
fn node(stroke: &Stroked, order: usize) -> Result<GrainNode, GrainError> {
    let lsf = lsf_from_ar(&predictor(stroke, order)?.ar)
        .ok_or(GrainError::Unstable { speed_mm_per_s: stroke.speed_mm_per_s, force_n: stroke.force_n })?;
    Ok(GrainNode {
        speed: MetersPerSecond::from_mm_per_s(stroke.speed_mm_per_s),
        force: Newtons(stroke.force_n),
        lsf,
        level_mps2: rms(&stroke.accel_mps2),
    })
}

fn predictor(stroke: &Stroked, order: usize) -> Result<ArFit, GrainError> {
    yule_walker(&stroke.accel_mps2, order).map_err(|source| GrainError::Fit {
        speed_mm_per_s: stroke.speed_mm_per_s,
        force_n: stroke.force_n,
        source,
    })
}

#[cfg(test)]
mod tests;
