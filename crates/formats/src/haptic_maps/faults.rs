//! Collected faults of a scene, and access to its lists.

use std::fmt;

use serde_json::Value;

use crate::first_faults::FirstFaults;
use crate::text_limits::begin_of;

/// Most characters of a value in a fault.
const MOST_SHOWN: usize = 40;

/// Fault of a scene, and its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GltfFault {
    /// Fields and indices that lead to the value, such as `textures[0].source`.
    pub place: String,
    /// What is wrong, and what to do.
    pub reason: String,
}

impl fmt::Display for GltfFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.place, self.reason)
    }
}

/// A scene that is checked, with the faults found so far.
pub(super) struct Scene<'a> {
    root: &'a Value,
    pub(super) faults: FirstFaults<GltfFault>,
}

impl<'a> Scene<'a> {
    pub(super) fn new(root: &'a Value) -> Self {
        Self { root, faults: FirstFaults::default() }
    }

    pub(super) fn add(&mut self, place: impl Into<String>, reason: impl Into<String>) {
        self.faults.add(GltfFault { place: place.into(), reason: reason.into() });
    }

    /// A list of the scene, empty if there is none.
    pub(super) fn list(&self, name: &str) -> &'a [Value] {
        list_of(self.root, name)
    }

    /// Adds a fault if an index, where one is given, is no whole number or beyond the list. Returns a valid index.
    pub(super) fn check_index(
        &mut self,
        place: impl FnOnce() -> String,
        index: Option<&Value>,
        (list, n): (&str, usize),
    ) -> Option<usize> {
        let index = index?;
        let valid = index.as_u64().filter(|index| *index < n as u64);
        if valid.is_none() {
            let shown = begin_of(index.to_string(), MOST_SHOWN);
            self.add(place(), format!("{shown} is no index of {list}, which has {n} entries; correct it"));
        }
        valid.map(|index| index as usize)
    }
}

/// A list in an object, empty if there is none.
pub(super) fn list_of<'a>(object: &'a Value, name: &str) -> &'a [Value] {
    object.get(name).and_then(Value::as_array).map_or(&[], Vec::as_slice)
}

/// A whole number in an object, or its default.
pub(super) fn number_of(object: &Value, name: &str, default: u64) -> u64 {
    object.get(name).and_then(Value::as_u64).unwrap_or(default)
}
