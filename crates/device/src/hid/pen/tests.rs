use hidreport::Report as _;

use super::PenDecoder;
use crate::hid::descriptor::parse;
use crate::hid::descriptor::tests::{PEN, corpus};

fn decoder(bytes: &[u8]) -> Option<PenDecoder> {
    PenDecoder::of_descriptor(&parse(bytes).unwrap())
}

/// A descriptor with one application collection of switches, 16-bit X and Y, and further items, without report ids.
fn simple(page: u16, application: u8, more: &[u8]) -> Vec<u8> {
    let [low, high] = page.to_le_bytes();
    let start =
        [0x06, low, high, 0x09, application, 0xa1, 0x01, 0x05, 0x0d, 0x15, 0x00, 0x25, 0x01, 0x75, 0x01];
    let switches = [0x95, 0x02, 0x09, 0x42, 0x09, 0x32, 0x81, 0x02, 0x95, 0x06, 0x81, 0x03];
    let axes = [
        0x05, 0x01, 0x75, 0x10, 0x95, 0x02, 0x26, 0xff, 0x7f, 0x09, 0x30, 0x09, 0x31, 0x81, 0x02, 0x95, 0x01,
    ];
    [&start[..], &switches, &axes, more, &[0xc0]].concat()
}

/// Pressure up to 8191 in 16 bits.
const PRESSURE: [u8; 9] = [0x05, 0x0d, 0x26, 0xff, 0x1f, 0x09, 0x30, 0x81, 0x02];

fn check(found: Option<f64>, expected: f64) {
    let found = found.unwrap();
    assert!((found - expected).abs() <= 1e-12, "{found} for {expected}");
}

#[test]
fn a_report_in_si_units() {
    let decoder = decoder(PEN).unwrap();
    let format = decoder.best();
    assert_eq!((format.report_id, format.n_bytes, format.has_tilt), (Some(0x1a), 12, true));
    assert_eq!((format.x.logical_max, format.y.logical_max), (20_966, 15_725));
    check(format.x.side_m, 0.209_66);
    check(format.y.side_m, 0.157_25);
    let pressure = format.pressure.unwrap();
    assert_eq!((pressure.bits, pressure.logical_max), (16, 4095));
    check(pressure.full_n, 4.016);
    // Tip and in range; X 10483, Y 15725, pressure 2048, tilts of 45 and -60 degrees.
    let bytes = [0x1a, 0x21, 0xf3, 0x28, 0x6d, 0x3d, 0x00, 0x08, 0x94, 0x11, 0x90, 0xe8];
    let report = decoder.decode(&bytes).unwrap();
    assert!(report.touching() && report.tip && !report.eraser && report.barrel == [false; 2]);
    check(report.x_m, 0.104_83);
    check(report.y_m, 0.157_25);
    check(Some(report.y_share), 1.0);
    check(report.pressure, 2048.0 / 4095.0);
    check(report.force_n, 2048.0 / 4095.0 * 4.016);
    check(report.tilt_x_rad, std::f64::consts::FRAC_PI_4);
    check(report.tilt_y_rad, -std::f64::consts::FRAC_PI_3);
    assert_eq!((report.distance_m, report.clock_secs, report.twist_rad), (None, None, None));
    // Eraser, both buttons, and out of range, where nothing touches.
    let switches = |byte: u8| decoder.decode(&[&[0x1a, byte][..], &bytes[2..]].concat()).unwrap();
    assert!(switches(0x2c).eraser && switches(0x2c).inverted && switches(0x2c).touching());
    assert_eq!(switches(0x32).barrel, [true; 2]);
    assert!(!switches(0x01).touching());
}

#[test]
fn reports_that_are_none_of_the_pens() {
    let decoder = decoder(PEN).unwrap();
    for bytes in [&[][..], &[0x1a], &[0x1a; 11], &[0x19; 12], &[0; 64]] {
        assert_eq!(decoder.decode(bytes), None, "{bytes:?}");
    }
    // A longer report is a padded one.
    assert_eq!(decoder.decode(&[0x1a; 12]), decoder.decode(&[0x1a; 5000]));
}

#[test]
fn values_beyond_the_range_are_pulled_in_unless_that_means_that_there_are_none() {
    let bytes = [0x1a, 0x21, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0, 0, 0, 0];
    let report = decoder(PEN).unwrap().decode(&bytes).unwrap();
    assert_eq!((report.x_share, report.y_share, report.pressure), (1.0, 1.0, Some(1.0)));
    check(report.force_n, 4.016);
    let null = PEN
        .iter()
        .enumerate()
        .map(|(i, byte)| if i > 0 && PEN[i - 1] == 0x81 && *byte == 2 { 0x42 } else { *byte });
    let null: Vec<u8> = null.collect();
    assert_eq!(decoder(&null).unwrap().decode(&bytes), None);
}

#[test]
fn pens_and_what_is_none() {
    let is_pen = |page, application, more: &[u8]| decoder(&simple(page, application, more)).is_some();
    // A pen without pressure; a generic digitizer with and without; vendor-defined; a mouse with pressure.
    assert!(is_pen(0x0d, 0x02, &[]));
    assert!(is_pen(0x0d, 0x01, &PRESSURE) && !is_pen(0x0d, 0x01, &[]));
    assert!(is_pen(0xff00, 0x01, &PRESSURE) && !is_pen(0xff00, 0x01, &[]));
    assert!(is_pen(0x01, 0x02, &PRESSURE) && !is_pen(0x01, 0x02, &[]));
    // Touch screen, touch pad, multi-axis puck, with or without pressure.
    for application in [0x04, 0x05, 0x07] {
        assert!(!is_pen(0x0d, application, &[]) && !is_pen(0x0d, application, &PRESSURE));
    }
    let format = decoder(&simple(0x0d, 0x02, &[])).unwrap();
    assert_eq!((format.best().report_id, format.best().pressure, format.best().size_m()), (None, None, None));
    // A mouse has relative X and Y.
    let mut relative = simple(0x0d, 0x02, &PRESSURE);
    let at = relative.windows(4).position(|w| w == [0x09, 0x31, 0x81, 0x02]).unwrap();
    relative[at + 3] = 0x06;
    assert_eq!(decoder(&relative), None);
}

#[test]
fn a_makers_copy_of_the_usages_is_read_like_the_original() {
    // All usages are on page FF0D: switches, X (0130), Y (0131), pressure.
    let bytes = [
        &[0x06, 0x0d, 0xff, 0x09, 0x01, 0xa1, 0x01, 0x15, 0x00, 0x25, 0x01, 0x75, 0x01, 0x95, 0x02][..],
        &[0x09, 0x42, 0x09, 0x32, 0x81, 0x02, 0x95, 0x06, 0x81, 0x03, 0x75, 0x18, 0x95, 0x01],
        &[0x27, 0x78, 0xcd, 0x00, 0x00, 0x0a, 0x30, 0x01, 0x81, 0x02, 0x0a, 0x31, 0x01, 0x81, 0x02],
        &[0x75, 0x10, 0x26, 0xff, 0x1f, 0x09, 0x30, 0x81, 0x02, 0xc0],
    ]
    .concat();
    let decoder = decoder(&bytes).unwrap();
    let report = decoder.decode(&[0x03, 0xbc, 0x66, 0x00, 0, 0, 0, 0xff, 0x1f]).unwrap();
    assert!(report.touching());
    assert_eq!((report.x_share, report.y_share, report.pressure), (0.5, 0.0, Some(1.0)));
}

#[test]
fn a_size_that_is_given_counts() {
    let size = Some([0.2, 0.1]);
    for bytes in [&simple(0x0d, 0x02, &[])[..], PEN] {
        let given = decoder(bytes).unwrap().with_size_m(size);
        assert_eq!(given.best().size_m(), size);
        assert_eq!(given.clone().with_size_m(None), given);
    }
}

#[test]
fn one_length_for_everything_is_doubtful() {
    // Some tablets of 279 × 174 mm declare this: 2048 thousandths of an inch (cubic inch) for X, Y and pressure.
    let mut bytes = simple(0x0d, 0x02, &PRESSURE);
    let at = bytes.windows(2).position(|w| w == [0x05, 0x01]).unwrap();
    bytes.splice(at..at, [0x65, 0x33, 0x55, 0x0d, 0x46, 0x00, 0x08]);
    let found = decoder(&bytes).unwrap();
    assert!(found.best().is_size_doubtful);
    check(found.best().x.side_m, 2.048 * 0.0254);
    assert!(!found.with_size_m(Some([0.279, 0.174])).best().is_size_doubtful);
    assert!(!decoder(PEN).unwrap().best().is_size_doubtful);
}

/// Every real descriptor is parsed; pens are those with position and pressure according to another parser.
#[test]
fn pens_among_real_devices() {
    let (mut n_pens, mut n_sizes, mut n_forces) = (0, 0, 0);
    let corpus = corpus();
    for (name, bytes) in &corpus {
        let found = decoder(bytes);
        let Ok(oracle) = hidreport::ReportDescriptor::try_from(&bytes[..]) else { continue };
        let usages = |report: &dyn Fn() -> Vec<u32>| {
            [0x1_0030, 0x1_0031, 0xd_0030].iter().all(|u| report().contains(u))
        };
        let is_pen = oracle.input_reports().iter().any(|report| {
            usages(&|| {
                let fields = report.fields().iter().filter_map(|field| match field {
                    hidreport::Field::Variable(field) => Some(u32::from(field.usage)),
                    _ => None,
                });
                fields.collect()
            })
        });
        assert_eq!(found.as_ref().is_some_and(|decoder| decoder.best().pressure.is_some()), is_pen, "{name}");
        let Some(decoder) = found else { continue };
        n_pens += 1;
        let format = decoder.best();
        n_sizes += u32::from(format.size_m().is_some());
        n_forces +=
            u32::from(decoder.formats().iter().any(|f| f.pressure.is_some_and(|p| p.full_n.is_some())));
        if let Some([width_m, height_m]) = format.size_m() {
            assert!(
                (0.05..0.7).contains(&width_m) && (0.03..0.5).contains(&height_m),
                "{name}: {width_m} {height_m}"
            );
        }
        compare_values(&decoder, &oracle, name);
    }
    if corpus.len() == 123 {
        // One more descriptor is rejected by the other parser.
        assert_eq!((n_pens, n_sizes, n_forces), (70, 69, 2));
    }
}

/// Asserts that both parsers extract the same values from reports of random bytes.
fn compare_values(decoder: &PenDecoder, oracle: &hidreport::ReportDescriptor, name: &str) {
    let mut seed = 1_u32;
    for format in decoder.formats() {
        let id = format.report_id.map(hidreport::ReportId::from);
        let Some(report) = oracle.input_reports().iter().find(|report| *report.report_id() == id) else {
            panic!("{name}: {id:?}");
        };
        for _ in 0..50 {
            let mut bytes: Vec<u8> = (0..format.n_bytes)
                .map(|_| {
                    seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                    (seed >> 24) as u8
                })
                .collect();
            if let Some(id) = format.report_id {
                bytes[0] = id;
            }
            let Some(pen) = decoder.decode(&bytes) else { continue };
            let share = |usage: u32| {
                report.fields().iter().find_map(|field| match field {
                    hidreport::Field::Variable(field) if u32::from(field.usage) == usage => {
                        let (low, high) =
                            (i32::from(field.logical_minimum), i32::from(field.logical_maximum));
                        let value = i32::from(field.extract(&bytes).unwrap());
                        Some((f64::from(value - low) / f64::from(high - low)).clamp(0.0, 1.0))
                    }
                    _ => None,
                })
            };
            for (usage, own) in
                [(0x1_0030, Some(pen.x_share)), (0x1_0031, Some(pen.y_share)), (0xd_0030, pen.pressure)]
            {
                if let (Some(other), Some(own)) = (share(usage), own) {
                    assert!((own - other).abs() < 1e-12, "{name}: {usage:x} is {own} for {other}");
                }
            }
        }
    }
}
