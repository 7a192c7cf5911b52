//! Messages of the serial protocol in both directions. All numbers are little-endian.

mod mode;
mod payload;

pub use self::mode::Mode;

use self::payload::{Reader, Writer};
use crate::serial::frame::{Frame, MAX_PAYLOAD, MAX_WIRE, encode};

/// Protocol version of this implementation.
pub const VERSION: u8 = 1;
/// Most samples in a [`HostMessage::Samples`].
pub const MAX_SAMPLES: usize = 120;
/// Most samples in a [`DeviceMessage::Sensor`].
pub const MAX_SENSOR_SAMPLES: usize = (MAX_PAYLOAD - 10) / 2;
/// Longest name of a receiver, in bytes.
pub const MAX_NAME: usize = 32;
/// Longest text of a fault, in bytes.
pub const MAX_FAULT: usize = 64;

/// Playback settings for a receiver. It may use smaller numbers of samples than requested, but never a higher ceiling.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Configure {
    /// Number of this configuration, not 0. The status repeats it, so that the host knows that the configuration
    /// arrived.
    pub config: u8,
    /// Rendering mode.
    pub mode: Mode,
    /// Sample rate, in Hz.
    pub rate_hz: u16,
    /// Largest magnitude of any played sample.
    pub ceiling: u16,
    /// Time without samples or controls after which the receiver becomes silent, in ms.
    pub watchdog_ms: u16,
    /// Most samples in the queue.
    pub window: u16,
    /// Samples in the queue at which playback starts.
    pub prefill: u16,
    /// Samples between two status messages.
    pub report: u16,
    /// Length of a fade, in samples.
    pub fade: u16,
    /// Acceleration at a sample of 32767, in cm/s².
    pub full_scale_cmps2: u16,
}

/// Contact and texture for a receiver that renders.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Control {
    /// Tip speed, in units of 0.1 mm/s.
    pub speed_dmmps: u16,
    /// Normal force, in mN.
    pub force_mn: u16,
    /// Id of the texture, or [`NO_TEXTURE`].
    pub texture: u16,
    /// Gain in thousandths; 0 is silence.
    pub gain_permille: u16,
}

/// Texture id that means no texture.
pub const NO_TEXTURE: u16 = 0xFFFF;

/// Samples in the encoding of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SampleBytes<'a>(&'a [u8]);

impl<'a> SampleBytes<'a> {
    /// Number of samples.
    pub fn len(self) -> usize {
        self.0.len() / 2
    }

    /// Whether there are no samples.
    pub fn is_empty(self) -> bool {
        self.0.is_empty()
    }

    /// Iterates over the samples.
    pub fn iter(self) -> impl Iterator<Item = i16> + 'a {
        self.0.chunks_exact(2).map(|pair| i16::from_le_bytes([pair[0], pair[1]]))
    }
}

/// Message from the host.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HostMessage<'a> {
    /// A new host is connected: fall silent, discard the configuration, and reply with the capabilities.
    Hello {
        /// Nonce that the reply repeats.
        nonce: u16,
        /// Protocol version of the host.
        version: u8,
    },
    /// New playback settings.
    Configure(Configure),
    /// Samples of a run.
    Samples {
        /// Index of the first sample, modulo 65536.
        seq: u16,
        /// Run number of the samples.
        run: u8,
        /// The samples, at least one.
        samples: SampleBytes<'a>,
    },
    /// Contact and texture for a receiver that renders.
    Control {
        /// Message counter, modulo 65536.
        seq: u16,
        /// Run number of the message.
        run: u8,
        /// Contact and texture.
        control: Control,
    },
    /// Fade out and discard the queue.
    Stop,
    /// Request for a status.
    Ping {
        /// Number that the status repeats.
        id: u16,
    },
}

/// Playback state of a receiver.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RunState {
    /// No configuration, or a reset since the last one.
    #[default]
    Unconfigured,
    /// Waiting for the first samples or controls of the run.
    Armed,
    /// Filling the queue; too few samples to start.
    Filling,
    /// Playing.
    Playing,
}

/// Status of a receiver.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DeviceStatus {
    /// Index of the next expected sample, modulo 65536; undefined in the state [`RunState::Armed`].
    pub seq: u16,
    /// Number of the configuration; 0 for none.
    pub config: u8,
    /// Number of the current run; only samples with this number are played.
    pub run: u8,
    /// Playback state.
    pub state: RunState,
    /// Number of samples that fit into the queue now.
    pub free: u16,
    /// Number of samples in the queue.
    pub queued: u16,
    /// Ticks of the sample clock since the configuration, including silence, modulo 2³².
    pub clock: u32,
    /// Number of runs that ended by an underrun, modulo 65536.
    pub underruns: u16,
    /// Number of truncated or corrupted frames, modulo 65536.
    pub bad_frames: u16,
    /// Number of samples and controls that were late, repeated, too early or of another run, modulo 65536.
    pub dropped: u16,
    /// Number of the last received ping.
    pub ping: u16,
}

/// Identity and capabilities of a receiver.
#[expect(clippy::struct_excessive_bools, reason = "each is one capability bit of the protocol")]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HelloReply<'a> {
    /// Nonce of the answered hello; 0 right after a reset.
    pub nonce: u16,
    /// Protocol version of the receiver.
    pub version: u8,
    /// Whether it plays samples.
    pub has_stream: bool,
    /// Whether it renders textures itself.
    pub has_control: bool,
    /// Whether it sends [`DeviceMessage::Sensor`].
    pub has_sensor: bool,
    /// Whether it plays levels of friction.
    pub has_friction: bool,
    /// Lowest sample rate, in Hz.
    pub rate_min_hz: u16,
    /// Highest sample rate, in Hz.
    pub rate_max_hz: u16,
    /// Capacity of its queue, in samples.
    pub buffer: u16,
    /// Most samples in a frame.
    pub frame_max: u8,
    /// Name, UTF-8, at most [`MAX_NAME`] bytes.
    pub name: &'a [u8],
}

/// Message from the receiver.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DeviceMessage<'a> {
    /// Identity and capabilities.
    HelloReply(HelloReply<'a>),
    /// Status.
    Status(DeviceStatus),
    /// Accelerometer samples.
    Sensor {
        /// Index of the first sample, modulo 65536.
        seq: u16,
        /// Sample rate, in Hz.
        rate_hz: u16,
        /// Time of the first sample, in µs of the receiver's own clock, modulo 2³².
        time_us: u32,
        /// Acceleration per count, in µm/s².
        scale_umps2: u32,
        /// The samples.
        samples: SampleBytes<'a>,
    },
    /// A fault of the receiver.
    Fault {
        /// Whether the receiver has stopped permanently; otherwise it continues.
        has_stopped: bool,
        /// Description, UTF-8, at most [`MAX_FAULT`] bytes.
        text: &'a [u8],
    },
}

/// Error of a payload that does not match its message type.
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
const HAS_FRICTION: u8 = 8;

/// Decodes a frame from the host. Returns `None` for an unknown type, which later protocol versions may send.
///
/// # Errors
/// [`Malformed`] if the payload is too short or holds an invalid value. Longer payloads are accepted, because later
/// versions may append fields.
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

/// Decodes a frame from the receiver. Returns `None` for an unknown type, which later protocol versions may send.
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

/// Encodes a message of the host for the line. Returns its length in bytes.
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

/// Encodes samples as [`HostMessage::Samples`], at most [`MAX_SAMPLES`] of them. Returns the length on the line in
/// bytes.
pub fn write_samples(seq: u16, run: u8, samples: &[i16], wire: &mut [u8; MAX_WIRE]) -> usize {
    let mut w = Writer::new();
    w.u8(run);
    w.samples(&samples[..samples.len().min(MAX_SAMPLES)]);
    encode(Frame { kind: SAMPLES, seq, payload: w.payload() }, wire)
}

/// Encodes accelerometer samples as [`DeviceMessage::Sensor`], at most [`MAX_SENSOR_SAMPLES`] of them. Returns the
/// length on the line in bytes.
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

/// Encodes a message of the receiver for the line. Returns its length in bytes.
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
    let mode = Mode::of_code(r.u8()?).ok_or(Malformed)?;
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
    w.u8(configure.mode.code());
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
        has_friction: flags & HAS_FRICTION != 0,
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
        | flag(reply.has_sensor, HAS_SENSOR)
        | flag(reply.has_friction, HAS_FRICTION));
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
