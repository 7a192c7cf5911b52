use std::path::Path;

use proptest::prelude::{Strategy, any, prop, prop_assert, proptest};

use super::{Descriptor, DescriptorError, Field, MAX_DESCRIPTOR_BYTES, ReportKind, Usage, parse};
use crate::hid::pen::PenDecoder;

/// A pen: switches, padding, X and Y in cm, pressure in newtons, tilt, with pushed and popped globals.
pub(crate) const PEN: &[u8] = &[
    0x05, 0x0d, 0x09, 0x02, 0xa1, 0x01, 0x85, 0x1a, 0x09, 0x20, 0xa1,
    0x00, // page, pen, report 26, stylus
    0x15, 0x00, 0x25, 0x01, 0x75, 0x01, 0x95, 0x06, // six bits
    0x09, 0x42, 0x09, 0x44, 0x09, 0x45, 0x09, 0x3c, 0x09, 0x5a, 0x09, 0x32, 0x81, 0x02, //
    0x95, 0x02, 0x81, 0x03, // padding
    0x05, 0x01, 0xa4, 0x75, 0x10, 0x95, 0x01, 0x65, 0x11, 0x55, 0x0d, // push, 16 bits, cm/1000
    0x09, 0x30, 0x26, 0xe6, 0x51, 0x46, 0xe6, 0x51, 0x81, 0x02, // X 0 to 20966
    0x09, 0x31, 0x26, 0x6d, 0x3d, 0x46, 0x6d, 0x3d, 0x81, 0x02, // Y 0 to 15725
    0xb4, 0x05, 0x0d, 0x75, 0x10, 0x95, 0x01, // pop
    0x67, 0x11, 0xe1, 0x00, 0x00, 0x55, 0x02, 0x26, 0xff, 0x0f, 0x46, 0xb0, 0x0f, // 4095 for 4016
    0x09, 0x30, 0x81, 0x02, // pressure
    0x65, 0x14, 0x55, 0x0e, 0x16, 0xd8, 0xdc, 0x26, 0x28, 0x23, 0x36, 0xd8, 0xdc, 0x46, 0x28, 0x23, //
    0x09, 0x3d, 0x09, 0x3e, 0x95, 0x02, 0x81, 0x02, // tilts, -9000 to 9000
    0xc0, 0xc0,
];

/// A keyboard: a range of usages, an output report, an array.
const KEYBOARD: &[u8] = &[
    0x05, 0x01, 0x09, 0x06, 0xa1, 0x01, 0x05, 0x07, 0x19, 0xe0, 0x29, 0xe7, 0x15, 0x00, 0x25, 0x01, 0x75,
    0x01, 0x95, 0x08, 0x81, 0x02, 0x95, 0x01, 0x75, 0x08, 0x81, 0x01, 0x95, 0x05, 0x75, 0x01, 0x05, 0x08,
    0x19, 0x01, 0x29, 0x05, 0x91, 0x02, 0x95, 0x01, 0x75, 0x03, 0x91, 0x01, 0x95, 0x06, 0x75, 0x08, 0x26,
    0xff, 0x00, 0x05, 0x07, 0x19, 0x00, 0x2a, 0xff, 0x00, 0x81, 0x00, 0xc0,
];

/// A mouse with two reports and a usage that includes its page.
const MOUSE: &[u8] = &[
    0x05, 0x01, 0x09, 0x02, 0xa1, 0x01, 0x85, 0x01, 0x09, 0x01, 0xa1, 0x00, 0x05, 0x09, 0x19, 0x01, 0x29,
    0x03, 0x05, 0x09, 0x15, 0x00, 0x25, 0x01, 0x95, 0x03, 0x75, 0x01, 0x81, 0x02, 0x95, 0x01, 0x75, 0x05,
    0x81, 0x01, 0x05, 0x01, 0x09, 0x30, 0x09, 0x31, 0x0b, 0x38, 0x00, 0x01, 0x00, 0x15, 0x81, 0x25, 0x7f,
    0x75, 0x08, 0x95, 0x03, 0x81, 0x06, 0xc0, 0xc0, 0x06, 0x00, 0xff, 0x09, 0x01, 0xa1, 0x01, 0x85, 0x02,
    0x09, 0x02, 0x15, 0x00, 0x26, 0xff, 0x00, 0x75, 0x08, 0x95, 0x07, 0x81, 0x02, 0x09, 0x03, 0x95, 0x03,
    0xb1, 0x02, 0xc0,
];

/// A field as both parsers return it: usage, first bit, bits, logical range.
type Told = (u32, usize, usize, i64, i64);

/// A report as both parsers return it.
type ToldReport = (Option<u8>, usize, Vec<Told>);

fn ours(descriptor: &Descriptor, kind: ReportKind) -> Vec<ToldReport> {
    let told = |field: &Field| -> Vec<Told> {
        let size = field.bit_size as usize;
        let at = |i: u32| {
            let start = field.bit_offset as usize + i as usize * size;
            field.usage(i).map(|usage| (usage.0, start, size, field.logical_min, field.logical_max))
        };
        (0..field.count).filter_map(at).collect()
    };
    let mut reports: Vec<ToldReport> = descriptor
        .reports
        .iter()
        .filter(|report| report.kind == kind)
        .map(|report| {
            let variables = report.fields.iter().filter(|field| field.is_variable && !field.is_constant);
            (report.id, report.n_bits as usize, variables.flat_map(told).collect())
        })
        .collect();
    reports.sort();
    reports
}

fn theirs<R: hidreport::Report>(reports: &[R]) -> Vec<ToldReport> {
    let told = |field: &hidreport::Field| -> Option<Told> {
        let hidreport::Field::Variable(field) = field else { return None };
        let bits = field.bits.clone();
        Some((
            u32::from(field.usage),
            bits.start,
            bits.len(),
            i64::from(i32::from(field.logical_minimum)),
            i64::from(i32::from(field.logical_maximum)),
        ))
    };
    let mut reports: Vec<ToldReport> = reports
        .iter()
        .map(|report| {
            let id = report.report_id().map(u8::from);
            (id, report.size_in_bits(), report.fields().iter().filter_map(told).collect())
        })
        .collect();
    reports.sort();
    reports
}

/// Asserts that our parser and the published one agree. Returns `false` if the published parser rejects the bytes.
///
/// Two differences are intended. The published parser returns an unsigned maximum with another width. It also pushes
/// and pops usages, although they are not global items (class definition 6.2.2.7), so a vendor field after a pop may
/// have an extra usage.
fn compare(bytes: &[u8], name: &str) -> bool {
    let descriptor = parse(bytes).unwrap_or_else(|error| panic!("{name}: {error}"));
    let Ok(oracle) = hidreport::ReportDescriptor::try_from(bytes) else { return false };
    let is_same = |own: &Told, other: &Told| {
        let is_vendors = own.0 >> 16 >= 0xff00 && own.0 >> 16 == other.0 >> 16;
        // Our value is negative as a signed number of this width, and theirs ends in the same bits.
        let is_wrapped = |bits: u32| own.4 >> (bits - 1) == 1 && other.4 & ((1 << bits) - 1) == own.4;
        (own.0 == other.0 || is_vendors)
            && (own.1, own.2, own.3) == (other.1, other.2, other.3)
            && (own.4 == other.4 || own.3 >= 0 && [8, 16, 32].into_iter().any(is_wrapped))
    };
    for (kind, other) in [
        (ReportKind::Input, theirs(oracle.input_reports())),
        (ReportKind::Output, theirs(oracle.output_reports())),
        (ReportKind::Feature, theirs(oracle.feature_reports())),
    ] {
        let own = ours(&descriptor, kind);
        assert_eq!(own.len(), other.len(), "{name}: {kind:?}");
        for ((id, n_bits, own), (other_id, other_n_bits, other)) in own.iter().zip(&other) {
            assert_eq!((id, n_bits, own.len()), (other_id, other_n_bits, other.len()), "{name}: {kind:?}");
            for (own, other) in own.iter().zip(other) {
                assert!(is_same(own, other), "{name}: {kind:?} report {id:?}: {own:x?} for {other:x?}");
            }
        }
    }
    true
}

#[test]
fn the_published_parser_tells_the_same() {
    for (name, bytes) in [("pen", PEN), ("keyboard", KEYBOARD), ("mouse", MOUSE)] {
        assert!(compare(bytes, name));
    }
}

/// Descriptors of real devices, if they are available.
#[expect(clippy::print_stdout, reason = "a skipped test prints the reason")]
pub(crate) fn corpus() -> Vec<(String, Vec<u8>)> {
    let folder = std::env::var_os("SHAGREEN_DATA").map_or_else(
        || Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data"),
        std::path::PathBuf::from,
    );
    let Ok(entries) = std::fs::read_dir(folder.join("hid-descriptors")) else {
        println!("skipped: there is no ../shared/data/hid-descriptors, nor one in SHAGREEN_DATA");
        return Vec::new();
    };
    let mut found: Vec<_> = entries
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "bin"))
        .map(|path| (path.file_name().unwrap().to_string_lossy().into_owned(), std::fs::read(&path).unwrap()))
        .collect();
    found.sort();
    found
}

#[test]
fn descriptors_of_real_devices_are_read_like_the_published_parser_reads_them() {
    let corpus = corpus();
    let n_compared = corpus.iter().filter(|(name, bytes)| compare(bytes, name)).count();
    // One descriptor has a main item without a usage, which the published parser rejects.
    assert!(n_compared + 1 >= corpus.len());
}

#[test]
fn a_pen_in_all_its_fields() {
    let descriptor = parse(PEN).unwrap();
    assert_eq!(descriptor.warnings, []);
    assert_eq!(descriptor.reports.len(), 1);
    let report = &descriptor.reports[0];
    assert_eq!((report.id, report.n_bytes()), (Some(0x1a), 12));
    let pressure = report.fields.iter().find(|f| f.usage(0) == Some(Usage::new(0x0d, 0x30))).unwrap();
    let ranges = (pressure.logical_min, pressure.logical_max, pressure.physical_max);
    assert_eq!((ranges, pressure.unit, pressure.unit_exponent), ((0, 4095, 4016), 0xe111, 2));
    assert_eq!(descriptor.application_of(pressure), Some(Usage::new(0x0d, 2)));
    assert_eq!(descriptor.collections_of(pressure).count(), 2);
    let tilt = report.fields.last().unwrap();
    let bytes = [0x1a, 0, 1, 0, 2, 0, 0xff, 0x0f, 0xd8, 0xdc, 0x28, 0x23];
    assert_eq!((tilt.value(&bytes, 0), tilt.value(&bytes, 1)), (Some(-9000), Some(9000)));
    assert_eq!((tilt.value(&bytes, 2), tilt.value(&bytes[..11], 1)), (None, None));
    assert_eq!(pressure.value(&bytes, 0), Some(4095));
}

#[test]
fn the_last_usage_stands_for_all_that_follow() {
    let descriptor = parse(MOUSE).unwrap();
    let bulk = &descriptor.reports[1].fields[0];
    assert_eq!((0..7).map(|i| bulk.usage(i)).collect::<Vec<_>>(), [Some(Usage(0xff00_0002)); 7]);
    let buttons = &descriptor.reports[0].fields[0];
    assert_eq!(
        (0..3).map(|i| buttons.usage(i).unwrap().0).collect::<Vec<_>>(),
        [0x9_0001, 0x9_0002, 0x9_0003]
    );
}

#[test]
fn a_range_may_name_its_page_itself() {
    // The published parser ignores the page; the class definition (6.2.2.8) does not.
    let range = [0x1b, 0x01, 0x00, 0x09, 0x00, 0x2b, 0x03, 0x00, 0x09, 0x00];
    for items in [&range[..], &[0x1b, 0x01, 0x00, 0x09, 0x00, 0x29, 0x03]] {
        let bytes = [&[0x05, 0x01][..], items, &[0x25, 0x01, 0x75, 0x01, 0x95, 0x03, 0x81, 0x02]].concat();
        let field = parse(&bytes).unwrap().reports[0].fields[0].clone();
        assert_eq!(field.usages, [(Usage::new(9, 1), Usage::new(9, 3))]);
    }
}

#[test]
fn highest_values_whose_sign_bit_is_a_bit() {
    let field = |items: &[u8]| {
        let bytes = [&[0x05, 0x01, 0x09, 0x30, 0x75, 0x10, 0x95, 0x01][..], items, &[0x81, 0x02]].concat();
        parse(&bytes).unwrap().reports[0].fields[0].clone()
    };
    let range = |items: &[u8]| (field(items).logical_min, field(items).logical_max);
    assert_eq!(range(&[0x15, 0x00, 0x26, 0xff, 0xff]), (0, 65_535));
    assert_eq!(range(&[0x15, 0x00, 0x25, 0xff]), (0, 255));
    assert_eq!(range(&[0x15, 0x00, 0x27, 0xff, 0xff, 0xff, 0xff]), (0, 0xffff_ffff));
    assert_eq!(range(&[0x15, 0x81, 0x25, 0x7f]), (-127, 127));
    assert_eq!(range(&[0x16, 0x00, 0x80, 0x26, 0xff, 0xff]), (-32_768, -1));
    // The physical range is corrected likewise, and equals the logical range if it is absent.
    let with_physical = field(&[0x15, 0x00, 0x25, 0x7f, 0x46, 0x00, 0xff]);
    assert_eq!((with_physical.physical_min, with_physical.physical_max), (0, 0xff00));
    let without = field(&[0x15, 0x05, 0x25, 0x7f]);
    assert_eq!((without.physical_min, without.physical_max), (5, 127));
}

#[test]
fn what_real_devices_get_wrong_is_a_warning() {
    let main = [0x75, 0x08, 0x95, 0x01, 0x81, 0x02];
    for (bytes, n_warnings) in [
        // Fields without a usage; a long item; a collection without an end; a usage maximum without a minimum.
        (main.to_vec(), 1),
        ([&[0x09, 0x30, 0xfe, 0x02, 0x77, 1, 2][..], &main].concat(), 1),
        ([&[0x09, 0x30, 0xa1, 0x01, 0x09, 0x30][..], &main].concat(), 1),
        ([&[0x09, 0x30, 0x29, 0x05][..], &main].concat(), 1),
        // An item with a count of zero has no effect.
        ([&[0x09, 0x30, 0x75, 0x08, 0x95, 0x00, 0x81, 0x02, 0x09, 0x30][..], &main].concat(), 0),
        // The first of several delimited usages is used.
        ([&[0xa9, 0x01, 0x09, 0x30, 0x09, 0x31, 0xa9, 0x00][..], &main].concat(), 0),
    ] {
        let descriptor = parse(&bytes).unwrap();
        assert_eq!(descriptor.warnings.len(), n_warnings, "{bytes:x?} {:?}", descriptor.warnings);
        assert_eq!(descriptor.reports[0].n_bits, 8);
        if n_warnings == 0 {
            assert_eq!(descriptor.reports[0].fields[0].usage(0), Some(Usage(0x30)));
        }
    }
}

#[test]
fn what_cannot_be_is_one_error_with_its_place() {
    let offset_of = |bytes: &[u8]| match parse(bytes) {
        Err(DescriptorError::Item { offset, .. } | DescriptorError::CutOff { offset }) => offset,
        other => panic!("{other:?}"),
    };
    assert_eq!(parse(&[]), Err(DescriptorError::Empty));
    assert_eq!(parse(&[0x05, 0x01]), Err(DescriptorError::NoReport));
    let n_bytes = MAX_DESCRIPTOR_BYTES + 1;
    assert_eq!(parse(&vec![0; n_bytes]), Err(DescriptorError::TooLong { n_bytes }));
    assert_eq!(offset_of(&[0x05, 0x01, 0x26, 0xff]), 2);
    assert_eq!(offset_of(&[0x05, 0x01, 0xfe, 0x09, 0x00]), 2);
    assert_eq!(offset_of(&[0x05, 0x01, 0xc0]), 2);
    assert_eq!(offset_of(&[0x05, 0x01, 0xb4]), 2);
    assert_eq!(offset_of(&[0x85, 0x00]), 0);
    assert_eq!(offset_of(&[0x86, 0x00, 0x01]), 0);
    assert_eq!(offset_of(&[0x77, 0xff, 0xff, 0xff, 0xff]), 0);
    assert_eq!(offset_of(&[0x97, 0xff, 0xff, 0xff, 0x7f]), 0);
    assert_eq!(offset_of(&[0x76, 0xff, 0xff, 0x96, 0xff, 0xff, 0x81, 0x02]), 6);
    assert_eq!(offset_of(&[0xa0; 100]), 64);
    assert_eq!(offset_of(&[0xa4; 100]), 64);
}

#[test]
fn what_makes_the_published_parser_panic_does_not_make_ours() {
    let bytes = [
        0x09, 0x02, 0xa1, 0x01, 0x01, 0x85, 0x01, 0x09, 0x01, 0xa1, 0x00, 0x05, 0x09, 0x19, 0x00, 0x46, 0x58,
        0x19, 0x26, 0x05, 0x01, 0x09, 0x05, 0x09,
    ];
    assert!(parse(&bytes).is_err());
}

/// Number of elements in a descriptor, as a measure of its memory.
fn n_things(descriptor: &Descriptor) -> usize {
    let fields = descriptor.reports.iter().flat_map(|report| &report.fields);
    descriptor.collections.len()
        + descriptor.warnings.len()
        + descriptor.reports.len()
        + fields.map(|field| 1 + field.usages.len()).sum::<usize>()
}

/// Runs everything that the program does with a descriptor and a report.
fn exercise(bytes: &[u8], report: &[u8]) -> Result<(), proptest::test_runner::TestCaseError> {
    let Ok(descriptor) = parse(bytes) else { return Ok(()) };
    prop_assert!(n_things(&descriptor) <= 2 * bytes.len() + 2);
    for field in descriptor.reports.iter().flat_map(|report| &report.fields) {
        for index in [0, 1, field.count.saturating_sub(1), u32::MAX] {
            field.value(report, index);
            field.usage(index);
        }
        prop_assert!(descriptor.collections_of(field).count() <= descriptor.collections.len());
    }
    if let Some(decoder) = PenDecoder::of_descriptor(&descriptor) {
        for format in decoder.formats() {
            let id = [format.report_id.unwrap_or(0)];
            if let Some(pen) = decoder.decode(&[&id[..], report].concat()) {
                prop_assert!((0.0..=1.0).contains(&pen.x_share) && (0.0..=1.0).contains(&pen.y_share));
                prop_assert!(pen.pressure.is_none_or(|pressure| (0.0..=1.0).contains(&pressure)));
                let numbers = [pen.x_m, pen.y_m, pen.force_n, pen.tilt_x_rad, pen.distance_m, pen.clock_secs];
                prop_assert!(numbers.into_iter().flatten().all(f64::is_finite));
            }
        }
    }
    Ok(())
}

/// A descriptor with some bytes changed, removed or repeated.
fn mutated() -> impl Strategy<Value = Vec<u8>> {
    let source = prop::sample::select(vec![PEN, KEYBOARD, MOUSE]);
    let edits = prop::collection::vec((any::<prop::sample::Index>(), any::<u8>(), 0..4_u8), 1..8);
    (source, edits).prop_map(|(source, edits)| {
        let mut bytes = source.to_vec();
        for (index, byte, kind) in edits {
            if bytes.is_empty() {
                break;
            }
            let at = index.index(bytes.len());
            match kind {
                0 => bytes[at] = byte,
                1 => bytes[at] ^= 1 << (byte % 8),
                2 => {
                    bytes.remove(at);
                }
                _ => bytes.extend_from_within(at..),
            }
        }
        bytes
    })
}

proptest! {
    #[test]
    fn any_bytes_are_a_descriptor_or_an_error(
        bytes in prop::collection::vec(any::<u8>(), 0..600),
        report in prop::collection::vec(any::<u8>(), 0..80),
    ) {
        exercise(&bytes, &report)?;
    }

    #[test]
    fn mutations_of_descriptors_are_harmless(
        bytes in mutated(),
        report in prop::collection::vec(any::<u8>(), 0..80),
    ) {
        exercise(&bytes, &report)?;
    }
}
