//! Points for the parametric haptics of OpenXR.

use std::path::Path;

use shagreen_formats::openxr_parametric::{FORMAT, openxr_parametric, write_openxr_parametric};
use shagreen_formats::wav_encoding::WavEncoding;

use super::envelopes::{clip_of, clipped_onset, full_scale_mps2, lost_in_envelopes, scale_of};
use super::signal_format::{FilePart, SignalFormat, SignalSamples, StrokeSignal};
use super::stroke_losses::Rendered;
use crate::replace::has_format;

pub(super) struct OpenXr;

impl SignalFormat for OpenXr {
    fn id(&self) -> &'static str {
        "openxr"
    }

    fn name(&self) -> &'static str {
        "OpenXR parametric haptics"
    }

    fn ending(&self) -> &'static str {
        "openxr.json"
    }

    fn help(&self) -> &'static str {
        "Points for XR_EXT_haptic_parametric on headsets; examples/export has a reader in C++"
    }

    fn suffixes(&self, _: bool) -> &'static [&'static str] {
        &[""]
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
        let clip = clip_of(signal, created_by)?;
        let about = (created_by, &*clip.metadata.description);
        let calls = openxr_parametric(&clip, scale_of(signal), about);
        Ok(vec![FilePart { suffix: "", bytes: write_openxr_parametric(&calls) }])
    }

    fn may_replace(&self, _: &Path, bytes: &[u8]) -> bool {
        has_format(bytes, FORMAT)
    }
}
