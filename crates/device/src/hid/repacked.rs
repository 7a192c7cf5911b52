//! Reports of a pen whose system states their values, but neither their layout nor the report descriptor.
//!
//! Windows reads the reports of pens itself and translates them for programs. The values are packed into reports of a
//! layout of our own here, together with its descriptor, so that such a pen is decoded like any other.

use crate::hid::descriptor::Usage;

/// A field of a pen, as the system describes it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SystemField {
    /// Meaning of the field.
    pub usage: Usage,
    /// Size of the field in the pen's own report, in bits, at most 32.
    pub bit_size: u32,
    /// Lowest and highest value.
    pub logical: [i32; 2],
    /// Physical value of the lowest and of the highest value.
    pub physical: [i32; 2],
    /// Unit code of HID.
    pub unit: u32,
    /// Power of ten of the unit, as the descriptor of the pen encodes it.
    pub unit_exponent: u32,
}

/// Layout of our own for the values and switches of a pen.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Repacked {
    fields: Vec<SystemField>,
    switches: Vec<Usage>,
}

impl Repacked {
    /// A layout for these fields, and switches of one bit. Fields of more than 32 bits are left out: they are no
    /// numbers.
    pub fn new(fields: Vec<SystemField>, switches: Vec<Usage>) -> Self {
        let fields = fields.into_iter().filter(|field| (1..=32).contains(&field.bit_size)).collect();
        Self { fields, switches }
    }

    /// The report descriptor of the layout: a pen without report ids, switches first, then numbers of 32 bits.
    pub fn descriptor(&self) -> Vec<u8> {
        let long = |prefix: u8, value: u32| std::iter::once(prefix).chain(value.to_le_bytes());
        // Application: pen. Physical: stylus. Switches are 0 or 1.
        let mut bytes = vec![0x05, 0x0d, 0x09, 0x02, 0xa1, 0x01, 0x09, 0x20, 0xa1, 0x00];
        bytes.extend([0x15, 0x00, 0x25, 0x01, 0x75, 0x01, 0x95, 0x01]);
        for switch in &self.switches {
            bytes.extend(long(0x0b, switch.0));
            bytes.extend([0x81, 0x02]);
        }
        let n_padding = self.switches.len().next_multiple_of(8) - self.switches.len();
        if n_padding > 0 {
            bytes.extend([0x95, n_padding as u8, 0x81, 0x03, 0x95, 0x01]);
        }
        bytes.extend([0x75, 0x20]);
        for field in &self.fields {
            let [low, high] = field.logical.map(i32::cast_unsigned);
            let [physical_low, physical_high] = field.physical.map(i32::cast_unsigned);
            let items = [(0x17, low), (0x27, high), (0x37, physical_low), (0x47, physical_high)];
            bytes.extend(items.into_iter().flat_map(|(prefix, value)| long(prefix, value)));
            bytes.extend(long(0x67, field.unit).chain(long(0x57, field.unit_exponent)));
            bytes.extend(long(0x0b, field.usage.0).chain([0x81, 0x02]));
        }
        bytes.extend([0xc0, 0xc0]);
        bytes
    }

    /// A report with the values that `value` returns for the fields, and the switches that are `on`. A value that is
    /// missing is zero. Values are the bits of the pen's own report.
    pub fn report(&self, value: impl Fn(&SystemField) -> Option<u32>, on: &[Usage]) -> Vec<u8> {
        let mut report = vec![0; self.switches.len().div_ceil(8)];
        for (index, switch) in self.switches.iter().enumerate() {
            if on.contains(switch) {
                report[index / 8] |= 1 << (index % 8);
            }
        }
        for field in &self.fields {
            let bits = value(field).unwrap_or(0);
            report.extend(field.sign_extended(bits).to_le_bytes());
        }
        report
    }

    /// The fields of the layout.
    pub fn fields(&self) -> &[SystemField] {
        &self.fields
    }

    /// The switches of the layout.
    pub fn switches(&self) -> &[Usage] {
        &self.switches
    }
}

impl SystemField {
    /// The number in these bits: negative if the field has negative values and its highest bit is set.
    fn sign_extended(&self, bits: u32) -> i32 {
        let shift = 32 - self.bit_size.clamp(1, 32);
        let shifted = bits << shift;
        if self.logical[0] < 0 { shifted.cast_signed() >> shift } else { (shifted >> shift).cast_signed() }
    }
}

#[cfg(test)]
mod tests {
    use super::{Repacked, SystemField, Usage};
    use crate::hid::descriptor;
    use crate::hid::pen::PenDecoder;
    use crate::pen_backend::PositionUnit;

    const TIP: Usage = Usage::new(0x0d, 0x42);
    const IN_RANGE: Usage = Usage::new(0x0d, 0x32);
    const PRESSURE: Usage = Usage::new(0x0d, 0x30);
    const TILT_X: Usage = Usage::new(0x0d, 0x3d);
    const TILT_Y: Usage = Usage::new(0x0d, 0x3e);

    fn field(usage: Usage, bit_size: u32, logical: [i32; 2], physical: [i32; 2]) -> SystemField {
        SystemField { usage, bit_size, logical, physical, unit: 0, unit_exponent: 0 }
    }

    /// A pen as a system would describe it: 209.66 mm × 157.25 mm, 4096 levels of pressure, tilt of ±90°.
    fn pen() -> Repacked {
        let side = |id: u16, most: i32| SystemField {
            unit: 0x11,
            unit_exponent: 0x0d,
            ..field(Usage::new(1, id), 16, [0, most], [0, most])
        };
        let tilt = |usage| SystemField {
            unit: 0x14,
            unit_exponent: 0x0e,
            ..field(usage, 16, [-9000, 9000], [-9000, 9000])
        };
        let pressure = field(PRESSURE, 12, [0, 4095], [0, 4095]);
        let fields = vec![side(0x30, 20_966), side(0x31, 15_725), pressure, tilt(TILT_X), tilt(TILT_Y)];
        Repacked::new(fields, vec![TIP, IN_RANGE])
    }

    #[test]
    fn a_repacked_pen_is_decoded_like_any_other() {
        let pen = pen();
        let bytes = pen.descriptor();
        let declared = descriptor::parse(&bytes).unwrap();
        assert!(declared.warnings.is_empty(), "{:?}", declared.warnings);
        let decoder = PenDecoder::of_descriptor(&declared).unwrap();
        let best = decoder.best();
        let [width_m, height_m] = best.size_m().unwrap();
        assert!((width_m - 0.209_66).abs() < 1e-9 && (height_m - 0.157_25).abs() < 1e-9);
        let provides = best.provides();
        assert_eq!(provides.position, Some(PositionUnit::Millimeters));
        assert_eq!((provides.pressure, provides.tilt, provides.clock), (Some(true), Some(true), Some(false)));
        let value = |field: &SystemField| match field.usage.id() {
            0x30 if field.usage.page() == 1 => Some(10_483),
            0x31 => Some(15_725),
            0x30 => Some(2048),
            0x3d => Some(0xffff - 4499), // −4500 in 16 bits.
            _ => None,
        };
        let report = pen.report(value, &[IN_RANGE, TIP]);
        let decoded = decoder.decode(&report).unwrap();
        assert!((decoded.x_share - 0.5).abs() < 1e-9 && decoded.y_share == 1.0);
        assert!((decoded.pressure.unwrap() - 2048.0 / 4095.0).abs() < 1e-9);
        assert!((decoded.tilt_x_rad.unwrap() + 45.0_f64.to_radians()).abs() < 1e-9);
        assert!(decoded.tip && decoded.in_range);
        let lifted = decoder.decode(&pen.report(value, &[])).unwrap();
        assert!(!lifted.tip && !lifted.in_range);
    }

    #[test]
    fn a_published_parser_reads_the_descriptor_too() {
        let bytes = pen().descriptor();
        let theirs = hidreport::ReportDescriptor::try_from(bytes.as_slice()).unwrap();
        let ours = descriptor::parse(&bytes).unwrap();
        assert_eq!((theirs.input_reports().len(), ours.reports.len()), (1, 1));
        // Two switches, six bits of padding, five numbers of 32 bits.
        assert_eq!(ours.reports[0].n_bits, 8 + 5 * 32);
    }

    #[test]
    fn numbers_keep_their_sign_and_long_fields_are_left_out() {
        let signed = field(TILT_X, 8, [-127, 127], [0, 0]);
        for (bits, expected) in [(0x7f, 127), (0x80, -128), (0xff, -1), (0x1ff, -1), (0, 0)] {
            assert_eq!(signed.sign_extended(bits), expected);
        }
        let unsigned = field(PRESSURE, 8, [0, 255], [0, 0]);
        assert_eq!((unsigned.sign_extended(0xff), unsigned.sign_extended(0x1ff)), (255, 255));
        let long = field(PRESSURE, 64, [0, 1], [0, 0]);
        assert!(Repacked::new(vec![long], Vec::new()).fields().is_empty());
        // Whatever a system states, the descriptor is valid or an error of the parser.
        for n_switches in [0, 1, 7, 8, 9, 200] {
            let switches = (0..n_switches).map(|id| Usage::new(0x0d, id)).collect();
            let all = Repacked::new(vec![signed, unsigned], switches);
            let bytes = all.descriptor();
            let declared = descriptor::parse(&bytes).unwrap();
            assert_eq!(declared.reports[0].n_bytes(), all.report(|_| None, &[]).len());
        }
    }
}
