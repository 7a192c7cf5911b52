//! What the callback tells back, after every block.

use crate::touch::Touch;

/// How an output is doing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum LinkState {
    /// Opened, but the device has not asked for anything yet.
    #[default]
    Starting,
    /// The device asks for samples.
    Running,
    /// The device has not asked for a while ([`crate::engine::STALL_SECS`], or after opening
    /// [`crate::engine::START_SECS`]): it may come back.
    Stalled,
    /// The device is gone or failed for good: it stays silent until the person opens an output again.
    /// [`crate::engine::Handle::loss`] says why.
    Lost,
}

/// How long a person's touch takes until the drive that it makes has left the device, as far as the device says.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Latency {
    /// Of the last touch: from its report to the middle of the change of texture, in seconds; zero before the first.
    pub stroke_secs: f32,
    /// Of the last touch, had it landed: from its report to the first sample of the tap, in seconds.
    pub tap_secs: f32,
    /// Highest of the strokes since the output was opened, in seconds.
    pub stroke_max_secs: f32,
    /// Touches that were measured.
    pub n_touches: u64,
}

/// A texture that is later than this does not feel tied to the hand: the budget from report to drive, in seconds.
pub const STROKE_BUDGET_SECS: f32 = 0.030;
/// A tap that is later than about this feels softer than it is, in seconds.
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

    /// Whether taps come too late to feel as hard as they are.
    pub fn is_tap_late(&self) -> bool {
        self.n_touches > 0 && self.tap_secs > TAP_BUDGET_SECS
    }

    /// Whether strokes come later than the budget.
    pub fn is_stroke_late(&self) -> bool {
        self.n_touches > 0 && self.stroke_secs > STROKE_BUDGET_SECS
    }
}

/// How the engine is doing: as of the end of the last block.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Status {
    /// Whether the device still asks for samples.
    pub state: LinkState,
    /// Time used by the callback over time allotted to it, smoothed; 1 is the end.
    pub load: f32,
    /// Highest time used over time allotted in any block since the output was opened.
    pub load_max: f32,
    /// Times that the device ran out of samples.
    pub underruns: u64,
    /// Other errors that the device reported and went on after.
    pub backend_errors: u64,
    /// Samples that the limiter turned down or bent.
    pub limited_samples: u64,
    /// Whether a sample that was not finite has silenced the output until [`crate::engine::Handle::reset_limiter`].
    pub tripped: bool,
    /// Share of what the coil stands for long that is used, root mean square over its time constant; 0 where that is not
    /// known.
    pub heat_used: f32,
    /// Gain by which the drive is turned down to keep the coil cool, 0..1.
    pub heat_gain: f32,
    /// How much later than it was asked for the last block is heard, in seconds, as far as the device says.
    pub device_latency_secs: f32,
    /// How long touches take.
    pub latency: Latency,
    /// Whether a signal is played in the place of the texture.
    pub plays_signal: bool,
    /// Whether a person's hand is followed, because it was chosen or because it took over.
    pub follows_live: bool,
    /// Where the tip is and what it does.
    pub touch: Touch,
    /// Level of the texture before gain and limiter, root mean square over about 50 ms, in m/s².
    pub level_mps2: f32,
    /// Highest output of late as a share of the device's full scale, 0..1: falls by half in about 0.2 s.
    pub peak: f32,
    /// Frames handed to the device since it was opened.
    pub frames_played: u64,
    /// Time since the input was last switched or its track replaced, in seconds of the engine's clock.
    pub input_secs: f64,
    /// Things that the callback could neither keep nor give back, and leaked.
    pub leaked: u64,
}
