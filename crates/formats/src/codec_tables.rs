//! The built-in codebook tables of the texture codec, and their file format.

use serde::{Deserialize, Serialize};
use shagreen_core::signals::codec::books::{BooksError, Codebooks, SplitTable, Tables};

use crate::layout;

const BYTES: &[u8] = include_bytes!("../../../assets/codec/tables.json");
/// Numbers are rounded to multiples of 1/`DIGITS`, far finer than their accuracy.
const DIGITS: f64 = 1e7;

/// The tables, as the JSON file stores them.
#[derive(Debug, Serialize, Deserialize)]
struct TablesV1 {
    /// Description of the training data, for people.
    trained_on: String,
    /// Mean line spectral frequencies in radians.
    lsf_mean: Vec<f64>,
    lsf: Vec<SplitV1>,
    /// Gain codebooks of 4, 5 and 6 bits.
    gains: Vec<Vec<[f64; 2]>>,
}

#[derive(Debug, Serialize, Deserialize)]
struct SplitV1 {
    split: usize,
    bits: u32,
    entries: Vec<Vec<f64>>,
}

/// Why the tables are unavailable.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CodecTablesError {
    /// The JSON file is invalid.
    #[error("the built-in codec tables are damaged: {0}; reinstall the program")]
    Json(#[from] serde_json::Error),
    /// The tables do not fit this codec.
    #[error(transparent)]
    Books(#[from] BooksError),
}

/// Returns the built-in codebooks. Encoder and decoder of a stream must use the same ones.
///
/// # Errors
/// Fails only if the embedded file is damaged, which a test excludes.
pub fn built_in_codebooks() -> Result<Codebooks, CodecTablesError> {
    let TablesV1 { lsf_mean, lsf, gains, .. } = serde_json::from_slice(BYTES)?;
    let split =
        |table: SplitV1| SplitTable { split: table.split, n_bits: table.bits, entries: table.entries };
    Ok(Codebooks::new(Tables { lsf_mean, lsf: lsf.into_iter().map(split).collect(), gains })?)
}

/// Serializes tables as JSON; `trained_on` describes the training data.
pub fn write_tables(tables: &Tables, trained_on: &str) -> Vec<u8> {
    let row = |row: &[f64]| -> Vec<f64> { row.iter().map(|x| (x * DIGITS).round() / DIGITS).collect() };
    let split = |table: &SplitTable| SplitV1 {
        split: table.split,
        bits: table.n_bits,
        entries: table.entries.iter().map(|entry| row(entry)).collect(),
    };
    let rounded = |gains: &[f64; 2]| gains.map(|x| (x * DIGITS).round() / DIGITS);
    let tables = TablesV1 {
        trained_on: trained_on.to_owned(),
        lsf_mean: row(&tables.lsf_mean),
        lsf: tables.lsf.iter().map(split).collect(),
        gains: tables.gains.iter().map(|table| table.iter().map(rounded).collect()).collect(),
    };
    layout::to_bytes(&tables, 3)
}

#[cfg(test)]
mod tests {
    use super::{BYTES, TablesV1, built_in_codebooks, write_tables};

    #[test]
    fn the_committed_file_is_sound_and_is_what_is_written() {
        let books = built_in_codebooks().unwrap();
        let TablesV1 { trained_on, .. } = serde_json::from_slice(BYTES).unwrap();
        assert_eq!(write_tables(books.tables(), &trained_on), BYTES);
    }
}
