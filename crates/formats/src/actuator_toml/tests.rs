use super::{
    BUILT_IN, Calibrated, FrictionDisplay, NamedChannel, built_in_actuators, read_actuator, write_actuator,
};
use shagreen_core::actuator::{DataSheet, Mechanics};
use shagreen_core::units::{Hertz, Kilograms, Volts};

#[track_caller]
fn check_error(text: &str, expected: &str) {
    let message = read_actuator(text.as_bytes()).unwrap_err().to_string();
    assert!(message.contains(expected) && !message.contains('\n'), "{message}");
}

#[test]
fn the_built_in_profiles_say_where_they_come_from() {
    let actuators = built_in_actuators().unwrap();
    let ids: Vec<&str> = actuators.iter().map(|a| a.id.as_str()).collect();
    let expected =
        ["haptuator-mark-ii", "haptuator-redesign", "alps-aft14a903a", "mm1c", "dualsense", "four-channels"];
    assert_eq!(ids, expected);
    for actuator in &actuators {
        assert!(actuator.source.len() > 20, "{}", actuator.id);
        // Only one built-in profile has a response; the others ask the user to calibrate.
        assert_eq!(actuator.measured.is_some(), actuator.id == "haptuator-mark-ii");
        assert!(actuator.measured.is_some() || actuator.source.contains("calibrate it"));
    }
}

#[test]
fn the_mark_ii_follows_from_its_data_sheet() {
    let actuator = built_in_actuators().unwrap().remove(0);
    let (limits, physical) = (actuator.limits, actuator.physical);
    let mechanics = Mechanics::identified(&DataSheet {
        moving_mass: physical.moving_mass.unwrap(),
        total_mass: Kilograms::from_g(8.7),
        load: Kilograms::from_g(100.0),
        resistance_ohm: physical.resistance_ohm.unwrap(),
        resonance: Hertz(65.0),
        rated_volts_rms: limits.rated_volts_rms.unwrap(),
        rated_amps_rms: limits.rated_amps_rms.unwrap(),
        peak_volts: limits.peak_volts.unwrap(),
        peak_mps2: 4.0 * 9.81,
    })
    .unwrap();
    let (written, derived) =
        (actuator.response().unwrap(), mechanics.response_on(Kilograms::from_g(100.0)).unwrap());
    for (written, derived) in [
        (written.resonance().0, derived.resonance().0),
        (written.q(), derived.q()),
        (written.gain_mps2_per_v(), derived.gain_mps2_per_v()),
        (physical.body_mass.unwrap().0, mechanics.body_mass.0),
        (physical.force_factor_n_per_a.unwrap(), mechanics.force_factor_n_per_a),
        (physical.stiffness_n_per_m.unwrap(), mechanics.stiffness_n_per_m),
        (physical.damping_n_s_per_m.unwrap(), mechanics.damping_n_s_per_m),
    ] {
        // The file stores six digits.
        assert!((written / derived - 1.0).abs() < 5e-6, "{written} for {derived}");
    }
}

#[test]
fn every_profile_comes_back_exactly() {
    for mut actuator in built_in_actuators().unwrap() {
        assert_eq!(read_actuator(&write_actuator(&actuator)).unwrap(), actuator);
        actuator.name = "A \"name\"\n\\ \u{7f} µ".to_owned();
        actuator.physical.moving_mass = Some(Kilograms(0.1 + 0.2));
        actuator.physical.inductance_h = Some(1.0 / 3.0e4);
        actuator.calibrated = Some(Calibrated {
            fit_error_db: 0.1,
            resonance_error_hz: 1e-9,
            q_error: 0.0,
            gain_error_mps2_per_v: 1.0 / 3.0,
            full_scale: Volts(2.0),
        });
        assert_eq!(read_actuator(&write_actuator(&actuator)).unwrap(), actuator);
        actuator.friction = Some(FrictionDisplay { carrier: Hertz(1.0e3 / 7.0), channel: 9 });
        let written = write_actuator(&actuator);
        assert_eq!(read_actuator(&written).unwrap(), actuator);
        // Version 1.2 may have a friction display too.
        let version = if actuator.channels.is_empty() { "1.1" } else { "1.2" };
        assert!(String::from_utf8(written).unwrap().contains(&format!("version = \"{version}\"")));
    }
}

#[test]
fn a_friction_display_is_read_and_checked() {
    let with = |table: &str| format!("{}\n[friction]\n{table}\n", BUILT_IN[0]).replace("\"1.0\"", "\"1.1\"");
    let read = read_actuator(with("carrier_hz = 120\nchannel = 2").as_bytes()).unwrap();
    assert_eq!(read.friction, Some(FrictionDisplay { carrier: Hertz(120.0), channel: 2 }));
    check_error(&with("carrier_hz = 120"), "the field `channel` is missing");
    check_error(&with("carrier_hz = 120\nchannel = 2.5"), "at line");
    check_error(&with("carrier_hz = 5\nchannel = 2"), "the carrier of the friction display in Hz is 5");
    check_error(&with("carrier_hz = 120\nchannel = 2\nvolts = 9"), "the field `volts` is unknown");
}

#[test]
fn named_channels_are_read_and_checked() {
    let actuators = built_in_actuators().unwrap();
    let of = |id: &str| actuators.iter().find(|actuator| actuator.id == id).unwrap();
    let channel = |number, name: &str| NamedChannel { number, name: name.to_owned() };
    assert_eq!(of("dualsense").channels, [channel(3, "left grip"), channel(4, "right grip")]);
    assert!(of("dualsense").is_proportional() && !of("mm1c").is_proportional());
    assert_eq!(of("four-channels").channels.len(), 4);
    let with = |table: &str| format!("{}\n[[channel]]\n{table}\n", BUILT_IN[0]).replace("\"1.0\"", "\"1.2\"");
    let read = read_actuator(with("number = 3\nname = \"grip\"").as_bytes()).unwrap();
    assert_eq!((read.channels.as_slice(), read.is_proportional()), (&[channel(3, "grip")][..], false));
    check_error(&with("number = 3"), "the field `name` is missing");
    check_error(&with("number = 0\nname = \"grip\""), "is 0, needs 1 to 64");
    check_error(&with("number = 3\nname = \"7\""), "needs a word");
    check_error(&with("number = 3\nname = \"grip\"\nvolts = 9"), "the field `volts` is unknown");
}

#[test]
fn what_is_wrong_is_named_with_its_place() {
    let good = BUILT_IN[0];
    check_error(&good.replace("peak_v", "peak_volts"), "the field `peak_volts` is unknown");
    check_error(&good.replace("peak_v", "peak_volts"), "at line 20");
    check_error(&good.replace("q = 4.08634", "q = nan"), "Q is NaN, needs 0.1 to 1000");
    check_error(&good.replace("peak_v = 4.5", "peak_v = -4.5"), "the peak voltage in V is -4.5");
    check_error(&good.replace("lowest_hz = 20", "lowest_hz = \"low\""), "line 9");
    check_error(&good.replace("\"1.0\"", "\"2.0\""), "version 2.0");
    check_error(&good.replace("shagreen-actuator", "shagreen-signal"), "not an actuator profile");
    check_error(
        &good.replace("id = \"haptuator-mark-ii\"", "id = \"Mark II\""),
        "`id` is \"Mark II\", which is not a valid identifier",
    );
    check_error("x = 1", "the field `format` is missing");
    check_error("[", "line 1");
    assert!(read_actuator(b"a = \"\xff\"").unwrap_err().to_string().contains("byte 5"));
}
