//! Pointer on the pad.

/// Report of the pointer on the pad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MouseReport {
    /// Distance to the right of the center, in m.
    pub x_m: f64,
    /// Distance above the center, in m.
    pub y_m: f64,
    /// Whether the button is pressed.
    pub pressed: bool,
    /// Pressure, 0..1, if the window system reports it for a pen or a touch screen.
    pub pressure: Option<f64>,
}
