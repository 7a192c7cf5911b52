use proptest::prelude::{any, prop, prop_assert, prop_assert_eq, proptest};

use super::{HapticController, OfferedWaveform, ReportShape};
use crate::haptic_pen::pen::HapticPort as _;
use crate::haptic_pen::simulated::{LISTED, LISTING_PEN, STATING_PEN, SimulatedPen};
use crate::haptic_pen::waveform::{Play, Waveform};
use crate::hid::descriptor::{self, Descriptor};
use crate::hid::pen::PenDecoder;

fn parsed(bytes: &[u8]) -> Descriptor {
    let descriptor = descriptor::parse(bytes).unwrap();
    assert!(descriptor.warnings.is_empty(), "{:?}", descriptor.warnings);
    descriptor
}

fn controller(bytes: &[u8]) -> HapticController {
    HapticController::of_descriptor(&parsed(bytes)).unwrap()
}

/// The controller of the pen that lists its waveforms, and these waveforms.
fn listing() -> (HapticController, Vec<OfferedWaveform>) {
    let controller = controller(LISTING_PEN);
    let mut pen = SimulatedPen::listing();
    let shapes = controller.list_reports();
    let lists: Vec<_> = shapes.iter().map(|shape| (*shape, pen.feature(*shape).unwrap())).collect();
    let offered = controller.waveforms(&lists);
    (controller, offered)
}

fn offered(waveform: Waveform, ordinal: u16) -> OfferedWaveform {
    OfferedWaveform { waveform, ordinal }
}

#[test]
fn a_pen_that_lists_its_waveforms_is_read() {
    let (controller, found) = listing();
    assert_eq!(controller.list_reports(), [ReportShape { id: Some(8), n_bytes: 25 }]);
    assert_eq!(controller.automatic_shape(), Some(ReportShape { id: Some(7), n_bytes: 4 }));
    assert!(controller.is_automatic() && controller.has_intensity());
    assert_eq!((controller.n_entries(), controller.output_id()), (6, Some(7)));
    let expected: Vec<_> =
        LISTED[..5].iter().zip(3_u16..).map(|(waveform, ordinal)| offered(*waveform, ordinal)).collect();
    assert_eq!(found, expected, "the empty entry is left out");
}

#[test]
fn a_pen_that_states_its_waveforms_is_read_without_asking_it() {
    let controller = controller(STATING_PEN);
    assert!(controller.list_reports().is_empty() && !controller.is_automatic());
    assert_eq!(controller.waveforms(&[]), [offered(Waveform::CLICK, 3), offered(Waveform::INK, 4)]);
    assert_eq!((controller.n_entries(), controller.output_id()), (2, None));
}

/// The bytes are those that the layout of the descriptors prescribes, written by hand.
#[test]
fn reports_have_the_declared_layout() {
    let (listing, found) = listing();
    let ink = found[1];
    assert_eq!(listing.manual_report(ink, 54), Some(vec![7, 54, 0, 4]));
    assert_eq!(listing.manual_report(found[0], 200), Some(vec![7, 100, 0, 3]), "at most 100 %");
    assert_eq!(listing.stop_report(), Some(vec![7, 0, 0, 2]));
    assert_eq!(listing.automatic_report(&[7, 50, 9, 4], Some(found[4]), 30), Some(vec![7, 30, 9, 7]));
    assert_eq!(listing.automatic_report(&[7, 50, 9, 4], None, 0), Some(vec![7, 0, 9, 1]));
    // A report that is too short was cut off by the system.
    assert_eq!(listing.automatic_report(&[7], Some(ink), 100), Some(vec![7, 100, 0, 4]));
    let stating = controller(STATING_PEN);
    assert_eq!(stating.manual_report(offered(Waveform::INK, 4), 50), Some(vec![4, 64]));
    assert_eq!(stating.stop_report(), Some(vec![2, 0]));
    assert_eq!(stating.automatic_report(&[0; 8], None, 0), None);
    // An ordinal that the field cannot hold has no report.
    assert_eq!(listing.manual_report(offered(Waveform::INK, 40), 50), None);
}

#[test]
fn a_trigger_that_holds_usage_ids_gets_them() {
    let mut bytes = STATING_PEN.to_vec();
    let at = bytes.windows(6).position(|w| w == [0x15, 0x01, 0x25, 0x04, 0x09, 0x21]).unwrap();
    // Sixteen bits, 0x1001 to 0x2fff.
    let trigger = [0x75, 0x10, 0x16, 0x01, 0x10, 0x26, 0xff, 0x2f, 0x09, 0x21, 0x91, 0x02, 0x75, 0x08];
    bytes.splice(at..at + 8, trigger);
    let controller = controller(&bytes);
    assert_eq!(controller.manual_report(offered(Waveform::INK, 4), 100), Some(vec![0x0b, 0x10, 127]));
    assert_eq!(controller.stop_report(), Some(vec![0x02, 0x10, 0]));
}

#[test]
fn reports_come_back() {
    let (controller, found) = listing();
    for offered in &found {
        for percent in [1, 37, 100] {
            let play = Play { waveform: Some(offered.waveform), intensity_percent: percent };
            let report = controller.manual_report(*offered, percent).unwrap();
            assert_eq!(controller.played_by_output(&found, &report), Some(play));
            let report = controller.automatic_report(&[], Some(*offered), percent).unwrap();
            assert_eq!(controller.played_by_feature(&found, &report), None, "a report without its id");
            let report = controller.automatic_report(&[7, 0, 0, 0], Some(*offered), percent).unwrap();
            assert_eq!(controller.played_by_feature(&found, &report), Some(play));
        }
    }
    let stop = controller.stop_report().unwrap();
    assert_eq!(controller.played_by_output(&found, &stop), Some(Play::SILENCE));
    assert_eq!(controller.played_by_output(&found, &[9, 1, 1, 1]), None);
}

#[test]
fn other_devices_have_no_haptic_pen() {
    let is_haptic = |bytes: &[u8]| HapticController::of_descriptor(&parsed(bytes)).is_some();
    assert!(!is_haptic(descriptor::tests::PEN));
    // The same controller in a touch pad.
    let mut touch_pad = LISTING_PEN.to_vec();
    touch_pad[3] = 0x05;
    assert!(!is_haptic(&touch_pad));
    // Nor does a haptic pen without a position count as a pen to read.
    for bytes in [LISTING_PEN, STATING_PEN] {
        assert!(PenDecoder::of_descriptor(&parsed(bytes)).is_none());
    }
}

/// Uses everything that a descriptor declares; nothing may panic, and every report has the declared length.
fn use_all(bytes: &[u8], feature: &[u8]) -> bool {
    let Ok(declared) = descriptor::parse(bytes) else { return false };
    let Some(controller) = HapticController::of_descriptor(&declared) else { return false };
    let lists: Vec<_> =
        controller.list_reports().into_iter().map(|shape| (shape, feature.to_vec())).collect();
    let found = controller.waveforms(&lists);
    for offered in &found {
        for percent in [0, 50, 255] {
            if let Some(report) = controller.manual_report(*offered, percent) {
                assert!(controller.played_by_output(&found, &report).is_some());
            }
            if let Some(report) = controller.automatic_report(feature, Some(*offered), percent) {
                assert_eq!(report.len(), controller.automatic_shape().unwrap().n_bytes);
                controller.played_by_feature(&found, &report);
            }
        }
    }
    controller.stop_report();
    controller.automatic_report(feature, None, 0);
    controller.played_by_output(&found, feature);
    true
}

#[test]
fn the_descriptors_of_the_fixtures_are_used_completely() {
    let list = SimulatedPen::listing().feature(ReportShape { id: Some(8), n_bytes: 25 }).unwrap();
    assert!(use_all(LISTING_PEN, &list) && use_all(STATING_PEN, &[]));
}

proptest! {
    #[test]
    fn any_bytes_are_a_controller_or_none(
        bytes in prop::collection::vec(any::<u8>(), 0..200),
        feature in prop::collection::vec(any::<u8>(), 0..80),
    ) {
        use_all(&bytes, &feature);
    }

    /// Nearly right descriptors reach deeper than random bytes.
    #[test]
    fn damaged_descriptors_never_panic(
        which in any::<bool>(),
        damage in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..6),
        end in any::<prop::sample::Index>(),
        feature in prop::collection::vec(any::<u8>(), 0..80),
    ) {
        let mut bytes = if which { LISTING_PEN } else { STATING_PEN }.to_vec();
        for (index, byte) in damage {
            let at = index.index(bytes.len());
            bytes[at] = byte;
        }
        bytes.truncate(end.index(bytes.len()) + 1);
        use_all(&bytes, &feature);
    }

    /// Values of a field come back, and its neighbors stay.
    #[test]
    fn written_values_are_read_again(
        bit_size in 1_u32..=32,
        offset in 0_u32..20,
        value in any::<i32>(),
        before in prop::collection::vec(any::<u8>(), 12),
    ) {
        let bytes = [0x05, 0x0d, 0x09, 0x02, 0xa1, 0x01, 0x15, 0x81, 0x25, 0x7f, 0x75, bit_size as u8, 0x95, 0x01,
            0x09, 0x42, 0x81, 0x02, 0xc0];
        let mut field = descriptor::parse(&bytes).unwrap().reports[0].fields[0].clone();
        field.bit_offset = offset;
        let mut report = before.clone();
        prop_assert!(field.set_value(&mut report, 0, i64::from(value)));
        let shift = 32 - bit_size;
        prop_assert_eq!(field.value(&report, 0), Some(i64::from(value << shift >> shift)));
        for (bit, (now, then)) in bits(&report).zip(bits(&before)).enumerate() {
            let is_inside = (offset as usize..(offset + bit_size) as usize).contains(&bit);
            prop_assert!(is_inside || now == then, "bit {bit}");
        }
        prop_assert!(!field.set_value(&mut report, 1, 0) && !field.set_value(&mut [], 0, 0));
    }
}

fn bits(bytes: &[u8]) -> impl Iterator<Item = bool> + '_ {
    bytes.iter().flat_map(|byte| (0..8).map(move |bit| byte >> bit & 1 == 1))
}
