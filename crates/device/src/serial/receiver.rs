//! Receiver side of the serial protocol, as run by a microcontroller.
//!
//! It needs no clock, no memory allocation and no waiting. Bytes enter by [`Receiver::receive`]. [`Receiver::tick`]
//! returns one sample per tick of the sample clock, and [`Receiver::transmit`] returns frames to send. All numbers are
//! integers, so the same bytes and ticks give the same samples in every language; `examples/serial-receiver-c`
//! implements the same in C.
//!
//! It never plays above the ceiling and never plays samples of another run. It never jumps at a gap but fades out and
//! in, and it stops when samples or controls stop.
//!
//! ```
//! use shagreen_device::serial::receiver::{About, Receiver};
//!
//! let mut receiver = Receiver::<256>::new(About { name: "Voice coil", ..About::STREAM });
//! for byte in [0x03, 0x01, 0x01, 0x02, 0x01] {
//!     receiver.receive(byte);
//! }
//! assert_eq!(receiver.tick(0), 0, "an unconfigured receiver is silent");
//! ```

mod queue;

use self::queue::{Next, Queue};
use crate::serial::frame::{Decoder, MAX_WIRE};
use crate::serial::message::{
    Configure, Control, DeviceMessage, DeviceStatus, HelloReply, HostMessage, MAX_FAULT, MAX_SAMPLES, Mode,
    RunState, SampleBytes, VERSION, from_host, write_to_host,
};

/// Identity and capabilities of a receiver.
#[expect(clippy::struct_excessive_bools, reason = "each is one capability bit of the protocol")]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct About {
    /// Whether it plays samples.
    pub has_stream: bool,
    /// Whether it renders textures itself.
    pub has_control: bool,
    /// Whether it sends accelerometer samples.
    pub has_sensor: bool,
    /// Whether it plays levels of friction.
    pub has_friction: bool,
    /// Lowest sample rate, in Hz.
    pub rate_min_hz: u16,
    /// Highest sample rate, in Hz.
    pub rate_max_hz: u16,
    /// Name of the receiver.
    pub name: &'static str,
}

impl About {
    /// A receiver without a name that plays samples at 1 to 16 kHz.
    pub const STREAM: Self = Self {
        has_stream: true,
        has_control: false,
        has_sensor: false,
        has_friction: false,
        rate_min_hz: 1000,
        rate_max_hz: 16_000,
        name: "",
    };
}

/// Settings before the first configuration.
const UNCONFIGURED: Configure = Configure {
    config: 0,
    mode: Mode::Stream,
    rate_hz: 1,
    ceiling: 0,
    watchdog_ms: 0,
    window: 0,
    prefill: 1,
    report: 1,
    fade: 1,
    full_scale_cmps2: 0,
};

/// A receiver with a queue of at most `N` samples.
#[derive(Clone, Debug)]
pub struct Receiver<const N: usize> {
    about: About,
    decoder: Decoder,
    /// Playback settings. With configuration number 0 the receiver is unconfigured, and they only control the fade-out.
    settings: Configure,
    queue: Queue<N>,
    run: u8,
    /// Whether playback of the run has started.
    is_playing: bool,
    /// Whether a fade-out is in progress; it always runs to its end.
    is_falling: bool,
    /// Current gain, in steps of a fade.
    gain: u16,
    /// Sample to which the gain applies.
    held: i16,
    control: Control,
    control_seq: Option<u16>,
    /// Ticks since the last samples or controls.
    unfed_ticks: u32,
    ticks_to_report: u16,
    clock: u32,
    underruns: u16,
    dropped: u16,
    ping: u16,
    /// Nonce of a hello that still needs a reply.
    hello_due: Option<u16>,
    is_status_due: bool,
    fault_due: Option<(bool, &'static str)>,
}

impl<const N: usize> Receiver<N> {
    /// A receiver right after a reset; it sends a hello reply without a request.
    pub const fn new(about: About) -> Self {
        Self {
            about,
            decoder: Decoder::new(),
            settings: UNCONFIGURED,
            queue: Queue::new(),
            run: 0,
            is_playing: false,
            is_falling: false,
            gain: 0,
            held: 0,
            control: Control { speed_dmmps: 0, force_mn: 0, texture: 0xFFFF, gain_permille: 0 },
            control_seq: None,
            unfed_ticks: 0,
            ticks_to_report: 0,
            clock: 0,
            underruns: 0,
            dropped: 0,
            ping: 0,
            hello_due: Some(0),
            is_status_due: false,
            fault_due: None,
        }
    }

    /// Processes the next byte from the line. Cost: that of one frame at its last byte, otherwise a few instructions.
    pub fn receive(&mut self, byte: u8) {
        // The message borrows from the decoder while the receiver is modified, so the decoder is moved out temporarily.
        let mut decoder = core::mem::take(&mut self.decoder);
        if let Some(frame) = decoder.push(byte) {
            match from_host(frame) {
                Ok(Some(message)) => self.obey(message),
                Ok(None) => {}
                Err(_) => decoder.note_bad(),
            }
        }
        self.decoder = decoder;
    }

    /// Returns the next sample to play, at a tick of the sample clock. `rendered` is the sample that the receiver
    /// itself renders for [`Receiver::control`]; it is used in [`Mode::Control`] only. Call this at the configured
    /// rate, or at any rate while there is no configuration.
    pub fn tick(&mut self, rendered: i16) -> i16 {
        let settings = self.settings;
        if settings.config != 0 {
            self.clock = self.clock.wrapping_add(1);
            self.report(settings);
            self.watch(settings);
        }
        let next = self.next(settings, rendered);
        if self.is_falling {
            self.gain = self.gain.saturating_sub(1);
            if self.gain == 0 {
                self.is_falling = false;
                if self.is_playing && self.queue.len() == 0 && settings.mode.is_streamed() {
                    self.starve();
                }
            }
        } else {
            match next {
                Next::Sample(sample) => {
                    self.held = sample;
                    self.gain = (self.gain + 1).min(settings.fade);
                }
                Next::Hole | Next::Empty if self.gain > 0 => {
                    self.gain -= 1;
                    self.is_falling = self.gain > 0;
                }
                Next::Empty if self.is_playing => self.starve(),
                Next::Hole | Next::Empty => {}
            }
        }
        let faded = i32::from(self.held) * i32::from(self.gain) / i32::from(settings.fade);
        let ceiling = i32::from(settings.ceiling);
        faded.clamp(settings.mode.floor(ceiling), ceiling) as i16
    }

    /// Encodes the next frame to send. Returns its length in bytes, or 0 if there is none. A newer status replaces an
    /// unsent one.
    pub fn transmit(&mut self, wire: &mut [u8; MAX_WIRE]) -> usize {
        if let Some(nonce) = self.hello_due.take() {
            return write_to_host(DeviceMessage::HelloReply(self.hello_reply(nonce)), wire);
        }
        if let Some((has_stopped, text)) = self.fault_due.take() {
            let text = text.as_bytes();
            let text = &text[..text.len().min(MAX_FAULT)];
            return write_to_host(DeviceMessage::Fault { has_stopped, text }, wire);
        }
        if core::mem::take(&mut self.is_status_due) {
            return write_to_host(DeviceMessage::Status(self.status()), wire);
        }
        0
    }

    /// Playback settings, or `None` without a configuration.
    pub fn settings(&self) -> Option<Configure> {
        (self.settings.config != 0).then_some(self.settings)
    }

    /// Contact and texture to render, or `None` outside a run in [`Mode::Control`].
    pub fn control(&self) -> Option<Control> {
        (self.settings.mode == Mode::Control && self.is_playing).then_some(self.control)
    }

    /// Current status.
    pub fn status(&self) -> DeviceStatus {
        let settings = self.settings;
        let queued = self.queue.len() as u16;
        let state = if settings.config == 0 {
            RunState::Unconfigured
        } else if self.is_playing {
            RunState::Playing
        } else if self.queue.has_begun() {
            RunState::Filling
        } else {
            RunState::Armed
        };
        let free = if settings.config == 0 { 0 } else { settings.window.saturating_sub(queued) };
        DeviceStatus {
            seq: self.queue.end(),
            config: settings.config,
            run: self.run,
            state,
            free,
            queued,
            clock: self.clock,
            underruns: self.underruns,
            bad_frames: self.decoder.bad_frames(),
            dropped: self.dropped,
            ping: self.ping,
        }
    }

    /// Reports a fault to the host. With `has_stopped`, the receiver is silent until it is configured again.
    pub fn fault(&mut self, has_stopped: bool, text: &'static str) {
        self.fault_due = Some((has_stopped, text));
        if has_stopped {
            self.forget();
        }
    }

    /// Discards the queue, for use after the sample clock has stood still.
    pub fn skip(&mut self) {
        self.end_run();
    }

    fn obey(&mut self, message: HostMessage<'_>) {
        match message {
            HostMessage::Hello { nonce, .. } => {
                self.forget();
                self.hello_due = Some(nonce);
            }
            HostMessage::Configure(configure) => self.configure(configure),
            HostMessage::Samples { seq, run, samples } => self.take_samples(seq, run, samples),
            HostMessage::Control { seq, run, control } => self.take_control(seq, run, control),
            HostMessage::Stop => self.end_run(),
            HostMessage::Ping { id } => {
                self.ping = id;
                self.is_status_due = true;
            }
        }
    }

    fn configure(&mut self, asked: Configure) {
        let has_mode = match asked.mode {
            Mode::Stream => self.about.has_stream,
            Mode::Control => self.about.has_control,
            Mode::Friction => self.about.has_friction,
        };
        if !has_mode || !(self.about.rate_min_hz..=self.about.rate_max_hz).contains(&asked.rate_hz) {
            self.fault(true, "no such mode or rate");
            return;
        }
        let window = asked.window.clamp(1, N.min(0x7FFF) as u16);
        let settings = Configure {
            ceiling: asked.ceiling.min(0x7FFF),
            window,
            prefill: asked.prefill.clamp(1, window),
            report: asked.report.max(1),
            fade: asked.fade.max(1),
            ..asked
        };
        self.end_run();
        self.gain = self.gain.min(settings.fade);
        self.settings = settings;
        (self.clock, self.ticks_to_report) = (0, settings.report);
    }

    fn take_samples(&mut self, seq: u16, run: u8, samples: SampleBytes<'_>) {
        let mut n_new = 0;
        let is_streamed = self.settings.config != 0 && self.settings.mode.is_streamed();
        if is_streamed && run == self.run {
            self.unfed_ticks = 0;
            n_new = self.queue.put(seq, samples, usize::from(self.settings.window));
        }
        self.dropped = self.dropped.wrapping_add(samples.len() as u16 - n_new);
        self.is_status_due |= self.settings.config == 0;
    }

    fn take_control(&mut self, seq: u16, run: u8, control: Control) {
        let is_newer = self.control_seq.is_none_or(|last| seq.wrapping_sub(last).cast_signed() > 0);
        let is_controlled = self.settings.config != 0 && !self.settings.mode.is_streamed();
        if is_controlled && run == self.run && is_newer {
            (self.control, self.control_seq) = (control, Some(seq));
            (self.is_playing, self.unfed_ticks) = (true, 0);
        } else {
            self.dropped = self.dropped.wrapping_add(1);
        }
        self.is_status_due |= self.settings.config == 0;
    }

    /// Schedules a status every `report` ticks.
    fn report(&mut self, settings: Configure) {
        self.ticks_to_report -= 1;
        if self.ticks_to_report == 0 {
            (self.ticks_to_report, self.is_status_due) = (settings.report, true);
        }
    }

    /// Ends the run if there were no samples or controls for too long.
    fn watch(&mut self, settings: Configure) {
        if !self.is_playing && !self.queue.has_begun() {
            return;
        }
        self.unfed_ticks += 1;
        let most = (u32::from(settings.watchdog_ms) * u32::from(settings.rate_hz) / 1000).max(1);
        if self.unfed_ticks >= most {
            self.starve();
        }
    }

    fn next(&mut self, settings: Configure, rendered: i16) -> Next {
        if settings.mode == Mode::Control {
            return if self.is_playing { Next::Sample(rendered) } else { Next::Empty };
        }
        if !self.is_playing && self.gain == 0 && self.queue.len() >= usize::from(settings.prefill) {
            self.is_playing = true;
        }
        if self.is_playing { self.queue.take() } else { Next::Empty }
    }

    fn starve(&mut self) {
        self.underruns = self.underruns.wrapping_add(1);
        self.end_run();
    }

    /// Discards the queue and fades out. Only samples with the number of the next run are played afterwards, so samples
    /// in transit are not.
    fn end_run(&mut self) {
        self.run = self.run.wrapping_add(1);
        self.queue.clear();
        self.control_seq = None;
        self.unfed_ticks = 0;
        self.is_playing = false;
        self.is_falling = self.gain > 0;
        self.is_status_due = true;
    }

    fn forget(&mut self) {
        self.end_run();
        self.settings.config = 0;
    }

    fn hello_reply(&self, nonce: u16) -> HelloReply<'static> {
        let About { has_stream, has_control, has_sensor, has_friction, rate_min_hz, rate_max_hz, name } =
            self.about;
        let (buffer, frame_max) = (N.min(0x7FFF) as u16, MAX_SAMPLES as u8);
        let name = name.as_bytes();
        HelloReply {
            nonce,
            version: VERSION,
            has_stream,
            has_control,
            has_sensor,
            has_friction,
            rate_min_hz,
            rate_max_hz,
            buffer,
            frame_max,
            name,
        }
    }
}

#[cfg(test)]
mod tests;
