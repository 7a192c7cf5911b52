//! `shagreen actuator show`: what is known of an actuator, and what follows from it.

use serde_json::json;
use shagreen_core::actuator::{inverse, inverse_gain_bound};
use shagreen_core::units::{Hertz, Kilograms};

use crate::cli::actuator_source::{actuator_json, grams, load_actuator};
use crate::cli::output;

/// The band of a texture that headroom is told for, in Hz.
const TEXTURE_HZ: [f64; 2] = [20.0, 400.0];
/// Share of its rate up to which a filter does what it was made after.
const FAITHFUL_SHARE: f64 = 0.1;

/// Shows a profile: its response on a load, what it bears, its headroom and the filter that makes up for it.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// A built-in actuator by its id, or a profile.
    #[arg(value_name = "ID_OR_FILE")]
    actuator: String,
    /// Mass of what it is fixed to, in g, without the actuator; without it, the load it was measured on.
    #[arg(long, value_name = "G", value_parser = grams)]
    load_g: Option<f64>,
    /// Rate of the output that the filter is for, in Hz.
    #[arg(long, value_name = "HZ", default_value_t = 48_000, value_parser = clap::value_parser!(u32).range(1..))]
    rate: u32,
    /// Print one JSON object.
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
        Err(_) => (None, None), // Told as such.
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
            Err(_) => "No response is known: calibrate it.".to_owned(),
            Ok(response) => {
                let load = actuator.measured.and_then(|m| m.load);
                let load = load.map_or("an unknown load".to_owned(), |load| format!("{:.3} g", load.g()));
                format!(
                    "On {load}: resonance {:.2} Hz, Q {:.3}, {:.4} (m/s²)/V far above it",
                    response.resonance().0,
                    response.q(),
                    response.gain_mps2_per_v()
                )
            }
        });
        if let Some(headroom) = headroom {
            let rated =
                headroom.rated_mps2.map_or(String::new(), |r| format!("; it bears {r:.2} m/s² rms for ever"));
            let [low, high] = TEXTURE_HZ;
            lines.push(format!(
                "A flat texture of {low} to {high} Hz takes {:.3} V rms for 1 m/s² rms{rated}",
                headroom.volts_per_mps2
            ));
        }
        if let Some(gain_bound) = gain_bound {
            let [low, high] = band_hz;
            lines.push(format!(
                "Equalizer at {rate_hz} Hz: with it flat from {low} Hz, where it is 3 dB down, to {high} Hz; never more than {gain_bound:.3} V for 1 m/s²"
            ));
        }
        lines.push(actuator.source.clone());
        lines.join("\n")
    });
    Ok(())
}
