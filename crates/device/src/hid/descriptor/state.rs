//! Parser state between two items.

use crate::hid::descriptor::items::{Item, ItemKind};
use crate::hid::descriptor::{
    Collection, Descriptor, DescriptorError, DescriptorWarning, Field, MAX_DEPTH, MAX_REPORT_BYTES, Report,
    ReportKind, Usage,
};

/// Most fields of one main item.
const MAX_COUNT: u32 = 65_535;
/// Most bits of a field; a longer field is bulk data, not a number.
const MAX_BIT_SIZE: u32 = 65_535;

/// Global items, valid until they are set again.
#[derive(Clone, Copy, Default)]
struct Globals {
    usage_page: u16,
    logical_min: i64,
    logical_max: Option<Item>,
    physical_min: i64,
    physical_max: Option<Item>,
    unit: u32,
    unit_exponent: i32,
    bit_size: u32,
    count: u32,
    report_id: Option<u8>,
}

/// Local items, valid for the next main item only.
#[derive(Default)]
struct Locals {
    /// First and last usage of each range, and whether they include their usage page.
    usages: Vec<(u32, u32, bool)>,
    min: Option<(u32, bool)>,
    /// Index of the first usage in a delimited set of alternatives for one field; only this first one is used.
    delimited: Option<usize>,
}

/// The parser between two items.
#[derive(Default)]
pub(super) struct State {
    globals: Globals,
    pushed: Vec<Globals>,
    locals: Locals,
    /// Open collections, innermost last.
    open: Vec<usize>,
    descriptor: Descriptor,
}

impl State {
    /// Processes the next item.
    pub(super) fn take(&mut self, item: Item) -> Result<(), DescriptorError> {
        match item.kind {
            ItemKind::Main => {
                self.main(item)?;
                self.locals = Locals::default();
            }
            ItemKind::Global => self.global(item)?,
            ItemKind::Local => self.local(item),
            ItemKind::Unknown => self.warn(item.offset, "an item of an unknown type is skipped"),
        }
        Ok(())
    }

    /// Returns the descriptor after its last item.
    pub(super) fn finish(mut self, n_bytes: usize) -> Result<Descriptor, DescriptorError> {
        if !self.open.is_empty() {
            self.warn(n_bytes, "a collection has no end; it ends with the descriptor");
        }
        if self.descriptor.reports.is_empty() {
            return Err(DescriptorError::NoReport);
        }
        let has_ids = self.descriptor.has_report_ids();
        if has_ids && self.descriptor.reports.iter().any(|report| report.id.is_none()) {
            self.warn(0, "only some reports have an id; the reports without an id are ignored");
            self.descriptor.reports.retain(|report| report.id.is_some());
        }
        Ok(self.descriptor)
    }

    fn warn(&mut self, offset: usize, what: &'static str) {
        self.descriptor.warnings.push(DescriptorWarning { offset, what });
    }

    fn main(&mut self, item: Item) -> Result<(), DescriptorError> {
        match item.tag {
            0x8 => self.field(item, ReportKind::Input),
            0x9 => self.field(item, ReportKind::Output),
            0xb => self.field(item, ReportKind::Feature),
            0xa => self.begin_collection(item),
            0xc => match self.open.pop() {
                Some(_) => Ok(()),
                None => Err(problem(item, "an end of collection without a collection")),
            },
            _ => {
                self.warn(item.offset, "an unknown main item is skipped");
                Ok(())
            }
        }
    }

    fn begin_collection(&mut self, item: Item) -> Result<(), DescriptorError> {
        if self.open.len() >= MAX_DEPTH {
            return Err(problem(item, "collections are nested too deeply"));
        }
        let page = self.globals.usage_page;
        let usage = self.locals.usages.first().map_or(Usage(0), |range| whole(*range, page).0);
        let parent = self.open.last().copied();
        self.open.push(self.descriptor.collections.len());
        self.descriptor.collections.push(Collection { usage, kind: item.data as u8, parent });
        Ok(())
    }

    fn field(&mut self, item: Item, kind: ReportKind) -> Result<(), DescriptorError> {
        let globals = self.globals;
        let (bit_size, count) = (globals.bit_size, globals.count);
        let id = globals.report_id;
        let reports = &mut self.descriptor.reports;
        let index = reports.iter().position(|report| (report.kind, report.id) == (kind, id));
        let index = index.unwrap_or_else(|| {
            reports.push(Report { kind, id, n_bits: if id.is_some() { 8 } else { 0 }, fields: Vec::new() });
            reports.len() - 1
        });
        if bit_size == 0 || count == 0 {
            // Some device families keep such empty items where a smaller model lacks a button.
            return Ok(());
        }
        let n_bits = u64::from(reports[index].n_bits) + u64::from(bit_size) * u64::from(count);
        if n_bits > 8 * u64::from(MAX_REPORT_BYTES) {
            return Err(problem(item, "the report exceeds the largest report length"));
        }
        let bit_offset = std::mem::replace(&mut reports[index].n_bits, n_bits as u32);
        let page = globals.usage_page;
        let usages: Vec<_> = self.locals.usages.iter().map(|range| whole(*range, page)).collect();
        let is_constant = item.data & 1 != 0;
        let (logical_min, logical_max) = range(globals.logical_min, globals.logical_max);
        let (mut physical_min, mut physical_max) = range(globals.physical_min, globals.physical_max);
        if (physical_min, physical_max) == (0, 0) {
            (physical_min, physical_max) = (logical_min, logical_max);
        }
        if usages.is_empty() && !is_constant {
            self.warn(item.offset, "fields without a usage are treated as padding");
        } else if logical_min > logical_max && !is_constant {
            self.warn(item.offset, "the logical maximum is below the logical minimum");
        }
        self.descriptor.reports[index].fields.push(Field {
            collection: self.open.last().copied(),
            bit_offset,
            bit_size,
            count,
            is_constant,
            is_variable: item.data & 2 != 0,
            is_relative: item.data & 4 != 0,
            has_null: item.data & 0x40 != 0,
            logical_min,
            logical_max,
            physical_min,
            physical_max,
            unit: globals.unit,
            unit_exponent: globals.unit_exponent,
            usages,
        });
        Ok(())
    }

    fn global(&mut self, item: Item) -> Result<(), DescriptorError> {
        let globals = &mut self.globals;
        match item.tag {
            0x0 => globals.usage_page = item.data as u16,
            0x1 => globals.logical_min = item.signed(),
            0x2 => globals.logical_max = Some(item),
            0x3 => globals.physical_min = item.signed(),
            0x4 => globals.physical_max = Some(item),
            0x5 => globals.unit_exponent = exponent(item),
            0x6 => globals.unit = item.data,
            0x7 if item.data > MAX_BIT_SIZE => {
                return Err(problem(item, "the report size (bits per field) is too large"));
            }
            0x7 => globals.bit_size = item.data,
            0x8 => {
                let id = u8::try_from(item.data).ok().filter(|id| *id > 0); // Others do not fit a byte.
                let id = id.ok_or(problem(item, "the report id must be 1 to 255"))?;
                globals.report_id = Some(id);
            }
            0x9 if item.data > MAX_COUNT => {
                return Err(problem(item, "the report count (number of fields) is too large"));
            }
            0x9 => globals.count = item.data,
            0xa if self.pushed.len() >= MAX_DEPTH => return Err(problem(item, "too many nested push items")),
            0xa => self.pushed.push(*globals),
            0xb => {
                let pushed = self.pushed.pop();
                *globals = pushed.ok_or(problem(item, "a pop item without a push item"))?;
            }
            _ => self.warn(item.offset, "an unknown global item is skipped"),
        }
        Ok(())
    }

    fn local(&mut self, item: Item) {
        let is_whole = item.n_bytes == 4;
        match item.tag {
            0x0 => self.usages(item.data, item.data, is_whole),
            0x1 => self.locals.min = Some((item.data, is_whole)),
            0x2 => match self.locals.min.take() {
                Some((min, min_is_whole)) if min <= item.data && is_whole == min_is_whole => {
                    self.usages(min, item.data, is_whole);
                }
                // If only one of the two includes its usage page, that page applies to both.
                Some((min, true)) if !is_whole && min as u16 <= item.data as u16 => {
                    self.usages(min, min & 0xffff_0000 | item.data & 0xffff, true);
                }
                _ => self.warn(item.offset, "a usage maximum without a usage minimum is skipped"),
            },
            // Designators and strings are ignored.
            0x3..=0x5 | 0x7..=0x9 => {}
            0xa if item.data == 1 => self.locals.delimited = Some(self.locals.usages.len()),
            0xa => self.locals.delimited = None,
            _ => self.warn(item.offset, "an unknown local item is skipped"),
        }
    }

    fn usages(&mut self, min: u32, max: u32, is_whole: bool) {
        if self.locals.delimited.is_none_or(|first| self.locals.usages.len() == first) {
            self.locals.usages.push((min, max, is_whole));
        }
    }
}

fn problem(item: Item, problem: &'static str) -> DescriptorError {
    DescriptorError::Item { offset: item.offset, problem }
}

/// First and last usage with their usage page: the current page, unless they include their own.
fn whole((min, max, is_whole): (u32, u32, bool), page: u16) -> (Usage, Usage) {
    if is_whole {
        (Usage(min), Usage(max))
    } else {
        (Usage::new(page, min as u16), Usage::new(page, max as u16))
    }
}

/// Signed range. Many devices store an unsigned maximum (0xFFFF in two bytes for 65535), which is detected here.
fn range(min: i64, max: Option<Item>) -> (i64, i64) {
    let max = match max {
        Some(max) if max.signed() < min && min >= 0 => i64::from(max.data),
        Some(max) => max.signed(),
        None => 0,
    };
    (min, max)
}

/// Unit exponent: a signed nibble by the specification, but many devices write a full signed number.
fn exponent(item: Item) -> i32 {
    match item.data {
        nibble @ 0..=7 => nibble.cast_signed(),
        nibble @ 8..=15 => nibble.cast_signed() - 16,
        _ => item.signed().clamp(-16, 16) as i32,
    }
}
