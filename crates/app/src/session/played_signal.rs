//! What plays instead of the authored texture: a signal of the Signals workspace, or a stimulus of a study.

use std::sync::Arc;
use std::time::Instant;

use egui::Context;
use shagreen_core::texture::plane::Plane;
use shagreen_core::units::Hertz;
use shagreen_device::synth::tap::Tap;

use super::Session;
use super::audible::Audible;
use super::path_walk::PathWalk;
use super::presented_texture::PresentedTexture;
use crate::state::bench_signal::BenchSignal;

/// What plays under the pen instead of the authored texture.
pub(super) struct PlayedSignal {
    played: Played,
    /// Whether it has not been sent to the output yet.
    pub(super) is_new: bool,
    /// The stroke along the path of a stimulus.
    walk: Option<PathWalk>,
    /// Key of this path that plays.
    key: usize,
}

#[derive(Clone)]
enum Played {
    Signal(Arc<BenchSignal>),
    Stimulus(Arc<PresentedTexture>),
    /// Nothing, at a sample rate if one is known.
    Silence(Option<Hertz>),
}

/// What a study plays instead of the texture of the project.
#[derive(Clone, Copy, Debug)]
pub enum Presented<'a> {
    /// Nothing, while the output is open at the sample rate of the stimuli to come, if it is known: opening it takes time.
    Silence(Option<Hertz>),
    /// A stimulus.
    Stimulus(&'a Arc<PresentedTexture>),
}

impl Played {
    fn is_same(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Signal(one), Self::Signal(other)) => Arc::ptr_eq(one, other),
            (Self::Stimulus(one), Self::Stimulus(other)) => Arc::ptr_eq(one, other),
            (Self::Silence(one), Self::Silence(other)) => one == other,
            _ => false,
        }
    }
}

impl PlayedSignal {
    fn new(played: Played) -> Self {
        let path = if let Played::Stimulus(stimulus) = &played { stimulus.path() } else { None };
        Self { walk: path.map(|path| PathWalk::new(path.along())), key: 0, is_new: true, played }
    }
}

impl Session {
    /// Plays a signal under the pen, or the authored texture again.
    pub fn feel(&mut self, signal: Option<&Arc<BenchSignal>>) {
        self.play_instead(signal.map(|signal| Played::Signal(Arc::clone(signal))));
    }

    /// Plays a stimulus of a study under the pen, or nothing.
    pub fn present(&mut self, presented: Presented<'_>) {
        self.play_instead(Some(match presented {
            Presented::Silence(rate) => Played::Silence(rate),
            Presented::Stimulus(stimulus) => Played::Stimulus(Arc::clone(stimulus)),
        }));
    }

    fn play_instead(&mut self, played: Option<Played>) {
        let is_same = match (&self.sound.felt, &played) {
            (Some(felt), Some(played)) => felt.played.is_same(played),
            (felt, played) => felt.is_none() && played.is_none(),
        };
        if !is_same {
            self.sound.felt = played.map(PlayedSignal::new);
            if self.sound.felt.is_none() {
                // What played is no authored texture, and no path advanced meanwhile.
                (self.sound.heard, self.sound.player.mix_is_new) = (Audible::default(), true);
                self.authored.walk = self.authored.walk.map(|walk| PathWalk::new(walk.along()));
                self.authored.walk_alone = None;
            }
            // Forces the next texture to be computed.
            self.sound.player.wanted = None;
        }
    }

    pub(super) fn felt_signal(&self) -> Option<&Arc<BenchSignal>> {
        match &self.sound.felt.as_ref()?.played {
            Played::Signal(signal) => Some(signal),
            Played::Stimulus(_) | Played::Silence(_) => None,
        }
    }

    /// Name of the signal that plays under the pen. Stimuli of a study have none.
    pub fn felt_name(&self) -> Option<&str> {
        self.felt_signal().map(|signal| signal.name.as_str())
    }

    /// Sends what is new to the output. Returns whether something plays instead of the texture.
    pub(super) fn follow_felt(&mut self, ctx: &Context) -> bool {
        let touch = self.touch();
        let Some(felt) = &mut self.sound.felt else { return false };
        if let (Some(walk), Played::Stimulus(stimulus)) = (&mut felt.walk, &felt.played)
            && let Some(path) = stimulus.path()
        {
            walk.advance(touch, Instant::now());
            let key = walk.nearest_key(path);
            felt.is_new |= std::mem::replace(&mut felt.key, key) != key;
        }
        if !std::mem::take(&mut felt.is_new) {
            return true;
        }
        let (played, key) = (felt.played.clone(), felt.key);
        self.authored.current = None;
        self.sound.player.tap = Tap::SILENT;
        match played {
            Played::Signal(signal) => self.play_signal(&signal, ctx),
            Played::Stimulus(stimulus) => {
                self.sound.heard = stimulus.audible(key, &mut self.authored.n_made);
                self.sound.player.tap = stimulus.tap();
                self.set_rate(stimulus.rate().0, ctx);
            }
            Played::Silence(rate) => {
                self.sound.heard = Audible::default();
                if let Some(rate) = rate {
                    self.set_rate(rate.0, ctx);
                }
            }
        }
        self.sound.player.mix_is_new = true;
        true
    }

    fn play_signal(&mut self, signal: &BenchSignal, ctx: &Context) {
        match signal.texture() {
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
    }
}
