//! What the callback is told, all at once: a `Copy` struct, since its parts must agree.

use shagreen_synth::renderer::{Blend, Mix};
use shagreen_synth::tap::Tap;

use crate::hand::Hand;
use crate::repeat::Repeat;

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
    /// The last track that was given, from its start and again and again. A change of tempo or force goes on from where the
    /// tip is.
    Repeat(Repeat),
}

/// When a person's hand takes over from the chosen input by itself: from the block on that its report arrives in, whatever
/// the thread of a window does meanwhile. It does with a stylus that touches, or that says that it is near
/// ([`crate::live::LiveInput::hover`]). A landing sounds at once; the contact fades, as with every change of input.
///
/// The chosen input stands still while the person's hand is followed, and goes on from there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Takeover {
    /// How long after the stylus is neither near nor touching the chosen input goes on, in seconds.
    pub lifted_secs: f32,
    /// The same after the last report of a stylus that never said that it went, in seconds.
    pub stale_secs: f32,
}

impl Takeover {
    /// Between two taps of a mouse the hand stays; a pen may be held still for a while.
    pub const USUAL: Self = Self { lifted_secs: 0.3, stale_secs: 2.0 };
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
    /// Whether and when a person's hand does in its place.
    pub takeover: Option<Takeover>,
}

impl Default for Controls {
    /// Nothing sounds, so that how it would be blended does not matter, and nothing moves.
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
