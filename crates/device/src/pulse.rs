//! Outputs of a PulseAudio server, or of PipeWire, which implements the same protocol.
//!
//! Other libraries let the server move a stream to another sink when its own is removed; actuator drive would then
//! reach someone's headphones. Here, a stream names its sink and forbids moves, so the server ends it instead. The
//! protocol messages are those of the crate `pulseaudio`, which `cpal` also uses. The client of that crate does not
//! report that a stream was ended, was moved or ran out of samples, so only the messages are used.

mod connection;
mod playback;
pub(crate) mod record;
pub(crate) mod stream;

use std::ffi::CString;
use std::sync::Arc;

use pulseaudio::protocol::{Command, ServerInfo, SinkInfo, SinkInfoList};

use self::connection::{Connection, Failure, unavailable};
use self::playback::{Playback, StreamKind};
use self::stream::PulseStream;
use crate::edge::Edge;
use crate::engine::Handle;
use crate::error::{DeviceError, DeviceErrorKind};
use crate::link::Shared;
use crate::output_options::{Made, OpenOptions, OutputInfo, OutputKind, USUAL_BUFFER_FRAMES, make_engine};
use crate::sound_server::SoundServer;

/// Prefix of the ids of these outputs; the rest is the sink's name.
pub(crate) const PREFIX: &str = "pulse:";

/// Sinks of the server; empty if no server responds.
pub(crate) fn list() -> Vec<OutputInfo> {
    // Without a server there are no such outputs.
    let Ok(mut connection) = Connection::open() else { return Vec::new() };
    let default =
        connection.ask::<ServerInfo>(&Command::GetServerInfo).ok().and_then(|i| i.default_sink_name);
    let sinks = connection.ask::<SinkInfoList>(&Command::GetSinkInfoList).unwrap_or_default();
    let describe = |sink: SinkInfo| {
        let name = sink.name.to_string_lossy().into_owned();
        OutputInfo {
            id: format!("{PREFIX}{name}"),
            name: sink.description.map_or(name, |d| d.to_string_lossy().into_owned()),
            kind: OutputKind::Audio,
            is_default: default.as_ref() == Some(&sink.name),
        }
    };
    sinks.into_iter().map(describe).collect()
}

/// State of the server, with its name and version.
pub(crate) fn server() -> SoundServer {
    let asked = Connection::open().and_then(|mut connection| connection.ask(&Command::GetServerInfo));
    match asked {
        Ok(ServerInfo { server_name, server_version, .. }) => {
            let text = |text: Option<CString>| text.map(|text| text.to_string_lossy().into_owned());
            let words = [text(server_name), text(server_version)];
            SoundServer::Responds(words.into_iter().flatten().collect::<Vec<_>>().join(" "))
        }
        Err(Failure::NoServer) => SoundServer::Missing,
        Err(failure) => SoundServer::Fails(failure.to_string()),
    }
}

/// Result of opening an output.
pub(crate) struct Opened {
    pub(crate) output: PulseStream,
    pub(crate) rate_hz: u32,
    pub(crate) channels: u16,
    pub(crate) buffer_frames: u32,
    pub(crate) engine_latency_secs: f64,
    pub(crate) shared: Arc<Shared>,
}

/// Opens the sink with this id.
pub(crate) fn open(id: &str, options: OpenOptions) -> Result<(Handle, Opened), DeviceError> {
    let name = id.strip_prefix(PREFIX).unwrap_or(id);
    let mut connection = Connection::open().map_err(|failure| unavailable(&failure))?;
    let sinks = connection.ask::<SinkInfoList>(&Command::GetSinkInfoList);
    let sinks = sinks.map_err(|failure| unavailable(&failure))?;
    let Some(sink) = sinks.into_iter().find(|sink| sink.name.to_bytes() == name.as_bytes()) else {
        let message =
            format!("there is no output `{id}` on this machine; `shagreen devices` lists the available ones");
        return Err(DeviceError::new(DeviceErrorKind::NotFound, message));
    };
    let n_channels = usize::from(sink.sample_spec.channels);
    if n_channels < options.channels.n_least() {
        let message =
            format!("the output `{id}` has {n_channels} channels; choose other channels or another output");
        return Err(DeviceError::new(DeviceErrorKind::Unsupported, message));
    }
    // The sink's own rate avoids resampling by the server, if it is at least the texture's rate.
    let own_hz = sink.sample_spec.sample_rate;
    let rate_hz = options.preferred_rate_hz.unwrap_or(own_hz).max(options.model_rate_hz.ceil() as u32);
    let kind = StreamKind {
        sink: sink.index,
        channels: sink.sample_spec.channels,
        channel_map: sink.channel_map,
        rate_hz,
        buffer_frames: options.buffer_frames.unwrap_or(USUAL_BUFFER_FRAMES),
    };
    let Made { handle, engine, reporter } = make_engine(options, rate_hz)?;
    let engine_latency_secs = f64::from(engine.latency_secs());
    let shared = Arc::clone(&reporter.shared);
    let edge = Edge::new(engine, Arc::clone(&shared), f64::from(rate_hz));
    let refused = |error: Failure| {
        let message = format!(
            "the output `{id}` cannot be opened: {error}; choose another one, or check the sound server"
        );
        DeviceError::new(DeviceErrorKind::Backend, message)
    };
    let socket = connection.socket().map_err(refused)?;
    let playback = Playback::start(connection, kind, edge, reporter, id).map_err(refused)?;
    let block_frames = playback.block_frames();
    let output = PulseStream::start(socket, "output", move |closing| playback.run(closing))?;
    let channels = u16::from(sink.sample_spec.channels);
    let opened =
        Opened { output, rate_hz, channels, buffer_frames: block_frames, engine_latency_secs, shared };
    Ok((handle, opened))
}
