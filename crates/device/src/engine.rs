//! What the callback runs, and the handle by which it is told what to do.
//!
//! 1. [`new`] makes both halves; the [`Engine`] goes into the callback, the [`Handle`] stays.
//! 2. [`Handle::load`] sends textures down; [`Handle::set_mix`], [`Handle::set_input`] and [`Handle::set_drive`] say
//!    what to do with them.
//! 3. The device calls [`Engine::process`] for every block, which never allocates, frees, locks, waits or panics.
//! 4. [`Handle::unload`] lets a texture fade out and come back; [`Handle::collect`] frees what came back. Call it
//!    often: every picture of a window, or every tenth of a second.
//!
//! An engine whose handle is gone fades out: nobody could mute it any more.

mod config;
mod handle;
mod meter;
mod place;
mod player;
mod signal_player;
mod slots;
#[cfg(test)]
mod tests;

use std::time::{Duration, Instant};

use rtrb::{Consumer, Producer, PushError, RingBuffer};
use shagreen_synth::drive::{DriveChain, Driven};
use shagreen_synth::renderer::{Mix, TextureId};
use shagreen_synth::stream::Stream;
use shagreen_synth::tap::{Tap, Taps};
use triple_buffer::triple_buffer;

pub use self::config::{ChannelMask, ConfigError, EngineConfig};
pub use self::handle::{Handle, LoadError, LoadReason, MixError};
pub use crate::link::{STALL_SECS, START_SECS};

use self::meter::{Meter, Ramp};
use self::player::{Landing, Player};
use self::signal_player::SignalPlayer;
use self::slots::Slots;
use crate::controls::{Controls, Input};
use crate::live::{LiveInput, TimedTouch};
use crate::signal::Signal;
use crate::status::{Latency, LinkState, Status};
use crate::texture::OwnedTexture;
use crate::touch::Touch;
use crate::track::Track;

/// Textures that an engine can hold at once.
pub const SLOTS: usize = 64;
/// How long muting, a gain or a change of input takes, in seconds.
pub const FADE_SECS: f64 = 0.02;
/// Orders that can wait for the next block.
const COMMANDS: usize = 128;
/// Things that can wait to be freed.
const RETURNED: usize = 32;
/// Touches that can wait for the next block: a quarter of a second of a fast stylus.
const TOUCHES: usize = 256;
/// Ways in for touches: a pen's and the mouse's.
pub const LIVE_INPUTS: usize = 2;
/// Samples of the scope that can wait to be drawn: more than half a second at 48 kHz.
const SCOPE: usize = 32_768;
/// Frames rendered at a time.
const SCRATCH: usize = 256;

/// What must arrive together and only whose newest counts.
#[derive(Clone, Copy, Debug, Default)]
struct Orders {
    controls: Controls,
    /// Counts the wishes to end the limiter's latched silence.
    n_resets: u32,
    /// Counts the wishes to end the signal that is played.
    n_stops: u32,
}

/// What must not be missed.
#[derive(Debug)]
enum Command {
    Load(TextureId, Box<OwnedTexture>),
    Unload(TextureId),
    Play(Box<Track>),
    /// With the number of wishes to end signals that are older.
    Signal(Box<Signal>, u32),
}

/// What the callback is done with and does not free.
#[derive(Debug)]
enum Returned {
    Texture(TextureId, #[expect(dead_code, reason = "held to be freed with its box")] Box<OwnedTexture>),
    Track(#[expect(dead_code, reason = "held to be freed with its box")] Box<Track>),
    Signal(#[expect(dead_code, reason = "held to be freed with its box")] Box<Signal>),
}

/// What the edge of a device knows and an engine does not: it has no clock.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BlockEdge {
    /// When the block was asked for.
    pub(crate) now: Instant,
    /// Smoothed load up to the last block.
    pub(crate) load: f32,
    /// Highest load up to the last block.
    pub(crate) load_max: f32,
    /// How much later than now the block will be heard, in seconds.
    pub(crate) device_latency_secs: f32,
}

/// The callback's half.
#[derive(Debug)]
pub struct Engine {
    stream: Stream,
    /// A stream that has not begun, to start again from after nonsense.
    fresh_stream: Stream,
    slots: Slots,
    player: Player,
    taps: Taps,
    tap: Tap,
    landing: Option<Landing>,
    signal: SignalPlayer,
    chain: DriveChain,
    gain: Ramp,
    /// Zero while muted: a signal is silenced by muting, not turned down by the gain.
    unmuted: Ramp,
    meter: Meter,
    device_rate_hz: f64,
    channels: ChannelMask,
    mix: Mix,
    n_resets: u32,
    edge: Option<BlockEdge>,
    latency: Latency,
    frames_played: u64,
    /// Frames since the stream began, or began again.
    stream_frames: u64,
    leaked: u64,
    orders: triple_buffer::Output<Orders>,
    commands: Consumer<Command>,
    touches: [Consumer<TimedTouch>; LIVE_INPUTS],
    returned: Producer<Returned>,
    scope: Producer<f32>,
    status: triple_buffer::Input<Status>,
}

/// Both halves of a silent engine.
///
/// # Errors
/// [`ConfigError`] names the setting that contradicts the rest.
pub fn new(config: EngineConfig) -> Result<(Handle, Engine), ConfigError> {
    let config = config.check()?;
    let (orders_in, orders_out) = triple_buffer(&Orders::default());
    let (status_in, status_out) = triple_buffer(&Status::default());
    let (commands_in, commands_out) = RingBuffer::new(COMMANDS);
    let rings: [_; LIVE_INPUTS] = std::array::from_fn(|_| RingBuffer::new(TOUCHES));
    let mut live = Vec::with_capacity(LIVE_INPUTS);
    let touches_out = rings.map(|(touches, touches_out)| {
        live.push(LiveInput { touches });
        touches_out
    });
    let (returned_in, returned_out) = RingBuffer::new(RETURNED);
    let (scope_in, scope_out) = RingBuffer::new(SCOPE);
    let stream = Stream::new(config.model_rate_hz, config.device_rate_hz, config.seed);
    let fade_frames = (FADE_SECS * f64::from(config.device_rate_hz)) as u32;
    let engine = Engine {
        fresh_stream: stream.clone(),
        stream,
        slots: Slots::new(),
        player: Player::new(),
        taps: Taps::new(config.device_rate_hz),
        tap: Tap::SILENT,
        landing: None,
        signal: SignalPlayer::new(fade_frames),
        chain: DriveChain::new(config.drive, config.device_rate_hz),
        gain: Ramp::new(fade_frames),
        unmuted: Ramp::new(fade_frames),
        meter: Meter::new(config.device_rate_hz),
        device_rate_hz: f64::from(config.device_rate_hz),
        channels: config.channels,
        mix: Controls::default().mix,
        n_resets: 0,
        edge: None,
        latency: Latency::default(),
        frames_played: 0,
        stream_frames: 0,
        leaked: 0,
        orders: orders_out,
        commands: commands_out,
        touches: touches_out,
        returned: returned_in,
        scope: scope_in,
        status: status_in,
    };
    Ok((Handle::new(config, orders_in, commands_in, live, returned_out, scope_out, status_out), engine))
}

impl Engine {
    /// Fills `out`, interleaved frames of `channels` samples each, with the next of the signal, -1..1.
    ///
    /// Never allocates, frees, locks, waits or panics. Cost: that of [`Stream::process`] for the frames, and of at
    /// most a ring full of orders.
    pub fn process(&mut self, out: &mut [f32], channels: usize) {
        // Orders first: whatever they name was put into the rings before they were given.
        let orders = *self.orders.read();
        self.take_commands();
        self.take_touches();
        self.follow(orders);
        let mut scratch = [0.0; SCRATCH];
        let n_channels = channels.max(1);
        for block in out.chunks_mut(SCRATCH * n_channels) {
            let frames = block.len() / n_channels;
            let mono = &mut scratch[..frames];
            self.render(mono);
            let mut frames = block.chunks_exact_mut(n_channels);
            for (frame, &sample) in frames.by_ref().zip(mono.iter()) {
                for (channel_idx, out) in frame.iter_mut().enumerate() {
                    *out = if self.channels.contains(channel_idx) { sample } else { 0.0 };
                }
            }
            frames.into_remainder().fill(0.0);
        }
        self.give_back();
        self.publish();
    }

    /// From a change of the contact to its middle in the output, in seconds, not counting the device's own buffers.
    pub fn latency_secs(&self) -> f32 {
        self.stream.latency_secs() + self.chain.latency_secs()
    }

    /// What a receiver that renders by itself has to know: the touch, the texture of the highest weight, and the gain.
    pub(crate) fn now(&self) -> (Touch, Option<TextureId>, f32) {
        let parents = self.mix.parents.iter().filter(|parent| parent.weight > 0.0);
        let loudest = parents.max_by(|a, b| a.weight.total_cmp(&b.weight));
        (self.player.touch(), loudest.map(|parent| parent.id), self.gain.value())
    }

    /// Tells what only the edge knows, before a block.
    pub(crate) fn begin_block(&mut self, edge: BlockEdge) {
        self.edge = Some(edge);
    }

    fn take_commands(&mut self) {
        // As many as the ring holds: a sender that never rests cannot keep the callback.
        for _ in 0..COMMANDS {
            match self.commands.pop() {
                Ok(Command::Load(id, texture)) => {
                    // The handle loads only into slots that it knows to be empty.
                    if let Some(displaced) = self.slots.put(id, texture) {
                        self.return_or_leak(Returned::Texture(id, displaced));
                    }
                }
                Ok(Command::Unload(id)) => self.slots.retire(id),
                Ok(Command::Play(track)) => {
                    if let Some(replaced) = self.player.play(track) {
                        self.return_or_leak(Returned::Track(replaced));
                    }
                }
                Ok(Command::Signal(signal, n_stops)) => {
                    if let Some(replaced) = self.signal.play(signal, n_stops) {
                        self.return_or_leak(Returned::Signal(replaced));
                    }
                }
                Err(_) => break,
            }
        }
    }

    fn take_touches(&mut self) {
        let Self { touches, player, latency, edge, chain, stream, .. } = self;
        let after_secs = chain.latency_secs() + edge.map_or(0.0, |edge| edge.device_latency_secs);
        for (stylus_idx, touches) in touches.iter_mut().enumerate() {
            for _ in 0..TOUCHES {
                let Ok(timed) = touches.pop() else { break };
                let age = edge.map_or(Duration::ZERO, |edge| edge.now.saturating_duration_since(timed.time));
                player.report(stylus_idx, timed, age.as_secs_f64());
                let out_secs = age.as_secs_f32() + after_secs;
                latency.note(out_secs + stream.latency_secs(), out_secs);
            }
        }
    }

    fn follow(&mut self, orders: Orders) {
        if orders.n_resets != self.n_resets {
            self.n_resets = orders.n_resets;
            self.start_again();
        }
        // A mix that was given twice would begin its fade anew.
        if orders.controls.mix != self.mix {
            self.mix = orders.controls.mix;
            self.stream.set_mix(self.mix);
        }
        self.player.set_takeover(orders.controls.takeover);
        self.player.set_input(orders.controls.input);
        self.tap = orders.controls.tap;
        for unheard in self.signal.follow(orders.n_stops).into_iter().flatten() {
            self.return_or_leak(Returned::Signal(unheard));
        }
        // Without a handle nobody can mute.
        let is_in_hand = !self.commands.is_abandoned();
        let drive = orders.controls.drive;
        self.gain.aim(if is_in_hand { drive.target() } else { 0.0 });
        self.unmuted.aim(if is_in_hand && !drive.muted { 1.0 } else { 0.0 });
    }

    /// Ends the limiter's latched silence. What was not finite came from the stream, which would never forget it.
    fn start_again(&mut self) {
        if self.chain.is_tripped() {
            self.chain.reset();
            self.taps.reset();
            self.stream = self.fresh_stream.clone();
            self.stream.set_mix(self.mix);
            self.player.restart_clock();
            (self.stream_frames, self.landing) = (0, None);
            self.meter.reset();
        }
    }

    /// Renders frames from the textures to what the device gets.
    fn render(&mut self, mono: &mut [f32]) {
        self.stream.process(&self.slots, &mut self.player, mono);
        self.add_taps(mono);
        let driven = self.signal.replace(mono);
        if driven == Driven::Acceleration {
            // What does not fit is not drawn: the scope is a picture, not a recording.
            let _ = self.scope.push_partial_slice(mono);
            self.meter.note_signal(mono);
        }
        for sample in mono.iter_mut() {
            let (gain, unmuted) = (self.gain.next(), self.unmuted.next());
            *sample *= if driven == Driven::Drive { unmuted } else { gain };
        }
        self.chain.process(mono, driven);
        self.meter.note_output(mono);
        self.frames_played += mono.len() as u64;
        self.stream_frames += mono.len() as u64;
        if let Some(played) = self.signal.take_played() {
            self.return_or_leak(Returned::Signal(played));
        }
    }

    /// Adds what the landings sound like, from their very frame on.
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
                self.taps.strike(self.tap, landing.strength);
                self.landing = None;
                rest = after;
            }
        }
        self.taps.add_to(rest);
    }

    /// Sends textures that nothing sounds of any more to be freed. One that does not fit waits in its slot.
    fn give_back(&mut self) {
        let Self { slots, stream, returned, .. } = self;
        for id in 0..SLOTS as TextureId {
            if !slots.is_retired(id) || stream.is_using(id) || returned.is_full() {
                continue;
            }
            if let Some(texture) = slots.take(id)
                && let Err(PushError::Full(texture)) = returned.push(Returned::Texture(id, texture))
            {
                std::mem::forget(texture);
                self.leaked += 1;
            }
        }
    }

    /// Sends something to be freed that there is no place to keep in.
    fn return_or_leak(&mut self, thing: Returned) {
        if let Err(PushError::Full(thing)) = self.returned.push(thing) {
            std::mem::forget(thing);
            self.leaked += 1;
        }
    }

    fn publish(&mut self) {
        let (load, load_max) = self.edge.map_or((0.0, 0.0), |edge| (edge.load, edge.load_max));
        self.status.write(Status {
            state: LinkState::Running,
            load,
            load_max,
            underruns: 0,
            backend_errors: 0,
            limited_samples: self.chain.limited_samples(),
            tripped: self.chain.is_tripped(),
            heat_used: self.chain.heat_used(),
            heat_gain: self.chain.heat_gain(),
            device_latency_secs: self.edge.map_or(0.0, |edge| edge.device_latency_secs),
            latency: self.latency,
            plays_signal: self.signal.is_playing(),
            follows_live: self.player.input() == Input::Live,
            touch: self.player.touch(),
            level_mps2: self.meter.level(),
            peak: self.meter.peak(),
            frames_played: self.frames_played,
            input_secs: self.player.input_secs(),
            leaked: self.leaked,
        });
    }
}
