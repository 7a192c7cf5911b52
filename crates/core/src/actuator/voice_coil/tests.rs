mod limits;

use std::f64::consts::TAU;

use proptest::prelude::{prop_assert, proptest};
use realfft::num_complex::Complex;
use serde_json::Value;

use super::{
    Actuator, ActuatorError, DataSheet, Drive, Limits, Measured, Mechanics, Physical, Response, USUAL_LOWEST,
    inverse, inverse_gain_bound, validate,
};
use crate::dsp::filter::Biquad;
use crate::maths::rng::lcg_noise;
use crate::units::{Hertz, Kilograms, Volts};

/// Numbers of the reference script (`vectors/b_act`).
fn golden() -> Value {
    serde_json::from_str(include_str!("../../../../../vectors/b_act/actuator_vectors.json")).unwrap()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
}

#[track_caller]
fn check_near(got: f64, expected: &Value, tolerance: f64) {
    let expected = expected.as_f64().unwrap();
    assert!((got / expected - 1.0).abs() < tolerance, "got {got}, expected {expected}");
}

/// Data sheet of the vectors: 8 g and 9 V are peak-to-peak values, and the reference uses 9.81 m/s² for gravity.
fn sheet() -> DataSheet {
    DataSheet {
        moving_mass: Kilograms::from_g(4.4),
        total_mass: Kilograms::from_g(8.7),
        load: Kilograms(0.1),
        resistance_ohm: 4.5,
        resonance: Hertz(65.0),
        rated_volts_rms: Volts(1.41),
        rated_amps_rms: 0.1478,
        peak_volts: Volts(4.5),
        peak_mps2: 4.0 * 9.81,
    }
}

fn response() -> Response {
    Mechanics::identified(&sheet()).unwrap().response_on(Kilograms(0.1)).unwrap()
}

fn actuator() -> Actuator {
    Actuator {
        id: "test".into(),
        name: "Test".into(),
        maker: String::new(),
        source: String::new(),
        license: String::new(),
        measured: Some(Measured { response: response(), load: Some(Kilograms(0.1)) }),
        limits: Limits { rated_volts_rms: Some(Volts(1.41)), ..Limits::default() },
        physical: Physical {
            moving_mass: Some(Kilograms::from_g(4.4)),
            body_mass: Some(Kilograms::from_g(4.3)),
            ..Physical::default()
        },
        lowest: USUAL_LOWEST,
        calibrated: None,
        friction: None,
        channels: Vec::new(),
    }
}

/// Complex gain of a filter at a frequency.
fn gain(filter: &Biquad, hz: f64, rate_hz: f64) -> Complex<f64> {
    let z = Complex::from_polar(1.0, -TAU * hz / rate_hz);
    let [b0, b1, b2] = filter.b;
    let [a1, a2] = filter.a;
    (b0 + z * (b1 + z * b2)) / (1.0 + z * (a1 + z * a2))
}

fn db(ratio: f64) -> f64 {
    20.0 * ratio.log10()
}

#[test]
fn a_data_sheet_implies_the_motor_of_the_reference() {
    let derived = &golden()["derived"];
    let mechanics = Mechanics::identified(&sheet()).unwrap();
    // A dozen products in f64 on both sides.
    check_near(mechanics.force_factor_n_per_a, &derived["Bl"], 1e-13);
    check_near(mechanics.stiffness_n_per_m, &derived["k"], 1e-13);
    check_near(mechanics.damping_n_s_per_m, &derived["b"], 1e-13);
    let response = response();
    check_near(response.q(), &derived["Q_voltage"], 1e-13);
    check_near(response.gain_mps2_per_v(), &derived["K_voltage"], 1e-13);
    assert!((response.resonance().0 - 65.0).abs() < 1e-12);
}

#[test]
fn a_data_sheet_that_cannot_be_is_refused() {
    let message = |sheet: DataSheet| Mechanics::identified(&sheet).unwrap_err().to_string();
    let heavy = DataSheet { moving_mass: Kilograms::from_g(9.0), ..sheet() };
    assert!(
        message(heavy).contains("the moving mass is 9.000 g, but the total mass is 8.700 g"),
        "{}",
        message(heavy)
    );
    let cold = DataSheet { rated_amps_rms: 0.4, ..sheet() };
    assert!(message(cold).contains("the coil resistance alone is 4.5"), "{}", message(cold));
    let nothing = DataSheet { peak_mps2: f64::NAN, ..sheet() };
    assert!(message(nothing).contains("peak acceleration in m/s² is NaN"));
}

#[test]
fn the_response_is_that_of_the_reference() {
    let golden = golden();
    let response = response();
    for (hz, expected) in numbers(&golden["freq"]).iter().zip(golden["mag_per_V_noL"].as_array().unwrap()) {
        check_near(response.magnitude_at(Hertz(*hz)), expected, 1e-12);
    }
    assert!(
        (response.magnitude_at(Hertz(65.0)) / (response.q() * response.gain_mps2_per_v()) - 1.0).abs()
            < 1e-13
    );
}

#[test]
fn numbers_that_are_none_are_refused() {
    let error = |hz, q, gain| Response::new(Hertz(hz), q, gain).unwrap_err().to_string();
    assert_eq!(error(0.0, 1.0, 1.0), "the resonance in Hz is 0, needs a number above 0");
    assert_eq!(error(65.0, 0.05, 1.0), "Q is 0.05, needs 0.1 to 1000");
    assert!(error(65.0, f64::NAN, 1.0).contains("Q is NaN"));
    assert!(error(65.0, 1.0, f64::INFINITY).contains("gain in (m/s²)/V is inf"));
    assert!(Drive::new(Volts(-1.0)).is_err());
    let limits = Limits { peak_volts: Some(Volts(-4.5)), ..Limits::default() };
    let message = validate(&Actuator { limits, ..actuator() }).unwrap_err().to_string();
    assert_eq!(message, "the peak voltage in V is -4.5, needs a number above 0, at most 100");
    assert_eq!(validate(&actuator()), Ok(()));
}

#[test]
fn the_inverse_is_that_of_the_reference_at_every_rate() {
    let golden = golden();
    for (name, expected) in golden["inverse"].as_object().unwrap() {
        let (rate, lowest) = name.strip_prefix("fs").unwrap().split_once("_fh").unwrap();
        let (rate_hz, lowest_hz): (f64, f64) = (rate.parse().unwrap(), lowest.parse().unwrap());
        let filter = inverse(&response(), Hertz(lowest_hz), Hertz(rate_hz)).unwrap();
        // At 48 kHz, sums of 1e10 give numbers near 1, which costs five digits.
        for (got, expected) in filter.b.iter().zip(numbers(&expected["b"])) {
            assert!((got - expected).abs() < 1e-12, "{name}: got {got}, expected {expected}");
        }
        for (got, expected) in filter.a.iter().zip(&numbers(&expected["a"])[1..]) {
            assert!((got - expected).abs() < 1e-12, "{name}: got {got}, expected {expected}");
        }
        let equalized = expected["f"].as_array().unwrap().iter().zip(expected["eq_dB"].as_array().unwrap());
        for (hz, expected) in equalized {
            let hz = hz.as_f64().unwrap();
            let both = gain(&filter, hz, rate_hz) * response().at(Hertz(hz));
            assert!((db(both.norm()) - expected.as_f64().unwrap()).abs() < 1e-8, "{name} at {hz} Hz");
        }
    }
}

#[test]
fn an_inverse_that_cannot_be_is_refused() {
    let response = response();
    let error = |lowest, rate| inverse(&response, Hertz(lowest), Hertz(rate)).unwrap_err();
    assert!(matches!(error(20.0, 130.0), ActuatorError::Rate { what: "the resonance", .. }));
    assert!(matches!(error(600.0, 1000.0), ActuatorError::Rate { what: "the lowest frequency", .. }));
    assert!(matches!(error(0.0, 1000.0), ActuatorError::Number { .. }));
    assert!(matches!(error(20.0, f64::NAN), ActuatorError::Number { .. }));
}

proptest! {
    /// With its inverse filter at 48 kHz, any actuator is flat within 1 dB from twice the lowest frequency to 500 Hz.
    /// The gain of the inverse filter stays below its bound.
    #[test]
    fn an_equalized_actuator_is_flat(f0 in 30.0..300.0_f64, ln_q in -0.693..3.4_f64, ln_k in -3.0..5.0_f64) {
        let response = Response::new(Hertz(f0), ln_q.exp(), ln_k.exp()).unwrap();
        let filter = inverse(&response, USUAL_LOWEST, Hertz(48_000.0)).unwrap();
        let bound = inverse_gain_bound(&response, USUAL_LOWEST);
        for step in 0..200 {
            let hz = 40.0 * 12.5_f64.powf(f64::from(step) / 199.0);
            let flat = db((gain(&filter, hz, 48_000.0) * response.at(Hertz(hz))).norm());
            prop_assert!(flat.abs() < 1.0, "{flat} dB at {hz} Hz");
        }
        for step in 0..300 {
            let hz = 24_000.0 * 1e-5_f64.powf(f64::from(step) / 299.0);
            let volts = gain(&filter, hz, 48_000.0).norm();
            prop_assert!(volts <= bound, "{volts} V at {hz} Hz is above {bound}");
        }
    }

    /// The filter is stable and bounded for all ratios of resonance, lowest frequency and sample rate.
    #[test]
    fn an_inverse_is_stable_and_bounded(f0 in 5.0..450.0_f64, lowest in 5.0..450.0_f64, ln_q in -2.0..6.0_f64) {
        let response = Response::new(Hertz(f0), ln_q.exp(), 2.0).unwrap();
        let filter = inverse(&response, Hertz(lowest), Hertz(1000.0)).unwrap();
        let [a1, a2] = filter.a;
        prop_assert!(a2.abs() < 1.0 && a1.abs() < 1.0 + a2, "{filter:?}");
        let bound = inverse_gain_bound(&response, Hertz(lowest));
        for step in 0..=100 {
            let volts = gain(&filter, 5.0 * f64::from(step), 1000.0).norm();
            prop_assert!(volts <= bound, "{volts} above {bound}");
        }
    }

    /// The bound is tight: the larger gain of zero frequency and half of the sample rate reaches it within √2.
    #[test]
    fn the_bound_is_tight(f0 in 5.0..450.0_f64, q in 0.5..30.0_f64) {
        let response = Response::new(Hertz(f0), q, 1.0).unwrap();
        let filter = inverse(&response, USUAL_LOWEST, Hertz(1000.0)).unwrap();
        let most = gain(&filter, 0.0, 1000.0).norm().max(gain(&filter, 500.0, 1000.0).norm());
        prop_assert!(inverse_gain_bound(&response, USUAL_LOWEST) <= 1.4146 * most);
    }
}

#[test]
fn the_headroom_is_that_of_the_reference() {
    let golden = golden();
    let response = response();
    // The reference averages over 2000 frequencies and weights both ends fully. The same grid must reproduce its
    // number, and a fine grid ours.
    let mean_of = |n: usize| {
        let inverse_square = |i: usize| {
            let hz = 20.0 + 380.0 * i as f64 / (n - 1) as f64;
            response.magnitude_at(Hertz(hz)).powi(-2)
        };
        let ends = 0.5 * (inverse_square(0) + inverse_square(n - 1));
        let sum: f64 = (0..n).map(inverse_square).sum();
        ((sum / n as f64).sqrt(), ((sum - ends) / (n - 1) as f64).sqrt())
    };
    check_near(mean_of(2000).0, &golden["volts_rms_per_mps2_rms_flat20_400"], 1e-12);
    let headroom = actuator().headroom(Hertz(20.0), Hertz(400.0)).unwrap();
    let fine = mean_of(200_001).1;
    // Error of the trapezoidal rule with 200,000 steps.
    assert!(
        (headroom.volts_per_mps2 / fine - 1.0).abs() < 1e-8,
        "got {}, expected {fine}",
        headroom.volts_per_mps2
    );
    // The ends of the reference's grid have double weight: 0.6 % of the voltage.
    check_near(headroom.volts_per_mps2, &golden["volts_rms_per_mps2_rms_flat20_400"], 0.007);
    check_near(headroom.rated_mps2.unwrap(), &golden["max_rms_mps2_at_rated_1p41Vrms"], 0.007);
    assert!(actuator().headroom(Hertz(400.0), Hertz(20.0)).is_err());
}

#[test]
fn another_load_is_what_its_masses_say() {
    let mechanics = Mechanics::identified(&sheet()).unwrap();
    for load in [0.005, 0.04, 0.1, 2.0] {
        let at_load = actuator().at_load(Kilograms(load)).unwrap().response().unwrap();
        let expected = mechanics.response_on(Kilograms(load)).unwrap();
        for (got, expected) in [
            (at_load.resonance().0, expected.resonance().0),
            (at_load.q(), expected.q()),
            (at_load.gain_mps2_per_v(), expected.gain_mps2_per_v()),
        ] {
            assert!((got / expected - 1.0).abs() < 1e-12, "got {got}, expected {expected} at {load} kg");
        }
    }
    // The reference estimates about 5.1 m/s² on a 40 g stylus from the mass ratio alone; the resonance moves, too.
    let on_pen = actuator().at_load(Kilograms(0.04)).unwrap().headroom(Hertz(20.0), Hertz(400.0)).unwrap();
    check_near(on_pen.rated_mps2.unwrap(), &golden()["max_rms_mps2_at_rated_40g_pen"], 0.08);
}

#[test]
fn a_load_that_does_not_follow_is_refused() {
    let on = |actuator: Actuator| actuator.at_load(Kilograms(0.04)).unwrap_err().to_string();
    let physical = Physical { moving_mass: None, ..actuator().physical };
    assert!(on(Actuator { physical, ..actuator() }).contains("needs its moving mass; calibrate"));
    let measured = Some(Measured { response: response(), load: None });
    assert!(on(Actuator { measured, ..actuator() }).contains("the load it was measured on"));
    assert!(on(Actuator { measured: None, ..actuator() }).contains("the response of test is unknown"));
    // The load of the measurement needs no masses.
    let bare = Actuator { physical: Physical::default(), ..actuator() };
    assert_eq!(bare.at_load(Kilograms(0.1)).unwrap(), bare);
}

/// Compares with the differential equation, integrated in small steps by the classical Runge-Kutta method.
#[test]
fn a_driven_actuator_follows_its_differential_equation() {
    let rate_hz = 8000.0;
    let response = response();
    // Frequencies below 500 Hz. Linear interpolation between samples would have an error of about a percent, so the
    // reference evaluates the sum of sines itself.
    let noise = lcg_noise(30, 4);
    let voltage = |t: f64| -> f64 {
        let fade = (t / 0.05).min(1.0);
        let sines = (0..10).map(|i| {
            noise[i] * (TAU * (30.0 + 45.0 * i as f64 + 3.0 * noise[i + 10]) * t + noise[i + 20]).sin()
        });
        fade * fade * (3.0 - 2.0 * fade) * sines.sum::<f64>()
    };
    let volts: Vec<f64> = (0..4000).map(|i| voltage(f64::from(i) / rate_hz)).collect();
    let got = response.drive(&volts, Hertz(rate_hz));
    let omega = TAU * response.resonance().0;
    let acceleration = |t: f64, [x, v]: [f64; 2]| voltage(t) - omega / response.q() * v - omega * omega * x;
    let mut state = [0.0, 0.0];
    let step = 1.0 / (4.0 * rate_hz);
    for (i, got) in got.iter().enumerate() {
        let t = i as f64 / rate_hz;
        let expected = response.gain_mps2_per_v() * acceleration(t, state);
        // The signal ends abruptly, which affects the circular convolution: the last tenth is excluded.
        if i < 3600 {
            assert!((got - expected).abs() < 2e-3, "got {got}, expected {expected} at {t} s");
        }
        for k in 0..4 {
            let t = t + f64::from(k) * step;
            let slope = |t: f64, s: [f64; 2]| [s[1], acceleration(t, s)];
            let along = |s: [f64; 2], d: [f64; 2], h: f64| [s[0] + h * d[0], s[1] + h * d[1]];
            let k1 = slope(t, state);
            let k2 = slope(t + 0.5 * step, along(state, k1, 0.5 * step));
            let k3 = slope(t + 0.5 * step, along(state, k2, 0.5 * step));
            let k4 = slope(t + step, along(state, k3, step));
            for j in 0..2 {
                state[j] += step / 6.0 * (k1[j] + 2.0 * k2[j] + 2.0 * k3[j] + k4[j]);
            }
        }
    }
    assert!(response.drive(&[], Hertz(rate_hz)).is_empty());
}
