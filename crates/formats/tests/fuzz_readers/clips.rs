//! Readers of haptic clips of other programs.

use shagreen_formats::ahap::AhapPattern;
use shagreen_formats::ahap::of_clip::ahap_of_clip;
use shagreen_formats::haptic_clip::{ClipRules, HapticClip};

const CLIP: &str = r#"{"version": {"major": 1, "minor": 0, "patch": 0},
    "metadata": {"editor": "test", "author": "", "source": "", "project": "", "tags": ["cork"], "description": "x"},
    "signals": {"continuous": {"envelopes": {
        "amplitude": [{"time": 0.0, "amplitude": 0.25}, {"time": 0.5, "amplitude": 0.5, "emphasis":
            {"amplitude": 0.75, "frequency": 1.0}}, {"time": 1.5, "amplitude": 0.0}],
        "frequency": [{"time": 0.0, "frequency": 0.5}, {"time": 1.0, "frequency": 0.75}]}}}}"#;

fn clip() -> HapticClip {
    HapticClip::from_json(CLIP.as_bytes(), ClipRules::Strict).unwrap()
}

pub(crate) fn clip_seeds() -> Vec<Vec<u8>> {
    vec![CLIP.as_bytes().to_vec(), clip().to_json()]
}

/// A clip that was read keeps the rules, comes back from its file, and has patterns that can be read.
pub(crate) fn read_a_clip(bytes: &[u8]) -> Result<(), String> {
    let Ok(clip) = HapticClip::from_json(bytes, ClipRules::Legacy) else { return Ok(()) };
    let again =
        HapticClip::from_json(&clip.to_json(), ClipRules::Legacy).map_err(|error| error.to_string())?;
    if again != clip {
        return Err("the written clip is another one".to_owned());
    }
    let pair = ahap_of_clip(&clip);
    for pattern in std::iter::once(pair.continuous).chain(pair.transients) {
        AhapPattern::from_json(&pattern.to_json("")).map_err(|error| error.to_string())?;
    }
    Ok(())
}

pub(crate) fn pattern_seeds() -> Vec<Vec<u8>> {
    let pair = ahap_of_clip(&clip());
    let patterns = std::iter::once(pair.continuous).chain(pair.transients);
    patterns.map(|pattern| pattern.to_json("test")).collect()
}

pub(crate) fn read_a_pattern(bytes: &[u8]) -> Result<(), String> {
    let Ok(read) = AhapPattern::from_json(bytes) else { return Ok(()) };
    let again = AhapPattern::from_json(&read.value.to_json("")).map_err(|error| error.to_string())?;
    if again.value == read.value { Ok(()) } else { Err("the written pattern is another one".to_owned()) }
}
