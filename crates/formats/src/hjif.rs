//! Haptic files of MPEG (`.hjif`, the JSON form of ISO/IEC 23090-31:2025, media type `haptics/hjif`).
//!
//! ```text
//! Hjif: profile, level, timescale
//! ├─ avatars: body models
//! └─ perceptions: what is felt, by modality
//!    ├─ reference_devices: actuators that the file was made for
//!    ├─ effect_library: effects with ids
//!    └─ channels: one actuator or one point of the body each
//!       └─ bands: parts of the spectrum
//!          └─ effects: their own keyframes, or an id of the library
//! ```
//!
//! [`read_hjif`] refuses files that break a rule of the format; [`check_hjif`] lists all broken rules. [`hjif_of_texture`]
//! writes a texture model: the spectrum at each of its speeds and forces as sines, one in each of up to seven bands.
//!
//! Positions are in ticks of `timescale`. In a perception of textures or stiffness, the format allows positions in space too;
//! files written here are in time.

mod check;
mod check_channel;
mod conditions;
mod date;
mod faults;
mod lost;
mod parts;
mod read;
mod rule;
mod scale;
mod tree;
mod write;

pub use self::date::iso_date;
pub use self::lost::lost_in_hjif;
pub use self::read::{Checked, HjifError, check_hjif, read_hjif};
pub use self::rule::{Fault, Rule};
pub use self::tree::{
    ActuatorType, Avatar, AvatarType, Band, BandType, BaseSignal, Channel, CurveType, Direction, Effect,
    EffectType, Hjif, Keyframe, Modality, Perception, Profile, ReferenceDevice, SyncPoint, Target,
};
pub use self::write::{HjifWriteError, hjif_of_texture, write_hjif};

#[cfg(test)]
mod tests;
