//! Actuator outputs through the operating system's audio interfaces.

mod choose;

use std::sync::Arc;
use std::time::{Duration, Instant};

use cpal::traits::{DeviceTrait as _, HostTrait as _, StreamTrait as _};
use cpal::{
    BufferSize, ErrorKind, FromSample, SampleFormat, SizedSample, StreamConfig, SupportedStreamConfigRange,
};

use self::choose::choose;
use crate::edge::Edge;
use crate::engine::Handle;
use crate::error::{DeviceError, DeviceErrorKind};
use crate::link::{Reporter, Shared};
use crate::output_options::{Made, OpenOptions, OutputInfo, OutputKind, make_engine};

/// The only id that is opened without a device search, because a search opens every sound card.
const ALSA_DEFAULT: &str = "alsa:default";

/// Direction of an audio stream.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Way {
    Out,
    In,
}

impl Way {
    /// Word for a device of this direction in messages.
    fn name(self) -> &'static str {
        match self {
            Self::Out => "output",
            Self::In => "input",
        }
    }

    fn default_of(self, host: &cpal::Host) -> Option<cpal::Device> {
        match self {
            Self::Out => host.default_output_device(),
            Self::In => host.default_input_device(),
        }
    }

    fn is_supported_by(self, device: &cpal::Device) -> bool {
        match self {
            Self::Out => device.supports_output(),
            Self::In => device.supports_input(),
        }
    }
}

/// A device that can be opened by its id.
pub(crate) struct Listed {
    pub(crate) id: String,
    pub(crate) name: String,
    pub(crate) is_default: bool,
}

/// An open audio stream; it closes when it is dropped.
pub(crate) struct AudioOutput {
    _stream: cpal::Stream,
}

impl std::fmt::Debug for AudioOutput {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("AudioOutput").finish_non_exhaustive()
    }
}

/// Result of opening an output.
pub(crate) struct Opened {
    pub(crate) output: AudioOutput,
    pub(crate) rate_hz: u32,
    pub(crate) channels: u16,
    pub(crate) buffer_frames: Option<u32>,
    pub(crate) engine_latency_secs: f64,
    pub(crate) shared: Arc<Shared>,
}

/// Ids of ALSA plugins that convert the signal for another output or discard it. They are not listed but can be opened
/// by id.
const ALSA_CONVERTERS: [&str; 8] = [
    "alsa:null",
    "alsa:lavrate",
    "alsa:samplerate",
    "alsa:speexrate",
    "alsa:speex",
    "alsa:upmix",
    "alsa:vdownmix",
    "alsa:oss",
];

/// Whether an id names a card by its number (`alsa:hw:CARD=0,DEV=0`, `alsa:plughw:1,0`). After replugging, that number
/// may belong to another card. Card names never begin with a digit.
fn is_by_number(id: &str) -> bool {
    let Some((_, arguments)) = id.strip_prefix("alsa:").and_then(|pcm| pcm.split_once(':')) else {
        return false;
    };
    let card = arguments.split(',').find_map(|a| a.strip_prefix("CARD=")).unwrap_or(arguments);
    card.starts_with(|c: char| c.is_ascii_digit())
}

/// Outputs of all available audio interfaces. None is opened.
pub(crate) fn list() -> Vec<OutputInfo> {
    let output =
        |Listed { id, name, is_default }| OutputInfo { id, name, kind: OutputKind::Audio, is_default };
    devices(Way::Out).into_iter().map(output).collect()
}

/// Devices of all available audio interfaces for one direction. None is opened.
pub(crate) fn devices(way: Way) -> Vec<Listed> {
    all_devices(way).map(|(listed, _)| listed).collect()
}

/// Devices of all available audio interfaces for one direction that the system does not open, with the reasons. Each is
/// queried for its formats, and none plays or records.
pub(crate) fn list_refused(way: Way) -> Vec<(String, DeviceError)> {
    let refused = |(Listed { id, .. }, device): (Listed, cpal::Device)| {
        let error = refusal(way, &id, &device)?;
        Some((id, error))
    };
    all_devices(way).filter_map(refused).collect()
}

fn all_devices(way: Way) -> impl Iterator<Item = (Listed, cpal::Device)> {
    #[cfg(target_os = "linux")]
    crate::alsa_messages::silence();
    let hosts = cpal::available_hosts().into_iter().filter_map(|id| cpal::host_from_id(id).ok()); // Disconnected.
    hosts.flat_map(move |host| devices_of(&host, way))
}

fn devices_of(host: &cpal::Host, way: Way) -> Vec<(Listed, cpal::Device)> {
    let default = way.default_of(host);
    let default_id = default.as_ref().and_then(|device| device.id().ok()); // Disconnected.
    // Not every audio interface lists its default among its devices.
    let found = host.devices().into_iter().flatten().filter(|device| way.is_supported_by(device));
    let mut listed: Vec<(Listed, cpal::Device)> = Vec::new();
    for device in default.into_iter().chain(found) {
        let Ok(id) = device.id() else { continue };
        let is_default = Some(&id) == default_id.as_ref();
        let id = id.to_string();
        let is_device = !ALSA_CONVERTERS.contains(&id.as_str()) && !is_by_number(&id);
        if is_device && listed.iter().all(|(other, _)| other.id != id) {
            listed.push((Listed { id, name: device.to_string(), is_default }, device));
        }
    }
    listed
}

pub(crate) fn open(id: &str, options: OpenOptions) -> Result<(Handle, Opened), DeviceError> {
    let device = find(Way::Out, id)?;
    let configs = configs_of(Way::Out, id, &device)?;
    let Some((range, rate_hz)) = choose(&configs, options) else {
        let message = format!(
            "none of the {} stream formats of the output `{id}` has a suitable channel, rate and sample format; \
             choose other channels, or another output: `shagreen devices` lists the outputs",
            configs.len()
        );
        return Err(DeviceError::new(DeviceErrorKind::Unsupported, message));
    };
    let asked = options.buffer_frames.map_or(BufferSize::Default, BufferSize::Fixed);
    let config = StreamConfig { channels: range.channels(), sample_rate: rate_hz, buffer_size: asked };
    let (handle, stream, engine_latency_secs, shared) =
        match build(id, &device, config, range.sample_format(), options) {
            // The requested number of frames is optional.
            Err(error) if error.kind() == DeviceErrorKind::Unsupported && asked != BufferSize::Default => {
                let config = StreamConfig { buffer_size: BufferSize::Default, ..config };
                build(id, &device, config, range.sample_format(), options)?
            }
            built => built?,
        };
    stream.play().map_err(|error| explain(Way::Out, id, "started", &error))?;
    let opened = Opened {
        rate_hz,
        channels: range.channels(),
        buffer_frames: stream.buffer_size().ok(), // Not every system reports it.
        output: AudioOutput { _stream: stream },
        engine_latency_secs,
        shared,
    };
    Ok((handle, opened))
}

/// Returns the device with exactly this id.
pub(crate) fn find(way: Way, id: &str) -> Result<cpal::Device, DeviceError> {
    #[cfg(target_os = "linux")]
    crate::alsa_messages::silence();
    let what = way.name();
    let not_found = || {
        let message =
            format!("there is no {what} `{id}` on this machine; `shagreen devices` lists the available ones");
        DeviceError::new(DeviceErrorKind::NotFound, message)
    };
    if is_by_number(id) {
        let message = format!(
            "the {what} `{id}` names a card by its number, which may belong to another card later; `shagreen devices` \
             lists the card by its name"
        );
        return Err(DeviceError::new(DeviceErrorKind::NotFound, message));
    }
    let device_id: cpal::DeviceId = id.parse().map_err(|_| not_found())?;
    let host = cpal::host_from_id(device_id.host()).map_err(|error| explain(way, id, "found", &error))?;
    if id == ALSA_DEFAULT {
        // To ALSA this is an ordinary name. On other systems the default device follows changes, so a device must be
        // opened by its own id there.
        return way.default_of(&host).ok_or_else(not_found);
    }
    host.device_by_id(&device_id).ok_or_else(not_found)
}

/// Stream formats of a device for one direction.
pub(crate) fn configs_of(
    way: Way,
    id: &str,
    device: &cpal::Device,
) -> Result<Vec<SupportedStreamConfigRange>, DeviceError> {
    let configs: Result<Vec<SupportedStreamConfigRange>, cpal::Error> = match way {
        Way::Out => device.supported_output_configs().map(Iterator::collect),
        Way::In => device.supported_input_configs().map(Iterator::collect),
    };
    configs.map_err(|error| explain(way, id, "queried for its formats", &error))
}

/// Why a device cannot be opened; `None` if the system states its formats.
fn refusal(way: Way, id: &str, device: &cpal::Device) -> Option<DeviceError> {
    match configs_of(way, id, device) {
        Ok(configs) if configs.is_empty() => {
            let what = way.name();
            let message = format!("the {what} `{id}` has no stream format; choose another {what}");
            Some(DeviceError::new(DeviceErrorKind::Unsupported, message))
        }
        Ok(_) => None,
        Err(error) => Some(error),
    }
}

type Built = (Handle, cpal::Stream, f64, Arc<Shared>);

fn build(
    id: &str,
    device: &cpal::Device,
    config: StreamConfig,
    format: SampleFormat,
    options: OpenOptions,
) -> Result<Built, DeviceError> {
    match format {
        SampleFormat::F64 => build_as::<f64>(id, device, config, options),
        SampleFormat::I32 => build_as::<i32>(id, device, config, options),
        SampleFormat::I24 => build_as::<cpal::I24>(id, device, config, options),
        SampleFormat::I16 => build_as::<i16>(id, device, config, options),
        SampleFormat::U16 => build_as::<u16>(id, device, config, options),
        SampleFormat::U8 => build_as::<u8>(id, device, config, options),
        _ => build_as::<f32>(id, device, config, options),
    }
}

fn build_as<T: SizedSample + FromSample<f32>>(
    id: &str,
    device: &cpal::Device,
    config: StreamConfig,
    options: OpenOptions,
) -> Result<Built, DeviceError> {
    let Made { handle, engine, mut reporter } = make_engine(options, config.sample_rate)?;
    let engine_latency_secs = f64::from(engine.latency_secs());
    let shared = Arc::clone(&reporter.shared);
    let mut edge = Edge::new(engine, Arc::clone(&shared), f64::from(config.sample_rate));
    let channels = usize::from(config.channels);
    let id_of_errors = id.to_owned();
    let stream = device
        .build_output_stream::<T, _, _>(
            config,
            move |out, info| {
                let times = info.timestamp();
                edge.fill(out, channels, times.playback.duration_since(times.callback));
            },
            move |error| note_error(&id_of_errors, &mut reporter, &error),
            Some(Duration::from_secs(1)),
        )
        .map_err(|error| explain(Way::Out, id, "opened", &error))?;
    Ok((handle, stream, engine_latency_secs, shared))
}

/// Handles an error that the system reports for an open stream. This may run on the callback's thread, but not inside
/// the callback; only an error that ends the stream allocates here.
fn note_error(id: &str, reporter: &mut Reporter, error: &cpal::Error) {
    let lost = || {
        let message = format!(
            "the output `{id}` is lost: {}; it stays silent until you open it again; `shagreen devices` lists \
             other outputs",
            reason(error)
        );
        DeviceError::new(DeviceErrorKind::Lost, message)
    };
    match error.kind() {
        ErrorKind::Xrun => reporter.note_underrun(Instant::now(), lost),
        // A stream that the system has rerouted may play to someone's headphones.
        ErrorKind::DeviceNotAvailable
        | ErrorKind::DeviceChanged
        | ErrorKind::HostUnavailable
        | ErrorKind::PermissionDenied
        | ErrorKind::StreamInvalidated => reporter.lose(lost()),
        // The stream plays without real-time priority.
        ErrorKind::RealtimeDenied => {}
        _ => reporter.note_error(Instant::now(), lost),
    }
    if reporter.shared.is_lost() {
        // Some systems repeat this report without pause. The stream has ended, so a delay here is harmless.
        std::thread::sleep(Duration::from_millis(10));
    }
}

/// Converts a system error before playback into an error that says what to do.
pub(crate) fn explain(way: Way, id: &str, done: &str, error: &cpal::Error) -> DeviceError {
    let (kind, advice) = match error.kind() {
        ErrorKind::DeviceBusy => (DeviceErrorKind::Busy, "close the program that uses it and try again"),
        ErrorKind::DeviceNotAvailable => {
            (DeviceErrorKind::NotFound, "plug it in, or choose another one that `shagreen devices` lists")
        }
        ErrorKind::PermissionDenied => {
            (DeviceErrorKind::Denied, "allow access to it in the system's settings")
        }
        ErrorKind::HostUnavailable => {
            (DeviceErrorKind::Unavailable, "start the system's audio service and try again")
        }
        ErrorKind::InvalidInput | ErrorKind::UnsupportedConfig | ErrorKind::UnsupportedOperation => {
            (DeviceErrorKind::Unsupported, "choose another rate, buffer size or device")
        }
        _ => (DeviceErrorKind::Backend, "try again, or choose another one that `shagreen devices` lists"),
    };
    DeviceError::new(kind, format!("the {} `{id}` cannot be {done}: {}; {advice}", way.name(), reason(error)))
}

/// The system's error text without its final period, for use within a sentence.
fn reason(error: &cpal::Error) -> String {
    error.to_string().trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests;
