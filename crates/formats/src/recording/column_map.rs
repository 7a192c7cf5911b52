//! What the columns of a table, or the channels of a WAV file, are.

use std::fmt;

use shagreen_core::units::{MetersPerSecond, Newtons};

use crate::recording::units::{AccelerationUnit, ForceUnit, PositionUnit, SpeedUnit, TimeUnit};

/// What parts the columns of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Separator {
    /// `,`
    Comma,
    /// `;`
    Semicolon,
    /// A tab.
    Tab,
    /// Any number of spaces or tabs.
    Spaces,
}

/// A column of a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Column {
    /// By its name in the header, whole or without its unit, whatever the case.
    Name(String),
    /// By its place, from 1.
    Number(usize),
}

/// What a channel of a WAV file holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Channel {
    /// An axis of acceleration.
    Acceleration,
    /// The speed of the tip.
    Speed,
    /// The normal force.
    Force,
    /// Something else.
    Unused,
}

/// What is known of a file's columns or channels. `None` everywhere is a good start: the reader guesses what can be told
/// from the file, says so, and asks for the rest.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ColumnMap {
    /// What parts the columns.
    pub separator: Option<Separator>,
    /// Whether numbers have a decimal comma.
    pub decimal_comma: Option<bool>,
    /// Whether the first row names the columns.
    pub header: Option<bool>,
    /// The time column.
    pub time: Option<Column>,
    /// Its unit.
    pub time_unit: Option<TimeUnit>,
    /// Rate in Hz of a table without a time column. Where it is stated, a time column that is not named in `time` is not used.
    pub rate_hz: Option<f64>,
    /// One to three columns of acceleration.
    pub acceleration: Option<Vec<Column>>,
    /// Their unit; in a WAV file, the unit of `full_scale`.
    pub acceleration_unit: Option<AccelerationUnit>,
    /// How many of `acceleration_unit` one count of a table is; 1 where it is not stated.
    pub per_count: Option<f64>,
    /// Acceleration, in `acceleration_unit`, of a WAV sample of 1.0; in a table the range of the sensor, where known.
    pub full_scale: Option<f64>,
    /// The speed column.
    pub speed: Option<Column>,
    /// Its unit; in a WAV file, the unit of `speed_full_scale`.
    pub speed_unit: Option<SpeedUnit>,
    /// Speed, in `speed_unit`, of a WAV sample of 1.0.
    pub speed_full_scale: Option<f64>,
    /// Speed throughout, where it was not measured.
    pub constant_speed: Option<MetersPerSecond>,
    /// One to three columns of position, that speed follows from.
    pub positions: Option<Vec<Column>>,
    /// Their unit.
    pub position_unit: Option<PositionUnit>,
    /// The column of normal force.
    pub force: Option<Column>,
    /// Its unit; in a WAV file, the unit of `force_full_scale`.
    pub force_unit: Option<ForceUnit>,
    /// Force, in `force_unit`, of a WAV sample of 1.0.
    pub force_full_scale: Option<f64>,
    /// Whether pressing makes the force more negative.
    pub pressing_is_negative: Option<bool>,
    /// Normal force throughout, where it was not measured.
    pub constant_force: Option<Newtons>,
    /// What each channel of a WAV file is.
    pub channels: Option<Vec<Channel>>,
}

impl Separator {
    /// All of them.
    pub const ALL: &[Self] = &[Self::Comma, Self::Semicolon, Self::Tab, Self::Spaces];

    /// How it is written in a map.
    pub fn name(self) -> &'static str {
        match self {
            Self::Comma => "comma",
            Self::Semicolon => "semicolon",
            Self::Tab => "tab",
            Self::Spaces => "spaces",
        }
    }

    /// The separator of a name, or the character itself.
    pub fn parse(text: &str) -> Option<Self> {
        match text {
            "," => Some(Self::Comma),
            ";" => Some(Self::Semicolon),
            "\t" => Some(Self::Tab),
            " " => Some(Self::Spaces),
            _ => Self::ALL.iter().copied().find(|separator| separator.name() == text),
        }
    }
}

impl Channel {
    /// All of them.
    pub const ALL: &[Self] = &[Self::Acceleration, Self::Speed, Self::Force, Self::Unused];

    /// How it is written in a map.
    pub fn name(self) -> &'static str {
        match self {
            Self::Acceleration => "acceleration",
            Self::Speed => "speed",
            Self::Force => "force",
            Self::Unused => "unused",
        }
    }

    /// The channel of a name; `x`, `y` and `z` are axes of acceleration, and so is what begins with that word, as
    /// rendered signals have it.
    pub fn parse(text: &str) -> Option<Self> {
        match text {
            _ if text.starts_with(Self::Acceleration.name()) => Some(Self::Acceleration),
            "x" | "y" | "z" | "ax" | "ay" | "az" => Some(Self::Acceleration),
            _ => Self::ALL.iter().copied().find(|channel| channel.name() == text),
        }
    }
}

impl Column {
    /// A column by its place where the text is a whole number, else by its name.
    pub fn parse(text: &str) -> Self {
        text.trim().parse().map_or_else(|_| Self::Name(text.trim().to_owned()), Self::Number)
    }
}

impl fmt::Display for Column {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Name(name) => write!(f, "{name:?}"),
            Self::Number(number) => write!(f, "column {number}"),
        }
    }
}
