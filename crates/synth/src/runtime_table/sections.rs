//! Frame of a table: version, length, checksum, and the bytes of its sections.

use crc::{CRC_32_ISO_HDLC, Crc};

use super::fields::Fields;
use super::{MAGIC, TableError, VERSION};

/// Checksum of a table.
pub(super) static CHECKSUM: Crc<u32> = Crc::<u32>::new(&CRC_32_ISO_HDLC);
/// Bytes of the checksum at the end.
const CHECKSUM_BYTES: usize = 4;

/// Kinds of sections.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Head,
    Nodes,
    Triangles,
    Excitations,
    NodesAlong,
    TrianglesAlong,
    Relief,
    HeightMap,
    Friction,
    Tap,
    Name,
    Terms,
    Origin,
    CreatedBy,
}

impl Kind {
    const ALL: [Self; 14] = [
        Self::Head,
        Self::Nodes,
        Self::Triangles,
        Self::Excitations,
        Self::NodesAlong,
        Self::TrianglesAlong,
        Self::Relief,
        Self::HeightMap,
        Self::Friction,
        Self::Tap,
        Self::Name,
        Self::Terms,
        Self::Origin,
        Self::CreatedBy,
    ];

    /// Letters at the begin of a section.
    pub(super) fn letters(self) -> [u8; 4] {
        *match self {
            Self::Head => b"HEAD",
            Self::Nodes => b"NODE",
            Self::Triangles => b"TRIA",
            Self::Excitations => b"EXCI",
            Self::NodesAlong => b"NODL",
            Self::TrianglesAlong => b"TRIL",
            Self::Relief => b"RELI",
            Self::HeightMap => b"HMAP",
            Self::Friction => b"FRIC",
            Self::Tap => b"TAPS",
            Self::Name => b"NAME",
            Self::Terms => b"TERM",
            Self::Origin => b"ORIG",
            Self::CreatedBy => b"MADE",
        }
    }
}

/// Bytes of the sections of a table.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sections<'b>([Option<&'b [u8]>; Kind::ALL.len()]);

impl<'b> Sections<'b> {
    /// Splits a table.
    ///
    /// # Errors
    /// The bytes are not a whole, undamaged table of this major version.
    pub(super) fn of(bytes: &'b [u8]) -> Result<Self, TableError> {
        let mut fields = Fields(bytes);
        if fields.letters() != Some(MAGIC) {
            return Err(TableError::Foreign);
        }
        let (Some(major), Some(_minor), Some(length)) = (fields.u16(), fields.u16(), fields.u32()) else {
            return Err(TableError::Length);
        };
        if major != VERSION[0] {
            return Err(TableError::Version);
        }
        let content = fields.0.split_at_checked(fields.0.len().wrapping_sub(CHECKSUM_BYTES));
        let Some((content, checksum)) = content.filter(|_| u32::try_from(bytes.len()) == Ok(length)) else {
            return Err(TableError::Length);
        };
        let checked = bytes.get(..bytes.len() - CHECKSUM_BYTES).unwrap_or_default();
        if Fields(checksum).u32() != Some(CHECKSUM.checksum(checked)) {
            return Err(TableError::Checksum);
        }
        Self::in_content(content).ok_or(TableError::Section)
    }

    /// Finds the sections between head and checksum; `None` if one is cut off or occurs twice.
    fn in_content(content: &'b [u8]) -> Option<Self> {
        let mut found = Self([None; Kind::ALL.len()]);
        let mut fields = Fields(content);
        while !fields.0.is_empty() {
            let letters = fields.letters()?;
            let length = usize::try_from(fields.u32()?).ok()?;
            let section = fields.bytes(length)?;
            if let Some(kind) = Kind::ALL.into_iter().find(|kind| kind.letters() == letters)
                && found.0[kind as usize].replace(section).is_some()
            {
                return None;
            }
        }
        Some(found)
    }

    /// Bytes of a section; `None` if the table does not have it.
    pub(super) fn get(&self, kind: Kind) -> Option<&'b [u8]> {
        self.0[kind as usize]
    }
}
