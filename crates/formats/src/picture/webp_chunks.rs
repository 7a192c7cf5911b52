//! Chunks of a WebP: whether the file is complete, and its orientation.
//!
//! The decoder reserves as much memory for the EXIF chunk as its header states, which may be more than the file has.

use image::metadata::Orientation;

use super::error::PictureError;

/// Bytes before the first chunk: the letters RIFF, the size of the file, and the letters WEBP.
const HEADER_BYTES: usize = 12;
/// Some programs write these letters of JPEG files before the EXIF data.
const EXIF_LETTERS: &[u8] = b"Exif\0\0";

/// Returns the orientation of a WebP in its EXIF chunk. A file without one counts as upright.
///
/// # Errors
/// [`PictureError::CutOff`] if the file ends within a chunk.
pub(super) fn webp_orientation(bytes: &[u8]) -> Result<Orientation, PictureError> {
    let mut orientation = None;
    let mut rest = bytes.get(HEADER_BYTES..).unwrap_or_default();
    // A chunk is its name, its length and its data, padded to an even length.
    while let Some((head, after)) = rest.split_first_chunk::<8>() {
        let [name @ .., a, b, c, d] = head;
        let length = u32::from_le_bytes([*a, *b, *c, *d]) as usize;
        let chunk = after.get(..length).ok_or(PictureError::CutOff)?;
        if name == b"EXIF" {
            let exif = chunk.strip_prefix(EXIF_LETTERS).unwrap_or(chunk);
            orientation = orientation.or_else(|| Orientation::from_exif_chunk(exif));
        }
        rest = after.get(length + length % 2..).unwrap_or_default();
    }
    Ok(orientation.unwrap_or(Orientation::NoTransforms))
}

#[cfg(test)]
mod tests {
    use image::metadata::Orientation;

    use super::{PictureError, webp_orientation};

    fn chunk(name: &[u8], data: &[u8]) -> Vec<u8> {
        let length = u32::try_from(data.len()).unwrap().to_le_bytes();
        [name, &length, data, &vec![0; data.len() % 2]].concat()
    }

    /// EXIF data with one entry: the orientation.
    fn exif(orientation: u8) -> Vec<u8> {
        let mut data = b"II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0".to_vec();
        data.extend([orientation, 0, 0, 0]);
        data
    }

    #[test]
    fn the_orientation_is_found_among_the_chunks() {
        let file = |chunks: &[Vec<u8>]| [b"RIFF\0\0\0\0WEBP".to_vec(), chunks.concat()].concat();
        let picture = || chunk(b"VP8L", &[1, 2, 3]);
        let of = |chunks: &[Vec<u8>]| webp_orientation(&file(chunks)).unwrap();
        assert_eq!(of(&[picture(), chunk(b"EXIF", &exif(6))]), Orientation::Rotate90);
        let with_letters = [b"Exif\0\0".to_vec(), exif(3)].concat();
        assert_eq!(of(&[picture(), chunk(b"EXIF", &with_letters)]), Orientation::Rotate180);
        for upright in [&b"none"[..], b"", &exif(9)[..]] {
            assert_eq!(of(&[picture(), chunk(b"EXIF", upright)]), Orientation::NoTransforms);
        }
        assert_eq!(of(&[]), Orientation::NoTransforms);
        let whole = file(&[picture(), chunk(b"EXIF", &exif(6))]);
        let cut = webp_orientation(&whole[..whole.len() - 1]);
        assert!(matches!(cut, Err(PictureError::CutOff)), "{cut:?}");
        // A length far beyond the end of the file.
        let huge = [file(&[picture()]), b"EXIF\xff\xff\xff\xff".to_vec()].concat();
        assert!(matches!(webp_orientation(&huge), Err(PictureError::CutOff)));
    }
}
