//! Waveforms of haptic pens.

/// A waveform by its usage id on the haptics page.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Waveform(pub u16);

impl Waveform {
    /// No waveform; what plays goes on.
    pub const NONE: Self = Self(0x1001);
    /// Ends what plays.
    pub const STOP: Self = Self(0x1002);
    /// A click; every haptic pen has it.
    pub const CLICK: Self = Self(0x1003);
    /// Ball pen; every haptic pen has it.
    pub const INK: Self = Self(0x100b);
    /// Pencil.
    pub const PENCIL: Self = Self(0x100c);
    /// Felt pen.
    pub const MARKER: Self = Self(0x100d);
    /// Felt pen with a broad tip.
    pub const CHISEL_MARKER: Self = Self(0x100e);
    /// Brush.
    pub const BRUSH: Self = Self(0x100f);
    /// Eraser.
    pub const ERASER: Self = Self(0x1010);
    /// Effect pen.
    pub const SPARKLE: Self = Self(0x1011);

    /// Usage ids that waveforms have, those of vendors included.
    pub(crate) const IDS: std::ops::RangeInclusive<i64> = 0x1001..=0x2fff;

    /// Whether it is one of the continuous waveforms, which play until they are stopped.
    pub fn is_continuous(self) -> bool {
        (Self::INK..=Self::SPARKLE).contains(&self)
    }

    /// Name in plain words.
    pub fn name(self) -> &'static str {
        match self {
            Self::NONE => "none",
            Self::STOP => "stop",
            Self::CLICK => "click",
            Self::INK => "ball pen",
            Self::PENCIL => "pencil",
            Self::MARKER => "marker",
            Self::CHISEL_MARKER => "chisel marker",
            Self::BRUSH => "brush",
            Self::ERASER => "eraser",
            Self::SPARKLE => "sparkle",
            _ => "other waveform",
        }
    }
}

/// A waveform at an intensity; `None` is silence.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Play {
    /// The waveform.
    pub waveform: Option<Waveform>,
    /// Intensity in percent, 0 to 100.
    pub intensity_percent: u8,
}

impl Play {
    /// Silence.
    pub const SILENCE: Self = Self { waveform: None, intensity_percent: 0 };
}
