//! The tables of the codec that are built into the program, and their file.

use serde::{Deserialize, Serialize};
use shagreen_core::codec::books::{BooksError, Codebooks, SplitTable, Tables};

use crate::layout;

const BYTES: &[u8] = include_bytes!("../../../assets/codec/tables.json");
/// Digits that are kept of every number: far finer than what any of them is known to.
const DIGITS: f64 = 1e7;

/// The tables as JSON.
#[derive(Debug, Serialize, Deserialize)]
struct TablesV1 {
    /// What the tables were learnt from, for people.
    trained_on: String,
    /// In radians.
    lsf_mean: Vec<f64>,
    lsf: Vec<SplitV1>,
    /// Of 4, 5 and 6 bits.
    gains: Vec<Vec<[f64; 2]>>,
}

#[derive(Debug, Serialize, Deserialize)]
struct SplitV1 {
    split: usize,
    bits: u32,
    entries: Vec<Vec<f64>>,
}

/// Why there are no tables.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CodecTablesError {
    /// No JSON of tables.
    #[error("the tables of the codec are damaged: {0}; install the program again")]
    Json(#[from] serde_json::Error),
    /// Tables of another codec.
    #[error(transparent)]
    Books(#[from] BooksError),
}

/// The tables of the program: encoder and decoder of a stream must have the same.
///
/// # Errors
/// None, as long as the committed file is sound, which a test holds.
pub fn built_in_codebooks() -> Result<Codebooks, CodecTablesError> {
    let TablesV1 { lsf_mean, lsf, gains, .. } = serde_json::from_slice(BYTES)?;
    let split =
        |table: SplitV1| SplitTable { split: table.split, n_bits: table.bits, entries: table.entries };
    Ok(Codebooks::new(Tables { lsf_mean, lsf: lsf.into_iter().map(split).collect(), gains })?)
}

/// Tables as the bytes of their file.
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
