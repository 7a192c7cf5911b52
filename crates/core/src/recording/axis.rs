//! One axis of acceleration, as input to the detection of dropouts and spikes.

/// Axis of acceleration to check; values are in file order.
pub(super) struct Axis<'a> {
    /// Column name for findings.
    pub(super) column: &'a str,
    /// Acceleration in m/s².
    pub(super) values: &'a [f64],
    /// Full scale of the sensor in m/s², if known.
    pub(super) full_scale_mps2: Option<f64>,
}
