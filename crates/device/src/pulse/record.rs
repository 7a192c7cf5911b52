//! Recording of the monitor of a sink: the samples that the server sends to the sink, without the delay of its hardware.

use std::sync::atomic::Ordering;

use pulseaudio::protocol::stream::BufferAttr;
use pulseaudio::protocol::{
    ChannelMap, Command, CorkStreamParams, CreateRecordStreamReply, Prop, Props, RecordStreamParams,
    SinkInfoList, SourceInfo, SourceInfoList,
};

use super::PREFIX;
use super::connection::{Connection, Failure, unavailable};
use super::stream::{PulseStream, sample_spec, stream_flags};
use crate::error::{DeviceError, DeviceErrorKind};

/// Samples that the server sends at a time, as a part of a second.
const BLOCKS_PER_SEC: u32 = 200;

/// A monitor that can be recorded.
pub(crate) struct ListedMonitor {
    /// Id of the monitor.
    pub(crate) id: String,
    /// Id of the output that it records.
    pub(crate) output_id: String,
    /// Display name of that output.
    pub(crate) output_name: String,
}

/// Monitors of the sinks of the server; empty if no server responds.
pub(crate) fn list_monitors() -> Vec<ListedMonitor> {
    // Without a server there are no monitors.
    let Ok(mut connection) = Connection::open() else { return Vec::new() };
    let sinks = connection.ask::<SinkInfoList>(&Command::GetSinkInfoList).unwrap_or_default();
    let sources = connection.ask::<SourceInfoList>(&Command::GetSourceInfoList).unwrap_or_default();
    let listed = |source: &SourceInfo| {
        let sink = sinks.iter().find(|sink| Some(sink.index) == source.monitor_of_sink_index)?;
        let sink_name = sink.name.to_string_lossy();
        let description = sink.description.as_ref().map(|name| name.to_string_lossy().into_owned());
        Some(ListedMonitor {
            id: format!("{PREFIX}{}", source.name.to_string_lossy()),
            output_id: format!("{PREFIX}{sink_name}"),
            output_name: description.unwrap_or_else(|| sink_name.into_owned()),
        })
    };
    sources.iter().filter_map(listed).collect()
}

/// A monitor that is not recorded yet.
pub(crate) struct Monitor {
    connection: Connection,
    id: String,
    source_index: u32,
    channels: u8,
    channel_map: ChannelMap,
    rate_hz: u32,
}

/// Finds the monitor with this id.
pub(crate) fn find_monitor(id: &str) -> Result<Monitor, DeviceError> {
    let name = id.strip_prefix(PREFIX).unwrap_or(id);
    let mut connection = Connection::open().map_err(|failure| unavailable(&failure))?;
    let sources = connection.ask::<SourceInfoList>(&Command::GetSourceInfoList);
    let sources = sources.map_err(|failure| unavailable(&failure))?;
    let is_meant = |source: &SourceInfo| {
        source.name.to_bytes() == name.as_bytes() && source.monitor_of_sink_index.is_some()
    };
    let Some(source) = sources.into_iter().find(is_meant) else {
        let message =
            format!("there is no input `{id}` on this machine; `shagreen devices` lists the available ones");
        return Err(DeviceError::new(DeviceErrorKind::NotFound, message));
    };
    Ok(Monitor {
        connection,
        id: id.to_owned(),
        source_index: source.index,
        channels: source.sample_spec.channels,
        channel_map: source.channel_map,
        rate_hz: source.sample_spec.sample_rate,
    })
}

impl Monitor {
    /// Number of channels.
    pub(crate) fn channels(&self) -> u8 {
        self.channels
    }

    /// Sample rate, in Hz.
    pub(crate) fn rate_hz(&self) -> u32 {
        self.rate_hz
    }

    /// Records until the input is dropped. A thread calls `take` with blocks of interleaved samples, and `lose` if the
    /// recording ends before.
    pub(crate) fn start(
        self,
        take: impl FnMut(&[f32]) + Send + 'static,
        lose: impl FnOnce() + Send + 'static,
    ) -> Result<PulseStream, DeviceError> {
        let Self { mut connection, id, .. } = self;
        let refused = |failure: Failure| {
            let message = format!(
                "the input `{id}` cannot be opened: {failure}; choose another one, or check the sound server"
            );
            DeviceError::new(DeviceErrorKind::Backend, message)
        };
        let mut props = Props::new();
        props.set(Prop::MediaName, c"Measurement");
        let params = RecordStreamParams {
            sample_spec: sample_spec(self.channels, self.rate_hz),
            channel_map: self.channel_map,
            source_index: Some(self.source_index),
            buffer_attr: BufferAttr {
                fragment_size: (self.rate_hz / BLOCKS_PER_SEC).max(1) * 4 * u32::from(self.channels),
                ..BufferAttr::default()
            },
            flags: stream_flags(),
            props,
            ..RecordStreamParams::default()
        };
        let reply: CreateRecordStreamReply =
            connection.ask(&Command::CreateRecordStream(params)).map_err(refused)?;
        connection.wait_for_ever().map_err(refused)?;
        let socket = connection.socket().map_err(refused)?;
        let uncork = CorkStreamParams { channel: reply.channel, cork: false };
        connection.say(&Command::CorkRecordStream(uncork)).map_err(refused)?;
        let recording = Recording { connection, channel: reply.channel };
        PulseStream::start(socket, "input", move |closing| {
            recording.run(take);
            if !closing.load(Ordering::Relaxed) {
                lose();
            }
        })
    }
}

/// A stream of samples from the server.
struct Recording {
    connection: Connection,
    channel: u32,
}

impl Recording {
    /// Passes blocks on until the stream or the connection ends.
    fn run(mut self, mut take: impl FnMut(&[f32])) {
        let mut block = Vec::new();
        while let Ok(packet) = self.connection.next_packet() {
            if packet.channel == Some(self.channel) {
                let samples = packet.bytes.chunks_exact(4);
                block.clear();
                block.extend(samples.map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])));
                take(&block);
            } else if packet.channel.is_none()
                && let Some(message) = self.connection.message(packet.bytes)
                && matches!(
                    message.command,
                    Command::Error(_) | Command::RecordStreamKilled(_) | Command::RecordStreamMoved(_)
                )
            {
                return;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Connection, Recording};
    use std::io::Write as _;
    use std::net::Shutdown;
    use std::os::unix::net::UnixStream;

    use pulseaudio::protocol::{
        Command, DESCRIPTOR_SIZE, Descriptor, DescriptorFlags, MAX_VERSION, PulseError, encode_descriptor,
        write_command_message,
    };

    fn send_samples(server: &mut UnixStream, channel: u32, samples: &[f32]) {
        let length = 4 * samples.len() as u32;
        let mut head = [0; DESCRIPTOR_SIZE];
        let descriptor = Descriptor { length, channel, offset: 0, flags: DescriptorFlags::empty() };
        encode_descriptor(&mut head, &descriptor);
        server.write_all(&head).unwrap();
        for sample in samples {
            server.write_all(&sample.to_le_bytes()).unwrap();
        }
    }

    /// Blocks that are recorded on channel 3 while the server sends something else between them.
    fn recorded(between: impl Fn(&mut UnixStream)) -> Vec<Vec<f32>> {
        let (ours, mut server) = UnixStream::pair().unwrap();
        send_samples(&mut server, 3, &[0.5, -0.25]);
        between(&mut server);
        send_samples(&mut server, 3, &[1.0]);
        server.shutdown(Shutdown::Write).unwrap();
        let mut blocks = Vec::new();
        Recording { connection: Connection::of(ours), channel: 3 }.run(|block| blocks.push(block.to_vec()));
        blocks
    }

    #[test]
    fn samples_of_its_channel_are_passed_on_until_the_stream_ends() {
        let all = vec![vec![0.5, -0.25], vec![1.0]];
        assert_eq!(recorded(|server| send_samples(server, 4, &[9.0])), all);
        let say = |command: Command| {
            recorded(|server| write_command_message(server, u32::MAX, &command, MAX_VERSION).unwrap())
        };
        assert_eq!(say(Command::Started(3)), all);
        assert_eq!(say(Command::RecordStreamKilled(3)), all[..1]);
        assert_eq!(say(Command::Error(PulseError::BadState)), all[..1]);
    }
}
