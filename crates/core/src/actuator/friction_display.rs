//! Display that renders friction, beside a voice coil.

use std::ops::RangeInclusive;

use crate::units::Hertz;

/// Surface that renders friction, such as an electrostatic or ultrasonic one, driven by a channel of its own: a sine
/// whose amplitude is the level of friction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrictionDisplay {
    /// Frequency of the sine, in [`FRICTION_CARRIERS_HZ`]: 20 to 200 Hz for an electrostatic surface, its resonance for an
    /// ultrasonic one.
    pub carrier: Hertz,
    /// Channel of the output, counted from 1, in [`FRICTION_CHANNELS`].
    pub channel: u16,
}

/// Valid carriers of a display that renders friction, in Hz.
pub const FRICTION_CARRIERS_HZ: RangeInclusive<f64> = 20.0..=80_000.0;

/// Valid channels of a display that renders friction, counted from 1.
pub const FRICTION_CHANNELS: RangeInclusive<u16> = 1..=64;
