//! Actuator outputs: listing and opening.
//!
//! An output is opened by its id. If the output is lost, nothing plays, and [`Handle::loss`] gives the reason. No other
//! output ever replaces it, because the drive signal of an actuator must not reach someone's headphones.
//!
//! An output has one owner: a second Shagreen cannot open it unless it takes it over, because the limits of two engines
//! would add up.

use std::borrow::Cow;
use std::sync::Arc;
use std::sync::mpsc::channel;

use crate::audio::Way;
use crate::engine::{ChannelMask, Handle};
use crate::error::{DeviceError, DeviceErrorKind};
use crate::haptic_pen;
use crate::haptic_pen::sender::{HapticMonitor, HapticSender};
use crate::haptic_pen::translator::{Translator, WINDOW_SECS};
use crate::null_output::NullOutput;
use crate::output_claim::Claim;
use crate::output_options::make_engine;
use crate::running::RunningFacts;
use crate::serial::SerialOptions;
use crate::sound_server::SoundServer;

pub use crate::output_options::{
    BUFFER_FRAMES, OpenOptions, OutputInfo, OutputKind, UNCALIBRATED_FULL_SCALE_MPS2, USUAL_BUFFER_FRAMES,
    USUAL_CEILING, USUAL_RATE_HZ,
};
pub use crate::running::Running;

/// Id of the silent output.
pub const NULL_ID: &str = "null";

/// Lists the outputs of this machine, the silent one first. None is opened.
pub fn list_outputs() -> Vec<OutputInfo> {
    let null = OutputInfo {
        id: NULL_ID.into(),
        name: "No output (silent, real clock)".into(),
        kind: OutputKind::Null,
        is_default: false,
    };
    let mut outputs = vec![null];
    #[cfg(target_os = "linux")]
    outputs.extend(crate::pulse::list());
    // If a sound server names its default output, an ALSA route to that server must not be the default too.
    let has_default = outputs.iter().any(|output| output.is_default);
    let audio = crate::audio::list().into_iter();
    outputs.extend(audio.map(|o| OutputInfo { is_default: o.is_default && !has_default, ..o }));
    // A system that cannot list its devices has no haptic pen to play on.
    let pens = haptic_pen::system::list().unwrap_or_default().into_iter();
    outputs.extend(pens.map(|pen| OutputInfo {
        name: format!("{} (haptic pen: approximation)", pen.name),
        id: pen.id,
        kind: OutputKind::HapticPen,
        is_default: false,
    }));
    outputs.push(OutputInfo {
        id: haptic_pen::system::SIMULATED_ID.into(),
        name: "Simulated haptic pen (plays nothing)".into(),
        kind: OutputKind::HapticPen,
        is_default: false,
    });
    outputs
}

/// Audio outputs of [`list_outputs`] that the system does not open, by id, with the reasons. An output of a sound server
/// that responds is none of them. Each other one is queried for its formats, and none plays.
pub fn list_refused_outputs() -> Vec<(String, DeviceError)> {
    crate::audio::list_refused(Way::Out)
}

/// Asks the sound server of this session for its name.
pub fn sound_server() -> SoundServer {
    #[cfg(target_os = "linux")]
    let server = crate::pulse::server();
    #[cfg(not(target_os = "linux"))]
    let server = SoundServer::Unused;
    server
}

/// Opens output `id`, which is silent until its handle sets controls. An id such as `serial:COM3` opens the receiver on
/// that serial port with [`SerialOptions::default`].
///
/// # Errors
/// - [`DeviceErrorKind::NotFound`] if there is no such output.
/// - [`DeviceErrorKind::Busy`] if another program uses the output.
/// - [`DeviceErrorKind::Claimed`] if another Shagreen plays on the output and the options do not take it over.
/// - [`DeviceErrorKind::Denied`] if the system refuses access.
/// - [`DeviceErrorKind::Unsupported`] if the output has no suitable rate, format or channel.
/// - [`DeviceErrorKind::Config`] if the options are contradictory.
/// - [`DeviceErrorKind::Unavailable`] if the system service or the receiver on a serial port does not respond.
/// - [`DeviceErrorKind::Backend`] if the system fails.
pub fn open(id: &str, options: OpenOptions) -> Result<(Handle, Running), DeviceError> {
    if id == NULL_ID {
        return open_null_with_tap(options, |_| {});
    }
    check_buffer(options)?;
    if id.starts_with(crate::serial::ID_PREFIX) {
        // The system opens a serial port once only.
        let connection = crate::serial::open(id, options, SerialOptions::default())?;
        return Ok((connection.handle, connection.running));
    }
    let claim = Claim::new(&claimed_id(id), options.take_over)?;
    let (handle, running) = open_device(id, options)?;
    Ok((handle, running.claimed_by(claim)?))
}

/// Whether two ids lead to the same output, which can be open only once.
pub fn is_same_output(first: &str, second: &str) -> bool {
    first == second || claimed_id(first) == claimed_id(second)
}

/// Id under which an output is claimed. An ALSA device that leads to the sound server has the id of the server's
/// default output.
fn claimed_id(id: &str) -> Cow<'_, str> {
    #[cfg(target_os = "linux")]
    if matches!(id, "alsa:default" | "alsa:pulse" | "alsa:pipewire" | "alsa:sysdefault")
        && let Some(output) = crate::pulse::list().into_iter().find(|output| output.is_default)
    {
        return Cow::Owned(output.id);
    }
    Cow::Borrowed(id)
}

fn open_device(id: &str, options: OpenOptions) -> Result<(Handle, Running), DeviceError> {
    if id.starts_with(haptic_pen::ID_PREFIX) {
        return open_haptic_pen(id, options);
    }
    #[cfg(target_os = "linux")]
    if id.starts_with(crate::pulse::PREFIX) {
        return open_pulse(id, options);
    }
    let (handle, opened) = crate::audio::open(id, options)?;
    let buffer_frames = opened.buffer_frames;
    let facts = RunningFacts {
        id: id.into(),
        rate_hz: opened.rate_hz,
        channels: opened.channels,
        buffer_frames,
        engine_latency_secs: opened.engine_latency_secs,
        device_latency_secs: 2.0 * f64::from(buffer_frames.unwrap_or(0)) / f64::from(opened.rate_hz),
    };
    let running = Running::new(facts, opened.shared, opened.output);
    Ok((handle, running))
}

#[cfg(target_os = "linux")]
fn open_pulse(id: &str, options: OpenOptions) -> Result<(Handle, Running), DeviceError> {
    let (handle, opened) = crate::pulse::open(id, options)?;
    let facts = RunningFacts {
        id: id.into(),
        rate_hz: opened.rate_hz,
        channels: opened.channels,
        buffer_frames: Some(opened.buffer_frames),
        engine_latency_secs: opened.engine_latency_secs,
        device_latency_secs: 2.0 * f64::from(opened.buffer_frames) / f64::from(opened.rate_hz),
    };
    let running = Running::new(facts, opened.shared, opened.output);
    Ok((handle, running))
}

/// Opens a haptic pen. The engine renders as for the silent output; its signal is measured instead of played.
fn open_haptic_pen(id: &str, options: OpenOptions) -> Result<(Handle, Running), DeviceError> {
    if options.drive.inverse.is_some() {
        let message = format!(
            "the output `{id}` plays waveforms of its own, so that no actuator can be equalized on it; select no actuator"
        );
        return Err(DeviceError::new(DeviceErrorKind::Config, message));
    }
    // A pen has no channels: the signal is measured whatever channels were selected.
    let options = OpenOptions { channels: ChannelMask::FIRST_TWO, friction: None, ..options };
    let pen = haptic_pen::system::open(id)?;
    let least_hz = options.model_rate_hz.ceil() as u32;
    let rate_hz = options.preferred_rate_hz.unwrap_or(haptic_pen::RATE_HZ.max(least_hz));
    let frames = options.buffer_frames.unwrap_or(haptic_pen::BUFFER_FRAMES);
    let made = make_engine(options, rate_hz)?;
    let engine_latency_secs = f64::from(made.engine.latency_secs());
    let shared = Arc::clone(&made.reporter.shared);
    let channels = crate::null_output::CHANNELS;
    let waveforms: Vec<_> = pen.waveforms().collect();
    let mut translator = Translator::new(rate_hz, waveforms.iter().copied());
    let (plays_in, plays) = channel();
    let tap = move |block: &[f32]| {
        if let Some(play) = translator.process(block, usize::from(channels)) {
            plays_in.send(play).ok(); // The pen is lost, which is reported.
        }
    };
    let output = NullOutput::start(made.engine, &made.reporter, rate_hz, frames, tap)?;
    let monitor = Arc::new(HapticMonitor::default());
    let sender = HapticSender::start(pen, plays, made.reporter, Arc::clone(&monitor))?;
    let facts = RunningFacts {
        id: id.into(),
        rate_hz,
        channels,
        buffer_frames: Some(frames),
        engine_latency_secs,
        device_latency_secs: f64::from(WINDOW_SECS) + f64::from(frames) / f64::from(rate_hz),
    };
    // The thread that renders ends first; the sender then ends by itself.
    Ok((made.handle, Running::new(facts, shared, (output, sender)).with_haptic(monitor)))
}

/// Opens the silent output. `tap` is called on the output's thread with every block that the output plays, two channels
/// interleaved.
///
/// # Errors
/// - [`DeviceErrorKind::Config`] if the options are contradictory.
/// - [`DeviceErrorKind::Backend`] if the system cannot start a thread.
pub fn open_null_with_tap(
    options: OpenOptions,
    tap: impl FnMut(&[f32]) + Send + 'static,
) -> Result<(Handle, Running), DeviceError> {
    check_buffer(options)?;
    let rate_hz = options.preferred_rate_hz.unwrap_or(USUAL_RATE_HZ);
    let frames = options.buffer_frames.unwrap_or(USUAL_BUFFER_FRAMES);
    let made = make_engine(options, rate_hz)?;
    let engine_latency_secs = f64::from(made.engine.latency_secs());
    let output = NullOutput::start(made.engine, &made.reporter, rate_hz, frames, tap)?;
    let facts = RunningFacts {
        id: NULL_ID.into(),
        rate_hz,
        channels: crate::null_output::CHANNELS,
        buffer_frames: Some(frames),
        engine_latency_secs,
        device_latency_secs: f64::from(frames) / f64::from(rate_hz),
    };
    let running = Running::new(facts, made.reporter.shared, output);
    Ok((made.handle, running))
}

fn check_buffer(options: OpenOptions) -> Result<(), DeviceError> {
    let Some(frames) = options.buffer_frames.filter(|frames| !BUFFER_FRAMES.contains(frames)) else {
        return Ok(());
    };
    let (least, most) = (BUFFER_FRAMES.start(), BUFFER_FRAMES.end());
    let message = format!("the buffer must have {least} to {most} frames, not {frames}; choose another size");
    Err(DeviceError::new(DeviceErrorKind::Config, message))
}

#[cfg(test)]
pub(crate) mod tests {
    use super::{
        BUFFER_FRAMES, DeviceErrorKind, NULL_ID, OpenOptions, OutputKind, list_outputs, list_refused_outputs,
        open,
    };
    use crate::engine::ChannelMask;
    use shagreen_synth::drive::{DriveConfig, Inverse};
    use shagreen_synth::equalizer::Resonance;
    use std::time::{Duration, Instant};

    /// Options for tests that do not depend on them.
    pub(crate) const OPTIONS: OpenOptions = OpenOptions {
        model_rate_hz: 1000.0,
        preferred_rate_hz: None,
        buffer_frames: None,
        seed: 0,
        drive: DriveConfig::proportional(10.0, 0.9),
        channels: ChannelMask::FIRST_TWO,
        friction: None,
        take_over: false,
    };

    #[test]
    fn the_null_output_is_always_there_and_ids_are_unique() {
        let outputs = list_outputs();
        assert_eq!((outputs[0].id.as_str(), outputs[0].is_default), (NULL_ID, false));
        let last = outputs.last().unwrap();
        assert_eq!(last.id, crate::haptic_pen::system::SIMULATED_ID);
        assert!(last.name.starts_with("Simulated") && !last.is_default, "{last:?}");
        let mut ids: Vec<_> = outputs.iter().map(|output| &output.id).collect();
        ids.sort();
        assert!(ids.windows(2).all(|w| w[0] != w[1]), "{ids:?}");
    }

    #[test]
    fn an_output_that_is_refused_cannot_be_opened_either() {
        let listed = list_outputs();
        for (id, error) in list_refused_outputs() {
            assert!(error.message().contains(&format!("`{id}`")), "{error}");
            assert!(listed.iter().any(|output| output.id == id && output.kind == OutputKind::Audio), "{id}");
            assert!(open(&id, OPTIONS).is_err(), "{id}");
        }
    }

    #[test]
    fn outputs_that_do_not_exist_are_named_with_what_to_do() {
        for id in ["", "nonsense", "alsa:no_such_pcm", "nohost:default"] {
            let error = open(id, OPTIONS).unwrap_err();
            assert_eq!(error.kind(), DeviceErrorKind::NotFound, "{error}");
            let text = error.to_string();
            assert!(text.contains(&format!("`{id}`")) && text.contains("shagreen devices"), "{text}");
        }
    }

    #[test]
    fn blocks_that_no_output_could_play_are_refused_by_every_output() {
        for frames in [0, 15, 65_537, u32::MAX] {
            for id in [NULL_ID, "alsa:no_such_pcm"] {
                let error = open(id, OpenOptions { buffer_frames: Some(frames), ..OPTIONS }).unwrap_err();
                assert_eq!(error.kind(), DeviceErrorKind::Config);
                assert!(error.message().contains("16 to 65536 frames"), "{error}");
            }
        }
        for frames in [*BUFFER_FRAMES.start(), *BUFFER_FRAMES.end()] {
            let (_handle, running) =
                open(NULL_ID, OpenOptions { buffer_frames: Some(frames), ..OPTIONS }).unwrap();
            assert_eq!(running.buffer_frames(), Some(frames));
        }
    }

    #[test]
    fn what_was_rendered_has_been_heard_after_a_drain() {
        let slow = OpenOptions { buffer_frames: Some(24_000), ..OPTIONS };
        let (mut handle, running) = open(NULL_ID, slow).unwrap();
        while handle.status().frames_played == 0 {
            std::thread::yield_now();
        }
        // Half a second is queued; the thread may have started a moment ago.
        let begun = Instant::now();
        assert!(!running.drain(Duration::from_millis(100)));
        assert!(begun.elapsed() >= Duration::from_millis(100));
        let heard_by = running.shared().heard_by();
        assert!(heard_by > begun, "the block must still be playing");
        assert!(running.drain(Duration::from_secs(10)));
        assert!(Instant::now() >= heard_by);
        assert!(begun.elapsed() < Duration::from_secs(5), "drain must not wait longer");
    }

    #[test]
    fn a_haptic_pen_is_an_output_that_takes_no_equalizer() {
        let id = crate::haptic_pen::system::SIMULATED_ID;
        let (handle, running) = open(id, OPTIONS).unwrap();
        assert_eq!((running.rate_hz(), running.channels()), (crate::haptic_pen::RATE_HZ, 2));
        assert_eq!(running.haptic_reading().map(|reading| reading.strongest), Some(None));
        drop((handle, running));
        let resonance = Resonance { frequency_hz: 65.0, q: 4.0, gain_mps2_per_volt: 2.0 };
        let inverse = Some(Inverse { resonance, lowest_hz: 20.0 });
        let error = open(id, OpenOptions { drive: DriveConfig { inverse, ..OPTIONS.drive }, ..OPTIONS });
        assert_eq!(error.unwrap_err().kind(), DeviceErrorKind::Config);
        let (_handle, silent) = open(NULL_ID, OPTIONS).unwrap();
        assert_eq!(silent.haptic_reading(), None);
    }

    #[test]
    fn contradicting_options_are_refused() {
        let error =
            open(NULL_ID, OpenOptions { drive: DriveConfig { full_scale: 0.0, ..OPTIONS.drive }, ..OPTIONS })
                .unwrap_err();
        assert_eq!(error.kind(), DeviceErrorKind::Config);
        assert!(error.message().contains("0 m/s²"), "{error}");
        let error = open(NULL_ID, OpenOptions { preferred_rate_hz: Some(0), ..OPTIONS }).unwrap_err();
        assert_eq!(error.kind(), DeviceErrorKind::Config);
    }
}
