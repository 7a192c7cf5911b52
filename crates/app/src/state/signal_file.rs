//! Export of the audible texture as a signal in m/s², with a sidecar.

use std::io::ErrorKind;
use std::path::Path;
use std::sync::Arc;

use shagreen_core::space::texture_path::TexturePath;
use shagreen_core::texture::blend::Mode;
use shagreen_core::texture::plane::Plane;
use shagreen_core::texture::render::{Hand, RenderError};
use shagreen_core::texture::tap::Tap;
use shagreen_core::units::{Contact, Hertz};
use shagreen_device::track::Track;
use shagreen_formats::bounded_file::{self, FileKind};
use shagreen_formats::wav::{SidecarV1, TraceV1, is_sidecar, sidecar_path, write_wav_scaled};
use shagreen_formats::wav_encoding::{Level, SampleType, WavEncoding};
use shagreen_studio::render::{SampleFormat, render_along, render_mixture};
use shagreen_studio::replace::is_own_signal;
use shagreen_studio::tap_transients::add_tap_transients;
use shagreen_studio::trace::{TrackHand, steady_trace, track_trace};

use crate::state::bench_signal::BenchSignal;
use crate::strings::export as strings;

/// Usual duration of the signal, in seconds.
pub(crate) const SIGNAL_SECS: f64 = 5.0;
/// Usual sample rate of the signal in Hz, which audio editors and game engines accept.
pub(crate) const SIGNAL_RATE_HZ: u32 = 48_000;
/// Seed of the noise.
pub(crate) const SIGNAL_SEED: u64 = 1;

/// How a signal is rendered and written.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SignalOptions {
    /// Duration in seconds, unless a recorded stroke or a signal of the Signals workspace determines it.
    pub seconds: f64,
    /// Sample rate in Hz.
    pub rate_hz: u32,
    /// Type and level of the samples.
    pub encoding: WavEncoding,
    /// Whether the end goes on into the beginning.
    pub loops: bool,
    /// Whether the tip follows the recorded stroke.
    pub follows_stroke: bool,
    /// Whether several signals at their peak are divided by one acceleration, so that differences in level stay.
    pub shares_scale: bool,
}

impl Default for SignalOptions {
    fn default() -> Self {
        Self {
            seconds: SIGNAL_SECS,
            rate_hz: SIGNAL_RATE_HZ,
            // What every player plays without clipping; the sidecar keeps the unit.
            encoding: WavEncoding { samples: SampleType::Float32, level: Level::Peak },
            loops: false,
            follows_stroke: false,
            shares_scale: true,
        }
    }
}

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
    /// Recorded stroke that the tip may follow instead.
    pub stroke: Option<Arc<Track>>,
    /// Tap transient of the texture, which each contact of a recorded stroke adds.
    pub tap: Option<Tap>,
    /// Rate of the texture's model.
    pub model_rate: Hertz,
    /// Metadata of the samples.
    pub sidecar: SidecarV1,
    /// Names of the contained textures that may not be redistributed.
    pub restricted: Vec<String>,
}

impl SignalFile {
    /// Renders the signal and writes it with its sidecar. `scale_mps2` becomes a sample of 1; `None` takes that of the encoding.
    ///
    /// # Errors
    /// States that the signal cannot be rendered or written, or that the path of the sidecar is taken by another kind
    /// of file.
    pub(crate) fn write(
        &self,
        path: &Path,
        options: &SignalOptions,
        scale_mps2: Option<f64>,
    ) -> Result<(), String> {
        if !Self::may_lie_beside(path) {
            return Err(strings::not_replaced(&sidecar_path(path).display().to_string()));
        }
        let (rate_hz, seconds) = (options.rate_hz, self.seconds(options));
        let samples = self.samples(options)?;
        let trace = self.trace(options);
        let sidecar = SidecarV1 { rate_hz, seconds, trace, ..self.sidecar.clone() };
        let scale_mps2 = scale_mps2.unwrap_or_else(|| options.encoding.full_scale(&samples));
        let written = write_wav_scaled(path, &samples, &sidecar, (options.encoding.samples, scale_mps2));
        written.map_err(|error| error.to_string())
    }

    /// Stroke that the tip follows with these options.
    fn stroke(&self, options: &SignalOptions) -> Option<&Track> {
        self.stroke.as_deref().filter(|_| options.follows_stroke && !self.is_of_bench())
    }

    /// Whether the signal is one of the Signals workspace, which has its own duration.
    pub(crate) fn is_of_bench(&self) -> bool {
        matches!(self.sounding, Sounding::Bench(_))
    }

    /// Duration in seconds.
    pub(crate) fn seconds(&self, options: &SignalOptions) -> f64 {
        match &self.sounding {
            Sounding::Bench(signal) => signal.seconds(),
            Sounding::Mix(..) | Sounding::Path(_) => {
                self.stroke(options).map_or(options.seconds, Track::duration_secs)
            }
        }
    }

    /// Samples in m/s².
    ///
    /// # Errors
    /// The signal cannot be rendered.
    pub(crate) fn samples(&self, options: &SignalOptions) -> Result<Vec<f32>, String> {
        let stroke = self.stroke(options);
        let rate = Hertz(f64::from(options.rate_hz));
        let loops = options.loops && stroke.is_none();
        let format = SampleFormat { rate, seconds: self.seconds(options), seed: SIGNAL_SEED, loops };
        let (mut recorded, mut steady) = (stroke.map(TrackHand), |_: f64| self.contact);
        let hand: &mut dyn Hand = match &mut recorded {
            Some(recorded) => recorded,
            None => &mut steady,
        };
        let rendered: Result<Vec<f32>, RenderError> = match &self.sounding {
            Sounding::Bench(signal) => Ok(signal.at(rate).into_iter().map(|x| x as f32).collect()),
            Sounding::Path(path) => render_along(path, format, hand),
            Sounding::Mix(voices, mode) => render_mixture(voices, *mode, format, hand),
        };
        let mut samples = rendered.map_err(|error| error.to_string())?;
        if let (Some(track), Some(tap)) = (stroke, self.tap) {
            let added = add_tap_transients(
                &mut samples,
                options.rate_hz,
                self.model_rate.0,
                track.clone(),
                tap.into(),
            );
            added.map_err(|error| format!("{error:#}"))?;
        }
        Ok(samples)
    }

    /// Speed and force over time, for the sidecar.
    fn trace(&self, options: &SignalOptions) -> TraceV1 {
        match self.stroke(options) {
            Some(track) => track_trace(track),
            None => steady_trace(self.contact, self.seconds(options)),
        }
    }

    /// Whether a signal may replace a file with these bytes at `path`: only another WAV file with a sidecar.
    pub(crate) fn may_replace(path: &Path, bytes: &[u8]) -> bool {
        is_own_signal(path, bytes)
    }

    /// Whether the path of the sidecar for a signal at `path` is free or has another sidecar.
    pub(crate) fn may_lie_beside(path: &Path) -> bool {
        match bounded_file::read(&sidecar_path(path), FileKind::Small) {
            Ok(beside) => is_sidecar(&beside),
            Err(error) => error.kind() == ErrorKind::NotFound,
        }
    }
}
