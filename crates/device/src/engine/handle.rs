//! Control half of an engine, for use outside the audio callback.

use std::time::Instant;

use rtrb::{Consumer, Producer};
use shagreen_synth::renderer::{Mix, TextureId};
use shagreen_synth::tap::Tap;

use super::{Command, EngineConfig, Orders, Returned, SLOTS};
use crate::controls::{Controls, Drive, Input, Takeover};
use crate::error::DeviceError;
use crate::link::Monitor;
use crate::live::LiveInput;
use crate::repeat::Repeat;
use crate::signal::Signal;
use crate::status::Status;
use crate::texture::OwnedTexture;
use crate::track::Track;

/// Reasons why a texture was not loaded.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LoadReason {
    /// The texture's sample rate differs from the engine's.
    #[error("the texture's sample rate is {texture_rate_hz} Hz; the engine renders at {model_rate_hz} Hz")]
    Rate {
        /// The texture's sample rate, in Hz.
        texture_rate_hz: f32,
        /// The engine's model rate, in Hz.
        model_rate_hz: f32,
    },
    /// All slots are in use. Unload a texture and wait until it has faded out.
    #[error("all {SLOTS} texture slots are in use; unload a texture first")]
    NoSlot,
    /// The command queue is full. Try again after the next block.
    #[error("the output's command queue is full; try again after its next block")]
    RingFull,
}

/// Error that returns the texture that was not loaded.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{reason}")]
pub struct LoadError {
    /// Reason for the failure.
    pub reason: LoadReason,
    /// The texture.
    pub texture: Box<OwnedTexture>,
}

/// Reasons why a mix was rejected. The previous mix stays active.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MixError {
    /// A texture of the mix is not loaded.
    #[error("texture {id} of the mix is not loaded")]
    NotLoaded {
        /// Id of the texture.
        id: TextureId,
    },
    /// A weight is outside 0..1.
    #[error("the weight of texture {id} is {weight}; it must be between 0 and 1")]
    Weight {
        /// Id of the texture.
        id: TextureId,
        /// The invalid weight.
        weight: f32,
    },
}

/// State of a slot as the handle knows it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Slot {
    Empty,
    Loaded,
    /// To be unloaded as soon as the command queue has room.
    Unwanted,
    /// Fading out; [`Handle::collect`] gets it back.
    Leaving,
}

/// Control half of an engine. None of its methods waits.
#[derive(Debug)]
pub struct Handle {
    config: EngineConfig,
    orders: Orders,
    orders_in: triple_buffer::Input<Orders>,
    commands: Producer<Command>,
    live: Vec<LiveInput>,
    returned: Consumer<Returned>,
    scope: Consumer<f32>,
    status: triple_buffer::Output<Status>,
    slots: [Slot; SLOTS],
    monitor: Option<Monitor>,
}

impl Handle {
    pub(super) fn new(
        config: EngineConfig,
        orders_in: triple_buffer::Input<Orders>,
        commands: Producer<Command>,
        live: Vec<LiveInput>,
        returned: Consumer<Returned>,
        scope: Consumer<f32>,
        status: triple_buffer::Output<Status>,
    ) -> Self {
        Self {
            config,
            orders: Orders::default(),
            orders_in,
            commands,
            live,
            returned,
            scope,
            status,
            slots: [Slot::Empty; SLOTS],
            monitor: None,
        }
    }

    /// Adds the device's state to [`Handle::status`] from now on.
    pub(crate) fn watch(&mut self, monitor: Monitor) {
        self.monitor = Some(monitor);
    }

    /// Configuration of the engine.
    pub fn config(&self) -> EngineConfig {
        self.config
    }

    /// Sends a texture to the engine and returns its id. The texture plays once a mix contains this id.
    ///
    /// # Errors
    /// [`LoadError`] gives the reason and returns the texture.
    pub fn load(&mut self, texture: OwnedTexture) -> Result<TextureId, LoadError> {
        let texture = Box::new(texture);
        let (texture_rate_hz, model_rate_hz) = (texture.rate_hz(), self.config.model_rate_hz);
        if texture_rate_hz != model_rate_hz {
            return Err(LoadError { reason: LoadReason::Rate { texture_rate_hz, model_rate_hz }, texture });
        }
        self.collect();
        let Some(idx) = self.slots.iter().position(|&slot| slot == Slot::Empty) else {
            return Err(LoadError { reason: LoadReason::NoSlot, texture });
        };
        if self.commands.is_full() {
            return Err(LoadError { reason: LoadReason::RingFull, texture });
        }
        let id = idx as TextureId;
        self.send(Command::Load(id, texture));
        self.slots[idx] = Slot::Loaded;
        Ok(id)
    }

    /// Fades a texture out if it is playing. [`Handle::collect`] frees it afterwards. Does nothing if the texture is
    /// not loaded.
    pub fn unload(&mut self, id: TextureId) {
        let Some(slot) = self.slots.get_mut(usize::from(id)).filter(|slot| **slot == Slot::Loaded) else {
            return;
        };
        *slot = Slot::Unwanted;
        // The texture leaves the mix first. Otherwise it would never fade, and a new texture with the same id could
        // inherit its weight.
        for parent in self.orders.controls.mix.parents.iter_mut().filter(|parent| parent.id == id) {
            parent.weight = 0.0;
        }
        self.publish();
        self.send_unloads();
    }

    /// Whether texture `id` is loaded and not being unloaded.
    pub fn is_loaded(&self, id: TextureId) -> bool {
        self.slots.get(usize::from(id)) == Some(&Slot::Loaded)
    }

    /// Frees objects that the engine has returned. Returns their number.
    pub fn collect(&mut self) -> usize {
        let mut n_freed = 0;
        while let Ok(returned) = self.returned.pop() {
            n_freed += 1;
            if let Returned::Texture(id, _) = returned
                && let Some(slot) = self.slots.get_mut(usize::from(id))
            {
                *slot = Slot::Empty;
            }
        }
        self.send_unloads();
        n_freed
    }

    /// The controls that were set last.
    pub fn controls(&self) -> Controls {
        self.orders.controls
    }

    /// Sets all controls at once.
    ///
    /// # Errors
    /// [`MixError`] if the mix is invalid; nothing changes in this case.
    pub fn set_controls(&mut self, controls: Controls) -> Result<(), MixError> {
        for parent in controls.mix.parents.iter().filter(|parent| parent.weight != 0.0) {
            if !(0.0..=1.0).contains(&parent.weight) {
                return Err(MixError::Weight { id: parent.id, weight: parent.weight });
            }
            if !self.is_loaded(parent.id) {
                return Err(MixError::NotLoaded { id: parent.id });
            }
        }
        self.orders.controls = controls;
        self.publish();
        Ok(())
    }

    /// Fades to a new mix.
    ///
    /// # Errors
    /// [`MixError`] if the mix is invalid or contains a texture that is not loaded; nothing changes in this case.
    pub fn set_mix(&mut self, mix: Mix) -> Result<(), MixError> {
        self.set_controls(Controls { mix, ..self.orders.controls })
    }

    /// Fades to a new gain, or to silence.
    pub fn set_drive(&mut self, drive: Drive) {
        self.orders.controls.drive = drive;
        self.publish();
    }

    /// Sets the tap transient of future contact onsets.
    pub fn set_tap(&mut self, tap: Tap) {
        self.orders.controls.tap = tap;
        self.publish();
    }

    /// Fades to another input. It starts now, unless only parameters of the current stroke change ([`Input`]).
    pub fn set_input(&mut self, input: Input) {
        self.orders.controls.input = input;
        self.publish();
    }

    /// Sets when live input takes over automatically; `None` turns automatic takeover off.
    pub fn set_takeover(&mut self, takeover: Option<Takeover>) {
        self.orders.controls.takeover = takeover;
        self.publish();
    }

    /// Plays a stroke once from its start and selects it as the input.
    ///
    /// # Errors
    /// Returns the track if the command queue is full. Try again after the next block.
    pub fn play_track(&mut self, track: Track) -> Result<(), Track> {
        self.send_track(track, Input::Track)
    }

    /// Plays a stroke repeatedly from its start and selects it as the input. [`Handle::set_input`] changes the
    /// repetition.
    ///
    /// # Errors
    /// As [`Handle::play_track`].
    pub fn repeat_track(&mut self, track: Track, repeat: Repeat) -> Result<(), Track> {
        self.send_track(track, Input::Repeat(repeat))
    }

    /// Plays a signal instead of the texture, after the texture or the current signal has faded out. Muting and the
    /// actuator's limits apply to every signal. The gain applies to acceleration signals, but not to drive signals
    /// ([`Driven`](shagreen_synth::drive::Driven)).
    ///
    /// # Errors
    /// Returns the signal if the command queue is full. Try again after the next block.
    pub fn play_signal(&mut self, signal: Signal) -> Result<(), Signal> {
        if self.commands.is_full() {
            return Err(signal);
        }
        self.send(Command::Signal(Box::new(signal), self.orders.n_stops));
        Ok(())
    }

    /// Fades out the current signal and cancels queued ones. Signals that are sent later are not affected.
    pub fn stop_signal(&mut self) {
        self.orders.n_stops = self.orders.n_stops.wrapping_add(1);
        self.publish();
    }

    /// Takes an input for live touches, for the reader of a stylus; `None` if all [`super::LIVE_INPUTS`] are taken. The
    /// first stylus that touches or is near is followed until it reports leaving, or sends nothing for
    /// [`Takeover::stale_secs`].
    pub fn take_live_input(&mut self) -> Option<LiveInput> {
        self.live.pop()
    }

    /// Ends the silence that a non-finite sample has latched. Only a person's action may lead to this call.
    pub fn reset_limiter(&mut self) {
        self.orders.n_resets = self.orders.n_resets.wrapping_add(1);
        self.publish();
    }

    /// Current state of the engine and its device.
    pub fn status(&mut self) -> Status {
        let mut status = *self.status.read();
        if let Some(monitor) = &self.monitor {
            monitor.complete(&mut status, Instant::now());
        }
        status
    }

    /// Returns the reason why the device is lost, or `None`.
    pub fn loss(&mut self) -> Option<&DeviceError> {
        self.monitor.as_mut()?.loss()
    }

    /// Takes the oldest queued samples of the acceleration, in m/s² at the device's rate, before gain, equalizer and
    /// limiters. Drive signals ([`Driven`](shagreen_synth::drive::Driven)) are not included. Returns the number of
    /// samples. If the queue is full, the newest samples are dropped: read the whole queue and display its end.
    pub fn read_scope(&mut self, out: &mut [f32]) -> usize {
        self.scope.pop_partial_slice(out).0.len()
    }

    fn send_track(&mut self, track: Track, input: Input) -> Result<(), Track> {
        if self.commands.is_full() {
            return Err(track);
        }
        self.send(Command::Play(Box::new(track)));
        self.set_input(input);
        Ok(())
    }

    fn publish(&mut self) {
        self.orders_in.write(self.orders);
    }

    fn send_unloads(&mut self) {
        for idx in 0..SLOTS {
            // Unloads that do not fit are sent at the next `collect`.
            if self.slots[idx] == Slot::Unwanted && !self.commands.is_full() {
                self.send(Command::Unload(idx as TextureId));
                self.slots[idx] = Slot::Leaving;
            }
        }
    }

    /// Sends a command into a queue that was just checked for room. Only this sender can fill it.
    fn send(&mut self, command: Command) {
        let sent = self.commands.push(command);
        assert!(sent.is_ok(), "bug: the command queue is full right after a check for room");
    }
}
