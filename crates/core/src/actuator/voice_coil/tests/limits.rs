//! What an actuator stands: drives, rated currents and friction displays.

use std::f64::consts::TAU;

use realfft::num_complex::Complex;

use super::{actuator, response, sheet};
use crate::actuator::friction_display::FrictionDisplay;
use crate::actuator::voice_coil::{
    Actuator, ActuatorError, Drive, Limits, Measured, Mechanics, Physical, USUAL_LOWEST, drive_config,
    validate,
};
use crate::units::{Hertz, Volts};

#[test]
fn a_drive_keeps_within_what_the_actuator_stands() {
    let actuator = Actuator {
        id: "coil".into(),
        name: "Coil".into(),
        maker: String::new(),
        source: String::new(),
        license: String::new(),
        measured: Some(Measured { response: response(), load: None }),
        limits: Limits {
            rated_volts_rms: Some(Volts(1.41)),
            peak_volts: Some(Volts(4.5)),
            ..Limits::default()
        },
        physical: Physical::default(),
        lowest: USUAL_LOWEST,
        calibrated: None,
        friction: None,
        channels: Vec::new(),
    };
    let drive = Drive::new(Volts(5.0)).unwrap();
    let config = drive_config(&actuator, drive, true).unwrap();
    let budget = config.budget.unwrap();
    assert_eq!((config.full_scale, config.ceiling, config.look_ahead_secs), (5.0, 0.9, 0.002));
    assert_eq!((budget.rms, budget.time_secs), (0.282, 10.0));
    let inverse = config.inverse.unwrap();
    assert_eq!((inverse.lowest_hz, inverse.resonance.frequency_hz), (20.0, response().resonance().0));
    let bare = drive_config(&actuator, drive, false).unwrap();
    assert!(bare.inverse.is_none() && bare.budget == config.budget && bare.ceiling == config.ceiling);
    // The acceleration far above the resonance is the same.
    assert!((f64::from(bare.full_scale) - 5.0 * response().gain_mps2_per_v()).abs() < 1e-5);
    assert!((config.full_scale_mps2() - bare.full_scale_mps2()).abs() < 1e-5);
    // An amplifier below the peak voltage is not limited below its own full scale.
    assert_eq!(drive_config(&actuator, Drive::ASSUMED, true).unwrap().ceiling, 1.0);
    let unknown = Actuator { measured: None, ..actuator };
    let error = drive_config(&unknown, drive, true).unwrap_err();
    assert!(matches!(error, ActuatorError::NoResponse { .. }), "{error}");
}

#[test]
fn a_rated_current_is_a_rated_voltage_through_the_resistance() {
    let of = |volts: Option<f64>, amps: Option<f64>, ohm: Option<f64>| {
        let limits = Limits { rated_volts_rms: volts.map(Volts), rated_amps_rms: amps, ..actuator().limits };
        let physical = Physical { resistance_ohm: ohm, ..actuator().physical };
        Actuator { limits, physical, ..actuator() }
    };
    // Redesigned Haptuator: 0.5 A through 6 Ω.
    for (volts, amps, ohm, expected) in [
        (None, Some(0.5), Some(6.0), Some(3.0)),
        (Some(1.41), Some(0.5), Some(6.0), Some(1.41)),
        (Some(4.0), Some(0.5), Some(6.0), Some(4.0)),
        (Some(1.41), Some(0.5), None, Some(1.41)),
        (Some(1.41), None, Some(6.0), Some(1.41)),
        (None, Some(0.5), None, None),
        (None, None, Some(6.0), None),
    ] {
        let actuator = of(volts, amps, ohm);
        let limits = actuator.limits_in_volts();
        assert_eq!(limits, Limits { rated_volts_rms: expected.map(Volts), ..actuator.limits });
        let budget = drive_config(&actuator, Drive::new(Volts(5.0)).unwrap(), true).unwrap().budget;
        assert_eq!(budget.map(|b| b.rms), expected.map(|volts| (volts / 5.0) as f32));
        let headroom = actuator.headroom(Hertz(20.0), Hertz(400.0)).unwrap();
        assert_eq!(headroom.rated_mps2, expected.map(|volts| volts / headroom.volts_per_mps2));
        let warning = actuator.limits_warning();
        assert_eq!(warning.is_some(), amps.is_some() && expected.is_none());
        assert!(warning.is_none_or(|w| w.to_string().contains("rated for 0.5 A")));
    }
    // At any frequency the derived voltage keeps the current within its rating. The impedance of coil and motion is
    // `R + jωL + Bl² jω / (m_r (ω₀² - ω²) + jω b)`.
    let mechanics = Mechanics::identified(&sheet()).unwrap();
    let case = mechanics.body_mass.0 + 0.1;
    let reduced = mechanics.moving_mass.0 * case / (mechanics.moving_mass.0 + case);
    for step in 0..200 {
        let omega = TAU * 5.0 * 200.0_f64.powf(f64::from(step) / 199.0);
        let moves = Complex::new(
            mechanics.stiffness_n_per_m - reduced * omega * omega,
            omega * mechanics.damping_n_s_per_m,
        );
        let motional = Complex::new(0.0, omega * mechanics.force_factor_n_per_a.powi(2)) / moves;
        let impedance = (Complex::new(mechanics.resistance_ohm, omega * 128e-6) + motional).norm();
        assert!(0.5 * mechanics.resistance_ohm / impedance <= 0.5, "at {omega} rad/s");
    }
}

#[test]
fn a_friction_display_needs_a_channel_and_a_carrier_that_an_output_can_play() {
    let of = |carrier_hz, channel| {
        let friction = Some(FrictionDisplay { carrier: Hertz(carrier_hz), channel });
        validate(&Actuator { friction, ..actuator() })
    };
    assert_eq!(of(120.0, 2), Ok(()));
    assert_eq!(of(30_000.0, 64), Ok(()));
    for (carrier_hz, channel, expected) in [
        (19.0, 2, "the carrier of the friction display in Hz is 19, needs 20 to 80000"),
        (f64::NAN, 2, "the carrier of the friction display in Hz is NaN"),
        (120.0, 0, "the channel of the friction display is 0, needs 1 to 64"),
        (120.0, 65, "the channel of the friction display is 65"),
    ] {
        let message = of(carrier_hz, channel).unwrap_err().to_string();
        assert!(message.contains(expected), "{message}");
    }
}
