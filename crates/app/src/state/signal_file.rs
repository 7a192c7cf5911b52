//! Export of the audible texture as a signal in m/s², with a sidecar.

use std::io::ErrorKind;
use std::path::Path;
use std::sync::Arc;

use shagreen_core::space::texture_path::TexturePath;
use shagreen_core::texture::blend::Mode;
use shagreen_core::texture::plane::Plane;
use shagreen_core::texture::render::RenderError;
use shagreen_core::units::{Contact, Hertz};
use shagreen_formats::bounded_file::{self, FileKind};
use shagreen_formats::wav::{SidecarV1, is_sidecar, sidecar_path, write_wav};
use shagreen_studio::render::{SampleFormat, render_along, render_mixture};
use shagreen_studio::replace::is_own_signal;

use crate::state::bench_signal::BenchSignal;
use crate::strings::signal as strings;

/// Duration of the signal, in seconds.
pub(crate) const SIGNAL_SECS: f64 = 5.0;
/// Sample rate of the signal in Hz, which audio editors and game engines accept.
pub(crate) const SIGNAL_RATE_HZ: u32 = 48_000;
/// Seed of the noise.
pub(crate) const SIGNAL_SEED: u64 = 1;

/// Source of a signal.
#[derive(Clone, Debug)]
pub enum Sounding {
    /// Textures and their weights, mixed in a mode.
    Mix(Vec<(Arc<Plane>, f64)>, Mode),
    /// Textures along a path.
    Path(Box<TexturePath>),
    /// Signal of the Signals workspace, at its own speed.
    Bench(Arc<BenchSignal>),
}

/// Signal to be exported.
#[derive(Clone, Debug)]
pub struct SignalFile {
    /// Source of the samples.
    pub sounding: Sounding,
    /// Constant tip speed and normal force.
    pub contact: Contact,
    /// Metadata of the samples.
    pub sidecar: SidecarV1,
    /// Names of the contained textures that may not be redistributed.
    pub restricted: Vec<String>,
}

impl SignalFile {
    /// Renders the signal and writes it with its sidecar.
    ///
    /// # Errors
    /// States that the signal cannot be rendered or written, or that the path of the sidecar is taken by another kind
    /// of file.
    pub(crate) fn write(&self, path: &Path) -> Result<(), String> {
        if !Self::may_lie_beside(path) {
            return Err(strings::NO_SIGNAL.to_owned());
        }
        let samples = self.samples().map_err(|error| error.to_string())?;
        write_wav(path, &samples, &self.sidecar).map_err(|error| error.to_string())
    }

    /// Samples in m/s² at [`SIGNAL_RATE_HZ`].
    ///
    /// # Errors
    /// The signal cannot be rendered.
    pub(crate) fn samples(&self) -> Result<Vec<f32>, RenderError> {
        let rate = Hertz(f64::from(SIGNAL_RATE_HZ));
        let format = SampleFormat { rate, seconds: SIGNAL_SECS, seed: SIGNAL_SEED };
        let mut contact_at = |_| self.contact;
        match &self.sounding {
            Sounding::Bench(signal) => Ok(signal.at(rate).into_iter().map(|x| x as f32).collect()),
            Sounding::Path(path) => render_along(path, format, &mut contact_at),
            Sounding::Mix(voices, mode) => render_mixture(voices, *mode, format, &mut contact_at),
        }
    }

    /// Whether a signal may replace a file with these bytes at `path`: only another WAV file with a sidecar.
    pub(crate) fn may_replace(path: &Path, bytes: &[u8]) -> bool {
        is_own_signal(path, bytes)
    }

    /// Whether the path of the sidecar for a signal at `path` is free or has another sidecar.
    fn may_lie_beside(path: &Path) -> bool {
        match bounded_file::read(&sidecar_path(path), FileKind::Small) {
            Ok(beside) => is_sidecar(&beside),
            Err(error) => error.kind() == ErrorKind::NotFound,
        }
    }
}
