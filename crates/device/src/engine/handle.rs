//! The half of an engine that stays with whoever is in charge.

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

/// Why a texture was not loaded.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LoadReason {
    /// The texture has another rate than the engine renders at.
    #[error("the texture is at {texture_rate_hz} Hz, the engine renders at {model_rate_hz} Hz")]
    Rate {
        /// The texture's rate, in Hz.
        texture_rate_hz: f32,
        /// The engine's, in Hz.
        model_rate_hz: f32,
    },
    /// Every slot is taken: unload one first, and let it fade.
    #[error("all {SLOTS} places for textures are taken")]
    NoSlot,
    /// The output takes no more at the moment: try again after its next block.
    #[error("the output is busy with what it was given before")]
    RingFull,
}

/// A texture that was not loaded, given back.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{reason}")]
pub struct LoadError {
    /// Why it was not.
    pub reason: LoadReason,
    /// The texture.
    pub texture: OwnedTexture,
}

/// Why a mix was not taken; what sounded before goes on.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MixError {
    /// A texture of the mix is not loaded.
    #[error("texture {id} of the mix is not loaded")]
    NotLoaded {
        /// Which one.
        id: TextureId,
    },
    /// A weight is not a share.
    #[error("the weight of texture {id} is {weight}; it must be between 0 and 1")]
    Weight {
        /// Of which texture.
        id: TextureId,
        /// The weight.
        weight: f32,
    },
}

/// What the handle knows of a slot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Slot {
    Empty,
    Loaded,
    /// To be unloaded as soon as the ring has room to say so.
    Unwanted,
    /// On its way out: back with [`Handle::collect`].
    Leaving,
}

/// The half of an engine that is not in the callback: no call of it ever waits.
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

    /// From now on the status tells how the device is doing.
    pub(crate) fn watch(&mut self, monitor: Monitor) {
        self.monitor = Some(monitor);
    }

    /// What the engine was made for.
    pub fn config(&self) -> EngineConfig {
        self.config
    }

    /// Sends a texture to the engine; it sounds once a mix names it.
    ///
    /// # Errors
    /// [`LoadError`] says why not, and gives the texture back.
    pub fn load(&mut self, texture: OwnedTexture) -> Result<TextureId, LoadError> {
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
        self.send(Command::Load(id, Box::new(texture)));
        self.slots[idx] = Slot::Loaded;
        Ok(id)
    }

    /// Fades a texture out, if it sounds, and lets it come back to be freed by [`Handle::collect`]. One that is not
    /// loaded is left alone.
    pub fn unload(&mut self, id: TextureId) {
        let Some(slot) = self.slots.get_mut(usize::from(id)).filter(|slot| **slot == Slot::Loaded) else {
            return;
        };
        *slot = Slot::Unwanted;
        // The mix goes first: a texture that it names would never fade, and the number may soon be that of another
        // texture, which must not take over the weight.
        for parent in self.orders.controls.mix.parents.iter_mut().filter(|parent| parent.id == id) {
            parent.weight = 0.0;
        }
        self.publish();
        self.send_unloads();
    }

    /// Whether texture `id` is loaded and not on its way out.
    pub fn is_loaded(&self, id: TextureId) -> bool {
        self.slots.get(usize::from(id)) == Some(&Slot::Loaded)
    }

    /// Frees what the engine is done with, and says how many things that were.
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

    /// What the engine was told last.
    pub fn controls(&self) -> Controls {
        self.orders.controls
    }

    /// Tells the engine all at once.
    ///
    /// # Errors
    /// [`MixError`] where the mix is not one; nothing is changed then.
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

    /// Fades to other textures or weights.
    ///
    /// # Errors
    /// [`MixError`] where it is not a mix of loaded textures; nothing is changed then.
    pub fn set_mix(&mut self, mix: Mix) -> Result<(), MixError> {
        self.set_controls(Controls { mix, ..self.orders.controls })
    }

    /// Fades to another gain, or to silence.
    pub fn set_drive(&mut self, drive: Drive) {
        self.orders.controls.drive = drive;
        self.publish();
    }

    /// Landings sound like this from now on.
    pub fn set_tap(&mut self, tap: Tap) {
        self.orders.controls.tap = tap;
        self.publish();
    }

    /// Fades to another input, which starts now.
    pub fn set_input(&mut self, input: Input) {
        self.orders.controls.input = input;
        self.publish();
    }

    /// Says when a person's hand takes over from the input by itself; never where it is `None`.
    pub fn set_takeover(&mut self, takeover: Option<Takeover>) {
        self.orders.controls.takeover = takeover;
        self.publish();
    }

    /// Plays a stroke from its start, and makes it the input.
    ///
    /// # Errors
    /// Gives the track back while the output is busy: try again after its next block.
    pub fn play_track(&mut self, track: Track) -> Result<(), Track> {
        self.send_track(track, Input::Track)
    }

    /// Plays a stroke from its start and again and again, and makes it the input; [`Handle::set_input`] changes how.
    ///
    /// # Errors
    /// As [`Handle::play_track`].
    pub fn repeat_track(&mut self, track: Track, repeat: Repeat) -> Result<(), Track> {
        self.send_track(track, Input::Repeat(repeat))
    }

    /// Plays a signal in the place of the texture, once that, or the signal that is played, has faded. Muting silences it,
    /// the limits of the actuator hold.
    ///
    /// # Errors
    /// Gives the signal back while the output is busy: try again after its next block.
    pub fn play_signal(&mut self, signal: Signal) -> Result<(), Signal> {
        if self.commands.is_full() {
            return Err(signal);
        }
        self.send(Command::Signal(Box::new(signal), self.orders.n_stops));
        Ok(())
    }

    /// Lets the signal fade that is played, if one is; one that is sent later is played.
    pub fn stop_signal(&mut self) {
        self.orders.n_stops = self.orders.n_stops.wrapping_add(1);
        self.publish();
    }

    /// A way in for a person's touches, for whoever reads a stylus. There are [`super::LIVE_INPUTS`]: the first that touches
    /// or is near counts, until it says itself that it is no more, or says nothing for [`Takeover::stale_secs`].
    pub fn take_live_input(&mut self) -> Option<LiveInput> {
        self.live.pop()
    }

    /// Ends the silence that a sample that was not finite has latched: a person has looked.
    pub fn reset_limiter(&mut self) {
        self.orders.n_resets = self.orders.n_resets.wrapping_add(1);
        self.publish();
    }

    /// How the engine and its device are doing.
    pub fn status(&mut self) -> Status {
        let mut status = *self.status.read();
        if let Some(monitor) = &self.monitor {
            monitor.complete(&mut status, Instant::now());
        }
        status
    }

    /// Why the device is lost, if it is.
    pub fn loss(&mut self) -> Option<&DeviceError> {
        self.monitor.as_mut()?.loss()
    }

    /// Takes the oldest waiting samples of the signal in m/s² at the device's rate, before gain and limiter, and says
    /// how many. What nobody takes is dropped, newest first: read all that waits and show the end of it.
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
            // What does not fit goes with the next `collect`.
            if self.slots[idx] == Slot::Unwanted && !self.commands.is_full() {
                self.send(Command::Unload(idx as TextureId));
                self.slots[idx] = Slot::Leaving;
            }
        }
    }

    /// Sends a command into a ring that was just seen to have room, which nobody else can have filled since.
    fn send(&mut self, command: Command) {
        let sent = self.commands.push(command);
        assert!(sent.is_ok(), "a ring with one sender lost the room that it had");
    }
}
