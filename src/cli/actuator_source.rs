//! Actuators that a command line names: built-in profiles, or files.

use std::ops::RangeInclusive;
use std::path::Path;

use anyhow::{Context as _, bail};
use serde_json::{Value, json};
use shagreen_core::actuator::Actuator;
use shagreen_core::units::Kilograms;
use shagreen_formats::actuator_toml::{built_in_actuators, read_actuator};

use crate::cli::output;

/// The profile of a built-in actuator, or in a file, on another load where one is given.
pub(crate) fn load_actuator(name: &str, load_g: Option<f64>) -> anyhow::Result<Actuator> {
    let built_in = built_in_actuators()?;
    let actuator = if let Some(found) = built_in.iter().find(|actuator| actuator.id == name) {
        found.clone()
    } else if Path::new(name).exists() {
        let path = Path::new(name);
        read_actuator(&output::read_file(path)?).with_context(|| output::in_file(path))?
    } else {
        let ids: Vec<&str> = built_in.iter().map(|actuator| actuator.id.as_str()).collect();
        bail!("there is no actuator and no file \"{name}\"; the actuators are {}", ids.join(", "));
    };
    match load_g {
        None => Ok(actuator),
        Some(load_g) => Ok(actuator.at_load(Kilograms::from_g(load_g))?),
    }
}

/// What lists and pages say of an actuator.
pub(crate) fn actuator_json(actuator: &Actuator) -> Value {
    let response = actuator.response().ok();
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
    })
}

/// Loads that can hang on an actuator, in g.
const LOADS_G: RangeInclusive<f64> = 0.01..=100_000.0;

/// A load in g on the command line.
pub(crate) fn grams(text: &str) -> Result<f64, String> {
    let (least, most) = (LOADS_G.start(), LOADS_G.end());
    let load_g = text.parse().ok().filter(|load_g| LOADS_G.contains(load_g)); // Anything else is said below.
    load_g.ok_or_else(|| format!("needs a mass in g from {least} to {most}"))
}

/// A voltage in V on the command line.
pub(crate) fn volts(text: &str) -> Result<f64, String> {
    positive(text, "a voltage in V")
}

/// A number above zero on the command line.
pub(crate) fn positive(text: &str, what: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok().filter(|number| number.is_finite() && *number > 0.0);
    number.ok_or_else(|| format!("needs {what} above 0"))
}
