//! Negotiation with a receiver: the rate, window and block size that receiver and serial line support.

use std::time::Duration;

use crate::error::{DeviceError, DeviceErrorKind};
use crate::output_options::OpenOptions;
use crate::serial::SerialOptions;
use crate::serial::frame::OVERHEAD;
use crate::serial::message::{Configure, HelloReply, Mode, VERSION};
use crate::serial::sender::Plan;

/// Default sample rate on a serial line, in Hz.
pub const USUAL_SERIAL_RATE_HZ: u32 = 4000;
/// Default rate of friction levels on a serial line, in Hz.
const USUAL_FRICTION_RATE_HZ: u32 = 10_000;
/// Lowest rate of friction levels, in Hz: that of a published variable-friction display, one level every 0.12 ms (D. J.
/// Meyer, M. A. Peshkin and J. E. Colgate, "Modeling and Synthesis of Tactile Texture with Spatial Spectrograms for
/// Display on Variable Friction Surfaces", 2015).
const LEAST_FRICTION_RATE_HZ: u32 = 8334;
/// Default length of the receiver's queue, in seconds.
const WINDOW_SECS: f64 = 0.010;
/// Duration of a fade in the receiver, in seconds.
const FADE_SECS: f64 = 0.003;
/// Largest fraction of the line's capacity to use; the rest allows for clock differences and delays of the host.
const LINE_SHARE: f64 = 0.9;
/// Bits on the line per byte, including start and stop bit.
const BITS_PER_BYTE: f64 = 10.0;
/// Bytes of a status frame on the line.
const STATUS_BYTES: f64 = 26.0;
/// Smallest usable queue of a receiver, in samples.
const LEAST_BUFFER: u16 = 8;

/// Capabilities of a receiver, from its hello reply.
#[expect(clippy::struct_excessive_bools, reason = "each is one capability bit of the protocol")]
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ReceiverInfo {
    /// Name of the receiver; may be empty.
    pub name: String,
    /// Protocol version of the receiver.
    pub version: u8,
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
    /// Capacity of its queue, in samples.
    pub buffer: u16,
    /// Most samples in a frame.
    pub frame_max: u8,
}

impl ReceiverInfo {
    pub(super) fn of(reply: HelloReply<'_>) -> Self {
        Self {
            name: String::from_utf8_lossy(reply.name).into_owned(),
            version: reply.version,
            has_stream: reply.has_stream,
            has_control: reply.has_control,
            has_sensor: reply.has_sensor,
            has_friction: reply.has_friction,
            rate_min_hz: reply.rate_min_hz,
            rate_max_hz: reply.rate_max_hz,
            buffer: reply.buffer,
            frame_max: reply.frame_max,
        }
    }
}

/// Bits per second on a line that carries `rate_hz` in blocks of `block` samples.
fn line_bits_per_sec(rate_hz: f64, block: f64) -> f64 {
    // The additional byte holds the run number.
    BITS_PER_BYTE * rate_hz / block * (2.0 * block + 1.0 + OVERHEAD as f64)
}

/// Window and block size in samples at a rate. `asked` is the requested window, if any.
fn window_and_block(rate_hz: u32, asked: Option<u32>, info: &ReceiverInfo) -> (u16, u16) {
    let usual = (WINDOW_SECS * f64::from(rate_hz)) as u32;
    let window = asked.unwrap_or(usual).clamp(u32::from(LEAST_BUFFER), u32::from(info.buffer)) as u16;
    // A window holds 2.5 blocks: one is playing, one is waiting, and one may be in transit.
    (window, (window * 2 / 5).clamp(1, u16::from(info.frame_max).min(120)))
}

/// Chooses the playback parameters.
///
/// # Errors
/// - [`DeviceErrorKind::Unsupported`] if the receiver or the line does not support the options.
pub(super) fn agree(
    id: &str,
    info: &ReceiverInfo,
    options: OpenOptions,
    serial: SerialOptions,
) -> Result<Plan, DeviceError> {
    let refuse = |message: String| Err(DeviceError::new(DeviceErrorKind::Unsupported, message));
    if info.version != VERSION {
        return refuse(format!(
            "the receiver on `{id}` uses protocol version {}, not {VERSION}; update its firmware or Shagreen",
            info.version
        ));
    }
    let (has_mode, mode_name, advice) = match serial.mode {
        Mode::Stream => (info.has_stream, "play samples", "choose another mode"),
        Mode::Control => (info.has_control, "render textures itself", "choose another mode"),
        Mode::Friction => {
            (info.has_friction, "render friction", "update its firmware, or choose another mode")
        }
    };
    if !has_mode {
        return refuse(format!("the receiver on `{id}` cannot {mode_name}; {advice}"));
    }
    if info.buffer < LEAST_BUFFER || info.frame_max == 0 || info.buffer > 0x7FFF {
        return refuse(format!(
            "the receiver on `{id}` queues {} samples, {} per frame; it must queue {LEAST_BUFFER} to 32767: change its firmware",
            info.buffer, info.frame_max
        ));
    }
    if !options.channels.contains(0) {
        return refuse(format!(
            "the receiver on `{id}` has one channel, which is not among the chosen ones; choose the first channel"
        ));
    }
    let rate_hz = choose_rate(id, info, options, serial)?;
    let (window, block) = window_and_block(rate_hz, options.buffer_frames, info);
    // On a slow line, status frames may use at most half of the return capacity.
    let report = f64::from(block / 2)
        .max(2.0 * BITS_PER_BYTE * STATUS_BYTES * f64::from(rate_hz) / f64::from(serial.baud));
    let rate = f64::from(rate_hz);
    // Levels of friction are no acceleration: they end at 1, and the receiver's own drive has its own limits.
    let (ceiling, full_scale_mps2) = match serial.mode {
        Mode::Friction => (1.0, 0.0),
        Mode::Stream | Mode::Control => (options.drive.ceiling, options.drive.full_scale_mps2()),
    };
    let configure = Configure {
        config: 1,
        mode: serial.mode,
        rate_hz: rate_hz as u16,
        // The limiter's ceiling is converted like a sample, so that both ceilings are equal.
        ceiling: (ceiling.clamp(0.0, 1.0) * 32_768.0).min(32_767.0) as u16,
        watchdog_ms: serial.watchdog_ms.max(10),
        window,
        prefill: (window * 3 / 5).min(window / block * block).max(1),
        report: (report.ceil() as u16).max(1),
        fade: ((FADE_SECS * rate) as u16).max(1),
        full_scale_cmps2: (100.0 * full_scale_mps2).round() as u16,
    };
    let stall = Duration::from_millis(u64::from(configure.watchdog_ms / 2));
    Ok(Plan { configure, block, stall })
}

/// Transmission time of a block on the line, in seconds.
pub(super) fn line_secs(plan: Plan, baud: u32) -> f64 {
    BITS_PER_BYTE * (2.0 * f64::from(plan.block) + 1.0 + OVERHEAD as f64) / f64::from(baud.max(1))
}

fn choose_rate(
    id: &str,
    info: &ReceiverInfo,
    options: OpenOptions,
    serial: SerialOptions,
) -> Result<u32, DeviceError> {
    let refuse = |message: String| Err(DeviceError::new(DeviceErrorKind::Unsupported, message));
    let model_rate_hz = options.model_rate_hz.max(1.0).ceil() as u32;
    let (least, most) = (u32::from(info.rate_min_hz), u32::from(info.rate_max_hz));
    let is_carried = |rate_hz: u32| {
        let (_, block) = window_and_block(rate_hz, options.buffer_frames, info);
        let bits = line_bits_per_sec(f64::from(rate_hz), f64::from(block));
        serial.mode == Mode::Control || bits <= LINE_SHARE * f64::from(serial.baud)
    };
    let (usual_hz, what, needed_hz) = match serial.mode {
        Mode::Friction => {
            (USUAL_FRICTION_RATE_HZ, "friction needs", model_rate_hz.max(LEAST_FRICTION_RATE_HZ))
        }
        Mode::Stream | Mode::Control => (USUAL_SERIAL_RATE_HZ, "the textures need", model_rate_hz),
    };
    let wished = options.preferred_rate_hz.unwrap_or_else(|| {
        // The highest rate that the line carries, in steps of 100 Hz, but at least the needed one.
        let usual = usual_hz.max(needed_hz).clamp(least, most.max(least));
        let steps = (needed_hz.max(least)..=usual).rev();
        steps
            .filter(|rate_hz| rate_hz % 100 == 0 || *rate_hz == usual)
            .find(|&rate_hz| is_carried(rate_hz))
            .unwrap_or(usual)
    });
    if !(least..=most).contains(&wished) {
        return refuse(format!(
            "the receiver on `{id}` plays at {least} to {most} Hz, not {wished} Hz; choose another rate"
        ));
    }
    if wished < needed_hz {
        let advice = match serial.mode {
            Mode::Friction => "choose a higher rate, or change its firmware",
            Mode::Stream | Mode::Control => "choose a higher rate or other textures",
        };
        return refuse(format!(
            "the receiver on `{id}` plays at {wished} Hz, {what} {needed_hz} Hz; {advice}"
        ));
    }
    if !is_carried(wished) {
        let (_, block) = window_and_block(wished, options.buffer_frames, info);
        let needed = line_bits_per_sec(f64::from(wished), f64::from(block)) / LINE_SHARE;
        return refuse(format!(
            "{} baud is too slow for {wished} Hz to `{id}`, which needs {needed:.0} baud; raise it on both sides (--baud)",
            serial.baud
        ));
    }
    Ok(wished)
}

#[cfg(test)]
mod tests {
    use super::{ReceiverInfo, agree, line_bits_per_sec};
    use crate::engine::ChannelMask;
    use crate::error::DeviceErrorKind;
    use crate::output::tests::OPTIONS;
    use crate::output_options::OpenOptions;
    use crate::serial::SerialOptions;
    use crate::serial::message::Mode;

    fn info() -> ReceiverInfo {
        ReceiverInfo {
            name: "test".into(),
            version: 1,
            has_stream: true,
            has_control: false,
            has_sensor: false,
            has_friction: false,
            rate_min_hz: 500,
            rate_max_hz: 8000,
            buffer: 256,
            frame_max: 120,
        }
    }

    fn rate(baud: u32, options: OpenOptions) -> Result<u16, String> {
        let serial = SerialOptions { baud, ..SerialOptions::default() };
        agree("serial:x", &info(), options, serial)
            .map(|plan| plan.configure.rate_hz)
            .map_err(|e| e.to_string())
    }

    #[test]
    fn the_usual_agreement() {
        let plan = agree("serial:x", &info(), OPTIONS, SerialOptions::default()).unwrap();
        let c = plan.configure;
        assert_eq!((c.rate_hz, c.window, plan.block, c.prefill, c.report, c.fade), (4000, 40, 16, 24, 8, 12));
        assert_eq!((c.ceiling, c.watchdog_ms, c.full_scale_cmps2), (29_491, 50, 1000));
        // 250 frames per second with 40 bytes of 10 bits each.
        assert_eq!(line_bits_per_sec(4000.0, 16.0), 100_000.0);
    }

    #[test]
    fn the_rate_is_what_the_line_carries() {
        assert_eq!(rate(1_000_000, OPTIONS), Ok(4000));
        assert_eq!(rate(115_200, OPTIONS), Ok(4000));
        let slower = rate(57_600, OPTIONS).unwrap();
        assert!((1000..2000).contains(&slower), "{slower}");
        let error = rate(9600, OPTIONS).unwrap_err();
        assert!(
            error.contains("9600 baud") && error.contains("111111 baud") && error.contains("--baud"),
            "{error}"
        );
        let error = rate(57_600, OpenOptions { preferred_rate_hz: Some(8000), ..OPTIONS }).unwrap_err();
        assert!(error.contains("8000 Hz"), "{error}");
        // Control messages need little capacity.
        let serial = SerialOptions { baud: 19_200, mode: Mode::Control, ..SerialOptions::default() };
        let able = ReceiverInfo { has_control: true, ..info() };
        assert_eq!(agree("x", &able, OPTIONS, serial).unwrap().configure.rate_hz, 4000);
    }

    #[test]
    fn friction_is_streamed_at_its_rate_or_refused() {
        let serial = SerialOptions { mode: Mode::Friction, ..SerialOptions::default() };
        let display = ReceiverInfo { has_friction: true, rate_max_hz: 16_000, ..info() };
        let c = agree("serial:x", &display, OPTIONS, serial).unwrap().configure;
        assert_eq!((c.mode, c.rate_hz, c.window), (Mode::Friction, 10_000, 100));
        assert_eq!((c.ceiling, c.full_scale_cmps2), (32_767, 0));
        let refusal = |info: &ReceiverInfo, options: OpenOptions, serial: SerialOptions| {
            agree("serial:x", info, options, serial).unwrap_err().to_string()
        };
        // A receiver of earlier firmware does not state the capability.
        let old = refusal(&info(), OPTIONS, serial);
        assert!(old.contains("cannot render friction") && old.contains("update its firmware"), "{old}");
        let slow = refusal(&ReceiverInfo { rate_max_hz: 8000, ..display.clone() }, OPTIONS, serial);
        assert!(slow.contains("8000 Hz, friction needs 8334 Hz"), "{slow}");
        let low = OpenOptions { preferred_rate_hz: Some(4000), ..OPTIONS };
        assert!(refusal(&display, low, serial).contains("friction needs 8334 Hz"));
        let line = refusal(&display, OPTIONS, SerialOptions { baud: 115_200, ..serial });
        assert!(line.contains("115200 baud") && line.contains("10000 Hz"), "{line}");
    }

    #[test]
    fn what_the_receiver_cannot_do_is_said() {
        let agreed = |info: ReceiverInfo, options: OpenOptions| {
            let error = agree("serial:x", &info, options, SerialOptions::default()).unwrap_err();
            assert_eq!(error.kind(), DeviceErrorKind::Unsupported);
            assert!(error.message().contains("serial:x"), "{error}");
            error.to_string()
        };
        assert!(agreed(ReceiverInfo { version: 2, ..info() }, OPTIONS).contains("version 2"));
        assert!(agreed(ReceiverInfo { has_stream: false, ..info() }, OPTIONS).contains("play samples"));
        assert!(agreed(ReceiverInfo { buffer: 0, ..info() }, OPTIONS).contains("queues 0"));
        assert!(agreed(ReceiverInfo { frame_max: 0, ..info() }, OPTIONS).contains("0 per frame"));
        assert!(agreed(ReceiverInfo { rate_max_hz: 800, ..info() }, OPTIONS).contains("1000 Hz"));
        assert!(agreed(ReceiverInfo { rate_min_hz: 9000, ..info() }, OPTIONS).contains("9000 to 8000 Hz"));
        let fast = OpenOptions { preferred_rate_hz: Some(16_000), ..OPTIONS };
        assert!(agreed(info(), fast).contains("500 to 8000 Hz"));
        let slow = OpenOptions { preferred_rate_hz: Some(800), ..OPTIONS };
        assert!(agreed(info(), slow).contains("need 1000 Hz"));
        let other = OpenOptions { channels: ChannelMask::only(1), ..OPTIONS };
        assert!(agreed(info(), other).contains("one channel"));
    }

    #[test]
    fn every_window_can_be_filled_to_its_prefill() {
        for buffer in 8..=400 {
            for asked in [None, Some(16), Some(100), Some(65_536)] {
                for frame_max in [1, 3, 16, 255] {
                    let info = ReceiverInfo { buffer, frame_max, ..info() };
                    let options = OpenOptions { buffer_frames: asked, ..OPTIONS };
                    let Ok(plan) = agree("x", &info, options, SerialOptions::default()) else { continue };
                    let c = plan.configure;
                    assert!(c.window <= buffer && plan.block <= u16::from(frame_max));
                    assert!(c.prefill >= 1 && c.prefill <= c.window / plan.block * plan.block, "{plan:?}");
                }
            }
        }
    }
}
