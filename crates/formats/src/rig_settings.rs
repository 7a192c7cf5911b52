//! What the program remembers of the machine around it: the output, the actuator on it, and the pen.

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

/// What is remembered; what is not is as on a first start.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RigSettings {
    /// The output that was chosen, by its id.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub output: Option<String>,
    /// Frames of the output's buffer.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub buffer_frames: Option<u32>,
    /// The only channel that is driven, counted from one; without it the first two.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub channel: Option<usize>,
    /// The actuator on the output.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub actuator: Option<ActuatorSettings>,
    /// Whether the actuator's response is undone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub equalizes: Option<bool>,
    /// Volts at the actuator when the output is at full scale.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub full_scale_volts: Option<f64>,
    /// Acceleration at full scale in m/s², where no actuator is known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub full_scale_mps2: Option<f64>,
    /// The pen that is read, by its id.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pen: Option<String>,
    /// From pressure to force, for pens that tell no force.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pressure: Option<PressureSettings>,
    /// Width and height of the pen's area in mm, for pens that do not tell it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pen_size_mm: Option<[f64; 2]>,
    /// What another version remembers.
    #[serde(flatten)]
    pub unknown: Map<String, Value>,
}

/// An actuator that was chosen.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ActuatorSettings {
    /// Its profile.
    #[serde(flatten)]
    pub profile: ProfileSettings,
    /// What it carries in g, where that is another load than its profile's.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub load_g: Option<f64>,
}

/// The profile of an actuator.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ProfileSettings {
    /// One of the program's, by its id.
    BuiltIn(String),
    /// One that was read or measured, as the text of its file: that may have moved, or there is none.
    Own(String),
}

/// A map from pressure to force.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PressureSettings {
    /// Force at which the tip is just felt, in N.
    pub activation_n: f64,
    /// Force at full pressure, in N.
    pub full_n: f64,
    /// Bend of the curve.
    pub bend: f64,
}
