//! A pen that is read while it is used: it may be unplugged and plugged in again at any time.
//!
//! A thread of its own reads reports and sends touches to the engine and moments to the window. It waits for a pen that
//! is not there, by its identity, and never takes another in its place.

mod reader;

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel, sync_channel};
use std::thread::JoinHandle;
use std::time::Duration;

use rtrb::{Consumer, RingBuffer};

use crate::error::{DeviceError, DeviceErrorKind};
use crate::hid::identity::HidPen;
use crate::hid::live::reader::{Command, Reader};
use crate::hid::tracker::{PenMoment, TrackerOptions};
use crate::live::LiveInput;
use crate::pressure::PressureMap;
use crate::urgency::run_before_others;

/// Moments that wait for the window at most: at 1000 reports a second, four seconds.
pub const N_MOMENTS: usize = 4096;
/// Longest that a report is waited for before commands are looked at, in s.
const READ_TIMEOUT: Duration = Duration::from_millis(20);
/// How often a pen that is not there is looked for.
const LOOK_AGAIN: Duration = Duration::from_secs(1);

/// A device that sends reports.
pub trait ReportSource: Send {
    /// Its report descriptor.
    ///
    /// # Errors
    /// [`DeviceErrorKind::Lost`] if it is gone.
    fn descriptor(&mut self) -> Result<Vec<u8>, DeviceError>;

    /// Waits for a report for at most `timeout` and writes as much of it to `buffer` as there is room for: its length,
    /// or zero if there was none.
    ///
    /// # Errors
    /// [`DeviceErrorKind::Lost`] if the device is gone.
    fn read(&mut self, buffer: &mut [u8], timeout: Duration) -> Result<usize, DeviceError>;
}

/// Where pens are plugged in.
pub trait PenBus: Send {
    /// The pens that are there now. None is opened.
    ///
    /// # Errors
    /// [`DeviceErrorKind::Unavailable`] if the system does not tell.
    fn list(&mut self) -> Result<Vec<HidPen>, DeviceError>;

    /// Opens a pen for reading.
    ///
    /// # Errors
    /// [`DeviceErrorKind::Denied`] with what to do about it, [`DeviceErrorKind::NotFound`],
    /// [`DeviceErrorKind::Busy`] or [`DeviceErrorKind::Backend`].
    fn open(&mut self, pen: &HidPen) -> Result<Box<dyn ReportSource>, DeviceError>;
}

/// Which pen is read, and how.
#[derive(Clone, Debug, PartialEq)]
pub struct PenOptions {
    /// Its name: [`HidPen::id`].
    pub id: String,
    /// How reports become touches.
    pub tracking: TrackerOptions,
    /// Width and height of its area in m, where the person gives them: for a pen that declares none, or wrong ones.
    pub size_m: Option<[f64; 2]>,
}

/// What happened to a pen.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum PenNotice {
    /// It is read from now on.
    Connected {
        /// The pen.
        pen: HidPen,
        /// Width and height of its area in m. Without it nothing can be felt, since there is no speed: ask the person.
        size_m: Option<[f64; 2]>,
        /// Whether that size is likely wrong: see [`crate::hid::pen::PenFormat::is_size_doubtful`].
        is_size_doubtful: bool,
        /// Whether it tells pressure.
        has_pressure: bool,
        /// Force at full pressure in N, if it declares it; else the map of pressure is used.
        full_n: Option<f64>,
    },
    /// It went away; it is looked for and read again when it is back.
    Lost(DeviceError),
    /// It is not there or cannot be read; it is tried again each second. Told once for each reason.
    Waiting(DeviceError),
}

/// How reading goes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PenCounts {
    /// Whether a pen is being read.
    pub is_connected: bool,
    /// Reports that were understood.
    pub n_reports: u64,
    /// Reports that were none of the pen's, or nonsense.
    pub n_ignored: u64,
    /// Moments that found no room on their way to the window.
    pub n_dropped: u64,
}

/// Counters of both ends.
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
    moments: Consumer<PenMoment>,
    notices: Receiver<PenNotice>,
    shared: Arc<Shared>,
    thread: Option<JoinHandle<Option<LiveInput>>>,
}

impl PenThread {
    /// Starts to look for a pen and to read it; touches go to `live`, if there is an engine already.
    ///
    /// # Errors
    /// [`DeviceErrorKind::Unavailable`] if the system starts no thread.
    pub fn start(
        bus: impl PenBus + 'static,
        options: PenOptions,
        live: Option<LiveInput>,
    ) -> Result<Self, DeviceError> {
        // At most as many notices as a person can read; what finds no room was said before.
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
                format!("the system starts no thread to read the pen: {error}; close other programs");
            DeviceError::new(DeviceErrorKind::Unavailable, message)
        })?;
        Ok(Self { commands: Some(commands), moments, notices, shared, thread: Some(thread) })
    }

    /// Sends touches to another engine from now on.
    pub fn set_live(&self, live: LiveInput) {
        self.command(Command::Live(live));
    }

    /// Takes another map for pressure from now on.
    pub fn set_pressure_map(&self, map: PressureMap) {
        self.command(Command::Map(map));
    }

    /// Takes `size_m` (width, height) for the area from now on; `None` is what the pen declares. A stroke in progress ends
    /// where that is another than before, and goes on where it is not.
    pub fn set_size_m(&self, size_m: Option<[f64; 2]>) {
        self.command(Command::Size(size_m));
    }

    /// Ends the thread, the tip lifted, and gives back the way into the engine that it had last, for the next pen; this
    /// takes a few hundredths of a second. There is none where it was given none.
    pub fn finish(mut self) -> Option<LiveInput> {
        self.end()
    }

    /// The oldest moment that has not been taken yet.
    pub fn next_moment(&mut self) -> Option<PenMoment> {
        self.moments.pop().ok() // Empty: there is none.
    }

    /// The oldest notice that has not been taken yet.
    pub fn next_notice(&self) -> Option<PenNotice> {
        self.notices.try_recv().ok() // Empty: there is none.
    }

    /// How reading goes.
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
            commands.send(command).ok(); // The thread ends only with this handle.
        }
    }
}

impl PenThread {
    fn end(&mut self) -> Option<LiveInput> {
        drop(self.commands.take());
        // A panic of a bus that is not ours has been printed by then.
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
