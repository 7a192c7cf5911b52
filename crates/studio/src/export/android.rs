//! Vibration envelopes for Android 16.

use std::path::Path;

use shagreen_formats::android_envelope::{FORMAT, android_envelope, write_android_envelope};
use shagreen_formats::wav_encoding::WavEncoding;

use super::envelopes::{description_of, full_scale_mps2, lost_in_envelopes, outline_of, scale_of};
use super::signal_format::{FilePart, SignalFormat, SignalSamples, StrokeSignal};
use super::stroke_losses::Rendered;
use crate::replace::has_format;

pub(super) struct Android;

/// The format has no short events, so that its envelope has the taps.
fn with_taps_in_envelope(samples: SignalSamples<'_>) -> SignalSamples<'_> {
    SignalSamples { without_taps: None, ..samples }
}

impl SignalFormat for Android {
    fn id(&self) -> &'static str {
        "android"
    }

    fn name(&self) -> &'static str {
        "Android 16 envelope"
    }

    fn ending(&self) -> &'static str {
        "android.json"
    }

    fn help(&self) -> &'static str {
        "Control points for the envelope builders of VibrationEffect; examples/export has a reader in Kotlin"
    }

    fn suffixes(&self, _: bool) -> &'static [&'static str] {
        &[""]
    }

    fn lost(&self, rendered: Rendered<'_>) -> Vec<String> {
        let mut lost = lost_in_envelopes(rendered, "with a point every 20 ms at most");
        lost.push("short events: they are part of the envelope, which needs 20 ms to rise".to_owned());
        lost
    }

    fn full_scale_mps2(&self, samples: SignalSamples<'_>, _: WavEncoding) -> f64 {
        full_scale_mps2(with_taps_in_envelope(samples))
    }

    fn files(&self, signal: &StrokeSignal<'_>, created_by: &str) -> anyhow::Result<Vec<FilePart>> {
        let description = description_of(signal);
        let of_envelope = StrokeSignal { samples: with_taps_in_envelope(signal.samples), ..*signal };
        let about = (created_by, &*description);
        let envelope = android_envelope(&outline_of(&of_envelope), scale_of(signal), about);
        Ok(vec![FilePart { suffix: "", bytes: write_android_envelope(&envelope) }])
    }

    fn may_replace(&self, _: &Path, bytes: &[u8]) -> bool {
        has_format(bytes, FORMAT)
    }
}
