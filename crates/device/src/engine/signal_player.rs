//! A signal in the place of the texture: the texture fades, the signal plays, the texture comes back.

use shagreen_synth::drive::Driven;

use super::meter::Ramp;
use crate::signal::Signal;

/// What plays signals.
#[derive(Debug)]
pub(super) struct SignalPlayer {
    playing: Option<Box<Signal>>,
    next_frame: usize,
    played: Option<Box<Signal>>,
    texture: Ramp,
    signal: Ramp,
    n_stops: u32,
}

impl SignalPlayer {
    /// Nothing is played; fades take so many frames.
    pub(super) fn new(fade_frames: u32) -> Self {
        Self {
            playing: None,
            next_frame: 0,
            played: None,
            texture: Ramp::at(1.0, fade_frames),
            signal: Ramp::at(1.0, fade_frames),
            n_stops: 0,
        }
    }

    /// Takes a signal, to be played once the texture has faded; gives back the one that it ends.
    pub(super) fn play(&mut self, signal: Box<Signal>) -> Option<Box<Signal>> {
        self.next_frame = 0;
        self.signal.jump(1.0);
        self.playing.replace(signal)
    }

    /// Lets the signal fade where that was wished once more.
    pub(super) fn follow(&mut self, n_stops: u32) {
        if n_stops != self.n_stops {
            self.n_stops = n_stops;
            if self.playing.is_some() {
                self.signal.aim(0.0);
            }
        }
    }

    /// Whether there is a signal, or the texture has not begun to come back.
    pub(super) fn is_playing(&self) -> bool {
        self.playing.is_some()
    }

    /// Puts the signal in the place of the texture's samples, and says what they are now.
    pub(super) fn replace(&mut self, mono: &mut [f32]) -> Driven {
        self.texture.aim(if self.playing.is_some() { 0.0 } else { 1.0 });
        if let Some(signal) = self.playing.as_ref().filter(|_| self.texture.is_at(0.0)) {
            let part = signal.part(self.next_frame, mono.len());
            let (begun, rest) = mono.split_at_mut(part.len());
            for (sample, signal) in begun.iter_mut().zip(part) {
                *sample = *signal * self.signal.next();
            }
            rest.fill(0.0);
            self.next_frame += begun.len();
            let driven = signal.driven();
            if self.next_frame >= signal.n_frames() || self.signal.is_at(0.0) {
                self.played = self.playing.take();
            }
            return driven;
        }
        for sample in mono {
            *sample *= self.texture.next();
        }
        Driven::Acceleration
    }

    /// The signal that has ended, to be freed.
    pub(super) fn take_played(&mut self) -> Option<Box<Signal>> {
        self.played.take()
    }
}
