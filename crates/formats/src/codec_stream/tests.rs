use std::sync::{Arc, OnceLock};

use proptest::prelude::{prop, prop_assert, prop_assert_eq, proptest};
use shagreen_core::maths::rng::lcg_noise;
use shagreen_core::signals::codec::bitrate::Bitrate;
use shagreen_core::signals::codec::books::Codebooks;
use shagreen_core::signals::codec::coded::Coded;
use shagreen_core::signals::quality::snr_db;

use super::{CodecStreamError, HEADER_BYTES, HEADER_CRC, read_stream, write_stream};
use crate::codec_tables::built_in_codebooks;

fn books() -> &'static Arc<Codebooks> {
    static BOOKS: OnceLock<Arc<Codebooks>> = OnceLock::new();
    BOOKS.get_or_init(|| Arc::new(built_in_codebooks().unwrap()))
}

/// A signal of 26 frames, the last half full.
fn signal() -> Vec<f64> {
    let mut last = 0.0;
    let smoothed = |x: f64| {
        last = 0.9 * last + x;
        0.3 * last
    };
    lcg_noise(1020, 5).into_iter().map(smoothed).collect()
}

fn coded(rate: Bitrate) -> Coded {
    Coded::encode(&signal(), rate, books()).unwrap()
}

#[test]
fn a_stream_is_read_as_it_was_written_and_has_its_bits() {
    for rate in Bitrate::ALL {
        let coded = coded(rate);
        let bytes = write_stream(&coded).unwrap();
        let read = read_stream(&bytes).unwrap();
        assert!(read.warnings.is_empty());
        assert_eq!((read.value.rate, &read.value.frames), (rate, &coded.frames));
        assert_eq!(read.value.n_samples, 1020);
        // Three whole blocks, and two frames padded to a whole byte.
        let n_bits = rate.allocation().n_bits() as usize;
        assert_eq!((coded.frames.len(), coded.n_bits()), (26, 26 * n_bits as u64));
        assert_eq!(bytes.len(), HEADER_BYTES + 3 * (n_bits + 2) + (2 * n_bits).div_ceil(8) + 2);
        // The scale is stored as `f32`, with 24 significant bits.
        let (there, back) = (coded.decode(books()), read.value.decode(books()));
        assert!(snr_db(&there, &back) > 120.0);
    }
}

#[test]
fn what_is_no_stream_is_named() {
    let bytes = write_stream(&coded(Bitrate::Kbps2_45)).unwrap();
    assert_eq!(read_stream(b"RIFF"), Err(CodecStreamError::NotStream));
    assert_eq!(read_stream(b""), Err(CodecStreamError::NotStream));
    assert_eq!(read_stream(&bytes[..20]), Err(CodecStreamError::Header));
    let mut damaged = bytes.clone();
    damaged[9] ^= 4;
    assert_eq!(read_stream(&damaged), Err(CodecStreamError::Header));
    let mut later = bytes.clone();
    later[4] = 2;
    assert_eq!(
        read_stream(&later),
        Err(CodecStreamError::Header),
        "a damaged version byte is not a newer version"
    );
    let check = HEADER_CRC.checksum(&later[..20]).to_le_bytes();
    later[20..24].copy_from_slice(&check);
    assert_eq!(read_stream(&later), Err(CodecStreamError::Version { found: 2 }));
    for (at, number) in [(6, [1, 0, 0, 0]), (12, (-1.0_f32).to_le_bytes()), (16, f32::NAN.to_le_bytes())] {
        let mut nonsense = bytes.clone();
        let n = if at == 6 { 2 } else { 4 };
        nonsense[at..at + n].copy_from_slice(&number[..n]);
        let check = HEADER_CRC.checksum(&nonsense[..20]).to_le_bytes();
        nonsense[20..24].copy_from_slice(&check);
        assert!(matches!(read_stream(&nonsense), Err(CodecStreamError::Nonsense { .. })), "{at}");
    }
}

#[test]
fn what_is_cut_off_damaged_or_follows_is_said() {
    let coded = coded(Bitrate::Kbps3_15);
    let bytes = write_stream(&coded).unwrap();
    let cut = read_stream(&bytes[..HEADER_BYTES + 65 + 30]).unwrap();
    assert_eq!((cut.value.frames.len(), cut.value.n_samples), (8, 320));
    assert_eq!(cut.warnings, ["the stream is truncated: it holds 8 of 26 frames"]);
    let mut damaged = bytes.clone();
    damaged[HEADER_BYTES + 65 + 7] ^= 1;
    damaged.extend([1, 2, 3]);
    let damaged = read_stream(&damaged).unwrap();
    assert!((0..26).all(|i| damaged.value.frames[i].is_none() == (8..16).contains(&i)));
    assert_eq!(damaged.warnings.len(), 2);
    // Swapped blocks are detected.
    let mut swapped = bytes.clone();
    let (first, second) = swapped[HEADER_BYTES..].split_at_mut(65);
    first.swap_with_slice(&mut second[..65]);
    assert!(read_stream(&swapped).unwrap().value.frames[..16].iter().all(Option::is_none));
    // Lost frames stay lost.
    let lost = read_stream(&write_stream(&damaged.value).unwrap()).unwrap();
    assert_eq!(lost.value.frames, damaged.value.frames);
    let silent = Coded::encode(&[], Bitrate::Kbps1_75, books()).unwrap();
    assert_eq!(read_stream(&write_stream(&silent).unwrap()).unwrap().value.frames, []);
}

proptest! {
    /// However a stream is damaged, reading it returns an error that says what to do, or a signal within its limit.
    #[test]
    fn any_damage_is_an_error_or_within_the_limit(
        rate in 0_usize..5,
        damage in prop::collection::vec((0_usize..300, prop::num::u8::ANY), 0..6),
        length in 0_usize..400,
    ) {
        let mut bytes = write_stream(&coded(Bitrate::ALL[rate])).unwrap();
        for (at, value) in damage {
            if let Some(byte) = bytes.get_mut(at) {
                *byte = value;
            }
        }
        bytes.truncate(length);
        match read_stream(&bytes) {
            Ok(read) => {
                let out = read.value.decode(books());
                prop_assert_eq!(out.len(), read.value.n_samples);
                prop_assert!(out.iter().all(|x| x.abs() <= read.value.limit_mps2));
            }
            Err(error) => prop_assert!(error.to_string().contains(';')),
        }
    }
}
