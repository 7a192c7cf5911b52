//! Effects and keyframes of an `.hjif` file.

use serde::{Deserialize, Serialize};

/// Effect of a band or of the library of a perception.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Effect {
    /// Whether it has keyframes of its own.
    pub effect_type: EffectType,
    /// Identifier: its own in a library, that of the library for a reference.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub id: Option<i32>,
    /// Begin in ticks.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub position: Option<i32>,
    /// Phase of the base signal at the begin, in rad.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub phase: Option<f64>,
    /// Waveform that is modulated.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub base_signal: Option<BaseSignal>,
    /// Category and name of what it stands for, such as "Texture/Wood".
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub semantic_keywords: Option<String>,
    /// Points of amplitude and frequency, in the order of their positions.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub keyframes: Vec<Keyframe>,
    /// Coefficients of a block of wavelets, in base64.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wavelet_stream: Option<String>,
}

/// Whether an effect has keyframes of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum EffectType {
    /// Its own keyframes.
    Basis,
    /// Those of an effect of the library.
    Reference,
    /// Several effects.
    Composite,
}

/// Waveform that is modulated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum BaseSignal {
    /// Sine.
    Sine,
    /// Square wave.
    Square,
    /// Triangle wave.
    Triangle,
    /// Saw tooth that rises slowly.
    SawToothUp,
    /// Saw tooth that falls slowly.
    SawToothDown,
}

/// Point of an effect.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Keyframe {
    /// Position from the begin of the effect, in ticks.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub relative_position: Option<i32>,
    /// Amplitude, -1 to 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub amplitude_modulation: Option<f64>,
    /// Frequency in Hz.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frequency_modulation: Option<i32>,
}
