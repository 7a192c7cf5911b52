//! Playback of a signal instead of the texture: the texture fades out, the signal plays, the texture fades in.

use shagreen_synth::drive::Driven;

use super::meter::Ramp;
use crate::signal::Signal;

/// A signal with the number of stop requests that were sent before it.
#[derive(Debug)]
struct Wanted {
    signal: Box<Signal>,
    n_stops: u32,
}

impl Wanted {
    /// Whether one of `n_stops` requests was sent after the signal. A signal may arrive before earlier stop requests.
    fn is_stopped(&self, n_stops: u32) -> bool {
        n_stops.wrapping_sub(self.n_stops).cast_signed() > 0
    }
}

/// Player of signals.
#[derive(Debug)]
pub(super) struct SignalPlayer {
    playing: Option<Wanted>,
    /// Signal to start after `playing` has faded out.
    next: Option<Wanted>,
    next_frame: usize,
    played: Option<Box<Signal>>,
    texture: Ramp,
    signal: Ramp,
}

impl SignalPlayer {
    /// A player without a signal, with a fade length in frames.
    pub(super) fn new(fade_frames: u32) -> Self {
        Self {
            playing: None,
            next: None,
            next_frame: 0,
            played: None,
            texture: Ramp::at(1.0, fade_frames),
            signal: Ramp::at(1.0, fade_frames),
        }
    }

    /// Takes a signal that was sent after `n_stops` stop requests. It plays after the texture or the previous signal
    /// has faded out. Returns a signal that it replaces before that one has started.
    pub(super) fn play(&mut self, signal: Box<Signal>, n_stops: u32) -> Option<Box<Signal>> {
        let wanted = Wanted { signal, n_stops };
        let unheard = if self.next_frame > 0 {
            self.signal.aim(0.0);
            self.next.replace(wanted)
        } else {
            self.signal.jump(1.0);
            self.playing.replace(wanted)
        };
        unheard.map(|wanted| wanted.signal)
    }

    /// Fades out the signal that the last of `n_stops` requests applies to. Returns stopped signals that have not
    /// started.
    pub(super) fn follow(&mut self, n_stops: u32) -> [Option<Box<Signal>>; 2] {
        let is_stopped = |wanted: &mut Wanted| wanted.is_stopped(n_stops);
        let waiting = self.next.take_if(is_stopped);
        let begun = self.next_frame > 0;
        let unheard = if begun { None } else { self.playing.take_if(is_stopped) };
        if begun && self.playing.as_mut().is_some_and(is_stopped) {
            self.signal.aim(0.0);
        }
        [waiting, unheard].map(|wanted| wanted.map(|wanted| wanted.signal))
    }

    /// Whether a signal is playing or waiting.
    pub(super) fn is_playing(&self) -> bool {
        self.playing.is_some()
    }

    /// Replaces the texture's samples by the signal's. Returns the kind of the resulting samples.
    pub(super) fn replace(&mut self, mono: &mut [f32]) -> Driven {
        self.texture.aim(if self.playing.is_some() { 0.0 } else { 1.0 });
        if let Some(Wanted { signal, .. }) = self.playing.as_ref().filter(|_| self.texture.is_at(0.0)) {
            let part = signal.part(self.next_frame, mono.len());
            let (begun, rest) = mono.split_at_mut(part.len());
            for (sample, signal) in begun.iter_mut().zip(part) {
                *sample = *signal * self.signal.next();
            }
            rest.fill(0.0);
            self.next_frame += begun.len();
            let driven = signal.driven();
            if self.next_frame >= signal.n_frames() || self.signal.is_at(0.0) {
                self.played = self.playing.take().map(|wanted| wanted.signal);
                self.playing = self.next.take();
                self.next_frame = 0;
                self.signal.jump(1.0);
            }
            return driven;
        }
        for sample in mono {
            *sample *= self.texture.next();
        }
        Driven::Acceleration
    }

    /// Takes the signal that has ended, to be freed.
    pub(super) fn take_played(&mut self) -> Option<Box<Signal>> {
        self.played.take()
    }
}
