use super::fit_tap_transients;
use crate::maths::rng::lcg_noise;
use crate::recording::Recording;
use crate::texture::tap::Tap;
use crate::units::Hertz;

/// Simulated recording of six taps, after each of which the tip rests, on a surface with the tap transient `tap`.
fn landing_recording(tap: Tap, rate_hz: f64, noise_mps2: f64) -> Recording {
    let n = (6.0 * rate_hz) as usize;
    let noise = lcg_noise(n, 4);
    let mut acceleration_mps2: Vec<f64> = noise.iter().map(|e| 9.81 + noise_mps2 * e).collect();
    let mut force_n = vec![0.0; n];
    for k in 0..6 {
        // Contact times are not at samples, and each tap is harder than the one before.
        let start_secs = 0.4 + f64::from(k) + 0.000_37;
        let strength = 1.0 + 0.1 * f64::from(k);
        for i in 0..n {
            let t = i as f64 / rate_hz - start_secs;
            acceleration_mps2[i] += strength * tap.at(t);
            if (0.0..0.5).contains(&t) {
                force_n[i] = (t / 0.01).min(1.0);
            }
        }
    }
    Recording {
        rate: Hertz(rate_hz),
        acceleration_mps2,
        speed_mps: vec![0.0; n],
        force_n,
        usable: std::iter::once(0..n).collect(),
    }
}

#[track_caller]
fn check(frequency_hz: f64, decay_per_sec: f64, rate_hz: f64) {
    let tap = Tap { frequency: Hertz(frequency_hz), decay_per_sec, amplitude_mps2: 8.0 };
    let landed = fit_tap_transients(&[landing_recording(tap, rate_hz, 0.1)]).unwrap();
    let got = landed.tap;
    assert_eq!(landed.n_landings, 6, "{landed:?}");
    assert!(landed.explained > 0.9, "{landed:?}");
    assert!((got.frequency.0 / frequency_hz - 1.0).abs() < 0.04, "{landed:?}");
    assert!((got.decay_per_sec / decay_per_sec - 1.0).abs() < 0.15, "{landed:?}");
    // The mean of the six amplitudes is a quarter above the first.
    assert!((got.amplitude_mps2 / 10.0 - 1.0).abs() < 0.15, "{landed:?}");
}

#[test]
fn materials_of_the_literature_come_back() {
    for rate_hz in [1000.0, 3000.0, 10_000.0] {
        // Rubber, wood and aluminum from Okamura and others 2001.
        check(18.0, 60.0, rate_hz);
        check(100.0, 80.0, rate_hz);
        check(300.0, 90.0, rate_hz);
    }
}

#[test]
fn gentle_landings_are_found() {
    let tap = Tap { frequency: Hertz(120.0), decay_per_sec: 80.0, amplitude_mps2: 4.0 };
    for newtons_per_sec in [0.5, 1.0, 1.5] {
        let mut gentle = landing_recording(tap, 1000.0, 0.05);
        let noise = lcg_noise(6000, 7);
        for (i, force_n) in gentle.force_n.iter_mut().enumerate() {
            // Contact starts 0.4 s into every second and lasts half a second.
            let t = i as f64 / 1000.0 % 1.0 - 0.4;
            *force_n = if (0.0..0.5).contains(&t) { newtons_per_sec * t } else { 0.0 };
            *force_n += 0.003 * noise[i];
        }
        let landed = fit_tap_transients(&[gentle]).unwrap();
        assert!(landed.n_landings >= 5 && landed.explained > 0.9, "{newtons_per_sec} N/s: {landed:?}");
        assert!((landed.tap.frequency.0 / 120.0 - 1.0).abs() < 0.02, "{landed:?}");
    }
}

#[test]
fn without_a_landing_there_is_none() {
    let tap = Tap { frequency: Hertz(100.0), decay_per_sec: 80.0, amplitude_mps2: 8.0 };
    assert_eq!(fit_tap_transients(&[]), None);
    // No tap transient in the acceleration.
    let still = Tap { amplitude_mps2: 0.0, ..tap };
    assert_eq!(fit_tap_transients(&[landing_recording(still, 1000.0, 0.1)]), None);
    // The force is never zero before a contact.
    let mut pressed = landing_recording(tap, 1000.0, 0.1);
    pressed.force_n.fill(1.0);
    assert_eq!(fit_tap_transients(&[pressed]), None);
}

#[test]
fn noise_is_not_explained() {
    // Noise bursts at every contact: the best sinusoid explains little of their energy.
    let tap = Tap { frequency: Hertz(100.0), decay_per_sec: 80.0, amplitude_mps2: 0.0 };
    let mut bursts = landing_recording(tap, 1000.0, 0.01);
    let noise = lcg_noise(6000, 9);
    for (i, a) in bursts.acceleration_mps2.iter_mut().enumerate() {
        if bursts.force_n[i] > 0.0 {
            *a += 3.0 * noise[i];
        }
    }
    let landed = fit_tap_transients(&[bursts]).unwrap();
    assert!(landed.explained < 0.4, "{landed:?}");
}
