//! What the hand does at one moment: the only input that a texture has.

/// Speed and normal force of the tip on the surface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Contact {
    /// Tangential speed of the tip in m/s, not negative.
    pub speed_mps: f32,
    /// Normal force in N; zero when the tip is lifted.
    pub force_n: f32,
}

impl Contact {
    /// The tip in the air.
    pub const LIFTED: Self = Self { speed_mps: 0.0, force_n: 0.0 };

    /// The same contact with anything that is not a positive finite number replaced by zero: an input device that
    /// sends nonsense is a lifted tip, never a loud one.
    #[must_use]
    pub fn sanitized(self) -> Self {
        let clean = |x: f32| if x.is_finite() && x > 0.0 { x } else { 0.0 };
        Self { speed_mps: clean(self.speed_mps), force_n: clean(self.force_n) }
    }
}

/// Where the tip is along a relief.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Place {
    /// The place in m.
    pub x_m: f64,
    /// How often it was somewhere else of a sudden, without a way there.
    pub n_jumps: u32,
}

/// Where the renderer asks what the hand does.
pub trait ContactSource {
    /// The contact at `time_secs` of the model clock, which starts at zero and never goes back.
    fn contact_at(&mut self, time_secs: f64) -> Contact;

    /// Where the tip was at the contact that was asked for last: a hand that says nothing of it stands still.
    fn place(&self) -> Place {
        Place::default()
    }
}

/// A hand that never changes.
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
