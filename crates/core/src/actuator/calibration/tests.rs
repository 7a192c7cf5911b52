use std::f64::consts::TAU;

use serde_json::Value;

use super::{
    Calibration, CalibrationError, CalibrationWarning, CurvePoint, FitError, Sweep, calibrate, fit_response,
};
use crate::actuator::{Drive, Response};
use crate::maths::rng::Random;
use crate::units::{Hertz, Volts};

/// Shorter than the default sweep, for fast tests.
const QUICK: Sweep = Sweep { seconds: 8.0, silence_secs: 1.5, ..Sweep::USUAL };
const QUICK_RATE: Hertz = Hertz(4000.0);

/// Simulated measurement between the sweep and the recording.
#[derive(Clone, Copy)]
struct Bench {
    rate: Hertz,
    /// Delay of the recorded sweep.
    latency_secs: f64,
    noise_mps2: f64,
    hum_mps2: f64,
    offset_mps2: f64,
    /// Deviation of the sensor's clock from that of the output, in ppm.
    clock_ppm: f64,
    /// Quadratic distortion of the amplifier, per volt.
    square_per_v: f64,
}

impl Bench {
    const QUIET: Self = Self {
        rate: QUICK_RATE,
        latency_secs: 0.0,
        noise_mps2: 0.0,
        hum_mps2: 0.0,
        offset_mps2: 0.0,
        clock_ppm: 0.0,
        square_per_v: 0.0,
    };

    /// Recording of a sweep; `of` converts voltage to acceleration.
    fn record_as(&self, sweep: &Sweep, of: impl Fn(&[f64], Hertz) -> Vec<f64>) -> Vec<f64> {
        // A fast clock takes more samples of the same sweep.
        let true_rate = Hertz(self.rate.0 * (1.0 + 1e-6 * self.clock_ppm));
        let mut volts = vec![0.0; (self.latency_secs * self.rate.0) as usize];
        volts.extend(sweep.signal(true_rate).unwrap());
        for v in &mut volts {
            *v += self.square_per_v * *v * *v;
        }
        let mut random = Random::new(7);
        let noisy = |(i, a): (usize, f64)| {
            let t = i as f64 / self.rate.0;
            let drift = 0.3 * self.offset_mps2 * (TAU * 0.05 * t).sin();
            a + self.noise_mps2 * random.normal()
                + self.hum_mps2 * (TAU * 60.0 * t).sin()
                + self.offset_mps2
                + drift
        };
        of(&volts, true_rate).into_iter().enumerate().map(noisy).collect()
    }

    fn record(&self, sweep: &Sweep, response: &Response) -> Vec<f64> {
        self.record_as(sweep, |volts, rate| response.drive(volts, rate))
    }

    fn calibrate(&self, sweep: &Sweep, response: &Response) -> Calibration {
        calibrate(&self.record(sweep, response), self.rate, sweep, Drive::ASSUMED).unwrap()
    }
}

fn response(hz: f64, q: f64, gain: f64) -> Response {
    Response::new(Hertz(hz), q, gain).unwrap()
}

fn mark_ii() -> Response {
    response(65.0, 4.086_340_698, 2.133_938_564)
}

/// Checks the relative errors of resonance, Q and gain.
#[track_caller]
fn check_fit(calibration: &Calibration, expected: &Response, tolerances: [f64; 3]) {
    let fit = calibration.fit.as_ref().unwrap();
    let got = fit.response;
    let off = [
        got.resonance().0 / expected.resonance().0 - 1.0,
        got.q() / expected.q() - 1.0,
        got.gain_mps2_per_v() / expected.gain_mps2_per_v() - 1.0,
    ];
    let is_near = off.iter().zip(tolerances).all(|(off, tolerance)| off.abs() < tolerance);
    assert!(is_near, "relative errors {off:?}, expected {expected:?}; {fit:?}; {:?}", calibration.warnings);
}

#[test]
fn a_sweep_is_what_it_says() {
    let rate = Hertz(8000.0);
    let signal = Sweep::USUAL.signal(rate).unwrap();
    assert_eq!(signal.len(), 24 * 8000);
    let peak = signal.iter().fold(0.0, |peak: f64, v| peak.max(v.abs()));
    assert!(peak <= 0.5 && peak > 0.499, "{peak}");
    assert!(signal[..16_000].iter().chain(&signal[22 * 8000..]).all(|v| *v == 0.0));
    for hz in [20.0, 100.0, 500.0] {
        // Counts upward zero crossings within half a second on both sides.
        let at = 2.0 + Sweep::USUAL.time_of(Hertz(hz));
        let around = &signal[((at - 0.5) * rate.0) as usize..((at + 0.5) * rate.0) as usize];
        let n = around.windows(2).filter(|pair| pair[0] < 0.0 && pair[1] >= 0.0).count();
        // The mean frequency of this second exceeds the central frequency by 0.2 %.
        assert!((n as f64 - hz).abs() <= 1.0 + 0.003 * hz, "{n} at {hz} Hz");
    }
}

#[test]
fn a_sweep_that_cannot_be_is_refused() {
    let message = |sweep: Sweep, rate| sweep.signal(Hertz(rate)).unwrap_err().to_string();
    assert_eq!(
        message(Sweep { high: Hertz(50.0), ..Sweep::USUAL }, 8000.0),
        "the end in Hz of the sweep is 50, needs 80 to 24000"
    );
    assert_eq!(
        message(Sweep::USUAL, 2000.0),
        "the end in Hz of the sweep is 1000, needs 900 or less at this rate"
    );
    assert!(message(Sweep { seconds: f64::NAN, ..Sweep::USUAL }, 8000.0).contains("length in s"));
    assert!(
        message(Sweep { amplitude: 1.5, ..Sweep::USUAL }, 8000.0).contains("amplitude of the sweep is 1.5")
    );
}

#[test]
fn actuators_of_all_kinds_are_recovered() {
    // Noise about 40 dB below the response far above the resonance.
    for (i, hz) in (0..).zip([30.0, 65.0, 120.0, 210.0, 300.0]) {
        for (k, q) in (0..).zip([0.6, 1.5, 4.0, 12.0, 30.0]) {
            let gain = 0.3 * 3.0_f64.powi((i + k) % 5);
            let expected = response(hz, q, gain);
            let bench = Bench { noise_mps2: 0.005 * gain, latency_secs: 0.05 * f64::from(k), ..Bench::QUIET };
            let calibration = bench.calibrate(&QUICK, &expected);
            // Q of a flat maximum at the upper end of the band is the least accurate; a sharp maximum loses a little to
            // the window.
            check_fit(&calibration, &expected, [0.004, 0.015, 0.01]);
            let fit = calibration.fit.unwrap();
            assert!(fit.error_db < 1.0, "{fit:?}");
        }
    }
}

#[test]
fn hum_gravity_drift_latency_and_a_wrong_clock_do_no_harm() {
    for rate_hz in [48_000.0, 44_100.0, 3200.0] {
        for clock_ppm in [-100.0, 100.0] {
            let bench = Bench {
                rate: Hertz(rate_hz),
                latency_secs: 0.371,
                noise_mps2: 0.05,
                hum_mps2: 0.05,
                offset_mps2: 9.81,
                clock_ppm,
                ..Bench::QUIET
            };
            let calibration = bench.calibrate(&QUICK, &mark_ii());
            check_fit(&calibration, &mark_ii(), [0.005, 0.02, 0.02]);
            assert!((calibration.begins_secs - 1.871).abs() < 0.05, "{}", calibration.begins_secs);
        }
    }
}

#[test]
fn the_usual_sweep_recovers_the_reference() {
    let bench = Bench { rate: Hertz(48_000.0), noise_mps2: 0.02, latency_secs: 0.2, ..Bench::QUIET };
    let calibration = bench.calibrate(&Sweep::USUAL, &mark_ii());
    check_fit(&calibration, &mark_ii(), [0.001, 0.003, 0.003]);
    assert_eq!(calibration.warnings, []);
    let fit = calibration.fit.unwrap();
    assert!(fit.error_db < 0.1, "{fit:?}");
    // The curve agrees with the response to 0.2 dB, and to 0.05 dB far above the noise.
    for point in calibration.curve.iter().filter(|p| p.frequency.0 > 25.0) {
        let db = 20.0 * (point.gain_mps2_per_v / mark_ii().magnitude_at(point.frequency)).log10();
        assert!(db.abs() < 0.2, "{db} dB at {}", point.frequency);
    }
    assert!(calibration.distortion.iter().all(|p| p.share < 0.01));
}

#[test]
fn the_drive_scales_the_gain() {
    let drive = Drive::new(Volts(2.5)).unwrap();
    let loud = Bench::QUIET.record_as(&QUICK, |volts, rate| {
        let volts: Vec<f64> = volts.iter().map(|v| 2.5 * v).collect();
        mark_ii().drive(&volts, rate)
    });
    let calibration = calibrate(&loud, QUICK_RATE, &QUICK, drive).unwrap();
    check_fit(&calibration, &mark_ii(), [0.001, 0.005, 0.005]);
}

#[test]
fn the_noise_is_that_of_the_silence() {
    let bench = Bench { noise_mps2: 0.2, ..Bench::QUIET };
    let calibration = bench.calibrate(&QUICK, &mark_ii());
    let quiet = Bench::QUIET.calibrate(&QUICK, &mark_ii());
    // The difference between a measurement with noise and one without is as large as the reported noise.
    let ratio = |(noisy, quiet): (&CurvePoint, &CurvePoint)| {
        let away = noisy.gain_mps2_per_v - quiet.gain_mps2_per_v;
        (away / noisy.noise_mps2_per_v.unwrap()).powi(2)
    };
    let clear = calibration.curve.iter().zip(&quiet.curve).filter(|(_, q)| q.frequency.0 > 40.0);
    let ratios: Vec<f64> = clear.map(ratio).collect();
    let mean = ratios.iter().sum::<f64>() / ratios.len() as f64;
    // Half of the noise power is in phase with the signal; a hundred points of one realization determine it within a
    // third.
    assert!((0.3..0.7).contains(&mean), "{mean}");
    // Without noise, the reported noise is almost zero.
    assert!(quiet.curve.iter().all(|p| p.noise_mps2_per_v.unwrap() < 1e-3 * p.gain_mps2_per_v));
}

#[test]
fn harmonics_are_told_from_the_response() {
    let square_per_v = 0.4;
    let bench = Bench { square_per_v, ..Bench::QUIET };
    let calibration = bench.calibrate(&Sweep { seconds: 16.0, ..QUICK }, &mark_ii());
    check_fit(&calibration, &mark_ii(), [0.003, 0.01, 0.01]);
    let mut n_checked = 0;
    for point in calibration.distortion.iter().filter(|p| p.frequency.0 > 40.0 && p.frequency.0 < 400.0) {
        // The square of A sin is A²/2 (1 - cos): half of the coefficient times the amplitude, with the gain one octave
        // higher.
        let twice = mark_ii().magnitude_at(Hertz(2.0 * point.frequency.0));
        let expected = 0.5 * square_per_v * 0.5 * twice / mark_ii().magnitude_at(point.frequency);
        assert!(
            (point.share / expected - 1.0).abs() < 0.1,
            "got {}, expected {expected} at {}",
            point.share,
            point.frequency
        );
        n_checked += 1;
    }
    assert!(n_checked > 60, "{n_checked}");
    assert!(calibration.warnings.iter().any(|w| matches!(w, CalibrationWarning::Distorted { .. })));
}

#[test]
fn cut_peaks_are_named_and_rounded_ones_are_not() {
    let recording = Bench { noise_mps2: 0.01, ..Bench::QUIET }.record(&QUICK, &mark_ii());
    let of = |recording: &[f64]| calibrate(recording, QUICK_RATE, &QUICK, Drive::ASSUMED).unwrap().warnings;
    let is_clipped = |w: &CalibrationWarning| matches!(w, CalibrationWarning::Clipped { .. });
    let cut: Vec<f64> = recording.iter().map(|a| a.clamp(-2.0, 2.0)).collect();
    let warnings = of(&cut);
    assert!(warnings.iter().any(is_clipped), "{warnings:?}");
    assert!(warnings[0].to_string().contains("clipped at 2.000 m/s²"));
    // Clipped runs shorter than three samples are not detected.
    let n_cut = cut.iter().filter(|a| a.abs() == 2.0).count() as f64;
    let expected = n_cut / (QUICK.seconds * QUICK_RATE.0);
    let CalibrationWarning::Clipped { share, .. } = warnings[0] else { panic!("{warnings:?}") };
    assert!(share > 0.01 && (share / expected - 1.0).abs() < 0.05, "got {share}, expected {expected}");
    // A recording clipped at a tenth of that level is not a measurement.
    let low: Vec<f64> = recording.iter().map(|a| a.clamp(-0.2, 0.2)).collect();
    let fit = calibrate(&low, QUICK_RATE, &QUICK, Drive::ASSUMED).unwrap().fit;
    assert!(matches!(fit, Err(FitError::Clipped { share, .. }) if share > 0.05), "{fit:?}");
    // Quantization by a converter with few bits, at fine to coarse steps.
    for step in [1e-4, 1e-3, 0.01, 0.05] {
        let coarse: Vec<f64> = recording.iter().map(|a| (a / step).round() * step).collect();
        assert!(!of(&coarse).iter().any(is_clipped), "{step}");
    }
    // A wire instead of an actuator has constant amplitude.
    let flat = Bench::QUIET.record_as(&QUICK, |volts, _| volts.to_vec());
    let flat: Vec<f64> = flat.iter().map(|a| (a * 32_767.0).round() / 32_767.0).collect();
    assert!(!of(&flat).iter().any(is_clipped));
}

#[test]
fn a_part_of_a_sweep_is_used_as_far_as_it_goes() {
    let recording = Bench { noise_mps2: 0.005, ..Bench::QUIET }.record(&QUICK, &mark_ii());
    // From 1.5 s after the start of the sweep, and without the silence after it.
    let part = &recording[(3.0 * QUICK_RATE.0) as usize..(9.4 * QUICK_RATE.0) as usize];
    let calibration = calibrate(part, QUICK_RATE, &QUICK, Drive::ASSUMED).unwrap();
    check_fit(&calibration, &mark_ii(), [0.005, 0.02, 0.02]);
    assert!((calibration.begins_secs + 1.5).abs() < 0.05, "{}", calibration.begins_secs);
    let names: Vec<String> = calibration.warnings.iter().map(ToString::to_string).collect();
    assert!(names.iter().any(|w| w.contains("starts or ends within the sweep; only 24 to")), "{names:?}");
    assert!(names.iter().any(|w| w.contains("no silence around the sweep")), "{names:?}");
}

#[test]
fn what_is_no_recording_of_the_sweep_is_refused() {
    let of = |recording: &[f64], rate_hz| {
        calibrate(recording, Hertz(rate_hz), &QUICK, Drive::ASSUMED).unwrap_err()
    };
    let mut random = Random::new(3);
    let noise: Vec<f64> = (0..44_000).map(|_| random.normal()).collect();
    assert!(matches!(of(&noise, 4000.0), CalibrationError::NoSweep { .. }), "{}", of(&noise, 4000.0));
    let hum: Vec<f64> = (0..44_000).map(|i| (TAU * 0.015 * f64::from(i)).sin()).collect();
    assert!(matches!(of(&hum, 4000.0), CalibrationError::NoSweep { .. }), "{}", of(&hum, 4000.0));
    assert_eq!(of(&vec![9.81; 44_000], 4000.0), CalibrationError::Silent);
    assert!(matches!(of(&noise[..10_000], 4000.0), CalibrationError::Short { .. }));
    assert!(matches!(of(&noise[..5000], 150.0), CalibrationError::Rate { .. }));
    let mut broken = noise.clone();
    broken[77] = f64::NAN;
    assert_eq!(of(&broken, 4000.0), CalibrationError::NotFinite { index: 77 });
    // A sweep with other settings than the expected one.
    for seconds in [4.0, 6.5, 10.0, 16.0] {
        let other = Bench::QUIET.record(&Sweep { seconds, ..QUICK }, &mark_ii());
        assert!(
            matches!(of(&other, 4000.0), CalibrationError::NoSweep { .. }),
            "{seconds}: {}",
            of(&other, 4000.0)
        );
    }
    // The right sweep, far below the noise.
    let buried = Bench { noise_mps2: 200.0, ..Bench::QUIET }.record(&QUICK, &mark_ii());
    let error = of(&buried, 4000.0);
    assert!(matches!(error, CalibrationError::NoSweep { .. } | CalibrationError::Noisy { .. }), "{error}");
}

#[test]
fn a_resonance_that_is_not_there_is_not_made_up() {
    let fit = |bench: &Bench, of: &dyn Fn(&[f64], Hertz) -> Vec<f64>| {
        let recording = bench.record_as(&QUICK, of);
        calibrate(&recording, bench.rate, &QUICK, Drive::ASSUMED).unwrap().fit
    };
    let bench = Bench { noise_mps2: 0.002, ..Bench::QUIET };
    // A wire.
    let flat = fit(&bench, &|volts, _| volts.to_vec());
    assert!(matches!(flat, Err(FitError::NoResonance { .. })), "{flat:?}");
    assert!(flat.unwrap_err().to_string().contains("no resonance was found between 1"));
    // A response that only falls, and one that only rises.
    for high_hz in [40.0, 4000.0] {
        let first_order = fit(&bench, &|volts, rate| {
            let share = 1.0 - (-TAU * high_hz / rate.0).exp();
            let mut low = 0.0;
            let falling = volts.iter().map(|v| {
                low += share * (v - low);
                low
            });
            falling.collect()
        });
        assert!(matches!(first_order, Err(FitError::NoResonance { .. })), "{first_order:?}");
    }
    // A resonance above and one below the measured band.
    for hz in [5.0, 700.0] {
        let outside = fit(&bench, &|volts, rate| response(hz, 3.0, 1.0).drive(volts, rate));
        assert!(matches!(outside, Err(FitError::NoResonance { .. })), "{hz}: {outside:?}");
    }
    // Two resonances.
    let two = fit(&bench, &|volts, rate| {
        let (a, b) =
            (response(40.0, 25.0, 1.0).drive(volts, rate), response(300.0, 25.0, 1.0).drive(volts, rate));
        a.iter().zip(&b).map(|(a, b)| a + b).collect()
    });
    let is_told = match &two {
        Err(FitError::NoResonance { .. } | FitError::OtherShape { .. }) => true,
        Ok(fit) => fit.error_db > 2.0,
        Err(_) => false,
    };
    assert!(is_told, "{two:?}");
}

/// Gains of the reference at its sixteen frequencies (`vectors/b_act`); those up to 500 Hz are used.
fn golden_curve(key: &str) -> Vec<CurvePoint> {
    let golden: Value =
        serde_json::from_str(include_str!("../../../../../vectors/b_act/actuator_vectors.json")).unwrap();
    let numbers = |key: &str| -> Vec<f64> {
        golden[key].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
    };
    let points = numbers("freq").into_iter().zip(numbers(key));
    let point =
        |(hz, gain)| CurvePoint { frequency: Hertz(hz), gain_mps2_per_v: gain, noise_mps2_per_v: None };
    points.map(point).collect()
}

#[test]
fn the_gains_of_the_reference_give_its_figures() {
    let fit = fit_response(&golden_curve("mag_per_V_noL")).unwrap();
    let off = [
        fit.response.resonance().0 / 65.0,
        fit.response.q() / 4.086_340_698_080_68,
        fit.response.gain_mps2_per_v() / 2.133_938_563_687_484_4,
    ];
    // The search stops when a step no longer reduces the cost, which leaves half of the digits.
    assert!(off.iter().all(|ratio| (ratio - 1.0).abs() < 1e-6), "{off:?}");
    assert!(fit.error_db < 1e-5 && fit.n_points == 14, "{fit:?}");
    // The coil inductance, which the model omits, changes no parameter by more than 1 %.
    let with_coil = fit_response(&golden_curve("mag_per_V_L")).unwrap();
    for (a, b) in [
        (with_coil.response.resonance().0, fit.response.resonance().0),
        (with_coil.response.q(), fit.response.q()),
        (with_coil.response.gain_mps2_per_v(), fit.response.gain_mps2_per_v()),
    ] {
        assert!((a / b - 1.0).abs() < 0.01, "with inductance {a}, without {b}");
    }
}

/// Points of a response with relative errors of `share`, which are also reported as noise.
fn noisy_curve(response: &Response, share: f64, seed: u64) -> Vec<CurvePoint> {
    let mut random = Random::new(seed);
    let points = (0..130).map(|i| {
        let frequency = Hertz(12.0 * 2.0_f64.powf(f64::from(i) / 24.0));
        let gain = response.magnitude_at(frequency);
        CurvePoint {
            frequency,
            gain_mps2_per_v: gain * (share * std::f64::consts::FRAC_1_SQRT_2 * random.normal()).exp(),
            noise_mps2_per_v: Some(gain * share),
        }
    });
    points.collect()
}

#[test]
fn standard_errors_are_what_they_say() {
    let expected = response(80.0, 5.0, 2.0);
    let mut squares = [0.0; 3];
    let n = 200;
    for seed in 0..n {
        let fit = fit_response(&noisy_curve(&expected, 0.1, seed)).unwrap();
        let away = [
            (fit.response.resonance().0 - 80.0) / fit.resonance_error_hz,
            (fit.response.q() - 5.0) / fit.q_error,
            (fit.response.gain_mps2_per_v() - 2.0) / fit.gain_error_mps2_per_v,
        ];
        for (square, away) in squares.iter_mut().zip(away) {
            *square += away * away / n as f64;
        }
    }
    // Outliers with reduced weight make the estimated standard errors slightly too small.
    assert!(squares.iter().all(|square| (0.7..1.8).contains(square)), "{squares:?}");
}

#[test]
fn a_mode_of_the_case_has_no_say() {
    let expected = response(80.0, 5.0, 2.0);
    let mut curve = noisy_curve(&expected, 0.03, 5);
    for point in &mut curve {
        let away = (point.frequency.0 / 380.0).log2() / 0.08;
        point.gain_mps2_per_v *= 1.0 + 3.0 * (-away * away).exp();
    }
    let fit = fit_response(&curve).unwrap();
    assert!((fit.response.resonance().0 / 80.0 - 1.0).abs() < 0.005, "{fit:?}");
    assert!((fit.response.q() / 5.0 - 1.0).abs() < 0.03, "{fit:?}");
    assert!((fit.response.gain_mps2_per_v() / 2.0 - 1.0).abs() < 0.02, "{fit:?}");
}

#[test]
fn few_points_are_too_few() {
    let curve = noisy_curve(&mark_ii(), 0.01, 1);
    assert!(matches!(fit_response(&curve[..20]), Err(FitError::TooFew { n_points: 20, .. })));
    assert!(matches!(fit_response(&[]), Err(FitError::TooFew { n_points: 0, .. })));
}
