//! The texture codec on the starter library: signal-to-noise ratio against the reference at the same bit rate, and
//! predicted detectability (d′).
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may panic on an unexpected result")]

use std::sync::Arc;

use serde_json::Value;
use shagreen_core::signals::codec::bitrate::Bitrate;
use shagreen_core::signals::codec::coded::Coded;
use shagreen_core::signals::codec::corpus::{is_held_out, signal};
use shagreen_core::signals::quality::{PAPER_RATE, QualityMeter, snr_db};
use shagreen_core::surfaces::contact_model::REFERENCE_CONTACT;
use shagreen_formats::codec_stream::{read_stream, write_stream};
use shagreen_formats::codec_tables::built_in_codebooks;
use shagreen_formats::quality_model::built_in_quality_model;
use shagreen_formats::starter::starter_library;
use shagreen_formats::thresholds::ThresholdKind;

/// Uses every third texture, which the codebooks were not trained on.
#[test]
fn ours_is_nearer_than_the_reference_and_what_is_noticed_falls_with_the_rate() {
    let vectors: Value = serde_json::from_str(include_str!("../../../vectors/i_celp/starter.json")).unwrap();
    let books = Arc::new(built_in_codebooks().unwrap());
    let meter = QualityMeter::new(PAPER_RATE, &ThresholdKind::default().read().unwrap()).unwrap();
    let model = built_in_quality_model().unwrap().model;
    let library = starter_library().unwrap();
    let mut d_primes = [0.0; 5];
    for (_, texture) in library.textures.iter().enumerate().filter(|(index, _)| is_held_out(*index)) {
        let felt = signal(&texture.model, REFERENCE_CONTACT, 1.6, 5).unwrap();
        for (sum, rate) in d_primes.iter_mut().zip(Bitrate::ALL) {
            let decoded = Coded::encode(&felt, rate, &books).unwrap().decode(&books);
            let (reached, of_reference) = (
                snr_db(&felt, &decoded),
                vectors["snr_db"][&texture.id][rate.bits_per_sec().to_string()].as_f64().unwrap(),
            );
            println!("{} at {}: {reached:.2} dB, reference {of_reference} dB", texture.id, rate.kbps());
            assert!(reached > of_reference + 0.5, "{} at {rate:?}", texture.id);
            *sum += model.d_prime(&meter.distances(&felt, &decoded).unwrap());
        }
    }
    assert!(d_primes.is_sorted_by(|a, b| a > b), "{d_primes:?}");
}

/// A written stream decodes to the same samples in every later version. New codebooks or another decoder need a new
/// version of the stream format.
#[test]
fn the_stream_of_version_1_is_decoded_as_it_was() {
    let stream = include_bytes!("golden/codec_1.shgc");
    let samples = include_bytes!("golden/codec_1.f32");
    let read = read_stream(stream).unwrap();
    assert!(read.warnings.is_empty());
    assert_eq!(write_stream(&read.value).unwrap(), stream);
    let decoded = read.value.decode(&Arc::new(built_in_codebooks().unwrap()));
    let wanted = samples.as_chunks::<4>().0.iter().map(|bytes| f64::from(f32::from_le_bytes(*bytes)));
    assert_eq!(decoded.len(), samples.len() / 4);
    for (got, wanted) in decoded.iter().zip(wanted) {
        // Tolerance for `f32` samples and the rounding of recursive filters.
        assert!((got - wanted).abs() < 1e-5, "{got} for {wanted}");
    }
}
