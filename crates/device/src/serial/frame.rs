//! Framing of the serial protocol: header, payload and checksum, encoded so that a zero byte only ends a frame.
//!
//! A frame consists of `type`, `seq` (16 bits), payload and CRC (16 bits), all little-endian. It is encoded by COBS
//! (consistent overhead byte stuffing) and followed by one zero byte. A receiver that has lost synchronization regains
//! it at the next zero.

use crc::{CRC_16_IBM_3740, Crc};

/// Longest payload, in bytes.
///
/// Header, payload and checksum together stay below 254 bytes. COBS then always adds exactly one byte, and its encoding
/// is unique.
pub const MAX_PAYLOAD: usize = 248;
/// Bytes before the payload: type and sequence number.
const HEADER: usize = 3;
/// Bytes of the checksum.
const CHECKSUM: usize = 2;
/// Longest frame before encoding, in bytes.
const MAX_PLAIN: usize = HEADER + MAX_PAYLOAD + CHECKSUM;
/// Longest frame on the line, in bytes: encoded, with its final zero.
pub const MAX_WIRE: usize = MAX_PLAIN + 2;
/// Bytes on the line in addition to the payload.
pub const OVERHEAD: usize = HEADER + CHECKSUM + 2;

/// CRC-16/CCITT-FALSE, which is widely available in hardware and software. It takes two bytes of a typical frame of
/// forty. It misses one corrupted frame in 65536, which causes a click that the receiver's ceiling limits.
const CRC: Crc<u16> = Crc::<u16>::new(&CRC_16_IBM_3740);

/// A decoded frame: type, sequence number and payload.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Frame<'a> {
    /// Message type.
    pub kind: u8,
    /// Sequence number; its meaning depends on the type.
    pub seq: u16,
    /// Payload, at most [`MAX_PAYLOAD`] bytes.
    pub payload: &'a [u8],
}

/// Encodes a frame for the line, with its final zero. Returns its length in bytes, or 0 if the payload is longer than
/// [`MAX_PAYLOAD`].
pub fn encode(frame: Frame<'_>, wire: &mut [u8; MAX_WIRE]) -> usize {
    if frame.payload.len() > MAX_PAYLOAD {
        return 0;
    }
    let mut plain = [0; MAX_PLAIN];
    let body = HEADER + frame.payload.len();
    plain[0] = frame.kind;
    plain[1..HEADER].copy_from_slice(&frame.seq.to_le_bytes());
    plain[HEADER..body].copy_from_slice(frame.payload);
    let checksum = CRC.checksum(&plain[..body]);
    plain[body..body + CHECKSUM].copy_from_slice(&checksum.to_le_bytes());
    let stuffed = cobs::encode(&plain[..body + CHECKSUM], wire);
    wire[stuffed] = 0;
    stuffed + 1
}

/// Streaming decoder that finds frames in bytes, in pieces of any size; it stores at most one frame.
#[derive(Clone, Debug)]
pub struct Decoder {
    bytes: [u8; MAX_WIRE],
    len: usize,
    /// Whether there were more bytes than any frame has; the decoder then waits for the next zero.
    is_overlong: bool,
    bad_frames: u16,
}

impl Default for Decoder {
    fn default() -> Self {
        Self::new()
    }
}

impl Decoder {
    /// A decoder without input.
    pub const fn new() -> Self {
        Self { bytes: [0; MAX_WIRE], len: 0, is_overlong: false, bad_frames: 0 }
    }

    /// Processes the next byte. Returns a frame when it completes one with a correct checksum.
    pub fn push(&mut self, byte: u8) -> Option<Frame<'_>> {
        if byte != 0 {
            match self.bytes.get_mut(self.len) {
                Some(place) => (*place, self.len) = (byte, self.len + 1),
                None => self.is_overlong = true,
            }
            return None;
        }
        let len = core::mem::take(&mut self.len);
        if core::mem::take(&mut self.is_overlong) {
            self.note_bad();
            return None;
        }
        // Repeated zeros between frames are ignored.
        if len == 0 {
            return None;
        }
        let Some(body) = unstuff(&mut self.bytes[..len]) else {
            self.note_bad();
            return None;
        };
        let [kind, low, high, ..] = self.bytes;
        Some(Frame { kind, seq: u16::from_le_bytes([low, high]), payload: &self.bytes[HEADER..body] })
    }

    /// Number of truncated, corrupted or overlong frames, modulo 65536.
    pub fn bad_frames(&self) -> u16 {
        self.bad_frames
    }

    /// Counts a bad frame; a frame with an invalid payload counts too.
    pub(crate) fn note_bad(&mut self) {
        self.bad_frames = self.bad_frames.wrapping_add(1);
    }
}

/// Decodes a frame in place and checks its CRC. Returns the length of header and payload if it is correct.
fn unstuff(stuffed: &mut [u8]) -> Option<usize> {
    let len = cobs::decode_in_place(stuffed).ok()?; // Truncated or corrupted: counted as a bad frame.
    let body = len.checked_sub(CHECKSUM).filter(|&body| (HEADER..=HEADER + MAX_PAYLOAD).contains(&body))?;
    let checksum = u16::from_le_bytes([stuffed[body], stuffed[body + 1]]);
    (CRC.checksum(&stuffed[..body]) == checksum).then_some(body)
}

#[cfg(test)]
mod tests {
    use super::{CRC, Decoder, Frame, MAX_PAYLOAD, MAX_WIRE, OVERHEAD, encode};
    use proptest::prelude::{any, prop, proptest};

    type Owned = (u8, u16, Vec<u8>);

    fn wire(kind: u8, seq: u16, payload: &[u8]) -> Vec<u8> {
        let mut wire = [0; MAX_WIRE];
        let len = encode(Frame { kind, seq, payload }, &mut wire);
        wire[..len].to_vec()
    }

    fn frames(decoder: &mut Decoder, bytes: &[u8]) -> Vec<Owned> {
        let mut found = Vec::new();
        for &byte in bytes {
            if let Some(frame) = decoder.push(byte) {
                found.push((frame.kind, frame.seq, frame.payload.to_vec()));
            }
        }
        found
    }

    /// Reference implementation of COBS: each run of nonzero bytes, preceded by its length plus one.
    fn slow_stuffing(plain: &[u8]) -> Vec<u8> {
        let runs = plain.split(|&byte| byte == 0);
        runs.flat_map(|run| std::iter::once(run.len() as u8 + 1).chain(run.iter().copied())).collect()
    }

    #[test]
    fn checksum_is_the_one_of_the_catalogue() {
        assert_eq!(CRC.checksum(b"123456789"), 0x29B1);
    }

    #[test]
    fn bytes_are_those_of_the_description() {
        assert_eq!(wire(0x06, 0x1234, &[]), [0x06, 0x06, 0x34, 0x12, 0x1E, 0x85, 0x00]);
        assert_eq!(wire(0x06, 0, &[]), [0x02, 0x06, 0x01, 0x03, 0x3C, 0x7E, 0x00]);
    }

    #[test]
    fn the_longest_frame_fits_and_a_longer_one_is_refused() {
        let long = wire(1, 0xFFFF, &[7; MAX_PAYLOAD]);
        assert_eq!(long.len(), MAX_PAYLOAD + OVERHEAD);
        assert_eq!(frames(&mut Decoder::new(), &long), [(1, 0xFFFF, vec![7; MAX_PAYLOAD])]);
        assert!(wire(1, 1, &[7; MAX_PAYLOAD + 1]).is_empty());
        // One byte more than the longest frame, and a thousand bytes within the same memory.
        for n in [MAX_WIRE + 1, 1000] {
            let mut decoder = Decoder::new();
            let mut bytes = vec![5; n];
            bytes.push(0);
            bytes.extend(wire(2, 2, &[2]));
            assert_eq!(frames(&mut decoder, &bytes), [(2, 2, vec![2])]);
            assert_eq!(decoder.bad_frames(), 1);
        }
    }

    #[test]
    fn every_single_corrupted_bit_is_seen() {
        let good = wire(3, 77, &[1, 0, 2, 255, 0, 0, 9]);
        for bit in 0..8 * good.len() {
            let mut bytes = good.clone();
            bytes[bit / 8] ^= 1 << (bit % 8);
            bytes.push(0);
            let mut decoder = Decoder::new();
            assert!(frames(&mut decoder, &bytes).is_empty(), "bit {bit}");
            assert!(decoder.bad_frames() > 0);
        }
    }

    proptest! {
        #[test]
        fn what_is_sent_is_received_however_it_is_cut(
            sent in prop::collection::vec((any::<u8>(), any::<u16>(), prop::collection::vec(any::<u8>(), 0..=MAX_PAYLOAD)), 0..6),
            garbage in prop::collection::vec(any::<u8>(), 0..40),
        ) {
            let mut bytes = garbage;
            bytes.push(0);
            let mut decoder = Decoder::new();
            frames(&mut decoder, &bytes);
            let bytes: Vec<u8> = sent.iter().flat_map(|(kind, seq, payload)| wire(*kind, *seq, payload)).collect();
            assert_eq!(frames(&mut decoder, &bytes), sent);
        }

        #[test]
        fn arbitrary_bytes_never_panic_and_cuts_change_nothing(
            bytes in prop::collection::vec(0_u8..8, 0..2000), cut in any::<prop::sample::Index>(),
        ) {
            let mut whole = Decoder::new();
            let expected = frames(&mut whole, &bytes);
            let (a, b) = bytes.split_at(cut.index(bytes.len() + 1));
            let mut parts = Decoder::new();
            let mut found = frames(&mut parts, a);
            found.extend(frames(&mut parts, b));
            assert_eq!(found, expected);
            assert_eq!(parts.bad_frames(), whole.bad_frames());
        }

        #[test]
        fn stuffing_is_that_of_its_paper(payload in prop::collection::vec(0_u8..4, 0..=MAX_PAYLOAD)) {
            let found = wire(9, 0x0100, &payload);
            let mut plain = vec![9, 0, 1];
            plain.extend(&payload);
            plain.extend(CRC.checksum(&plain).to_le_bytes());
            let mut expected = slow_stuffing(&plain);
            expected.push(0);
            assert_eq!(found, expected);
        }
    }
}
