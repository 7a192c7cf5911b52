//! Channels and bands of an `.hjif` file.

use serde::{Deserialize, Serialize};

use crate::hjif::tree::effect::Effect;

/// Signal of one actuator or one point of the body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Channel {
    /// Identifier, unique in the perception.
    pub id: i32,
    /// Description for people.
    pub description: String,
    /// Factor of all amplitudes.
    pub gain: f64,
    /// Weight when channels are mixed.
    pub mixing_coefficient: f64,
    /// Parts of the body, one bit each; 0 for none in particular.
    pub body_part_mask: u32,
    /// Priority for players that cannot play everything; a lower number is more important.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub priority: Option<i32>,
    /// Reference device that it was made for, by id.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reference_device_id: Option<i32>,
    /// Sample rate in Hz of the signal that it was made from.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frequency_sampling: Option<u32>,
    /// Number of samples of that signal.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sample_count: Option<u32>,
    /// Direction of the signal.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub direction: Option<Direction>,
    /// Number of actuators along each axis.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub actuator_resolution: Option<Target>,
    /// Names of parts of the body.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub body_part_target: Vec<String>,
    /// Positions among the actuators.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub actuator_target: Vec<Target>,
    /// Vertices of the mesh of the avatar.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub vertices: Vec<i32>,
    /// Parts of the spectrum, which are added.
    pub bands: Vec<Band>,
}

/// Direction as a unit vector, in steps of 1/127.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "UPPERCASE")]
pub struct Direction {
    /// Part along x.
    pub x: i8,
    /// Part along y.
    pub y: i8,
    /// Part along z.
    pub z: i8,
}

/// Position or number along each axis of an array of actuators.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "UPPERCASE")]
pub struct Target {
    /// Along x.
    pub x: i32,
    /// Along y.
    pub y: i32,
    /// Along z.
    pub z: i32,
}

/// Part of the spectrum of a channel.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Band {
    /// How effects become a signal.
    pub band_type: BandType,
    /// Interpolation between keyframes, for bands of curves only.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub curve_type: Option<CurveType>,
    /// Samples of a block, for bands of wavelets only; a power of two.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub block_length: Option<i32>,
    /// Lowest frequency in Hz.
    pub lower_frequency_limit: i32,
    /// Highest frequency in Hz.
    pub upper_frequency_limit: i32,
    /// Priority for players that cannot play everything; a lower number is more important.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub priority: Option<i32>,
    /// Effects in the order of their positions.
    pub effects: Vec<Effect>,
}

/// How effects become a signal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum BandType {
    /// Short bursts.
    Transient,
    /// A curve through the amplitudes.
    Curve,
    /// Sines whose amplitude and frequency are interpolated.
    VectorialWave,
    /// Blocks of wavelet coefficients.
    WaveletWave,
}

/// Interpolation between keyframes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum CurveType {
    /// Not known.
    Unknown,
    /// Cubic polynomials.
    Cubic,
    /// Straight lines.
    Linear,
    /// The method of Akima.
    Akima,
    /// Bézier curves.
    Bezier,
    /// B-splines.
    #[serde(rename = "B-spline")]
    BSpline,
}
