//! Contact model: simulated acceleration at a pen-mounted accelerometer while a ball tip strokes a material.
//!
//! The ball tip follows the surface profile (`dilate`). Its contact patch smooths finer detail (`patch_low_pass`). The
//! pen moves on the stiffness and damping of the contact and of the hand, and the tip can lose contact:
//!
//! - normal: `m z̈ = F_c − F − B ż − K z`, with `F_c = max(0, F + k (h − z) + c (ḣ − ż))`
//! - lateral: `m (ü + 2 ζ_l ω_l u̇ + ω_l² u) = µ F s ξ + µ (F_c − F) + F_c dh/dx`
//!
//! where ξ is a friction process of unit variance along the path and `c = 2 ζ √(k m)`. [`crate::dsp::dft321`] combines
//! both axes into one signal, which is high-passed and decimated to [`STROKE_RATE`]. Lengths in m are plain `f64`;
//! their names end in `_m`.
//!
//! [`prepare`] computes once what depends only on the surface and the angle of the stroke, and [`press`] once what depends
//! on the force. The model is that of a line: neither the ball nor its patch averages across the path. Along the lay of a
//! surface, where heights vary across the path, the level is therefore rather too high than too low.

mod dynamics;
pub mod following;
pub mod landing;
mod tip;

use crate::dsp::dft321::dft321;
use crate::dsp::filter::{butterworth_high_pass, decimate, filter_zero_phase};
use crate::dsp::spectrum::rms;
use crate::maths::rng::{Random, derive_seed};
use crate::surfaces::contact_model::dynamics::{Path, Run, Springs};
use crate::surfaces::contact_model::tip::{dilate, dilate_tile, patch_low_pass};
use crate::surfaces::height_field::{HeightField, PROFILE_STEP_M, elongation, profile};
use crate::surfaces::material::Material;
use crate::units::{Contact, Hertz, MetersPerSecond, Newtons, Radians};
use std::f64::consts::FRAC_PI_2;

/// Sampling rate of a simulated stroke.
pub const STROKE_RATE: Hertz = Hertz(1000.0);

/// Cut-off of the high-pass filter that removes hand motion.
const STROKE_HIGH_PASS: Hertz = Hertz(10.0);

/// Path length for one second at 250 mm/s, with room for a random start position.
pub const STARTER_PATH_M: f64 = 0.45;

/// Reference speed and force at which materials are compared; at this force the load scaling of the relief is 1.
pub const REFERENCE_CONTACT: Contact = Contact { speed: MetersPerSecond(0.1), force: Newtons(1.0) };

/// Simulation steps per output sample.
const OVERSAMPLING: usize = 16;

/// Time simulated before and after a stroke, so that start-up and filter transients decay.
const MARGIN_SECS: f64 = 0.15;

/// Length left unused at each end of a path: the path is not periodic, but its filters treat it as periodic.
const PATH_END_M: f64 = 5e-3;

/// A pen with a ball tip, held in a hand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tool {
    /// Radius of the ball.
    pub tip_radius_m: f64,
    /// Plane-strain elastic modulus of the ball.
    pub tip_modulus_pa: f64,
    /// Stiffness of the pen between ball and sensor.
    pub body_stiffness_n_per_m: f64,
    /// Mass of the pen.
    pub mass_kg: f64,
    /// Effective mass of pen and fingers in a landing.
    pub landing_mass_kg: f64,
    /// Stiffness of the hand's grip.
    pub hand_stiffness_n_per_m: f64,
    /// Damping of the hand's grip.
    pub hand_damping_n_s_per_m: f64,
    /// Resonance frequency of lateral pen motion in the grip.
    pub lateral_resonance_hz: f64,
    /// Damping ratio of the lateral resonance.
    pub lateral_damping_ratio: f64,
}

/// A 40 g pen with a plastic ball tip of 3 mm diameter in a writing grip.
pub const PEN: Tool = Tool {
    tip_radius_m: 1.5e-3,
    tip_modulus_pa: 3.3e9,
    body_stiffness_n_per_m: 1e5,
    mass_kg: 0.040,
    landing_mass_kg: 0.020,
    hand_stiffness_n_per_m: 400.0,
    hand_damping_n_s_per_m: 8.0,
    lateral_resonance_hz: 110.0,
    lateral_damping_ratio: 0.5,
};

/// Angle of a stroke across the lay of a surface, along x of its tile.
pub const ACROSS: Radians = Radians(0.0);

/// Angle of a stroke along the lay of a surface, along y of its tile.
pub const ALONG: Radians = Radians(FRAC_PI_2);

/// A material prepared for strokes at one angle: everything that does not depend on force or speed.
#[derive(Clone, Debug)]
pub struct Surface {
    material: Material,
    tool: Tool,
    /// Height of the ball's lowest point along the path.
    tip_heights_m: Vec<f64>,
    /// Friction process of unit variance along the path.
    friction: Vec<f64>,
}

/// A [`Surface`] at one normal force.
#[derive(Clone, Debug)]
pub struct PressedSurface {
    path: Path,
    springs: Springs,
    force_n: f64,
}

/// Reasons why a stroke cannot be simulated.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StrokeError {
    /// Speed, force or duration is not finite and above zero.
    #[error("{quantity} is {value}; it must be finite and above 0")]
    NotPositive {
        /// Name of the quantity, with its unit.
        quantity: &'static str,
        /// Given value.
        value: f64,
    },
    /// The stroke is longer than the prepared path.
    #[error(
        "the stroke needs {needed_m} m of surface, the path has {available_m} m; shorten or slow the stroke"
    )]
    PathTooShort {
        /// Length that the stroke and its margins cover.
        needed_m: f64,
        /// Usable length of the path.
        available_m: f64,
    },
}

/// Returns the surface of a material under a tool: a path of `path_m` over the material's tile at an angle ([`profile`]).
///
/// `field` must be the tile of the same material. The heights come from the tile; uneven friction follows the marks of the
/// surface, so that its correlation length grows along the lay as that of the heights. Takes some tens of milliseconds for
/// [`STARTER_PATH_M`].
pub fn prepare(
    material: &Material,
    field: &HeightField,
    tool: &Tool,
    path_m: f64,
    angle: Radians,
    seed: u64,
) -> Surface {
    let seed = derive_seed(seed, &material.id);
    let n_points = (path_m / PROFILE_STEP_M).round().max(0.0) as usize;
    let heights_m = profile(field, n_points, angle, derive_seed(seed, "detail"));
    let longer = elongation(material.stretch, angle);
    Surface {
        material: material.clone(),
        tool: *tool,
        tip_heights_m: dilate(&heights_m, PROFILE_STEP_M, tool.tip_radius_m),
        friction: tip::friction_process(n_points, PROFILE_STEP_M, longer, derive_seed(seed, "friction")),
    }
}

/// Returns the height of the ball's lowest point at each point of a periodic tile of `n_cells` × `n_cells` heights, row by
/// row, spaced by `spacing_m`.
///
/// The ball touches first along x, then along y, which is exact for a paraboloid with its radius.
pub fn tip_heights_m(heights_m: &[f64], n_cells: usize, spacing_m: f64, tool: &Tool) -> Vec<f64> {
    dilate_tile(heights_m, n_cells, spacing_m, tool.tip_radius_m)
}

/// Returns the surface as the tip meets it at this force; it serves any number of strokes.
///
/// # Errors
/// [`StrokeError::NotPositive`] if the force is not finite and above zero.
pub fn press(surface: &Surface, force: Newtons) -> Result<PressedSurface, StrokeError> {
    let force_n = force.0;
    require_positive("force in N", force_n)?;
    let Surface { material, tool, tip_heights_m, friction } = surface;
    let patch_m = material.patch_share * patch_radius_m(material, tool, force);
    let transmitted = (force_n / REFERENCE_CONTACT.force.0).powf(material.load_exponent);
    let heights_m = patch_low_pass(tip_heights_m, PROFILE_STEP_M, patch_m)
        .into_iter()
        .map(|height| transmitted * height)
        .collect();
    let mu = material.friction_coefficient;
    let drag_n = patch_low_pass(friction, PROFILE_STEP_M, patch_m)
        .into_iter()
        .map(|friction| mu * force_n * material.friction_heterogeneity * friction)
        .collect();
    let stiffness = contact_stiffness_n_per_m(material, tool, force);
    let springs = Springs {
        contact_n_per_m: stiffness,
        damping_n_s_per_m: 2.0 * material.contact_damping_ratio * (stiffness * tool.mass_kg).sqrt(),
        friction_coefficient: mu,
        tool: *tool,
    };
    Ok(PressedSurface { path: Path { heights_m, drag_n, step_m: PROFILE_STEP_M }, springs, force_n })
}

/// Returns the acceleration of a stroke over a pressed surface, in m/s² at [`STROKE_RATE`].
///
/// `seed` selects the start position.
///
/// # Errors
/// [`StrokeError::NotPositive`] for a bad speed or duration, [`StrokeError::PathTooShort`] for too long a stroke.
pub fn drag(
    pressed: &PressedSurface,
    speed: MetersPerSecond,
    duration_secs: f64,
    seed: u64,
) -> Result<Vec<f64>, StrokeError> {
    let run = run_over(&pressed.path, speed, duration_secs, seed)?;
    let [normal, lateral] =
        dynamics::accelerations_mps2(&pressed.path, &pressed.springs, pressed.force_n, &run);
    let combined = dft321(&[&normal, &lateral]);
    assert!(combined.is_ok(), "both axes must have {} samples", run.n_steps);
    Ok(recorded(&combined.unwrap_or_default(), duration_secs))
}

/// Returns a stroke with its margins over a path, from a random position.
fn run_over(path: &Path, speed: MetersPerSecond, duration_secs: f64, seed: u64) -> Result<Run, StrokeError> {
    let speed_mps = speed.0;
    require_positive("speed in m/s", speed_mps)?;
    require_positive("duration in s", duration_secs)?;
    let needed_m = (duration_secs + 2.0 * MARGIN_SECS) * speed_mps;
    let available_m = path.length_m() - 2.0 * PATH_END_M;
    if needed_m > available_m {
        return Err(StrokeError::PathTooShort { needed_m, available_m: available_m.max(0.0) });
    }
    let n_samples = n_output_samples(duration_secs) + 2 * n_output_samples(MARGIN_SECS);
    let start_m = PATH_END_M + Random::new(seed).uniform() * (available_m - needed_m);
    let rate_hz = STROKE_RATE.0 * OVERSAMPLING as f64;
    Ok(Run { start_m, speed_mps, rate_hz, n_steps: n_samples * OVERSAMPLING })
}

/// Returns the signal of a [`run_over`] a path at [`STROKE_RATE`], high-passed and without its margins.
fn recorded(signal: &[f64], duration_secs: f64) -> Vec<f64> {
    let mut signal = decimate(signal, OVERSAMPLING);
    filter_zero_phase(&butterworth_high_pass(2, STROKE_HIGH_PASS, STROKE_RATE), &mut signal);
    let n_margin = n_output_samples(MARGIN_SECS);
    signal[n_margin..n_margin + n_output_samples(duration_secs)].to_vec()
}

fn n_output_samples(duration_secs: f64) -> usize {
    (duration_secs * STROKE_RATE.0).round() as usize
}

/// Returns the acceleration of one stroke at this speed and mean force, in m/s² at [`STROKE_RATE`].
///
/// Calls [`press`], then [`drag`].
///
/// # Errors
/// Those of [`press`] and [`drag`].
pub fn simulate(
    surface: &Surface,
    contact: Contact,
    duration_secs: f64,
    seed: u64,
) -> Result<Vec<f64>, StrokeError> {
    drag(&press(surface, contact.force)?, contact.speed, duration_secs, seed)
}

/// Returns the roughness label: log₁₀ of the RMS acceleration in m/s² over one second at [`REFERENCE_CONTACT`].
///
/// A physical label from the simulation, not a human rating.
///
/// # Errors
/// Those of [`simulate`].
pub fn roughness(surface: &Surface, seed: u64) -> Result<f64, StrokeError> {
    let signal = simulate(surface, REFERENCE_CONTACT, 1.0, seed)?;

    Ok(rms(&signal).log10())
}

/// Returns the hardness label: log₁₀ of the Hertz contact stiffness in N/m at the force of [`REFERENCE_CONTACT`].
///
/// A physical label from the contact model, not a human rating.
pub fn hardness(material: &Material, tool: &Tool) -> f64 {
    hertz_stiffness_n_per_m(material, tool, REFERENCE_CONTACT.force).log10()
}

/// Effective modulus E* of ball and surface in series: `1/E* = 1/E + 1/E_tip`.
fn effective_modulus_pa(material: &Material, tool: &Tool) -> f64 {
    1.0 / (1.0 / material.youngs_modulus_pa + 1.0 / tool.tip_modulus_pa)
}

/// Returns the Hertz contact patch radius: `a = (¾ F R / E*)^⅓`.
pub fn patch_radius_m(material: &Material, tool: &Tool, force: Newtons) -> f64 {
    (0.75 * force.0 * tool.tip_radius_m / effective_modulus_pa(material, tool)).cbrt()
}

/// Hertz contact stiffness at the mean force: `k = 3/2 (4/3 E* √R)^⅔ F^⅓`.
fn hertz_stiffness_n_per_m(material: &Material, tool: &Tool, force: Newtons) -> f64 {
    let load_factor = 4.0 / 3.0 * effective_modulus_pa(material, tool) * tool.tip_radius_m.sqrt();
    1.5 * load_factor.cbrt().powi(2) * force.0.cbrt()
}

/// Stiffness between surface and sensor: Hertz contact, asperities `F / (½ h_rms)` and pen body in series.
fn contact_stiffness_n_per_m(material: &Material, tool: &Tool, force: Newtons) -> f64 {
    let asperity_compliance = 0.5 * material.height_rms_m / force.0;
    let hertz_compliance = 1.0 / hertz_stiffness_n_per_m(material, tool, force);
    1.0 / (hertz_compliance + asperity_compliance + 1.0 / tool.body_stiffness_n_per_m)
}

fn require_positive(quantity: &'static str, value: f64) -> Result<(), StrokeError> {
    if value > 0.0 && value.is_finite() { Ok(()) } else { Err(StrokeError::NotPositive { quantity, value }) }
}

#[cfg(test)]
mod tests;
