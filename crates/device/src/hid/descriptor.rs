//! What a HID device says about its reports: the report descriptor.
//!
//! The parser is ours because the published ones panic on malformed descriptors, and a device can send anything. It is
//! total: any bytes give a [`Descriptor`] or one [`DescriptorError`], in time and memory bounded by the length of the
//! bytes. What real devices get wrong without harm is a [`DescriptorWarning`] instead: an item that means nothing is
//! skipped, and a main item without a usage is padding. Reference: USB Device Class Definition for HID 1.11.

mod items;
mod state;

use crate::hid::descriptor::state::State;

/// Longest descriptor that is read, in bytes: as much as Linux takes.
pub const MAX_DESCRIPTOR_BYTES: usize = 4096;
/// Longest report that a descriptor may declare, in bytes: as much as Linux takes.
pub const MAX_REPORT_BYTES: u32 = 16_384;
/// Deepest nesting of collections, and most states that are pushed.
pub const MAX_DEPTH: usize = 64;

/// What a field or collection means: usage page and usage.
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

    /// The usage within its page.
    pub const fn id(self) -> u16 {
        self.0 as u16
    }
}

/// The way that a report goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ReportKind {
    /// From the device.
    Input,
    /// To the device.
    Output,
    /// Asked for, either way.
    Feature,
}

/// Fields that belong together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Collection {
    /// What they are.
    pub usage: Usage,
    /// 0 physical, 1 application, 2 logical; others are rare.
    pub kind: u8,
    /// The collection around this one, as an index into [`Descriptor::collections`].
    pub parent: Option<usize>,
}

/// Fields of one main item: `count` equal ones in a row.
#[expect(clippy::struct_excessive_bools, reason = "the flags of a main item are independent bits")]
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Field {
    /// The innermost collection around them, as an index into [`Descriptor::collections`].
    pub collection: Option<usize>,
    /// Place of the first bit, counted from the first byte of the report as it is read: its id, if there is one.
    pub bit_offset: u32,
    /// Bits of each.
    pub bit_size: u32,
    /// How many.
    pub count: u32,
    /// Whether it is padding.
    pub is_constant: bool,
    /// Whether each field has its own usage; else each holds the number of a usage (an array, as of keys).
    pub is_variable: bool,
    /// Whether it tells changes and not places.
    pub is_relative: bool,
    /// Whether a value outside of the logical range means that there is none.
    pub has_null: bool,
    /// Lowest value.
    pub logical_min: i64,
    /// Highest value.
    pub logical_max: i64,
    /// What the lowest value stands for, in [`Self::unit`] times ten to the [`Self::unit_exponent`].
    pub physical_min: i64,
    /// What the highest value stands for.
    pub physical_max: i64,
    /// The unit, in nibbles; zero is none.
    pub unit: u32,
    /// The power of ten of the unit.
    pub unit_exponent: i32,
    usages: Vec<(Usage, Usage)>,
}

/// A report.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Report {
    /// The way it goes.
    pub kind: ReportKind,
    /// Its first byte, where reports have an id.
    pub id: Option<u8>,
    /// Its length in bits, id included.
    pub n_bits: u32,
    /// Its fields in their order, padding included.
    pub fields: Vec<Field>,
}

/// A descriptor.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Descriptor {
    /// The collections in the order in which they begin.
    pub collections: Vec<Collection>,
    /// The reports in the order in which they are first mentioned.
    pub reports: Vec<Report>,
    /// What is wrong without harm.
    pub warnings: Vec<DescriptorWarning>,
}

/// Something odd at a place of a descriptor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{what} at byte {offset}")]
pub struct DescriptorWarning {
    /// Where the item starts, in bytes.
    pub offset: usize,
    /// What is odd, and what was made of it.
    pub what: &'static str,
}

/// Why bytes are no report descriptor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum DescriptorError {
    /// No bytes.
    #[error("the report descriptor is empty; get a complete copy")]
    Empty,
    /// Too many bytes.
    #[error(
        "the report descriptor has {n_bytes} bytes, more than {MAX_DESCRIPTOR_BYTES}; check that it is one"
    )]
    TooLong {
        /// How many.
        n_bytes: usize,
    },
    /// The last item is cut off.
    #[error("the item at byte {offset} of the report descriptor is cut off; get a complete copy")]
    CutOff {
        /// Where the item starts, in bytes.
        offset: usize,
    },
    /// An item contradicts what is ahead of it.
    #[error("byte {offset} of the report descriptor: {problem}; check that it is one")]
    Item {
        /// Where the item starts, in bytes.
        offset: usize,
        /// What is wrong.
        problem: &'static str,
    },
    /// Nothing that a device could report.
    #[error("the report descriptor declares no report; check that it is one")]
    NoReport,
}

/// Reads a report descriptor.
///
/// # Errors
/// See [`DescriptorError`]; each names the byte.
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
    /// The usage of the `index`th field; the last one stands for all that follow. `None` is padding.
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

    /// The value of the `index`th field in a report, as it was read; `None` if the report is too short.
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
}

impl Report {
    /// Its length in bytes, id included.
    pub fn n_bytes(&self) -> usize {
        self.n_bits.div_ceil(8) as usize
    }
}

impl Descriptor {
    /// The usages of the collections around a field, from the innermost out.
    pub fn collections_of(&self, field: &Field) -> impl Iterator<Item = Collection> + '_ {
        // A parent begins ahead of its children, so that this ends.
        let collection = |index: Option<usize>| index.and_then(|index| self.collections.get(index)).copied();
        std::iter::successors(collection(field.collection), move |inner| collection(inner.parent))
    }

    /// The application that a field belongs to: the outermost collection around it.
    pub fn application_of(&self, field: &Field) -> Option<Usage> {
        self.collections_of(field).last().map(|collection| collection.usage)
    }

    /// Whether reports start with their id.
    pub fn has_report_ids(&self) -> bool {
        self.reports.iter().any(|report| report.id.is_some())
    }
}

#[cfg(test)]
pub(crate) mod tests;
