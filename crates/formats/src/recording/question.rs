//! Facts that a file does not state, and the answers to them.

use std::fmt;

use shagreen_core::units::{MetersPerSecond, Newtons};

use crate::recording::RecordingFileError;
use crate::recording::column_map::{Channel, Column, ColumnMap, Separator};
use crate::recording::units::{AccelerationUnit, ForceUnit, PositionUnit, SpeedUnit, TimeUnit};

/// A question. Its name is the key in the column map that answers it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Ask {
    /// The column separator.
    Separator,
    /// Whether numbers have a decimal comma.
    DecimalComma,
    /// Whether the first row names the columns.
    Header,
    /// The time column.
    Time,
    /// The unit of time.
    TimeUnit,
    /// The sample rate in Hz.
    RateHz,
    /// The acceleration columns.
    Acceleration,
    /// The unit of acceleration.
    AccelerationUnit,
    /// Acceleration of one ADC count of a table.
    PerCount,
    /// Acceleration of a WAV sample, or of an amplitude in a haptic clip, of 1.0.
    FullScale,
    /// The speed column, a constant speed, or the position columns to compute it from.
    Speed,
    /// The unit of speed.
    SpeedUnit,
    /// Speed of a WAV sample of 1.0.
    SpeedFullScale,
    /// The position columns.
    Positions,
    /// The unit of position.
    PositionUnit,
    /// The column of normal force, or a constant force.
    Force,
    /// The unit of force.
    ForceUnit,
    /// Force of a WAV sample of 1.0.
    ForceFullScale,
    /// Whether pressing makes the force more negative.
    PressingIsNegative,
    /// Contents of the WAV channels.
    Channels,
    /// Frequencies of 0 and of 1 in a haptic clip.
    FrequencyRange,
}

/// A fact that a file does not state.
#[derive(Clone, Debug, PartialEq)]
pub struct Question {
    /// What is asked.
    pub what: Ask,
    /// The answer that the reader assumed, in the form of [`ColumnMap::answer`]; without a guess it could not continue.
    pub guess: Option<String>,
    /// Plausible answers, in the form of [`ColumnMap::answer`]; empty if a number is needed.
    pub choices: Vec<String>,
    /// The question as a sentence, with the reason for the guess.
    pub text: String,
}

/// Why an answer is invalid.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{key} cannot be {answer:?}; give {needs}")]
pub struct AnswerError {
    /// The key in the column map.
    pub key: &'static str,
    /// The given answer.
    pub answer: String,
    /// What is needed instead.
    pub needs: String,
}

impl Ask {
    /// All questions.
    pub const ALL: &[Self] = &[
        Self::Separator,
        Self::DecimalComma,
        Self::Header,
        Self::Time,
        Self::TimeUnit,
        Self::RateHz,
        Self::Acceleration,
        Self::AccelerationUnit,
        Self::PerCount,
        Self::FullScale,
        Self::Speed,
        Self::SpeedUnit,
        Self::SpeedFullScale,
        Self::Positions,
        Self::PositionUnit,
        Self::Force,
        Self::ForceUnit,
        Self::ForceFullScale,
        Self::PressingIsNegative,
        Self::Channels,
        Self::FrequencyRange,
    ];

    /// Returns the question that a key of the column map answers.
    pub fn from_key(key: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|ask| ask.key() == key)
    }

    /// The key in the column map.
    pub fn key(self) -> &'static str {
        match self {
            Self::Separator => "separator",
            Self::DecimalComma => "decimal_comma",
            Self::Header => "header",
            Self::Time => "time",
            Self::TimeUnit => "time_unit",
            Self::RateHz => "rate_hz",
            Self::Acceleration => "acceleration",
            Self::AccelerationUnit => "acceleration_unit",
            Self::PerCount => "per_count",
            Self::FullScale => "full_scale",
            Self::Speed => "speed",
            Self::SpeedUnit => "speed_unit",
            Self::SpeedFullScale => "speed_full_scale",
            Self::Positions => "positions",
            Self::PositionUnit => "position_unit",
            Self::Force => "force",
            Self::ForceUnit => "force_unit",
            Self::ForceFullScale => "force_full_scale",
            Self::PressingIsNegative => "pressing_is_negative",
            Self::Channels => "channels",
            Self::FrequencyRange => "frequency_range",
        }
    }
}

impl ColumnMap {
    /// Stores the answer to a question. Commas separate list items. A column is its name or its number from 1. A speed
    /// or force may also be a constant, a number with its unit such as `100 mm/s` or `1 N`. A constant and a column
    /// exclude each other: the later answer applies.
    ///
    /// # Errors
    /// [`AnswerError`]; the map is then unchanged.
    pub fn answer(&mut self, what: Ask, answer: &str) -> Result<(), AnswerError> {
        let answer = answer.trim();
        let error = |needs: String| AnswerError { key: what.key(), answer: answer.to_owned(), needs };
        let one_of = |names: &[&str]| error(format!("one of {}", names.join(", ")));
        macro_rules! named {
            ($type:ty) => {
                Some(
                    <$type>::parse(answer).ok_or_else(|| {
                        one_of(&<$type>::ALL.iter().map(|one| one.name()).collect::<Vec<_>>())
                    })?,
                )
            };
        }
        let flag = || match answer {
            "yes" | "true" => Ok(Some(true)),
            "no" | "false" => Ok(Some(false)),
            _ => Err(one_of(&["yes", "no"])),
        };
        let above_zero = || match answer.parse::<f64>() {
            Ok(number) if number.is_finite() && number > 0.0 => Ok(Some(number)),
            _ => Err(error("a number above 0".to_owned())),
        };
        let column = || {
            if answer.is_empty() {
                Err(error("a column name, or a column number from 1".to_owned()))
            } else {
                Ok(Some(Column::parse(answer)))
            }
        };
        let columns = || {
            let columns: Vec<Column> = answer.split(',').map(Column::parse).collect();
            if (1..=3).contains(&columns.len()) && !answer.is_empty() {
                Ok(Some(columns))
            } else {
                Err(error("one to three columns, separated by commas".to_owned()))
            }
        };
        let needs = |quantity: String| format!("a column, or {quantity}");
        match what {
            Ask::Separator => self.separator = named!(Separator),
            Ask::DecimalComma => self.decimal_comma = flag()?,
            Ask::Header => self.header = flag()?,
            Ask::Time => self.time = column()?,
            Ask::TimeUnit => self.time_unit = named!(TimeUnit),
            Ask::RateHz => self.rate_hz = above_zero()?,
            Ask::Acceleration => self.acceleration = columns()?,
            Ask::AccelerationUnit => self.acceleration_unit = named!(AccelerationUnit),
            Ask::PerCount => self.per_count = above_zero()?,
            Ask::FullScale => self.full_scale = above_zero()?,
            Ask::Speed => match quantity(answer, |unit| SpeedUnit::parse(unit).map(SpeedUnit::si)) {
                Some(speed_mps) => {
                    self.constant_speed = Some(MetersPerSecond(speed_mps));
                    self.speed = None;
                }
                None if is_bad_quantity(answer, |unit| SpeedUnit::parse(unit).is_some()) => {
                    return Err(error(needs(speed_needs())));
                }
                None => {
                    self.speed = column()?;
                    self.constant_speed = None;
                }
            },
            Ask::SpeedUnit => self.speed_unit = named!(SpeedUnit),
            Ask::SpeedFullScale => self.speed_full_scale = above_zero()?,
            Ask::Positions => {
                self.positions = columns()?;
                (self.speed, self.constant_speed) = (None, None);
            }
            Ask::PositionUnit => self.position_unit = named!(PositionUnit),
            Ask::Force => match quantity(answer, |unit| ForceUnit::parse(unit).map(ForceUnit::si)) {
                Some(force_n) => {
                    self.constant_force = Some(Newtons(force_n));
                    self.force = None;
                }
                None if is_bad_quantity(answer, |unit| ForceUnit::parse(unit).is_some()) => {
                    return Err(error(needs(force_needs())));
                }
                None => {
                    self.force = column()?;
                    self.constant_force = None;
                }
            },
            Ask::ForceUnit => self.force_unit = named!(ForceUnit),
            Ask::ForceFullScale => self.force_full_scale = above_zero()?,
            Ask::PressingIsNegative => self.pressing_is_negative = flag()?,
            Ask::Channels => {
                let channels: Option<Vec<Channel>> =
                    answer.split(',').map(|name| Channel::parse(name.trim())).collect();
                let names: Vec<&str> = Channel::ALL.iter().map(|channel| channel.name()).collect();
                self.channels = Some(channels.ok_or_else(|| one_of(&names))?);
            }
            Ask::FrequencyRange => {
                let range = frequency_range_hz(answer);
                let needs = || error("two frequencies in Hz, the lower one first, such as 60-300".to_owned());
                self.frequency_range_hz = Some(range.ok_or_else(needs)?);
            }
        }
        Ok(())
    }

    /// Returns an error if the answer to this question, speed or force, names a column, but the file has no columns. `file` names it.
    pub(super) fn refuse_column(&self, what: Ask, file: &str) -> Result<(), RecordingFileError> {
        let (column, needs) = match what {
            Ask::Speed => (&self.speed, speed_needs()),
            _ => (&self.force, force_needs()),
        };
        let given = match column {
            Some(Column::Name(name)) => name.clone(),
            Some(Column::Number(number)) => number.to_string(),
            None => return Ok(()),
        };
        let problem = format!(
            "{} is {given:?}, which could only be a column, but {file} has no columns; state {needs}",
            what.key()
        );
        Err(RecordingFileError::Map { problem })
    }
}

/// What a constant speed is.
fn speed_needs() -> String {
    constant_needs(SpeedUnit::ALL.iter().map(|unit| unit.name()), "100 mm/s")
}

/// What a constant force is.
fn force_needs() -> String {
    constant_needs(ForceUnit::ALL.iter().map(|unit| unit.name()), "1 N")
}

fn constant_needs(units: impl Iterator<Item = &'static str>, example: &str) -> String {
    let units: Vec<&str> = units.collect();
    format!("a number of at least 0 with its unit ({}), such as {example:?}", units.join(", "))
}

/// Parses two frequencies in Hz, such as `60-300`, `60 to 300 Hz` or `60,300`.
fn frequency_range_hz(text: &str) -> Option<[f64; 2]> {
    let text = text.trim_end_matches("Hz").trim_end();
    let (low, high) =
        text.split_once(" to ").or_else(|| text.split_once(',')).or_else(|| text.split_once('-'))?;
    // What is no number is no answer.
    let [low, high]: [f64; 2] = [low.trim().parse().ok()?, high.trim().parse().ok()?];
    (low >= 0.0 && high > low && high.is_finite()).then_some([low, high])
}

/// Parses a non-negative number with its unit; returns the value in SI units.
fn quantity(text: &str, si: impl Fn(&str) -> Option<f64>) -> Option<f64> {
    let end = text.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(text.len());
    let (number, unit) = text.split_at(end);
    let number: f64 = number.parse().ok()?;
    Some(number * si(unit)?).filter(|value| value.is_finite())
}

/// Returns whether a text that is not a [`quantity`] looks like one: a number that is not a column number, a number and a word, or
/// a number before a unit.
fn is_bad_quantity(text: &str, is_unit: impl Fn(&str) -> bool) -> bool {
    if let Ok(number) = text.parse::<f64>() {
        return !text.parse::<usize>().is_ok_and(|place| place > 0) && !number.is_nan();
    }
    let end = text.find(|c: char| !c.is_ascii_digit() && !"+-.".contains(c)).unwrap_or(text.len());
    let (number, unit) = text.split_at(end);
    if number.parse::<f64>().is_ok() && is_unit(unit) {
        return true;
    }
    let mut words = text.split_whitespace();
    words.next().is_some_and(|first| first.parse::<f64>().is_ok()) && words.count() == 1
}

impl fmt::Display for Question {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.what.key(), self.text)?;
        match &self.guess {
            Some(guess) => write!(f, "; assumed: {guess}"),
            None if self.choices.is_empty() => Ok(()),
            None => write!(f, " ({})", self.choices.join(" | ")),
        }
    }
}
