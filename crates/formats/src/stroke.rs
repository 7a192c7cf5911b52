//! A recorded stroke, whatever file it came from.

/// One report of a pen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PenSample {
    /// When, in seconds on any clock; never before the sample ahead of it.
    pub time_secs: f64,
    /// Position to the right, in m.
    pub x_m: f64,
    /// Position away from the person, in m.
    pub y_m: f64,
    /// How hard the tip is pressed, in the unit of [`Stroke::Pen`].
    pub press: f64,
    /// Whether the tip touches.
    pub touching: bool,
}

/// What [`PenSample::press`] counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PressUnit {
    /// A share of the pen's full scale, 0..1: a map to newtons is still needed.
    FullScale,
    /// Newtons.
    Newtons,
}

/// Speed and force at one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimedContact {
    /// When, in seconds; later than the contact ahead of it.
    pub time_secs: f64,
    /// Tangential speed, in m/s, at least zero.
    pub speed_mps: f64,
    /// Normal force, in N, at least zero; zero while the tip is lifted.
    pub force_n: f64,
}

/// A stroke.
#[derive(Clone, Debug, PartialEq)]
pub enum Stroke {
    /// Where a pen was; its speed is still to be estimated.
    Pen {
        /// At least one.
        samples: Vec<PenSample>,
        /// What their pressure counts.
        press_unit: PressUnit,
    },
    /// Speed and force as they are.
    Contacts(Vec<TimedContact>),
}
