//! What lies at each place of a surface, in place of noise that a speed and a force make: the relief layer of a texture.
//!
//! A relief is a profile of accelerations, played by where the tip is: its frequencies follow the speed, forwards and
//! backwards, and a tip that stands feels none. Beyond its end it comes back the way it went, so that nothing jumps there.

mod octaves;
#[cfg(test)]
mod tests;

use std::ops::RangeInclusive;

use crate::filter::resample;
use crate::profile::{Profile, ProfileError};
use crate::spectrum::rms;
use crate::statistics::{centered, is_constant};
use crate::texture::FORCES_N;
use crate::units::{Hertz, MetersPerSecond, Newtons};

pub use crate::relief::octaves::ReliefOctaves;

/// Most values of a relief: at steps of 10 µm, 65 cm.
pub const MAX_VALUES: usize = 1 << 16;
/// Steps that a relief may have, in m.
pub const STEPS_M: RangeInclusive<f64> = 1e-7..=1e-2;
/// Largest acceleration in a relief, in m/s².
pub const MAX_MPS2: f64 = 1e6;
/// Rate in Hz to which faster recordings are brought: nothing above half of it is felt, and more would fill a relief soon.
const HIGHEST_RATE: Hertz = Hertz(4000.0);
/// Parents of less weight, either way, have no say in a blend.
const LEAST_WEIGHT: f64 = 1e-3;

/// A profile in m/s², and the force at which it has its level: it grows in proportion to the force.
#[derive(Clone, Debug, PartialEq)]
pub struct Relief {
    profile: Profile,
    force: Newtons,
}

/// Why a profile is no relief.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ReliefError {
    /// Too many values.
    #[error("a relief has up to {MAX_VALUES} values, got {n}; make the steps longer, or cut it")]
    Long {
        /// How many there are.
        n: usize,
    },
    /// Nothing that could have a level.
    #[error("the profile is the same everywhere; there is nothing to feel in it")]
    Flat,
    /// A level that is none.
    #[error("the level of a relief must be above 0 and up to {MAX_MPS2} m/s², got {level_mps2}")]
    Level {
        /// The level in m/s².
        level_mps2: f64,
    },
    /// A step that no tip tells.
    #[error("the step of a relief must be from 0.1 µm to 1 cm, got {step_m} m")]
    Step {
        /// The step in m.
        step_m: f64,
    },
    /// An acceleration beyond all that moves a hand.
    #[error("value {index} of the relief is {value} m/s², up to {MAX_MPS2} is possible")]
    Value {
        /// Which, from zero.
        index: usize,
        /// What it is, in m/s².
        value: f64,
    },
    /// A force that is none.
    #[error("the force of a relief must be from {} to {} N, got {force_n}", FORCES_N.start(), FORCES_N.end())]
    Force {
        /// The force in N.
        force_n: f64,
    },
}

/// The profile of a recording in m/s² that was stroked at a speed, without what comes too fast to be felt.
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
    /// A relief of a profile in m/s² that has its level at a force.
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
        // Profiles hold finite numbers only.
        match profile.values().iter().position(|value| value.abs() > MAX_MPS2) {
            Some(index) => Err(ReliefError::Value { index, value: profile.values()[index] }),
            None => Ok(Self { profile, force }),
        }
    }

    /// A relief of heights, brightness or friction, whatever their unit: without their mean, and so large that the root mean
    /// square is `level_mps2` at a force.
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

    /// Accelerations in m/s² over places.
    pub fn profile(&self) -> &Profile {
        &self.profile
    }

    /// The force at which they are as the profile says.
    pub fn force(&self) -> Newtons {
        self.force
    }

    /// The acceleration in m/s² at a place in m, at the relief's own force: in a straight line between values, and back and
    /// forth beyond the ends.
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

    /// The sum of reliefs by weight, on the finest of their steps and as long as the longest, as far as [`MAX_VALUES`] reach:
    /// what lies at one place stays there up to this length, and from there all of it comes back. Parents without a relief
    /// take their share of the level. `None` where none has one.
    pub fn blended(parents: &[(Option<&Self>, f64)]) -> Option<Self> {
        let known = parents.iter().filter(|(_, weight)| weight.abs() > LEAST_WEIGHT);
        let known: Vec<(&Self, f64)> =
            known.filter_map(|(relief, weight)| Some(((*relief)?, *weight))).collect();
        if let [(only, weight)] = known.as_slice()
            && (weight - 1.0).abs() < LEAST_WEIGHT
        {
            return Some((*only).clone());
        }
        // Weights of a field may be below zero; forces may not.
        let total: f64 = known.iter().map(|(_, weight)| weight.abs()).sum();
        let mean = known.iter().map(|(relief, weight)| weight.abs() / total * relief.force.0).sum::<f64>();
        // A mean of forces is one, but for its last digit at the ends of their range.
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
        // None where nothing is known: then there is no step either.
        let profile = Profile::new(step_m, (0..n).map(value).collect()).ok()?;
        Self::new(profile, Newtons(force_n)).ok()
    }
}
