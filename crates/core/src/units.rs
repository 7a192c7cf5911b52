//! Quantities with their units: what crosses a public boundary says what it is.

use std::fmt;

macro_rules! quantity {
    ($(#[$doc:meta])* $name:ident, $suffix:literal) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
        pub struct $name(pub f64);

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "{} {}", self.0, $suffix)
            }
        }
    };
}

quantity!(
    /// A rate or frequency in Hz.
    Hertz,
    "Hz"
);
quantity!(
    /// A force in N.
    Newtons,
    "N"
);
quantity!(
    /// A speed in m/s.
    MetersPerSecond,
    "m/s"
);

quantity!(
    /// An electric tension in V.
    Volts,
    "V"
);
quantity!(
    /// A mass in kg.
    Kilograms,
    "kg"
);

impl MetersPerSecond {
    /// A speed given in mm/s, the unit of hands and of the command line.
    pub fn from_mm_per_s(mm_per_s: f64) -> Self {
        Self(mm_per_s * 1e-3)
    }

    /// The speed in mm/s.
    pub fn mm_per_s(self) -> f64 {
        self.0 * 1e3
    }
}

impl Kilograms {
    /// A mass given in g, the unit of pens and of data sheets.
    pub fn from_g(g: f64) -> Self {
        Self(g * 1e-3)
    }

    /// The mass in g.
    pub fn g(self) -> f64 {
        self.0 * 1e3
    }
}

/// Speed and normal force of the tip on the surface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Contact {
    /// Tangential speed of the tip.
    pub speed: MetersPerSecond,
    /// Normal force, zero when the tip is lifted.
    pub force: Newtons,
}

impl Contact {
    /// A contact from the units of hands: mm/s and N.
    pub fn from_mm_per_s_and_n(mm_per_s: f64, force_n: f64) -> Self {
        Self { speed: MetersPerSecond::from_mm_per_s(mm_per_s), force: Newtons(force_n) }
    }
}
