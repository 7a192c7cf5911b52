use std::collections::VecDeque;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use super::{PenBus, PenNotice, PenOptions, PenThread, ReportSource};
use crate::controls::Input;
use crate::engine::ChannelMask;
use crate::error::{DeviceError, DeviceErrorKind};
use crate::hid::choice::AUTOMATIC_ID;
use crate::hid::descriptor::tests::PEN;
use crate::hid::identity::{HidBus, HidPen, denied, with_ids};
use crate::hid::tracker::TrackerOptions;
use crate::hid::tracker::tests::{DOWN, HOVER, report};
use crate::kinematics::SpeedFilter;
use crate::output::tests::OPTIONS;
use crate::output::{OpenOptions, open_null_with_tap};
use crate::pen_backend::{Access, Backend, Provides};
use crate::pressure::PressureMap;
use crate::texture::tests::white;
use shagreen_synth::drive::DriveConfig;
use shagreen_synth::renderer::Mix;

/// A simulated machine with pens that can be plugged and unplugged.
#[derive(Clone, Default)]
struct Machine(Arc<Mutex<State>>);

#[derive(Default)]
struct State {
    plugged: Vec<&'static str>,
    is_denied: bool,
    descriptor: Vec<u8>,
    reports: VecDeque<Vec<u8>>,
    opened: Vec<String>,
}

struct Source(Machine, String);

fn pen(serial: &str) -> HidPen {
    HidPen {
        id: String::new(),
        name: "Test pen".into(),
        vendor_id: 1,
        product_id: 2,
        serial: Some(serial.into()),
        interface: None,
        path: format!("/dev/{serial}"),
        bus: HidBus::Usb,
        backend: Backend::Hid,
        provides: Provides::UNKNOWN,
        access: Access::Unknown,
    }
}

impl PenBus for Machine {
    fn list(&mut self) -> Result<Vec<HidPen>, DeviceError> {
        Ok(with_ids(self.0.lock().unwrap().plugged.iter().map(|serial| pen(serial)).collect()))
    }

    fn open(&mut self, pen: &HidPen) -> Result<Box<dyn ReportSource>, DeviceError> {
        let mut state = self.0.lock().unwrap();
        if state.is_denied {
            return Err(denied(pen));
        }
        state.opened.push(pen.id.clone());
        Ok(Box::new(Source(self.clone(), pen.serial.clone().unwrap())))
    }
}

impl ReportSource for Source {
    fn descriptor(&mut self) -> Result<Vec<u8>, DeviceError> {
        Ok(self.0.0.lock().unwrap().descriptor.clone())
    }

    fn read(&mut self, buffer: &mut [u8], _: Duration) -> Result<usize, DeviceError> {
        let mut state = self.0.0.lock().unwrap();
        if !state.plugged.contains(&self.1.as_str()) {
            return Err(DeviceError::new(DeviceErrorKind::Lost, "unplugged"));
        }
        if let Some(report) = state.reports.pop_front() {
            let length = report.len().min(buffer.len());
            buffer[..length].copy_from_slice(&report[..length]);
            return Ok(length);
        }
        drop(state);
        std::thread::sleep(Duration::from_millis(1));
        Ok(0)
    }
}

impl Machine {
    fn new(plugged: &[&'static str]) -> Self {
        let machine = Self::default();
        machine.0.lock().unwrap().descriptor = PEN.to_vec();
        machine.plug(plugged);
        machine
    }

    fn plug(&self, plugged: &[&'static str]) {
        self.0.lock().unwrap().plugged = plugged.to_vec();
    }

    fn send(&self, report: Vec<u8>) {
        self.0.lock().unwrap().reports.push_back(report);
    }

    /// A stroke at 0.2 m/s to the right with 2 N for 300 ms, with a report every 5 ms.
    fn stroke(&self) {
        for i in 0..60 {
            self.send(report(3000 + 100 * i, 8000, 2039, DOWN));
            std::thread::sleep(Duration::from_millis(5));
        }
    }
}

fn options(serial: &str) -> PenOptions {
    PenOptions {
        id: format!("hid:0001:0002:{serial}"),
        tracking: TrackerOptions { speed_filter: SpeedFilter::KALMAN, pressure_map: PressureMap::USUAL },
        size_m: None,
    }
}

/// Returns the next notice, within five seconds.
fn notice(thread: &PenThread) -> PenNotice {
    let begun = Instant::now();
    loop {
        if let Some(notice) = thread.next_notice() {
            return notice;
        }
        assert!(begun.elapsed() < Duration::from_secs(5), "no notice");
        std::thread::sleep(Duration::from_millis(2));
    }
}

/// Waits until the given number of reports is read or ignored.
fn wait_for(thread: &PenThread, n: u64) {
    let begun = Instant::now();
    while thread.counts().n_reports + thread.counts().n_ignored < n {
        assert!(begun.elapsed() < Duration::from_secs(5), "{:?}", thread.counts());
        std::thread::sleep(Duration::from_millis(2));
    }
}

#[test]
fn a_stroke_is_felt_until_the_pen_is_unplugged_and_again_when_it_is_back() {
    let output = OpenOptions {
        model_rate_hz: 1000.0,
        preferred_rate_hz: Some(48_000),
        buffer_frames: Some(256),
        seed: 5,
        drive: DriveConfig::proportional(4.0, 1.0),
        channels: ChannelMask::FIRST_TWO,
        friction: None,
        take_over: false,
    };
    let loud = Arc::new(Mutex::new(0.0_f32));
    let heard = Arc::clone(&loud);
    let tap = move |block: &[f32]| {
        let peak = block.iter().fold(0.0_f32, |peak, sample| peak.max(sample.abs()));
        let mut loud = heard.lock().unwrap();
        *loud = loud.max(peak);
    };
    let (mut handle, _running) = open_null_with_tap(output, tap).unwrap();
    let id = handle.load(white(1.0)).unwrap();
    handle.set_mix(Mix::solo(id)).unwrap();
    handle.set_input(Input::Live);
    let machine = Machine::new(&["a"]);
    let mut thread = PenThread::start(machine.clone(), options("a"), handle.take_live_input()).unwrap();
    let PenNotice::Connected { size_m: Some(size_m), full_n: Some(full_n), .. } = notice(&thread) else {
        panic!("not connected")
    };
    assert!((size_m[0] - 0.209_66).abs() < 1e-9 && (full_n - 4.016).abs() < 1e-9);
    for round in 1..=2_u64 {
        *loud.lock().unwrap() = 0.0;
        machine.stroke();
        let contact = handle.status().touch.contact;
        // On a busy machine, reports arrive late and in groups.
        assert!(contact.speed_mps > 0.02 && contact.speed_mps < 1.0, "{contact:?}");
        assert!((contact.force_n - 2.0).abs() < 0.01, "{contact:?}");
        assert!(*loud.lock().unwrap() > 0.01);
        wait_for(&thread, 60 * round);
        machine.plug(&[]);
        assert!(matches!(notice(&thread), PenNotice::Lost(error) if error.kind() == DeviceErrorKind::Lost));
        assert!(!thread.counts().is_connected);
        assert!(
            matches!(notice(&thread), PenNotice::Waiting(error) if error.kind() == DeviceErrorKind::NotFound)
        );
        std::thread::sleep(Duration::from_millis(50));
        assert_eq!(handle.status().touch.contact.force_n, 0.0);
        // Another pen of the same model is not this pen.
        machine.plug(&["b"]);
        std::thread::sleep(Duration::from_millis(50));
        machine.plug(&["b", "a"]);
        assert!(matches!(notice(&thread), PenNotice::Connected { pen, .. } if pen.id == "hid:0001:0002:a"));
    }
    let moments: Vec<_> = std::iter::from_fn(|| thread.next_moment()).collect();
    assert_eq!(moments.len(), 120);
    assert!(moments.iter().all(|moment| moment.report.tip && moment.place_m.is_some()));
    assert_eq!(machine.0.lock().unwrap().opened, ["hid:0001:0002:a"; 3]);
}

#[test]
fn nonsense_is_counted_and_felt_by_nobody() {
    let machine = Machine::new(&["a"]);
    let mut thread = PenThread::start(machine.clone(), options("a"), None).unwrap();
    notice(&thread);
    let mut seed = 7_u32;
    for i in 0..300 {
        let length = [1, 5, 11, 12, 64, 20_000][i % 6];
        let bytes = (0..length).map(|_| {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            // The first byte is never the pen's report id.
            (seed >> 24) as u8 | 0x80
        });
        machine.send(bytes.collect());
    }
    machine.send(report(1000, 1000, 0, HOVER)[..11].to_vec());
    wait_for(&thread, 301);
    assert_eq!((thread.counts().n_reports, thread.counts().n_ignored), (0, 301));
    assert!(thread.next_moment().is_none() && thread.counts().is_connected);
    // A report longer than declared is decoded up to the declared length.
    machine.send([report(1000, 1000, 4095, DOWN), vec![0xff; 30_000]].concat());
    wait_for(&thread, 302);
    assert!((thread.next_moment().unwrap().force_n - 4.016).abs() < 1e-9);
}

#[test]
fn a_refused_pen_is_told_once_and_read_when_it_is_allowed() {
    let machine = Machine::new(&["a"]);
    machine.0.lock().unwrap().is_denied = true;
    let thread = PenThread::start(machine.clone(), options("a"), None).unwrap();
    let rung = Arc::new(AtomicU64::new(0));
    let ring = Arc::clone(&rung);
    thread.set_doorbell(move || {
        ring.fetch_add(1, Ordering::Relaxed);
    });
    assert!(matches!(notice(&thread), PenNotice::Waiting(error) if error.kind() == DeviceErrorKind::Denied));
    std::thread::sleep(Duration::from_millis(1200));
    assert_eq!(thread.next_notice(), None);
    machine.0.lock().unwrap().is_denied = false;
    assert!(matches!(notice(&thread), PenNotice::Connected { .. }));
    machine.send(report(1000, 1000, 0, HOVER));
    wait_for(&thread, 1);
    // At least the second notice and the report; the first notice may come before the bell.
    let begun = Instant::now();
    while rung.load(Ordering::Relaxed) < 2 {
        assert!(begun.elapsed() < Duration::from_secs(5), "the bell did not ring");
        std::thread::yield_now();
    }
}

#[test]
fn a_device_that_is_no_pen_is_told() {
    for descriptor in
        [&[0x05, 0x01, 0x09, 0x06, 0xa1, 0x01, 0x75, 0x08, 0x95, 0x01, 0x81, 0x02, 0xc0][..], &[0xc0]]
    {
        let machine = Machine::new(&["a"]);
        machine.0.lock().unwrap().descriptor = descriptor.to_vec();
        let thread = PenThread::start(machine, options("a"), None).unwrap();
        assert!(
            matches!(notice(&thread), PenNotice::Waiting(error) if error.kind() == DeviceErrorKind::Unsupported)
        );
    }
}

#[test]
fn without_a_size_nothing_is_felt_until_one_is_given() {
    let machine = Machine::new(&["a"]);
    {
        let mut state = machine.0.lock().unwrap();
        let at = state.descriptor.windows(2).position(|w| w == [0x65, 0x11]).unwrap();
        state.descriptor[at + 1] = 0;
    }
    let mut thread = PenThread::start(machine.clone(), options("a"), None).unwrap();
    assert!(matches!(notice(&thread), PenNotice::Connected { size_m: None, .. }));
    machine.stroke();
    wait_for(&thread, 60);
    while let Some(moment) = thread.next_moment() {
        assert_eq!((moment.place_m, moment.touch.contact.force_n), (None, 0.0));
        assert!(moment.report.x_share > 0.1);
    }
    thread.set_size_m(Some([0.2, 0.15]));
    assert!(matches!(notice(&thread), PenNotice::Connected { size_m: Some(_), .. }));
    machine.stroke();
    wait_for(&thread, 120);
    let last = std::iter::from_fn(|| thread.next_moment()).last().unwrap();
    assert!(last.touch.contact.speed_mps > 0.02 && last.force_n > 1.9);
}

#[test]
fn a_size_that_is_no_other_leaves_the_stroke_alone() {
    let machine = Machine::new(&["a"]);
    let mut thread = PenThread::start(machine.clone(), options("a"), None).unwrap();
    assert!(matches!(notice(&thread), PenNotice::Connected { .. }));
    let mut speeds = Vec::new();
    for (i, size_m) in [None, None, Some([0.2, 0.15]), Some([0.2, 0.15]), None].into_iter().enumerate() {
        thread.set_size_m(size_m);
        std::thread::sleep(Duration::from_millis(50));
        machine.stroke();
        wait_for(&thread, 60 * (i as u64 + 1));
        let moments: Vec<_> = std::iter::from_fn(|| thread.next_moment()).collect();
        assert_eq!(moments.len(), 60);
        speeds.push(moments[0].touch.contact.speed_mps);
        let is_new = i == 2 || i == 4;
        assert_eq!(thread.next_notice().is_some(), is_new, "{i}");
    }
    // After a restart of the tracker, the speed at the first report is zero.
    let begins: Vec<bool> = speeds.iter().map(|speed| *speed == 0.0).collect();
    assert_eq!(begins, [true, false, true, false, true]);
}

#[test]
fn the_way_into_the_engine_comes_back_for_the_next_pen() {
    let output = OpenOptions { preferred_rate_hz: Some(48_000), ..OPTIONS };
    let (mut handle, _running) = open_null_with_tap(output, |_| {}).unwrap();
    handle.set_input(Input::Live);
    let mut live = handle.take_live_input();
    // The same pen twice, then another one; the last thread ends while it waits for its pen.
    for (serial, plugged) in [("a", "a"), ("a", "a"), ("b", "b"), ("a", "b")] {
        let machine = Machine::new(&[plugged]);
        let thread = PenThread::start(machine.clone(), options(serial), live.take()).unwrap();
        notice(&thread);
        if serial == plugged {
            machine.send(report(3000, 8000, 2039, DOWN));
            wait_for(&thread, 1);
            let begun = Instant::now();
            while handle.status().touch.contact.force_n == 0.0 {
                assert!(begun.elapsed() < Duration::from_secs(5), "{serial} has no effect");
                std::thread::sleep(Duration::from_millis(2));
            }
        }
        live = thread.finish();
        assert!(live.is_some());
        let begun = Instant::now();
        while handle.status().touch.contact.force_n > 0.0 {
            assert!(begun.elapsed() < Duration::from_secs(5), "{serial} is not lifted");
            std::thread::sleep(Duration::from_millis(2));
        }
    }
    assert!(PenThread::start(Machine::new(&[]), options("a"), None).unwrap().finish().is_none());
}

#[test]
fn a_ring_that_nobody_empties_is_counted_and_harmless() {
    let machine = Machine::new(&["a"]);
    let thread = PenThread::start(machine.clone(), options("a"), None).unwrap();
    let n = super::N_MOMENTS as u64 + 100;
    for i in 0..n {
        machine.send(report((i % 20_000) as u16, 0, 0, HOVER));
    }
    wait_for(&thread, n);
    assert_eq!(thread.counts().n_dropped, 100);
    let begun = Instant::now();
    drop(thread);
    assert!(begun.elapsed() < Duration::from_secs(1));
}

#[test]
fn any_pen_is_read_automatically_and_a_pause_lifts_it() {
    let machine = Machine::new(&[]);
    let options = PenOptions { id: AUTOMATIC_ID.to_owned(), ..options("a") };
    machine.plug(&["b", "a"]);
    let mut thread = PenThread::start(machine.clone(), options, None).unwrap();
    let PenNotice::Connected { pen, provides, .. } = notice(&thread) else { panic!("not connected") };
    // Equal pens are chosen by their id, so that the choice is the same every time.
    assert_eq!((pen.id.as_str(), provides.pressure), ("hid:0001:0002:a", Some(true)));
    machine.send(report(1000, 1000, 2039, DOWN));
    wait_for(&thread, 1);
    assert!(thread.next_moment().is_some());
    thread.set_active(false);
    std::thread::sleep(Duration::from_millis(50));
    machine.send(report(1100, 1000, 2039, DOWN));
    wait_for(&thread, 2);
    assert!(thread.next_moment().is_none(), "a report is counted only");
    thread.set_active(true);
    std::thread::sleep(Duration::from_millis(50));
    machine.send(report(1200, 1000, 2039, DOWN));
    wait_for(&thread, 3);
    assert!(thread.next_moment().is_some());
}

#[test]
fn without_a_pen_the_automatic_choice_waits() {
    let options = PenOptions { id: AUTOMATIC_ID.to_owned(), ..options("a") };
    let thread = PenThread::start(Machine::new(&[]), options, None).unwrap();
    assert!(
        matches!(notice(&thread), PenNotice::Waiting(error) if error.kind() == DeviceErrorKind::NotFound)
    );
}
