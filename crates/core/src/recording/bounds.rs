//! Largest magnitude of each recorded quantity that counts as a measurement.

use crate::texture::{FORCES_N, LEVELS_MPS2, SPEEDS_MPS};

/// Largest magnitude, in any SI unit, of a value that can be interpolated.
pub(super) const MOST: f64 = 1e9;

/// Largest valid magnitude of a quantity.
pub(super) struct Bound {
    /// Largest magnitude, in `unit`.
    pub(super) most: f64,
    /// SI unit.
    pub(super) unit: &'static str,
}

/// Above these limits a model cannot be rendered.
pub(super) const ACCELERATION: Bound = Bound { most: *LEVELS_MPS2.end(), unit: "m/s²" };
pub(super) const SPEED: Bound = Bound { most: *SPEEDS_MPS.end(), unit: "m/s" };
pub(super) const FORCE: Bound = Bound { most: *FORCES_N.end(), unit: "N" };
pub(super) const POSITION: Bound = Bound { most: MOST, unit: "m" };
