//! Relief layer of a texture: acceleration as a function of position, instead of noise that depends on speed and force.
//!
//! A relief is an acceleration profile that is read at the tip position. Its frequencies scale with tip speed, it plays
//! in both directions, and a resting tip produces no signal. Beyond its ends it is mirrored, so that it has no jumps.

mod octaves;
#[cfg(test)]
mod tests;

use std::ops::RangeInclusive;

use crate::dsp::filter::resample;
use crate::dsp::spectrum::rms;
use crate::maths::statistics::{centered, is_constant};
use crate::texture::limits::FORCES_N;
use crate::texture::profile::{Profile, ProfileError};
use crate::units::{Hertz, MetersPerSecond, Newtons};

pub use crate::texture::relief::octaves::ReliefOctaves;

/// Maximum number of values of a relief: 65 cm at steps of 10 µm.
pub const MAX_VALUES: usize = 1 << 16;
/// Valid steps of a relief, in m.
pub const STEPS_M: RangeInclusive<f64> = 1e-7..=1e-2;
/// Largest magnitude of acceleration in a relief, in m/s².
pub const MAX_MPS2: f64 = 1e6;
/// Sample rate to which faster recordings are downsampled. Content above half of this rate cannot be felt, and at a
/// higher rate a short recording would already exceed [`MAX_VALUES`].
const HIGHEST_RATE: Hertz = Hertz(4000.0);
/// Parents whose weight has a smaller magnitude do not contribute to a blend.
const LEAST_WEIGHT: f64 = 1e-3;

/// Acceleration profile in m/s², and the normal force to which it applies; at other forces, the acceleration is
/// proportional to force.
#[derive(Clone, Debug, PartialEq)]
pub struct Relief {
    profile: Profile,
    force: Newtons,
}

/// Error of creating a relief from a profile.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ReliefError {
    /// The profile has too many values.
    #[error("a relief has up to {MAX_VALUES} values, got {n}; use longer steps, or shorten the profile")]
    Long {
        /// Number of values.
        n: usize,
    },
    /// The profile is constant, so it cannot be scaled to a level.
    #[error("the profile is constant; a relief needs values that vary")]
    Flat,
    /// The level is out of range.
    #[error("the level of a relief must be above 0 and up to {MAX_MPS2} m/s², got {level_mps2}")]
    Level {
        /// Requested level, in m/s².
        level_mps2: f64,
    },
    /// The step is out of range.
    #[error("the step of a relief must be from 0.1 µm to 1 cm, got {step_m} m")]
    Step {
        /// Step in m.
        step_m: f64,
    },
    /// The magnitude of an acceleration exceeds [`MAX_MPS2`].
    #[error("value {index} of the relief is {value} m/s²; its magnitude may be at most {MAX_MPS2} m/s²")]
    Value {
        /// Index of the value, from zero.
        index: usize,
        /// Acceleration in m/s².
        value: f64,
    },
    /// The force is out of range.
    #[error("the force of a relief must be from {} to {} N, got {force_n}", FORCES_N.start(), FORCES_N.end())]
    Force {
        /// Force in N.
        force_n: f64,
    },
}

/// Profile of an acceleration recording in m/s², stroked at a constant speed.
///
/// Recordings with a high sample rate are downsampled, which removes only frequencies that cannot be felt.
///
/// # Errors
/// See [`ProfileError`].
pub fn felt_profile(
    samples_mps2: &[f64],
    rate: Hertz,
    speed: MetersPerSecond,
) -> Result<Profile, ProfileError> {
    let is_fast = rate.0 > HIGHEST_RATE.0 && samples_mps2.iter().all(|x| x.is_finite());
    let (values, rate) = if is_fast {
        (resample(samples_mps2, rate, HIGHEST_RATE), HIGHEST_RATE)
    } else {
        (samples_mps2.to_vec(), rate)
    };
    Profile::new(speed.0 / rate.0, values)
}

impl Relief {
    /// Creates a relief from an acceleration profile in m/s² and the normal force to which it applies.
    ///
    /// # Errors
    /// See [`ReliefError`].
    pub fn new(profile: Profile, force: Newtons) -> Result<Self, ReliefError> {
        let n = profile.values().len();
        if n > MAX_VALUES {
            return Err(ReliefError::Long { n });
        }
        if !STEPS_M.contains(&profile.step_m()) {
            return Err(ReliefError::Step { step_m: profile.step_m() });
        }
        if !FORCES_N.contains(&force.0) {
            return Err(ReliefError::Force { force_n: force.0 });
        }
        // Profiles contain finite numbers only.
        match profile.values().iter().position(|value| value.abs() > MAX_MPS2) {
            Some(index) => Err(ReliefError::Value { index, value: profile.values()[index] }),
            None => Ok(Self { profile, force }),
        }
    }

    /// Creates a relief from heights, brightness or friction in any unit. The mean is removed, and the profile is
    /// scaled to the root mean square acceleration `level_mps2` at `force`.
    ///
    /// # Errors
    /// See [`ReliefError`].
    pub fn of_level(profile: &Profile, level_mps2: f64, force: Newtons) -> Result<Self, ReliefError> {
        if !(level_mps2 > 0.0 && level_mps2 <= MAX_MPS2) {
            return Err(ReliefError::Level { level_mps2 });
        }
        let values = centered(profile.values());
        let scale = level_mps2 / rms(&values);
        if is_constant(profile.values()) || !scale.is_finite() {
            return Err(ReliefError::Flat);
        }
        match Profile::new(profile.step_m(), values.into_iter().map(|x| scale * x).collect()) {
            Ok(profile) => Self::new(profile, force),
            Err(_) => Err(ReliefError::Flat),
        }
    }

    /// Acceleration in m/s² over position.
    pub fn profile(&self) -> &Profile {
        &self.profile
    }

    /// Force at which the relief has the accelerations of its profile.
    pub fn force(&self) -> Newtons {
        self.force
    }

    /// Acceleration in m/s² at a position in m and at the relief's own force. Interpolated linearly between values and
    /// mirrored beyond the ends.
    pub fn at(&self, place_m: f64) -> f64 {
        let values = self.profile.values();
        let n = values.len();
        let place = place_m / self.profile.step_m();
        let whole = place.floor();
        let value = |i: f64| {
            let turned = i.rem_euclid(2.0 * n as f64) as usize;
            values[if turned < n { turned } else { (2 * n).saturating_sub(1 + turned) }]
        };
        let (a, b) = (value(whole), value(whole + 1.0));
        a + (place - whole) * (b - a)
    }

    /// Weighted sum of reliefs, with the smallest step and the largest length among them, and at most [`MAX_VALUES`]
    /// values.
    ///
    /// Features keep their position within this length, and the sum is mirrored beyond it. Parents without a relief
    /// reduce the level by their weight. `None` if no parent has a relief.
    pub fn blended(parents: &[(Option<&Self>, f64)]) -> Option<Self> {
        let known = parents.iter().filter(|(_, weight)| weight.abs() > LEAST_WEIGHT);
        let known: Vec<(&Self, f64)> =
            known.filter_map(|(relief, weight)| Some(((*relief)?, *weight))).collect();
        if let [(only, weight)] = known.as_slice()
            && (weight - 1.0).abs() < LEAST_WEIGHT
        {
            return Some((*only).clone());
        }
        // Weights of a field can be negative; forces cannot.
        let total: f64 = known.iter().map(|(_, weight)| weight.abs()).sum();
        let mean = known.iter().map(|(relief, weight)| weight.abs() / total * relief.force.0).sum::<f64>();
        // The mean can leave the valid range by a rounding error.
        let force_n = mean.clamp(*FORCES_N.start(), *FORCES_N.end());
        let length_m = known.iter().map(|(relief, _)| relief.profile.length_m()).fold(0.0, f64::max);
        let step_m = known.iter().map(|(relief, _)| relief.profile.step_m()).fold(f64::INFINITY, f64::min);
        let n = ((length_m / step_m).round() as usize).clamp(2, MAX_VALUES);
        let value = |i: usize| {
            let part = |(relief, weight): &(&Self, f64)| {
                weight * force_n / relief.force.0 * relief.at(i as f64 * step_m)
            };
            known.iter().map(part).sum::<f64>().clamp(-MAX_MPS2, MAX_MPS2)
        };
        // Fails if no relief contributes, because the step is then infinite.
        let profile = Profile::new(step_m, (0..n).map(value).collect()).ok()?;
        Self::new(profile, Newtons(force_n)).ok()
    }
}
