//! A signal of the Signals workspace that plays instead of the authored texture.

use std::sync::Arc;

use egui::Context;
use shagreen_core::texture::plane::Plane;
use shagreen_device::synth::tap::Tap;

use super::Session;
use super::audible::Audible;
use super::path_walk::PathWalk;
use crate::state::bench_signal::BenchSignal;

/// Signal that plays under the pen.
pub(super) struct PlayedSignal {
    signal: Arc<BenchSignal>,
    /// Whether it has not been sent to the output yet.
    pub(super) is_new: bool,
}

impl Session {
    /// Plays a signal under the pen, or the authored texture again.
    pub fn feel(&mut self, signal: Option<&Arc<BenchSignal>>) {
        let is_same = match (&self.sound.felt, signal) {
            (Some(felt), Some(signal)) => Arc::ptr_eq(&felt.signal, signal),
            (felt, signal) => felt.is_none() && signal.is_none(),
        };
        if !is_same {
            self.sound.felt = signal.map(|signal| PlayedSignal { signal: Arc::clone(signal), is_new: true });
            if self.sound.felt.is_none() {
                // The signal is no authored texture, and no path advanced while it played.
                (self.sound.heard, self.sound.player.mix_is_new) = (Audible::default(), true);
                self.authored.walk = self.authored.walk.map(|walk| PathWalk::new(walk.along()));
                self.authored.walk_alone = None;
            }
            // Forces the next texture to be computed.
            self.sound.player.wanted = None;
        }
    }

    pub(super) fn felt_signal(&self) -> Option<&Arc<BenchSignal>> {
        self.sound.felt.as_ref().map(|felt| &felt.signal)
    }

    /// Name of the signal that plays under the pen.
    pub fn felt_name(&self) -> Option<&str> {
        self.sound.felt.as_ref().map(|felt| felt.signal.name.as_str())
    }

    /// Sends a new signal to the output. Returns whether a signal plays instead of the texture.
    pub(super) fn follow_felt(&mut self, ctx: &Context) -> bool {
        let Some(felt) = &mut self.sound.felt else { return false };
        if !std::mem::take(&mut felt.is_new) {
            return true;
        }
        self.authored.current = None;
        match felt.signal.texture() {
            Ok(model) => {
                self.authored.n_made += 1;
                self.sound.heard = Audible::made_alone(Plane::new(&model), self.authored.n_made);
                self.set_rate(model.rate().0, ctx);
            }
            Err(reason) => {
                self.sound.heard = Audible::default();
                self.say(reason);
            }
        }
        self.sound.player.tap = Tap::SILENT;
        self.sound.player.mix_is_new = true;
        true
    }
}
