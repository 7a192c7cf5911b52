//! Replay of recorded pen reports in real time, through the same processing as a real pen's.

use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::{Duration, Instant};

use crate::error::{DeviceError, DeviceErrorKind};
use crate::hid::identity::{HidBus, HidPen};
use crate::hid::live::{PenBus, ReportSource};
use crate::pen_backend::{Access, Backend, Provides};

/// A report with its time, in seconds after the start of the replay.
#[derive(Clone, Debug, PartialEq)]
pub struct ReplayedReport {
    /// Time in seconds.
    pub secs: f64,
    /// Bytes of the report.
    pub bytes: Vec<u8>,
}

/// Index of a replayed report, and the time at which it was delivered.
pub type Came = (usize, Instant);

/// A simulated list of connected pens with one replayed pen.
#[derive(Debug)]
pub struct ReplayBus {
    descriptor: Vec<u8>,
    reports: Vec<ReplayedReport>,
    came: Option<Sender<Came>>,
}

/// Id of a replayed pen.
pub const REPLAY_ID: &str = "replay";

impl ReplayBus {
    /// A pen with this descriptor that sends the reports once, sorted by time, and then disconnects. The returned
    /// receiver gets the delivery time of each report.
    pub fn new(descriptor: Vec<u8>, mut reports: Vec<ReplayedReport>) -> (Self, Receiver<Came>) {
        reports.sort_by(|a, b| a.secs.total_cmp(&b.secs));
        let (came, times) = channel();
        (Self { descriptor, reports, came: Some(came) }, times)
    }
}

impl PenBus for ReplayBus {
    fn list(&mut self) -> Result<Vec<HidPen>, DeviceError> {
        if self.came.is_none() {
            return Ok(Vec::new());
        }
        Ok(vec![HidPen {
            id: REPLAY_ID.to_owned(),
            name: "Replayed pen".to_owned(),
            vendor_id: 0,
            product_id: 0,
            serial: None,
            interface: None,
            path: REPLAY_ID.to_owned(),
            bus: HidBus::Other,
            backend: Backend::Hid,
            provides: Provides::UNKNOWN,
            access: Access::Granted,
        }])
    }

    fn open(&mut self, _pen: &HidPen) -> Result<Box<dyn ReportSource>, DeviceError> {
        let gone = || DeviceError::new(DeviceErrorKind::NotFound, "the replay has ended");
        Ok(Box::new(Replay {
            descriptor: std::mem::take(&mut self.descriptor),
            reports: std::mem::take(&mut self.reports),
            next: 0,
            came: self.came.take().ok_or_else(gone)?,
            begun: None,
        }))
    }
}

struct Replay {
    descriptor: Vec<u8>,
    reports: Vec<ReplayedReport>,
    next: usize,
    came: Sender<Came>,
    begun: Option<Instant>,
}

impl ReportSource for Replay {
    fn descriptor(&mut self) -> Result<Vec<u8>, DeviceError> {
        Ok(self.descriptor.clone())
    }

    fn read(&mut self, buffer: &mut [u8], timeout: Duration) -> Result<usize, DeviceError> {
        let begun = *self.begun.get_or_insert_with(Instant::now);
        let Some(report) = self.reports.get(self.next) else {
            return Err(DeviceError::new(DeviceErrorKind::Lost, "the replay has ended"));
        };
        let due = Duration::from_secs_f64(report.secs.max(0.0)).saturating_sub(begun.elapsed());
        if due > timeout {
            std::thread::sleep(timeout);
            return Ok(0);
        }
        std::thread::sleep(due);
        let length = report.bytes.len().min(buffer.len());
        buffer[..length].copy_from_slice(&report.bytes[..length]);
        self.came.send((self.next, Instant::now())).ok(); // The receiver may be dropped.
        self.next += 1;
        Ok(length)
    }
}

/// Report descriptor of a simple pen: 100 mm × 100 mm in units of 0.01 mm, 4096 pressure levels, tip and in-range
/// switch. [`plain_report`] makes its reports.
pub const PLAIN_PEN: &[u8] = &[
    0x05, 0x0d, // usage page: digitizer
    0x09, 0x02, 0xa1, 0x01, // application: pen
    0x09, 0x20, 0xa1, 0x00, // physical: stylus
    0x09, 0x42, 0x09, 0x32, // tip, in range
    0x15, 0x00, 0x25, 0x01, 0x75, 0x01, 0x95, 0x02, 0x81, 0x02, // one bit each
    0x95, 0x06, 0x81, 0x03, // six bits of padding
    0x05, 0x01, 0x09, 0x30, 0x09, 0x31, // x, y
    0x26, 0x10, 0x27, 0x46, 0xe8, 0x03, // logical 0..10000, physical 0..1000
    0x55, 0x0e, 0x65, 0x11, // 0.01 cm
    0x75, 0x10, 0x95, 0x02, 0x81, 0x02, // 16 bits each
    0x05, 0x0d, 0x09, 0x30, // pressure
    0x26, 0xff, 0x0f, 0x45, 0x00, 0x55, 0x00, 0x65, 0x00, // 0..4095, no unit
    0x95, 0x01, 0x81, 0x02, // 16 bits
    0xc0, 0xc0,
];

/// A report of [`PLAIN_PEN`]: position in mm from the upper left corner, pressure 0..1, and whether the tip touches.
pub fn plain_report(x_mm: f64, y_mm: f64, pressure: f64, touches: bool) -> Vec<u8> {
    let count = |value: f64, most: f64| (value.clamp(0.0, 1.0) * most).round() as u16;
    let [x0, x1] = count(x_mm / 100.0, 10_000.0).to_le_bytes();
    let [y0, y1] = count(y_mm / 100.0, 10_000.0).to_le_bytes();
    let [p0, p1] = count(pressure, 4095.0).to_le_bytes();
    vec![if touches { 3 } else { 2 }, x0, x1, y0, y1, p0, p1]
}

#[cfg(test)]
mod tests {
    use super::{Instant, PLAIN_PEN, REPLAY_ID, ReplayBus, ReplayedReport, plain_report};
    use crate::hid::descriptor::parse;
    use crate::hid::live::{PenNotice, PenOptions, PenThread};
    use crate::hid::pen::PenDecoder;
    use crate::hid::tracker::TrackerOptions;
    use crate::kinematics::SpeedFilter;
    use crate::pressure::PressureMap;
    use std::time::Duration;

    #[test]
    fn the_plain_pen_is_one() {
        let decoder = PenDecoder::of_descriptor(&parse(PLAIN_PEN).unwrap()).unwrap();
        let report = decoder.decode(&plain_report(25.0, 75.0, 0.5, true)).unwrap();
        assert!((report.x_m.unwrap() - 0.025).abs() < 1e-9 && (report.y_m.unwrap() - 0.075).abs() < 1e-9);
        assert!((report.pressure.unwrap() - 0.5).abs() < 1e-3 && report.tip && report.in_range);
        assert!(!decoder.decode(&plain_report(25.0, 75.0, 0.0, false)).unwrap().tip);
    }

    #[test]
    fn reports_come_again_in_their_time_and_then_the_pen_is_gone() {
        let report = |i: u32| ReplayedReport {
            secs: 0.008 * f64::from(i),
            bytes: plain_report(10.0 + f64::from(i), 50.0, 0.4, i > 2),
        };
        let (bus, times) = ReplayBus::new(PLAIN_PEN.to_vec(), (0..20).map(report).collect());
        let tracking = TrackerOptions { speed_filter: SpeedFilter::KALMAN, pressure_map: PressureMap::USUAL };
        let options = PenOptions { id: REPLAY_ID.to_owned(), tracking, size_m: None };
        let mut thread = PenThread::start(bus, options, None).unwrap();
        let begun = Instant::now();
        let mut moments = Vec::new();
        let mut is_lost = false;
        while !is_lost && begun.elapsed() < Duration::from_secs(20) {
            moments.extend(std::iter::from_fn(|| thread.next_moment()));
            is_lost = std::iter::from_fn(|| thread.next_notice()).any(|n| matches!(n, PenNotice::Lost(_)));
            std::thread::sleep(Duration::from_millis(2));
        }
        moments.extend(std::iter::from_fn(|| thread.next_moment()));
        let times: Vec<_> = times.try_iter().collect();
        assert!(is_lost && times.len() == 20 && moments.len() == 20, "{} {}", times.len(), moments.len());
        // No report is early.
        for (i, came) in &times {
            assert!(came.duration_since(times[0].1).as_secs_f64() > 0.008 * *i as f64 - 0.002);
        }
        assert!(moments[19].touch.contact.force_n > 0.5 && moments[2].touch.contact.force_n == 0.0);
    }
}
