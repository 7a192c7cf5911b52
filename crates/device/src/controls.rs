//! Controls of the engine, sent together as one `Copy` struct because they must agree.

use shagreen_synth::renderer::{Blend, Mix};
use shagreen_synth::tap::Tap;

use crate::hand::Hand;
use crate::repeat::Repeat;

/// Source of the tip's motion over the texture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Input {
    /// None: the tip is lifted.
    #[default]
    Lifted,
    /// Live stylus input through [`crate::live::LiveInput`].
    Live,
    /// Automatic stroke, from its start. A change of speed, force or extent continues from the current tip position; a
    /// change of path restarts the stroke.
    Hand(Hand),
    /// The last track that was sent to the engine ([`crate::engine::Handle::play_track`]), played once from its start.
    Track,
    /// The last track that was sent to the engine, repeated from its start. A change of tempo or force continues from
    /// the current tip position.
    Repeat(Repeat),
}

/// Automatic takeover: live stylus input replaces the chosen input when a stylus touches or reports proximity
/// ([`crate::live::LiveInput::hover`]). The takeover starts in the block in which the report arrives, independently of
/// the window's thread. The tap transient starts at once; speed and force fade, as at every change of input.
///
/// The chosen input pauses during the takeover and continues from the same position afterwards.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Takeover {
    /// Time from the end of touch and proximity until the chosen input continues, in seconds.
    pub lifted_secs: f32,
    /// Time from the last report of a stylus that has not reported leaving until the chosen input continues, in
    /// seconds.
    pub stale_secs: f32,
}

impl Takeover {
    /// Usual times: `lifted_secs` bridges two taps of a mouse, and `stale_secs` allows a pen to be held still.
    pub const USUAL: Self = Self { lifted_secs: 0.3, stale_secs: 2.0 };
}

/// Level of the output signal: muting and gain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive {
    /// Whether the output is muted.
    pub muted: bool,
    /// Factor from the texture's acceleration to the actuator's, at least 0. The limiters act after it.
    pub gain: f32,
}

impl Default for Drive {
    /// Not muted, with a gain of 1 (the measured level).
    fn default() -> Self {
        Self { muted: false, gain: 1.0 }
    }
}

impl Drive {
    /// Gain to fade to: zero when muted, or if the gain is negative or not finite.
    pub(crate) fn target(self) -> f32 {
        if self.muted || !(self.gain.is_finite() && self.gain >= 0.0) { 0.0 } else { self.gain }
    }
}

/// All controls that an engine takes at once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Controls {
    /// Textures to play and their interpolation mode.
    pub mix: Mix,
    /// Tap transient at a contact onset.
    pub tap: Tap,
    /// Level of the output signal: muting and gain.
    pub drive: Drive,
    /// Source of the tip's motion.
    pub input: Input,
    /// Automatic takeover by live input, if enabled.
    pub takeover: Option<Takeover>,
}

impl Default for Controls {
    /// No texture and no motion. The interpolation mode has no effect on an empty mix.
    fn default() -> Self {
        Self {
            mix: Mix::silent(Blend::Power),
            tap: Tap::SILENT,
            drive: Drive::default(),
            input: Input::default(),
            takeover: None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Drive;

    #[test]
    fn nonsense_gains_are_silence() {
        for gain in [f32::NAN, f32::INFINITY, -1.0] {
            assert_eq!(Drive { muted: false, gain }.target(), 0.0);
        }
        assert_eq!(Drive { muted: false, gain: 0.5 }.target(), 0.5);
        assert_eq!(Drive { muted: true, gain: 0.5 }.target(), 0.0);
    }
}
