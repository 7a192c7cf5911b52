//! Parser for HID report descriptors, in which a device declares its reports.
//!
//! This is a parser of our own because published ones panic on malformed descriptors, and a device can send any bytes.
//! It is total: any bytes give a [`Descriptor`] or one [`DescriptorError`], in time and memory bounded by their length.
//! Harmless errors of real devices are a [`DescriptorWarning`] instead: a meaningless item is skipped, and a main item
//! without a usage is padding. Reference: USB Device Class Definition for HID 1.11.

mod items;
mod state;

use crate::hid::descriptor::state::State;

/// Longest descriptor in bytes, the limit of Linux.
pub const MAX_DESCRIPTOR_BYTES: usize = 4096;
/// Longest report that a descriptor may declare, in bytes, the limit of Linux.
pub const MAX_REPORT_BYTES: u32 = 16_384;
/// Deepest nesting of collections, and largest size of the stack of pushed global items.
pub const MAX_DEPTH: usize = 64;

/// Usage page and usage id: the meaning of a field or collection.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Usage(pub u32);

impl Usage {
    /// The usage `id` of `page`.
    pub const fn new(page: u16, id: u16) -> Self {
        Self((page as u32) << 16 | id as u32)
    }

    /// The usage page.
    pub const fn page(self) -> u16 {
        (self.0 >> 16) as u16
    }

    /// The usage id within its page.
    pub const fn id(self) -> u16 {
        self.0 as u16
    }
}

/// Type of a report.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ReportKind {
    /// Input report, from the device.
    Input,
    /// Output report, to the device.
    Output,
    /// Feature report, on request in either direction.
    Feature,
}

/// Collection of related fields.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Collection {
    /// Meaning of the collection.
    pub usage: Usage,
    /// Type: 0 physical, 1 application, 2 logical; others are rare.
    pub kind: u8,
    /// Enclosing collection, as an index into [`Descriptor::collections`].
    pub parent: Option<usize>,
}

/// Fields of one main item: `count` adjacent fields of equal size.
#[expect(clippy::struct_excessive_bools, reason = "the flags of a main item are independent bits")]
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Field {
    /// Innermost enclosing collection, as an index into [`Descriptor::collections`].
    pub collection: Option<usize>,
    /// Position of the first bit in the report as it is read, including the report id if there is one.
    pub bit_offset: u32,
    /// Size of each field in bits.
    pub bit_size: u32,
    /// Number of fields.
    pub count: u32,
    /// Whether the fields are constant (padding).
    pub is_constant: bool,
    /// Whether each field has its own usage; otherwise each field holds a usage number (an array, as for keys).
    pub is_variable: bool,
    /// Whether the values are changes instead of positions.
    pub is_relative: bool,
    /// Whether a value outside the logical range means "no value".
    pub has_null: bool,
    /// Lowest value.
    pub logical_min: i64,
    /// Highest value.
    pub logical_max: i64,
    /// Physical value of `logical_min`, in [`Self::unit`] times ten to the power of [`Self::unit_exponent`].
    pub physical_min: i64,
    /// Physical value of `logical_max`, in the same unit.
    pub physical_max: i64,
    /// Unit code, in nibbles; zero is no unit.
    pub unit: u32,
    /// Power of ten of the unit.
    pub unit_exponent: i32,
    usages: Vec<(Usage, Usage)>,
}

/// A report with its fields.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Report {
    /// Type of the report.
    pub kind: ReportKind,
    /// Report id, its first byte, if the device uses report ids.
    pub id: Option<u8>,
    /// Length in bits, including the id.
    pub n_bits: u32,
    /// Fields in order, including padding.
    pub fields: Vec<Field>,
}

/// A parsed report descriptor.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Descriptor {
    /// Collections in the order in which they begin.
    pub collections: Vec<Collection>,
    /// Reports in the order of their first field.
    pub reports: Vec<Report>,
    /// Harmless errors.
    pub warnings: Vec<DescriptorWarning>,
}

/// A harmless error in a descriptor, with its position.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{what} at byte {offset}")]
pub struct DescriptorWarning {
    /// Position of the item, in bytes.
    pub offset: usize,
    /// The error, and how the parser treats it.
    pub what: &'static str,
}

/// Reasons why bytes are not a valid report descriptor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum DescriptorError {
    /// There are no bytes.
    #[error("the report descriptor is empty; get a complete copy")]
    Empty,
    /// There are too many bytes.
    #[error(
        "the report descriptor has {n_bytes} bytes, the limit is {MAX_DESCRIPTOR_BYTES}; check its source"
    )]
    TooLong {
        /// Number of bytes.
        n_bytes: usize,
    },
    /// The last item is truncated.
    #[error("the report descriptor is truncated in the item at byte {offset}; get a complete copy")]
    CutOff {
        /// Position of the item, in bytes.
        offset: usize,
    },
    /// An item is invalid or contradicts earlier items.
    #[error("report descriptor, byte {offset}: {problem}; check that it is a report descriptor")]
    Item {
        /// Position of the item, in bytes.
        offset: usize,
        /// The error.
        problem: &'static str,
    },
    /// The descriptor declares no report.
    #[error("the report descriptor declares no report; check that it is a report descriptor")]
    NoReport,
}

/// Parses a report descriptor.
///
/// # Errors
/// [`DescriptorError`] for invalid descriptors; it names the byte where that applies.
pub fn parse(bytes: &[u8]) -> Result<Descriptor, DescriptorError> {
    if bytes.is_empty() {
        return Err(DescriptorError::Empty);
    }
    if bytes.len() > MAX_DESCRIPTOR_BYTES {
        return Err(DescriptorError::TooLong { n_bytes: bytes.len() });
    }
    let mut state = State::default();
    for item in items::items(bytes) {
        state.take(item?)?;
    }
    state.finish(bytes.len())
}

impl Field {
    /// The usage of field `index`; the last usage applies to all further fields. `None` is padding.
    pub fn usage(&self, index: u32) -> Option<Usage> {
        let mut left = index;
        for (first, last) in &self.usages {
            let n_after_first = last.0 - first.0;
            if left <= n_after_first {
                return Some(Usage(first.0 + left));
            }
            left -= n_after_first + 1;
        }
        self.usages.last().map(|(_, last)| *last)
    }

    /// The raw value of field `index` in a report as it was read; `None` if the report is too short.
    pub fn value(&self, report: &[u8], index: u32) -> Option<i64> {
        if index >= self.count || self.bit_size == 0 || self.bit_size > 32 {
            return None;
        }
        let start = u64::from(self.bit_offset) + u64::from(index) * u64::from(self.bit_size);
        let end = start + u64::from(self.bit_size);
        let bytes = report.get((start / 8) as usize..end.div_ceil(8) as usize)?;
        let bits = bytes.iter().rev().fold(0_u64, |bits, byte| bits << 8 | u64::from(*byte));
        let bits = bits >> (start % 8) & ((1 << self.bit_size) - 1);
        let is_negative = self.logical_min < 0 && bits >> (self.bit_size - 1) == 1;
        Some(bits.cast_signed() - if is_negative { 1 << self.bit_size } else { 0 })
    }

    /// Writes the raw value of field `index` into a report of the declared length. A value that needs more bits than the
    /// field has loses the highest ones. Returns whether the report has the field.
    pub fn set_value(&self, report: &mut [u8], index: u32, value: i64) -> bool {
        let has_bits = index < self.count && (1..=32).contains(&self.bit_size);
        let start = u64::from(self.bit_offset) + u64::from(index) * u64::from(self.bit_size);
        let end = start + u64::from(self.bit_size);
        if !has_bits || end > 8 * report.len() as u64 {
            return false;
        }
        for bit in 0..self.bit_size {
            let at = start + u64::from(bit);
            let (byte, mask) = (&mut report[(at / 8) as usize], 1 << (at % 8));
            *byte = if value >> bit & 1 == 1 { *byte | mask } else { *byte & !mask };
        }
        true
    }
}

impl Report {
    /// Length in bytes, including the id.
    pub fn n_bytes(&self) -> usize {
        self.n_bits.div_ceil(8) as usize
    }
}

impl Descriptor {
    /// The collections around a field, innermost first.
    pub fn collections_of(&self, field: &Field) -> impl Iterator<Item = Collection> + '_ {
        // A parent begins before its children, so the iteration ends.
        let collection = |index: Option<usize>| index.and_then(|index| self.collections.get(index)).copied();
        std::iter::successors(collection(field.collection), move |inner| collection(inner.parent))
    }

    /// Usage of the outermost collection around a field: the application that it belongs to.
    pub fn application_of(&self, field: &Field) -> Option<Usage> {
        self.collections_of(field).last().map(|collection| collection.usage)
    }

    /// Whether reports start with a report id.
    pub fn has_report_ids(&self) -> bool {
        self.reports.iter().any(|report| report.id.is_some())
    }
}

#[cfg(test)]
pub(crate) mod tests;
