//! Frames of one block: textures and tap transients or a signal, the drive chain, and friction.

use shagreen_synth::drive::Driven;
use shagreen_synth::impact::share_of_range;
use shagreen_synth::lift_gate::Touching;

use crate::engine::friction_channel::Noting;
use crate::engine::{Engine, Returned};

impl Engine {
    /// Renders the next frames of the drive signal: textures and tap transients or a signal, then gain, equalizer and
    /// limiters.
    pub(super) fn render(&mut self, mono: &mut [f32]) {
        let Self { stream, slots, player, friction, mix, .. } = &mut *self;
        let (slots, mix) = (&*slots, &*mix);
        match friction {
            Some(channel) => {
                let mut noting = Noting { contacts: player, textures: slots, mix, channel };
                stream.process(slots, &mut noting, mono);
            }
            None => stream.process(slots, player, mono),
        }
        self.add_taps(mono);
        let touching = if self.signal.is_playing() { Touching::NotNeeded } else { self.touching() };
        let driven = self.signal.replace(mono);
        if driven == Driven::Acceleration {
            // Samples that do not fit are dropped: the scope is a display, not a recording.
            let _ = self.scope.push_partial_slice(mono);
            self.meter.note_signal(mono);
        }
        for sample in mono.iter_mut() {
            let (gain, unmuted) = (self.gain.next(), self.unmuted.next());
            *sample *= if driven == Driven::Drive { unmuted } else { gain };
        }
        self.chain.process(mono, driven, touching);
        if self.chain.is_silenced() && !self.is_at_rest {
            // The output is silent now. A filter that still oscillates would start the next contact with a jump.
            self.taps.reset();
            self.stream.silence();
        }
        self.is_at_rest = self.chain.is_silenced();
        self.meter.note_output(mono);
        self.frames_played += mono.len() as u64;
        self.stream_frames += mono.len() as u64;
        if let Some(played) = self.signal.take_played() {
            self.return_or_leak(Returned::Signal(played));
        }
    }

    /// Renders the friction of a block that begins at a frame of the stream. Returns the index of its channel.
    pub(super) fn render_friction(&mut self, first_frame: u64, friction: &mut [f32]) -> Option<usize> {
        let is_open = self.unmuted.target() > 0.0 && !self.signal.is_playing() && !self.chain.is_tripped();
        let channel = self.friction.as_mut()?;
        channel.set_open(is_open);
        channel.fill(first_frame, friction);
        Some(channel.channel_idx())
    }

    /// Last contact of the tip, in frames of the stream.
    fn touching(&self) -> Touching {
        let Some((landed_secs, touched_secs)) = self.player.contact_secs() else { return Touching::Never };
        let frame = |secs: f64| (secs * self.device_rate_hz).round() as u64;
        Touching::Span { landed: frame(landed_secs), touched: frame(touched_secs) }
    }

    /// Adds tap transients, starting at the exact frame of the contact onset.
    fn add_taps(&mut self, mono: &mut [f32]) {
        let stream_secs = self.stream_frames as f64 / self.device_rate_hz;
        if let Some(landing) = self.player.take_landing(stream_secs) {
            self.landing = Some(landing);
        }
        let mut rest = mono;
        if let Some(landing) = self.landing {
            let frame = (landing.stream_secs * self.device_rate_hz).round() as u64;
            let ahead = frame.saturating_sub(self.stream_frames) as usize;
            if ahead < rest.len() {
                let (before, after) = rest.split_at_mut(ahead);
                self.taps.add_to(before);
                // The gain is highest at one end of its ramp. A gain of zero permits any amplitude and silences it.
                let gain = self.gain.value().max(self.gain.target());
                let share = share_of_range(landing.strength);
                self.taps.strike(self.tap.within(share * self.tap_range_mps2 / gain), landing.strength);
                self.landing = None;
                self.player.note_contact(landing.stream_secs, landing.stream_secs);
                rest = after;
            }
        }
        self.taps.add_to(rest);
    }
}
