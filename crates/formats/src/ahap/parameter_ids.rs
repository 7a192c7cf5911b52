//! Parameters of events, and controls of whole patterns, with their names in files and their ranges.

use std::ops::RangeInclusive;

/// Parameter of one event.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EventParameterId {
    /// Strength, 0 to 1.
    HapticIntensity,
    /// Sharpness, 0 to 1: higher values feel crisper.
    HapticSharpness,
    /// Time until the full strength, 0 to 1.
    AttackTime,
    /// Time until the strength falls, 0 to 1.
    DecayTime,
    /// Time after the end until silence, 0 to 1.
    ReleaseTime,
    /// Whether the strength stays until the end, 0 or 1.
    Sustained,
    /// Level of a sound, 0 to 1.
    AudioVolume,
    /// Pitch of a sound, -1 to 1.
    AudioPitch,
    /// Position of a sound from left to right, -1 to 1.
    AudioPan,
    /// High frequencies of a sound, 0 to 1.
    AudioBrightness,
}

/// Control that acts on all events of a pattern.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ControlId {
    /// Factor of all intensities, 0 to 1, neutral at 1.
    HapticIntensityControl,
    /// Added to all sharpnesses, -1 to 1.
    HapticSharpnessControl,
    /// Added to all attack times, -1 to 1.
    HapticAttackTimeControl,
    /// Added to all decay times, -1 to 1.
    HapticDecayTimeControl,
    /// Added to all release times, -1 to 1.
    HapticReleaseTimeControl,
    /// Factor of all levels of sounds, 0 to 1, neutral at 1.
    AudioVolumeControl,
    /// Added to all positions of sounds, -1 to 1.
    AudioPanControl,
    /// Added to the brightness of all sounds, -1 to 1.
    AudioBrightnessControl,
    /// Added to the pitch of all sounds, -1 to 1.
    AudioPitchControl,
    /// Added to the attack times of all sounds, -1 to 1.
    AudioAttackTimeControl,
    /// Added to the decay times of all sounds, -1 to 1.
    AudioDecayTimeControl,
    /// Added to the release times of all sounds, -1 to 1.
    AudioReleaseTimeControl,
}

impl EventParameterId {
    /// All parameters.
    pub const ALL: [Self; 10] = [
        Self::HapticIntensity,
        Self::HapticSharpness,
        Self::AttackTime,
        Self::DecayTime,
        Self::ReleaseTime,
        Self::Sustained,
        Self::AudioVolume,
        Self::AudioPitch,
        Self::AudioPan,
        Self::AudioBrightness,
    ];

    /// Name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::HapticIntensity => "HapticIntensity",
            Self::HapticSharpness => "HapticSharpness",
            Self::AttackTime => "AttackTime",
            Self::DecayTime => "DecayTime",
            Self::ReleaseTime => "ReleaseTime",
            Self::Sustained => "Sustained",
            Self::AudioVolume => "AudioVolume",
            Self::AudioPitch => "AudioPitch",
            Self::AudioPan => "AudioPan",
            Self::AudioBrightness => "AudioBrightness",
        }
    }

    /// Valid values.
    pub fn range(self) -> RangeInclusive<f64> {
        match self {
            Self::AudioPitch | Self::AudioPan => -1.0..=1.0,
            _ => 0.0..=1.0,
        }
    }

    /// The parameter with this name.
    pub(super) fn of(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|id| id.name() == name)
    }
}

impl ControlId {
    /// All controls.
    pub const ALL: [Self; 12] = [
        Self::HapticIntensityControl,
        Self::HapticSharpnessControl,
        Self::HapticAttackTimeControl,
        Self::HapticDecayTimeControl,
        Self::HapticReleaseTimeControl,
        Self::AudioVolumeControl,
        Self::AudioPanControl,
        Self::AudioBrightnessControl,
        Self::AudioPitchControl,
        Self::AudioAttackTimeControl,
        Self::AudioDecayTimeControl,
        Self::AudioReleaseTimeControl,
    ];

    /// Name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::HapticIntensityControl => "HapticIntensityControl",
            Self::HapticSharpnessControl => "HapticSharpnessControl",
            Self::HapticAttackTimeControl => "HapticAttackTimeControl",
            Self::HapticDecayTimeControl => "HapticDecayTimeControl",
            Self::HapticReleaseTimeControl => "HapticReleaseTimeControl",
            Self::AudioVolumeControl => "AudioVolumeControl",
            Self::AudioPanControl => "AudioPanControl",
            Self::AudioBrightnessControl => "AudioBrightnessControl",
            Self::AudioPitchControl => "AudioPitchControl",
            Self::AudioAttackTimeControl => "AudioAttackTimeControl",
            Self::AudioDecayTimeControl => "AudioDecayTimeControl",
            Self::AudioReleaseTimeControl => "AudioReleaseTimeControl",
        }
    }

    /// Valid values.
    pub fn range(self) -> RangeInclusive<f64> {
        match self {
            Self::HapticIntensityControl | Self::AudioVolumeControl => 0.0..=1.0,
            _ => -1.0..=1.0,
        }
    }

    /// Value without a curve.
    pub fn neutral(self) -> f64 {
        match self {
            Self::HapticIntensityControl | Self::AudioVolumeControl => 1.0,
            _ => 0.0,
        }
    }

    /// The control with this name.
    pub(super) fn of(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|id| id.name() == name)
    }
}
