//! Tags of a TIFF: whether the file is large enough for their values.
//!
//! The decoder reserves memory for as many values as a tag states before it reads them, up to 256 MiB.

use super::error::PictureError;

/// First tag number that is reserved for private use. The decoder does not read these tags.
const PRIVATE: u16 = 32_768;

/// Places of the numbers in a directory of tags.
struct Directory {
    /// Bytes of the number of tags before the first one.
    before_tags: usize,
    /// Bytes of a tag: its number, its type, the number of its values, and where they are.
    tag_bytes: usize,
    /// Bytes of the number of values of a tag.
    count_width: usize,
}

const CLASSIC: Directory = Directory { before_tags: 2, tag_bytes: 12, count_width: 4 };
const BIG: Directory = Directory { before_tags: 8, tag_bytes: 20, count_width: 8 };

/// Checks that no tag of the first page states more values than the file has bytes for. What is no TIFF passes, since the
/// decoder refuses it.
///
/// # Errors
/// [`PictureError::CutOff`].
pub(super) fn check_tags(bytes: &[u8]) -> Result<(), PictureError> {
    let is_large = |tag: &Tag| tag.number < PRIVATE && tag.n_bytes() > bytes.len() as u64;
    if first_page(bytes).unwrap_or_default().iter().any(is_large) {
        Err(PictureError::CutOff)
    } else {
        Ok(())
    }
}

/// A tag without its values.
struct Tag {
    number: u16,
    kind: u16,
    n_values: u64,
}

impl Tag {
    /// Bytes of all values; 0 for an unknown type.
    fn n_bytes(&self) -> u64 {
        let size = match self.kind {
            1 | 2 | 6 | 7 => 1,
            3 | 8 => 2,
            4 | 9 | 11 | 13 => 4,
            5 | 10 | 12 | 16..=18 => 8,
            _ => 0,
        };
        self.n_values.saturating_mul(size)
    }
}

/// Returns the tags of the first page, up to the end of the file; `None` if there is no page.
fn first_page(bytes: &[u8]) -> Option<Vec<Tag>> {
    let is_little = match bytes.get(..2)? {
        b"II" => true,
        b"MM" => false,
        _ => return None,
    };
    // A number of two, four or eight bytes.
    let number = |at: usize, n_bytes: usize| -> Option<u64> {
        let digits = bytes.get(at..at.checked_add(n_bytes)?)?;
        let add = |sum: u64, digit: &u8| sum << 8 | u64::from(*digit);
        Some(if is_little { digits.iter().rev().fold(0, add) } else { digits.iter().fold(0, add) })
    };
    let (directory, begin) = match number(2, 2)? {
        42 => (CLASSIC, number(4, 4)?),
        43 => (BIG, number(8, 8)?),
        _ => return None,
    };
    let begin = usize::try_from(begin).ok()?;
    let n_tags = usize::try_from(number(begin, directory.before_tags)?).ok()?;
    let tag = |index: usize| -> Option<Tag> {
        let at =
            begin.checked_add(directory.before_tags)?.checked_add(index.checked_mul(directory.tag_bytes)?)?;
        Some(Tag {
            number: u16::try_from(number(at, 2)?).ok()?,
            kind: u16::try_from(number(at + 2, 2)?).ok()?,
            n_values: number(at + 4, directory.count_width)?,
        })
    };
    Some((0..n_tags).map_while(tag).collect())
}

#[cfg(test)]
mod tests {
    use super::{check_tags, first_page};
    use crate::picture::PictureError;

    /// A file of one tag, and 40 bytes after it.
    fn file(is_little: bool, is_big: bool, [number, kind]: [u16; 2], n_values: u32) -> Vec<u8> {
        let digits = |value: u64, n_bytes: usize| -> Vec<u8> {
            if is_little {
                value.to_le_bytes()[..n_bytes].to_vec()
            } else {
                value.to_be_bytes()[8 - n_bytes..].to_vec()
            }
        };
        let head = if is_big {
            [digits(43, 2), digits(8, 2), digits(0, 2), digits(16, 8), digits(1, 8)].concat()
        } else {
            [digits(42, 2), digits(8, 4), digits(1, 2)].concat()
        };
        let wide = if is_big { 8 } else { 4 };
        let tag = [digits(number.into(), 2), digits(kind.into(), 2), digits(n_values.into(), wide)].concat();
        let letters: &[u8] = if is_little { b"II" } else { b"MM" };
        [letters.to_vec(), head, tag, digits(0, wide), vec![0; 40]].concat()
    }

    #[test]
    fn a_tag_with_more_values_than_the_file_is_truncated() {
        for (is_little, is_big) in [(true, false), (false, false), (true, true), (false, true)] {
            let of = |tag: [u16; 2], n: u32| check_tags(&file(is_little, is_big, tag, n));
            let tags = first_page(&file(is_little, is_big, [277, 3], 5)).unwrap();
            assert_eq!((tags.len(), tags[0].number, tags[0].n_bytes()), (1, 277, 10));
            assert!(of([277, 3], 20).is_ok());
            assert!(matches!(of([277, 3], 3_000_000), Err(PictureError::CutOff)));
            assert!(matches!(of([273, 5], 12), Err(PictureError::CutOff)), "96 bytes");
            // The decoder reads neither a private tag nor an unknown type.
            assert!(of([50_000, 3], 3_000_000).is_ok() && of([277, 99], 3_000_000).is_ok());
        }
        for other in [&b""[..], b"II", b"II*\0", b"II*\0\xff\xff\xff\xff", b"JFIF..............."] {
            assert!(check_tags(other).is_ok());
        }
    }
}
