//! Frames on the wire: a header, a payload and a checksum, stuffed so that a zero byte ends a frame and nothing else.
//!
//! A frame is `type`, `seq` (16 bits), payload, CRC (16 bits), all little-endian, stuffed by COBS (consistent overhead
//! byte stuffing) and followed by one zero byte. Whoever lost the thread finds it at the next zero.

use crc::{CRC_16_IBM_3740, Crc};

/// Most bytes of a payload.
///
/// With header and checksum it stays below 254, so that the stuffing is always one byte, and every way to stuff gives the
/// same bytes.
pub const MAX_PAYLOAD: usize = 248;
/// Bytes before the payload: type and sequence number.
const HEADER: usize = 3;
/// Bytes of the checksum.
const CHECKSUM: usize = 2;
/// Most bytes of a frame before stuffing.
const MAX_PLAIN: usize = HEADER + MAX_PAYLOAD + CHECKSUM;
/// Most bytes of a frame on the wire: stuffed, with its zero.
pub const MAX_WIRE: usize = MAX_PLAIN + 2;
/// Bytes on the wire beside the payload.
pub const OVERHEAD: usize = HEADER + CHECKSUM + 2;

/// CRC-16/CCITT-FALSE. Every chip and every language has it, it costs two bytes of a frame of forty, and a frame is short:
/// what it misses, one corrupted frame in 65536, is a click that the receiver's ceiling bounds.
const CRC: Crc<u16> = Crc::<u16>::new(&CRC_16_IBM_3740);

/// A frame: what sort, which one, and what it says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Frame<'a> {
    /// Type of the message.
    pub kind: u8,
    /// Sequence number; what it counts depends on the type.
    pub seq: u16,
    /// What the message says, at most [`MAX_PAYLOAD`] bytes.
    pub payload: &'a [u8],
}

/// Writes a frame as it goes over the wire, with its closing zero, and returns its length; nothing is written, and the
/// length is 0, where the payload is longer than [`MAX_PAYLOAD`].
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

/// Finds frames in bytes, however they are cut into pieces; needs no more memory than one frame.
#[derive(Clone, Debug)]
pub struct Decoder {
    bytes: [u8; MAX_WIRE],
    len: usize,
    /// More bytes than any frame has: wait for the next zero.
    is_overlong: bool,
    bad_frames: u16,
}

impl Default for Decoder {
    fn default() -> Self {
        Self::new()
    }
}

impl Decoder {
    /// A decoder that has seen nothing.
    pub const fn new() -> Self {
        Self { bytes: [0; MAX_WIRE], len: 0, is_overlong: false, bad_frames: 0 }
    }

    /// Takes the next byte; a frame, when it was the last of one whose checksum is right.
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
        // Zeros between frames are no frames.
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

    /// Frames that were cut, corrupted or too long, modulo 65536.
    pub fn bad_frames(&self) -> u16 {
        self.bad_frames
    }

    /// A frame whose payload does not say what its type should is bad too.
    pub(crate) fn note_bad(&mut self) {
        self.bad_frames = self.bad_frames.wrapping_add(1);
    }
}

/// Unstuffs a frame in place and checks it; the length of header and payload where it is right.
fn unstuff(stuffed: &mut [u8]) -> Option<usize> {
    let len = cobs::decode_in_place(stuffed).ok()?; // Cut or corrupted, which is counted.
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

    /// The stuffing as its paper tells it: each run of bytes that are not zero, after its length and one.
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
        // One byte more than any frame, and no more memory for a thousand.
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
