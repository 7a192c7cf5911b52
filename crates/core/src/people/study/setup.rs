//! Devices with which a participant answers, so that an analysis can judge the answers.

/// Devices of a session, as they are from one of its events on.
#[derive(Clone, Debug, PartialEq)]
pub struct Setup {
    /// Output that drives the actuator; `None` for the silent output, and for a closed or muted one: nothing was felt.
    pub output: Option<OutputDevice>,
    /// Identifier of the actuator profile; `None` if no profile was selected, so that the signal was not equalized.
    pub actuator: Option<String>,
    /// Name of the output that plays the masking noise; `None` if none plays it.
    pub masking: Option<String>,
    /// Name of the pen; `None` if the tip followed the pointer of the window.
    pub pen: Option<String>,
    /// Scale of the screen, which determines the length of sliders.
    pub screen: ScreenScale,
    /// Name and version of the program.
    pub program: String,
}

/// An output.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OutputDevice {
    /// Identifier, which begins with the kind of the output.
    pub id: String,
    /// Name for display.
    pub name: String,
}

/// Scale of the screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ScreenScale {
    /// Measured on the screen.
    Measured {
        /// Pixels in each mm.
        pixels_per_mm: f64,
    },
    /// Assumed, because nobody measured it: lengths on the screen are not known.
    Assumed {
        /// Pixels in each mm.
        pixels_per_mm: f64,
    },
}

impl ScreenScale {
    /// Whether the scale was measured.
    pub fn is_measured(self) -> bool {
        matches!(self, Self::Measured { .. })
    }

    /// Pixels in each mm.
    pub fn pixels_per_mm(self) -> f64 {
        match self {
            Self::Measured { pixels_per_mm } | Self::Assumed { pixels_per_mm } => pixels_per_mm,
        }
    }
}
