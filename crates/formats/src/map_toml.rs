//! The column map of a recording, read from a TOML file.
//!
//! Every key is optional; missing ones are guessed or asked for. An unknown key is an error, because its value would
//! have no effect.
//!
//! ```
//! let map = shagreen_formats::map_toml::read_map(br#"
//! separator = "semicolon"        # comma, semicolon, tab or spaces
//! decimal_comma = true
//! header = true
//! time = "t"                     # a column name, or a column number from 1
//! time_unit = "ms"               # s, ms, us or ns
//! rate_hz = 10000.0              # only if there is no time column
//! acceleration = ["ax", "ay", "az"]
//! acceleration_unit = "g"        # m/s^2, g or mg
//! per_count = 6.1e-5             # only for raw ADC counts: acceleration units per count
//! full_scale = 16.0              # acceleration of a WAV sample of 1.0, or the sensor range, in that unit
//! speed = "v"                    # or positions = ["x", "y"] with position_unit = "mm" (mm, m or um),
//! speed_unit = "mm/s"            # or constant_speed = "100 mm/s"
//! force = 6                      # or constant_force = "1 N"
//! force_unit = "N"               # N, mN or gf
//! pressing_is_negative = false
//! "#)?;
//! assert_eq!(map.time_unit, Some(shagreen_formats::recording::TimeUnit::Milliseconds));
//! # Ok::<(), shagreen_formats::map_toml::MapError>(())
//! ```
//!
//! A WAV file uses `channels = ["acceleration", "speed", "force", "unused"]`, `full_scale`, `speed_full_scale` and
//! `force_full_scale` instead of columns. A haptic clip uses `full_scale`, the constants, `frequency_range = [60, 300]` in Hz and
//! `rate_hz`.

use toml::Value;

use crate::parser_words::plain;
use crate::recording::{Ask, ColumnMap};

/// Why bytes are not a column map.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum MapError {
    /// The file is not UTF-8.
    #[error("the column map is not valid UTF-8 at byte {at}; save the file as UTF-8")]
    NotText {
        /// Offset of the first invalid byte, from zero.
        at: usize,
    },
    /// Not TOML, a key is unknown, or its value is invalid.
    #[error("cannot read the column map: {reason}; correct the file")]
    Damaged {
        /// What is wrong, with the line number, on one line.
        reason: String,
    },
}

/// Keys of constants, and the questions that they answer.
const CONSTANTS: [(&str, Ask); 2] = [("constant_speed", Ask::Speed), ("constant_force", Ask::Force)];

/// Keys that exclude each other.
const EXCLUSIVE: [[&str; 2]; 3] =
    [["constant_speed", "speed"], ["constant_speed", "positions"], ["constant_force", "force"]];

/// Reads a column map.
///
/// # Errors
/// See [`MapError`].
pub fn read_map(bytes: &[u8]) -> Result<ColumnMap, MapError> {
    let text = std::str::from_utf8(bytes).map_err(|error| MapError::NotText { at: error.valid_up_to() })?;
    let table: toml::Table = toml::from_str(text).map_err(|error| {
        let before = error.span().and_then(|span| text.get(..span.start));
        let line = before.map_or(1, |before| before.matches('\n').count() + 1);
        MapError::Damaged { reason: format!("{} in line {line}", plain(error.message())) }
    })?;
    for [constant, column] in EXCLUSIVE {
        if table.contains_key(constant) && table.contains_key(column) {
            let line = line_of(text, column).map_or(String::new(), |line| format!(" in line {line}"));
            let reason = format!("{column}{line} and {constant} exclude each other");
            return Err(MapError::Damaged { reason });
        }
    }
    let mut map = ColumnMap::default();
    for (key, value) in &table {
        let damaged = |problem: String| match line_of(text, key) {
            Some(line) => MapError::Damaged { reason: format!("{problem} in line {line}") },
            None => MapError::Damaged { reason: problem },
        };
        let constant = CONSTANTS.iter().find(|(name, _)| name == key);
        let Some(what) =
            constant.map(|(_, what)| *what).or_else(|| Ask::ALL.iter().copied().find(|ask| ask.key() == key))
        else {
            return Err(damaged(format!("unknown key {key:?}")));
        };
        let answer =
            answer_of(value).ok_or_else(|| damaged(format!("{key} cannot be a {}", value.type_str())))?;
        map.answer(what, &answer).map_err(|error| damaged(error.to_string()))?;
        let taken = if what == Ask::Speed { map.speed.is_some() } else { map.force.is_some() };
        if constant.is_some() && taken {
            return Err(damaged(format!(
                "{key} is {answer:?}, but must be a number with its unit, such as {:?}",
                if what == Ask::Speed { "100 mm/s" } else { "1 N" }
            )));
        }
    }
    Ok(map)
}

/// Converts a TOML value to the text form of an answer.
fn answer_of(value: &Value) -> Option<String> {
    match value {
        Value::String(text) => Some(text.clone()),
        Value::Integer(number) => Some(number.to_string()),
        Value::Float(number) => Some(number.to_string()),
        Value::Boolean(flag) => Some(if *flag { "yes" } else { "no" }.to_owned()),
        Value::Array(values) => {
            let answers: Option<Vec<String>> = values.iter().map(answer_of).collect();
            Some(answers?.join(","))
        }
        Value::Datetime(_) | Value::Table(_) => None,
    }
}

/// Returns the line, from one, that begins with a key.
fn line_of(text: &str, key: &str) -> Option<usize> {
    let begins =
        |line: &str| line.trim_start().trim_start_matches(['"', '\'', '[']).strip_prefix(key).is_some();
    text.lines().position(begins).map(|line| line + 1)
}

#[cfg(test)]
mod tests {
    use super::read_map;
    use crate::recording::{AccelerationUnit, Column};
    use shagreen_core::units::MetersPerSecond;

    #[track_caller]
    fn check_error(text: &str, words: &str) {
        let message = read_map(text.as_bytes()).unwrap_err().to_string();
        assert!(message.contains(words) && !message.contains('\n'), "{message}");
    }

    #[test]
    fn keys_are_answers() {
        let map = read_map(
            b"acceleration = [\"ax\", 3]\nacceleration_unit = \"m/s\xc2\xb2\"\nconstant_speed = \"50 mm/s\"",
        )
        .unwrap();
        assert_eq!(map.acceleration, Some(vec![Column::Name("ax".into()), Column::Number(3)]));
        assert_eq!(map.acceleration_unit, Some(AccelerationUnit::MetersPerSecondSquared));
        assert_eq!(map.constant_speed, Some(MetersPerSecond(0.05)));
    }

    #[test]
    fn what_is_wrong_is_named_with_its_line() {
        check_error("header = true\nspeeed = \"v\"", "unknown key \"speeed\" in line 2");
        check_error("time_unit = \"h\"", "one of s, ms, us, ns in line 1");
        check_error("a = [", "line 1");
        check_error("rate_hz = -5", "a number above 0");
        check_error("constant_speed = \"fast\"", "number with its unit, such as \"100 mm/s\"");
        check_error("constant_force = \"f\"", "number with its unit, such as \"1 N\"");
        check_error("speed = \"100 kg\"", "such as \"100 mm/s\"");
        check_error("force = -3", "such as \"1 N\"");
        check_error("speed = 2\nconstant_speed = \"1 m/s\"", "speed in line 1 and constant_speed exclude");
        check_error("time = 1979-05-27", "cannot be a datetime");
        assert!(read_map(b"\xff").unwrap_err().to_string().contains("byte 0"));
    }
}
