//! Detection of pen reports in a descriptor, and their decoding.
//!
//! A report is a pen's report if it has absolute X and Y and a tip, in an application collection that is a digitizer or
//! a pen. In another application collection (vendor-defined, or a mouse) it must also have a tip pressure. Touch
//! screens and touch pads are not pens. Wacom's copy of the digitizer usages (usage page 0xFF0D) is read like the
//! original.

mod fields;
mod known;

use crate::hid::descriptor::Descriptor;
use crate::hid::pen::fields::{PenFields, Slot};
use crate::pen_backend::{PositionUnit, Provides};

/// One decoded pen report, in SI units where the device declares units.
#[expect(clippy::struct_excessive_bools, reason = "the switches of a pen are independent")]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PenReport {
    /// Position from the left edge as a fraction of the active area's width, 0..1.
    pub x_share: f64,
    /// Position from the upper edge as a fraction of the active area's height, 0..1.
    pub y_share: f64,
    /// Position from the left edge in m, if the size of the area is known.
    pub x_m: Option<f64>,
    /// Position from the upper edge in m, if the size of the area is known.
    pub y_m: Option<f64>,
    /// Tip pressure as a fraction of full pressure, 0..1.
    pub pressure: Option<f64>,
    /// Tip force in N, if the device declares it.
    pub force_n: Option<f64>,
    /// Whether the tip touches. Without a tip switch, a pressure above zero counts as touching.
    pub tip: bool,
    /// Whether the pen is in range of the sensor.
    pub in_range: bool,
    /// State of the two barrel buttons.
    pub barrel: [bool; 2],
    /// Whether the eraser end touches.
    pub eraser: bool,
    /// Whether the eraser end points down.
    pub inverted: bool,
    /// Tilt to the right, in rad.
    pub tilt_x_rad: Option<f64>,
    /// Tilt toward the person, in rad.
    pub tilt_y_rad: Option<f64>,
    /// Azimuth of the pen, in rad, in the device's convention.
    pub azimuth_rad: Option<f64>,
    /// Altitude: angle between pen and surface, in rad.
    pub altitude_rad: Option<f64>,
    /// Rotation around the barrel's axis, in rad.
    pub twist_rad: Option<f64>,
    /// Height above the surface in m, if the device declares its unit.
    pub distance_m: Option<f64>,
    /// Time of the device's own clock in s; it wraps around after [`PenFormat::clock_round_secs`].
    pub clock_secs: Option<f64>,
    /// Index of the pen, for devices with several pens.
    pub transducer: Option<u32>,
    /// Serial number of the pen.
    pub serial: Option<u32>,
}

/// Whether a device is a known pen although its descriptor declares none.
pub fn is_known_pen(vendor_id: u16, product_id: u16) -> bool {
    known::is_known(vendor_id, product_id)
}

impl PenReport {
    /// Whether the tip or the eraser touches.
    pub fn touching(&self) -> bool {
        self.in_range && (self.tip || self.eraser)
    }
}

/// An axis of the active area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PenAxis {
    /// Lowest value.
    pub logical_min: i64,
    /// Highest value.
    pub logical_max: i64,
    /// Length of the area along this axis in m, if known.
    pub side_m: Option<f64>,
}

/// Range of the pressure values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PenPressure {
    /// Size of the field in bits, which may exceed what its values need.
    pub bits: u32,
    /// Lowest value.
    pub logical_min: i64,
    /// Highest value.
    pub logical_max: i64,
    /// Force at the highest value in N, if the device declares it.
    pub full_n: Option<f64>,
}

/// One type of report of a pen.
#[derive(Clone, Debug, PartialEq)]
pub struct PenFormat {
    /// Report id, its first byte, if the device uses report ids.
    pub report_id: Option<u8>,
    /// Length of the report in bytes, including the id.
    pub n_bytes: usize,
    /// Axis from left to right.
    pub x: PenAxis,
    /// Axis from the upper edge down.
    pub y: PenAxis,
    /// Whether the declared size is probably wrong: some tablets declare one value for both sides and for the pressure.
    pub is_size_doubtful: bool,
    /// Tip pressure, if it is reported.
    pub pressure: Option<PenPressure>,
    /// Whether tilt is reported, either along two axes or as azimuth and altitude.
    pub has_tilt: bool,
    /// Period after which the device's own clock wraps around in s, if there is one.
    pub clock_round_secs: Option<f64>,
    fields: PenFields,
}

/// Decoder for the pen reports of a device.
#[derive(Clone, Debug, PartialEq)]
pub struct PenDecoder {
    formats: Vec<PenFormat>,
}

impl PenDecoder {
    /// Returns a decoder for the pen that a descriptor declares, or `None` if it declares none.
    pub fn of_descriptor(descriptor: &Descriptor) -> Option<Self> {
        let mut found: Vec<_> = descriptor
            .reports
            .iter()
            .filter_map(|report| {
                let (rank, fields) = fields::pen_fields(descriptor, report)?;
                let format = fields.into_format(report.id, report.n_bytes());
                Some(((rank, format.pressure.is_some(), format.size_m().is_some()), format))
            })
            .collect();
        // The sort is stable: among equal ranks, the first declared report comes first.
        found.sort_by_key(|(rank, _)| std::cmp::Reverse(*rank));
        (!found.is_empty()).then(|| Self { formats: found.into_iter().map(|(_, format)| format).collect() })
    }

    /// Returns a decoder for a pen that is known by vendor and product although its descriptor declares none; see
    /// [`is_known_pen`].
    pub fn of_known(vendor_id: u16, product_id: u16) -> Option<Self> {
        let (descriptor, not_a_pen) = known::descriptor(vendor_id, product_id)?;
        let mut decoder = Self::of_descriptor(&descriptor)?;
        for format in &mut decoder.formats {
            format.fields.not_a_pen.clone_from(&not_a_pen);
        }
        Some(decoder)
    }

    /// Returns a decoder for the pen that the descriptor declares, or else for the known pen of this vendor and
    /// product.
    pub fn of_device(descriptor: &Descriptor, identity: Option<(u16, u16)>) -> Option<Self> {
        Self::of_descriptor(descriptor)
            .or_else(|| identity.and_then(|(vendor_id, product_id)| Self::of_known(vendor_id, product_id)))
    }

    /// All types of reports of the pen, best first; at least one.
    pub fn formats(&self) -> &[PenFormat] {
        &self.formats
    }

    /// The best type of report.
    pub fn best(&self) -> &PenFormat {
        &self.formats[0]
    }

    /// Returns the decoder with an active area of `size_m` (width, height) instead of the declared one, unless `None`.
    #[must_use]
    pub fn with_size_m(mut self, size_m: Option<[f64; 2]>) -> Self {
        if let Some([width_m, height_m]) = size_m {
            for format in &mut self.formats {
                format.x.side_m = Some(width_m);
                format.y.side_m = Some(height_m);
                format.is_size_doubtful = false;
            }
        }
        self
    }

    /// Decodes a report. Returns `None` if it is not a pen report, too short, or without a position.
    ///
    /// Reports may be longer than declared, because some systems pad them to the longest report.
    pub fn decode(&self, report: &[u8]) -> Option<PenReport> {
        self.decode_with_format(report).map(|(_, report)| report)
    }

    /// As [`PenDecoder::decode`], together with the type of the report.
    pub fn decode_with_format(&self, report: &[u8]) -> Option<(&PenFormat, PenReport)> {
        let first = report.first();
        let format = self.formats.iter().find(|format| match format.report_id {
            Some(id) => first == Some(&id),
            None => true,
        })?;
        Some((format, format.decode(report)?))
    }
}

impl PenFormat {
    /// Width and height of the active area in m, if both are known.
    pub fn size_m(&self) -> Option<[f64; 2]> {
        Some([self.x.side_m?, self.y.side_m?])
    }

    /// Quantities that the reports provide.
    pub fn provides(&self) -> Provides {
        let has_size = self.size_m().is_some() && !self.is_size_doubtful;
        Provides {
            position: Some(if has_size { PositionUnit::Millimeters } else { PositionUnit::Fraction }),
            pressure: Some(self.pressure.is_some()),
            tilt: Some(self.has_tilt),
            clock: Some(self.clock_round_secs.is_some()),
        }
    }

    fn decode(&self, report: &[u8]) -> Option<PenReport> {
        if report.len() < self.n_bytes {
            return None;
        }
        let fields = &self.fields;
        if fields.not_a_pen.as_ref().is_some_and(|field| field.is_set(report)) {
            return None;
        }
        let quantity = |field: &Option<Slot>| field.as_ref().and_then(|field| field.quantity(report));
        let number = |field: &Option<Slot>| field.as_ref().and_then(|field| field.value(report));
        let switch = |field: &Option<Slot>| field.as_ref().map(|field| field.is_set(report));
        let (x_share, y_share) =
            (self.x.share(fields.x.value(report)?)?, self.y.share(fields.y.value(report)?)?);
        let count = number(&fields.pressure);
        let pressure = self.pressure.zip(count).map(|(format, count)| format.share(count));
        let force_n = fields.force_scale.zip(self.pressure).zip(count).map(|((scale, format), count)| {
            scale.of(count.clamp(format.logical_min, format.logical_max)).max(0.0)
        });
        let tip = switch(&fields.tip);
        Some(PenReport {
            x_share,
            y_share,
            x_m: self.x.side_m.map(|side_m| side_m * x_share),
            y_m: self.y.side_m.map(|side_m| side_m * y_share),
            pressure,
            force_n,
            tip: tip.unwrap_or_else(|| pressure.is_some_and(|pressure| pressure > 0.0)),
            in_range: switch(&fields.in_range).unwrap_or(true),
            barrel: [&fields.barrel, &fields.second_barrel].map(|field| switch(field).unwrap_or(false)),
            eraser: switch(&fields.eraser).unwrap_or(false),
            inverted: switch(&fields.invert).unwrap_or(false),
            tilt_x_rad: quantity(&fields.x_tilt),
            tilt_y_rad: quantity(&fields.y_tilt),
            azimuth_rad: quantity(&fields.azimuth),
            altitude_rad: quantity(&fields.altitude),
            twist_rad: quantity(&fields.twist),
            // Some devices count the height up, some count down from zero.
            distance_m: quantity(&fields.distance).map(f64::abs),
            clock_secs: quantity(&fields.clock),
            transducer: number(&fields.transducer).map(|number| number as u32),
            serial: number(&fields.serial).map(|number| number as u32),
        })
    }
}

impl PenAxis {
    /// Position of a value within the range, clamped to 0..1; `None` for an empty range.
    fn share(self, count: i64) -> Option<f64> {
        let counts = self.logical_max - self.logical_min;
        (counts > 0).then(|| ((count - self.logical_min) as f64 / counts as f64).clamp(0.0, 1.0))
    }
}

impl PenPressure {
    fn share(self, count: i64) -> f64 {
        let counts = (self.logical_max - self.logical_min) as f64;
        ((count - self.logical_min) as f64 / counts).clamp(0.0, 1.0)
    }
}

#[cfg(test)]
mod tests;
