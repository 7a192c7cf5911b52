//! Quantities with units, used in public signatures.

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
    /// A voltage in V.
    Volts,
    "V"
);
quantity!(
    /// A mass in kg.
    Kilograms,
    "kg"
);
quantity!(
    /// An angle in rad.
    Radians,
    "rad"
);

impl MetersPerSecond {
    /// Speed from a value in mm/s, the unit that the command line uses.
    pub fn from_mm_per_s(mm_per_s: f64) -> Self {
        Self(mm_per_s * 1e-3)
    }

    /// Value in mm/s.
    pub fn mm_per_s(self) -> f64 {
        self.0 * 1e3
    }
}

impl Kilograms {
    /// Mass from a value in g, the unit that data sheets use.
    pub fn from_g(g: f64) -> Self {
        Self(g * 1e-3)
    }

    /// Value in g.
    pub fn g(self) -> f64 {
        self.0 * 1e3
    }
}

impl Radians {
    /// Angle from a value in degrees, the unit that files and the command line use.
    pub fn from_degrees(degrees: f64) -> Self {
        Self(degrees.to_radians())
    }
}

/// Tip speed and normal force on the surface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Contact {
    /// Tangential tip speed.
    pub speed: MetersPerSecond,
    /// Normal force, zero when the tip is lifted.
    pub force: Newtons,
}

/// The contact as the renderer has it, in `f32`.
impl From<Contact> for shagreen_synth::contact::Contact {
    fn from(contact: Contact) -> Self {
        Self { speed_mps: contact.speed.0 as f32, force_n: contact.force.0 as f32 }
    }
}

impl From<shagreen_synth::contact::Contact> for Contact {
    fn from(contact: shagreen_synth::contact::Contact) -> Self {
        Self {
            speed: MetersPerSecond(f64::from(contact.speed_mps)),
            force: Newtons(f64::from(contact.force_n)),
        }
    }
}

impl Contact {
    /// Contact from a tip speed in mm/s and a normal force in N.
    pub fn from_mm_per_s_and_n(mm_per_s: f64, force_n: f64) -> Self {
        Self { speed: MetersPerSecond::from_mm_per_s(mm_per_s), force: Newtons(force_n) }
    }
}
