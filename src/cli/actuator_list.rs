//! `shagreen actuator list`: lists the built-in profiles.

use serde_json::{Value, json};
use shagreen_formats::actuator_toml::built_in_actuators;

use crate::cli::actuator_source::actuator_json;
use crate::cli::output;

/// Lists the built-in actuator profiles.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let actuators = built_in_actuators()?;
    let listed: Vec<Value> = actuators.iter().map(actuator_json).collect();
    output::print(args.json, &json!({"actuators": listed}), || {
        let line = |actuator: &shagreen_core::actuator::Actuator| match actuator.response() {
            Ok(r) => format!(
                "{:20} {}: {:.1} Hz, Q {:.2}, {:.3} (m/s²)/V",
                actuator.id,
                actuator.name,
                r.resonance().0,
                r.q(),
                r.gain_mps2_per_v()
            ),
            Err(_) => format!("{:20} {}: response unknown; calibrate it", actuator.id, actuator.name),
        };
        actuators.iter().map(line).collect::<Vec<_>>().join("\n")
    });
    Ok(())
}
