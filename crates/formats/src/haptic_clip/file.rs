//! The fields of a `.haptic` file.

use serde::{Deserialize, Serialize};

use super::{AmplitudePoint, CLIP_VERSION, ClipMetadata, Emphasis, FrequencyPoint, HapticClip};

/// The part of a file of any version that states the version.
#[derive(Deserialize)]
pub(super) struct VersionFileV1 {
    version: VersionV1,
}

impl VersionFileV1 {
    pub(super) fn major(&self) -> u32 {
        self.version.major
    }
}

/// A whole file.
#[derive(Serialize, Deserialize)]
pub(super) struct ClipFileV1 {
    version: VersionV1,
    #[serde(default)]
    metadata: MetadataV1,
    signals: SignalsV1,
}

#[derive(Serialize, Deserialize)]
struct VersionV1 {
    major: u32,
    #[serde(default)]
    minor: u32,
    #[serde(default)]
    patch: u32,
}

#[derive(Default, Serialize, Deserialize)]
#[serde(default)]
struct MetadataV1 {
    editor: String,
    author: String,
    source: String,
    project: String,
    tags: Vec<String>,
    description: String,
}

#[derive(Serialize, Deserialize)]
struct SignalsV1 {
    continuous: ContinuousV1,
}

#[derive(Serialize, Deserialize)]
struct ContinuousV1 {
    envelopes: EnvelopesV1,
}

#[derive(Serialize, Deserialize)]
struct EnvelopesV1 {
    amplitude: Vec<AmplitudeV1>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    frequency: Option<Vec<FrequencyV1>>,
}

#[derive(Serialize, Deserialize)]
struct AmplitudeV1 {
    time: f64,
    amplitude: f64,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    emphasis: Option<EmphasisV1>,
}

#[derive(Serialize, Deserialize)]
struct EmphasisV1 {
    amplitude: f64,
    frequency: f64,
}

#[derive(Serialize, Deserialize)]
struct FrequencyV1 {
    time: f64,
    frequency: f64,
}

impl From<ClipFileV1> for HapticClip {
    fn from(file: ClipFileV1) -> Self {
        let MetadataV1 { editor, author, source, project, tags, description } = file.metadata;
        let EnvelopesV1 { amplitude: amplitude_points, frequency: frequency_points } =
            file.signals.continuous.envelopes;
        let emphasis =
            |emphasis: EmphasisV1| Emphasis { amplitude: emphasis.amplitude, frequency: emphasis.frequency };
        let amplitude = |point: AmplitudeV1| AmplitudePoint {
            time_secs: point.time,
            amplitude: point.amplitude,
            emphasis: point.emphasis.map(emphasis),
        };
        let frequency =
            |point: FrequencyV1| FrequencyPoint { time_secs: point.time, frequency: point.frequency };
        Self {
            metadata: ClipMetadata { editor, author, source, project, tags, description },
            amplitude: amplitude_points.into_iter().map(amplitude).collect(),
            frequency: frequency_points.into_iter().flatten().map(frequency).collect(),
        }
    }
}

impl From<&HapticClip> for ClipFileV1 {
    fn from(clip: &HapticClip) -> Self {
        let ClipMetadata { editor, author, source, project, tags, description } = clip.metadata.clone();
        let emphasis =
            |emphasis: Emphasis| EmphasisV1 { amplitude: emphasis.amplitude, frequency: emphasis.frequency };
        let amplitude = |point: &AmplitudePoint| AmplitudeV1 {
            time: point.time_secs,
            amplitude: point.amplitude,
            emphasis: point.emphasis.map(emphasis),
        };
        let frequency =
            |point: &FrequencyPoint| FrequencyV1 { time: point.time_secs, frequency: point.frequency };
        let envelopes = EnvelopesV1 {
            amplitude: clip.amplitude.iter().map(amplitude).collect(),
            frequency: (!clip.frequency.is_empty()).then(|| clip.frequency.iter().map(frequency).collect()),
        };
        Self {
            version: VersionV1 { major: CLIP_VERSION, minor: 0, patch: 0 },
            metadata: MetadataV1 { editor, author, source, project, tags, description },
            signals: SignalsV1 { continuous: ContinuousV1 { envelopes } },
        }
    }
}
