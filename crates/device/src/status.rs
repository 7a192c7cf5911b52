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
    /// Samples that the limiter bent.
    pub limited_samples: u64,
    /// Whether a sample that was not finite has silenced the output until [`crate::engine::Handle::reset_limiter`].
    pub tripped: bool,
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
