//! Signal that the program sends to a sound server, recorded from the monitor of a null sink and compared with the
//! spectrum of the model.
#![cfg(target_os = "linux")]

use crate::guard::have;
use crate::sound::{RATE_HZ, SoundServer, shagreen};
use shagreen_core::dsp::spectrum::{rms, third_octave_centers, welch};
use shagreen_core::units::Hertz;

/// Acceleration at full scale, as given on the command line.
const FULL_SCALE_MPS2: f64 = 20.0;

/// Returns the power in the third of an octave around `center`, from a density at evenly spaced frequencies.
fn band_power(density: &[(f64, f64)], center: Hertz) -> f64 {
    let (low, high) = (center.0 * 2.0_f64.powf(-1.0 / 6.0), center.0 * 2.0_f64.powf(1.0 / 6.0));
    let step = density[1].0 - density[0].0;
    // A bin contributes in proportion to its overlap with the band.
    let share = |f: f64| ((f + step / 2.0).min(high) - (f - step / 2.0).max(low)).clamp(0.0, step);
    density.iter().map(|(f, p)| p * share(*f)).sum()
}

/// Checks that every third-octave band from 30 to 400 Hz is within 1.5 dB, and returns the first that is not.
fn compare(recorded_mps2: &[f64], model: &[(f64, f64)]) -> Result<(), String> {
    // The signal ends at 500 Hz and its images are 65 dB lower, so every 24th sample is sufficient.
    let thinned: Vec<f64> = recorded_mps2.iter().step_by(24).copied().collect();
    let density: Vec<(f64, f64)> =
        welch(&thinned, Hertz(RATE_HZ / 24.0), 2048).into_iter().map(|(f, p)| (f.0, p)).collect();
    for center in third_octave_centers(Hertz(30.0), Hertz(400.0)) {
        let error_db = 10.0 * (band_power(&density, center) / band_power(model, center)).log10();
        println!("{:6.1} Hz: {error_db:+.2} dB", center.0);
        if error_db.abs() > 1.5 {
            return Err(format!("{:.1} Hz is off by {error_db:.2} dB", center.0));
        }
    }
    Ok(())
}

#[test]
fn the_sink_gets_the_spectrum_of_the_model() {
    if !have(&["pulseaudio", "pactl", "parec"]) {
        return;
    }
    let server = SoundServer::new();
    let condition = ["--at", "40,60", "--speed", "100", "--force", "1"];
    let mut played = serde_json::Value::Null;
    let recorded = server.record(|server| {
        let rest = ["--seconds", "24", "--output", "alsa:default", "--full-scale", "20"];
        played = shagreen(server, &[&["play"], &condition[..], &rest[..]].concat());
    });
    println!("{played}");
    assert_eq!(played["limited"], 0, "the limiter would change the spectrum");
    assert!(recorded.iter().all(|f| f[0] == f[1]), "both channels carry the signal");

    // From the first to the last audible sample, without half a second at either end.
    let sounds = |f: &[f64; 2]| f[0].abs() > 1e-4;
    let (first, last) =
        (recorded.iter().position(sounds).unwrap(), recorded.iter().rposition(sounds).unwrap());
    let margin = RATE_HZ as usize / 2;
    let signal: Vec<f64> =
        recorded[first + margin..last - margin].iter().map(|f| f[0] * FULL_SCALE_MPS2).collect();
    let seconds = signal.len() as f64 / RATE_HZ;
    assert!(seconds > 21.0, "only {seconds} s were recorded");
    // After the stroke the output is silent.
    assert!(recorded[last + 1..].iter().all(|f| *f == [0.0; 2] || f[0].abs() <= 1e-4));

    let psd = shagreen(&server, &[&["texture", "psd"], &condition[..], &["--bins", "2000"]].concat());
    let list = |name: &str| -> Vec<f64> {
        psd[name].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
    };
    let model: Vec<(f64, f64)> = list("hz").into_iter().zip(list("psd")).collect();
    compare(&signal, &model).unwrap();
    let level_db = 20.0 * (rms(&signal) / psd["rms"].as_f64().unwrap()).log10();
    assert!(level_db.abs() < 1.0, "level off by {level_db} dB");

    // Negative control: the comparison detects one band that is 3 dB too strong.
    let wrong: Vec<(f64, f64)> =
        model.iter().map(|(f, p)| (*f, if (110.0..142.0).contains(f) { p / 2.0 } else { *p })).collect();
    assert!(compare(&signal, &wrong).is_err());
}
