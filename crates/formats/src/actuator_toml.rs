//! Actuator profiles, as TOML files.
//!
//! Every key carries its unit in its name. Files use grams and microhenries; values in memory use SI units. Unknown
//! quantities are omitted. An unknown key is an error, because its value would have no effect.
//!
//! ```
//! use shagreen_core::units::{Hertz, Kilograms};
//! use shagreen_formats::actuator_toml::{built_in_actuators, read_actuator, write_actuator};
//!
//! let mark_ii = built_in_actuators()?.remove(0);
//! assert_eq!(read_actuator(&write_actuator(&mark_ii))?, mark_ii);
//! let on_a_pen = mark_ii.at_load(Kilograms::from_g(40.0))?;
//! assert!(on_a_pen.response()?.resonance() > Hertz(65.0));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use serde::Deserialize;
use shagreen_core::actuator::{
    Actuator, ActuatorError, Calibrated, FrictionDisplay, Limits, Measured, NamedChannel, Physical, Response,
    USUAL_LOWEST, USUAL_THERMAL_SECS, validate,
};
use shagreen_core::units::{Hertz, Kilograms, Volts};

use crate::library::id_from_name;
use crate::toml_text::{self, quoted};

/// Value of the `format` key.
pub const FORMAT: &str = "shagreen-actuator";
/// Version of a profile without a friction display.
pub const VERSION: &str = "1.0";
/// Version of a profile with a friction display. Programs that read [`VERSION`] only would ignore the display.
pub const VERSION_WITH_FRICTION: &str = "1.1";
/// Version of a profile with named channels. Older programs would drive other channels.
pub const VERSION_WITH_CHANNELS: &str = "1.2";

/// The built-in profiles, in list order.
const BUILT_IN: [&str; 6] = [
    include_str!("../../../assets/actuators/haptuator-mark-ii.toml"),
    include_str!("../../../assets/actuators/haptuator-redesign.toml"),
    include_str!("../../../assets/actuators/alps-aft14a903a.toml"),
    include_str!("../../../assets/actuators/mm1c.toml"),
    include_str!("../../../assets/actuators/dualsense.toml"),
    include_str!("../../../assets/actuators/four-channels.toml"),
];

/// Why bytes are not an actuator profile.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ActuatorFileError {
    /// The file is not UTF-8.
    #[error("the actuator profile is not valid UTF-8 at byte {at}; save the file as UTF-8")]
    NotText {
        /// Offset of the first invalid byte, from zero.
        at: usize,
    },
    /// Not TOML, or a key is missing, unknown or of the wrong type.
    #[error("cannot read the actuator profile: {reason}; correct that line of the file")]
    Damaged {
        /// The parser's message with its line number, on one line.
        reason: String,
    },
    /// The file has another format.
    #[error(
        "the file is not an actuator profile: `format` is \"{found}\", not \"{FORMAT}\"; choose another file"
    )]
    Format {
        /// Value of the `format` key.
        found: String,
    },
    /// The file has an unsupported version.
    #[error(
        "the actuator profile has version {found}, but this program reads versions {VERSION} to \
         {VERSION_WITH_CHANNELS}; use a newer version of Shagreen"
    )]
    Version {
        /// Value of the `version` key.
        found: String,
    },
    /// The `id` key is not a valid identifier.
    #[error(
        "`id` is \"{id}\", which is not a valid identifier; use only lower-case letters, digits and hyphens"
    )]
    Id {
        /// Value of the `id` key.
        id: String,
    },
    /// A number is out of range.
    #[error("{0}; correct the actuator profile")]
    Number(#[from] ActuatorError),
}

#[derive(Deserialize)]
struct HeaderV1 {
    format: String,
    version: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ActuatorV1 {
    #[serde(rename = "format")]
    _format: String,
    #[serde(rename = "version")]
    _version: String,
    id: String,
    name: String,
    #[serde(default)]
    maker: String,
    source: String,
    #[serde(default)]
    licence: String,
    lowest_hz: Option<f64>,
    response: Option<ResponseV1>,
    #[serde(default)]
    limits: LimitsV1,
    #[serde(default)]
    physical: PhysicalV1,
    calibration: Option<CalibrationV1>,
    friction: Option<FrictionV1>,
    #[serde(default, rename = "channel")]
    channels: Vec<ChannelV1>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ChannelV1 {
    number: u16,
    name: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FrictionV1 {
    carrier_hz: f64,
    channel: u16,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ResponseV1 {
    load_g: Option<f64>,
    resonance_hz: f64,
    q: f64,
    gain_mps2_per_v: f64,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct LimitsV1 {
    rated_v_rms: Option<f64>,
    rated_a_rms: Option<f64>,
    peak_v: Option<f64>,
    thermal_time_s: Option<f64>,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct PhysicalV1 {
    moving_mass_g: Option<f64>,
    body_mass_g: Option<f64>,
    resistance_ohm: Option<f64>,
    inductance_uh: Option<f64>,
    force_factor_n_per_a: Option<f64>,
    stiffness_n_per_m: Option<f64>,
    damping_n_s_per_m: Option<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct CalibrationV1 {
    fit_error_db: f64,
    resonance_error_hz: f64,
    q_error: f64,
    gain_error_mps2_per_v: f64,
    full_scale_v: f64,
}

/// Reads an actuator profile.
///
/// # Errors
/// See [`ActuatorFileError`]; [`validate`] checks every number.
pub fn read_actuator(bytes: &[u8]) -> Result<Actuator, ActuatorFileError> {
    let text =
        std::str::from_utf8(bytes).map_err(|error| ActuatorFileError::NotText { at: error.valid_up_to() })?;
    let damaged =
        |error: toml::de::Error| ActuatorFileError::Damaged { reason: toml_text::reason(&error, text) };
    // The header is checked first: in a newer version, unknown keys are not an error.
    let header: HeaderV1 = toml::from_str(text).map_err(damaged)?;
    if header.format != FORMAT {
        return Err(ActuatorFileError::Format { found: header.format });
    }
    if ![VERSION, VERSION_WITH_FRICTION, VERSION_WITH_CHANNELS].contains(&header.version.as_str()) {
        return Err(ActuatorFileError::Version { found: header.version });
    }
    let wire: ActuatorV1 = toml::from_str(text).map_err(damaged)?;
    if wire.id.is_empty() || id_from_name(&wire.id) != wire.id {
        return Err(ActuatorFileError::Id { id: wire.id });
    }
    let actuator = actuator(wire)?;
    validate(&actuator)?;
    Ok(actuator)
}

/// Returns the built-in actuator profiles; the first has a frequency response.
///
/// # Errors
/// Fails only if an embedded file is damaged, which a test excludes.
pub fn built_in_actuators() -> Result<Vec<Actuator>, ActuatorFileError> {
    BUILT_IN.iter().map(|text| read_actuator(text.as_bytes())).collect()
}

/// A key with its number, if known.
type Entry = (&'static str, Option<f64>);

/// Serializes an actuator profile as TOML.
pub fn write_actuator(actuator: &Actuator) -> Vec<u8> {
    let volts = |volts: Option<Volts>| volts.map(|volts| volts.0);
    let grams = |mass: Option<Kilograms>| mass.map(|mass| exact(mass.0, 1e3, |g| Kilograms::from_g(g).0));
    let Actuator { measured, limits, physical, calibrated, .. } = actuator;
    let version = match (actuator.channels.is_empty(), actuator.friction) {
        (false, _) => VERSION_WITH_CHANNELS,
        (true, Some(_)) => VERSION_WITH_FRICTION,
        (true, None) => VERSION,
    };
    let mut lines = vec![format!("format = {}", quoted(FORMAT)), format!("version = {}", quoted(version))];
    let texts = [
        ("id", &actuator.id),
        ("name", &actuator.name),
        ("maker", &actuator.maker),
        ("source", &actuator.source),
        ("licence", &actuator.license),
    ];
    // A profile always has an id, a name and a source.
    let is_told = |(key, text): &(&str, &String)| !text.is_empty() || ["id", "name", "source"].contains(key);
    lines.extend(
        texts.iter().filter(|entry| is_told(entry)).map(|(key, text)| format!("{key} = {}", quoted(text))),
    );
    lines.push(format!("lowest_hz = {}", actuator.lowest.0));
    let response = measured.map(|Measured { response, load }| {
        [
            ("load_g", grams(load)),
            ("resonance_hz", Some(response.resonance().0)),
            ("q", Some(response.q())),
            ("gain_mps2_per_v", Some(response.gain_mps2_per_v())),
        ]
    });
    let limits = [
        ("rated_v_rms", volts(limits.rated_volts_rms)),
        ("rated_a_rms", limits.rated_amps_rms),
        ("peak_v", volts(limits.peak_volts)),
        ("thermal_time_s", Some(limits.thermal_secs)),
    ];
    let physical = [
        ("moving_mass_g", grams(physical.moving_mass)),
        ("body_mass_g", grams(physical.body_mass)),
        ("resistance_ohm", physical.resistance_ohm),
        ("inductance_uh", physical.inductance_h.map(|h| exact(h, 1e6, |uh| uh * 1e-6))),
        ("force_factor_n_per_a", physical.force_factor_n_per_a),
        ("stiffness_n_per_m", physical.stiffness_n_per_m),
        ("damping_n_s_per_m", physical.damping_n_s_per_m),
    ];
    let calibration = calibrated.map(|c| {
        [
            ("fit_error_db", Some(c.fit_error_db)),
            ("resonance_error_hz", Some(c.resonance_error_hz)),
            ("q_error", Some(c.q_error)),
            ("gain_error_mps2_per_v", Some(c.gain_error_mps2_per_v)),
            ("full_scale_v", Some(c.full_scale.0)),
        ]
    });
    let tables: [(&str, Vec<Entry>); 4] = [
        ("response", response.into_iter().flatten().collect()),
        ("limits", limits.to_vec()),
        ("physical", physical.to_vec()),
        ("calibration", calibration.into_iter().flatten().collect()),
    ];
    for (table, entries) in tables {
        let told: Vec<String> = entries
            .iter()
            .filter_map(|(key, value)| value.map(|value| format!("{key} = {value:?}")))
            .collect();
        if !told.is_empty() {
            lines.extend([String::new(), format!("[{table}]")]);
            lines.extend(told);
        }
    }
    if let Some(FrictionDisplay { carrier, channel }) = actuator.friction {
        let entries = [format!("carrier_hz = {:?}", carrier.0), format!("channel = {channel}")];
        lines.extend([String::new(), "[friction]".to_owned()]);
        lines.extend(entries);
    }
    for NamedChannel { number, name } in &actuator.channels {
        let entries = [format!("number = {number}"), format!("name = {}", quoted(name))];
        lines.extend([String::new(), "[[channel]]".to_owned()]);
        lines.extend(entries);
    }
    lines.push(String::new());
    lines.join("\n").into_bytes()
}

/// Converts an SI value to the unit of the file so that `back` restores it exactly. `per_si` is the number of file
/// units in one SI unit. Among the numbers near the product, it returns an exact one with the fewest digits.
fn exact(si: f64, per_si: f64, back: impl Fn(f64) -> f64) -> f64 {
    let product = si * per_si;
    let rounded = (0..=15).filter_map(|digits| format!("{product:.digits$e}").parse::<f64>().ok());
    rounded
        .chain([product, product.next_up(), product.next_down()])
        .find(|value| back(*value) == si)
        .unwrap_or(product)
}

fn actuator(wire: ActuatorV1) -> Result<Actuator, ActuatorError> {
    let kilograms = |g: Option<f64>| g.map(Kilograms::from_g);
    let measured = wire.response.map(|r| {
        let response = Response::new(Hertz(r.resonance_hz), r.q, r.gain_mps2_per_v)?;
        Ok(Measured { response, load: kilograms(r.load_g) })
    });
    Ok(Actuator {
        id: wire.id,
        name: wire.name,
        maker: wire.maker,
        source: wire.source,
        license: wire.licence,
        measured: measured.transpose()?,
        limits: Limits {
            rated_volts_rms: wire.limits.rated_v_rms.map(Volts),
            rated_amps_rms: wire.limits.rated_a_rms,
            peak_volts: wire.limits.peak_v.map(Volts),
            thermal_secs: wire.limits.thermal_time_s.unwrap_or(USUAL_THERMAL_SECS),
        },
        physical: Physical {
            moving_mass: kilograms(wire.physical.moving_mass_g),
            body_mass: kilograms(wire.physical.body_mass_g),
            resistance_ohm: wire.physical.resistance_ohm,
            inductance_h: wire.physical.inductance_uh.map(|uh| uh * 1e-6),
            force_factor_n_per_a: wire.physical.force_factor_n_per_a,
            stiffness_n_per_m: wire.physical.stiffness_n_per_m,
            damping_n_s_per_m: wire.physical.damping_n_s_per_m,
        },
        lowest: wire.lowest_hz.map_or(USUAL_LOWEST, Hertz),
        calibrated: wire.calibration.map(|c| Calibrated {
            fit_error_db: c.fit_error_db,
            resonance_error_hz: c.resonance_error_hz,
            q_error: c.q_error,
            gain_error_mps2_per_v: c.gain_error_mps2_per_v,
            full_scale: Volts(c.full_scale_v),
        }),
        friction: wire.friction.map(|f| FrictionDisplay { carrier: Hertz(f.carrier_hz), channel: f.channel }),
        channels: wire
            .channels
            .into_iter()
            .map(|channel| NamedChannel { number: channel.number, name: channel.name })
            .collect(),
    })
}

#[cfg(test)]
mod tests;
