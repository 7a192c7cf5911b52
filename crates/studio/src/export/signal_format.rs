//! What a format of signals is: files of one stroke over one texture, where [`super::ExportFormat`] has files of the texture
//! itself.

use std::path::{Path, PathBuf};

use shagreen_core::units::Hertz;
use shagreen_formats::acf::AcfV1;
use shagreen_formats::wav::SidecarV1;
use shagreen_formats::wav_encoding::WavEncoding;

use super::stroke_losses::Rendered;
use super::suffixed_path;

/// Samples of one stroke.
#[derive(Clone, Copy, Debug)]
pub struct SignalSamples<'a> {
    /// Acceleration of the tip in m/s².
    pub all: &'a [f32],
    /// The same without tap transients; `None` if none was added.
    pub without_taps: Option<&'a [f32]>,
    /// Their rate.
    pub rate: Hertz,
    /// Whether the end goes on into the beginning.
    pub loops: bool,
}

/// Signal of one stroke that is exported.
#[derive(Clone, Copy, Debug)]
pub struct StrokeSignal<'a> {
    /// Acceleration of the tip, at the rate of the sidecar.
    pub samples: SignalSamples<'a>,
    /// Rate, texture, license and motion of the samples.
    pub sidecar: &'a SidecarV1,
    /// Encoding of the samples, for formats that store samples.
    pub encoding: WavEncoding,
    /// Acceleration in m/s² that files store as 1, above 0 ([`SignalFormat::full_scale_mps2`]). Signals with one value keep
    /// the differences between their levels.
    pub full_scale_mps2: f64,
    /// Configuration of the actuator that shall play the files; `None` if it is not known.
    pub acf: Option<&'a AcfV1>,
}

/// One file of an exported signal.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FilePart {
    /// What follows the name in the file name, one of [`SignalFormat::suffixes`].
    pub suffix: &'static str,
    /// Content of the file.
    pub bytes: Vec<u8>,
}

/// A file format for signals of one stroke.
pub trait SignalFormat: Sync {
    /// Identifier for scripts.
    fn id(&self) -> &'static str;

    /// Name of the format, for menus.
    fn name(&self) -> &'static str;

    /// Ending of its first file, without the dot in front.
    fn ending(&self) -> &'static str;

    /// One sentence that names the programs that read it.
    fn help(&self) -> &'static str;

    /// Whether its files store the samples, so that their encoding matters.
    fn stores_samples(&self) -> bool {
        false
    }

    /// Whether a sidecar marks its files as those of this program. Without one, nothing tells a file of another editor, or one that
    /// was changed, from an export.
    fn has_sidecar(&self) -> bool {
        false
    }

    /// Whether its files depend on the actuator that shall play them, if that is known.
    fn uses_actuator(&self) -> bool {
        !self.stores_samples()
    }

    /// Suffixes of all files that an export may write ([`path_of`]), the first one empty. `has_actuator` states whether the
    /// actuator is known.
    fn suffixes(&self, has_actuator: bool) -> &'static [&'static str];

    /// Properties of a texture that the files of one stroke cannot hold.
    fn lost(&self, rendered: Rendered<'_>) -> Vec<String>;

    /// Acceleration in m/s² at which the signal uses the range of the format; 0 for silence.
    fn full_scale_mps2(&self, samples: SignalSamples<'_>, encoding: WavEncoding) -> f64;

    /// Warning about what the files of a signal hold otherwise than the signal.
    fn warning(&self, _signal: &StrokeSignal<'_>) -> Option<String> {
        None
    }

    /// Returns the files: the first suffix always, others where the signal needs them.
    ///
    /// # Errors
    /// The format cannot represent the signal.
    fn files(&self, signal: &StrokeSignal<'_>, created_by: &str) -> anyhow::Result<Vec<FilePart>>;

    /// Returns whether an export may replace the file at `path` with these bytes: one of this format.
    fn may_replace(&self, path: &Path, bytes: &[u8]) -> bool;
}

/// Returns the path of a file with this suffix, where `out` is the path of the first file. The suffix replaces the ending of
/// the format, or any other ending.
pub fn path_of(format: &dyn SignalFormat, out: &Path, suffix: &str) -> PathBuf {
    suffixed_path(out, format.ending(), suffix)
}
