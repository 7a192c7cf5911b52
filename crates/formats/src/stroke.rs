//! A recorded stroke, independent of its file format.

/// One report of a pen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PenSample {
    /// Time in seconds on any clock; never before that of the previous sample.
    pub time_secs: f64,
    /// Position to the right, in m.
    pub x_m: f64,
    /// Position away from the user, in m.
    pub y_m: f64,
    /// Pressure or force of the tip, in the unit of [`Stroke::Pen`].
    pub press: f64,
    /// Whether the tip is in contact.
    pub touching: bool,
    /// Speed towards the surface in m/s, non-negative, if known; it counts where a contact begins.
    pub impact_mps: Option<f64>,
}

/// Unit of [`PenSample::press`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PressUnit {
    /// Fraction of the pen's full scale, 0..1; needs a map to newtons.
    FullScale,
    /// Newtons.
    Newtons,
}

/// Speed and force at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimedContact {
    /// Time in seconds; later than that of the previous contact.
    pub time_secs: f64,
    /// Tangential speed in m/s, non-negative.
    pub speed_mps: f64,
    /// Normal force in N, non-negative; zero while the tip is lifted.
    pub force_n: f64,
    /// Speed towards the surface in m/s, non-negative, if known; it counts where a contact begins.
    pub impact_mps: Option<f64>,
}

/// A stroke.
#[derive(Clone, Debug, PartialEq)]
pub enum Stroke {
    /// Positions of a pen; its speed remains to be estimated.
    Pen {
        /// At least one sample.
        samples: Vec<PenSample>,
        /// Unit of the samples' `press`.
        press_unit: PressUnit,
    },
    /// Measured speed and force.
    Contacts(Vec<TimedContact>),
}
