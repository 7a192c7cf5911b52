//! Options and figures of fitting a texture model to recordings.

use serde_json::{Value, json};
use shagreen_core::recording::fit::{FitOptions, MODEL_RATES_HZ, TapFit};
use shagreen_core::texture::{Interpolation, MAX_ORDER};
use shagreen_core::units::Hertz;
use shagreen_core::words::counted;
use shagreen_device::synth::tap::REFERENCE_IMPACT_MPS;

/// Options of a fit.
#[derive(clap::Args)]
pub(crate) struct FitArgs {
    /// Model rate (sample rate of the model), in Hz. Default: selected from the bandwidth of the recordings.
    #[arg(long, value_name = "HZ", value_parser = parse_rate)]
    rate: Option<f64>,
    /// Model order (order of the linear predictor). Default: the lowest order that predicts held-out segments about as well as
    /// the best one; in recordings too short for that, selected by the Bayesian information criterion.
    #[arg(long, value_parser = clap::value_parser!(u8).range(1..=MAX_ORDER as i64))]
    order: Option<u8>,
    /// Interpolation of the model between the measured speeds and forces.
    #[arg(long, value_name = "MODE", value_parser = ["barycentric", "radial-basis"], default_value = "barycentric")]
    interpolation: String,
}

impl FitArgs {
    /// Returns the options of the fit.
    pub(crate) fn options(&self) -> FitOptions {
        FitOptions {
            rate: self.rate.map(Hertz),
            order: self.order.map(usize::from),
            interpolation: match self.interpolation.as_str() {
                "radial-basis" => Interpolation::RadialBasis,
                _ => Interpolation::Barycentric,
            },
        }
    }
}

/// Returns the figures of a fitted tap transient; null without one.
pub(crate) fn tap_json(tap: Option<&TapFit>) -> Value {
    tap.map_or(Value::Null, |fit| {
        json!({
            "frequency_hz": fit.tap.frequency.0,
            "decay_per_s": fit.tap.decay_per_sec,
            "amplitude_mps2": fit.tap.amplitude_mps2,
            "landings": fit.n_landings,
            "assumed_impact_mm_per_s": 1e3 * REFERENCE_IMPACT_MPS,
            "explained": fit.explained,
        })
    })
}

/// Describes a fitted tap transient, with the impact speed that is assumed because recordings do not state one.
pub(crate) fn tap_text(tap: &TapFit) -> String {
    format!(
        "tap transient of {:.0} Hz and {:.1} m/s² from {}, which are assumed to land at {:.0} mm/s; faster landings are played stronger",
        tap.tap.frequency.0,
        tap.tap.amplitude_mps2,
        counted(tap.n_landings, "landing"),
        1e3 * REFERENCE_IMPACT_MPS
    )
}

fn parse_rate(text: &str) -> Result<f64, String> {
    let rate = MODEL_RATES_HZ.into_iter().find(|rate| rate.to_string() == text);
    rate.ok_or_else(|| format!("it must be {} Hz", MODEL_RATES_HZ.map(|rate| rate.to_string()).join(" or ")))
}
