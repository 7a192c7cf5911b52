//! WAV: the samples of one stroke, rendered by `shagreen render`, `shagreen export` and the export sheet.

use std::ffi::OsStr;
use std::path::Path;

use shagreen_formats::wav::{is_sidecar, wav_bytes};
use shagreen_formats::wav_encoding::WavEncoding;

use super::FormatInfo;
use super::signal_format::{FilePart, SignalFormat, SignalSamples, StrokeSignal};
use super::stroke_losses::{Rendered, lost_of_stroke};
use crate::replace::is_own_signal;

/// The WAV format, which stores the samples themselves.
pub const WAV: FormatInfo = FormatInfo {
    id: "wav",
    name: "WAV signal",
    ending: "wav",
    help: "Acceleration along one stroke, for audio editors, game engines and analysis",
};

/// Ending of the sidecar file.
const SIDECAR: &str = "json";

pub(super) struct Wav;

impl SignalFormat for Wav {
    fn id(&self) -> &'static str {
        WAV.id
    }

    fn name(&self) -> &'static str {
        WAV.name
    }

    fn ending(&self) -> &'static str {
        WAV.ending
    }

    fn help(&self) -> &'static str {
        WAV.help
    }

    fn stores_samples(&self) -> bool {
        true
    }

    fn has_sidecar(&self) -> bool {
        true
    }

    fn suffixes(&self, _: bool) -> &'static [&'static str] {
        &["", ".json"]
    }

    fn lost(&self, rendered: Rendered<'_>) -> Vec<String> {
        lost_of_stroke(rendered)
    }

    fn full_scale_mps2(&self, samples: SignalSamples<'_>, encoding: WavEncoding) -> f64 {
        // Samples that are not scaled have the same scale even if they are silent.
        let is_silent = samples.all.iter().all(|sample| *sample == 0.0);
        if is_silent && encoding.is_scaled() { 0.0 } else { encoding.full_scale(samples.all) }
    }

    fn files(&self, signal: &StrokeSignal<'_>, _: &str) -> anyhow::Result<Vec<FilePart>> {
        let scale = (signal.encoding.samples, signal.full_scale_mps2);
        let [wav, sidecar] = wav_bytes(signal.samples.all, signal.sidecar, scale)?;
        Ok(vec![FilePart { suffix: "", bytes: wav }, FilePart { suffix: ".json", bytes: sidecar }])
    }

    fn may_replace(&self, path: &Path, bytes: &[u8]) -> bool {
        if path.extension() == Some(OsStr::new(SIDECAR)) {
            is_sidecar(bytes)
        } else {
            is_own_signal(path, bytes)
        }
    }
}
