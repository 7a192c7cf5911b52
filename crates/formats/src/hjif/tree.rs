//! The tree of an `.hjif` file. Fields that the format lets out are `None` or empty; unknown fields are ignored.

mod channel;
mod device;
mod effect;

use serde::{Deserialize, Serialize};

pub use self::channel::{Band, BandType, Channel, CurveType, Direction, Target};
pub use self::device::{ActuatorType, ReferenceDevice};
pub use self::effect::{BaseSignal, Effect, EffectType, Keyframe};

/// A haptic experience: the whole file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Hjif {
    /// Edition of the standard, as a year from 2023 on, with the number of an amendment: "2023", "2023-1".
    pub version: String,
    /// Set of tools that a player needs.
    pub profile: Profile,
    /// Size that a player needs, 1 or 2.
    pub level: u32,
    /// Date of the file (ISO 8601).
    pub date: String,
    /// Description for people.
    pub description: String,
    /// Ticks per second; 1000 if there is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub timescale: Option<u32>,
    /// Body models.
    pub avatars: Vec<Avatar>,
    /// What is felt.
    pub perceptions: Vec<Perception>,
    /// Points at which a player can start.
    pub syncs: Vec<SyncPoint>,
}

/// Set of tools that a player needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Profile {
    /// All tools.
    Main,
    /// Neither wavelets nor composite effects; a timescale of 1000.
    #[serde(rename = "Simple Parametric")]
    SimpleParametric,
}

/// Point at which a player can start.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct SyncPoint {
    /// Time in ticks.
    pub timestamp: i32,
    /// Ticks per second; that of the file if there is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub timescale: Option<u32>,
}

/// Body model on which haptic effects lie.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Avatar {
    /// Identifier, unique and not 0, which stands for no avatar.
    pub id: i32,
    /// Level of detail.
    pub lod: i32,
    /// What the resolution of the model follows.
    #[serde(rename = "type")]
    pub kind: AvatarType,
    /// Address of the mesh of a custom model.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mesh: Option<String>,
}

/// What the resolution of a body model follows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum AvatarType {
    /// Sensitivity to vibration.
    Vibration,
    /// Sensitivity to pressure.
    Pressure,
    /// Sensitivity to temperature.
    Temperature,
    /// A mesh of the author.
    Custom,
}

/// Signals of one modality.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Perception {
    /// Identifier, unique in the file.
    pub id: i32,
    /// Avatar on which it lies; 0 for none.
    pub avatar_id: i32,
    /// Description for people.
    pub description: String,
    /// What is felt.
    pub perception_modality: Modality,
    /// Priority for players that cannot play everything; a lower number is more important.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub priority: Option<i32>,
    /// Positions are in 10 to this power of the unit of time or length; -3 if there is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unit_exponent: Option<i8>,
    /// Amplitudes are in 10 to this power of the unit of the modality; 0 if there is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub perception_unit_exponent: Option<i8>,
    /// Scheme of the semantic keywords; that of the standard if there is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub effect_semantic_scheme: Option<String>,
    /// Actuators that it was made for.
    #[serde(default)]
    pub reference_devices: Vec<ReferenceDevice>,
    /// Effects that bands refer to by their ids.
    pub effect_library: Vec<Effect>,
    /// Channels, which play together.
    pub channels: Vec<Channel>,
}

/// What is felt.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Modality {
    /// Pressure.
    Pressure,
    /// Acceleration.
    Acceleration,
    /// Velocity.
    Velocity,
    /// Position.
    Position,
    /// Temperature.
    Temperature,
    /// Vibration over time.
    Vibrotactile,
    /// Water.
    Water,
    /// Wind.
    Wind,
    /// Force.
    Force,
    /// Vibration of a tip that slides over a surface.
    #[serde(rename = "Vibrotactile Texture")]
    VibrotactileTexture,
    /// Force against a penetration.
    Stiffness,
    /// Force against sliding.
    Friction,
    /// Electric current on the skin.
    Electrotactile,
    /// Anything else.
    Other,
}
