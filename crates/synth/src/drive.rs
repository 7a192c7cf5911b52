//! Output stage from texture acceleration to actuator drive: equalizer, thermal limiter, look-ahead limiter, limiter, and
//! the gate that silences it after lift-off.

use crate::budget::{Budget, Heat};
use crate::equalizer::{Biquad, Equalizer, Resonance};
use crate::lift_gate::{LiftGate, Touching};
use crate::limiter::Limiter;
use crate::look_ahead::{LookAhead, MAX_LOOK_AHEAD};

/// Parameters of the equalizer that inverts an actuator's response.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inverse {
    /// Frequency response of the actuator.
    pub resonance: Resonance,
    /// Lowest frequency that is fully reproduced, in Hz: see [`Biquad::bounded_inverse`].
    pub lowest_hz: f64,
}

/// Conversion of acceleration to drive, independent of the device's sample rate. Drive is dimensionless: 1 is the
/// device's full scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DriveConfig {
    /// Inverse of the actuator's response; with `None`, drive is proportional to acceleration.
    pub inverse: Option<Inverse>,
    /// Value of full scale: actuator voltage in V with an inverse, acceleration in m/s² without one.
    pub full_scale: f32,
    /// Highest output magnitude as a fraction of full scale, 0..1.
    pub ceiling: f32,
    /// Look-ahead of the limiter in seconds, 0 to [`MAX_LOOK_AHEAD_SECS`]; it delays the output by the same time.
    pub look_ahead_secs: f32,
    /// Thermal limit of the coil; its RMS is a fraction of full scale.
    pub budget: Option<Budget>,
}

/// Longest look-ahead, in seconds.
pub const MAX_LOOK_AHEAD_SECS: f32 = 0.002;
/// Knee of the limiter as a fraction of its ceiling; the limiter is linear below it.
pub const KNEE_SHARE: f32 = 0.8;
/// Knee of the limiter that follows the look-ahead limiter, which leaves it only rounding errors.
const LAST_KNEE_SHARE: f32 = 0.999;
/// Samples between two updates of the thermal gain.
const HEAT_BLOCK: usize = 32;

impl DriveConfig {
    /// Drive proportional to acceleration, for an actuator with unknown response.
    pub const fn proportional(full_scale_mps2: f32, ceiling: f32) -> Self {
        Self { inverse: None, full_scale: full_scale_mps2, ceiling, look_ahead_secs: 0.0, budget: None }
    }

    /// Acceleration at full scale in m/s²; with an inverse, far above the resonance.
    pub fn full_scale_mps2(&self) -> f32 {
        self.inverse
            .map_or(self.full_scale, |inverse| self.full_scale * inverse.resonance.gain_mps2_per_volt as f32)
    }

    /// Acceleration in m/s² up to which the limiter is linear; with an inverse, far above the resonance.
    pub fn linear_mps2(&self) -> f32 {
        KNEE_SHARE * self.ceiling * self.full_scale_mps2()
    }
}

/// Kind of samples that enter the output stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Driven {
    /// Acceleration in m/s²: equalized, then limited.
    Acceleration,
    /// Drive, 1 at full scale: only limited.
    Drive,
}

/// Output stage from texture to actuator.
#[derive(Clone, Debug)]
pub struct DriveChain {
    equalizer: Option<Equalizer>,
    per_unit: f32,
    heat: Option<Heat>,
    heat_gain: f32,
    look_ahead: Option<LookAhead>,
    limiter: Limiter,
    gate: LiftGate,
    rate_hz: f32,
}

impl DriveChain {
    /// An output stage with zero state, at the device's sample rate in Hz.
    ///
    /// An inverse whose resonance is not below half the sample rate is ignored.
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
            gate: LiftGate::new(rate_hz),
            rate_hz,
        }
    }

    /// Converts samples to drive, in place. For samples that are drive already, adds the decaying response of the
    /// equalizer to the acceleration before. Cost: that of two second-order filters per sample.
    ///
    /// `touching` is the contact of the tip, in frames of this stage. Without contact, the output fades to silence within
    /// [`crate::lift_gate::SILENT_AFTER_SECS`].
    pub fn process(&mut self, block: &mut [f32], driven: Driven, touching: Touching) {
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
        self.gate.process(block, touching);
        if let Some(equalizer) = self.equalizer.as_mut().filter(|_| self.gate.is_closed()) {
            equalizer.reset();
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

    /// Delay of the drive in seconds.
    pub fn latency_secs(&self) -> f32 {
        self.look_ahead.as_ref().map_or(0, LookAhead::delay) as f32 / self.rate_hz
    }

    /// Whether the output is silent because the tip was lifted some time ago.
    pub fn is_silenced(&self) -> bool {
        self.gate.is_closed()
    }

    /// Whether a non-finite sample has latched silence.
    pub fn is_tripped(&self) -> bool {
        self.limiter.is_tripped()
    }

    /// Ends the latched silence and clears the equalizer and look-ahead; the thermal estimate is kept.
    pub fn reset(&mut self) {
        self.limiter.reset();
        self.gate.reset();
        if let Some(equalizer) = &mut self.equalizer {
            equalizer.reset();
        }
        if let Some(look_ahead) = &mut self.look_ahead {
            look_ahead.reset();
        }
    }

    /// Number of samples that the limiters have attenuated since the start.
    pub fn limited_samples(&self) -> u64 {
        self.limiter.limited_samples() + self.look_ahead.as_ref().map_or(0, LookAhead::limited_samples)
    }

    /// Running RMS as a fraction of the coil's thermal limit; 0 without a limit.
    pub fn heat_used(&self) -> f32 {
        self.heat.as_ref().map_or(0.0, Heat::used)
    }

    /// Current gain of the thermal limiter, 0..1.
    pub fn heat_gain(&self) -> f32 {
        self.heat_gain
    }
}

#[cfg(test)]
mod tests;
