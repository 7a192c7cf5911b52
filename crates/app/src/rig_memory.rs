//! What of the rig outlives the program.

use anyhow::{Context as _, anyhow};
use shagreen_core::units::Kilograms;
use shagreen_device::output::BUFFER_FRAMES;
use shagreen_device::pressure::PressureMap;
use shagreen_formats::actuator_toml::{built_in_actuators, read_actuator, write_actuator};
use shagreen_formats::rig_settings::{ActuatorSettings, PressureSettings, ProfileSettings, RigSettings};

use crate::rig::{Mounted, Rig};
use crate::strings::rig as strings;

/// Channels are told from one on, and a device has so many at most.
const CHANNELS: std::ops::RangeInclusive<usize> = 1..=64;
/// Range of the acceleration at full scale, in m/s².
const FULL_SCALES_MPS2: std::ops::RangeInclusive<f64> = 0.1..=1000.0;
/// Range of the voltage at full scale, in V.
const FULL_SCALES_VOLTS: std::ops::RangeInclusive<f64> = 0.01..=100.0;
/// Range of the sides of a pen's area, in mm.
const SIDES_MM: std::ops::RangeInclusive<f64> = 10.0..=2000.0;

/// The rig as it is remembered, in the place of `before`: the output stays, and what another version remembers.
pub(crate) fn remembered(rig: &Rig, before: Option<&RigSettings>) -> RigSettings {
    let PressureMap { activation_n, full_n, bend } = rig.pressure_map;
    RigSettings {
        output: before.and_then(|before| before.output.clone()),
        buffer_frames: Some(rig.buffer_frames),
        channel: rig.channel.map(|channel| channel + 1),
        actuator: rig.mounted.as_ref().map(remembered_actuator),
        equalizes: Some(rig.equalizes),
        full_scale_volts: Some(rig.full_scale_volts),
        full_scale_mps2: Some(rig.full_scale_mps2),
        pen: rig.pen.clone(),
        pressure: Some(PressureSettings { activation_n, full_n, bend }),
        pen_size_mm: rig.pen_size_mm,
        unknown: before.map(|before| before.unknown.clone()).unwrap_or_default(),
    }
}

fn remembered_actuator(mounted: &Mounted) -> ActuatorSettings {
    let profile = mounted.profile();
    // One of the program's own follows the program.
    let is_built_in = built_in_actuators().is_ok_and(|all| all.contains(profile));
    let has_other_load = mounted.actuator() != profile;
    ActuatorSettings {
        profile: if is_built_in {
            ProfileSettings::BuiltIn(profile.id.clone())
        } else {
            ProfileSettings::Own(String::from_utf8_lossy(&write_actuator(profile)).into_owned())
        },
        load_g: mounted.load().filter(|_| has_other_load).map(Kilograms::g),
    }
}

/// The rig that is remembered. Numbers that make no sense are as on a first start.
///
/// # Errors
/// The actuator cannot be had: what would be driven in its place has other limits, so nothing may be.
pub(crate) fn restored(settings: &RigSettings) -> anyhow::Result<Rig> {
    let usual = Rig::default();
    let mounted = settings.actuator.as_ref().map(restored_actuator).transpose()?;
    let buffer_frames = settings.buffer_frames.filter(|frames| BUFFER_FRAMES.contains(frames));
    let channel = settings.channel.filter(|channel| CHANNELS.contains(channel));
    let full_scale_volts = settings.full_scale_volts.filter(|volts| FULL_SCALES_VOLTS.contains(volts));
    let full_scale_mps2 = settings.full_scale_mps2.filter(|mps2| FULL_SCALES_MPS2.contains(mps2));
    Ok(Rig {
        buffer_frames: buffer_frames.unwrap_or(usual.buffer_frames),
        channel: channel.map(|channel| channel - 1),
        mounted,
        equalizes: settings.equalizes.unwrap_or(usual.equalizes),
        full_scale_volts: full_scale_volts.unwrap_or(usual.full_scale_volts),
        full_scale_mps2: full_scale_mps2.unwrap_or(usual.full_scale_mps2),
        pen: settings.pen.clone(),
        pressure_map: settings.pressure.and_then(restored_map).unwrap_or(usual.pressure_map),
        pen_size_mm: settings.pen_size_mm.filter(|size| size.iter().all(|side| SIDES_MM.contains(side))),
    })
}

fn restored_actuator(settings: &ActuatorSettings) -> anyhow::Result<Mounted> {
    let profile = match &settings.profile {
        ProfileSettings::BuiltIn(id) => {
            let mut all = built_in_actuators()?.into_iter();
            all.find(|actuator| actuator.id == *id).ok_or_else(|| anyhow!(strings::unknown_profile(id)))?
        }
        ProfileSettings::Own(text) => read_actuator(text.as_bytes())?,
    };
    let id = profile.id.clone();
    Mounted::new(profile, settings.load_g.map(Kilograms::from_g)).context(id)
}

fn restored_map(settings: PressureSettings) -> Option<PressureMap> {
    let PressureSettings { activation_n, full_n, bend } = settings;
    let is_sound = activation_n >= 0.0 && full_n > activation_n && full_n <= 100.0 && bend.abs() <= 20.0;
    is_sound.then_some(PressureMap { activation_n, full_n, bend })
}

#[cfg(test)]
mod tests {
    use super::{
        ActuatorSettings, Kilograms, Mounted, PressureMap, PressureSettings, ProfileSettings, Rig,
        RigSettings, built_in_actuators, remembered, restored,
    };
    use shagreen_core::actuator::Actuator;

    fn known() -> Actuator {
        let all = built_in_actuators().unwrap();
        all.into_iter().find(|actuator| actuator.name == "Haptuator Mark II-D").unwrap()
    }

    #[test]
    fn a_rig_comes_back() {
        let own = Actuator { name: "Mine".to_owned(), ..known() };
        let load = Some(Kilograms::from_g(77.0));
        for (mounted, is_built_in) in [
            (None, false),
            (Some(Mounted::new(known(), None).unwrap()), true),
            (Some(Mounted::new(known(), load).unwrap()), true),
            (Some(Mounted::new(own.clone(), load).unwrap()), false),
        ] {
            let rig = Rig {
                buffer_frames: 64,
                channel: Some(1),
                mounted,
                equalizes: false,
                full_scale_volts: 2.5,
                full_scale_mps2: 7.0,
                pen: Some("hid:056a:0061".to_owned()),
                pressure_map: PressureMap { activation_n: 0.1, full_n: 3.0, bend: 0.0 },
                pen_size_mm: Some([216.0, 135.0]),
            };
            let before = RigSettings { output: Some("null".to_owned()), ..RigSettings::default() };
            let settings = remembered(&rig, Some(&before));
            assert_eq!(settings.output.as_deref(), Some("null"), "the output stays");
            let profile = settings.actuator.as_ref().map(|actuator| &actuator.profile);
            assert_eq!(matches!(profile, Some(ProfileSettings::BuiltIn(_))), is_built_in);
            assert_eq!(restored(&settings).unwrap(), rig);
        }
    }

    #[test]
    fn nothing_remembered_and_nonsense_are_a_first_start() {
        assert_eq!(restored(&RigSettings::default()).unwrap(), Rig::default());
        let nonsense = RigSettings {
            buffer_frames: Some(0),
            channel: Some(0),
            full_scale_volts: Some(-1.0),
            full_scale_mps2: Some(1e-9),
            pressure: Some(PressureSettings { activation_n: 5.0, full_n: 1.0, bend: 0.0 }),
            pen_size_mm: Some([0.0, 100.0]),
            ..RigSettings::default()
        };
        assert_eq!(restored(&nonsense).unwrap(), Rig::default());
    }

    #[test]
    fn without_its_actuator_a_rig_is_none() {
        for (profile, words) in [
            (ProfileSettings::BuiltIn("gone".to_owned()), "gone"),
            (ProfileSettings::Own("my notes".to_owned()), "profile"),
        ] {
            let actuator = Some(ActuatorSettings { profile, load_g: None });
            let error = restored(&RigSettings { actuator, ..RigSettings::default() }).unwrap_err();
            assert!(format!("{error:#}").contains(words), "{error:#}");
        }
    }
}
