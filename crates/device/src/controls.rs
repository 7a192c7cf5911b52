//! What the callback is told, all at once: a `Copy` struct, since its parts must agree.

use shagreen_synth::renderer::{Blend, Mix};
use shagreen_synth::tap::Tap;

use crate::hand::Hand;

/// What moves over the texture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Input {
    /// Nothing: the tip is in the air.
    #[default]
    Lifted,
    /// The person, through [`crate::live::LiveInput`].
    Live,
    /// The automatic hand, from the start of its stroke. A change of speed, force or extent goes on from where the hand
    /// is; a change of path starts anew.
    Hand(Hand),
    /// The last track given to [`crate::engine::Handle::play_track`], from its start.
    Track,
}

/// How much of the signal goes out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive {
    /// Whether nothing goes out.
    pub muted: bool,
    /// Gain from the texture's acceleration to that of the actuator, at least 0; the limiter acts after it.
    pub gain: f32,
}

impl Default for Drive {
    /// As measured: not muted, with a gain of one.
    fn default() -> Self {
        Self { muted: false, gain: 1.0 }
    }
}

impl Drive {
    /// The gain to fade to: zero when muted, or where the gain is not a number from zero up.
    pub(crate) fn target(self) -> f32 {
        if self.muted || !(self.gain.is_finite() && self.gain >= 0.0) { 0.0 } else { self.gain }
    }
}

/// All that an engine can be told at once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Controls {
    /// Which textures sound, and how they are blended.
    pub mix: Mix,
    /// What a landing sounds like.
    pub tap: Tap,
    /// How much of it goes out.
    pub drive: Drive,
    /// What moves over them.
    pub input: Input,
}

impl Default for Controls {
    /// Nothing sounds, so that how it would be blended does not matter, and nothing moves.
    fn default() -> Self {
        Self {
            mix: Mix::silent(Blend::Power),
            tap: Tap::SILENT,
            drive: Drive::default(),
            input: Input::default(),
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
