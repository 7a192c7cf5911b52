//! Limits of the memory that decoding a photo takes.

use super::error::PictureError;

/// Maximum memory that decoding a photo takes, in bytes.
pub(super) const MAX_PHOTO_BYTES: u64 = 1 << 30;
/// Memory in bytes that decoding a photo may take regardless of its file size.
const FREE_BYTES: u64 = 24 << 20;
/// Additional memory, in bytes per compressed byte. The deflate compression of PNG and TIFF reaches 1032 (RFC 1951: 258
/// bytes in 2 bits); a photo is far below. A small file that states a huge picture is refused before it is decoded.
const FACTOR: u64 = 1100;

/// Checks that decoding a picture of this size takes a permitted amount of memory. `n_decoded` is the memory, and
/// `n_bytes` the size of the file.
///
/// # Errors
/// [`PictureError::LargePhoto`] above [`MAX_PHOTO_BYTES`], [`PictureError::TooLarge`] if it is too much for this file.
pub(super) fn check_memory(
    (width, height): (u32, u32),
    n_decoded: u64,
    n_bytes: usize,
) -> Result<(), PictureError> {
    if n_decoded > MAX_PHOTO_BYTES {
        return Err(PictureError::LargePhoto);
    }
    if n_decoded > FREE_BYTES + FACTOR * n_bytes as u64 {
        return Err(PictureError::TooLarge { width, height, n_bytes });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::{MAX_PHOTO_BYTES, check_memory};
    use crate::picture::PictureError;

    #[test]
    fn memory_is_bounded_by_the_file_and_in_total() {
        assert!(check_memory((2000, 2000), 12 << 20, 100).is_ok());
        assert!(matches!(
            check_memory((8000, 8000), 192 << 20, 100),
            Err(PictureError::TooLarge { width: 8000, height: 8000, n_bytes: 100 })
        ));
        assert!(check_memory((8000, 8000), 192 << 20, 1 << 20).is_ok());
        assert!(check_memory((16_000, 16_000), MAX_PHOTO_BYTES, 9 << 20).is_ok());
        let more = check_memory((16_000, 16_000), MAX_PHOTO_BYTES + 1, 9 << 20);
        assert!(matches!(more, Err(PictureError::LargePhoto)));
    }
}
