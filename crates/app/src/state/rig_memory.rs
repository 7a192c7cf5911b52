//! Stores and restores the device setup.

use anyhow::{Context as _, anyhow, ensure};
use shagreen_core::units::Kilograms;
use shagreen_device::output::BUFFER_FRAMES;
use shagreen_device::pressure::PressureMap;
use shagreen_formats::actuator_toml::{built_in_actuators, read_actuator, write_actuator};
use shagreen_formats::rig_settings::{ActuatorSettings, PressureSettings, ProfileSettings, RigSettings};

use crate::state::rig::{FULL_SCALES_MPS2, FULL_SCALES_VOLTS, MissingActuator, Mounted, Rig, SIDES_MM};
use crate::strings::rig as strings;

/// Valid channel numbers in the settings, which start at one. The maximum is the number of channels of a device.
const CHANNELS: std::ops::RangeInclusive<usize> = 1..=64;

/// Stored id for no pen: only mouse and window stroke. Settings without an id are a first start.
const WINDOW_ONLY: &str = "window";

/// Settings of `rig` for `output`; unknown settings are kept from `before`.
pub(crate) fn remembered(rig: &Rig, output: String, before: Option<&RigSettings>) -> RigSettings {
    let missing = rig.missing.as_ref();
    let actuator = rig.mounted.as_ref().map(remembered_actuator);
    RigSettings {
        output: Some(output),
        buffer_frames: Some(rig.buffer_frames),
        channel: rig.channel.map(|channel| channel + 1),
        actuator: actuator.or_else(|| missing.map(|missing| missing.actuator.clone())),
        equalizes: Some(rig.equalizes),
        full_scale_volts: missing.map_or(Some(rig.full_scale_volts), |missing| missing.full_scale_volts),
        full_scale_mps2: Some(rig.full_scale_mps2),
        ..with_pen_of(rig, before)
    }
}

/// `before` with the pen settings of `rig`, which do not depend on the output.
pub(crate) fn with_pen_of(rig: &Rig, before: Option<&RigSettings>) -> RigSettings {
    let PressureMap { activation_n, full_n, bend } = rig.pressure_map;
    RigSettings {
        pen: Some(rig.pen.clone().unwrap_or_else(|| WINDOW_ONLY.to_owned())),
        pressure: Some(PressureSettings { activation_n, full_n, bend }),
        pen_size_mm: rig.pen_size_mm,
        ..before.cloned().unwrap_or_default()
    }
}

fn remembered_actuator(mounted: &Mounted) -> ActuatorSettings {
    let profile = mounted.profile();
    // A built-in profile is stored by its id, so that an update of the program updates it.
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

/// Device setup from the settings. Invalid numbers fall back to defaults, except those that determine the actuator's
/// limits: then the actuator is unavailable.
pub(crate) fn restored(settings: &RigSettings) -> Rig {
    let usual = Rig::default();
    let (mut mounted, mut missing) = (None, None);
    if let Some(actuator) = &settings.actuator {
        match restored_actuator(actuator, settings.full_scale_volts) {
            Ok(restored) => mounted = Some(restored),
            Err(error) => {
                missing = Some(MissingActuator {
                    actuator: actuator.clone(),
                    full_scale_volts: settings.full_scale_volts,
                    reason: format!("{error:#}"),
                });
            }
        }
    }
    let buffer_frames = settings.buffer_frames.filter(|frames| BUFFER_FRAMES.contains(frames));
    let channel = settings.channel.filter(|channel| CHANNELS.contains(channel));
    let full_scale_volts = settings.full_scale_volts.filter(|volts| FULL_SCALES_VOLTS.contains(volts));
    let full_scale_mps2 = settings.full_scale_mps2.filter(|mps2| FULL_SCALES_MPS2.contains(mps2));
    Rig {
        buffer_frames: buffer_frames.unwrap_or(usual.buffer_frames),
        channel: channel.map(|channel| channel - 1),
        mounted,
        missing,
        equalizes: settings.equalizes.unwrap_or(usual.equalizes),
        full_scale_volts: full_scale_volts.unwrap_or(usual.full_scale_volts),
        full_scale_mps2: full_scale_mps2.unwrap_or(usual.full_scale_mps2),
        pen: match settings.pen.as_deref() {
            Some(WINDOW_ONLY) => None,
            Some(pen) => Some(pen.to_owned()),
            None => usual.pen,
        },
        pressure_map: settings.pressure.and_then(restored_map).unwrap_or(usual.pressure_map),
        pen_size_mm: settings.pen_size_mm.filter(|size| size.iter().all(|side| SIDES_MM.contains(side))),
    }
}

fn restored_actuator(settings: &ActuatorSettings, full_scale_volts: Option<f64>) -> anyhow::Result<Mounted> {
    if let Some(volts) = full_scale_volts {
        ensure!(
            FULL_SCALES_VOLTS.contains(&volts),
            strings::full_scale_out_of_range(volts, FULL_SCALES_VOLTS)
        );
    }
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
        ActuatorSettings, FULL_SCALES_VOLTS, Kilograms, Mounted, PressureMap, PressureSettings,
        ProfileSettings, Rig, RigSettings, built_in_actuators, remembered, restored, with_pen_of,
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
                missing: None,
                equalizes: false,
                full_scale_volts: 2.5,
                full_scale_mps2: 7.0,
                pen: Some("hid:056a:0061".to_owned()),
                pressure_map: PressureMap { activation_n: 0.1, full_n: 3.0, bend: 0.0 },
                pen_size_mm: Some([216.0, 135.0]),
            };
            let mut before = RigSettings { output: Some("other".to_owned()), ..RigSettings::default() };
            before.unknown.insert("later".to_owned(), 3.into());
            let settings = remembered(&rig, "null".to_owned(), Some(&before));
            assert_eq!((settings.output.as_deref(), &settings.unknown), (Some("null"), &before.unknown));
            let profile = settings.actuator.as_ref().map(|actuator| &actuator.profile);
            assert_eq!(matches!(profile, Some(ProfileSettings::BuiltIn(_))), is_built_in);
            assert_eq!(restored(&settings), rig);
            // Storing only the pen leaves the other settings unchanged.
            let (pen, usual) = (with_pen_of(&rig, Some(&before)), Rig::default());
            let Rig { pressure_map, pen_size_mm, .. } = rig;
            assert_eq!(restored(&pen), Rig { pen: rig.pen, pressure_map, pen_size_mm, ..usual });
            assert_eq!((pen.output, pen.buffer_frames, pen.unknown), (before.output, None, before.unknown));
        }
    }

    #[test]
    fn no_pen_comes_back_as_none_and_a_first_start_chooses_automatically() {
        for pen in [None, Some("auto".to_owned()), Some("raw:056a:0061".to_owned())] {
            let rig = Rig { pen, ..Rig::default() };
            assert_eq!(restored(&with_pen_of(&rig, None)), rig);
        }
        assert_eq!(restored(&RigSettings::default()).pen.as_deref(), Some("auto"));
    }

    #[test]
    fn nothing_remembered_and_nonsense_are_a_first_start() {
        assert_eq!(restored(&RigSettings::default()), Rig::default());
        let nonsense = RigSettings {
            buffer_frames: Some(0),
            channel: Some(0),
            full_scale_volts: Some(-1.0),
            full_scale_mps2: Some(1e-9),
            pressure: Some(PressureSettings { activation_n: 5.0, full_n: 1.0, bend: 0.0 }),
            pen_size_mm: Some([0.0, 100.0]),
            ..RigSettings::default()
        };
        assert_eq!(restored(&nonsense), Rig::default());
    }

    /// Nothing is driven, and all settings are kept, including the actuator.
    #[test]
    fn an_actuator_that_cannot_be_had_stays_remembered() {
        let known = ProfileSettings::BuiltIn(known().id);
        for (profile, volts, words) in [
            (ProfileSettings::BuiltIn("gone".to_owned()), 2.0, "gone"),
            (ProfileSettings::Own("my notes".to_owned()), 2.0, "profile"),
            (known.clone(), -1.0, "-1 V"),
            (known.clone(), 2.0 * FULL_SCALES_VOLTS.end(), "200 V"),
        ] {
            let settings = RigSettings {
                output: Some("null".to_owned()),
                actuator: Some(ActuatorSettings { profile, load_g: Some(40.0) }),
                full_scale_volts: Some(volts),
                pen: Some("hid:056a:0061".to_owned()),
                ..RigSettings::default()
            };
            let rig = restored(&settings);
            let error = rig.drive().unwrap_err().to_string();
            assert!(error.contains(words), "{error}");
            assert_eq!((rig.mounted.as_ref(), rig.pen.as_ref()), (None, settings.pen.as_ref()));
            let rig = Rig { buffer_frames: 64, ..rig };
            let again = remembered(&rig, "null".to_owned(), Some(&settings));
            assert_eq!((&again.actuator, again.full_scale_volts), (&settings.actuator, Some(volts)));
            assert_eq!(restored(&again), rig);
        }
    }
}
