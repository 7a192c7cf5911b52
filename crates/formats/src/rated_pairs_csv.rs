//! Rated pairs of signals: the table to which a model of felt difference is fitted, one row for each pair.
//!
//! | column | content |
//! |---|---|
//! | `reference`, `comparison` | the two signals: files, or identifiers of the stimuli of a study |
//! | `texture` | texture of the pair, whose pairs are left out together in the validation; without it, `reference` |
//! | `d_prime` | rated d′, -40 to 40; if it is empty, it is computed from the counts |
//! | `n_same`, `n_different` | "same" and "different" answers to the different pair |
//! | `n_trials_identical`, `n_different_on_identical` | trials with two identical signals, "different" answers to them |
//! | `hits`, `n_different`, `false_alarms`, `n_same` | the counts in another form: "different" answers to the different pair, its number of trials, "different" answers to identical signals, number of these trials |
//! | `weight` | weight of the pair in the fit, above 0; without it, 1 |
//! | `simulated` | 1 if simulated participants answered, else 0 or empty |
//! | `roughness`, `brightness`, `regularity`, `asymmetry`, `spectral_power`, `spectral_amplitude`, `envelope` | distances of the two signals, 0 or more; with any of these columns, no signals are read |
//!
//! [`crate::study_tables`] has the single answers of a study; this table has their counts.

mod error;
mod row;

use shagreen_core::people::study::same_different::{Correction, Counts, d_prime};
use shagreen_core::signals::quality::{Distances, Feature};

use crate::imported::Imported;
use crate::named_table::{NamedTable, write_table};
use crate::pair_columns::unused_warning;

pub use crate::rated_pairs_csv::error::RatedPairsError;

use self::row::Columns;

/// Rated pairs of signals.
#[derive(Clone, Debug, PartialEq)]
pub struct RatedPairsTable {
    /// The pairs, at least one.
    pub rows: Vec<RatedRow>,
    /// Features whose distances the table states, in the order of [`Feature::ALL`]; none if signals must be read.
    pub features: Vec<Feature>,
}

/// A row of the table.
#[derive(Clone, Debug, PartialEq)]
pub struct RatedRow {
    /// Line in the file, from one.
    pub line: u64,
    /// File or identifier of the reference.
    pub reference: String,
    /// File or identifier of the signal that is compared with it.
    pub comparison: String,
    /// Texture of the pair.
    pub texture: String,
    /// Rated d′.
    pub d_prime: f64,
    /// Answers from which d′ was computed; `None` if the table states d′.
    pub counts: Option<Counts>,
    /// Weight in a fit, above 0.
    pub weight: f64,
    /// Whether simulated participants answered.
    pub is_simulated: bool,
    /// Stated distances; those of features without a column are 0. `None` if signals must be read.
    pub distances: Option<Distances>,
}

/// Answers to a pair, as a study counts them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CountedPair {
    /// Identifier of the reference.
    pub reference: String,
    /// Identifier of the signal that is compared with it.
    pub comparison: String,
    /// The answers.
    pub counts: Counts,
    /// Whether simulated participants answered.
    pub is_simulated: bool,
}

/// Columns that a table needs, for errors.
const WANTED: &str = "reference, comparison, and d_prime or counts of answers";

/// Reads rated pairs. Warnings name columns that are not used.
///
/// # Errors
/// See [`RatedPairsError`].
pub fn read_rated_pairs(bytes: &[u8]) -> Result<Imported<RatedPairsTable>, RatedPairsError> {
    let table = NamedTable::read(bytes, WANTED, "pair of signals")?;
    let columns = Columns::find(&table)?;
    let rows = table.rows().map(|row| columns.row(row)).collect::<Result<Vec<_>, _>>()?;
    let used = "the table of rated pairs has the columns that the guide lists";
    let warnings = unused_warning(&table, &columns.unused(&table), used).into_iter().collect();
    Ok(Imported { value: RatedPairsTable { rows, features: columns.features() }, warnings })
}

/// Writes the counts of a study, and the d′ of each pair with both kinds of trials (log-linear correction), in the form that
/// [`read_rated_pairs`] accepts.
pub fn rated_pairs_csv(pairs: &[CountedPair]) -> Vec<u8> {
    let first = [
        "reference",
        "comparison",
        "n_same",
        "n_different",
        "n_trials_identical",
        "n_different_on_identical",
        "d_prime",
        "simulated",
    ];
    let row = |pair: &CountedPair| {
        let Counts { hits, n_different, false_alarms, n_same } = pair.counts;
        let d_prime = d_prime(pair.counts, Correction::LogLinear);
        vec![
            pair.reference.clone(),
            pair.comparison.clone(),
            n_different.saturating_sub(hits).to_string(),
            hits.to_string(),
            n_same.to_string(),
            false_alarms.to_string(),
            d_prime.map_or_else(String::new, |d_prime| d_prime.to_string()),
            u8::from(pair.is_simulated).to_string(),
        ]
    };
    write_table(std::iter::once(first.map(str::to_owned).to_vec()).chain(pairs.iter().map(row)))
}

#[cfg(test)]
mod tests;
