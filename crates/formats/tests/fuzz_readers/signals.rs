//! Readers of codec streams and profiles.

use std::sync::{Arc, OnceLock};

use crc::{CRC_16_IBM_3740, CRC_32_ISO_HDLC, Crc};
use shagreen_core::maths::rng::lcg_noise;
use shagreen_core::signals::codec::bitrate::Bitrate;
use shagreen_core::signals::codec::books::Codebooks;
use shagreen_core::signals::codec::coded::Coded;
use shagreen_formats::codec_stream::{read_stream, write_stream};
use shagreen_formats::codec_tables::built_in_codebooks;
use shagreen_formats::profile_csv::read_profile_csv;

/// Bytes of the stream header, of which the last four are its checksum.
const HEAD: usize = 24;

fn books() -> &'static Arc<Codebooks> {
    static BOOKS: OnceLock<Arc<Codebooks>> = OnceLock::new();
    BOOKS.get_or_init(|| Arc::new(built_in_codebooks().unwrap()))
}

pub(crate) fn stream_seeds() -> Vec<Vec<u8>> {
    let signal = lcg_noise(700, 3);
    let coded = |rate| write_stream(&Coded::encode(&signal, rate, books()).unwrap()).unwrap();
    [Bitrate::Kbps1_75, Bitrate::Kbps3_15].map(coded).to_vec()
}

/// A header that states 25 days of signal, without any data.
pub(crate) fn stream_bombs() -> Vec<Vec<u8>> {
    let mut head = stream_seeds().remove(0);
    head.truncate(HEAD);
    head[8..12].copy_from_slice(&u32::MAX.to_le_bytes());
    repair_stream(&mut head);
    vec![head]
}

/// Recomputes the checksum of the header, and those of the blocks if the header is valid enough to locate them.
pub(crate) fn repair_stream(bytes: &mut [u8]) {
    let Some(sum) = bytes.get(..HEAD - 4).map(|head| Crc::<u32>::new(&CRC_32_ISO_HDLC).checksum(head)) else {
        return;
    };
    if let Some(place) = bytes.get_mut(HEAD - 4..HEAD) {
        place.copy_from_slice(&sum.to_le_bytes());
    }
    let bits_per_sec = u32::from(u16::from_le_bytes([bytes[6], bytes[7]]));
    let Some(rate) = Bitrate::from_bits_per_sec(bits_per_sec) else { return };
    let n = rate.allocation().n_bits() as usize;
    for (index, block) in bytes.get_mut(HEAD..).unwrap_or_default().chunks_exact_mut(n + 2).enumerate() {
        let crc = Crc::<u16>::new(&CRC_16_IBM_3740);
        let mut digest = crc.digest();
        digest.update(&(index as u32).to_le_bytes());
        digest.update(&block[..n]);
        let sum = digest.finalize().to_le_bytes();
        block[n..].copy_from_slice(&sum);
    }
}

pub(crate) fn read_a_stream(bytes: &[u8]) -> Result<(), String> {
    let Ok(read) = read_stream(bytes) else { return Ok(()) };
    let coded = read.value;
    let decoded = coded.decode(books());
    let is_within = |x: &f64| x.abs() <= coded.limit_mps2;
    if decoded.iter().all(is_within) {
        Ok(())
    } else {
        Err(format!("a sample exceeds the limit of {} m/s²", coded.limit_mps2))
    }
}

pub(crate) fn profile_seeds() -> Vec<Vec<u8>> {
    let table = |part: &str| {
        let rows: Vec<String> = (0..40).map(|i| format!("{}{part}{}", f64::from(i) * 0.01, i % 7)).collect();
        rows.join("\n")
    };
    vec![format!("x_mm,value\n{}", table(",")).into_bytes(), table(";").into_bytes()]
}

pub(crate) fn read_a_profile(bytes: &[u8]) -> Result<(), String> {
    match read_profile_csv(bytes) {
        Ok(profile) if !profile.values().iter().all(|x| x.is_finite()) => {
            Err("a value is not finite".to_owned())
        }
        Ok(_) | Err(_) => Ok(()),
    }
}
