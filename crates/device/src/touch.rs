//! Position and contact of the tip.

use shagreen_synth::contact::Contact;

/// State of the tip on the pad at one moment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Touch {
    /// Position from the pad's center towards its right edge, in m.
    pub x_m: f32,
    /// Position from the pad's center towards its upper edge, in m.
    pub y_m: f32,
    /// Speed and force of the tip; a force of zero is a lifted tip.
    pub contact: Contact,
}

impl Touch {
    /// Returns the touch at the same position with a lifted tip.
    #[must_use]
    pub fn lifted(self) -> Self {
        Self { contact: Contact::LIFTED, ..self }
    }

    /// Returns the touch with invalid values of a faulty device replaced: see [`Contact::sanitized`].
    #[must_use]
    pub fn sanitized(self) -> Self {
        let clean = |x: f32| if x.is_finite() { x } else { 0.0 };
        Self { x_m: clean(self.x_m), y_m: clean(self.y_m), contact: self.contact.sanitized() }
    }
}

/// Linear interpolation between two contacts, with `share` in 0..1.
pub(crate) fn mix_contacts(from: Contact, to: Contact, share: f32) -> Contact {
    let mix = |a: f32, b: f32| a + share * (b - a);
    Contact { speed_mps: mix(from.speed_mps, to.speed_mps), force_n: mix(from.force_n, to.force_n) }
}

#[cfg(test)]
mod tests {
    use super::{Contact, Touch, mix_contacts};

    #[test]
    fn nonsense_is_a_lifted_tip_in_the_middle() {
        let bad = Touch {
            x_m: f32::NAN,
            y_m: f32::INFINITY,
            contact: Contact { speed_mps: f32::NAN, force_n: -1.0 },
        };
        assert_eq!(bad.sanitized(), Touch::default());
        let good = Touch { x_m: -0.01, y_m: 0.02, contact: Contact { speed_mps: 0.1, force_n: 0.5 } };
        assert_eq!(good.sanitized(), good);
        assert_eq!(good.lifted(), Touch { contact: Contact::LIFTED, ..good });
    }

    #[test]
    fn contacts_mix_in_a_straight_line() {
        let (a, b) = (Contact { speed_mps: 0.1, force_n: 1.0 }, Contact { speed_mps: 0.3, force_n: 0.0 });
        assert_eq!(mix_contacts(a, b, 0.0), a);
        let middle = mix_contacts(a, b, 0.5);
        assert!((middle.speed_mps - 0.2).abs() < 1e-7 && (middle.force_n - 0.5).abs() < 1e-7);
    }
}
