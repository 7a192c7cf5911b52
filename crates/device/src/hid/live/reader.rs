//! Body of the pen thread.

use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, TryRecvError};
use std::time::{Duration, Instant};

use rtrb::Producer;

use crate::error::{DeviceError, DeviceErrorKind};
use crate::hid::choice::{AUTOMATIC_ID, chosen};
use crate::hid::descriptor::{self, MAX_REPORT_BYTES};
use crate::hid::identity::HidPen;
use crate::hid::live::{
    LOOK_AGAIN, LOOK_AGAIN_AUTOMATICALLY, PenBus, PenNotice, PenOptions, READ_TIMEOUT, ReportSource, Shared,
};
use crate::hid::pen::PenDecoder;
use crate::hid::tracker::{PenTracker, TrackedSample};
use crate::live::LiveInput;
use crate::pressure::PressureMap;

/// Function to call when there is something new.
pub(super) struct Doorbell(pub(super) Box<dyn Fn() + Send>);

impl std::fmt::Debug for Doorbell {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Doorbell")
    }
}

/// Command from the handle. When the handle is dropped, the thread ends.
#[derive(Debug)]
pub(super) enum Command {
    Live(LiveInput),
    Map(PressureMap),
    Size(Option<[f64; 2]>),
    Doorbell(Doorbell),
    Active(bool),
}

/// An open pen.
struct Open {
    source: Box<dyn ReportSource>,
    tracker: PenTracker,
    pen: HidPen,
    declared: PenDecoder,
}

pub(super) struct Reader {
    bus: Box<dyn PenBus>,
    options: PenOptions,
    live: Option<LiveInput>,
    moments: Producer<TrackedSample>,
    notices: SyncSender<PenNotice>,
    shared: Arc<Shared>,
    open: Option<Open>,
    buffer: Vec<u8>,
    started: Instant,
    last_reason: Option<DeviceError>,
    doorbell: Option<Doorbell>,
    /// Whether reports are passed on.
    is_active: bool,
}

impl Reader {
    pub(super) fn new(
        bus: Box<dyn PenBus>,
        options: PenOptions,
        live: Option<LiveInput>,
        moments: Producer<TrackedSample>,
        notices: SyncSender<PenNotice>,
        shared: Arc<Shared>,
    ) -> Self {
        Self {
            bus,
            options,
            live,
            moments,
            notices,
            shared,
            open: None,
            buffer: vec![0; MAX_REPORT_BYTES as usize + 1],
            started: Instant::now(),
            last_reason: None,
            doorbell: None,
            is_active: true,
        }
    }

    /// Reads until the handle is dropped. Returns the engine's live input.
    pub(super) fn run(mut self, commands: &Receiver<Command>) -> Option<LiveInput> {
        loop {
            loop {
                match commands.try_recv() {
                    Ok(command) => self.obey(command),
                    Err(TryRecvError::Empty) => break,
                    Err(TryRecvError::Disconnected) => {
                        self.lift();
                        return self.live;
                    }
                }
            }
            if self.open.is_some() {
                self.read();
                continue;
            }
            if let Err(error) = self.look() {
                self.wait_for(error);
                let is_automatic = self.options.id == AUTOMATIC_ID;
                match wait(commands, if is_automatic { LOOK_AGAIN_AUTOMATICALLY } else { LOOK_AGAIN }) {
                    Waited::Command(command) => self.obey(command),
                    Waited::Time => {}
                    Waited::End => return self.live,
                }
            }
        }
    }

    fn obey(&mut self, command: Command) {
        match command {
            Command::Live(live) => self.live = Some(live),
            Command::Map(map) => {
                self.options.tracking.pressure_map = map;
                if let Some(open) = &mut self.open {
                    open.tracker.set_pressure_map(map);
                }
            }
            Command::Doorbell(doorbell) => self.doorbell = Some(doorbell),
            Command::Active(is_active) => {
                if !is_active {
                    self.lift();
                }
                self.is_active = is_active;
            }
            Command::Size(size_m) if size_m == self.options.size_m => {}
            Command::Size(size_m) => {
                self.options.size_m = size_m;
                self.lift();
                if let Some(open) = &mut self.open {
                    let decoder = open.declared.clone().with_size_m(size_m);
                    open.tracker = PenTracker::new(decoder, self.options.tracking);
                    self.connected();
                }
            }
        }
    }

    /// Searches for the pen and opens it.
    fn look(&mut self) -> Result<(), DeviceError> {
        let pen = chosen(self.bus.list()?, &self.options.id)?;
        let mut source = self.bus.open(&pen)?;
        let declared = decoder_of(&source.descriptor()?, &pen)?;
        let tracker =
            PenTracker::new(declared.clone().with_size_m(self.options.size_m), self.options.tracking);
        self.open = Some(Open { source, tracker, pen, declared });
        self.last_reason = None;
        self.shared.is_connected.store(true, Ordering::Relaxed);
        self.connected();
        Ok(())
    }

    fn connected(&mut self) {
        let Some(open) = &self.open else { return };
        let format = open.tracker.decoder().best();
        self.tell(PenNotice::Connected {
            pen: open.pen.clone(),
            size_m: format.size_m(),
            is_size_doubtful: format.is_size_doubtful,
            has_pressure: format.pressure.is_some(),
            full_n: format.pressure.and_then(|pressure| pressure.full_n),
            provides: format.provides(),
        });
    }

    /// Waits for one report and processes it.
    fn read(&mut self) {
        let Some(open) = &mut self.open else { return };
        let read = open.source.read(&mut self.buffer, READ_TIMEOUT);
        let now = Instant::now();
        match read {
            Ok(0) => {}
            Ok(length) => {
                let bytes = self.buffer.get(..length).unwrap_or(&self.buffer);
                let arrival_secs = now.saturating_duration_since(self.started).as_secs_f64();
                let Some(moment) = open.tracker.report(arrival_secs, bytes) else {
                    self.shared.n_ignored.fetch_add(1, Ordering::Relaxed);
                    return;
                };
                self.shared.n_reports.fetch_add(1, Ordering::Relaxed);
                if !self.is_active {
                    return;
                }
                self.tell_engine(&moment, now);
                if self.moments.push(moment).is_err() {
                    self.shared.n_dropped.fetch_add(1, Ordering::Relaxed);
                }
                self.ring();
            }
            Err(error) => {
                self.lift();
                self.open = None;
                self.shared.is_connected.store(false, Ordering::Relaxed);
                self.tell(PenNotice::Lost(error));
            }
        }
    }

    /// Reports a lifted tip to the engine, because the pen is no longer read.
    fn lift(&mut self) {
        if let Some(open) = &mut self.open {
            let touch = open.tracker.lift();
            if let Some(live) = &mut self.live {
                live.send(touch, Instant::now()).ok(); // Full only when the output has stopped.
            }
        }
    }

    fn tell_engine(&mut self, moment: &TrackedSample, time: Instant) {
        let Some(live) = &mut self.live else { return };
        // Without a known position there is no output, so another stylus may take over.
        let hovers = moment.touch.contact.force_n == 0.0 && moment.place_m.is_some();
        let sent = if hovers {
            live.hover(moment.touch, time)
        } else {
            live.land(moment.touch, time, moment.impact_mps)
        };
        sent.ok(); // Full only when the output has stopped.
    }

    /// Reports why there is no pen, unless this reason was already reported.
    fn wait_for(&mut self, reason: DeviceError) {
        if self.last_reason.as_ref() != Some(&reason) {
            self.last_reason = Some(reason.clone());
            self.tell(PenNotice::Waiting(reason));
        }
    }

    fn tell(&mut self, notice: PenNotice) {
        self.notices.try_send(notice).ok(); // Full: the notices are not read.
        self.ring();
    }

    fn ring(&self) {
        if let Some(Doorbell(ring)) = &self.doorbell {
            ring();
        }
    }
}

enum Waited {
    Command(Command),
    Time,
    End,
}

fn wait(commands: &Receiver<Command>, time: Duration) -> Waited {
    match commands.recv_timeout(time) {
        Ok(command) => Waited::Command(command),
        Err(RecvTimeoutError::Timeout) => Waited::Time,
        Err(RecvTimeoutError::Disconnected) => Waited::End,
    }
}

fn decoder_of(bytes: &[u8], pen: &HidPen) -> Result<PenDecoder, DeviceError> {
    let unsupported = |why: String| {
        let message = format!("the pen {} cannot be read: {why}; use another pen", pen.name);
        DeviceError::new(DeviceErrorKind::Unsupported, message)
    };
    let descriptor = descriptor::parse(bytes).map_err(|error| unsupported(error.to_string()))?;
    PenDecoder::of_device(&descriptor, Some((pen.vendor_id, pen.product_id)))
        .ok_or_else(|| unsupported("its report descriptor declares no pen".into()))
}
