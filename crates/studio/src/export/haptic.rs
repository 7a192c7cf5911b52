//! `.haptic` clips, with the configuration of the actuator beside them.

use std::ffi::OsStr;
use std::path::Path;

use shagreen_formats::acf::{AcfV1, write_acf};
use shagreen_formats::haptic_clip::{ClipRules, HapticClip};
use shagreen_formats::wav_encoding::WavEncoding;

use super::envelopes::{clip_of, clipped_onset, full_scale_mps2, lost_in_envelopes};
use super::signal_format::{FilePart, SignalFormat, SignalSamples, StrokeSignal};
use super::stroke_losses::Rendered;

/// Ending of the configuration of an actuator.
const ACF: &str = "acf";

pub(super) struct Haptic;

impl SignalFormat for Haptic {
    fn id(&self) -> &'static str {
        "haptic"
    }

    fn name(&self) -> &'static str {
        "Haptic clip"
    }

    fn ending(&self) -> &'static str {
        "haptic"
    }

    fn help(&self) -> &'static str {
        "Amplitude, frequency and emphases, for the haptics SDK of game engines, headsets and phones"
    }

    fn suffixes(&self, has_actuator: bool) -> &'static [&'static str] {
        if has_actuator { &["", ".acf"] } else { &[""] }
    }

    fn lost(&self, rendered: Rendered<'_>) -> Vec<String> {
        lost_in_envelopes(rendered, "with a point every 5 ms at most")
    }

    fn full_scale_mps2(&self, samples: SignalSamples<'_>, _: WavEncoding) -> f64 {
        full_scale_mps2(samples)
    }

    fn warning(&self, signal: &StrokeSignal<'_>) -> Option<String> {
        clipped_onset(signal)
    }

    fn files(&self, signal: &StrokeSignal<'_>, created_by: &str) -> anyhow::Result<Vec<FilePart>> {
        let mut files = vec![FilePart { suffix: "", bytes: clip_of(signal, created_by)?.to_json() }];
        files.extend(signal.acf.map(|acf| FilePart { suffix: ".acf", bytes: write_acf(acf) }));
        Ok(files)
    }

    fn may_replace(&self, path: &Path, bytes: &[u8]) -> bool {
        if path.extension() == Some(OsStr::new(ACF)) {
            serde_json::from_slice::<AcfV1>(bytes).is_ok()
        } else {
            HapticClip::from_json(bytes, ClipRules::Legacy).is_ok()
        }
    }
}
