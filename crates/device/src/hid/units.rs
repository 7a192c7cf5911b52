//! Physical quantities of a field in SI units, if the descriptor declares them and they are plausible.

use crate::hid::descriptor::Field;

/// Plausible range for the side length of an active area, in m.
const SIDES_M: (f64, f64) = (0.01, 2.0);
/// Plausible range for the full force of a pen, in N.
const FULL_FORCES_N: (f64, f64) = (0.5, 50.0);
/// Longest plausible period of a clock, in s; the shortest tick is [`SHORTEST_TICK_SECS`].
const LONGEST_ROUND_SECS: f64 = 1e7;
/// Shortest plausible tick of a clock, in s.
const SHORTEST_TICK_SECS: f64 = 1e-7;
/// Length of an inch, in m.
const INCH_M: f64 = 0.0254;
/// One slug inch per second squared in N: the unit of force in HID's English system.
const SLUG_INCH_PER_S2_N: f64 = 14.593_903 * INCH_M;

/// Linear map from the values of a field to a physical quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Scale {
    at_zero: f64,
    per_count: f64,
}

impl Scale {
    /// Returns the quantity for a value.
    pub(crate) fn of(self, value: i64) -> f64 {
        self.at_zero + self.per_count * value as f64
    }

    /// Change of the quantity from one value to the next.
    pub(crate) fn per_count(self) -> f64 {
        self.per_count
    }
}

/// Unit system of HID. The SI and the English system each have a rotation variant for angles.
#[derive(Clone, Copy, PartialEq, Eq)]
enum System {
    Centimeters,
    Radians,
    Inches,
    Degrees,
}

fn system(unit: u32) -> Option<System> {
    match unit & 0xf {
        1 => Some(System::Centimeters),
        2 => Some(System::Radians),
        3 => Some(System::Inches),
        4 => Some(System::Degrees),
        _ => None,
    }
}

/// Linear map through the ends of the logical and the physical range, times `factor` and the power of ten.
fn scale(field: &Field, factor: f64) -> Option<Scale> {
    let counts = field.logical_max - field.logical_min;
    if counts <= 0 || field.physical_max <= field.physical_min {
        return None;
    }
    let factor = factor * 10_f64.powi(field.unit_exponent);
    let per_count = factor * (field.physical_max - field.physical_min) as f64 / counts as f64;
    let at_zero = factor * field.physical_min as f64 - per_count * field.logical_min as f64;
    Some(Scale { at_zero, per_count })
}

fn is_within(value: f64, (low, high): (f64, f64)) -> bool {
    (low..=high).contains(&value)
}

/// Length of an axis in m, from its lowest to its highest value.
///
/// Many descriptors declare cubic inches (0x33) but mean inches, so the exponent of the length is ignored.
pub(crate) fn side_m(field: &Field) -> Option<f64> {
    let meters = length_m(field.unit)?;
    let side_m = scale(field, meters)?.per_count * (field.logical_max - field.logical_min) as f64;
    is_within(side_m, SIDES_M).then_some(side_m)
}

/// Map to a distance in m.
pub(crate) fn distance_scale(field: &Field) -> Option<Scale> {
    scale(field, length_m(field.unit)?)
}

fn length_m(unit: u32) -> Option<f64> {
    // The unit is a length alone, without mass or time.
    let is_length = unit & 0xf0 != 0 && unit & !0xff == 0;
    match system(unit)? {
        System::Centimeters if is_length => Some(0.01),
        System::Inches if is_length => Some(INCH_M),
        _ => None,
    }
}

/// Map to a force in N.
pub(crate) fn force_scale(field: &Field) -> Option<Scale> {
    /// Unit code of length × mass / time².
    const FORCE: u32 = 0xe110;
    let newtons = match system(field.unit)? {
        System::Centimeters if field.unit & !0xf == FORCE => 1e-5,
        System::Inches if field.unit & !0xf == FORCE => SLUG_INCH_PER_S2_N,
        _ => return None,
    };
    let scale = scale(field, newtons)?;
    is_within(scale.of(field.logical_max), FULL_FORCES_N).then_some(scale)
}

/// Map to an angle in rad. Without a unit, a range up to 360 is read as degrees, and a larger one as hundredths of a
/// degree.
pub(crate) fn angle_scale(field: &Field) -> Option<Scale> {
    let degree = 1_f64.to_radians();
    match system(field.unit) {
        Some(System::Radians) => scale(field, 1.0),
        Some(System::Degrees) => scale(field, degree),
        // Some devices keep the unit of length of the previous field here, so it is ignored.
        _ => {
            let end = field.physical_max.abs().max(field.physical_min.abs()) as f64;
            let per_unit = if end <= 360.0 { degree } else { 0.01 * degree };
            scale(field, per_unit * 10_f64.powi(-field.unit_exponent))
        }
    }
}

/// Map to a time in s. Without a unit, a scan time counts 0.1 ms, as Windows requires of pens.
pub(crate) fn time_scale(field: &Field) -> Option<Scale> {
    /// Unit code of time alone, in any unit system.
    const TIME: u32 = 0x1000;
    let scale = match field.unit {
        unit if unit & !0xf == TIME => scale(field, 1.0)?,
        // Some devices keep another unit of the previous field here, so it is ignored.
        _ => Scale { at_zero: 0.0, per_count: 1e-4 },
    };
    let round_secs = scale.per_count * (field.logical_max - field.logical_min) as f64;
    (scale.per_count >= SHORTEST_TICK_SECS && round_secs <= LONGEST_ROUND_SECS).then_some(scale)
}

#[cfg(test)]
mod tests {
    use super::{angle_scale, distance_scale, force_scale, side_m, time_scale};
    use crate::hid::descriptor::{Field, parse};

    /// A field of 16 bits with these ranges and this unit.
    fn field(logical: (i16, i32), physical: (i16, i32), unit: u16, exponent: u8) -> Field {
        let mut bytes = vec![0x05, 0x01, 0x09, 0x30, 0x75, 0x10, 0x95, 0x01, 0x55, exponent];
        for (prefix, value) in [(0x16, logical.0), (0x36, physical.0), (0x66, unit.cast_signed())] {
            bytes.push(prefix);
            bytes.extend(value.to_le_bytes());
        }
        for (prefix, value) in [(0x27, logical.1), (0x47, physical.1)] {
            bytes.push(prefix);
            bytes.extend(value.to_le_bytes());
        }
        bytes.extend([0x81, 0x02]);
        parse(&bytes).unwrap().reports[0].fields[0].clone()
    }

    fn check(found: Option<f64>, expected: f64) {
        let found = found.unwrap();
        // The tolerance covers sums and products of a few numbers.
        assert!((found - expected).abs() <= 1e-12 * expected.abs().max(1e-3), "{found} for {expected}");
    }

    #[test]
    fn sides_in_centimeters_and_inches() {
        check(side_m(&field((0, 20_966), (0, 20_966), 0x11, 0x0d)), 0.209_66);
        check(side_m(&field((0, 20_966), (0, 20_966), 0x11, 0xfd)), 0.209_66);
        check(side_m(&field((0, 32_767), (0, 10_000), 0x13, 0x0d)), 0.254);
        check(side_m(&field((0, 32_767), (0, 10_000), 0x33, 0x0d)), 0.254);
        check(side_m(&field((-100, 100), (0, 200), 0x11, 0x0f)), 0.2);
        // Without a physical range, the logical range applies.
        check(side_m(&field((0, 2000), (0, 0), 0x11, 0x0e)), 0.2);
    }

    #[test]
    fn sides_that_cannot_be_are_not_believed() {
        for (unit, exponent) in [(0, 0x0d), (0x11, 0x00), (0x11, 0x09), (0xe111, 0x0d), (0x14, 0x0d)] {
            assert_eq!(side_m(&field((0, 20_966), (0, 20_966), unit, exponent)), None, "{unit:x} {exponent}");
        }
        assert_eq!(side_m(&field((100, 100), (0, 20_966), 0x11, 0x0d)), None);
        assert_eq!(side_m(&field((0, 100), (50, 20), 0x11, 0x0d)), None);
    }

    #[test]
    fn the_force_of_a_declared_pressure() {
        let scale = force_scale(&field((0, 4095), (0, 4016), 0xe111, 2)).unwrap();
        check(Some(scale.of(4095)), 4.016);
        check(Some(scale.of(0)), 0.0);
        check(Some(scale.per_count()), 4.016 / 4095.0);
        // One slug inch per second squared is 1/12 pound-force; one pound-force is 4.448222 N.
        let english = force_scale(&field((0, 1000), (0, 10), 0xe113, 0)).unwrap();
        assert!((english.of(1000) - 10.0 * 4.448_222 / 12.0).abs() < 1e-5);
        assert_eq!(force_scale(&field((0, 4095), (0, 4016), 0x11, 2)), None);
        assert_eq!(force_scale(&field((0, 4095), (0, 4016), 0xe111, 6)), None);
    }

    #[test]
    fn angles_times_and_distances() {
        let right = 1.5 * std::f64::consts::FRAC_PI_3;
        check(angle_scale(&field((-9000, 9000), (-9000, 9000), 0x14, 0x0e)).map(|s| s.of(9000)), right);
        check(angle_scale(&field((-64, 63), (-64, 63), 0x14, 0)).map(|s| s.of(-60)), -right / 1.5);
        check(angle_scale(&field((-9000, 9000), (0, 0), 0, 0)).map(|s| s.of(-9000)), -right);
        check(angle_scale(&field((-90, 90), (0, 0), 0x11, 0x0d)).map(|s| s.of(90)), right);
        check(angle_scale(&field((0, 1000), (0, 3), 0x12, 0)).map(|s| s.of(1000)), 3.0);
        check(time_scale(&field((0, 65_535), (0, 65_535), 0x1001, 0x0c)).map(|s| s.of(20)), 0.002);
        check(time_scale(&field((0, 65_535), (0, 0), 0, 0)).map(|s| s.of(20)), 0.002);
        check(time_scale(&field((0, 65_535), (0, 65_535), 0x11, 0)).map(|s| s.of(20)), 0.002);
        assert_eq!(time_scale(&field((0, 65_535), (0, 65_535), 0x1001, 7)), None);
        check(distance_scale(&field((-255, 0), (-255, 0), 0x11, 0x0e)).map(|s| s.of(-100)), -0.01);
    }
}
