//! Location of the pen's values in a report.

use crate::hid::descriptor::{Descriptor, Field, Report, ReportKind, Usage};
use crate::hid::pen::{PenAxis, PenFormat, PenPressure};
use crate::hid::units::{self, Scale};

/// HID usage pages.
const DESKTOP: u16 = 0x01;
const DIGITIZER: u16 = 0x0d;
/// Wacom's usage page. The high byte of the id is a standard usage page (zero for digitizer), the low byte its usage.
const WACOM_DIGITIZER: u16 = 0xff0d;

const X: Usage = Usage::new(DESKTOP, 0x30);
const Y: Usage = Usage::new(DESKTOP, 0x31);
const Z: Usage = Usage::new(DESKTOP, 0x32);
const TIP_PRESSURE: Usage = digitizer(0x30);
const IN_RANGE: Usage = digitizer(0x32);
const SERIAL: Usage = digitizer(0x5b);
const TRANSDUCER: Usage = digitizer(0x38);
const INVERT: Usage = digitizer(0x3c);
const X_TILT: Usage = digitizer(0x3d);
const Y_TILT: Usage = digitizer(0x3e);
const AZIMUTH: Usage = digitizer(0x3f);
const ALTITUDE: Usage = digitizer(0x40);
const TWIST: Usage = digitizer(0x41);
const TIP: Usage = digitizer(0x42);
const BARREL: Usage = digitizer(0x44);
const ERASER: Usage = digitizer(0x45);
const SCAN_TIME: Usage = digitizer(0x56);
const SECOND_BARREL: Usage = digitizer(0x5a);

const fn digitizer(id: u16) -> Usage {
    Usage::new(DIGITIZER, id)
}

/// Confidence that a report belongs to a pen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Rank {
    /// Pressure in a report of a mouse or another device type.
    Pressure,
    /// Pressure in a vendor-defined collection.
    Vendor,
    /// A digitizer or a pen.
    Pen,
}

/// One value of a report.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Slot {
    field: Field,
    index: u32,
    scale: Option<Scale>,
}

impl Slot {
    /// The value of a field with a count of one.
    pub(crate) fn of_field(field: Field) -> Self {
        Self { field, index: 0, scale: None }
    }

    /// Whether it has a range and at most 32 bits.
    fn is_number(&self) -> bool {
        self.field.logical_min < self.field.logical_max && self.field.bit_size <= 32
    }

    /// Returns the raw value, or `None` for the null state (out of range in a field with a null state).
    pub(crate) fn value(&self, report: &[u8]) -> Option<i64> {
        let value = self.field.value(report, self.index)?;
        let is_none = self.field.has_null
            && self.field.logical_min < self.field.logical_max
            && !(self.field.logical_min..=self.field.logical_max).contains(&value);
        (!is_none).then_some(value)
    }

    /// Whether the value is nonzero.
    pub(crate) fn is_set(&self, report: &[u8]) -> bool {
        self.value(report).is_some_and(|value| value != 0)
    }

    /// Returns the value in physical units.
    pub(crate) fn quantity(&self, report: &[u8]) -> Option<f64> {
        Some(self.scale?.of(self.value(report)?))
    }
}

/// The values of a report that are used.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PenFields {
    pub(crate) x: Slot,
    pub(crate) y: Slot,
    pub(crate) pressure: Option<Slot>,
    pub(crate) force_scale: Option<Scale>,
    pub(crate) tip: Option<Slot>,
    pub(crate) in_range: Option<Slot>,
    pub(crate) barrel: Option<Slot>,
    pub(crate) second_barrel: Option<Slot>,
    pub(crate) eraser: Option<Slot>,
    pub(crate) invert: Option<Slot>,
    pub(crate) x_tilt: Option<Slot>,
    pub(crate) y_tilt: Option<Slot>,
    pub(crate) azimuth: Option<Slot>,
    pub(crate) altitude: Option<Slot>,
    pub(crate) twist: Option<Slot>,
    pub(crate) distance: Option<Slot>,
    pub(crate) clock: Option<Slot>,
    pub(crate) transducer: Option<Slot>,
    pub(crate) serial: Option<Slot>,
    /// Nonzero in reports of other tools, such as a mouse on a tablet.
    pub(crate) not_a_pen: Option<Slot>,
}

/// Returns the pen's values in a report, or `None` if it is not a pen report.
pub(super) fn pen_fields(descriptor: &Descriptor, report: &Report) -> Option<(Rank, PenFields)> {
    if report.kind != ReportKind::Input {
        return None;
    }
    let find = |wanted: Usage| {
        let fields = report.fields.iter().filter(|field| is_place(field));
        fields.flat_map(indexed).find(|(_, _, usage)| standard(*usage) == wanted)
    };
    let slot =
        |usage: Usage| find(usage).map(|(field, index, _)| Slot { field: field.clone(), index, scale: None });
    let scaled = |usage: Usage, scale_of: fn(&Field) -> Option<Scale>| {
        slot(usage).map(|slot| Slot { scale: scale_of(&slot.field), ..slot })
    };
    let (x, y) = (slot(X).filter(Slot::is_number)?, slot(Y).filter(Slot::is_number)?);
    let pressure = slot(TIP_PRESSURE).filter(Slot::is_number);
    let rank = rank_of(descriptor, &x.field, pressure.is_some())?;
    let (tip, in_range) = (slot(TIP), slot(IN_RANGE));
    if pressure.is_none() && tip.is_none() && in_range.is_none() {
        return None;
    }
    let fields = PenFields {
        x,
        y,
        force_scale: pressure.as_ref().and_then(|slot| units::force_scale(&slot.field)),
        pressure,
        tip,
        in_range,
        barrel: slot(BARREL),
        second_barrel: slot(SECOND_BARREL),
        eraser: slot(ERASER),
        invert: slot(INVERT),
        x_tilt: scaled(X_TILT, units::angle_scale),
        y_tilt: scaled(Y_TILT, units::angle_scale),
        azimuth: scaled(AZIMUTH, units::angle_scale),
        altitude: scaled(ALTITUDE, units::angle_scale),
        twist: scaled(TWIST, units::angle_scale),
        distance: scaled(Z, units::distance_scale),
        clock: scaled(SCAN_TIME, units::time_scale),
        transducer: slot(TRANSDUCER),
        serial: slot(SERIAL),
        not_a_pen: None,
    };
    Some((rank, fields))
}

/// Whether a field holds absolute values: no padding, no array, no relative values.
fn is_place(field: &Field) -> bool {
    !field.is_constant && field.is_variable && !field.is_relative
}

/// The usages of a field. Fields with more values are bulk data.
fn indexed(field: &Field) -> impl Iterator<Item = (&Field, u32, Usage)> {
    const MOST: u32 = 64;
    (0..field.count.min(MOST)).filter_map(move |index| Some((field, index, field.usage(index)?)))
}

/// The standard usage for one on Wacom's usage page; any other usage unchanged.
fn standard(usage: Usage) -> Usage {
    if usage.page() != WACOM_DIGITIZER {
        return usage;
    }
    match usage.id() >> 8 {
        0 => digitizer(usage.id()),
        page => Usage::new(page, usage.id() & 0xff),
    }
}

fn rank_of(descriptor: &Descriptor, x: &Field, has_pressure: bool) -> Option<Rank> {
    /// The usages are digitizer, pen, light pen, white board and stylus.
    const PENS: [u16; 5] = [0x01, 0x02, 0x03, 0x06, 0x20];
    const STYLUS: Usage = digitizer(0x20);
    const FINGER: Usage = digitizer(0x22);
    const PEN: Usage = digitizer(0x02);
    let application = descriptor.application_of(x)?;
    let is_inside = |wanted: Usage| descriptor.collections_of(x).any(|c| standard(c.usage) == wanted);
    if is_inside(FINGER) {
        return None;
    }
    match (application.page(), standard(application)) {
        (DIGITIZER | WACOM_DIGITIZER, usage) if PENS.contains(&usage.id()) => {
            // A generic digitizer may be any pointing device; a stylus collection or a pressure makes it a pen.
            let is_pen = usage == PEN || has_pressure || is_inside(STYLUS);
            let rank = if application.page() == DIGITIZER { Rank::Pen } else { Rank::Vendor };
            is_pen.then_some(rank)
        }
        (DIGITIZER, _) => None,
        (0xff00.., _) => (has_pressure && is_standard_x(x)).then_some(Rank::Vendor),
        _ => has_pressure.then_some(Rank::Pressure),
    }
}

/// Values on a vendor-defined page may mean anything, so X must be the standard usage there.
fn is_standard_x(x: &Field) -> bool {
    x.usage(0).is_some_and(|usage| usage.page() == DESKTOP)
}

impl PenFields {
    /// Returns the report type with these values.
    pub(crate) fn into_format(self, report_id: Option<u8>, n_bytes: usize) -> PenFormat {
        let axis = |slot: &Slot| PenAxis {
            logical_min: slot.field.logical_min,
            logical_max: slot.field.logical_max,
            side_m: units::side_m(&slot.field),
        };
        let pressure = self.pressure.as_ref().map(|slot| {
            let Field { bit_size, logical_min, logical_max, .. } = slot.field;
            PenPressure {
                bits: bit_size,
                logical_min,
                logical_max,
                full_n: self.force_scale.map(|scale| scale.of(logical_max)),
            }
        });
        let clock_round_secs = self.clock.as_ref().and_then(|slot| {
            let counts = slot.field.logical_max - slot.field.logical_min + 1;
            slot.scale.map(|scale| scale.per_count() * counts as f64)
        });
        let declared = |slot: &Slot| (slot.field.unit, slot.field.unit_exponent, slot.field.physical_max);
        let is_size_doubtful = declared(&self.x) == declared(&self.y)
            && self.pressure.as_ref().is_some_and(|slot| declared(slot) == declared(&self.x))
            && self.x.field.unit != 0;
        PenFormat {
            report_id,
            n_bytes,
            x: axis(&self.x),
            y: axis(&self.y),
            is_size_doubtful,
            pressure,
            has_tilt: self.x_tilt.is_some() && self.y_tilt.is_some()
                || self.azimuth.is_some() && self.altitude.is_some(),
            clock_round_secs,
            fields: self,
        }
    }
}
