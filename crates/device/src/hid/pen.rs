//! Which reports of a device are of a pen, and what they say.
//!
//! A report is of a pen if it has absolute X and Y and a tip, in an application collection that is a digitizer or a
//! pen; or in another one (a maker's own, or a mouse) if it tells the pressure of a tip too. Touch screens and touch
//! pads are none. A maker's copy of the usages of digitizers (usage page 0xFF0D) is read like the original.

mod fields;
mod known;

use crate::hid::descriptor::Descriptor;
use crate::hid::pen::fields::{PenFields, Slot};

/// One report of a pen, in SI units where the device states them.
#[expect(clippy::struct_excessive_bools, reason = "a pen has so many independent switches")]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PenReport {
    /// Place from the left edge of the area, as a share of its width, 0..1.
    pub x_share: f64,
    /// Place from the upper edge of the area, as a share of its height, 0..1.
    pub y_share: f64,
    /// Place from the left edge, in m, where the size of the area is known.
    pub x_m: Option<f64>,
    /// Place from the upper edge, in m, where the size of the area is known.
    pub y_m: Option<f64>,
    /// How hard the tip is pressed, as a share of full pressure, 0..1.
    pub pressure: Option<f64>,
    /// How hard the tip is pressed in N, where the device declares it.
    pub force_n: Option<f64>,
    /// Whether the tip touches. A device without a switch for it touches where there is pressure.
    pub tip: bool,
    /// Whether the pen is near enough to be followed.
    pub in_range: bool,
    /// The buttons on the barrel.
    pub barrel: [bool; 2],
    /// Whether the other end touches, with its eraser.
    pub eraser: bool,
    /// Whether the other end points down.
    pub inverted: bool,
    /// Tilt to the right, in rad.
    pub tilt_x_rad: Option<f64>,
    /// Tilt toward the person, in rad.
    pub tilt_y_rad: Option<f64>,
    /// Direction in which the pen leans, in rad, as the device counts it.
    pub azimuth_rad: Option<f64>,
    /// Angle between the pen and the surface, in rad.
    pub altitude_rad: Option<f64>,
    /// Turn of the barrel, in rad.
    pub twist_rad: Option<f64>,
    /// Height above the surface in m, where the device states its unit.
    pub distance_m: Option<f64>,
    /// Reading of the device's own clock in s; it starts over after [`PenFormat::clock_round_secs`].
    pub clock_secs: Option<f64>,
    /// Which of several pens it is, by number.
    pub transducer: Option<u32>,
    /// Which pen it is, by its serial number.
    pub serial: Option<u32>,
}

/// Whether a device is known to be a pen although its descriptor declares none.
pub fn is_known_pen(vendor_id: u16, product_id: u16) -> bool {
    known::is_known(vendor_id, product_id)
}

impl PenReport {
    /// Whether either end touches.
    pub fn touching(&self) -> bool {
        self.in_range && (self.tip || self.eraser)
    }
}

/// An axis of the area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PenAxis {
    /// Lowest number.
    pub logical_min: i64,
    /// Highest number.
    pub logical_max: i64,
    /// Length of the area along it in m, where it is known.
    pub side_m: Option<f64>,
}

/// How pressure is told.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PenPressure {
    /// Bits of the field, which may be more than its numbers need.
    pub bits: u32,
    /// Lowest number.
    pub logical_min: i64,
    /// Highest number.
    pub logical_max: i64,
    /// The force at the highest number in N, where the device declares it.
    pub full_n: Option<f64>,
}

/// One sort of report of a pen.
#[derive(Clone, Debug, PartialEq)]
pub struct PenFormat {
    /// Its first byte, where reports have an id.
    pub report_id: Option<u8>,
    /// Length of the report in bytes, id included.
    pub n_bytes: usize,
    /// From left to right.
    pub x: PenAxis,
    /// From the upper edge down.
    pub y: PenAxis,
    /// Whether the declared size is likely wrong: some tablets declare one length for both sides and for the pressure.
    pub is_size_doubtful: bool,
    /// Pressure of the tip, if it is told.
    pub pressure: Option<PenPressure>,
    /// Whether tilt is told, along two axes or as azimuth and altitude.
    pub has_tilt: bool,
    /// After how long the device's own clock starts over in s, if it has one.
    pub clock_round_secs: Option<f64>,
    fields: PenFields,
}

/// What is needed to read the pen of a device.
#[derive(Clone, Debug, PartialEq)]
pub struct PenDecoder {
    formats: Vec<PenFormat>,
}

impl PenDecoder {
    /// The pen that a descriptor declares, or `None` if it declares none.
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
        // A stable order: of equally good reports the first declared.
        found.sort_by_key(|(rank, _)| std::cmp::Reverse(*rank));
        (!found.is_empty()).then(|| Self { formats: found.into_iter().map(|(_, format)| format).collect() })
    }

    /// The pen of a device that is known by its vendor and product although its descriptor declares none; see
    /// [`is_known_pen`].
    pub fn of_known(vendor_id: u16, product_id: u16) -> Option<Self> {
        let (descriptor, not_a_pen) = known::descriptor(vendor_id, product_id)?;
        let mut decoder = Self::of_descriptor(&descriptor)?;
        for format in &mut decoder.formats {
            format.fields.not_a_pen.clone_from(&not_a_pen);
        }
        Some(decoder)
    }

    /// The pen of a device: what its descriptor declares, else what is known of it.
    pub fn of_device(descriptor: &Descriptor, identity: Option<(u16, u16)>) -> Option<Self> {
        Self::of_descriptor(descriptor)
            .or_else(|| identity.and_then(|(vendor_id, product_id)| Self::of_known(vendor_id, product_id)))
    }

    /// All sorts of reports of the pen, the best first: there is at least one.
    pub fn formats(&self) -> &[PenFormat] {
        &self.formats
    }

    /// The best sort of report.
    pub fn best(&self) -> &PenFormat {
        &self.formats[0]
    }

    /// The same with an area of `size_m` (width, height), if it is given, whatever the device declares.
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

    /// What a report says; `None` if it is none of the pen's, too short, or says nothing of a place.
    ///
    /// Reports may be longer than declared: some systems pad them to the longest.
    pub fn decode(&self, report: &[u8]) -> Option<PenReport> {
        self.decode_with_format(report).map(|(_, report)| report)
    }

    /// The same with the sort of report that it was.
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
    /// Width and height of the area in m, where both are known.
    pub fn size_m(&self) -> Option<[f64; 2]> {
        Some([self.x.side_m?, self.y.side_m?])
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
            // Some count it up, some down from zero.
            distance_m: quantity(&fields.distance).map(f64::abs),
            clock_secs: quantity(&fields.clock),
            transducer: number(&fields.transducer).map(|number| number as u32),
            serial: number(&fields.serial).map(|number| number as u32),
        })
    }
}

impl PenAxis {
    /// The share of the range below a number, pulled to 0..1.
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
