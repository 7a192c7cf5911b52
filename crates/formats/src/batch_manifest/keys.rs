//! Keys of a table in a manifest: each is read with its type and range, and problems are collected.

use std::ops::RangeInclusive;

use toml::{Table, Value};

use crate::batch_manifest::shown;
use crate::toml_lines::known_keys;

/// A problem of a key.
#[derive(Debug)]
pub(super) struct KeyProblem {
    pub(super) key: String,
    pub(super) text: String,
}

/// A table and its place in the file.
pub(super) struct Keys<'t, 'p> {
    table: &'t Table,
    /// Key of the table with its final dot; empty for the whole file.
    at: String,
    problems: &'p mut Vec<KeyProblem>,
}

impl<'t, 'p> Keys<'t, 'p> {
    /// A table with these known keys; others are problems.
    pub(super) fn new(
        table: &'t Table,
        at: String,
        known: &[&str],
        problems: &'p mut Vec<KeyProblem>,
    ) -> Self {
        let mut keys = Self { table, at, problems };
        for key in table.keys().filter(|key| !known.contains(&key.as_str())) {
            keys.problem(key, format!("the key is unknown; {}", known_keys(known, key)));
        }
        keys
    }

    pub(super) fn problem(&mut self, key: &str, text: String) {
        self.problems.push(KeyProblem { key: format!("{}{key}", self.at), text });
    }

    pub(super) fn has(&self, key: &str) -> bool {
        self.table.contains_key(key)
    }

    /// The value of a key that is needed; `needs` says what it is.
    pub(super) fn need<T: Default>(&mut self, key: &str, value: Option<T>, needs: &str) -> T {
        value.unwrap_or_else(|| {
            // A value of another type has been reported already.
            if !self.has(key) {
                self.problem(key, format!("the key is missing; add it with {needs}"));
            }
            T::default()
        })
    }

    /// The text of a key, not empty and with at most `most` characters.
    pub(super) fn text(&mut self, key: &str, most: usize) -> Option<String> {
        let value = self.table.get(key)?;
        let found = value.as_str().filter(|text| !text.trim().is_empty() && text.chars().count() <= most);
        if found.is_none() {
            self.wrong(key, value, &format!("a text with 1 to {most} characters"));
        }
        found.map(str::to_owned)
    }

    /// The number of a key.
    pub(super) fn number(&mut self, key: &str, range: &RangeInclusive<f64>) -> Option<f64> {
        let value = self.table.get(key)?;
        let found = number(value).filter(|number| range.contains(number));
        if found.is_none() {
            self.wrong(key, value, &format!("a number from {} to {}", range.start(), range.end()));
        }
        found
    }

    /// The whole number of a key.
    pub(super) fn whole(&mut self, key: &str, range: &RangeInclusive<u64>) -> Option<u64> {
        let value = self.table.get(key)?;
        let found = value.as_integer().and_then(|number| u64::try_from(number).ok());
        let found = found.filter(|number| range.contains(number));
        if found.is_none() {
            self.wrong(key, value, &format!("a whole number from {} to {}", range.start(), range.end()));
        }
        found
    }

    pub(super) fn flag(&mut self, key: &str) -> Option<bool> {
        let value = self.table.get(key)?;
        if value.as_bool().is_none() {
            self.wrong(key, value, "true or false");
        }
        value.as_bool()
    }

    /// The text of a key as one of these words.
    pub(super) fn word<T>(&mut self, key: &str, of: impl Fn(&str) -> Option<T>, words: &str) -> Option<T> {
        let value = self.table.get(key)?;
        let found = value.as_str().and_then(of);
        if found.is_none() {
            self.wrong(key, value, &format!("one of {words}"));
        }
        found
    }

    /// The texts of a key: a list, not empty.
    pub(super) fn texts(&mut self, key: &str, most: usize) -> Option<Vec<String>> {
        let value = self.table.get(key)?;
        let text = |value: &Value| Some(value.as_str().filter(|text| !text.is_empty())?.to_owned());
        let found: Option<Vec<String>> =
            value.as_array().and_then(|values| values.iter().map(text).collect());
        let found = found.filter(|texts| (1..=most).contains(&texts.len()));
        if found.is_none() {
            self.wrong(key, value, &format!("a list of 1 to {most} texts"));
        }
        found
    }

    /// The points of a key: a list of lists of numbers, each with at least one.
    pub(super) fn points(&mut self, key: &str, range: &RangeInclusive<usize>) -> Option<Vec<Vec<f64>>> {
        let value = self.table.get(key)?;
        let point = |value: &Value| -> Option<Vec<f64>> {
            let numbers = value.as_array().filter(|numbers| !numbers.is_empty())?;
            numbers.iter().map(number).collect()
        };
        let found: Option<Vec<Vec<f64>>> =
            value.as_array().and_then(|values| values.iter().map(point).collect());
        let found = found.filter(|points| range.contains(&points.len()));
        if found.is_none() {
            let needs = format!(
                "a list of {} to {} points, such as [[30, 70], [40, 60]]",
                range.start(),
                range.end()
            );
            self.wrong(key, value, &needs);
        }
        found
    }

    /// The tables of a key, at most `most`.
    pub(super) fn tables(&mut self, key: &str, most: usize) -> Vec<&'t Table> {
        let Some(value) = self.table.get(key) else { return Vec::new() };
        let found: Option<Vec<&'t Table>> =
            value.as_array().and_then(|values| values.iter().map(Value::as_table).collect());
        let found = found.filter(|tables| tables.len() <= most);
        if found.is_none() {
            self.wrong(key, value, &format!("at most {most} tables, each after a line [[{key}]]"));
        }
        found.unwrap_or_default()
    }

    fn wrong(&mut self, key: &str, value: &Value, needs: &str) {
        self.problem(key, format!("it is {}, but must be {needs}", shown(value)));
    }
}

/// A finite number, which may be written without a decimal point.
fn number(value: &Value) -> Option<f64> {
    let number = value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64));
    number.filter(|number| number.is_finite())
}
