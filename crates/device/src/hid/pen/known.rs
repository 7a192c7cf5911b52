//! Known pens whose descriptors declare only vendor-defined bytes.
//!
//! Each has a substitute descriptor here that declares the bytes correctly. The layout is that of older small Wacom
//! tablets (vendor 056A), as public drivers describe it. A recording of the PenPartner FT-0203-U confirms it: a byte of
//! switches, X, Y, and pressure of nine bits.

use crate::hid::descriptor::{self, Descriptor, Usage};
use crate::hid::pen::fields::Slot;

/// A tablet with this layout.
struct KnownTablet {
    product_id: u16,
    /// Highest X and Y.
    counts: [u16; 2],
    pressure_max: u16,
    /// Size of the active area, in units of 0.01 mm.
    ///
    /// The resolution of the Volito (1016 lines per inch) and of the Graphires (2032) is stated by the manufacturer. No
    /// document of the FT-0203-U was available: the 1016 lines of its family are assumed, while drivers assume 1270.
    size_hundredths: [u16; 2],
}

const fn tablet(
    product_id: u16,
    counts: [u16; 2],
    pressure_max: u16,
    size_hundredths: [u16; 2],
) -> KnownTablet {
    KnownTablet { product_id, counts, pressure_max, size_hundredths }
}

const VENDOR_ID: u16 = 0x056a;

const TABLETS: [KnownTablet; 7] = [
    tablet(0x10, [10_206, 7422], 511, [12_758, 9278]),
    tablet(0x11, [10_206, 7422], 511, [12_758, 9278]),
    tablet(0x12, [13_918, 10_206], 511, [17_398, 12_758]),
    tablet(0x13, [10_208, 7424], 511, [12_760, 9280]),
    tablet(0x14, [16_704, 12_064], 511, [20_880, 15_080]),
    tablet(0x60, [5104, 3712], 511, [12_760, 9280]),
    tablet(0x61, [3250, 2320], 255, [8125, 5800]),
];

/// Usage of our own for the switch that marks reports of the tablet's mouse.
const NOT_A_PEN: Usage = Usage::new(0xff00, 1);

/// Whether a device is in the table.
pub(super) fn is_known(vendor_id: u16, product_id: u16) -> bool {
    find(vendor_id, product_id).is_some()
}

/// Returns the substitute descriptor of a device, and the switch that marks reports of other tools.
pub(super) fn descriptor(vendor_id: u16, product_id: u16) -> Option<(Descriptor, Option<Slot>)> {
    let bytes = descriptor_bytes(find(vendor_id, product_id)?);
    let descriptor = descriptor::parse(&bytes).ok()?; // A test parses the whole table.
    let mut fields = descriptor.reports.iter().flat_map(|report| &report.fields);
    let not_a_pen = fields.find(|field| field.usage(0) == Some(NOT_A_PEN)).cloned().map(Slot::of_field);
    Some((descriptor, not_a_pen))
}

fn find(vendor_id: u16, product_id: u16) -> Option<&'static KnownTablet> {
    TABLETS.iter().find(|tablet| vendor_id == VENDOR_ID && tablet.product_id == product_id)
}

fn descriptor_bytes(tablet: &KnownTablet) -> Vec<u8> {
    // Digitizer page; application pen; report 2. One-bit switches: tip, two barrel buttons, two bits of padding, eraser
    // end, mouse, in range.
    let mut bytes = vec![0x05, 0x0d, 0x09, 0x02, 0xa1, 0x01, 0x85, 0x02, 0x15, 0x00, 0x25, 0x01, 0x75, 0x01];
    bytes.extend([0x95, 0x03, 0x09, 0x42, 0x09, 0x44, 0x09, 0x5a, 0x81, 0x02, 0x95, 0x02, 0x81, 0x03]);
    bytes.extend([0x95, 0x01, 0x09, 0x3c, 0x81, 0x02, 0x0b, 0x01, 0x00, 0x00, 0xff, 0x81, 0x02, 0x09, 0x32]);
    bytes.extend([0x81, 0x02]);
    // X and Y in cm × 10^-3; the usages include their page.
    bytes.extend([0x65, 0x11, 0x55, 0x0d, 0x75, 0x10]);
    for (usage, counts, hundredths) in [
        (0x30, tablet.counts[0], tablet.size_hundredths[0]),
        (0x31, tablet.counts[1], tablet.size_hundredths[1]),
    ] {
        bytes.extend([0x0b, usage, 0x00, 0x01, 0x00, 0x26]);
        bytes.extend(counts.to_le_bytes());
        bytes.push(0x46);
        bytes.extend(hundredths.to_le_bytes());
        bytes.extend([0x81, 0x02]);
    }
    // Pressure without a unit; padding up to eight bytes.
    bytes.extend([0x65, 0x00, 0x55, 0x00, 0x45, 0x00, 0x75, 0x0a, 0x09, 0x30, 0x26]);
    bytes.extend(tablet.pressure_max.to_le_bytes());
    bytes.extend([0x81, 0x02, 0x75, 0x06, 0x81, 0x03, 0xc0]);
    bytes
}

#[cfg(test)]
mod tests {
    use super::{TABLETS, VENDOR_ID};
    use crate::hid::pen::PenDecoder;

    #[test]
    fn every_tablet_of_the_table_can_be_read() {
        for tablet in &TABLETS {
            let decoder = PenDecoder::of_known(VENDOR_ID, tablet.product_id).unwrap();
            let format = decoder.best();
            let [width_m, height_m] = format.size_m().unwrap();
            assert_eq!((format.report_id, format.n_bytes), (Some(2), 8));
            // The table is rounded to 0.01 mm.
            let counts_per_mm =
                [f64::from(tablet.counts[0]) / width_m, f64::from(tablet.counts[1]) / height_m];
            for per_mm in counts_per_mm.map(|per_m| 1e-3 * per_m) {
                assert!((per_mm - 40.0).abs() < 0.01 || (per_mm - 80.0).abs() < 0.01, "{per_mm}");
            }
        }
        assert_eq!(PenDecoder::of_known(VENDOR_ID, 0), None);
        assert_eq!(PenDecoder::of_known(1, 0x61), None);
    }

    #[test]
    fn reports_as_the_tablet_sends_them() {
        let decoder = PenDecoder::of_known(VENDOR_ID, 0x61).unwrap();
        let hover = decoder.decode(&[2, 0x90, 0xe0, 0x04, 0x4c, 0x04, 0, 0]).unwrap();
        assert!(hover.in_range && !hover.touching() && !hover.inverted);
        assert!((hover.x_m.unwrap() - 1248.0 / 40e3).abs() < 1e-9);
        assert!((hover.y_m.unwrap() - 1100.0 / 40e3).abs() < 1e-9);
        let pressed = decoder.decode(&[2, 0x95, 0xe0, 0x04, 0x4c, 0x04, 0xc2, 0]).unwrap();
        assert!(pressed.touching() && pressed.barrel == [false, true]);
        assert!((pressed.pressure.unwrap() - 194.0 / 255.0).abs() < 1e-12);
        assert!(decoder.decode(&[2, 0xb1, 0, 0, 0, 0, 9, 0]).unwrap().inverted);
        assert!(!decoder.decode(&[2, 0x01, 0, 0, 0, 0, 9, 0]).unwrap().touching());
        // A report of the tablet's mouse, an empty report, another report, a truncated one.
        assert_eq!(decoder.decode(&[2, 0xd1, 0, 0, 0, 0, 9, 0]), None);
        assert_eq!(decoder.decode(&[0x63, 0x90, 0, 0, 0, 0, 0, 0]), None);
        assert_eq!(decoder.decode(&[2, 0x90, 0, 0, 0, 0, 0]), None);
        assert_eq!(decoder.decode(&[]), None);
    }
}
