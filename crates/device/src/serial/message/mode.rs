//! What a host sends to a receiver.

/// Rendering mode.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mode {
    /// The host renders and streams samples.
    #[default]
    Stream,
    /// The host sends speed and force, and the receiver renders.
    Control,
    /// The host streams levels of friction, 0 to 32767, to a display that renders friction.
    Friction,
}

impl Mode {
    /// Number of the mode in a frame.
    pub(super) fn code(self) -> u8 {
        match self {
            Self::Stream => 0,
            Self::Control => 1,
            Self::Friction => 2,
        }
    }

    /// Mode with this number, if there is one.
    pub(super) fn of_code(code: u8) -> Option<Self> {
        [Self::Stream, Self::Control, Self::Friction].into_iter().find(|mode| mode.code() == code)
    }

    /// Whether the host sends samples, of the drive signal or of friction.
    pub fn is_streamed(self) -> bool {
        self != Self::Control
    }

    /// Lowest sample that a receiver plays under a ceiling: friction has no sign.
    pub(in crate::serial) fn floor(self, ceiling: i32) -> i32 {
        if self == Self::Friction { 0 } else { -ceiling }
    }
}
