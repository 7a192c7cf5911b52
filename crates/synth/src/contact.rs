//! Contact of the tip with the surface at one moment: the only input of a texture.

/// Tip speed and normal force on the surface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Contact {
    /// Tangential tip speed in m/s, at least 0.
    pub speed_mps: f32,
    /// Normal force in N; zero while the tip is lifted.
    pub force_n: f32,
}

impl Contact {
    /// No contact: speed and force are zero.
    pub const LIFTED: Self = Self { speed_mps: 0.0, force_n: 0.0 };

    /// Returns the contact with every value that is not finite and positive replaced by zero. Invalid input from a
    /// device therefore acts as a lifted tip and never as a strong contact.
    #[must_use]
    pub fn sanitized(self) -> Self {
        let clean = |x: f32| if x.is_finite() && x > 0.0 { x } else { 0.0 };
        Self { speed_mps: clean(self.speed_mps), force_n: clean(self.force_n) }
    }
}

/// Position of the tip on the pad.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Place {
    /// Position to the right, in m.
    pub x_m: f64,
    /// Position upwards, in m.
    pub y_m: f64,
    /// Number of jumps so far: position changes without a path between the two positions.
    pub n_jumps: u32,
}

/// Source of the contact that the renderer polls.
pub trait ContactSource {
    /// Returns the contact at `time_secs` of the model clock, which starts at zero and never decreases.
    fn contact_at(&mut self, time_secs: f64) -> Contact;

    /// Returns the tip position at the contact that was requested last. The default is a tip at rest at (0, 0) m.
    fn place(&self) -> Place {
        Place::default()
    }
}

/// A constant contact.
impl ContactSource for Contact {
    fn contact_at(&mut self, _time_secs: f64) -> Contact {
        *self
    }
}

#[cfg(test)]
mod tests {
    use super::Contact;

    #[test]
    fn nonsense_is_a_lifted_tip() {
        for bad in [f32::NAN, f32::INFINITY, -1.0, f32::NEG_INFINITY] {
            assert_eq!(Contact { speed_mps: bad, force_n: bad }.sanitized(), Contact::LIFTED);
        }
        let good = Contact { speed_mps: 0.1, force_n: 0.5 };
        assert_eq!(good.sanitized(), good);
    }
}
