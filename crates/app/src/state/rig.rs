//! Device setup: settings of output, actuator and pen. They are stored for this computer, not in the project, so undo
//! does not change them.

use anyhow::bail;
use shagreen_core::actuator::{Actuator, ActuatorError, Drive, drive_config};
use shagreen_core::units::{Kilograms, Volts};
use shagreen_device::engine::{ChannelMask, FrictionConfig};
use shagreen_device::hid::choice::AUTOMATIC_ID;
use shagreen_device::output::{UNCALIBRATED_FULL_SCALE_MPS2, USUAL_BUFFER_FRAMES, USUAL_CEILING};
use shagreen_device::pressure::PressureMap;
use shagreen_device::synth::drive::DriveConfig;
use shagreen_formats::rig_settings::ActuatorSettings;
use shagreen_studio::driven_channels::driven_channels;

use crate::strings::rig as strings;

/// Selectable buffer sizes, in frames.
pub const BUFFERS: [u32; 6] = [32, 64, 128, 256, 512, 1024];
/// Range of the acceleration at full scale, in m/s².
pub const FULL_SCALES_MPS2: std::ops::RangeInclusive<f64> = 0.1..=1000.0;
/// Range of the voltage at full scale, in V.
pub const FULL_SCALES_VOLTS: std::ops::RangeInclusive<f64> = 0.01..=100.0;
/// Range of width and height of a pen's active area, in mm.
pub const SIDES_MM: std::ops::RangeInclusive<f64> = 10.0..=2000.0;

/// Actuator with its load.
#[derive(Clone, Debug, PartialEq)]
pub struct Mounted {
    profile: Actuator,
    on_load: Actuator,
}

impl Mounted {
    /// Actuator with this load; with `None`, with the load of its profile.
    ///
    /// # Errors
    /// Those of [`Actuator::at_load`].
    pub fn new(profile: Actuator, load: Option<Kilograms>) -> Result<Self, ActuatorError> {
        let on_load = load.map_or_else(|| Ok(profile.clone()), |load| profile.at_load(load))?;
        Ok(Self { profile, on_load })
    }

    /// Actuator with the load of its profile.
    pub fn profile(&self) -> &Actuator {
        &self.profile
    }

    /// Actuator with its actual load.
    pub fn actuator(&self) -> &Actuator {
        &self.on_load
    }

    /// Mass of the load, if known.
    pub fn load(&self) -> Option<Kilograms> {
        self.on_load.measured?.load
    }
}

/// Stored actuator that is unavailable.
#[derive(Clone, Debug, PartialEq)]
pub struct MissingActuator {
    /// Its profile and load, as stored.
    pub actuator: ActuatorSettings,
    /// Voltage at the actuator at full scale of the output, in V.
    pub full_scale_volts: Option<f64>,
    /// Reason why it is unavailable.
    pub reason: String,
}

/// Device setup: settings of output, actuator and pen. The output itself is selected separately.
#[derive(Clone, Debug, PartialEq)]
pub struct Rig {
    /// Buffer size of the output, in frames.
    pub buffer_frames: u32,
    /// The only driven channel, counted from zero; `None` drives the first two.
    pub channel: Option<usize>,
    /// The actuator with its load. `None` is an unknown actuator, whose drive signal is proportional to acceleration.
    pub mounted: Option<Mounted>,
    /// Stored actuator that is unavailable. While there is one, the limits of the connected actuator are unknown, so no
    /// output opens until the user selects an actuator or [`UNCALIBRATED`](crate::strings::devices::UNCALIBRATED).
    pub missing: Option<MissingActuator>,
    /// Whether the actuator's response is equalized.
    pub equalizes: bool,
    /// Voltage at the actuator at full scale of the output, in V.
    pub full_scale_volts: f64,
    /// Acceleration at full scale of the output in m/s², used for an actuator with an unknown response.
    pub full_scale_mps2: f64,
    /// Id of the pen that is read, or [`AUTOMATIC_ID`] for the one that provides most. `None` reads none: mouse and window
    /// stroke.
    pub pen: Option<String>,
    /// Conversion from pressure to force, for pens that do not report force.
    pub pressure_map: PressureMap,
    /// Width and height of the pen's active area in mm, for pens that do not report it.
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
            pen: Some(AUTOMATIC_ID.to_owned()),
            pressure_map: PressureMap::USUAL,
            pen_size_mm: None,
        }
    }
}

impl Rig {
    /// Conversion from acceleration to the drive signal.
    ///
    /// # Errors
    /// The actuator's parameters are inconsistent, or the actuator is unavailable.
    pub fn drive(&self) -> anyhow::Result<DriveConfig> {
        if let Some(missing) = &self.missing {
            bail!(strings::no_actuator(&missing.reason));
        }
        match self.actuator().filter(|actuator| !actuator.is_proportional()) {
            None => Ok(DriveConfig::proportional(self.full_scale_mps2 as f32, USUAL_CEILING)),
            Some(actuator) => {
                Ok(drive_config(actuator, Drive::new(Volts(self.full_scale_volts))?, self.equalizes)?)
            }
        }
    }

    /// The actuator with its actual load, if selected.
    pub fn actuator(&self) -> Option<&Actuator> {
        self.mounted.as_ref().map(Mounted::actuator)
    }

    /// Driven channels on an output, and the channel of the actuator's friction display; see [`driven_channels`].
    pub fn channels(&self, is_serial: bool) -> (ChannelMask, Option<FrictionConfig>) {
        driven_channels(self.actuator(), self.channel, is_serial)
    }

    /// Whether an output that was opened with the settings `other` must be reopened to apply these settings.
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
    use super::{ChannelMask, FrictionConfig, Mounted, Rig};
    use shagreen_core::actuator::FrictionDisplay;
    use shagreen_core::units::Hertz;
    use shagreen_device::engine::FrictionWave;
    use shagreen_formats::actuator_toml::built_in_actuators;

    #[test]
    fn a_friction_display_has_its_own_channel() {
        let mut profile = built_in_actuators().unwrap().remove(0);
        profile.friction = Some(FrictionDisplay { carrier: Hertz(120.0), channel: 2 });
        let mounted = Some(Mounted::new(profile, None).unwrap());
        let rig = Rig { mounted, ..Rig::default() };
        let wave = FrictionWave::Carrier { frequency_hz: 120.0 };
        let friction = Some(FrictionConfig { channel_idx: 1, wave });
        assert_eq!(rig.channels(false), (ChannelMask::only(0), friction));
        assert_eq!(rig.channels(true), (ChannelMask::FIRST_TWO, None));
        assert!(rig.opens_unlike(&Rig::default()));
        assert_eq!(Rig::default().channels(false), (ChannelMask::FIRST_TWO, None));
    }

    #[test]
    fn a_controller_is_driven_in_proportion_until_it_is_calibrated() {
        let profile = built_in_actuators().unwrap().into_iter().find(|actuator| actuator.id == "dualsense");
        let mounted = Some(Mounted::new(profile.unwrap(), None).unwrap());
        let rig = Rig { mounted, full_scale_mps2: 7.0, ..Rig::default() };
        let drive = rig.drive().unwrap();
        assert_eq!((drive.full_scale, drive.inverse), (7.0, None));
        assert_eq!(rig.channels(false).0, ChannelMask::only(2).and(ChannelMask::only(3)));
    }

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
