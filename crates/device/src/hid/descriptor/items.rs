//! Items of a report descriptor.

use crate::hid::descriptor::DescriptorError;

/// Type of an item.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ItemKind {
    Main,
    Global,
    Local,
    /// A long item or one of the reserved type, which no known device uses.
    Unknown,
}

/// An item with its data.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Item {
    pub(super) offset: usize,
    pub(super) kind: ItemKind,
    pub(super) tag: u8,
    /// Length of the data in bytes: 0, 1, 2 or 4.
    pub(super) n_bytes: u32,
    /// Data as an unsigned number.
    pub(super) data: u32,
}

impl Item {
    /// Data as a signed number of its length.
    pub(super) fn signed(self) -> i64 {
        match self.n_bytes {
            1 => i64::from((self.data as u8).cast_signed()),
            2 => i64::from((self.data as u16).cast_signed()),
            _ => i64::from(self.data.cast_signed()),
        }
    }
}

/// Items of a descriptor, up to the first truncated one.
pub(super) fn items(bytes: &[u8]) -> impl Iterator<Item = Result<Item, DescriptorError>> + '_ {
    let mut offset = 0;
    std::iter::from_fn(move || {
        let rest = bytes.get(offset..).filter(|rest| !rest.is_empty())?;
        let Some((item, length)) = first_item(rest, offset) else {
            let cut_off = DescriptorError::CutOff { offset };
            offset = bytes.len();
            return Some(Err(cut_off));
        };
        offset += length;
        Some(Ok(item))
    })
}

/// Prefix of a long item; its length and tag follow.
const LONG_PREFIX: u8 = 0xfe;

/// The item at the start of `bytes` with its length; `None` if it is truncated.
fn first_item(bytes: &[u8], offset: usize) -> Option<(Item, usize)> {
    let prefix = *bytes.first()?;
    if prefix == LONG_PREFIX {
        let length = 3 + usize::from(*bytes.get(1)?);
        let item = Item { offset, kind: ItemKind::Unknown, tag: *bytes.get(2)?, n_bytes: 0, data: 0 };
        return (length <= bytes.len()).then_some((item, length));
    }
    let n_bytes = [0, 1, 2, 4][usize::from(prefix & 3)];
    let data = bytes.get(1..1 + n_bytes)?;
    let kind = match prefix >> 2 & 3 {
        0 => ItemKind::Main,
        1 => ItemKind::Global,
        2 => ItemKind::Local,
        _ => ItemKind::Unknown,
    };
    let data = data.iter().rev().fold(0, |data, byte| data << 8 | u32::from(*byte));
    Some((Item { offset, kind, tag: prefix >> 4, n_bytes: n_bytes as u32, data }, 1 + n_bytes))
}
