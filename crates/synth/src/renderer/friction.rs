//! Stick-slip vibration of a mix.

use crate::contact::Contact;
use crate::stick_slip::{Friction, StickSlip};

/// Stick-slip vibration with the mean friction of the textures that have one. A tip either sticks or slips, so there is
/// one model for all textures.
#[derive(Clone, Debug)]
pub(super) struct MixedFriction {
    model: StickSlip,
    /// Mean friction, kept where no texture has one.
    mean: Friction,
    /// Sum of the weights at the end of the last tick.
    weight: f32,
}

impl MixedFriction {
    /// A tip without friction at the model's sample rate in Hz.
    pub(super) fn new(rate_hz: f32) -> Self {
        Self { model: StickSlip::new(rate_hz), mean: Friction::default(), weight: 0.0 }
    }

    /// Clears the state of the tip.
    pub(super) fn reset(&mut self) {
        self.model.reset();
    }

    /// Adds a tick with contacts at its start and end. `parts` are the textures with friction, each with its weight at
    /// the start and at the end.
    pub(super) fn add_tick(
        &mut self,
        parts: impl Iterator<Item = (Friction, (f32, f32))>,
        contacts: (Contact, Contact),
        out: &mut [f32],
    ) {
        let mut end = 0.0;
        let parts = parts.map(|(friction, weights)| {
            end += weights.1;
            // A texture that fades in or out has a weight at one end of the tick only.
            (friction, weights.0 + weights.1)
        });
        if let Some((mean, _)) = Friction::mean(parts) {
            self.mean = mean;
        }
        let weights = (self.weight, end);
        self.weight = end;
        if weights.0 > 0.0 || weights.1 > 0.0 {
            self.model.add_tick(self.mean, contacts, weights, out);
        } else {
            self.model.reset();
        }
    }
}
