//! Writes the built-in quality model: the paper's weights, with scaling lengths computed from a corpus. The corpus
//! pairs each texture of the starter library with its decoded version at every bit rate. Run it after `train_codec`:
//!
//! `cargo run --release -p shagreen-formats --example quality_lengths -- assets/quality/paper.json`

use std::error::Error;
use std::num::ParseFloatError;
use std::sync::Arc;

use shagreen_core::signals::codec::bitrate::Bitrate;
use shagreen_core::signals::codec::coded::Coded;
use shagreen_core::signals::codec::corpus::signal;
use shagreen_core::signals::quality::{
    PAPER_FEATURES, PAPER_PAIRS, PAPER_RATE, PAPER_WEIGHTS, QualityMeter, QualityModel, SEGMENT_SECS, Term,
};
use shagreen_core::surfaces::contact_model::REFERENCE_CONTACT;
use shagreen_formats::codec_tables::built_in_codebooks;
use shagreen_formats::quality_model::{QualityModelFile, write_quality_model};
use shagreen_formats::starter::starter_library;
use shagreen_formats::thresholds::ThresholdKind;

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args_os()
        .nth(1)
        .ok_or("missing argument: give the output file, for example assets/quality/paper.json")?;
    let books = Arc::new(built_in_codebooks()?);
    let meter = QualityMeter::new(PAPER_RATE, &ThresholdKind::default().read()?)?;
    let mut corpus = Vec::new();
    for (index, texture) in starter_library()?.textures.iter().enumerate() {
        let reference = signal(&texture.model, REFERENCE_CONTACT, SEGMENT_SECS, index as u64)?;
        for rate in Bitrate::ALL {
            let decoded = Coded::encode(&reference, rate, &books)?.decode(&books);
            corpus.push(meter.distances(&reference, &decoded)?);
        }
    }
    let weights: Vec<_> = PAPER_FEATURES.into_iter().zip(PAPER_WEIGHTS).collect();
    // A length is the root of a sum over pairs, so it is scaled to the number of pairs in the paper.
    let share = (PAPER_PAIRS as f64 / corpus.len() as f64).sqrt();
    let terms = QualityModel::weighted(&weights, &corpus)?;
    // Five digits are more than such a corpus determines.
    let rounded = |length: f64| format!("{length:.4e}").parse::<f64>();
    let scaled = |term: &Term| Ok(Term { length: rounded(share * term.length)?, ..*term });
    let terms = terms.terms().iter().map(scaled).collect::<Result<_, ParseFloatError>>()?;
    let said = format!(
        "{} pairs, scaled to {PAPER_PAIRS}: the textures of the starter library at 100 mm/s and 1 N, original against decoded, at the five bit rates of the codec",
        corpus.len()
    );
    let file = QualityModelFile {
        model: QualityModel::of_terms(terms)?,
        corpus: said,
        threshold: Some(ThresholdKind::default()),
        fit: None,
    };
    std::fs::write(path, write_quality_model(&file))?;
    Ok(())
}
