//! Playback stream to one sink: samples at the server's requests, permanent silence after the stream's end.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant, SystemTime};

use pulseaudio::protocol::stream::{BufferAttr, StreamFlags};
use pulseaudio::protocol::{
    ChannelMap, ChannelVolume, Command, CorkStreamParams, CreatePlaybackStreamReply, LatencyParams,
    MAX_MEMBLOCKQ_LENGTH, PlaybackLatency, PlaybackStreamParams, Prop, Props, ProtocolError,
};

use super::connection::{Connection, Failure, Message};
use super::stream::{sample_spec, stream_flags};
use crate::edge::Edge;
use crate::error::{DeviceError, DeviceErrorKind};
use crate::link::Reporter;

/// Parameters of a stream.
#[derive(Clone, Copy)]
pub(super) struct StreamKind {
    /// Index of the sink.
    pub(super) sink: u32,
    /// Number of channels of the sink, so that each stream channel maps to one sink channel.
    pub(super) channels: u8,
    /// Channel map of the sink.
    pub(super) channel_map: ChannelMap,
    pub(super) rate_hz: u32,
    /// Requested buffer in frames. The server requests half of it at a time. Its total latency, shared by server, sink
    /// and connection, is three buffers.
    pub(super) buffer_frames: u32,
}

/// Buffers that the server may hold in total. With two its sink has no time of its own and underruns; with four the
/// latency rises by 5 ms.
const BUFFERS_AHEAD: f64 = 3.0;
/// Buffers that the server requests at a time.
const BUFFERS_AT_ONCE: f64 = 0.5;
/// Interval between two latency requests.
const LATENCY_EVERY: Duration = Duration::from_millis(50);

/// An open stream with the engine that fills it.
pub(super) struct Playback {
    connection: Connection,
    edge: Edge,
    reporter: Reporter,
    id: String,
    channel: u32,
    n_channels: usize,
    rate_hz: u32,
    block_frames: u32,
    block: Vec<f32>,
    requested_bytes: usize,
    latency: Duration,
    latency_asked: Option<(u32, Instant)>,
    has_started: bool,
}

impl Playback {
    /// Creates the stream. It stays silent until [`Playback::run`].
    pub(super) fn start(
        mut connection: Connection,
        kind: StreamKind,
        edge: Edge,
        reporter: Reporter,
        id: &str,
    ) -> Result<Self, Failure> {
        let n_channels = usize::from(kind.channels);
        let buffer_bytes = |n_buffers: f64| {
            (n_buffers * f64::from(kind.buffer_frames)).round() as u32 * 4 * u32::from(kind.channels)
        };
        let mut props = Props::new();
        props.set(Prop::MediaName, c"Actuator drive");
        let params = PlaybackStreamParams {
            sample_spec: sample_spec(kind.channels, kind.rate_hz),
            channel_map: kind.channel_map,
            sink_index: Some(kind.sink),
            buffer_attr: BufferAttr {
                target_length: buffer_bytes(BUFFERS_AHEAD),
                // The stream clock never stops: late samples are dropped instead of delaying the stream.
                pre_buffering: 0,
                minimum_request_length: buffer_bytes(BUFFERS_AT_ONCE),
                ..BufferAttr::default()
            },
            cvolume: Some(ChannelVolume::norm(kind.channels)),
            props,
            flags: StreamFlags { fail_on_suspend: true, ..stream_flags() },
            ..PlaybackStreamParams::default()
        };
        let reply: CreatePlaybackStreamReply = connection.ask(&Command::CreatePlaybackStream(params))?;
        connection.wait_for_ever()?;
        let frame_bytes = 4 * u32::from(kind.channels);
        Ok(Self {
            connection,
            edge,
            reporter,
            id: id.to_owned(),
            channel: reply.channel,
            n_channels,
            rate_hz: kind.rate_hz,
            block_frames: reply.buffer_attr.minimum_request_length / frame_bytes,
            block: Vec::new(),
            requested_bytes: reply.requested_bytes as usize,
            latency: Duration::from_micros(reply.stream_latency),
            latency_asked: None,
            has_started: false,
        })
    }

    /// Frames that the server requests at a time.
    pub(super) fn block_frames(&self) -> u32 {
        self.block_frames
    }

    /// Plays until the stream or the connection ends. The output is then lost, unless it is being closed.
    pub(super) fn run(mut self, is_closing: &AtomicBool) {
        let ended = self.play();
        if let Err(reason) = ended
            && !is_closing.load(Ordering::Relaxed)
        {
            let message = format!(
                "the output `{}` is lost: {reason}; it stays silent until you open it again, or open another that \
                 `shagreen devices` lists",
                self.id
            );
            self.reporter.lose(DeviceError::new(DeviceErrorKind::Lost, message));
        }
    }

    fn play(&mut self) -> Result<(), String> {
        self.fill().map_err(|failure| hung_up(&failure, None))?;
        let uncork = CorkStreamParams { channel: self.channel, cork: false };
        let uncork = self.connection.say(&Command::CorkPlaybackStream(uncork));
        let uncork = uncork.map_err(|failure| hung_up(&failure, None))?;
        let mut refusal = None;
        loop {
            let message = self.connection.next().map_err(|failure| hung_up(&failure, refusal.as_ref()))?;
            match message.command {
                Command::Error(error) => {
                    let error = ProtocolError::ServerError(error);
                    if message.seq == uncork {
                        return Err(format!("the sound server refuses to start it ({error})"));
                    }
                    // The stream may continue; if it ends, this error is the reason.
                    refusal = Some(error);
                }
                Command::Request(request) if request.channel == self.channel => {
                    // The request is clamped to the largest buffer of a server.
                    let requested = self.requested_bytes.saturating_add(request.length as usize);
                    self.requested_bytes = requested.min(MAX_MEMBLOCKQ_LENGTH);
                    self.fill().map_err(|failure| hung_up(&failure, refusal.as_ref()))?;
                }
                Command::Started(_) => self.has_started = true,
                Command::Underflow(_) if self.has_started => self.reporter.shared.note_underrun(),
                Command::PlaybackStreamKilled(_) => return Err("its sink was removed".to_owned()),
                Command::PlaybackStreamMoved(params) => {
                    let sink = params.device_name.to_string_lossy().into_owned();
                    return Err(format!("the sound server has moved it to another sink, `{sink}`"));
                }
                Command::PlaybackStreamSuspended(params) if params.suspended => {
                    return Err("its sink is suspended".to_owned());
                }
                Command::Reply => self.note_latency(message),
                _ => {}
            }
        }
    }

    /// Sends the requested samples.
    fn fill(&mut self) -> Result<(), Failure> {
        let frame_bytes = 4 * self.n_channels;
        let frames = self.requested_bytes / frame_bytes;
        if frames == 0 {
            return Ok(());
        }
        // Requested before the samples are sent, the latency applies to them.
        self.ask_latency()?;
        self.requested_bytes -= frames * frame_bytes;
        self.block.resize(frames * self.n_channels, 0.0);
        self.edge.fill(&mut self.block, self.n_channels, self.latency);
        self.connection.send_samples(self.channel, &self.block)
    }

    fn ask_latency(&mut self) -> Result<(), Failure> {
        let now = Instant::now();
        if self.latency_asked.is_none_or(|(_, asked)| now.duration_since(asked) >= LATENCY_EVERY) {
            let params = LatencyParams { channel: self.channel, now: SystemTime::now() };
            self.latency_asked = Some((self.connection.say(&Command::GetPlaybackLatency(params))?, now));
        }
        Ok(())
    }

    fn note_latency(&mut self, message: Message) {
        if self.latency_asked.is_none_or(|(seq, _)| seq != message.seq) {
            return;
        }
        // If the reply cannot be decoded, the previous latency stays.
        let Ok(reply) = message.reply::<PlaybackLatency>(self.connection.version()) else { return };
        let waiting_bytes = reply.write_offset.saturating_sub(reply.read_offset).max(0) as f64;
        let waiting_secs = waiting_bytes / (4.0 * self.n_channels as f64 * f64::from(self.rate_hz));
        self.latency =
            Duration::from_micros(reply.sink_usec) + Duration::from_secs_f64(waiting_secs.min(60.0));
    }
}

/// Message about a closed connection, with an earlier error of the server if there was one.
fn hung_up(failure: &Failure, refusal: Option<&ProtocolError>) -> String {
    let refusal = refusal.map(|refusal| format!("; earlier error: {refusal}")).unwrap_or_default();
    format!("the sound server has closed the connection ({failure}{refusal})")
}

#[cfg(test)]
mod tests;
