//! From the acceleration of a texture to the drive of an actuator: equalizer, budget, look-ahead, and the limiter last.

use crate::budget::{Budget, Heat};
use crate::equalizer::{Biquad, Equalizer, Resonance};
use crate::limiter::Limiter;
use crate::look_ahead::{LookAhead, MAX_LOOK_AHEAD};

/// What undoes an actuator's response.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inverse {
    /// The response.
    pub resonance: Resonance,
    /// Lowest frequency that is reproduced in full, in Hz: see [`Biquad::bounded_inverse`].
    pub lowest_hz: f64,
}

/// How acceleration becomes drive, whatever the rate of the device. Drive has no unit: 1 is the device's full scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DriveConfig {
    /// What undoes the actuator's response; without it drive is in proportion to acceleration.
    pub inverse: Option<Inverse>,
    /// What full scale is: volts at the actuator with an inverse, m/s² without one.
    pub full_scale: f32,
    /// Share of the full scale that is never exceeded, 0..1.
    pub ceiling: f32,
    /// How far the limiter sees ahead, in seconds, 0 to [`MAX_LOOK_AHEAD_SECS`]; what it sees comes as much later.
    pub look_ahead_secs: f32,
    /// What the coil stands for long, as a share of the full scale.
    pub budget: Option<Budget>,
}

/// Longest look-ahead, in seconds.
pub const MAX_LOOK_AHEAD_SECS: f32 = 0.002;
/// The limiter is linear up to this share of its ceiling.
const KNEE_SHARE: f32 = 0.8;
/// The same for the limiter behind the look-ahead, which leaves it nothing but rounding.
const LAST_KNEE_SHARE: f32 = 0.999;
/// Samples between two looks at the coil's heat.
const HEAT_BLOCK: usize = 32;

impl DriveConfig {
    /// Drive in proportion to acceleration, for an actuator of which nothing is known.
    pub const fn proportional(full_scale_mps2: f32, ceiling: f32) -> Self {
        Self { inverse: None, full_scale: full_scale_mps2, ceiling, look_ahead_secs: 0.0, budget: None }
    }

    /// Acceleration at full scale in m/s², far above the resonance.
    pub fn full_scale_mps2(&self) -> f32 {
        self.inverse
            .map_or(self.full_scale, |inverse| self.full_scale * inverse.resonance.gain_mps2_per_volt as f32)
    }
}

/// What samples are before they are driven.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Driven {
    /// Acceleration in m/s², to be equalized.
    Acceleration,
    /// Drive, 1 at full scale: only kept within the limits.
    Drive,
}

/// All that stands between a texture and an actuator.
#[derive(Clone, Debug)]
pub struct DriveChain {
    equalizer: Option<Equalizer>,
    per_unit: f32,
    heat: Option<Heat>,
    heat_gain: f32,
    look_ahead: Option<LookAhead>,
    limiter: Limiter,
    rate_hz: f32,
}

impl DriveChain {
    /// A chain at rest, at the rate of a device in Hz.
    ///
    /// An inverse whose resonance is not below half the rate is left out.
    pub fn new(config: DriveConfig, rate_hz: f32) -> Self {
        let DriveConfig { inverse, full_scale, ceiling, look_ahead_secs, budget } = config;
        let delay = libm::roundf(look_ahead_secs.clamp(0.0, MAX_LOOK_AHEAD_SECS) * rate_hz) as usize;
        let look_ahead =
            (delay > 0).then(|| LookAhead::new(ceiling, KNEE_SHARE, delay.min(MAX_LOOK_AHEAD - 1), rate_hz));
        let knee_share = if look_ahead.is_some() { LAST_KNEE_SHARE } else { KNEE_SHARE };
        let is_possible = |inverse: &Inverse| 2.0 * inverse.resonance.frequency_hz < f64::from(rate_hz);
        Self {
            equalizer: inverse.filter(is_possible).map(|Inverse { resonance, lowest_hz }| {
                Equalizer::new(Biquad::bounded_inverse(resonance, lowest_hz, f64::from(rate_hz)))
            }),
            per_unit: full_scale.recip(),
            heat: budget.map(|budget| Heat::new(budget, rate_hz)),
            heat_gain: 1.0,
            look_ahead,
            limiter: Limiter::new(ceiling, knee_share),
            rate_hz,
        }
    }

    /// Turns samples into drive, in place; to drive that is played as it is, what the equalizer still rings with of the
    /// acceleration before is added. Cost: two filters' worth a sample.
    pub fn process(&mut self, block: &mut [f32], driven: Driven) {
        match driven {
            Driven::Acceleration => {
                if let Some(equalizer) = &mut self.equalizer {
                    equalizer.process(block);
                }
                for sample in block.iter_mut() {
                    *sample *= self.per_unit;
                }
            }
            Driven::Drive => {
                if let Some(equalizer) = &mut self.equalizer {
                    equalizer.ring_out(block, self.per_unit);
                }
            }
        }
        for part in block.chunks_mut(HEAT_BLOCK) {
            self.limit(part);
        }
    }

    fn limit(&mut self, part: &mut [f32]) {
        let target = self.heat.as_ref().map_or(1.0, Heat::gain);
        let step = (target - self.heat_gain) / part.len() as f32;
        for sample in part.iter_mut() {
            self.heat_gain += step;
            let cooled = *sample * self.heat_gain;
            let ahead = self.look_ahead.as_mut().map_or(cooled, |look_ahead| look_ahead.next(cooled));
            *sample = self.limiter.limit(ahead);
        }
        self.heat_gain = target;
        if let Some(heat) = &mut self.heat {
            heat.note(part);
        }
    }

    /// How much later than its cause the drive is, in seconds.
    pub fn latency_secs(&self) -> f32 {
        self.look_ahead.as_ref().map_or(0, LookAhead::delay) as f32 / self.rate_hz
    }

    /// Whether a sample that was not finite has latched silence.
    pub fn is_tripped(&self) -> bool {
        self.limiter.is_tripped()
    }

    /// Ends the latched silence and forgets what was; a coil stays as warm as it is.
    pub fn reset(&mut self) {
        self.limiter.reset();
        if let Some(equalizer) = &mut self.equalizer {
            equalizer.reset();
        }
        if let Some(look_ahead) = &mut self.look_ahead {
            look_ahead.reset();
        }
    }

    /// Samples that were turned down or bent since the start.
    pub fn limited_samples(&self) -> u64 {
        self.limiter.limited_samples() + self.look_ahead.as_ref().map_or(0, LookAhead::limited_samples)
    }

    /// Share of what the coil stands for long that is used, root mean square; 0 where nothing is known of it.
    pub fn heat_used(&self) -> f32 {
        self.heat.as_ref().map_or(0.0, Heat::used)
    }

    /// Gain by which the drive is turned down to keep the coil cool, 0..1.
    pub fn heat_gain(&self) -> f32 {
        self.heat_gain
    }
}

#[cfg(test)]
mod tests;
