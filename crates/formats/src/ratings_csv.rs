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

#[cfg(test)]
mod tests {
    use super::{ratings_csv, read_ratings, read_ratings_csv, read_relevance_csv};

    const LONG: &str = "participant,texture,adjective,value\n\
                        p1,cork,rough-smooth,41\np1,cork,hard-soft,70.5\n\
                        p2,cork,rough-smooth,\np2,cork,hard-soft,60\n";
    const WIDE: &str = "subject\ttexture id\trough-smooth\thard-soft\np1\tcork\t41\t70,5\np2\tcork\t\t60\n";

    #[test]
    fn both_shapes_say_the_same() {
        let long = read_ratings_csv(LONG.as_bytes()).unwrap();
        assert_eq!(read_ratings_csv(WIDE.as_bytes()), Ok(long.clone()));
        assert_eq!((long.len(), long[2].value, long[1].value), (4, None, Some(70.5)));
        assert_eq!(read_ratings_csv(&ratings_csv(&long)), Ok(long));
    }

    #[test]
    fn what_is_no_rating_says_why() {
        let check = |text: &str, words: &str| {
            let message = read_ratings_csv(text.as_bytes()).unwrap_err().to_string();
            assert!(message.contains(words), "{message}");
        };
        for sorts in [
            "participant,trial,groups,texture,group\np,1,2,cork,a\n",
            "participant,trial,cork,felt\np,1,a,b\n",
            "participant,groups,cork,felt\np,2,a,b\n",
        ] {
            check(sorts, "this looks like the sorting table: the columns are participant");
        }
        check("participant,texture\np,cork\n", "no column holds ratings");
        check(
            "participant,texture,smoothness\np,cork,3\n",
            "the columns are participant, texture, smoothness",
        );
        check(
            "participant,texture,non-stick-sticky\np,cork,3\n",
            "line 1: \"non-stick-sticky\" can be split",
        );
        check("sep=,\nparticipant,texture,non-stick-sticky\np,cork,3\n", "line 2: \"non-stick-sticky\"");
        check(
            "participant,texture,a-b\np,cork,101\n",
            "a-b in line 2 is \"101\"; a rating is a number from 0 to 100",
        );
        check("participant,texture,a-b,pre-post\np,cork,1,12:30\n", "pre-post in line 2 is \"12:30\"");
        check(
            "participant,texture,a-b,pre-post\np,cork,1,12:30\n",
            "if the column is not an adjective pair, remove it",
        );
        check("participant,texture,pair,value\np,cork,a-b,-1\n", "value in line 2 is \"-1\"");
        check("participant,texture,a-b\np,cork,\"1,234,5\"\n", "a-b in line 2 is \"1,234,5\"");
        check("participant,texture,adjective,value\np,cork,smooth,3\n", "line 2: \"smooth\"");
        check("participant,texture,a-b\np,cork,much\n", "a-b in line 2 is \"much\"");
        check("participant,texture,a-b\np,,3\n", "line 2 has no texture");
        check("texture,a-b\ncork,3\n", "\"participant\"");
    }

    #[test]
    fn other_columns_are_named_and_not_used() {
        let expected = read_ratings(WIDE.as_bytes()).unwrap();
        assert!(expected.warnings.is_empty());
        let wide = "subject,age,texture id,rough-smooth,start-time,hard-soft,test date\n\
                    p1,31,cork,41,12:30,\"70,5\",2026-11-21\np2,27,cork,,12:40,60,2026-11-21\n";
        let read = read_ratings(wide.as_bytes()).unwrap();
        assert_eq!(read.value, expected.value);
        assert!(
            read.warnings[0].starts_with("the columns age, start-time, test date are not used;"),
            "{read:?}"
        );
        let long = "participant,trial,texture,adjective,value\np1,1,cork,rough-smooth,41\n";
        let read = read_ratings(long.as_bytes()).unwrap();
        assert!(
            read.value.len() == 1 && read.warnings[0].starts_with("the column trial is not used;"),
            "{read:?}"
        );
    }

    #[test]
    fn votes_are_read_in_both_shapes() {
        let long = "participant,adjective,relevant\np1,rough,yes\np1,warm,0\np2,rough,1\np2,warm,\n";
        let wide = "participant,rough,warm\np1,1,0\np2,x,\n";
        let votes = read_relevance_csv(long.as_bytes()).unwrap();
        assert_eq!(read_relevance_csv(wide.as_bytes()), Ok(votes.clone()));
        assert_eq!(votes.iter().filter(|vote| vote.relevant).count(), 2);
        let message = read_relevance_csv(b"participant,rough\np1,maybe\n").unwrap_err().to_string();
        assert!(message.contains("rough in line 2 is \"maybe\""), "{message}");
    }
}
