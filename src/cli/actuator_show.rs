//! `shagreen actuator show`: shows a profile and the quantities derived from it.

use serde_json::json;
use shagreen_core::actuator::{inverse, inverse_gain_bound};
use shagreen_core::units::{Hertz, Kilograms};

use crate::cli::actuator_source::{actuator_json, grams, load_actuator};
use crate::cli::output;

/// Frequency band for which the headroom is computed, in Hz.
const TEXTURE_HZ: [f64; 2] = [20.0, 400.0];
/// Fraction of the sample rate up to which the digital filter matches its analog prototype.
const FAITHFUL_SHARE: f64 = 0.1;

/// Shows an actuator profile: frequency response with its load, drive voltage, continuous rating, and the inverse
/// filter (equalizer) that flattens the response. --json adds electrical limits and physical parameters.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Built-in actuator, by id, or a profile file.
    #[arg(value_name = "ID_OR_FILE")]
    actuator: String,
    /// Mass of the load on the actuator, in g, without the actuator itself. Default: the load at which the profile was
    /// measured.
    #[arg(long, value_name = "G", value_parser = grams)]
    load_g: Option<f64>,
    /// Sample rate of the inverse filter, in Hz.
    #[arg(long, value_name = "HZ", default_value_t = 48_000, value_parser = clap::value_parser!(u32).range(1..))]
    rate: u32,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let actuator = load_actuator(&args.actuator, args.load_g)?;
    let (limits, physical) = (actuator.limits, actuator.physical);
    let headroom = actuator.headroom(Hertz(TEXTURE_HZ[0]), Hertz(TEXTURE_HZ[1])).ok();
    let rate_hz = f64::from(args.rate);
    let (filter, gain_bound) = match actuator.response() {
        Ok(response) => {
            let filter = inverse(&response, actuator.lowest, Hertz(rate_hz))?;
            (Some(filter), Some(inverse_gain_bound(&response, actuator.lowest)))
        }
        Err(_) => (None, None), // Reported as unknown.
    };
    let band_hz = [actuator.lowest.0, FAITHFUL_SHARE * rate_hz];
    let mut result = actuator_json(&actuator);
    result["limits"] = json!({
        "rated_v_rms": limits.rated_volts_rms.map(|v| v.0),
        "rated_a_rms": limits.rated_amps_rms,
        "peak_v": limits.peak_volts.map(|v| v.0),
        "thermal_time_s": limits.thermal_secs,
    });
    result["physical"] = json!({
        "moving_mass_g": physical.moving_mass.map(Kilograms::g),
        "body_mass_g": physical.body_mass.map(Kilograms::g),
        "resistance_ohm": physical.resistance_ohm,
        "inductance_uh": physical.inductance_h.map(|h| 1e6 * h),
        "force_factor_n_per_a": physical.force_factor_n_per_a,
        "stiffness_n_per_m": physical.stiffness_n_per_m,
        "damping_n_s_per_m": physical.damping_n_s_per_m,
    });
    result["headroom"] = json!({
        "band_hz": TEXTURE_HZ,
        "volts_per_mps2": headroom.map(|h| h.volts_per_mps2),
        "rated_mps2": headroom.and_then(|h| h.rated_mps2),
    });
    result["inverse"] = json!({
        "rate_hz": args.rate,
        "lowest_hz": actuator.lowest.0,
        "band_hz": filter.map(|_| band_hz),
        "volts_per_mps2_max": gain_bound,
        "b": filter.map(|f| f.b),
        "a": filter.map(|f| f.a),
    });
    output::print(args.json, &result, || {
        let mut lines = vec![format!("{} ({})", actuator.name, actuator.id)];
        lines.push(match actuator.response() {
            Err(_) => "Response unknown: calibrate the actuator.".to_owned(),
            Ok(response) => {
                let load = actuator.measured.and_then(|m| m.load);
                let load =
                    load.map_or("an unknown load".to_owned(), |load| format!("a load of {:.3} g", load.g()));
                format!(
                    "With {load}: resonance {:.2} Hz, Q {:.3}, gain {:.4} (m/s²)/V far above resonance",
                    response.resonance().0,
                    response.q(),
                    response.gain_mps2_per_v()
                )
            }
        });
        if let Some(headroom) = headroom {
            let rated =
                headroom.rated_mps2.map_or(String::new(), |r| format!("; continuous rating {r:.2} m/s² rms"));
            let [low, high] = TEXTURE_HZ;
            lines.push(format!(
                "A flat spectrum from {low} to {high} Hz needs {:.3} V rms for 1 m/s² rms{rated}",
                headroom.volts_per_mps2
            ));
        }
        if let Some(gain_bound) = gain_bound {
            let [low, high] = band_hz;
            lines.push(format!(
                "Equalizer at {rate_hz} Hz: flat response from {low} Hz (3 dB down) to {high} Hz; gain at most {gain_bound:.3} V per m/s²"
            ));
        }
        if let Some(display) = actuator.friction {
            let (carrier_hz, channel) = (display.carrier.0, display.channel);
            lines.push(format!("Friction display: carrier of {carrier_hz} Hz on channel {channel}"));
        }
        if !actuator.channels.is_empty() {
            let channels =
                actuator.channels.iter().map(|channel| format!("{} {}", channel.number, channel.name));
            lines.push(format!("Channels: {}", channels.collect::<Vec<_>>().join(", ")));
        }
        lines.push(actuator.source.clone());
        lines.join("\n")
    });
    Ok(())
}
