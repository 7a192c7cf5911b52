//! Export of the audible texture as a signal in m/s², with a sidecar.

use std::path::Path;
use std::sync::Arc;

use shagreen_core::space::texture_path::TexturePath;
use shagreen_core::texture::blend::Mode;
use shagreen_core::texture::plane::Plane;
use shagreen_core::texture::render::{Hand, RenderError};
use shagreen_core::texture::tap::Tap;
use shagreen_core::units::{Contact, Hertz};
use shagreen_device::track::Track;
use shagreen_formats::wav::{SidecarV1, TraceV1};
use shagreen_formats::wav_encoding::{Level, SampleType, WavEncoding};
use shagreen_studio::export::{
    SignalFormat, SignalSamples, StrokeSignal, shared_full_scale_mps2, write_signal,
};
use shagreen_studio::file::one_line;
use shagreen_studio::render::{SampleFormat, render_along, render_mixture};
use shagreen_studio::report::{Reporter as _, Warnings};
use shagreen_studio::silence::{is_silent, silence_warning};
use shagreen_studio::tap_transients::add_tap_transients;
use shagreen_studio::trace::{TrackHand, steady_trace, track_trace};

use crate::state::bench_signal::BenchSignal;
use crate::state::document::CREATED_BY;
use crate::strings::signal as strings;

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
    /// Renders the signal and writes its files. `full_scale_mps2` becomes a value of 1; `None` takes that of the signal.
    /// Returns the warnings: silence, what the files hold otherwise than the signal, and files of an earlier export.
    ///
    /// # Errors
    /// States that the signal cannot be rendered or written.
    pub(crate) fn write(
        &self,
        format: &dyn SignalFormat,
        path: &Path,
        options: &SignalOptions,
        full_scale_mps2: Option<f64>,
    ) -> Result<Vec<String>, String> {
        let (rate_hz, seconds) = (options.rate_hz, self.seconds(options));
        let (texture, all) = self.samples_by_taps(options)?;
        let samples = self.signal_samples(&texture, all.as_deref(), options);
        let (trace, loops) = (self.trace(options), samples.loops);
        let sidecar = SidecarV1 { rate_hz, seconds, loops, trace, ..self.sidecar.clone() };
        let encoding = options.encoding;
        let full_scale_mps2 = full_scale_mps2
            .unwrap_or_else(|| shared_full_scale_mps2([format.full_scale_mps2(samples, encoding)]));
        let signal = StrokeSignal { samples, sidecar: &sidecar, encoding, full_scale_mps2, acf: None };
        let warnings = Warnings::default();
        if let Some(warning) = self.silence_warning(samples.all, &sidecar.trace) {
            warnings.warn(&warning);
        }
        let written = write_signal(format, &signal, (path, CREATED_BY), &warnings);
        written.map_err(|error| one_line(&error))?;
        Ok(warnings.into_vec())
    }

    /// Warning that the rendered samples in m/s² are silent, with the reason; `None` if they are not.
    fn silence_warning(&self, samples: &[f32], trace: &TraceV1) -> Option<String> {
        // The motion is not the reason for the silence of samples that are given.
        if self.is_of_bench() {
            return is_silent(samples).then(|| strings::SILENT.to_owned());
        }
        silence_warning(samples, trace)
    }

    /// Acceleration in m/s² at full scale of a format, 0 for silence.
    ///
    /// # Errors
    /// The signal cannot be rendered.
    pub(crate) fn full_scale_mps2(
        &self,
        format: &dyn SignalFormat,
        options: &SignalOptions,
    ) -> Result<f64, String> {
        let (texture, all) = self.samples_by_taps(options)?;
        let samples = self.signal_samples(&texture, all.as_deref(), options);
        Ok(format.full_scale_mps2(samples, options.encoding))
    }

    /// Samples for a format, from those without and with tap transients.
    fn signal_samples<'a>(
        &self,
        texture: &'a [f32],
        all: Option<&'a [f32]>,
        options: &SignalOptions,
    ) -> SignalSamples<'a> {
        SignalSamples {
            all: all.unwrap_or(texture),
            without_taps: all.map(|_| texture),
            rate: Hertz(f64::from(options.rate_hz)),
            loops: self.loops(options),
        }
    }

    /// Whether the end of the samples goes on into the beginning.
    fn loops(&self, options: &SignalOptions) -> bool {
        options.loops && self.stroke(options).is_none() && !self.is_of_bench()
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
        let (texture, all) = self.samples_by_taps(options)?;
        Ok(all.unwrap_or(texture))
    }

    /// Samples in m/s² without tap transients, and with them if there are any.
    fn samples_by_taps(&self, options: &SignalOptions) -> Result<(Vec<f32>, Option<Vec<f32>>), String> {
        let stroke = self.stroke(options);
        let rate = Hertz(f64::from(options.rate_hz));
        let loops = self.loops(options);
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
        let texture = rendered.map_err(|error| error.to_string())?;
        let mut with_taps = None;
        if let (Some(track), Some(tap)) = (stroke, self.tap) {
            let mut samples = texture.clone();
            let added = add_tap_transients(
                &mut samples,
                options.rate_hz,
                self.model_rate.0,
                track.clone(),
                tap.into(),
            );
            added.map_err(|error| format!("{error:#}"))?;
            with_taps = Some(samples).filter(|samples| *samples != texture);
        }
        Ok((texture, with_taps))
    }

    /// Speed and force over time, for the sidecar.
    fn trace(&self, options: &SignalOptions) -> TraceV1 {
        match self.stroke(options) {
            Some(track) => track_trace(track),
            None => steady_trace(self.contact, self.seconds(options)),
        }
    }
}
