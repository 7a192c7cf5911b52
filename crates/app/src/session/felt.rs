//! A signal of the bench that is felt in the place of what is authored.

use std::sync::Arc;

use egui::Context;
use shagreen_core::plane::Plane;
use shagreen_device::synth::tap::Tap;

use super::Session;
use super::heard::Heard;
use super::path_walk::PathWalk;
use crate::signals::bench_signal::BenchSignal;

/// A signal that the pen feels.
pub(super) struct Felt {
    signal: Arc<BenchSignal>,
    /// Whether it is not heard yet.
    pub(super) is_new: bool,
}

impl Session {
    /// Lets the pen feel a signal, or what is authored again.
    pub fn feel(&mut self, signal: Option<&Arc<BenchSignal>>) {
        let is_same = match (&self.felt, signal) {
            (Some(felt), Some(signal)) => Arc::ptr_eq(&felt.signal, signal),
            (felt, signal) => felt.is_none() && signal.is_none(),
        };
        if !is_same {
            self.felt = signal.map(|signal| Felt { signal: Arc::clone(signal), is_new: true });
            if self.felt.is_none() {
                // What was felt is nothing that was authored, and meanwhile no path went on.
                (self.heard, self.player.mix_is_new) = (Heard::default(), true);
                self.walk = self.walk.map(|walk| PathWalk::new(walk.along()));
                self.walk_alone = None;
            }
            // What comes next is found anew.
            self.player.wanted = None;
        }
    }

    /// The signal that the pen feels.
    pub(super) fn felt_signal(&self) -> Option<&Arc<BenchSignal>> {
        self.felt.as_ref().map(|felt| &felt.signal)
    }

    /// The name of the signal that the pen feels, where it feels one.
    pub fn felt_name(&self) -> Option<&str> {
        self.felt.as_ref().map(|felt| felt.signal.name.as_str())
    }

    /// The signal that is to be felt is heard; returns whether there is one.
    pub(super) fn follow_felt(&mut self, ctx: &Context) -> bool {
        let Some(felt) = &mut self.felt else { return false };
        if !std::mem::take(&mut felt.is_new) {
            return true;
        }
        self.authored = None;
        match felt.signal.texture() {
            Ok(model) => {
                self.n_made += 1;
                self.heard = Heard::made_alone(Plane::new(&model), self.n_made);
                self.set_rate(model.rate().0, ctx);
            }
            Err(reason) => {
                self.heard = Heard::default();
                self.say(reason);
            }
        }
        self.player.tap = Tap::SILENT;
        self.player.mix_is_new = true;
        true
    }
}
