//! `shagreen actuator acf`: exports an actuator profile for players of `.haptic` clips.

use std::path::PathBuf;

use anyhow::bail;
use serde_json::json;
use shagreen_core::actuator::Drive;
use shagreen_core::units::Volts;
use shagreen_formats::acf::{AcfV1, acf, write_acf};
use shagreen_formats::atomic;

use crate::cli::actuator_source::{grams, load_actuator, volts};
use crate::cli::output;
use shagreen_studio::replace::{refuse_foreign, refuse_inputs};

/// Exports an actuator profile as an actuator configuration file (ACF) for players of .haptic clips.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Built-in actuator, by id, or a profile file.
    #[arg(value_name = "ID_OR_FILE")]
    actuator: String,
    /// Mass of the load on the actuator, in g, without the actuator itself. Default: the load at which the profile was
    /// measured.
    #[arg(long, value_name = "G", value_parser = grams)]
    load_g: Option<f64>,
    /// Peak voltage at the actuator when the player outputs digital full scale, in V.
    #[arg(long, value_name = "V", default_value = "1", value_parser = volts)]
    full_scale_volts: f64,
    /// File to write.
    #[arg(short, long, value_name = "OUT.acf")]
    out: PathBuf,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let actuator = load_actuator(&args.actuator, args.load_g)?;
    if args.out.as_os_str().is_empty() {
        bail!(output::Usage("--out is empty; give a file name".to_owned()));
    }
    refuse_inputs(&[&args.out], &[Some(args.actuator.as_ref())])?;
    refuse_foreign(&args.out, "the configuration", |bytes| serde_json::from_slice::<AcfV1>(bytes).is_ok())?;
    let made = acf(&actuator, Drive::new(Volts(args.full_scale_volts))?, output::CREATED_BY)?;
    atomic::write(&args.out, &write_acf(&made))?;
    let (continuous, out) = (&made.continuous, args.out.display().to_string());
    output::print(
        args.json,
        &json!({
            "out": out,
            "gain": continuous.gain,
            "emphasis_gain": made.emphasis.gain,
            "frequency_min_hz": continuous.frequency_min,
            "frequency_max_hz": continuous.frequency_max,
        }),
        || {
            format!(
                "Wrote the configuration of {}: {} to {} Hz, gain {:.3}\n{out}",
                actuator.name, continuous.frequency_min, continuous.frequency_max, continuous.gain
            )
        },
    );
    Ok(())
}
