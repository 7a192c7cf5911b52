//! The rig: how the output is opened, which actuator hangs on it, and which pen is held. It belongs to the machine, not to
//! the project: undo does not touch it.

use anyhow::bail;
use shagreen_core::actuator::{Actuator, ActuatorError, Drive, drive_config};
use shagreen_core::units::{Kilograms, Volts};
use shagreen_device::engine::ChannelMask;
use shagreen_device::output::{UNCALIBRATED_FULL_SCALE_MPS2, USUAL_BUFFER_FRAMES, USUAL_CEILING};
use shagreen_device::pressure::PressureMap;
use shagreen_device::synth::drive::DriveConfig;
use shagreen_formats::rig_settings::ActuatorSettings;

use crate::strings::rig as strings;

/// Sizes of buffers that can be chosen, in frames.
pub const BUFFERS: [u32; 6] = [32, 64, 128, 256, 512, 1024];
/// Range of the acceleration at full scale, in m/s².
pub const FULL_SCALES_MPS2: std::ops::RangeInclusive<f64> = 0.1..=1000.0;
/// Range of the voltage at full scale, in V.
pub const FULL_SCALES_VOLTS: std::ops::RangeInclusive<f64> = 0.01..=100.0;
/// Range of the sides of a pen's area, in mm.
pub const SIDES_MM: std::ops::RangeInclusive<f64> = 10.0..=2000.0;

/// An actuator on what it carries.
#[derive(Clone, Debug, PartialEq)]
pub struct Mounted {
    profile: Actuator,
    on_load: Actuator,
}

impl Mounted {
    /// An actuator on another load than its profile's where one is given.
    ///
    /// # Errors
    /// Those of [`Actuator::at_load`].
    pub fn new(profile: Actuator, load: Option<Kilograms>) -> Result<Self, ActuatorError> {
        let on_load = load.map_or_else(|| Ok(profile.clone()), |load| profile.at_load(load))?;
        Ok(Self { profile, on_load })
    }

    /// The actuator as its profile has it.
    pub fn profile(&self) -> &Actuator {
        &self.profile
    }

    /// The actuator on what it carries.
    pub fn actuator(&self) -> &Actuator {
        &self.on_load
    }

    /// What it carries, as far as that is known.
    pub fn load(&self) -> Option<Kilograms> {
        self.on_load.measured?.load
    }
}

/// An actuator of last time that cannot be had, as it is remembered.
#[derive(Clone, Debug, PartialEq)]
pub struct MissingActuator {
    /// Its profile and what it carries.
    pub actuator: ActuatorSettings,
    /// Volts at it when the output is at full scale.
    pub full_scale_volts: Option<f64>,
    /// Why it cannot be had.
    pub reason: String,
}

/// What stands around the program.
#[derive(Clone, Debug, PartialEq)]
pub struct Rig {
    /// Frames of the output's buffer.
    pub buffer_frames: u32,
    /// The only channel that is driven, counted from zero; without it the first two.
    pub channel: Option<usize>,
    /// The actuator, on what it carries; without it drive is in proportion to acceleration.
    pub mounted: Option<Mounted>,
    /// The one that cannot be had, until another is chosen, or none: what stands on the output has limits that nobody knows,
    /// so nothing is driven.
    pub missing: Option<MissingActuator>,
    /// Whether the actuator's response is undone.
    pub equalizes: bool,
    /// Volts at the actuator when the output is at full scale.
    pub full_scale_volts: f64,
    /// Acceleration at full scale in m/s², where no actuator is known.
    pub full_scale_mps2: f64,
    /// The pen that is read, by its id.
    pub pen: Option<String>,
    /// From pressure to force, for pens that tell no force.
    pub pressure_map: PressureMap,
    /// Width and height of the pen's area in mm, for pens that do not tell it.
    pub pen_size_mm: Option<[f64; 2]>,
}

impl Default for Rig {
    fn default() -> Self {
        Self {
            buffer_frames: USUAL_BUFFER_FRAMES,
            channel: None,
            mounted: None,
            missing: None,
            equalizes: true,
            full_scale_volts: 1.0,
            full_scale_mps2: f64::from(UNCALIBRATED_FULL_SCALE_MPS2),
            pen: None,
            pressure_map: PressureMap::USUAL,
            pen_size_mm: None,
        }
    }
}

impl Rig {
    /// How acceleration becomes drive.
    ///
    /// # Errors
    /// Says what of the actuator does not go together, or that it cannot be had.
    pub fn drive(&self) -> anyhow::Result<DriveConfig> {
        if let Some(missing) = &self.missing {
            bail!(strings::no_actuator(&missing.reason));
        }
        match self.actuator() {
            None => Ok(DriveConfig::proportional(self.full_scale_mps2 as f32, USUAL_CEILING)),
            Some(actuator) => {
                Ok(drive_config(actuator, Drive::new(Volts(self.full_scale_volts))?, self.equalizes)?)
            }
        }
    }

    /// The actuator, where it is known.
    pub fn actuator(&self) -> Option<&Actuator> {
        self.mounted.as_ref().map(Mounted::actuator)
    }

    /// The channels that are driven.
    pub fn channels(&self) -> ChannelMask {
        self.channel.map_or(ChannelMask::FIRST_TWO, ChannelMask::only)
    }

    /// Whether an output that was opened for `other` must be opened again.
    pub fn opens_unlike(&self, other: &Self) -> bool {
        let opening = |rig: &Self| {
            (
                rig.buffer_frames,
                rig.channel,
                rig.actuator().cloned(),
                rig.missing.clone(),
                rig.equalizes,
                rig.full_scale_volts,
                rig.full_scale_mps2,
            )
        };
        opening(self) != opening(other)
    }
}

#[cfg(test)]
mod tests {
    use super::Rig;

    #[test]
    fn only_what_the_output_depends_on_opens_it_again() {
        let rig = Rig::default();
        let other =
            Rig { pen: Some("hid:056a:0061".into()), pen_size_mm: Some([100.0, 80.0]), ..rig.clone() };
        assert!(!rig.opens_unlike(&other));
        assert!(rig.opens_unlike(&Rig { buffer_frames: 64, ..rig.clone() }));
        assert!(rig.opens_unlike(&Rig { channel: Some(1), ..rig.clone() }));
        assert!(rig.opens_unlike(&Rig { full_scale_mps2: 5.0, ..rig.clone() }));
    }
}
