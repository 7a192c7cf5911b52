//! Connection to the sound server, with requests and replies.

use std::ffi::CString;
use std::io::{Cursor, Read as _, Write as _};
use std::os::unix::net::UnixStream;
use std::path::PathBuf;
use std::time::{Duration, Instant};

use pulseaudio::protocol::{
    AuthParams, AuthReply, Command, CommandReply, DESCRIPTOR_SIZE, Descriptor, DescriptorFlags, MAX_VERSION,
    Prop, Props, ProtocolError, SetClientNameReply, TagStructRead, TagStructReader, encode_descriptor,
    read_descriptor, write_command_message,
};

use crate::error::{DeviceError, DeviceErrorKind};

/// Reasons for a missing or failed reply.
#[derive(Debug, thiserror::Error)]
pub(super) enum Failure {
    /// No server is configured, or none listens there.
    #[error("no sound server is running here")]
    NoServer,
    /// The connection failed or timed out.
    #[error("{0}")]
    Io(#[from] std::io::Error),
    /// The server sent an error or an invalid message.
    #[error("{0}")]
    Protocol(#[from] ProtocolError),
}

/// Returns the error for a server that does not respond.
pub(super) fn unavailable(failure: &Failure) -> DeviceError {
    let message = format!("the sound server does not respond: {failure}; start it and try again");
    DeviceError::new(DeviceErrorKind::Unavailable, message)
}

/// Time limit for a reply.
const PATIENCE: Duration = Duration::from_secs(5);
/// Longest valid message, in bytes; lists of sinks are some kilobytes.
const MAX_MESSAGE: u32 = 16 * 1024 * 1024;

/// A message from the server: its sequence number, its command, and the payload of a reply.
pub(super) struct Message {
    pub(super) seq: u32,
    pub(super) command: Command,
    payload: Cursor<Vec<u8>>,
}

impl Message {
    /// Decodes the payload of a reply.
    pub(super) fn reply<T: TagStructRead>(mut self, version: u16) -> Result<T, Failure> {
        let mut reader = TagStructReader::new(&mut self.payload, version);
        Ok(T::read(&mut reader, version)?)
    }
}

/// A packet from the server.
pub(super) struct Packet {
    /// Channel of the stream whose samples it contains; `None` for a message.
    pub(super) channel: Option<u32>,
    pub(super) bytes: Vec<u8>,
}

/// Channel number of messages.
const MESSAGES: u32 = u32::MAX;

/// A connection to the server of this session.
pub(super) struct Connection {
    socket: UnixStream,
    version: u16,
    next_seq: u32,
    out: Vec<u8>,
}

impl Connection {
    /// Connects to the server that the environment names.
    pub(super) fn open() -> Result<Self, Failure> {
        let path = socket_path().ok_or(Failure::NoServer)?;
        let socket = UnixStream::connect(path).map_err(|_| Failure::NoServer)?;
        socket.set_read_timeout(Some(PATIENCE))?;
        socket.set_write_timeout(Some(PATIENCE))?;
        let mut connection = Self { socket, version: MAX_VERSION, next_seq: 0, out: Vec::new() };
        // Without a cookie, a server that trusts this user still replies.
        let cookie = cookie_paths().into_iter().find_map(|path| std::fs::read(path).ok()).unwrap_or_default();
        let auth = AuthParams { version: MAX_VERSION, supports_shm: false, supports_memfd: false, cookie };
        let reply: AuthReply = connection.ask(&Command::Auth(auth))?;
        connection.version = MAX_VERSION.min(reply.version);
        let mut props = Props::new();
        props.set(Prop::ApplicationName, c"Shagreen");
        if let Ok(id) = CString::new(std::process::id().to_string()) {
            props.set(Prop::ApplicationProcessId, id);
        }
        let _: SetClientNameReply = connection.ask(&Command::SetClientName(props))?;
        Ok(connection)
    }

    /// A connection after its handshake.
    #[cfg(test)]
    pub(super) fn of(socket: UnixStream) -> Self {
        Self { socket, version: MAX_VERSION, next_seq: 0, out: Vec::new() }
    }

    /// Returns a second handle to the socket, to close the connection with.
    pub(super) fn socket(&self) -> Result<UnixStream, Failure> {
        Ok(self.socket.try_clone()?)
    }

    /// Removes the time limit for messages from the server.
    pub(super) fn wait_for_ever(&self) -> Result<(), Failure> {
        Ok(self.socket.set_read_timeout(None)?)
    }

    /// Negotiated protocol version.
    pub(super) fn version(&self) -> u16 {
        self.version
    }

    /// Sends a command. Returns its sequence number.
    pub(super) fn say(&mut self, command: &Command) -> Result<u32, Failure> {
        let seq = self.next_seq;
        self.next_seq = self.next_seq.wrapping_add(1);
        write_command_message(&mut self.socket, seq, command, self.version)?;
        Ok(seq)
    }

    /// Sends a command and waits for its reply. Other messages in between are discarded.
    pub(super) fn ask<T: CommandReply>(&mut self, command: &Command) -> Result<T, Failure> {
        let seq = self.say(command)?;
        let until = Instant::now() + PATIENCE;
        loop {
            let message = self.next_until(Some(until))?;
            match message.command {
                Command::Reply if message.seq == seq => return message.reply(self.version),
                Command::Error(error) if message.seq == seq => {
                    return Err(ProtocolError::ServerError(error).into());
                }
                _ => {}
            }
        }
    }

    /// Returns the next message that can be decoded.
    pub(super) fn next(&mut self) -> Result<Message, Failure> {
        self.next_until(None)
    }

    /// Same as [`Connection::next`], with a time limit for all of it.
    fn next_until(&mut self, until: Option<Instant>) -> Result<Message, Failure> {
        loop {
            let packet = self.packet_until(until)?;
            if packet.channel.is_none()
                && let Some(message) = self.message(packet.bytes)
            {
                return Ok(message);
            }
        }
    }

    /// Returns the next packet, whether message or samples.
    pub(super) fn next_packet(&mut self) -> Result<Packet, Failure> {
        self.packet_until(None)
    }

    fn packet_until(&mut self, until: Option<Instant>) -> Result<Packet, Failure> {
        let mut from = Patient { socket: &mut self.socket, until };
        let descriptor = read_descriptor(&mut from)?;
        if descriptor.length > MAX_MESSAGE {
            return Err(ProtocolError::Invalid("a message exceeds the length limit".into()).into());
        }
        let mut bytes = vec![0; descriptor.length as usize];
        from.read_exact(&mut bytes)?;
        let channel = (descriptor.channel != MESSAGES).then_some(descriptor.channel);
        Ok(Packet { channel, bytes })
    }

    /// Decodes a message; `None` for a command that this protocol version does not know.
    pub(super) fn message(&self, bytes: Vec<u8>) -> Option<Message> {
        let mut payload = Cursor::new(bytes);
        // Unknown commands are skipped.
        let (seq, command) = Command::read_tag_prefixed(&mut payload, self.version).ok()?;
        Some(Message { seq, command, payload })
    }

    /// Sends samples to stream `channel`.
    pub(super) fn send_samples(&mut self, channel: u32, samples: &[f32]) -> Result<(), Failure> {
        let descriptor = Descriptor {
            length: 4 * samples.len() as u32,
            channel,
            offset: 0,
            flags: DescriptorFlags::empty(),
        };
        let mut head = [0; DESCRIPTOR_SIZE];
        encode_descriptor(&mut head, &descriptor);
        self.out.clear();
        self.out.extend_from_slice(&head);
        self.out.extend(samples.iter().flat_map(|sample| sample.to_le_bytes()));
        Ok(self.socket.write_all(&self.out)?)
    }
}

/// Socket with a time limit for all reads together. A limit for each read would let a server that sends a byte now and
/// then block for ever.
struct Patient<'a> {
    socket: &'a mut UnixStream,
    until: Option<Instant>,
}

impl std::io::Read for Patient<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        if let Some(until) = self.until {
            let left = until.saturating_duration_since(Instant::now());
            if left.is_zero() {
                return Err(std::io::Error::new(
                    std::io::ErrorKind::TimedOut,
                    "the sound server is too slow",
                ));
            }
            self.socket.set_read_timeout(Some(left))?;
        }
        self.socket.read(buffer)
    }
}

/// The socket that the environment names, or the default one.
fn socket_path() -> Option<PathBuf> {
    let env = |name: &str| std::env::var_os(name).filter(|value| !value.is_empty());
    if let Some(server) = env("PULSE_SERVER") {
        // Servers on other machines are ignored, because their latency is too high for touch.
        let server = server.into_string().ok()?;
        return server.split_whitespace().find_map(|s| s.strip_prefix("unix:")).map(PathBuf::from);
    }
    let runtime = env("PULSE_RUNTIME_PATH").map(PathBuf::from);
    let usual = env("XDG_RUNTIME_DIR").map(|folder| PathBuf::from(folder).join("pulse"));
    runtime.into_iter().chain(usual).map(|folder| folder.join("native")).find(|path| path.exists())
}

/// Possible locations of this user's authentication cookie.
fn cookie_paths() -> Vec<PathBuf> {
    let home = |rest: &str| std::env::home_dir().map(|home| home.join(rest));
    let named = std::env::var_os("PULSE_COOKIE").map(PathBuf::from);
    named.into_iter().chain(home(".config/pulse/cookie")).chain(home(".pulse-cookie")).collect()
}
