//! The haptic controller that a report descriptor declares, and its reports.

use crate::haptic_pen::waveform::{Play, Waveform};
use crate::hid::descriptor::{Descriptor, Field, Report, ReportKind, Usage};

/// Usage page of haptics.
const HAPTICS: u16 = 0x0e;
/// Collection of a haptic controller.
const CONTROLLER: Usage = Usage::new(HAPTICS, 0x01);
/// Collection of the list of waveforms.
const WAVEFORM_LIST: Usage = Usage::new(HAPTICS, 0x10);
/// Waveform that plays by itself while the tip touches.
const AUTO_TRIGGER: Usage = Usage::new(HAPTICS, 0x20);
/// Waveform to play now.
const MANUAL_TRIGGER: Usage = Usage::new(HAPTICS, 0x21);
const INTENSITY: Usage = Usage::new(HAPTICS, 0x23);
/// Usage page of ordinals, whose ids number the entries of a list.
const ORDINALS: u16 = 0x0a;
/// Applications of a pen: digitizer, pen and stylus.
const PENS: [Usage; 3] = [Usage::new(0x0d, 0x01), Usage::new(0x0d, 0x02), Usage::new(0x0d, 0x20)];
/// Ordinals of "none" and "stop", which no list contains.
const NONE_ORDINAL: i64 = 1;
const STOP_ORDINAL: i64 = 2;
/// Most waveforms that are read; known pens have at most 16.
const MAX_WAVEFORMS: usize = 64;

/// Identity and length of a report.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ReportShape {
    /// Report id, its first byte, if the device uses report ids.
    pub id: Option<u8>,
    /// Length in bytes, including the id.
    pub n_bytes: usize,
}

/// A value of a report.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Slot {
    field: Field,
    index: u32,
}

/// A report that triggers a waveform, with the slots of waveform and intensity.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Trigger {
    shape: ReportShape,
    waveform: Slot,
    intensity: Option<Slot>,
    /// Other numbers of the report, such as repeats, which are set to zero or to the nearest permitted number.
    others: Vec<Slot>,
}

/// Source of an entry of the list of waveforms.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Entry {
    /// The descriptor states the waveform.
    Declared(Waveform),
    /// A feature report states it.
    Reported(ReportShape, Slot),
}

/// A waveform of a pen, with its ordinal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OfferedWaveform {
    /// The waveform.
    pub waveform: Waveform,
    /// Number by which the pen knows it.
    pub ordinal: u16,
}

/// Haptic controller of a pen.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct HapticController {
    manual: Option<Trigger>,
    automatic: Option<Trigger>,
    list: Vec<(u16, Entry)>,
}

impl HapticController {
    /// Returns the haptic controller of the pen that a descriptor declares; `None` if there is none.
    pub fn of_descriptor(descriptor: &Descriptor) -> Option<Self> {
        let manual = trigger(descriptor, ReportKind::Output, MANUAL_TRIGGER);
        let automatic = trigger(descriptor, ReportKind::Feature, AUTO_TRIGGER);
        let list = list(descriptor);
        let is_complete = (manual.is_some() || automatic.is_some()) && !list.is_empty();
        is_complete.then_some(Self { manual, automatic, list })
    }

    /// The feature reports that state waveforms, each once.
    pub fn list_reports(&self) -> Vec<ReportShape> {
        let mut shapes: Vec<ReportShape> = Vec::new();
        for (_, entry) in &self.list {
            if let Entry::Reported(shape, _) = entry
                && !shapes.contains(shape)
            {
                shapes.push(*shape);
            }
        }
        shapes
    }

    /// Number of entries of the list of waveforms, which may be empty.
    pub fn n_entries(&self) -> usize {
        self.list.len()
    }

    /// Whether a waveform can be set to play whenever the tip touches.
    pub fn is_automatic(&self) -> bool {
        self.automatic.is_some()
    }

    /// Whether the pen takes an intensity.
    pub fn has_intensity(&self) -> bool {
        [&self.manual, &self.automatic].into_iter().flatten().any(|trigger| trigger.intensity.is_some())
    }

    /// The waveforms of the pen, from the reports of [`Self::list_reports`] as they were read. Entries that are empty,
    /// unknown or cannot be triggered are left out.
    pub fn waveforms(&self, reports: &[(ReportShape, Vec<u8>)]) -> Vec<OfferedWaveform> {
        let read = |shape: &ReportShape, slot: &Slot| {
            let (_, bytes) = reports.iter().find(|(read, _)| read == shape)?;
            waveform(slot.field.value(bytes, slot.index)?)
        };
        let entry = |(ordinal, entry): &(u16, Entry)| {
            let waveform = match entry {
                Entry::Declared(waveform) => *waveform,
                Entry::Reported(shape, slot) => read(shape, slot)?,
            };
            let offered = OfferedWaveform { waveform, ordinal: *ordinal };
            let triggers = [&self.manual, &self.automatic];
            triggers.into_iter().flatten().any(|trigger| trigger.number(offered).is_some()).then_some(offered)
        };
        self.list.iter().filter_map(entry).collect()
    }

    /// The output report that plays a waveform now; `None` if the pen has no such report or number.
    pub fn manual_report(&self, offered: OfferedWaveform, intensity_percent: u8) -> Option<Vec<u8>> {
        let trigger = self.manual.as_ref()?;
        let report = trigger.shape.empty();
        trigger.filled(report, trigger.number(offered)?, intensity_percent)
    }

    /// The output report that ends what plays.
    pub fn stop_report(&self) -> Option<Vec<u8>> {
        let trigger = self.manual.as_ref()?;
        trigger.filled(trigger.shape.empty(), trigger.number_or(STOP_ORDINAL, Waveform::STOP)?, 0)
    }

    /// Id of the output report that plays waveforms.
    pub fn output_id(&self) -> Option<u8> {
        self.manual.as_ref()?.shape.id
    }

    /// The feature report that holds the waveform for a touching tip.
    pub fn automatic_shape(&self) -> Option<ReportShape> {
        Some(self.automatic.as_ref()?.shape)
    }

    /// That feature report with a waveform, or with none; `before` is the report as it was read, whose other values are
    /// kept.
    pub fn automatic_report(
        &self,
        before: &[u8],
        offered: Option<OfferedWaveform>,
        intensity_percent: u8,
    ) -> Option<Vec<u8>> {
        let trigger = self.automatic.as_ref()?;
        let number = match offered {
            Some(offered) => trigger.number(offered)?,
            None => trigger.number_or(NONE_ORDINAL, Waveform::NONE)?,
        };
        let mut report = before.to_vec();
        report.resize(trigger.shape.n_bytes, 0);
        let is_set = trigger.waveform.set(&mut report, number);
        trigger.set_intensity(&mut report, intensity_percent);
        is_set.then_some(report)
    }

    /// The waveform and the intensity of an output report; `None` if it is another report. The inverse of
    /// [`Self::manual_report`].
    pub fn played_by_output(&self, offered: &[OfferedWaveform], report: &[u8]) -> Option<Play> {
        self.manual.as_ref()?.played(offered, report)
    }

    /// The waveform and the intensity of the feature report for a touching tip; `None` if it is another report.
    pub fn played_by_feature(&self, offered: &[OfferedWaveform], report: &[u8]) -> Option<Play> {
        self.automatic.as_ref()?.played(offered, report)
    }
}

impl ReportShape {
    fn of(report: &Report) -> Self {
        Self { id: report.id, n_bytes: report.n_bytes() }
    }

    /// A report of this shape whose values are zero.
    fn empty(self) -> Vec<u8> {
        let mut report = vec![0; self.n_bytes];
        if let (Some(id), Some(first)) = (self.id, report.first_mut()) {
            *first = id;
        }
        report
    }

    fn is_of(self, report: &[u8]) -> bool {
        report.len() >= self.n_bytes && self.id.is_none_or(|id| report.first() == Some(&id))
    }
}

impl Slot {
    fn allows(&self, number: i64) -> bool {
        (self.field.logical_min..=self.field.logical_max).contains(&number)
    }

    fn set(&self, report: &mut [u8], number: i64) -> bool {
        self.field.set_value(report, self.index, number)
    }
}

impl Trigger {
    /// The number that triggers a waveform: its ordinal, or its usage id if the field holds usage ids.
    fn number(&self, offered: OfferedWaveform) -> Option<i64> {
        self.number_or(i64::from(offered.ordinal), offered.waveform)
    }

    fn number_or(&self, ordinal: i64, waveform: Waveform) -> Option<i64> {
        [ordinal, i64::from(waveform.0)].into_iter().find(|number| self.waveform.allows(*number))
    }

    fn filled(&self, mut report: Vec<u8>, number: i64, intensity_percent: u8) -> Option<Vec<u8>> {
        for other in &self.others {
            // An empty range has no permitted number.
            let (least, most) = (other.field.logical_min, other.field.logical_max);
            other.set(&mut report, 0_i64.max(least).min(most.max(least)));
        }
        self.set_intensity(&mut report, intensity_percent);
        self.waveform.set(&mut report, number).then_some(report)
    }

    fn set_intensity(&self, report: &mut [u8], percent: u8) {
        if let Some(intensity) = &self.intensity {
            let (least, most) = (intensity.field.logical_min, intensity.field.logical_max);
            let share = f64::from(percent.min(100)) / 100.0;
            let number = least as f64 + share * (most - least).max(0) as f64;
            intensity.set(report, number.round() as i64);
        }
    }

    fn played(&self, offered: &[OfferedWaveform], report: &[u8]) -> Option<Play> {
        if !self.shape.is_of(report) {
            return None;
        }
        let number = self.waveform.field.value(report, self.waveform.index)?;
        let found = offered.iter().find(|offered| self.number(**offered) == Some(number));
        let intensity = self.intensity.as_ref().and_then(|slot| {
            let (least, most) = (slot.field.logical_min, slot.field.logical_max);
            let value = slot.field.value(report, slot.index)?;
            (most > least).then(|| 100.0 * (value - least) as f64 / (most - least) as f64)
        });
        let intensity_percent = intensity.unwrap_or(100.0).round().clamp(0.0, 100.0) as u8;
        Some(found.map_or(Play::SILENCE, |found| Play { waveform: Some(found.waveform), intensity_percent }))
    }
}

/// The report of this kind with a field of this usage within a haptic controller of a pen.
fn trigger(descriptor: &Descriptor, kind: ReportKind, usage: Usage) -> Option<Trigger> {
    descriptor.reports.iter().filter(|report| report.kind == kind).find_map(|report| {
        let slots = || {
            let is_ours = move |field: &&Field| {
                field.is_variable && !field.is_constant && is_of_controller(descriptor, field)
            };
            report.fields.iter().filter(is_ours).flat_map(slots_of)
        };
        let slot_of = |usage: Usage| slots().find(|(found, _)| *found == usage).map(|(_, slot)| slot);
        let others = slots().filter(|(found, _)| ![usage, INTENSITY].contains(found)).map(|(_, slot)| slot);
        Some(Trigger {
            shape: ReportShape::of(report),
            waveform: slot_of(usage)?,
            intensity: slot_of(INTENSITY),
            others: others.take(MAX_WAVEFORMS).collect(),
        })
    })
}

/// The entries of the list of waveforms by their ordinals.
fn list(descriptor: &Descriptor) -> Vec<(u16, Entry)> {
    let features = descriptor.reports.iter().filter(|report| report.kind == ReportKind::Feature);
    let fields = features.flat_map(|report| report.fields.iter().map(move |field| (report, field)));
    let in_list = fields.filter(|(_, field)| {
        is_of_controller(descriptor, field)
            && descriptor.collections_of(field).next().is_some_and(|inner| inner.usage == WAVEFORM_LIST)
    });
    let entries = in_list.flat_map(|(report, field)| slots_of(field).map(move |found| (report, found)));
    let mut list: Vec<(u16, Entry)> = Vec::new();
    for (report, (usage, slot)) in entries {
        let ordinal = usage.id();
        let is_new = list.iter().all(|(known, _)| *known != ordinal);
        let is_listed = usage.page() == ORDINALS && i64::from(ordinal) > STOP_ORDINAL;
        if !is_listed || !is_new || list.len() == MAX_WAVEFORMS {
            continue;
        }
        let field = &slot.field;
        if field.is_constant || field.logical_min == field.logical_max {
            // The physical value is the usage id of the waveform, the logical one mostly its ordinal.
            let stated = waveform(field.physical_min).or_else(|| waveform(field.logical_min));
            list.extend(stated.map(|waveform| (ordinal, Entry::Declared(waveform))));
        } else {
            list.push((ordinal, Entry::Reported(ReportShape::of(report), slot)));
        }
    }
    list
}

/// The slots of a field with their usages, at most [`MAX_WAVEFORMS`].
fn slots_of(field: &Field) -> impl Iterator<Item = (Usage, Slot)> + '_ {
    (0..field.count.min(MAX_WAVEFORMS as u32))
        .filter_map(move |index| Some((field.usage(index)?, Slot { field: field.clone(), index })))
}

fn is_of_controller(descriptor: &Descriptor, field: &Field) -> bool {
    descriptor.collections_of(field).any(|collection| collection.usage == CONTROLLER)
        && descriptor.application_of(field).is_some_and(|application| PENS.contains(&application))
}

/// The waveform with this usage id, if it is one to play.
fn waveform(id: i64) -> Option<Waveform> {
    let waveform = Waveform(u16::try_from(id).ok().filter(|_| Waveform::IDS.contains(&id))?);
    (waveform > Waveform::STOP).then_some(waveform)
}

#[cfg(test)]
mod tests;
