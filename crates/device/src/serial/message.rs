//! What the frames of the serial protocol say, both ways. Every number is little-endian.

mod payload;

use self::payload::{Reader, Writer};
use crate::serial::frame::{Frame, MAX_PAYLOAD, MAX_WIRE, encode};

/// Version of the protocol that is spoken here.
pub const VERSION: u8 = 1;
/// Most samples of one [`HostMessage::Samples`].
pub const MAX_SAMPLES: usize = 120;
/// Most samples of one [`DeviceMessage::Sensor`].
pub const MAX_SENSOR_SAMPLES: usize = (MAX_PAYLOAD - 10) / 2;
/// Most bytes of a receiver's name.
pub const MAX_NAME: usize = 32;
/// Most bytes of a fault's text.
pub const MAX_FAULT: usize = 64;

/// Who renders.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mode {
    /// The host renders and streams samples.
    #[default]
    Stream,
    /// The host sends what the hand does, the receiver renders.
    Control,
}

/// How the receiver is to play. It may take smaller numbers of samples than it was asked for, never a higher ceiling.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Configure {
    /// Number of this configuration, not 0: the status names it, so that the host knows that it arrived.
    pub config: u8,
    /// Who renders.
    pub mode: Mode,
    /// Samples a second.
    pub rate_hz: u16,
    /// Highest magnitude of a sample that is ever played.
    pub ceiling: u16,
    /// Silence after this long without samples or control, in ms.
    pub watchdog_ms: u16,
    /// Most samples that are queued.
    pub window: u16,
    /// Samples that are queued before playing begins.
    pub prefill: u16,
    /// Samples from one status to the next.
    pub report: u16,
    /// Samples of a fade, in or out.
    pub fade: u16,
    /// Acceleration at a sample of 32767, in cm/s².
    pub full_scale_cmps2: u16,
}

/// What the hand does, for a receiver that renders.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Control {
    /// Speed of the tip in tenths of mm/s.
    pub speed_dmmps: u16,
    /// Force of the tip in mN.
    pub force_mn: u16,
    /// Number of the texture; [`NO_TEXTURE`] is none.
    pub texture: u16,
    /// Gain in thousandths; 0 is silence.
    pub gain_permille: u16,
}

/// Number of no texture.
pub const NO_TEXTURE: u16 = 0xFFFF;

/// Samples as they lie in a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SampleBytes<'a>(&'a [u8]);

impl<'a> SampleBytes<'a> {
    /// How many there are.
    pub fn len(self) -> usize {
        self.0.len() / 2
    }

    /// Whether there is none.
    pub fn is_empty(self) -> bool {
        self.0.is_empty()
    }

    /// One after the other.
    pub fn iter(self) -> impl Iterator<Item = i16> + 'a {
        self.0.chunks_exact(2).map(|pair| i16::from_le_bytes([pair[0], pair[1]]))
    }
}

/// What the host says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HostMessage<'a> {
    /// Somebody new is there: fall silent, forget the configuration, and say who you are.
    Hello {
        /// Comes back in the answer.
        nonce: u16,
        /// The host's version of the protocol.
        version: u8,
    },
    /// Play like this from now on.
    Configure(Configure),
    /// Samples of a run.
    Samples {
        /// Index of the first, modulo 65536.
        seq: u16,
        /// The run that they belong to.
        run: u8,
        /// The samples, at least one.
        samples: SampleBytes<'a>,
    },
    /// What the hand does.
    Control {
        /// Counts these messages, modulo 65536.
        seq: u16,
        /// The run that it belongs to.
        run: u8,
        /// What it does.
        control: Control,
    },
    /// Fade out and drop what is queued.
    Stop,
    /// Send a status.
    Ping {
        /// Comes back in the status.
        id: u16,
    },
}

/// How far a receiver is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RunState {
    /// It has no configuration, or has been reset since.
    #[default]
    Unconfigured,
    /// It waits for the first samples or control of its run.
    Armed,
    /// It has samples, too few to begin.
    Filling,
    /// It plays.
    Playing,
}

/// How a receiver is doing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DeviceStatus {
    /// Index of the sample that it expects next, modulo 65536; means nothing while it is [`RunState::Armed`].
    pub seq: u16,
    /// Number of its configuration; 0 is none.
    pub config: u8,
    /// Number of its run: only samples that carry it are played.
    pub run: u8,
    /// How far it is.
    pub state: RunState,
    /// Samples that it would take now.
    pub free: u16,
    /// Samples that it has and has not played yet.
    pub queued: u16,
    /// Samples that its clock has counted since it was configured, modulo 2³²: silence too.
    pub clock: u32,
    /// Runs that ended for want of samples, modulo 65536.
    pub underruns: u16,
    /// Frames that were cut or corrupted, modulo 65536.
    pub bad_frames: u16,
    /// Samples and controls that came too late, twice, too early or for another run, modulo 65536.
    pub dropped: u16,
    /// The last ping that arrived.
    pub ping: u16,
}

/// Who a receiver is and what it can do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HelloReply<'a> {
    /// The nonce of the hello that this answers; 0 right after a reset.
    pub nonce: u16,
    /// Its version of the protocol.
    pub version: u8,
    /// Whether it plays samples.
    pub has_stream: bool,
    /// Whether it renders by itself.
    pub has_control: bool,
    /// Whether it sends [`DeviceMessage::Sensor`].
    pub has_sensor: bool,
    /// Lowest rate, in Hz.
    pub rate_min_hz: u16,
    /// Highest rate, in Hz.
    pub rate_max_hz: u16,
    /// Most samples that it queues.
    pub buffer: u16,
    /// Most samples a frame.
    pub frame_max: u8,
    /// Its name, UTF-8, at most [`MAX_NAME`] bytes.
    pub name: &'a [u8],
}

/// What the receiver says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DeviceMessage<'a> {
    /// Who it is.
    HelloReply(HelloReply<'a>),
    /// How it is doing.
    Status(DeviceStatus),
    /// Samples of its accelerometer.
    Sensor {
        /// Index of the first, modulo 65536.
        seq: u16,
        /// Samples a second.
        rate_hz: u16,
        /// When the first was taken, in µs of any clock of its own, modulo 2³².
        time_us: u32,
        /// Acceleration of a count, in µm/s².
        scale_umps2: u32,
        /// The samples.
        samples: SampleBytes<'a>,
    },
    /// Something is wrong with it.
    Fault {
        /// Whether it has stopped for good; else it goes on.
        has_stopped: bool,
        /// What is wrong, UTF-8, at most [`MAX_FAULT`] bytes.
        text: &'a [u8],
    },
}

/// A payload does not hold what its type should.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Malformed;

const HELLO: u8 = 0x01;
const CONFIGURE: u8 = 0x02;
const SAMPLES: u8 = 0x03;
const CONTROL: u8 = 0x04;
const STOP: u8 = 0x05;
const PING: u8 = 0x06;
const HELLO_REPLY: u8 = 0x81;
const STATUS: u8 = 0x82;
const SENSOR: u8 = 0x83;
const FAULT: u8 = 0x84;

const HAS_STREAM: u8 = 1;
const HAS_CONTROL: u8 = 2;
const HAS_SENSOR: u8 = 4;

/// What a frame from the host says; nothing where its type is unknown, which later versions may send.
///
/// # Errors
/// [`Malformed`] where the payload is too short or holds a number that means nothing. Longer ones are taken: later
/// versions may add to the end.
pub fn from_host(frame: Frame<'_>) -> Result<Option<HostMessage<'_>>, Malformed> {
    let mut r = Reader::new(frame.payload);
    let seq = frame.seq;
    let message = match frame.kind {
        HELLO => HostMessage::Hello { nonce: seq, version: r.u8()? },
        CONFIGURE => HostMessage::Configure(read_configure(&mut r)?),
        SAMPLES => HostMessage::Samples { seq, run: r.u8()?, samples: r.samples(MAX_SAMPLES)? },
        CONTROL => HostMessage::Control { seq, run: r.u8()?, control: read_control(&mut r)? },
        STOP => HostMessage::Stop,
        PING => HostMessage::Ping { id: seq },
        _ => return Ok(None),
    };
    Ok(Some(message))
}

/// What a frame from the receiver says; nothing where its type is unknown, which later versions may send.
///
/// # Errors
/// [`Malformed`] as for [`from_host`].
pub fn from_device(frame: Frame<'_>) -> Result<Option<DeviceMessage<'_>>, Malformed> {
    let mut r = Reader::new(frame.payload);
    let seq = frame.seq;
    let message = match frame.kind {
        HELLO_REPLY => DeviceMessage::HelloReply(read_hello_reply(seq, &mut r)?),
        STATUS => DeviceMessage::Status(read_status(seq, &mut r)?),
        SENSOR => DeviceMessage::Sensor {
            seq,
            rate_hz: r.u16()?,
            time_us: r.u32()?,
            scale_umps2: r.u32()?,
            samples: r.samples(MAX_SENSOR_SAMPLES)?,
        },
        FAULT => DeviceMessage::Fault { has_stopped: r.u8()? != 0, text: r.text(MAX_FAULT) },
        _ => return Ok(None),
    };
    Ok(Some(message))
}

/// Writes a message of the host as it goes over the wire, and returns its length.
pub fn write_to_device(message: HostMessage<'_>, wire: &mut [u8; MAX_WIRE]) -> usize {
    let mut w = Writer::new();
    let (kind, seq) = match message {
        HostMessage::Hello { nonce, version } => {
            w.u8(version);
            (HELLO, nonce)
        }
        HostMessage::Configure(configure) => {
            write_configure(&mut w, configure);
            (CONFIGURE, 0)
        }
        HostMessage::Samples { seq, run, samples } => {
            w.u8(run);
            w.bytes(samples.0);
            (SAMPLES, seq)
        }
        HostMessage::Control { seq, run, control } => {
            w.u8(run);
            w.u16(control.speed_dmmps);
            w.u16(control.force_mn);
            w.u16(control.texture);
            w.u16(control.gain_permille);
            (CONTROL, seq)
        }
        HostMessage::Stop => (STOP, 0),
        HostMessage::Ping { id } => (PING, id),
    };
    encode(Frame { kind, seq, payload: w.payload() }, wire)
}

/// Writes samples as [`HostMessage::Samples`], at most [`MAX_SAMPLES`] of them, and returns the length on the wire.
pub fn write_samples(seq: u16, run: u8, samples: &[i16], wire: &mut [u8; MAX_WIRE]) -> usize {
    let mut w = Writer::new();
    w.u8(run);
    w.samples(&samples[..samples.len().min(MAX_SAMPLES)]);
    encode(Frame { kind: SAMPLES, seq, payload: w.payload() }, wire)
}

/// Writes samples of an accelerometer as [`DeviceMessage::Sensor`], at most [`MAX_SENSOR_SAMPLES`] of them, and returns
/// the length on the wire.
pub fn write_sensor(
    (seq, rate_hz, time_us, scale_umps2): (u16, u16, u32, u32),
    samples: &[i16],
    wire: &mut [u8; MAX_WIRE],
) -> usize {
    let mut w = Writer::new();
    w.u16(rate_hz);
    w.u32(time_us);
    w.u32(scale_umps2);
    w.samples(&samples[..samples.len().min(MAX_SENSOR_SAMPLES)]);
    encode(Frame { kind: SENSOR, seq, payload: w.payload() }, wire)
}

/// Writes a message of the receiver as it goes over the wire, and returns its length.
pub fn write_to_host(message: DeviceMessage<'_>, wire: &mut [u8; MAX_WIRE]) -> usize {
    let mut w = Writer::new();
    let (kind, seq) = match message {
        DeviceMessage::HelloReply(reply) => {
            write_hello_reply(&mut w, reply);
            (HELLO_REPLY, reply.nonce)
        }
        DeviceMessage::Status(status) => {
            write_status(&mut w, status);
            (STATUS, status.seq)
        }
        DeviceMessage::Sensor { seq, rate_hz, time_us, scale_umps2, samples } => {
            w.u16(rate_hz);
            w.u32(time_us);
            w.u32(scale_umps2);
            w.bytes(samples.0);
            (SENSOR, seq)
        }
        DeviceMessage::Fault { has_stopped, text } => {
            w.u8(u8::from(has_stopped));
            w.bytes(&text[..text.len().min(MAX_FAULT)]);
            (FAULT, 0)
        }
    };
    encode(Frame { kind, seq, payload: w.payload() }, wire)
}

fn read_configure(r: &mut Reader<'_>) -> Result<Configure, Malformed> {
    let config = r.u8()?;
    let mode = match r.u8()? {
        0 => Mode::Stream,
        1 => Mode::Control,
        _ => return Err(Malformed),
    };
    let configure = Configure {
        config,
        mode,
        rate_hz: r.u16()?,
        ceiling: r.u16()?,
        watchdog_ms: r.u16()?,
        window: r.u16()?,
        prefill: r.u16()?,
        report: r.u16()?,
        fade: r.u16()?,
        full_scale_cmps2: r.u16()?,
    };
    if config == 0 || configure.rate_hz == 0 { Err(Malformed) } else { Ok(configure) }
}

fn write_configure(w: &mut Writer, configure: Configure) {
    w.u8(configure.config);
    w.u8(match configure.mode {
        Mode::Stream => 0,
        Mode::Control => 1,
    });
    let numbers = [
        configure.rate_hz,
        configure.ceiling,
        configure.watchdog_ms,
        configure.window,
        configure.prefill,
        configure.report,
        configure.fade,
        configure.full_scale_cmps2,
    ];
    for number in numbers {
        w.u16(number);
    }
}

fn read_control(r: &mut Reader<'_>) -> Result<Control, Malformed> {
    Ok(Control { speed_dmmps: r.u16()?, force_mn: r.u16()?, texture: r.u16()?, gain_permille: r.u16()? })
}

fn read_hello_reply<'a>(nonce: u16, r: &mut Reader<'a>) -> Result<HelloReply<'a>, Malformed> {
    let (version, flags) = (r.u8()?, r.u8()?);
    Ok(HelloReply {
        nonce,
        version,
        has_stream: flags & HAS_STREAM != 0,
        has_control: flags & HAS_CONTROL != 0,
        has_sensor: flags & HAS_SENSOR != 0,
        rate_min_hz: r.u16()?,
        rate_max_hz: r.u16()?,
        buffer: r.u16()?,
        frame_max: r.u8()?,
        name: {
            let len = usize::from(r.u8()?);
            r.take(len)?
        },
    })
}

fn write_hello_reply(w: &mut Writer, reply: HelloReply<'_>) {
    let flag = |has: bool, flag: u8| if has { flag } else { 0 };
    let name = &reply.name[..reply.name.len().min(MAX_NAME)];
    w.u8(reply.version);
    w.u8(flag(reply.has_stream, HAS_STREAM)
        | flag(reply.has_control, HAS_CONTROL)
        | flag(reply.has_sensor, HAS_SENSOR));
    w.u16(reply.rate_min_hz);
    w.u16(reply.rate_max_hz);
    w.u16(reply.buffer);
    w.u8(reply.frame_max);
    w.u8(name.len() as u8);
    w.bytes(name);
}

fn read_status(seq: u16, r: &mut Reader<'_>) -> Result<DeviceStatus, Malformed> {
    Ok(DeviceStatus {
        seq,
        config: r.u8()?,
        run: r.u8()?,
        state: match r.u8()? {
            0 => RunState::Unconfigured,
            1 => RunState::Armed,
            2 => RunState::Filling,
            3 => RunState::Playing,
            _ => return Err(Malformed),
        },
        free: r.u16()?,
        queued: r.u16()?,
        clock: r.u32()?,
        underruns: r.u16()?,
        bad_frames: r.u16()?,
        dropped: r.u16()?,
        ping: r.u16()?,
    })
}

fn write_status(w: &mut Writer, status: DeviceStatus) {
    w.u8(status.config);
    w.u8(status.run);
    w.u8(match status.state {
        RunState::Unconfigured => 0,
        RunState::Armed => 1,
        RunState::Filling => 2,
        RunState::Playing => 3,
    });
    w.u16(status.free);
    w.u16(status.queued);
    w.u32(status.clock);
    w.u16(status.underruns);
    w.u16(status.bad_frames);
    w.u16(status.dropped);
    w.u16(status.ping);
}

#[cfg(test)]
pub(super) mod tests;
