//! Actuators named on the command line: built-in profiles or profile files.

use std::ops::RangeInclusive;
use std::path::Path;

use anyhow::{Context as _, bail};
use serde_json::{Value, json};
use shagreen_core::actuator::{Actuator, NamedChannel};
use shagreen_core::units::Kilograms;
use shagreen_formats::actuator_toml::{built_in_actuators, read_actuator};
use shagreen_formats::bounded_file::FileKind;

use shagreen_studio::file;

/// Returns the built-in actuator with this id or the actuator of this profile file, converted to the load `load_g` (in
/// g) if it is given.
pub(crate) fn load_actuator(name: &str, load_g: Option<f64>) -> anyhow::Result<Actuator> {
    let built_in = built_in_actuators()?;
    let actuator = if let Some(found) = built_in.iter().find(|actuator| actuator.id == name) {
        found.clone()
    } else if Path::new(name).exists() {
        let path = Path::new(name);
        read_actuator(&file::read_file(path, FileKind::Small)?).with_context(|| file::in_file(path))?
    } else {
        let ids: Vec<&str> = built_in.iter().map(|actuator| actuator.id.as_str()).collect();
        bail!(
            "\"{name}\" is neither a built-in actuator nor a file; give a profile file or a built-in actuator: {}",
            ids.join(", ")
        );
    };
    match load_g {
        None => Ok(actuator),
        Some(load_g) => Ok(actuator.at_load(Kilograms::from_g(load_g))?),
    }
}

/// Returns the JSON description of an actuator.
pub(crate) fn actuator_json(actuator: &Actuator) -> Value {
    let response = actuator.response().ok();
    let channel = |channel: &NamedChannel| json!({"number": channel.number, "name": channel.name});
    json!({
        "id": actuator.id,
        "name": actuator.name,
        "maker": actuator.maker,
        "source": actuator.source,
        "licence": actuator.license,
        "load_g": actuator.measured.and_then(|m| m.load).map(Kilograms::g),
        "f0_hz": response.map(|r| r.resonance().0),
        "q": response.map(|r| r.q()),
        "gain": response.map(|r| r.gain_mps2_per_v()),
        "lowest_hz": actuator.lowest.0,
        "fit_error_db": actuator.calibrated.map(|c| c.fit_error_db),
        "channels": actuator.channels.iter().map(channel).collect::<Vec<_>>(),
        "friction": actuator.friction.map(|f| json!({"carrier_hz": f.carrier.0, "channel": f.channel})),
    })
}

/// Valid loads of an actuator, in g.
const LOADS_G: RangeInclusive<f64> = 0.01..=100_000.0;

/// Parses a load in g.
pub(crate) fn grams(text: &str) -> Result<f64, String> {
    let (least, most) = (LOADS_G.start(), LOADS_G.end());
    let load_g = text.parse().ok().filter(|load_g| LOADS_G.contains(load_g)); // Other values are rejected below.
    load_g.ok_or_else(|| format!("it must be a mass in g from {least} to {most}"))
}

/// Parses a voltage in V, above zero.
pub(crate) fn volts(text: &str) -> Result<f64, String> {
    positive(text, "a voltage in V")
}

/// Parses a finite number above zero; `what` names it in the error.
pub(crate) fn positive(text: &str, what: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok().filter(|number| number.is_finite() && *number > 0.0);
    number.ok_or_else(|| format!("it must be {what} above 0"))
}
