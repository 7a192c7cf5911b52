//! The receiver's side: what a microcontroller does with the bytes that arrive and the samples that are due.
//!
//! It has no clock, no memory to ask for and nothing to wait for: bytes go in by [`Receiver::receive`], a sample comes
//! out at every tick of the sample clock by [`Receiver::tick`], and frames to send by [`Receiver::transmit`]. Every
//! number is an integer, so that the same bytes and ticks give the same samples in any language;
//! `examples/serial-receiver-c` is the same in C.
//!
//! What it never does: play above the ceiling, play what is not of the present run, jump at a gap (it fades out, and in
//! again), play on when samples or control stop.
//!
//! ```
//! use shagreen_device::serial::receiver::{About, Receiver};
//!
//! let mut receiver = Receiver::<256>::new(About { name: "Voice coil", ..About::STREAM });
//! for byte in [0x03, 0x01, 0x01, 0x02, 0x01] {
//!     receiver.receive(byte);
//! }
//! assert_eq!(receiver.tick(0), 0, "nothing is configured, nothing is played");
//! ```

mod queue;

use self::queue::{Next, Queue};
use crate::serial::frame::{Decoder, MAX_WIRE};
use crate::serial::message::{
    Configure, Control, DeviceMessage, DeviceStatus, HelloReply, HostMessage, MAX_FAULT, MAX_SAMPLES, Mode,
    RunState, SampleBytes, VERSION, from_host, write_to_host,
};

/// What a receiver says of itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct About {
    /// Whether it plays samples.
    pub has_stream: bool,
    /// Whether it renders by itself.
    pub has_control: bool,
    /// Whether it sends samples of an accelerometer.
    pub has_sensor: bool,
    /// Lowest rate, in Hz.
    pub rate_min_hz: u16,
    /// Highest rate, in Hz.
    pub rate_max_hz: u16,
    /// Its name.
    pub name: &'static str,
}

impl About {
    /// A receiver that plays samples of any usual rate, and has no name.
    pub const STREAM: Self = Self {
        has_stream: true,
        has_control: false,
        has_sensor: false,
        rate_min_hz: 1000,
        rate_max_hz: 16_000,
        name: "",
    };
}

/// Before the first configuration.
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

/// A receiver that queues at most `N` samples.
#[derive(Clone, Debug)]
pub struct Receiver<const N: usize> {
    about: About,
    decoder: Decoder,
    /// How to play; a configuration of number 0 is none, and only says how to fade out.
    settings: Configure,
    queue: Queue<N>,
    run: u8,
    /// Whether the run has begun to be played.
    is_playing: bool,
    /// Whether it fades out: it does so to the end, whatever arrives.
    is_falling: bool,
    /// Present gain, in steps of a fade.
    gain: u16,
    /// The sample that is faded.
    held: i16,
    control: Control,
    control_seq: Option<u16>,
    /// Ticks since samples or control arrived.
    unfed_ticks: u32,
    ticks_to_report: u16,
    clock: u32,
    underruns: u16,
    dropped: u16,
    ping: u16,
    /// The nonce of a hello that is not answered yet.
    hello_due: Option<u16>,
    is_status_due: bool,
    fault_due: Option<(bool, &'static str)>,
}

impl<const N: usize> Receiver<N> {
    /// A receiver right after a reset: it says hello by itself.
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

    /// Takes the next byte from the line. Cost: that of one frame when it ends one, else a few instructions.
    pub fn receive(&mut self, byte: u8) {
        // What a message borrows from the decoder, the rest of the receiver takes: so the decoder is taken out.
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

    /// The next sample to play, at a tick of the sample clock; `rendered` is what the receiver itself has rendered for
    /// [`Receiver::control`], and counts in [`Mode::Control`] only. Call it at the configured rate, or at any rate while
    /// there is none.
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
                if self.is_playing && self.queue.len() == 0 && settings.mode == Mode::Stream {
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
        faded.clamp(-ceiling, ceiling) as i16
    }

    /// Writes the next frame that is to be sent, and returns its length: 0 is none. The newest status replaces one that
    /// has not been sent.
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

    /// How it is to play, while it is configured.
    pub fn settings(&self) -> Option<Configure> {
        (self.settings.config != 0).then_some(self.settings)
    }

    /// What to render, while the run is one of control.
    pub fn control(&self) -> Option<Control> {
        (self.settings.mode == Mode::Control && self.is_playing).then_some(self.control)
    }

    /// How it is doing.
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

    /// Tells the host that something is wrong, and where `has_stopped`, plays nothing until it is configured again.
    pub fn fault(&mut self, has_stopped: bool, text: &'static str) {
        self.fault_due = Some((has_stopped, text));
        if has_stopped {
            self.forget();
        }
    }

    /// The sample clock stood still: what is queued is old, and is dropped.
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
        if self.is_configured_for(Mode::Stream) && run == self.run {
            self.unfed_ticks = 0;
            n_new = self.queue.put(seq, samples, usize::from(self.settings.window));
        }
        self.dropped = self.dropped.wrapping_add(samples.len() as u16 - n_new);
        self.is_status_due |= self.settings.config == 0;
    }

    fn take_control(&mut self, seq: u16, run: u8, control: Control) {
        let is_newer = self.control_seq.is_none_or(|last| seq.wrapping_sub(last).cast_signed() > 0);
        if self.is_configured_for(Mode::Control) && run == self.run && is_newer {
            (self.control, self.control_seq) = (control, Some(seq));
            (self.is_playing, self.unfed_ticks) = (true, 0);
        } else {
            self.dropped = self.dropped.wrapping_add(1);
        }
        self.is_status_due |= self.settings.config == 0;
    }

    fn is_configured_for(&self, mode: Mode) -> bool {
        self.settings.config != 0 && self.settings.mode == mode
    }

    /// A status is due every so many ticks.
    fn report(&mut self, settings: Configure) {
        self.ticks_to_report -= 1;
        if self.ticks_to_report == 0 {
            (self.ticks_to_report, self.is_status_due) = (settings.report, true);
        }
    }

    /// Ends the run when nothing has fed it for too long.
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

    /// Drops what is queued and fades out. Only what carries the number of the next run will be played, so nothing that
    /// is on its way is.
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
        let About { has_stream, has_control, has_sensor, rate_min_hz, rate_max_hz, name } = self.about;
        let (buffer, frame_max) = (N.min(0x7FFF) as u16, MAX_SAMPLES as u8);
        let name = name.as_bytes();
        HelloReply {
            nonce,
            version: VERSION,
            has_stream,
            has_control,
            has_sensor,
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
