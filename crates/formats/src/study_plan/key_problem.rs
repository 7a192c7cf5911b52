//! Problems of keys, found before the plan is known.

/// A problem of a key.
pub(super) struct KeyProblem {
    pub(super) key: String,
    pub(super) text: String,
    /// Whether the whole table is not what was meant, so that its other problems mean nothing.
    hides_table: bool,
}

impl KeyProblem {
    pub(super) fn new(key: impl Into<String>, text: impl Into<String>) -> Self {
        Self { key: key.into(), text: text.into(), hides_table: false }
    }

    /// Notes that the whole table is not what was meant.
    pub(super) fn hide_table(&mut self) {
        self.hides_table = true;
    }

    /// Whether a problem with this key follows from this one.
    pub(super) fn hides(&self, key: &str) -> bool {
        let table = self.key.rsplit_once('.').map_or("", |(table, _)| table);
        self.hides_table && key.strip_prefix(table).is_some_and(|rest| rest.starts_with('.'))
    }
}
