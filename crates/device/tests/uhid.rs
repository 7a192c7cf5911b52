//! A simulated haptic pen as a device of the Linux kernel (`/dev/uhid`), found and driven through the real system.
//!
//! The test skips where the kernel or its permissions offer no such devices.
#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may panic, and prints what it skips")]

use std::fs::{File, OpenOptions};
use std::io::{Read as _, Write as _};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::{Duration, Instant};

use shagreen_device::haptic_pen::controller::ReportShape;
use shagreen_device::haptic_pen::pen::HapticPort as _;
use shagreen_device::haptic_pen::simulated::{LISTING_PEN, SimulatedPen};
use shagreen_device::haptic_pen::system::{list, open};
use shagreen_device::haptic_pen::waveform::{Play, Waveform};

/// Length of an event of the kernel in bytes: its type and the largest content.
const EVENT_BYTES: usize = 4 + 4372;
// Types of events, from the kernel's interface.
const CREATE: u32 = 11;
const DESTROY: u32 = 1;
const OUTPUT: u32 = 6;
const GET_REPORT: u32 = 9;
const GET_REPORT_REPLY: u32 = 10;
const SET_REPORT: u32 = 13;
const SET_REPORT_REPLY: u32 = 14;
/// Bus number of Bluetooth, and ids of vendor and product for tests.
const BLUETOOTH: u16 = 5;
const IDS: [u32; 2] = [0x1209, 0x5a47];

/// An event with zeros after its content.
fn event(kind: u32, content: &[u8]) -> Vec<u8> {
    let mut bytes = kind.to_le_bytes().to_vec();
    bytes.extend(content);
    bytes.resize(EVENT_BYTES, 0);
    bytes
}

/// The request for a device with the descriptor of the simulated pen.
fn creation() -> Vec<u8> {
    let mut content = b"Shagreen simulated haptic pen".to_vec();
    content.resize(128 + 64 + 64, 0);
    content.extend((LISTING_PEN.len() as u16).to_le_bytes());
    content.extend(BLUETOOTH.to_le_bytes());
    content.extend(IDS.iter().flat_map(|id| id.to_le_bytes()));
    content.extend([0; 8]);
    content.extend(LISTING_PEN);
    event(CREATE, &content)
}

/// Answers the requests of the kernel, and passes on the reports that it writes.
fn serve(mut kernel: File, written: &Sender<Vec<u8>>) {
    let mut pen = SimulatedPen::listing();
    let mut bytes = [0; EVENT_BYTES];
    while let Ok(length) = kernel.read(&mut bytes) {
        let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
        let half = |at: usize| usize::from(u16::from_le_bytes(bytes[at..at + 2].try_into().unwrap()));
        if length < 12 {
            continue;
        }
        let (kind, id) = (word(0), word(4));
        let reply = match kind {
            OUTPUT => {
                // The data of 4096 bytes precede their length.
                written.send(bytes[4..4 + half(4 + 4096)].to_vec()).ok();
                continue;
            }
            GET_REPORT => {
                let shape = ReportShape { id: Some(bytes[8]), n_bytes: 0 };
                let report = pen.feature(shape).unwrap_or_default();
                let mut content = id.to_le_bytes().to_vec();
                content.extend(u16::from(report.is_empty()).to_le_bytes());
                content.extend((report.len() as u16).to_le_bytes());
                content.extend(report);
                event(GET_REPORT_REPLY, &content)
            }
            SET_REPORT => {
                written.send(bytes[12..12 + half(10)].to_vec()).ok();
                event(SET_REPORT_REPLY, &[&id.to_le_bytes()[..], &[0, 0]].concat())
            }
            _ => continue,
        };
        if kernel.write_all(&reply).is_err() {
            return;
        }
    }
}

/// Returns the next report that the kernel writes to the pen.
fn next(written: &Receiver<Vec<u8>>) -> Vec<u8> {
    written.recv_timeout(Duration::from_secs(5)).unwrap()
}

#[test]
fn a_haptic_pen_of_the_kernel_is_found_and_driven() {
    let Ok(mut kernel) = OpenOptions::new().read(true).write(true).open("/dev/uhid") else {
        println!("skipped: /dev/uhid cannot be opened here");
        return;
    };
    if kernel.write_all(&creation()).is_err() {
        println!("skipped: the kernel makes no such device here");
        return;
    }
    let mut closing = kernel.try_clone().unwrap();
    let (written_in, written) = channel();
    std::thread::spawn(move || serve(kernel, &written_in));
    let begun = Instant::now();
    let found = loop {
        let pens = list().unwrap();
        let ours = pens.into_iter().find(|pen| [pen.vendor_id, pen.product_id].map(u32::from) == IDS);
        if let Some(pen) = ours {
            break pen;
        }
        if begun.elapsed() > Duration::from_secs(2) {
            println!("skipped: the system lists no raw HID devices");
            return;
        }
        std::thread::sleep(Duration::from_millis(50));
    };
    if !found.access.may_open() {
        println!("skipped: {} may not be opened", found.path);
        return;
    }
    let mut pen = open(&found.id).unwrap();
    assert_eq!((next(&written), next(&written)), (vec![7, 0, 0, 1], vec![7, 0, 0, 2]));
    pen.play(Play { waveform: Some(Waveform::PENCIL), intensity_percent: 70 }).unwrap();
    assert_eq!(next(&written), [7, 70, 0, 5]);
    pen.play(Play { waveform: Some(Waveform::CLICK), intensity_percent: 30 }).unwrap();
    assert_eq!(next(&written), [7, 30, 0, 3]);
    drop(pen);
    let last: Vec<Vec<u8>> = (0..3).map(|_| next(&written)).collect();
    assert_eq!(last, [vec![7, 0, 0, 1], vec![7, 0, 0, 2], vec![7, 50, 0, 4]]);
    closing.write_all(&event(DESTROY, &[])).unwrap();
}
