//! Real-time engine: the part that runs in the audio callback, and the handle that controls it.
//!
//! 1. [`new`] creates both halves. The [`Engine`] moves into the callback; the [`Handle`] stays with the controlling
//!    thread.
//! 2. [`Handle::load`] sends textures to the engine. [`Handle::set_mix`], [`Handle::set_input`] and
//!    [`Handle::set_drive`] select the audible textures, the tip motion and the output level.
//! 3. The device calls [`Engine::process`] for every block. [`Engine::process`] never allocates, frees, locks, waits or
//!    panics.
//! 4. [`Handle::unload`] fades a texture out. The engine then queues the texture for [`Handle::collect`], which frees
//!    all queued objects. Call `collect` often: at every frame of the user interface, or every tenth of a second.
//!
//! When the handle is dropped, the engine fades to silence, because nobody could mute it any more.

mod config;
mod friction_channel;
mod handle;
mod meter;
mod place;
mod player;
mod render;
mod signal_player;
mod slots;
#[cfg(test)]
mod tests;

use std::time::{Duration, Instant};

use rtrb::{Consumer, Producer, PushError, RingBuffer};
use shagreen_synth::drive::DriveChain;
use shagreen_synth::renderer::{Mix, TextureId};
use shagreen_synth::stream::Stream;
use shagreen_synth::tap::{Tap, Taps};
use triple_buffer::triple_buffer;

pub use self::config::{ChannelMask, ConfigError, EngineConfig};
pub use self::friction_channel::{
    CARRIER_SHARE, FRICTION_CEILING, FULL_FRICTION, FrictionConfig, FrictionWave, LEAST_CARRIER_HZ,
};
pub use self::handle::{Handle, LoadError, LoadReason, MixError};
pub use crate::link::{STALL_SECS, START_SECS};

use self::friction_channel::FrictionChannel;
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

/// Number of textures that an engine can hold.
pub const SLOTS: usize = 64;
/// Duration of a fade at muting, a gain change or an input change, in seconds.
pub const FADE_SECS: f64 = 0.02;
/// Capacity of the command queue, in commands.
const COMMANDS: usize = 128;
/// Capacity of the queue of objects to be freed, in objects.
const RETURNED: usize = 32;
/// Capacity of a touch queue, in reports: a quarter of a second of a stylus that reports at 1 kHz.
const TOUCHES: usize = 256;
/// Number of live inputs: one for a pen, one for the mouse.
pub const LIVE_INPUTS: usize = 2;
/// Capacity of the scope queue in samples: more than half a second at 48 kHz.
const SCOPE: usize = 32_768;
/// Frames rendered at a time.
const SCRATCH: usize = 256;

/// Values that must change together. The engine reads only the newest set.
#[derive(Clone, Copy, Debug, Default)]
struct Orders {
    controls: Controls,
    /// Number of requests to end the limiter's latched silence.
    n_resets: u32,
    /// Number of requests to end the current signal.
    n_stops: u32,
}

/// Commands that must not be lost.
#[derive(Debug)]
enum Command {
    Load(TextureId, Box<OwnedTexture>),
    Unload(TextureId),
    Play(Box<Track>),
    /// The signal with the number of stop requests sent before it.
    Signal(Box<Signal>, u32),
}

/// Objects that the callback no longer needs and must not free.
#[derive(Debug)]
enum Returned {
    Texture(TextureId, #[expect(dead_code, reason = "held to be freed with its box")] Box<OwnedTexture>),
    Track(#[expect(dead_code, reason = "held to be freed with its box")] Box<Track>),
    Signal(#[expect(dead_code, reason = "held to be freed with its box")] Box<Signal>),
}

/// Data that the device adapter adds to a block, because the engine has no clock.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CallbackAdapter {
    /// Time at which the device requested the block.
    pub(crate) now: Instant,
    /// Smoothed load up to the last block ([`Status::load`]).
    pub(crate) load: f32,
    /// Highest load up to the last block ([`Status::load_max`]).
    pub(crate) load_max: f32,
    /// Time from now until the device plays the block, in seconds.
    pub(crate) device_latency_secs: f32,
}

/// The half of the engine that runs in the audio callback.
#[derive(Debug)]
pub struct Engine {
    stream: Stream,
    /// Unused copy of the initial stream, to restart from after non-finite samples.
    fresh_stream: Stream,
    slots: Slots,
    player: Player,
    taps: Taps,
    tap: Tap,
    /// Highest amplitude of any tap transient, at the output, in m/s²: the range in which the limiter is linear.
    tap_range_mps2: f32,
    landing: Option<Landing>,
    signal: SignalPlayer,
    chain: DriveChain,
    gain: Ramp,
    /// 0 while muted, else 1: the factor on samples of [`shagreen_synth::drive::Driven::Drive`]. The factor on all other
    /// samples is `gain`, which includes muting.
    unmuted: Ramp,
    meter: Meter,
    device_rate_hz: f64,
    channels: ChannelMask,
    friction: Option<FrictionChannel>,
    mix: Mix,
    n_resets: u32,
    edge: Option<CallbackAdapter>,
    latency: Latency,
    frames_played: u64,
    /// Frames since the stream started or restarted.
    stream_frames: u64,
    /// Whether the lift gate had silenced the output at the end of the last block; the filters are then already
    /// cleared.
    is_at_rest: bool,
    leaked: u64,
    orders: triple_buffer::Output<Orders>,
    commands: Consumer<Command>,
    touches: [Consumer<TimedTouch>; LIVE_INPUTS],
    returned: Producer<Returned>,
    scope: Producer<f32>,
    status: triple_buffer::Input<Status>,
}

/// Returns both halves of a silent engine.
///
/// # Errors
/// [`ConfigError`] names the invalid setting.
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
    let chain = DriveChain::new(config.drive, config.device_rate_hz);
    let rates_hz = (config.model_rate_hz, config.device_rate_hz);
    let friction =
        config.friction.map(|friction| FrictionChannel::new(friction, rates_hz, chain.latency_secs()));
    let engine = Engine {
        fresh_stream: stream.clone(),
        stream,
        slots: Slots::new(),
        player: Player::new(),
        taps: Taps::new(config.device_rate_hz),
        tap: Tap::SILENT,
        tap_range_mps2: config.drive.linear_mps2(),
        landing: None,
        signal: SignalPlayer::new(fade_frames),
        chain,
        gain: Ramp::new(fade_frames),
        unmuted: Ramp::new(fade_frames),
        meter: Meter::new(config.device_rate_hz),
        device_rate_hz: f64::from(config.device_rate_hz),
        channels: config.channels,
        friction,
        mix: Controls::default().mix,
        n_resets: 0,
        edge: None,
        latency: Latency::default(),
        frames_played: 0,
        stream_frames: 0,
        is_at_rest: true,
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
    /// Fills `out` with the next frames: `channels` interleaved samples per frame, each -1..1.
    ///
    /// Never allocates, frees, locks, waits or panics. Cost: that of [`Stream::process`] and of the drive chain for the
    /// frames, plus at most one full command queue, [`LIVE_INPUTS`] full touch queues and one pass over the [`SLOTS`].
    pub fn process(&mut self, out: &mut [f32], channels: usize) {
        // Orders are read first: the objects they refer to were already queued when the orders were written.
        let orders = *self.orders.read();
        self.take_commands();
        self.take_touches();
        self.follow(orders);
        let (mut scratch, mut friction_scratch) = ([0.0; SCRATCH], [0.0; SCRATCH]);
        let n_channels = channels.max(1);
        for block in out.chunks_mut(SCRATCH * n_channels) {
            let frames = block.len() / n_channels;
            let (mono, friction) = (&mut scratch[..frames], &mut friction_scratch[..frames]);
            let first_frame = self.stream_frames;
            self.render(mono);
            let friction_idx = self.render_friction(first_frame, friction);
            let mut frames = block.chunks_exact_mut(n_channels);
            for ((frame, &sample), &level) in frames.by_ref().zip(mono.iter()).zip(friction.iter()) {
                for (channel_idx, out) in frame.iter_mut().enumerate() {
                    *out = match channel_idx {
                        _ if self.channels.contains(channel_idx) => sample,
                        _ if friction_idx == Some(channel_idx) => level,
                        _ => 0.0,
                    };
                }
            }
            frames.into_remainder().fill(0.0);
        }
        self.give_back();
        self.publish();
    }

    /// Delay in seconds from a change of speed or force to the middle of the resulting ramp in the output, without the
    /// device's own buffers.
    pub fn latency_secs(&self) -> f32 {
        self.stream.latency_secs() + self.chain.latency_secs()
    }

    /// Returns the data for a receiver that renders textures itself: touch, id of the texture with the highest weight,
    /// gain.
    pub(crate) fn now(&self) -> (Touch, Option<TextureId>, f32) {
        let parents = self.mix.parents.iter().filter(|parent| parent.weight > 0.0);
        let loudest = parents.max_by(|a, b| a.weight.total_cmp(&b.weight));
        (self.player.touch(), loudest.map(|parent| parent.id), self.gain.value())
    }

    /// Sets the adapter's data before a block.
    pub(crate) fn begin_block(&mut self, edge: CallbackAdapter) {
        self.edge = Some(edge);
    }

    fn take_commands(&mut self) {
        // The loop is bounded by the queue's capacity, so that a fast sender cannot stall the callback.
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
        // Setting the same mix again would restart its fade.
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
        // Without a handle nobody can mute, so the output fades to silence.
        let is_in_hand = !self.commands.is_abandoned();
        let drive = orders.controls.drive;
        self.gain.aim(if is_in_hand { drive.target() } else { 0.0 });
        self.unmuted.aim(if is_in_hand && !drive.muted { 1.0 } else { 0.0 });
    }

    /// Ends the limiter's latched silence. The stream restarts, because non-finite samples come from its filters and
    /// would stay in them.
    fn start_again(&mut self) {
        if self.chain.is_tripped() {
            self.chain.reset();
            self.taps.reset();
            self.stream = self.fresh_stream.clone();
            self.stream.set_mix(self.mix);
            self.player.restart_clock();
            if let Some(channel) = &mut self.friction {
                channel.restart();
            }
            (self.stream_frames, self.landing) = (0, None);
            self.meter.reset();
        }
    }

    /// Queues retired textures that no voice uses any more, to be freed by the handle. A texture stays in its slot
    /// while the queue is full.
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

    /// Queues an object to be freed by the handle. If the queue is full, the object is leaked and counted.
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
