//! Common parts of streams to and from the sound server: format, flags, and the thread.

use std::net::Shutdown;
use std::os::unix::net::UnixStream;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;

use pulseaudio::protocol::stream::StreamFlags;
use pulseaudio::protocol::{SampleFormat, SampleSpec};

use crate::error::{DeviceError, DeviceErrorKind};
use crate::urgency::run_before_others;

/// Samples as `f32`.
pub(super) fn sample_spec(channels: u8, rate_hz: u32) -> SampleSpec {
    SampleSpec { format: SampleFormat::Float32Le, channels, sample_rate: rate_hz }
}

/// A stream that waits for its start, whose channels are those of the device, and that stays at its device.
pub(super) fn stream_flags() -> StreamFlags {
    StreamFlags {
        start_corked: true,
        no_remap_channels: true,
        no_remix_channels: true,
        no_move: true,
        start_muted: Some(false),
        adjust_latency: true,
        ..StreamFlags::default()
    }
}

/// An open stream; it ends when it is dropped.
#[derive(Debug)]
pub(crate) struct PulseStream {
    /// Set before the connection is closed: the end of the stream is then not a loss.
    is_closing: Arc<AtomicBool>,
    socket: UnixStream,
    thread: Option<JoinHandle<()>>,
}

impl PulseStream {
    /// Starts a thread for the stream of `socket`, for the `direction` "input" or "output". The thread calls `run`, which
    /// returns when the connection ends; its argument says whether the stream is being closed.
    pub(super) fn start(
        socket: UnixStream,
        direction: &str,
        run: impl FnOnce(&AtomicBool) + Send + 'static,
    ) -> Result<Self, DeviceError> {
        let is_closing = Arc::new(AtomicBool::new(false));
        let closing = Arc::clone(&is_closing);
        let thread = std::thread::Builder::new().name(format!("sound server {direction}")).spawn(move || {
            run_before_others();
            run(&closing);
        });
        let thread = thread.map_err(|error| {
            let message = format!("the system cannot start a thread for the {direction}: {error}");
            DeviceError::new(DeviceErrorKind::Backend, message)
        })?;
        Ok(Self { is_closing, socket, thread: Some(thread) })
    }
}

impl Drop for PulseStream {
    fn drop(&mut self) {
        self.is_closing.store(true, Ordering::Relaxed);
        self.socket.shutdown(Shutdown::Both).ok(); // The server may have closed it already.
        if let Some(thread) = self.thread.take() {
            thread.join().ok(); // The panic of a callback has been printed already.
        }
    }
}
