//! Shape as text, for the command line: `level=-3,grain=1.2`, or `neutral`.

use std::fmt;
use std::str::FromStr;

use crate::texture::shape::{Shape, ShapeControl, ShapeError};

/// Text of a shape that changes nothing.
const NEUTRAL: &str = "neutral";
/// Longest part of a text that an error repeats, in characters.
const LONGEST_SHOWN: usize = 40;

/// All controls that are not neutral, in the order of [`ShapeControl::ALL`]; reading the text gives the same shape.
impl fmt::Display for Shape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_neutral() {
            return f.write_str(NEUTRAL);
        }
        for (i, control) in self.changed().enumerate() {
            let comma = if i == 0 { "" } else { "," };
            write!(f, "{comma}{}={}", control.id(), self.get(control))?;
        }
        Ok(())
    }
}

impl Shape {
    /// The shape as text; `None` if it is neutral.
    pub fn text(&self) -> Option<String> {
        (!self.is_neutral()).then(|| self.to_string())
    }
}

impl FromStr for Shape {
    type Err = ShapeError;

    /// Reads `control=value` separated by commas, in any order. Controls that are not named are neutral.
    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let mut shape = Self::default();
        if text.trim() == NEUTRAL {
            return Ok(shape);
        }
        let mut known: Vec<ShapeControl> = Vec::new();
        for part in text.split(',').map(str::trim) {
            let (name, value) = part.split_once('=').ok_or_else(|| ShapeError::Part { part: shown(part) })?;
            let control = control_of(name.trim())?;
            if known.contains(&control) {
                return Err(ShapeError::Twice { control });
            }
            known.push(control);
            let value = number(control, value.trim())?;
            if !control.limits().contains(&value) {
                return Err(ShapeError::Value { control, value });
            }
            shape = shape.with(control, value);
        }
        Ok(shape)
    }
}

fn number(control: ShapeControl, text: &str) -> Result<f64, ShapeError> {
    text.parse().map_err(|_| ShapeError::NotANumber { control, value: shown(text) })
}

fn control_of(name: &str) -> Result<ShapeControl, ShapeError> {
    let all = || ShapeControl::ALL.into_iter().map(ShapeControl::id);
    if let Some(control) = ShapeControl::ALL.into_iter().find(|control| control.id() == name) {
        return Ok(control);
    }
    let lower = name.to_lowercase();
    let is_near = |id: &&str| {
        let is_part = lower.chars().count() > 2 && (id.contains(&lower) || lower.contains(id));
        is_part || strsim::levenshtein(&lower, id) <= 1 + lower.chars().count() / 3
    };
    let near: Vec<&str> = all().filter(is_near).collect();
    let meant = if near.is_empty() {
        format!("its controls are {}", all().collect::<Vec<_>>().join(", "))
    } else {
        format!("did you mean {}?", near.join(" or "))
    };
    Err(ShapeError::Name { name: shown(name), meant })
}

/// Beginning of a text of any length.
fn shown(text: &str) -> String {
    if text.chars().count() > LONGEST_SHOWN {
        text.chars().take(LONGEST_SHOWN).chain(['…']).collect()
    } else {
        text.to_owned()
    }
}
