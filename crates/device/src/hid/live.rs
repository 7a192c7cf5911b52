//! Live reading of a pen that may be unplugged and plugged in at any time.
//!
//! A dedicated thread reads reports and sends touches to the engine and pen samples to the window. It waits for a
//! missing pen by its id and never uses another pen instead.

mod reader;

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel, sync_channel};
use std::thread::JoinHandle;
use std::time::Duration;

use rtrb::{Consumer, RingBuffer};

use crate::error::{DeviceError, DeviceErrorKind};
use crate::hid::identity::HidPen;
use crate::hid::live::reader::{Command, Doorbell, Reader};
use crate::hid::tracker::{TrackedSample, TrackerOptions};
use crate::live::LiveInput;
use crate::pen_backend::Provides;
use crate::pressure::PressureMap;
use crate::urgency::run_before_others;

/// Capacity of the queue of pen samples to the window: four seconds at 1000 reports per second.
pub const N_MOMENTS: usize = 4096;
/// Longest wait for a report before commands are processed.
const READ_TIMEOUT: Duration = Duration::from_millis(20);
/// Interval between two searches for a missing pen.
const LOOK_AGAIN: Duration = Duration::from_secs(1);
/// The same interval if any pen will do: perhaps there will never be one.
const LOOK_AGAIN_AUTOMATICALLY: Duration = Duration::from_secs(4);

/// A device that sends reports.
pub trait ReportSource: Send {
    /// Returns the report descriptor.
    ///
    /// # Errors
    /// [`DeviceErrorKind::Lost`] if the device was disconnected.
    fn descriptor(&mut self) -> Result<Vec<u8>, DeviceError>;

    /// Waits for a report for at most `timeout`. Writes as much of it to `buffer` as fits. Returns its length in bytes,
    /// or zero if there was none.
    ///
    /// # Errors
    /// [`DeviceErrorKind::Lost`] if the device was disconnected.
    fn read(&mut self, buffer: &mut [u8], timeout: Duration) -> Result<usize, DeviceError>;
}

/// The system's list of connected pens.
pub trait PenBus: Send {
    /// Lists the connected pens. None is opened.
    ///
    /// # Errors
    /// [`DeviceErrorKind::Unavailable`] if the system cannot list devices.
    fn list(&mut self) -> Result<Vec<HidPen>, DeviceError>;

    /// Opens a pen for reading.
    ///
    /// # Errors
    /// [`DeviceErrorKind::Denied`] with instructions, [`DeviceErrorKind::NotFound`], [`DeviceErrorKind::Busy`] or
    /// [`DeviceErrorKind::Backend`].
    fn open(&mut self, pen: &HidPen) -> Result<Box<dyn ReportSource>, DeviceError>;
}

/// Choice of the pen, and settings for its reports.
#[derive(Clone, Debug, PartialEq)]
pub struct PenOptions {
    /// Id of the pen: [`HidPen::id`], or [`AUTOMATIC_ID`](crate::hid::choice::AUTOMATIC_ID) for the pen that provides
    /// most.
    pub id: String,
    /// Conversion of reports to touches.
    pub tracking: TrackerOptions,
    /// Width and height of the active area in m, set by the person for a pen that declares none or wrong ones.
    pub size_m: Option<[f64; 2]>,
}

/// Event in the connection to a pen.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum PenNotice {
    /// The pen is connected and being read.
    Connected {
        /// The pen.
        pen: HidPen,
        /// Width and height of its active area in m. Without a size there is no speed and therefore no output: ask the
        /// person.
        size_m: Option<[f64; 2]>,
        /// Whether that size is probably wrong: see [`crate::hid::pen::PenFormat::is_size_doubtful`].
        is_size_doubtful: bool,
        /// Whether it reports pressure.
        has_pressure: bool,
        /// Force at full pressure in N, if the pen declares it; otherwise the pressure map applies.
        full_n: Option<f64>,
        /// Quantities that the pen provides.
        provides: Provides,
    },
    /// The pen was disconnected. It is searched for and read again when it returns.
    Lost(DeviceError),
    /// The pen is missing or cannot be read. It is retried every second; each reason is reported once.
    Waiting(DeviceError),
}

/// State and counters of pen reading.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PenCounts {
    /// Whether a pen is being read.
    pub is_connected: bool,
    /// Number of decoded reports.
    pub n_reports: u64,
    /// Number of ignored reports, which are invalid or not from the pen.
    pub n_ignored: u64,
    /// Number of pen samples that were dropped because the queue to the window was full.
    pub n_dropped: u64,
}

/// Counters that both threads share.
#[derive(Debug, Default)]
struct Shared {
    is_connected: AtomicBool,
    n_reports: AtomicU64,
    n_ignored: AtomicU64,
    n_dropped: AtomicU64,
}

/// A thread that reads a pen. Dropping it ends the thread, which takes a few hundredths of a second.
#[derive(Debug)]
pub struct PenThread {
    commands: Option<Sender<Command>>,
    moments: Consumer<TrackedSample>,
    notices: Receiver<PenNotice>,
    shared: Arc<Shared>,
    thread: Option<JoinHandle<Option<LiveInput>>>,
}

impl PenThread {
    /// Starts to search for a pen and to read it. Touches go to `live` if an engine exists already.
    ///
    /// # Errors
    /// [`DeviceErrorKind::Unavailable`] if the system cannot start a thread.
    pub fn start(
        bus: impl PenBus + 'static,
        options: PenOptions,
        live: Option<LiveInput>,
    ) -> Result<Self, DeviceError> {
        // The queue holds more notices than a person can read; later ones are dropped.
        let (notices_in, notices) = sync_channel(64);
        let (moments_in, moments) = RingBuffer::new(N_MOMENTS);
        let (commands, commands_out) = channel();
        let shared = Arc::new(Shared::default());
        let reader = Reader::new(Box::new(bus), options, live, moments_in, notices_in, Arc::clone(&shared));
        let thread = std::thread::Builder::new().name("pen".into()).spawn(move || {
            run_before_others();
            reader.run(&commands_out)
        });
        let thread = thread.map_err(|error| {
            let message =
                format!("the system cannot start a thread to read the pen: {error}; close other programs");
            DeviceError::new(DeviceErrorKind::Unavailable, message)
        })?;
        Ok(Self { commands: Some(commands), moments, notices, shared, thread: Some(thread) })
    }

    /// Sends touches to another engine from now on.
    pub fn set_live(&self, live: LiveInput) {
        self.command(Command::Live(live));
    }

    /// Sets the pressure map from now on.
    pub fn set_pressure_map(&self, map: PressureMap) {
        self.command(Command::Map(map));
    }

    /// Sets the size (width, height) of the active area in m; `None` uses the size that the pen declares. A new size
    /// ends a stroke in progress; the same size does not.
    pub fn set_size_m(&self, size_m: Option<[f64; 2]>) {
        self.command(Command::Size(size_m));
    }

    /// Sets whether reports are passed on from now on. While they are not, the tip is lifted; reports are only counted.
    pub fn set_active(&self, is_active: bool) {
        self.command(Command::Active(is_active));
    }

    /// Calls `ring` after each report and notice from now on, on the pen's thread: it must be quick.
    pub fn set_doorbell(&self, ring: impl Fn() + Send + 'static) {
        self.command(Command::Doorbell(Doorbell(Box::new(ring))));
    }

    /// Lifts the tip and ends the thread, which takes a few hundredths of a second. Returns the engine's live input for
    /// the next pen, or `None` if the thread never had one.
    pub fn finish(mut self) -> Option<LiveInput> {
        self.end()
    }

    /// Takes the oldest pen sample from the queue.
    pub fn next_moment(&mut self) -> Option<TrackedSample> {
        self.moments.pop().ok() // The queue is empty.
    }

    /// Takes the oldest notice from the queue.
    pub fn next_notice(&self) -> Option<PenNotice> {
        self.notices.try_recv().ok() // The queue is empty.
    }

    /// Current state and counters.
    pub fn counts(&self) -> PenCounts {
        PenCounts {
            is_connected: self.shared.is_connected.load(Ordering::Relaxed),
            n_reports: self.shared.n_reports.load(Ordering::Relaxed),
            n_ignored: self.shared.n_ignored.load(Ordering::Relaxed),
            n_dropped: self.shared.n_dropped.load(Ordering::Relaxed),
        }
    }

    fn command(&self, command: Command) {
        if let Some(commands) = &self.commands {
            commands.send(command).ok(); // The thread ends only after this handle.
        }
    }
}

impl PenThread {
    fn end(&mut self) -> Option<LiveInput> {
        drop(self.commands.take());
        // If a third-party `PenBus` panicked, the panic message has been printed already.
        self.thread.take()?.join().ok()?
    }
}

impl Drop for PenThread {
    fn drop(&mut self) {
        self.end();
    }
}

#[cfg(test)]
mod tests;
