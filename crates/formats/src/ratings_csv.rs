//! Human ratings as a table, in long or wide format.
//!
//! One line per rating, or one line per participant and texture with a column for each adjective pair:
//!
//! ```csv
//! participant,texture,adjective,value          participant,texture,rough-smooth,hard-soft
//! p01,cork,rough-smooth,41                     p01,cork,41,70.5
//! ```
//!
//! A pair is named by its poles, the one at 0 first. An empty rating is missing. Other columns, such as `age` or
//! `start_time`, are not used.

use shagreen_core::people::ratings::{AdjectivePair, PairNameError, Rating, RelevanceVote};

use crate::imported::Imported;
use crate::judgment_columns::{ADJECTIVE, PARTICIPANT, TEXTURE, VALUE, are_sorts};
use crate::named_table::{Field, NamedTable, NamedTableError, write_table};
use crate::pair_columns::{NAME_BOTH_POLES, pair_columns, unused_warning};

/// Why a table holds no ratings.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RatingsCsvError {
    /// The table cannot be read.
    #[error(transparent)]
    Table(#[from] NamedTableError),
    /// A name is not an adjective pair.
    #[error("line {line}: {source}")]
    Pair {
        /// The line, from one.
        line: u64,
        /// What is wrong.
        source: PairNameError,
    },
    /// A value is not a rating.
    #[error("{column} in line {line} is \"{found}\"; a rating is a number from 0 to 100, or empty; {hint}")]
    NotARating {
        /// Name of the column.
        column: String,
        /// The line, from one.
        line: u64,
        /// Text of the field.
        found: String,
        /// What the user should do.
        hint: &'static str,
    },
    /// The table has the columns of sorts.
    #[error(
        "this looks like the sorting table: the columns are {found}; give the ratings table here, with the columns participant, texture, adjective and value, or one column per adjective pair, named like \"rough-smooth\""
    )]
    Sorting {
        /// Names of the columns.
        found: String,
    },
    /// No column is an adjective pair.
    #[error(
        "no column holds ratings; the columns are {found}; use the columns adjective and value, or one column per adjective pair, named like \"rough-smooth\""
    )]
    NoPairs {
        /// Names of the columns.
        found: String,
    },
    /// A vote is neither yes nor no.
    #[error("{column} in line {line} is \"{found}\"; use 1 or 0, or yes or no")]
    Vote {
        /// Name of the column.
        column: String,
        /// The line, from one.
        line: u64,
        /// Text of the field.
        found: String,
    },
}

const RELEVANT: [&str; 4] = ["relevant", "selected", "vote", "chosen"];

/// Suggestions for an invalid rating, in either format.
const RESCALE: &str = "convert ratings on another scale first";
const RESCALE_OR_RENAME: &str = "convert ratings on another scale first; if the column is not an adjective pair, remove it, or rename it to one word";

/// Reads ratings, including missing ones. Unused columns raise a warning.
///
/// # Errors
/// See [`RatingsCsvError`].
pub fn read_ratings(bytes: &[u8]) -> Result<Imported<Vec<Rating>>, RatingsCsvError> {
    let table = NamedTable::read(bytes, "participant, texture, adjective, value", "rating")?;
    let participant = table.need(&PARTICIPANT)?;
    if are_sorts(&table) {
        return Err(RatingsCsvError::Sorting { found: table.columns.join(", ") });
    }
    let texture = table.need(&TEXTURE)?;
    let mut ratings = Vec::new();
    let mut push = |row_participant: Field<'_>, row_texture: Field<'_>, pair, value| {
        let (participant, texture) = (row_participant.word()?.to_owned(), row_texture.word()?.to_owned());
        ratings.push(Rating { participant, texture, pair, value });
        Ok::<(), RatingsCsvError>(())
    };
    let warning = if let (Some(adjective), Some(value)) = (table.find(&ADJECTIVE), table.find(&VALUE)) {
        for row in table.rows() {
            let pair: AdjectivePair = (row.at(adjective).word()?.parse())
                .map_err(|source| RatingsCsvError::Pair { line: row.line(), source })?;
            push(row.at(participant), row.at(texture), pair, rating(row.at(value), RESCALE)?)?;
        }
        let unused = table.others(&[participant, texture, adjective, value].map(Some));
        unused_warning(&table, &unused, "ratings are read from the columns adjective and value")
    } else {
        let others = table.others(&[Some(participant), Some(texture)]);
        let columns = pair_columns(&table, &others, |field| rating(field, RESCALE).is_ok())
            .map_err(|source| RatingsCsvError::Pair { line: table.first_line, source })?;
        if columns.pairs.is_empty() {
            return Err(RatingsCsvError::NoPairs { found: table.columns.join(", ") });
        }
        for row in table.rows() {
            for (column, pair) in &columns.pairs {
                let value = rating(row.at(*column), RESCALE_OR_RENAME)?;
                push(row.at(participant), row.at(texture), pair.clone(), value)?;
            }
        }
        unused_warning(&table, &columns.unused, NAME_BOTH_POLES)
    };
    Ok(Imported { value: ratings, warnings: warning.into_iter().collect() })
}

/// Parses the rating in a field; `None` if it is empty.
fn rating(field: Field<'_>, hint: &'static str) -> Result<Option<f64>, RatingsCsvError> {
    match field.number() {
        Ok(value) if value.is_none_or(|value| (0.0..=100.0).contains(&value)) => Ok(value),
        _ => Err(RatingsCsvError::NotARating {
            column: field.name().to_owned(),
            line: field.line(),
            found: field.text().to_owned(),
            hint,
        }),
    }
}

/// Reads ratings as [`read_ratings`] does, without warnings.
///
/// # Errors
/// See [`RatingsCsvError`].
pub fn read_ratings_csv(bytes: &[u8]) -> Result<Vec<Rating>, RatingsCsvError> {
    read_ratings(bytes).map(|imported| imported.value)
}

/// Reads votes on the relevance of adjectives: the columns `participant`, `adjective`, `relevant` and optionally
/// `texture`, or one column per adjective. An empty vote was not cast.
///
/// # Errors
/// See [`RatingsCsvError`].
pub fn read_relevance_csv(bytes: &[u8]) -> Result<Vec<RelevanceVote>, RatingsCsvError> {
    let table = NamedTable::read(bytes, "participant, adjective, relevant", "vote")?;
    let participant = table.need(&PARTICIPANT)?;
    let texture = table.find(&TEXTURE);
    let mut votes = Vec::new();
    if let (Some(adjective), Some(relevant)) = (table.find(&ADJECTIVE), table.find(&RELEVANT)) {
        for row in table.rows() {
            let texture = texture.map(|column| row.at(column).word().map(str::to_owned)).transpose()?;
            let Some(relevant) = vote(row.at(relevant))? else { continue };
            let adjective = row.at(adjective).word()?.to_owned();
            votes.push(RelevanceVote {
                participant: row.at(participant).word()?.to_owned(),
                texture,
                adjective,
                relevant,
            });
        }
        return Ok(votes);
    }
    let others = table.others(&[Some(participant), texture]);
    if others.is_empty() {
        return Err(RatingsCsvError::NoPairs { found: table.columns.join(", ") });
    }
    for row in table.rows() {
        for column in &others {
            let texture = texture.map(|column| row.at(column).word().map(str::to_owned)).transpose()?;
            let Some(relevant) = vote(row.at(*column))? else { continue };
            votes.push(RelevanceVote {
                participant: row.at(participant).word()?.to_owned(),
                texture,
                adjective: table.columns[*column].clone(),
                relevant,
            });
        }
    }
    Ok(votes)
}

fn vote(field: Field<'_>) -> Result<Option<bool>, RatingsCsvError> {
    match field.text().to_lowercase().as_str() {
        "" => Ok(None),
        "1" | "yes" | "y" | "true" | "x" => Ok(Some(true)),
        "0" | "no" | "n" | "false" => Ok(Some(false)),
        found => Err(RatingsCsvError::Vote {
            column: field.name().to_owned(),
            line: field.line(),
            found: found.to_owned(),
        }),
    }
}

/// Writes ratings as a table with one line per rating.
pub fn ratings_csv(ratings: &[Rating]) -> Vec<u8> {
    let first = ["participant", "texture", "adjective", "value"].map(str::to_owned).to_vec();
    let rows = ratings.iter().map(|Rating { participant, texture, pair, value }| {
        let value = value.map_or_else(String::new, |value| format!("{value}"));
        vec![participant.clone(), texture.clone(), pair.name(), value]
    });
    write_table(std::iter::once(first).chain(rows))
}

/// Writes votes on the relevance of adjectives as a table with one line per vote. The column `texture` is left out if no vote
/// names a texture.
pub fn relevance_csv(votes: &[RelevanceVote]) -> Vec<u8> {
    let has_textures = votes.iter().any(|vote| vote.texture.is_some());
    let row = |fields: [String; 4]| -> Vec<String> {
        let [participant, texture, adjective, relevant] = fields;
        let texture = has_textures.then_some(texture);
        [participant].into_iter().chain(texture).chain([adjective, relevant]).collect()
    };
    let first = row(["participant", "texture", "adjective", "relevant"].map(str::to_owned));
    let rows = votes.iter().map(|RelevanceVote { participant, texture, adjective, relevant }| {
        let relevant = u8::from(*relevant).to_string();
        row([participant.clone(), texture.clone().unwrap_or_default(), adjective.clone(), relevant])
    });
    write_table(std::iter::once(first).chain(rows))
}

#[cfg(test)]
mod tests;
