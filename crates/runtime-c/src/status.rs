//! Results of the functions of the C interface, and what they mean.

use std::ffi::CStr;

use shagreen_synth::runtime_table::TableError;
use shagreen_synth::runtime_voice::VoiceError;

/// Result of a function.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShagreenStatus {
    /// The function has done its work.
    Ok = 0,
    /// A pointer is null or misaligned.
    Pointer = 1,
    /// A number of values is larger than any memory.
    TooLong = 2,
    /// The bytes are not a runtime table.
    Foreign = 3,
    /// The runtime table has a newer version.
    Version = 4,
    /// The runtime table is cut off or has extra bytes.
    Incomplete = 5,
    /// The runtime table is damaged.
    Damaged = 6,
    /// The runtime table contains no valid texture.
    Invalid = 7,
    /// The sample rate is below that of the texture or above 768 kHz, or that of the texture is not 200 to 4000 Hz.
    Rate = 8,
    /// The highest magnitude is not a positive finite number.
    Limit = 9,
    /// A sample was not finite. The voice is silent until it is reset.
    Silenced = 10,
    /// A fault of the runtime.
    Internal = 11,
}

impl ShagreenStatus {
    /// Every status, in the order of their numbers.
    pub(crate) const ALL: [Self; 12] = [
        Self::Ok,
        Self::Pointer,
        Self::TooLong,
        Self::Foreign,
        Self::Version,
        Self::Incomplete,
        Self::Damaged,
        Self::Invalid,
        Self::Rate,
        Self::Limit,
        Self::Silenced,
        Self::Internal,
    ];

    /// One sentence: what is wrong, and what to do.
    pub(crate) fn text(self) -> &'static CStr {
        match self {
            Self::Ok => c"done",
            Self::Pointer => c"a pointer is null or misaligned; pass the address of a valid object",
            Self::TooLong => c"a number of values is larger than any memory; pass the number in the array",
            Self::Foreign => c"this is not a runtime table; export one from Shagreen",
            Self::Version => {
                c"the runtime table has a newer version than this runtime reads; use a newer runtime, or export it again"
            }
            Self::Incomplete => {
                c"the runtime table is incomplete or has extra bytes; copy or export it again, and pass its whole length"
            }
            Self::Damaged => c"the runtime table is damaged; copy or export it again",
            Self::Invalid => {
                c"the runtime table contains no valid texture; correct the texture and export it again"
            }
            Self::Rate => {
                c"the sample rate is out of range; choose one from the rate of the texture to 768000 Hz"
            }
            Self::Limit => c"the highest magnitude is not a positive finite number; choose one in m/s^2",
            Self::Silenced => c"a sample was not finite, so the voice is silent; reset it, and check the texture",
            Self::Internal => c"a fault of the runtime; report it with the table and the calls that led to it",
        }
    }
}

impl From<TableError> for ShagreenStatus {
    fn from(error: TableError) -> Self {
        match error {
            TableError::Foreign => Self::Foreign,
            TableError::Version => Self::Version,
            TableError::Length => Self::Incomplete,
            TableError::Checksum => Self::Damaged,
            _ => Self::Invalid,
        }
    }
}

impl From<VoiceError> for ShagreenStatus {
    fn from(error: VoiceError) -> Self {
        match error {
            VoiceError::Rate => Self::Rate,
            VoiceError::Limit => Self::Limit,
            _ => Self::Internal,
        }
    }
}
