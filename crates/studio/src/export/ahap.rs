//! AHAP patterns: one for the continuous vibration, and one for short events if the stroke has any.

use std::path::Path;

use shagreen_formats::ahap::AhapPattern;
use shagreen_formats::ahap::of_clip::{AhapPair, ahap_of_clip};
use shagreen_formats::wav_encoding::WavEncoding;

use super::envelopes::{clip_of, clipped_onset, full_scale_mps2, lost_in_envelopes};
use super::signal_format::{FilePart, SignalFormat, SignalSamples, StrokeSignal};
use super::stroke_losses::Rendered;

/// Suffix of the pattern of short events.
const TRANSIENTS: &str = ".transients.ahap";

pub(super) struct Ahap;

impl SignalFormat for Ahap {
    fn id(&self) -> &'static str {
        "ahap"
    }

    fn name(&self) -> &'static str {
        "AHAP patterns"
    }

    fn ending(&self) -> &'static str {
        "ahap"
    }

    fn help(&self) -> &'static str {
        "Intensity, sharpness and taps, for Core Haptics on iPhones and game controllers"
    }

    fn suffixes(&self, _: bool) -> &'static [&'static str] {
        &["", TRANSIENTS]
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
        let AhapPair { continuous, transients } = ahap_of_clip(&clip);
        let description = &clip.metadata.description;
        let part = |suffix, pattern: &AhapPattern| FilePart { suffix, bytes: pattern.to_json(description) };
        let transients = transients.map(|pattern| part(TRANSIENTS, &pattern));
        Ok(std::iter::once(part("", &continuous)).chain(transients).collect())
    }

    fn may_replace(&self, _: &Path, bytes: &[u8]) -> bool {
        AhapPattern::from_json(bytes).is_ok()
    }
}
