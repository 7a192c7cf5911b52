//! Chunks of a PNG that are not decoded.

use std::borrow::Cow;

/// Signature at the beginning of a PNG.
const PNG_SIGNATURE: &[u8] = b"\x89PNG\r\n\x1a\n";
/// Chunks of a PNG that hold compressed data besides the image. A few kilobytes can expand to gigabytes, and nothing of
/// them is used.
const COMPRESSED_CHUNKS: [&[u8]; 3] = [b"iCCP", b"zTXt", b"iTXt"];

/// Returns a PNG without its color profile and compressed texts; any other file unchanged.
pub(super) fn without_large_texts(bytes: &[u8]) -> Cow<'_, [u8]> {
    let Some(mut rest) = bytes.strip_prefix(PNG_SIGNATURE) else { return Cow::Borrowed(bytes) };
    let mut kept = PNG_SIGNATURE.to_vec();
    // A chunk is its length, its name, its data and a checksum.
    while let Some((length, name)) = rest.first_chunk::<4>().zip(rest.get(4..8)) {
        let end = (u32::from_be_bytes(*length) as usize).saturating_add(12).min(rest.len());
        if !COMPRESSED_CHUNKS.contains(&name) {
            kept.extend_from_slice(&rest[..end]);
        }
        rest = &rest[end..];
    }
    kept.extend_from_slice(rest);
    Cow::Owned(kept)
}

#[cfg(test)]
mod tests {
    use super::{PNG_SIGNATURE, without_large_texts};

    /// A chunk with a checksum of zero, which is not looked at.
    fn chunk(name: [u8; 4], data: &[u8]) -> Vec<u8> {
        let length = u32::try_from(data.len()).unwrap().to_be_bytes();
        [&length[..], &name, data, &[0; 4]].concat()
    }

    #[test]
    fn profiles_and_compressed_texts_are_left_out() {
        let file = |chunks: &[Vec<u8>]| [PNG_SIGNATURE.to_vec(), chunks.concat()].concat();
        let [header, profile, text, data] = [(b"IHDR", 13), (b"iCCP", 900), (b"zTXt", 50), (b"IDAT", 20)]
            .map(|(name, n): (&[u8; 4], usize)| chunk(*name, &vec![7; n]));
        let all = file(&[header.clone(), profile, text, data.clone()]);
        assert_eq!(&*without_large_texts(&all), file(&[header, data]));
        assert_eq!(&*without_large_texts(b"no picture"), b"no picture");
        // A file that is cut off within a chunk is handed on; the decoder reports it.
        let cut = &all[..all.len() - 7];
        assert!(without_large_texts(cut).ends_with(&cut[cut.len() - 5..]));
    }
}
