//! Result of a calibration: the profile and its summary.

use serde_json::json;
use shagreen_core::actuator::calibration::{Calibration, Fit};
use shagreen_core::actuator::{Actuator, Drive};
use shagreen_core::units::Kilograms;
use shagreen_formats::measured_profile::{CalibrationConditions, measured_profile};

use crate::cli::calibrate_args::Args;
use crate::cli::calibrate_recording::Recorded;
use crate::cli::output;

/// Returns the measured profile, with the data of an existing profile if one is given.
pub(crate) fn profile(args: &Args, file: &str, base: Option<Actuator>, fit: &Fit, drive: Drive) -> Actuator {
    let name = args
        .name
        .clone()
        .or_else(|| base.as_ref().map(|b| b.name.clone()))
        .unwrap_or("My actuator".to_owned());
    let how = CalibrationConditions {
        name,
        heard: file.to_owned(),
        load: args.load_g.map(Kilograms::from_g),
        drive,
        is_drive_assumed: args.full_scale_volts.is_none(),
    };
    measured_profile(base, fit, how)
}

/// Prints the result of a calibration.
pub(crate) fn print(
    args: &Args,
    recorded: &Recorded,
    calibration: &Calibration,
    fit: &Fit,
    (warnings, figures): (&[String], &[String]),
) {
    let response = fit.response;
    let (hz, q, gain) = (response.resonance().0, response.q(), response.gain_mps2_per_v());
    let curve = &calibration.curve;
    let worst = calibration.worst_distortion();
    output::print(
        args.json,
        &json!({
            "f0_hz": hz,
            "q": q,
            "gain": gain,
            "fit_error_db": fit.error_db,
            "f0_error_hz": fit.resonance_error_hz,
            "q_error": fit.q_error,
            "gain_error": fit.gain_error_mps2_per_v,
            "band_hz": [fit.band.0.0, fit.band.1.0],
            "full_scale_volts": args.full_scale_volts,
            "load_g": args.load_g,
            "channel": recorded.channel,
            "rate_hz": recorded.rate.0,
            "begins_s": calibration.begins_secs,
            "distortion_max": worst.as_ref().map(|w| json!({"share": w.share, "hz": w.frequency.0})),
            "curve": {
                "hz": curve.iter().map(|p| p.frequency.0).collect::<Vec<_>>(),
                "gain": curve.iter().map(|p| p.gain_mps2_per_v).collect::<Vec<_>>(),
                "noise": curve.iter().map(|p| p.noise_mps2_per_v).collect::<Vec<_>>(),
            },
            "warnings": warnings,
            "figures": figures,
            "out": args.out.as_ref().map(|out| out.display().to_string()),
        }),
        || {
            let mut lines = vec![format!(
                "Resonance {hz:.2} ± {:.2} Hz, Q {q:.3} ± {:.3}, gain {gain:.4} ± {:.4} (m/s²)/V (± standard error); fit error {:.2} dB rms",
                fit.resonance_error_hz, fit.q_error, fit.gain_error_mps2_per_v, fit.error_db
            )];
            if let Some(worst) = &worst {
                let (percent, at) = (100.0 * worst.share, worst.frequency.0);
                lines.push(format!("Harmonic distortion up to {percent:.1} % (at {at:.0} Hz)"));
            }
            lines.extend(args.out.iter().map(|out| out.display().to_string()));
            lines.extend_from_slice(figures);
            lines.join("\n")
        },
    );
}
