//! The open output: textures sent to it, touches, and its status.

use std::sync::Arc;
use std::sync::mpsc::Receiver;
use std::time::Instant;

use shagreen_core::dsp::filter::resample;
use shagreen_core::space::SpacePoint;
use shagreen_core::space::authoring::Blending;
use shagreen_core::texture::plane::Prepared;
use shagreen_core::texture::render::synth_blend;
use shagreen_core::texture::shape::Shape;
use shagreen_core::units::Hertz;
use shagreen_device::audio_input::{InputInfo, list_inputs};
use shagreen_device::controls::{Controls, Drive, Input, Takeover};
use shagreen_device::engine::{Handle, LoadError, LoadReason, SLOTS};
use shagreen_device::error::DeviceErrorKind;
use shagreen_device::live::LiveInput;
use shagreen_device::output::{OpenOptions, OutputInfo, OutputKind, Running, is_same_output, list_outputs};
use shagreen_device::serial::{ID_PREFIX, list_serial_ports};
use shagreen_device::signal::{Signal, SignalError};
use shagreen_device::status::{LinkState, Status};
use shagreen_device::stylus::MouseStylus;
use shagreen_device::synth::drive::{DriveConfig, Driven};
use shagreen_device::synth::renderer::{MAX_PARENTS, Mix, Parent, TextureId};
use shagreen_device::synth::tap::Tap;
use shagreen_device::texture::OwnedTexture;

use super::audible::{Audible, Made, Source};
use super::opening::{Came, Opened, Opening, OutputChoice, Request};
use crate::state::background::in_background;
use crate::state::mouse_report::MouseReport;
use crate::state::recorded_stroke::RecordedStroke;
use crate::state::rig::Rig;
use crate::state::scope_buffer::ScopeBuffer;
use crate::strings;

/// Duration of a test tone, in seconds.
const TONE_SECS: f64 = 2.0;
/// Maximum number of loaded textures; the least recently played one is unloaded.
const KEPT: usize = SLOTS - 16;

/// Slots of textures that are not those of the library, each with the number of its texture.
#[derive(Debug, Default)]
struct MadeSlots {
    /// Slots in the present mix.
    sounding: Vec<(u64, TextureId)>,
    /// Slots loaded for the next mix.
    next: Vec<(u64, TextureId)>,
}

/// Input of a mix: point, interpolation options, shape, index of the soloed texture, and key on its path.
type Wanted = (SpacePoint, Blending, Shape, Option<usize>, Option<usize>);

/// An output, and everything to be sent to it: many fields, because the output takes all of it through one handle.
pub(super) struct Player {
    /// Input of the last computed mix.
    pub(super) wanted: Option<Wanted>,
    pub(super) mix_is_new: bool,
    /// Tap transient at a contact onset, from the next mix on.
    pub(super) tap: Tap,
    pub(super) outputs: Vec<OutputInfo>,
    pub(super) inputs: Vec<InputInfo>,
    pub(super) output_id: Option<String>,
    pub(super) message: Option<String>,
    /// Output on which another Shagreen plays, if it was asked for.
    pub(super) claimed: Option<String>,
    pub(super) status: Option<Status>,
    pub(super) muted: bool,
    pub(super) limited_at: Option<Instant>,
    handle: Option<Handle>,
    running: Option<Running>,
    live: Option<LiveInput>,
    /// Input for live touches of the pen, until the pen takes it.
    pub(super) pen_live: Option<LiveInput>,
    opening: Opening,
    /// Last requested output.
    pub(super) choice: Option<OutputChoice>,
    /// Whether the output was closed to free its device.
    pub(super) is_let_go: bool,
    listing: Option<Receiver<Vec<OutputInfo>>>,
    listing_inputs: Option<Receiver<Vec<InputInfo>>>,
    /// Slot of each library texture, and the number of the mix that used it last.
    slots: Vec<Option<(TextureId, u64)>>,
    made: MadeSlots,
    /// Stroke recording that the output holds.
    stroke: Option<Arc<RecordedStroke>>,
    n_mixes: u64,
    stylus: MouseStylus,
    started: Instant,
}

impl Player {
    pub(super) fn new(n_textures: usize) -> Self {
        Self {
            wanted: None,
            mix_is_new: false,
            tap: Tap::SILENT,
            outputs: Vec::new(),
            inputs: Vec::new(),
            output_id: None,
            message: None,
            claimed: None,
            status: None,
            muted: false,
            limited_at: None,
            handle: None,
            running: None,
            live: None,
            pen_live: None,
            opening: Opening::default(),
            choice: None,
            is_let_go: false,
            listing: None,
            listing_inputs: None,
            slots: vec![None; n_textures],
            made: MadeSlots::default(),
            stroke: None,
            n_mixes: 0,
            stylus: MouseStylus::new(1.0),
            started: Instant::now(),
        }
    }

    pub(super) fn list_outputs(&mut self, ctx: egui::Context) {
        self.listing = Some(in_background(ctx, || {
            let mut outputs = list_outputs();
            // If the system cannot list serial ports, none is offered.
            let ports = list_serial_ports().unwrap_or_default().into_iter();
            outputs.extend(ports.map(|port| OutputInfo {
                id: port.id,
                name: port.name,
                kind: OutputKind::Serial,
                is_default: false,
            }));
            outputs
        }));
    }

    pub(super) fn list_inputs(&mut self, ctx: egui::Context) {
        self.listing_inputs = Some(in_background(ctx, list_inputs));
    }

    /// Closes the output, or cancels its opening. The choice of output is kept.
    pub(super) fn silence(&mut self) {
        self.close();
        self.opening.discard();
    }

    pub(super) fn is_released(&self) -> bool {
        self.handle.is_none() && !self.opening.is_busy()
    }

    fn close(&mut self) {
        (self.handle, self.running, self.live, self.pen_live) = (None, None, None, None);
        self.status = None;
    }

    pub(super) fn open(
        &mut self,
        choice: OutputChoice,
        rig: &Rig,
        (drive, take_over): (DriveConfig, bool),
        model_rate_hz: f32,
        ctx: egui::Context,
    ) {
        // The default output of the system is never a serial port.
        let is_serial = matches!(&choice, OutputChoice::Id(id) if id.starts_with(ID_PREFIX));
        let (channels, friction) = rig.channels(is_serial);
        let options = OpenOptions {
            model_rate_hz,
            preferred_rate_hz: None,
            buffer_frames: Some(rig.buffer_frames),
            seed: 1,
            drive,
            channels,
            friction,
            take_over,
        };
        self.begin(Request { choice, options, ctx });
    }

    /// Opens an output, after the opening in progress.
    fn begin(&mut self, request: Request) {
        let is_open = |id: &String| self.output_id.as_ref().is_some_and(|open| is_same_output(id, open));
        let is_same = matches!(&request.choice, OutputChoice::Id(id) if is_open(id));
        if is_same || self.status.is_some_and(|s| s.state == LinkState::Lost) {
            // Some devices can be opened only once, and the open output may drive another actuator.
            self.close();
        }
        if self.opening.is_busy() {
            self.opening.wait_with(request);
        } else {
            self.opening.begin(request);
        }
    }

    /// Reads status and samples from the output. Returns true if an output has just been opened.
    pub(super) fn collect(&mut self, scope: &mut ScopeBuffer) -> bool {
        if let Some(outputs) = self.listing.as_ref().and_then(|r| r.try_recv().ok()) {
            self.outputs = outputs;
            self.listing = None;
        }
        if let Some(inputs) = self.listing_inputs.as_ref().and_then(|r| r.try_recv().ok()) {
            self.inputs = inputs;
            self.listing_inputs = None;
        }
        let opened = self.take_opened(scope);
        let mut is_taken_over = false;
        if let Some(handle) = &mut self.handle {
            handle.collect();
            let status = handle.status();
            if self.status.is_some_and(|s| status.limited_samples > s.limited_samples) {
                self.limited_at = Some(Instant::now());
            }
            self.status = Some(status);
            if let Some(loss) = handle.loss() {
                self.message = Some(loss.to_string());
                is_taken_over = loss.kind() == DeviceErrorKind::Claimed;
            }
            let mut samples = [0.0; 4096];
            loop {
                let n = handle.read_scope(&mut samples);
                scope.push(&samples[..n], status.touch.contact);
                if n < samples.len() {
                    break;
                }
            }
        }
        if is_taken_over {
            // The newcomer waits until the device is closed.
            self.close();
            self.claimed = self.output_id.clone();
        }
        opened
    }

    fn take_opened(&mut self, scope: &mut ScopeBuffer) -> bool {
        let Opened { outcome, warning, claimed } = match self.opening.take() {
            Came::Nothing => return false,
            Came::Next(request) => {
                self.begin(*request);
                return false;
            }
            Came::Opened(opened) => *opened,
        };
        self.message = warning;
        self.claimed = claimed;
        match outcome {
            Err(error) => {
                self.message = Some(error.to_string());
                if self.handle.is_some() {
                    // The previous output stays open.
                    self.choice = self.output_id.clone().map(OutputChoice::Id);
                }
                false
            }
            Ok((mut handle, running)) => {
                let config = handle.config();
                *scope = ScopeBuffer::new(f64::from(config.device_rate_hz), f64::from(config.model_rate_hz));
                self.live = handle.take_live_input();
                self.pen_live = handle.take_live_input();
                handle.set_drive(Drive { muted: self.muted, ..Drive::default() });
                handle.set_takeover(Some(Takeover::USUAL));
                self.output_id = Some(running.id().to_owned());
                // From now on it is this device, even if the system default changes.
                self.choice = self.output_id.clone().map(OutputChoice::Id);
                // The old output stops only now that the new one is open.
                self.handle = Some(handle);
                self.running = Some(running);
                self.slots.fill(None);
                self.made = MadeSlots::default();
                self.stroke = None;
                self.mix_is_new = true;
                true
            }
        }
    }

    /// Loads the audible textures and fades to them. If the output is busy or a texture is not prepared yet, the next
    /// frame retries.
    pub(super) fn send_mix(&mut self, heard: &Audible, ahead: &[Option<Prepared>], rate_hz: f64) {
        let is_ready = |handle: &Handle| handle.config().model_rate_hz == rate_hz as f32;
        if !self.mix_is_new || !self.handle.as_ref().is_some_and(is_ready) {
            return;
        }
        self.n_mixes += 1;
        self.unload_replaced(&heard.made);
        let mut mix = Mix::silent(synth_blend(heard.mixing));
        for (voice, parent) in heard.voices.iter().zip(&mut mix.parents[..MAX_PARENTS]) {
            let id = match voice.source {
                Source::Library(texture) => self.slot_of(texture, ahead),
                Source::Made(number) => {
                    let made = heard.made.iter().find(|made| made.number == number);
                    made.and_then(|made| self.slot_of_made(made))
                }
            };
            let Some(id) = id else { return };
            *parent = Parent { id, weight: voice.share as f32 };
        }
        if let Some(handle) = &mut self.handle
            && handle.set_controls(Controls { mix, tap: self.tap, ..handle.controls() }).is_ok()
        {
            self.mix_is_new = false;
            let is_sounding =
                |(_, id): &(u64, TextureId)| mix.parents.iter().any(|p| p.id == *id && p.weight > 0.0);
            let MadeSlots { mut sounding, next } = std::mem::take(&mut self.made);
            sounding.extend(next);
            for slot in sounding {
                if is_sounding(&slot) {
                    self.made.sounding.push(slot);
                } else {
                    // It fades out before its slot is freed.
                    handle.unload(slot.1);
                }
            }
        }
    }

    /// Unloads textures that are not marked in `is_kept`, and resizes the slots to its length.
    pub(super) fn keep(&mut self, is_kept: &[bool]) {
        self.slots.resize(self.slots.len().max(is_kept.len()), None);
        for (texture, slot) in self.slots.iter_mut().enumerate() {
            let is_gone = !is_kept.get(texture).copied().unwrap_or(false);
            if let (Some((id, _)), Some(handle)) = (slot.take_if(|_| is_gone), &mut self.handle) {
                handle.unload(id);
            }
        }
        self.slots.truncate(is_kept.len());
    }

    fn slot_of(&mut self, texture: usize, ahead: &[Option<Prepared>]) -> Option<TextureId> {
        let handle = self.handle.as_mut()?;
        if let Some((id, used)) = &mut self.slots[texture] {
            *used = self.n_mixes;
            return Some(*id);
        }
        let prepared = ahead.get(texture)?.as_ref()?;
        if self.slots.iter().flatten().count() >= KEPT {
            let oldest = (0..self.slots.len())
                .filter(|i| self.slots[*i].is_some())
                .min_by_key(|i| self.slots[*i].map(|s| s.1));
            if let Some((id, _)) = oldest.and_then(|i| self.slots[i].take()) {
                handle.unload(id);
            }
        }
        let id = self.load(prepared)?;
        self.slots[texture] = Some((id, self.n_mixes));
        Some(id)
    }

    /// Unloads textures that were loaded for the next mix and are not in it any more, because the point or the shape
    /// changed before they played.
    fn unload_replaced(&mut self, made: &[Made]) {
        let Some(handle) = &mut self.handle else { return };
        self.made.next.retain(|(number, id)| {
            let is_wanted = made.iter().any(|made| made.number == *number);
            if !is_wanted {
                handle.unload(*id);
            }
            is_wanted
        });
    }

    /// Slot of a texture that is not one of the library, loaded if necessary.
    fn slot_of_made(&mut self, made: &Made) -> Option<TextureId> {
        let mut known = self.made.sounding.iter().chain(&self.made.next);
        if let Some((_, id)) = known.find(|(number, _)| *number == made.number) {
            return Some(*id);
        }
        let id = self.load(&made.prepared)?;
        self.made.next.push((made.number, id));
        Some(id)
    }

    /// Sends a texture to the output. If the output is busy, the next frame retries.
    fn load(&mut self, prepared: &Prepared) -> Option<TextureId> {
        let handle = self.handle.as_mut()?;
        let refusal = match OwnedTexture::new(prepared.parts()) {
            Ok(owned) => match handle.load(owned) {
                Ok(id) => return Some(id),
                Err(LoadError { reason: LoadReason::RingFull | LoadReason::NoSlot, .. }) => return None,
                Err(error) => error.to_string(),
            },
            Err(error) => error.to_string(),
        };
        self.message = Some(refusal);
        None
    }

    /// Number of loaded textures, except those that are fading out.
    pub(super) fn n_loaded(&self) -> usize {
        let is_loaded = |handle: &Handle| (0..SLOTS).filter(|id| handle.is_loaded(*id as TextureId)).count();
        self.handle.as_ref().map_or(0, is_loaded)
    }

    /// Sets the automatic stroke; the engine itself lets live input take over. A stroke recording is sent along if the
    /// output does not hold it. If the output is busy, the next frame retries.
    pub(super) fn set_hand(&mut self, hand: Option<Input>, stroke: Option<&Arc<RecordedStroke>>) {
        let has_stroke = self.has_stroke(stroke);
        let Some(handle) = &mut self.handle else { return };
        match (hand, stroke) {
            (Some(Input::Repeat(repeat)), Some(stroke)) if !has_stroke => {
                let is_sent = handle.repeat_track(stroke.track().clone(), repeat).is_ok();
                self.stroke = is_sent.then(|| Arc::clone(stroke));
            }
            _ => handle.set_input(hand.unwrap_or(Input::Lifted)),
        }
    }

    /// Whether the output holds this stroke recording.
    pub(super) fn has_stroke(&self, stroke: Option<&Arc<RecordedStroke>>) -> bool {
        self.stroke.as_ref().zip(stroke).is_some_and(|(held, wanted)| Arc::ptr_eq(held, wanted))
    }

    pub(super) fn mouse(&mut self, report: MouseReport, force_n: f64) {
        let now = Instant::now();
        let time_secs = now.duration_since(self.started).as_secs_f64();
        self.stylus.set_force_n(force_n);
        let touch = self.stylus.report(time_secs, report.x_m, report.y_m, report.pressed);
        if let Some(live) = &mut self.live {
            // The queue is full only if the output has stopped; then the touch is lost.
            let _ = live.send(touch, now);
        }
    }

    pub(super) fn stream(&self) -> Option<(u32, u16, Option<u32>)> {
        self.running.as_ref().map(|r| (r.rate_hz(), r.channels(), r.buffer_frames()))
    }

    pub(super) fn play_tone(&mut self, frequency_hz: f64, amplitude_mps2: f64) {
        self.play(|rate_hz| Signal::tone(frequency_hz, amplitude_mps2, TONE_SECS, rate_hz));
    }

    pub(super) fn play_samples(&mut self, samples_mps2: &[f64], rate: Hertz) {
        self.play(|rate_hz| {
            let samples = resample(samples_mps2, rate, Hertz(rate_hz));
            Signal::new(samples.iter().map(|x| *x as f32).collect(), rate_hz, Driven::Acceleration)
        });
    }

    /// Plays the signal that `made` returns for the sample rate of the output in Hz.
    fn play(&mut self, made: impl FnOnce(f64) -> Result<Signal, SignalError>) {
        let Some(handle) = &mut self.handle else { return };
        match made(f64::from(handle.config().device_rate_hz)) {
            Ok(signal) => {
                if handle.play_signal(signal).is_err() {
                    self.message = Some(strings::OUTPUT_BUSY.to_owned());
                }
            }
            Err(error) => self.message = Some(error.to_string()),
        }
    }

    pub(super) fn stop_tone(&mut self) {
        if let Some(handle) = &mut self.handle {
            handle.stop_signal();
        }
    }

    pub(super) fn is_opening(&self) -> bool {
        self.opening.is_busy()
    }

    pub(super) fn toggle_mute(&mut self) {
        self.muted = !self.muted;
        if let Some(handle) = &mut self.handle {
            let drive = handle.controls().drive;
            handle.set_drive(Drive { muted: self.muted, ..drive });
        }
    }

    pub(super) fn reset_limiter(&mut self) {
        if let Some(handle) = &mut self.handle {
            handle.reset_limiter();
        }
    }

    pub(super) fn latency_ms(&self) -> Option<f64> {
        Some(self.running.as_ref()?.latency_secs(&self.status?) * 1e3)
    }
}
