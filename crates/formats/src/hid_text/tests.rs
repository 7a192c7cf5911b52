use proptest::prelude::{any, prop, proptest};

use super::{
    HidRecording, HidTextError, TimedReport, bytes_of_hex, bytes_of_hex_file, is_hid_text, read_hid_text,
};

const RECORDER: &str = "\
# a comment
D: 0
R: 6 05 0d 09 02 a1 01
N: Some pen 4x5
P: usb-0000:00:1d.0-1.8/input0
I: 3 056a 0061
D: 0
E: 0.000000 3 02 90 e0
E: 000001.123456 3 02 91 E1
";

const DUMP: &str = "\
Starting dumping interrupt transfer stream
with 1 minute timeout.

001:005:000:DESCRIPTOR         1234567.100000
 05 0D 09 02
 A1 01

001:005:000:STREAM             1234567.123456
 02 90 E0

001:005:000:STREAM             1234567.131456
 02 91 E1
";

fn one(text: &str) -> HidRecording {
    let found = read_hid_text(text.as_bytes()).unwrap();
    assert_eq!(found.warnings, Vec::<String>::new());
    assert_eq!(found.value.len(), 1);
    found.value[0].clone()
}

#[test]
fn text_of_hid_recorder() {
    let device = one(RECORDER);
    assert_eq!(device.name.as_deref(), Some("Some pen 4x5"));
    assert_eq!(device.identity, Some((0x056a, 0x0061)));
    assert_eq!(device.descriptor, Some(vec![0x05, 0x0d, 0x09, 0x02, 0xa1, 0x01]));
    let report = |time_secs, bytes: &[u8]| TimedReport { time_secs, bytes: bytes.to_vec() };
    assert_eq!(device.reports, [report(0.0, &[2, 0x90, 0xe0]), report(1.123_456, &[2, 0x91, 0xe1])]);
    assert_eq!(one(&RECORDER.replace('\n', "\r\n")), device);
    assert_eq!(one(&format!("\u{feff}{RECORDER}")), device);
}

#[test]
fn text_in_utf_16_with_its_mark() {
    for order in [u16::to_le_bytes, u16::to_be_bytes] {
        let wide = |text: &str| -> Vec<u8> {
            format!("\u{feff}{}", text.replace('\n', "\r\n")).encode_utf16().flat_map(order).collect()
        };
        for text in [RECORDER, DUMP] {
            assert!(is_hid_text(&wide(text)));
            assert_eq!(read_hid_text(&wide(text)).unwrap().value, [one(text)]);
        }
        assert_eq!(bytes_of_hex_file(&wide("05 0d\n09 02\n")), Some(vec![5, 0x0d, 9, 2]));
    }
    assert_eq!(bytes_of_hex_file(&[0x05, 0x0d, 0x00, 0xff]), None);
}

#[test]
fn text_of_usbhid_dump() {
    let device = one(DUMP);
    assert_eq!(
        (device.device.as_str(), device.name.as_deref(), device.identity),
        ("001:005:000", None, None)
    );
    assert_eq!(device.descriptor, Some(vec![0x05, 0x0d, 0x09, 0x02, 0xa1, 0x01]));
    assert_eq!(device.reports.len(), 2);
    assert!((device.reports[1].time_secs - device.reports[0].time_secs - 0.008).abs() < 1e-6);
    assert_eq!(device.reports[1].bytes, [2, 0x91, 0xe1]);
}

#[test]
fn several_devices_in_one_file() {
    let text = "D: 0\nR: 2 05 0d\nD: 1\nR: 2 05 01\nI: 3 1 2\nE: 0.1 1 aa\nD: 0\nE: 0.0 1 bb\nE: 0.3 1 cc\n";
    let found = read_hid_text(text.as_bytes()).unwrap().value;
    assert_eq!(found.len(), 2);
    let bytes = |index: usize| found[index].reports.iter().map(|report| report.bytes[0]).collect::<Vec<_>>();
    assert_eq!((bytes(0), bytes(1)), (vec![0xbb, 0xcc], vec![0xaa]));
    assert_eq!((found[0].descriptor.as_deref(), found[1].identity), (Some(&[5, 0x0d][..]), Some((1, 2))));
    let dumps = DUMP.replace("001:005:000:DESCRIPTOR", "001:006:000:DESCRIPTOR");
    assert_eq!(read_hid_text(dumps.as_bytes()).unwrap().value.len(), 2);
}

#[test]
fn damaged_lines_are_left_out_with_a_warning() {
    for (damage, part) in [
        ("E: 2.0 3 02 91", "line 10 is ignored: the line states 3 bytes but has 2"),
        ("E: 2.0 3 02 91 zz", "line 10 is ignored: the bytes are not hexadecimal"),
        ("E: 2.0", "line 10 is ignored: the line ends after the time"),
        ("E: soon 1 02", "line 10 is ignored: \"soon\" is not a time"),
        ("E: nan 1 02", "line 10 is ignored: \"nan\" is not a time"),
        ("E: 0.5 1 02", "line 10 is ignored: the time decreases from 1.123456 s to 0.5 s"),
        ("I: 3 056a", "line 10 is ignored: \"3 056a\" is not a bus"),
        ("nonsense", "line 10 is ignored: \"nonsense\""),
    ] {
        let found = read_hid_text(format!("{RECORDER}{damage}\nE: 3.0 1 07\n").as_bytes()).unwrap();
        assert_eq!(found.warnings.len(), 1, "{damage}");
        assert!(found.warnings[0].starts_with(part), "{}", found.warnings[0]);
        assert_eq!(found.value[0].reports.len(), 3, "{damage}");
    }
    let found =
        read_hid_text(format!("{DUMP}\n001:005:000:STREAM 1234568.0\n 02 9Q E0\n").as_bytes()).unwrap();
    assert_eq!((found.value[0].reports.len(), found.warnings.len()), (2, 1));
    assert!(found.warnings[0].contains("not a row of hexadecimal bytes"), "{}", found.warnings[0]);
    // Further damaged lines are only counted.
    let many = read_hid_text(format!("{RECORDER}{}", "E: 1 2 3\n".repeat(1000)).as_bytes()).unwrap();
    assert_eq!(many.warnings.len(), 21);
    assert_eq!(many.warnings[20], "980 more lines are ignored");
}

#[test]
fn what_is_no_recording() {
    for text in ["", "t,x,y\n0,1,2\n", "R: some note\nE: another\n", "05 0d 09 02", "\u{0}\u{1}"] {
        assert!(!is_hid_text(text.as_bytes()), "{text}");
        assert_eq!(read_hid_text(text.as_bytes()), Err(HidTextError::NotARecording), "{text}");
    }
    assert!(!is_hid_text(&[0x05, 0x0d, 0xff, 0xfe]));
    assert!(is_hid_text(RECORDER.as_bytes()) && is_hid_text(DUMP.as_bytes()));
    let cut = "001:005:000:STREAM 12.5\n zz\n";
    assert!(matches!(read_hid_text(cut.as_bytes()), Err(HidTextError::Unreadable { line: 1, .. })));
}

#[test]
fn hexadecimal_text() {
    let bytes = Some(vec![0x05, 0x0d, 0xff]);
    for text in ["05 0d ff", "050DFF", " 0x05, 0x0d,\n0xff ", "05\n0d\tff"] {
        assert_eq!(bytes_of_hex(text), bytes, "{text}");
    }
    for text in ["", " ", "5", "05 0", "0x", "05 0g", "05;0d", "+5"] {
        assert_eq!(bytes_of_hex(text), None, "{text}");
    }
}

proptest! {
    #[test]
    fn any_text_is_a_recording_or_an_error(text in "[ 0-9a-fERDNI:.#\n\\x00-\\xff]{0,400}") {
        read_hid_text(text.as_bytes()).ok();
        is_hid_text(text.as_bytes());
    }

    #[test]
    fn any_bytes_are_a_recording_or_an_error(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        read_hid_text(&bytes).ok();
    }

    #[test]
    fn a_file_with_a_changed_byte_is_read_or_refused(at in 0..RECORDER.len(), byte in any::<u8>()) {
        for text in [RECORDER, DUMP] {
            let mut bytes = text.as_bytes().to_vec();
            bytes[at.min(text.len() - 1)] = byte;
            if let Ok(found) = read_hid_text(&bytes) {
                for pair in found.value.iter().flat_map(|device| device.reports.windows(2)) {
                    assert!(pair[0].time_secs <= pair[1].time_secs);
                }
            }
        }
    }
}
