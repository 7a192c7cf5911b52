//! Actuators that an `.hjif` file was made for.

use serde::{Deserialize, Serialize};

/// Actuator that a perception was made for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReferenceDevice {
    /// Identifier, unique in the perception.
    pub id: i32,
    /// Name.
    pub name: String,
    /// Parts of the body, one bit each.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub body_part_mask: Option<u32>,
    /// Highest frequency in Hz.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub maximum_frequency: Option<f64>,
    /// Lowest frequency in Hz.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub minimum_frequency: Option<f64>,
    /// Resonance frequency in Hz.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub resonance_frequency: Option<f64>,
    /// Largest amplitude, in the unit of the modality.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub maximum_amplitude: Option<f64>,
    /// Impedance in Ω.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub impedance: Option<f64>,
    /// Largest voltage in V.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub maximum_voltage: Option<f64>,
    /// Largest current in A.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub maximum_current: Option<f64>,
    /// Largest displacement.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub maximum_displacement: Option<f64>,
    /// Weight.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub weight: Option<f64>,
    /// Size.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub size: Option<f64>,
    /// A number of the author.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub custom: Option<f64>,
    /// Kind of actuator.
    #[serde(rename = "type", default, skip_serializing_if = "Option::is_none")]
    pub kind: Option<ActuatorType>,
}

/// Kind of actuator.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum ActuatorType {
    /// Linear resonant actuator.
    #[serde(rename = "LRA")]
    Lra,
    /// Voice coil actuator.
    #[serde(rename = "VCA")]
    Vca,
    /// Motor with an eccentric mass.
    #[serde(rename = "ERM")]
    Erm,
    /// Piezoelectric actuator.
    Piezo,
    /// Not known.
    Unknown,
}
