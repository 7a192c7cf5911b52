//! Rules of the format, and where a file breaks one.

use std::fmt;
use std::ops::RangeInclusive;

use crate::hjif::tree::Profile;

/// First year of a version.
pub(super) const FIRST_YEAR: u32 = 2023;
/// Most ticks per second in the main profile.
pub(super) const MOST_TICKS: u32 = 48_000;
/// Ticks per second in the simple parametric profile.
pub(super) const SIMPLE_TICKS: u32 = 1000;
/// Most channels of a perception, by level.
pub(super) const MOST_CHANNELS: [usize; 2] = [127, 65_535];
/// Most bands of a channel, by level.
pub(super) const MOST_BANDS: [usize; 2] = [7, 63];
/// Length of a direction that counts as 1.
pub(super) const UNIT_NORMS: RangeInclusive<f64> = 0.99..=1.01;

/// Broken rule and its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// Fields and indices that lead to the value, such as `perceptions[0].channels[1].gain`.
    pub place: String,
    /// The rule.
    pub rule: Rule,
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.place, self.rule)
    }
}

/// Rule that a file breaks.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Rule {
    /// The version is not a year with or without an amendment.
    #[error(
        "\"{found}\" is no version; write a year from {FIRST_YEAR} on, or a year and an amendment such as 2023-1"
    )]
    Version {
        /// Stated version.
        found: String,
    },
    /// The level does not exist.
    #[error("the level is {found}; it must be 1 or 2")]
    Level {
        /// Stated level.
        found: u32,
    },
    /// The date does not follow ISO 8601.
    #[error("\"{found}\" is no date of ISO 8601; write year, month and day as in 2026-01-31")]
    Date {
        /// Stated date.
        found: String,
    },
    /// The profile does not allow the timescale.
    #[error("the timescale is {found} ticks per second; {}", .profile.allowed_ticks())]
    Timescale {
        /// Stated ticks per second.
        found: u32,
        /// Stated profile.
        profile: Profile,
    },
    /// An avatar has the id 0.
    #[error("the id of an avatar must not be 0, which stands for no avatar; use another number")]
    AvatarZero,
    /// A custom avatar has no mesh, or another one has a mesh.
    #[error("only an avatar of the type Custom has a mesh, and it needs one; change the type or the mesh")]
    Mesh,
    /// An id is given twice.
    #[error("the id {id} is given twice; give each {what} its own id")]
    Twice {
        /// What has the id.
        what: &'static str,
        /// The id.
        id: i32,
    },
    /// An id names nothing.
    #[error("there is no {what} with the id {id}; add it, or refer to another one")]
    NoSuch {
        /// What the id should name.
        what: &'static str,
        /// The id.
        id: i32,
    },
    /// There are more parts than the level allows.
    #[error("{n} {what} are too many; the level {level} allows {most}")]
    TooMany {
        /// Name of the parts.
        what: &'static str,
        /// Number of the parts.
        n: usize,
        /// Most parts.
        most: usize,
        /// Stated level.
        level: u32,
    },
    /// Level 1 of the simple parametric profile does not have the modality.
    #[error(
        "level 1 of the profile Simple Parametric has only Force, Vibrotactile, Stiffness and Vibrotactile Texture; use the profile Main"
    )]
    ModalityOfProfile,
    /// The simple parametric profile does not have the tool.
    #[error("the profile Simple Parametric has no {what}; use the profile Main")]
    ToolOfProfile {
        /// Name of the tool.
        what: &'static str,
    },
    /// A direction is not a unit vector.
    #[error(
        "the direction has the length {norm:.3}; it must be 1 (127 in steps of 1/127) within one hundredth"
    )]
    Direction {
        /// Length of the direction.
        norm: f64,
    },
    /// A number is out of range.
    #[error("{what} is {value}; it must be {low} to {high}")]
    Range {
        /// Name of the quantity.
        what: &'static str,
        /// The number.
        value: f64,
        /// Lowest valid number.
        low: f64,
        /// Highest valid number.
        high: f64,
    },
    /// A number is negative.
    #[error("{what} is {value}; it must be 0 or more")]
    Negative {
        /// Name of the quantity.
        what: &'static str,
        /// The number.
        value: f64,
    },
    /// Two numbers are in the wrong order.
    #[error("{low_name} is {low}, above {high_name}, which is {high}; exchange or correct them")]
    Order {
        /// Name of the number that must not be higher.
        low_name: &'static str,
        /// The number.
        low: f64,
        /// Name of the number that must not be lower.
        high_name: &'static str,
        /// The number.
        high: f64,
    },
    /// The length of a block of wavelets is no power of two.
    #[error("the block length is {found}; it must be a power of two")]
    BlockLength {
        /// Stated length.
        found: i32,
    },
    /// A field is missing.
    #[error("{what} needs {field}; add it")]
    Missing {
        /// What needs the field.
        what: &'static str,
        /// Name of the field.
        field: &'static str,
    },
    /// A field has no meaning here.
    #[error("{field} belongs only to {what}; remove it")]
    Misplaced {
        /// Name of the field.
        field: &'static str,
        /// What has the field.
        what: &'static str,
    },
    /// Keyframes are not in the order of their positions.
    #[error("its position {position} is before that of the keyframe before it, {before}; sort the keyframes")]
    Unsorted {
        /// Position of the keyframe in ticks.
        position: i32,
        /// Position of the keyframe before it in ticks.
        before: i32,
    },
    /// The standard has no such semantic keyword.
    #[error(
        "\"{found}\" is no semantic keyword of the standard; write a category and a name, such as Texture/Wood"
    )]
    Semantic {
        /// Stated keyword.
        found: String,
    },
    /// The coefficients of a block of wavelets are not base64.
    #[error("the coefficients are not valid base64; encode them again")]
    Base64,
}

impl Profile {
    /// Timescales that the profile allows, as a clause.
    fn allowed_ticks(self) -> String {
        match self {
            Self::Main => format!("the profile Main allows 1 to {MOST_TICKS}"),
            Self::SimpleParametric => format!("the profile Simple Parametric allows only {SIMPLE_TICKS}"),
        }
    }
}
