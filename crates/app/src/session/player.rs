//! The open output: textures sent to it, touches, and its status.

mod signals;
mod slots;

use std::sync::Arc;
use std::sync::mpsc::Receiver;
use std::time::Instant;

use shagreen_core::space::SpacePoint;
use shagreen_core::space::authoring::Blending;
use shagreen_core::texture::shape::Shape;
use shagreen_device::audio_input::{InputInfo, list_inputs};
use shagreen_device::controls::{Drive, Input, Takeover};
use shagreen_device::engine::Handle;
use shagreen_device::error::DeviceErrorKind;
use shagreen_device::haptic_pen::sender::HapticReading;
use shagreen_device::live::LiveInput;
use shagreen_device::output::{OpenOptions, OutputInfo, OutputKind, Running, is_same_output, list_outputs};
use shagreen_device::serial::{ID_PREFIX, list_serial_ports};
use shagreen_device::status::{LinkState, Status};
use shagreen_device::stylus::MouseStylus;
use shagreen_device::synth::drive::DriveConfig;
use shagreen_device::synth::renderer::TextureId;
use shagreen_device::synth::tap::Tap;

use super::opening::{Came, Opened, Opening, OutputChoice, Request};
use crate::session::player::slots::MadeSlots;
use crate::state::background::in_background;
use crate::state::mouse_report::MouseReport;
use crate::state::recorded_stroke::RecordedStroke;
use crate::state::rig::Rig;
use crate::state::scope_buffer::ScopeBuffer;

/// Input of a mix: point, interpolation options, shape, index of the soloed texture, and key on its path.
pub(super) type Wanted = (SpacePoint, Blending, Shape, Option<usize>, Option<usize>);

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

    pub(super) fn haptic_reading(&self) -> Option<HapticReading> {
        self.running.as_ref()?.haptic_reading()
    }

    pub(super) fn stream(&self) -> Option<(u32, u16, Option<u32>)> {
        self.running.as_ref().map(|r| (r.rate_hz(), r.channels(), r.buffer_frames()))
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
