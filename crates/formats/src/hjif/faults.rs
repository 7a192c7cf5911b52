//! Collected faults of a file, and what its parts are checked against.

use std::collections::BTreeSet;

use crate::first_faults::FirstFaults;
use crate::hjif::rule::{Fault, Rule};
use crate::hjif::tree::Profile;

/// Most characters of a text in a fault.
pub(super) const MOST_SHOWN: usize = 40;

/// What parts of a file are checked against: its profile and level, and the library of their perception.
pub(super) struct Context<'a> {
    pub(super) profile: Profile,
    pub(super) level: u32,
    /// Ids of the reference devices of the perception.
    pub(super) devices: BTreeSet<i32>,
    /// Ids of the effects in the library of the perception.
    pub(super) effects: BTreeSet<i32>,
    /// Scheme of semantic keywords of the perception.
    pub(super) scheme: Option<&'a str>,
}

/// Faults of a file that were found so far.
#[derive(Default)]
pub(super) struct Faults(pub(super) FirstFaults<Fault>);

impl Faults {
    pub(super) fn add(&mut self, place: impl Into<String>, rule: Rule) {
        self.0.add(Fault { place: place.into(), rule });
    }

    /// Adds a fault for each id that an earlier part has already; `place` is that of the list.
    pub(super) fn check_unique(&mut self, place: &str, what: &'static str, ids: impl Iterator<Item = i32>) {
        let mut seen = BTreeSet::new();
        for (index, id) in ids.enumerate() {
            if !seen.insert(id) {
                self.add(format!("{place}[{index}].id"), Rule::Twice { what, id });
            }
        }
    }

    /// Adds a fault if there are more parts than the level allows. A level that does not exist is a fault of its own.
    pub(super) fn check_number(
        &mut self,
        place: &str,
        (what, n): (&'static str, usize),
        most_by_level: [usize; 2],
        level: u32,
    ) {
        let most = (level as usize).checked_sub(1).and_then(|index| most_by_level.get(index));
        if let Some(most) = most.copied().filter(|most| n > *most) {
            self.add(place, Rule::TooMany { what, n, most, level });
        }
    }

    /// Adds a fault if the first number is above the second one.
    pub(super) fn check_order(&mut self, place: &str, low: (&'static str, f64), high: (&'static str, f64)) {
        let ((low_name, low), (high_name, high)) = (low, high);
        if low > high {
            self.add(place, Rule::Order { low_name, low, high_name, high });
        }
    }
}
