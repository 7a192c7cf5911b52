//! Status that the engine publishes after every block.

use crate::touch::Touch;

/// Connection state of an output.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum LinkState {
    /// Opened, but the device has not requested samples yet.
    #[default]
    Starting,
    /// The device requests samples.
    Running,
    /// The device has not requested samples for some time ([`crate::engine::STALL_SECS`], or after opening
    /// [`crate::engine::START_SECS`]). It may recover.
    Stalled,
    /// The device was disconnected or failed permanently. It stays silent until the person opens an output again.
    /// [`crate::engine::Handle::loss`] gives the reason.
    Lost,
}

/// Latency from a live touch to the device's output, based on the latency that the device states.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Latency {
    /// Latency of the last touch, from its report to the middle of the resulting ramp in the output, in seconds; zero
    /// before the first touch.
    pub stroke_secs: f32,
    /// Latency that a tap at the last touch would have, from its report to the first sample of the tap transient, in
    /// seconds.
    pub tap_secs: f32,
    /// Highest `stroke_secs` since the output was opened, in seconds.
    pub stroke_max_secs: f32,
    /// Number of measured touches.
    pub n_touches: u64,
}

/// Latency limit for strokes from report to drive, in seconds; above it, a texture feels detached from the hand's
/// motion.
pub const STROKE_BUDGET_SECS: f32 = 0.030;
/// Latency limit for taps, in seconds; above it, a surface feels softer than it is.
pub const TAP_BUDGET_SECS: f32 = 0.006;

impl Latency {
    pub(crate) fn note(&mut self, stroke_secs: f32, tap_secs: f32) {
        *self = Self {
            stroke_secs,
            tap_secs,
            stroke_max_secs: self.stroke_max_secs.max(stroke_secs),
            n_touches: self.n_touches + 1,
        };
    }

    /// Whether taps exceed their latency limit.
    pub fn is_tap_late(&self) -> bool {
        self.n_touches > 0 && self.tap_secs > TAP_BUDGET_SECS
    }

    /// Whether strokes exceed their latency limit.
    pub fn is_stroke_late(&self) -> bool {
        self.n_touches > 0 && self.stroke_secs > STROKE_BUDGET_SECS
    }
}

/// Status of the engine and its device at the end of the last block.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Status {
    /// Connection state of the output.
    pub state: LinkState,
    /// Processing time of the callback divided by the block's duration, smoothed; at 1, dropouts begin.
    pub load: f32,
    /// Highest unsmoothed load of any block since the output was opened.
    pub load_max: f32,
    /// Number of underruns (dropouts) that the device reports.
    pub underruns: u64,
    /// Number of other errors after which the device continued.
    pub backend_errors: u64,
    /// Number of samples that the limiters attenuated.
    pub limited_samples: u64,
    /// Whether a non-finite sample has silenced the output until [`crate::engine::Handle::reset_limiter`].
    pub tripped: bool,
    /// Running RMS of the drive as a fraction of the coil's thermal limit; 0 without a limit.
    pub heat_used: f32,
    /// Current gain of the thermal limiter, 0..1.
    pub heat_gain: f32,
    /// Time from the request of the last block until its playback, in seconds, as the device states it.
    pub device_latency_secs: f32,
    /// Latency of live touches.
    pub latency: Latency,
    /// Whether a signal replaces the texture.
    pub plays_signal: bool,
    /// Whether live input is followed, because it was selected or because it took over.
    pub follows_live: bool,
    /// Position and contact of the tip.
    pub touch: Touch,
    /// Level (RMS over about 50 ms) of the texture or of an acceleration signal, before gain, equalizer and limiters,
    /// in m/s².
    pub level_mps2: f32,
    /// Recent output peak as a fraction of full scale, 0..1; it decays by half in about 0.2 s.
    pub peak: f32,
    /// Number of frames returned to the device since it was opened.
    pub frames_played: u64,
    /// Time since the input was last switched or its track replaced, in seconds of the engine's clock.
    pub input_secs: f64,
    /// Number of objects that the callback leaked because the queue of objects to be freed was full.
    pub leaked: u64,
}
