//! Meaning of the columns of a table or the channels of a WAV file.

use std::fmt;

use shagreen_core::units::{MetersPerSecond, Newtons};

use crate::recording::units::{AccelerationUnit, ForceUnit, PositionUnit, SpeedUnit, TimeUnit};

/// The column separator of a table.
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

/// A reference to a column of a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Column {
    /// Name in the header, with or without its unit, ignoring case.
    Name(String),
    /// Column number, from 1.
    Number(usize),
}

/// Contents of a WAV channel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Channel {
    /// An axis of acceleration.
    Acceleration,
    /// The tip speed.
    Speed,
    /// The normal force.
    Force,
    /// Other data.
    Unused,
}

/// Known facts about the columns or channels of a file. Start with `None` everywhere: the reader guesses what the file
/// implies, reports it, and asks for the rest.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ColumnMap {
    /// The column separator.
    pub separator: Option<Separator>,
    /// Whether numbers have a decimal comma.
    pub decimal_comma: Option<bool>,
    /// Whether the first row names the columns.
    pub header: Option<bool>,
    /// The time column.
    pub time: Option<Column>,
    /// Unit of the time column.
    pub time_unit: Option<TimeUnit>,
    /// Sample rate in Hz of a table without a time column, or of the signal that a haptic clip becomes. If it is stated, a time column that `time` does not name is
    /// not used.
    pub rate_hz: Option<f64>,
    /// One to three columns of acceleration.
    pub acceleration: Option<Vec<Column>>,
    /// Unit of acceleration; in a WAV file, the unit of `full_scale`.
    pub acceleration_unit: Option<AccelerationUnit>,
    /// Acceleration of one ADC count of a table, in `acceleration_unit`; 1 if not stated.
    pub per_count: Option<f64>,
    /// Acceleration of a WAV sample or of an amplitude in a haptic clip of 1.0, in `acceleration_unit`; in a table, the range of
    /// the sensor if known.
    pub full_scale: Option<f64>,
    /// The speed column.
    pub speed: Option<Column>,
    /// Unit of speed; in a WAV file, the unit of `speed_full_scale`.
    pub speed_unit: Option<SpeedUnit>,
    /// Speed of a WAV sample of 1.0, in `speed_unit`.
    pub speed_full_scale: Option<f64>,
    /// Constant speed, if it was not measured.
    pub constant_speed: Option<MetersPerSecond>,
    /// One to three columns of position, from which speed is computed.
    pub positions: Option<Vec<Column>>,
    /// Unit of position.
    pub position_unit: Option<PositionUnit>,
    /// The column of normal force.
    pub force: Option<Column>,
    /// Unit of force; in a WAV file, the unit of `force_full_scale`.
    pub force_unit: Option<ForceUnit>,
    /// Force of a WAV sample of 1.0, in `force_unit`.
    pub force_full_scale: Option<f64>,
    /// Whether pressing makes the force more negative.
    pub pressing_is_negative: Option<bool>,
    /// Constant normal force, if it was not measured.
    pub constant_force: Option<Newtons>,
    /// Contents of each WAV channel.
    pub channels: Option<Vec<Channel>>,
    /// Frequencies of 0 and of 1 in a haptic clip, in Hz; the second is higher.
    pub frequency_range_hz: Option<[f64; 2]>,
}

impl Separator {
    /// All separators.
    pub const ALL: &[Self] = &[Self::Comma, Self::Semicolon, Self::Tab, Self::Spaces];

    /// Name in a column map.
    pub fn name(self) -> &'static str {
        match self {
            Self::Comma => "comma",
            Self::Semicolon => "semicolon",
            Self::Tab => "tab",
            Self::Spaces => "spaces",
        }
    }

    /// Parses a separator name or character.
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
    /// All kinds of channels.
    pub const ALL: &[Self] = &[Self::Acceleration, Self::Speed, Self::Force, Self::Unused];

    /// Name in a column map.
    pub fn name(self) -> &'static str {
        match self {
            Self::Acceleration => "acceleration",
            Self::Speed => "speed",
            Self::Force => "force",
            Self::Unused => "unused",
        }
    }

    /// Parses a channel name. `x`, `y` and `z` are axes of acceleration, and so is any name that begins with
    /// "acceleration", as in rendered signals.
    pub fn parse(text: &str) -> Option<Self> {
        match text {
            _ if text.starts_with(Self::Acceleration.name()) => Some(Self::Acceleration),
            "x" | "y" | "z" | "ax" | "ay" | "az" => Some(Self::Acceleration),
            _ => Self::ALL.iter().copied().find(|channel| channel.name() == text),
        }
    }
}

impl Column {
    /// Parses a whole number as a column number, other text as a column name.
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
