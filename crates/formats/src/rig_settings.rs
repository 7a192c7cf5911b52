//! Saved device setup: the output, its actuator, and the pen.

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

/// The saved device setup; missing values take their defaults.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RigSettings {
    /// Id of the selected output.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub output: Option<String>,
    /// Buffer size of the output, in frames.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub buffer_frames: Option<u32>,
    /// The only driven channel, from one; `None` drives the first two.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub channel: Option<usize>,
    /// The actuator on the output.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub actuator: Option<ActuatorSettings>,
    /// Whether the actuator's frequency response is equalized.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub equalizes: Option<bool>,
    /// Voltage at the actuator at digital full scale, in V.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub full_scale_volts: Option<f64>,
    /// Acceleration at full scale in m/s², if the actuator is unknown.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub full_scale_mps2: Option<f64>,
    /// Id of the selected pen, `auto` for the best one, `window` for none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pen: Option<String>,
    /// Pressure-to-force map, for pens that do not report force.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pressure: Option<PressureSettings>,
    /// Width and height of the pen's area in mm, for pens that do not report it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pen_size_mm: Option<[f64; 2]>,
    /// Fields of other versions.
    #[serde(flatten)]
    pub unknown: Map<String, Value>,
}

/// A selected actuator.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ActuatorSettings {
    /// Its profile.
    #[serde(flatten)]
    pub profile: ProfileSettings,
    /// Mass of the load in g, if it differs from that of the profile.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub load_g: Option<f64>,
}

/// The profile of an actuator.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ProfileSettings {
    /// Identifier of a built-in profile.
    BuiltIn(String),
    /// Text of an imported or measured profile, because its file may have moved or may not exist.
    Own(String),
}

/// A map from pressure to force.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PressureSettings {
    /// Force in N at which the tip is just detected.
    pub activation_n: f64,
    /// Force at full pressure, in N.
    pub full_n: f64,
    /// Curvature of the map.
    pub bend: f64,
}
