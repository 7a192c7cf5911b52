//! Ratings as a complete table; duplicate and contradictory entries are errors.

use std::collections::BTreeMap;

use super::{AdjectivePair, Rating};

/// Ratings by participant, texture and adjective pair, each list in the order of first appearance.
#[derive(Clone, Debug, PartialEq)]
pub struct RatingTable {
    participants: Vec<String>,
    textures: Vec<String>,
    pairs: Vec<AdjectivePair>,
    /// Ordered by participant, then texture, then pair.
    values: Vec<Option<f64>>,
}

/// Maximum number of adjective pairs; a larger number indicates a wrong column.
const MAX_PAIRS: usize = 1000;

/// Maximum number of table cells: a thousand participants, a hundred textures and a hundred pairs.
const MAX_CELLS: usize = 10_000_000;

/// Reasons why ratings do not form a table.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RatingsError {
    /// There are no ratings.
    #[error("there are no ratings; add at least one")]
    Empty,
    /// A participant rated the same texture twice on one pair.
    #[error("{participant} rated \"{texture}\" twice on {pair}; keep one of the two ratings")]
    Twice {
        /// Name of the participant.
        participant: String,
        /// Name of the texture.
        texture: String,
        /// The adjective pair.
        pair: AdjectivePair,
    },
    /// A rating is outside the scale.
    #[error(
        "{participant} rated \"{texture}\" {value} on {pair}; a rating must be between 0 ({}) and 100 ({}), or empty", pair.low, pair.high
    )]
    OutOfRange {
        /// Name of the participant.
        participant: String,
        /// Name of the texture.
        texture: String,
        /// The adjective pair.
        pair: AdjectivePair,
        /// The rating given.
        value: f64,
    },
    /// There are too many adjective pairs.
    #[error(
        "{n_pairs} adjective pairs exceed the maximum of {MAX_PAIRS}; check which column contains the adjective pair"
    )]
    TooManyPairs {
        /// Number of pairs.
        n_pairs: usize,
    },
    /// The table would be too large.
    #[error(
        "{n_participants} participants, {n_textures} textures and {n_pairs} pairs exceed the maximum of {MAX_CELLS} ratings; check the assignment of the columns"
    )]
    TooMany {
        /// Number of participants.
        n_participants: usize,
        /// Number of textures.
        n_textures: usize,
        /// Number of pairs.
        n_pairs: usize,
    },
    /// Both poles of a pair are the same word, or one pole is empty.
    #[error("the pair \"{}\"\u{2013}\"{}\" does not have two poles; name two different adjectives", .0.low, .0.high)]
    Poles(AdjectivePair),
    /// Two pairs consist of the same adjectives.
    #[error("{first} and {second} are the same adjectives; use one spelling and order, low pole first")]
    SamePair {
        /// The pair that appears first.
        first: AdjectivePair,
        /// The other pair.
        second: AdjectivePair,
    },
}

impl RatingTable {
    /// Builds a table. A missing answer may be a rating without a value or no rating at all.
    ///
    /// # Errors
    /// See [`RatingsError`].
    pub fn new(ratings: &[Rating]) -> Result<Self, RatingsError> {
        if ratings.is_empty() {
            return Err(RatingsError::Empty);
        }
        let mut pairs: Vec<AdjectivePair> = Vec::new();
        let mut index_of_pair: BTreeMap<(&str, &str), usize> = BTreeMap::new();
        for AdjectivePair { low, high } in ratings.iter().map(|rating| &rating.pair) {
            index_of_pair.entry((low, high)).or_insert_with(|| {
                pairs.push(AdjectivePair { low: low.clone(), high: high.clone() });
                pairs.len() - 1
            });
        }
        if pairs.len() > MAX_PAIRS {
            return Err(RatingsError::TooManyPairs { n_pairs: pairs.len() });
        }
        check_pairs(&pairs)?;
        let pair_index = |pair: &AdjectivePair| index_of_pair[&(pair.low.as_str(), pair.high.as_str())];
        let (participants, participant_index) = names(ratings, |r| &r.participant);
        let (textures, texture_index) = names(ratings, |r| &r.texture);
        let n_cells = participants.len().saturating_mul(textures.len()).saturating_mul(pairs.len());
        if n_cells > MAX_CELLS {
            let (n_participants, n_textures) = (participants.len(), textures.len());
            return Err(RatingsError::TooMany { n_participants, n_textures, n_pairs: pairs.len() });
        }
        let (mut values, mut seen) = (vec![None; n_cells], vec![false; n_cells]);
        for rating in ratings {
            let (participant, texture) = (rating.participant.clone(), rating.texture.clone());
            if let Some(value) = rating.value
                && !(0.0..=100.0).contains(&value)
            {
                let pair = rating.pair.clone();
                return Err(RatingsError::OutOfRange { participant, texture, pair, value });
            }
            let row = participant_index[&participant] * textures.len() + texture_index[&texture];
            let cell = row * pairs.len() + pair_index(&rating.pair);
            if std::mem::replace(&mut seen[cell], true) {
                return Err(RatingsError::Twice { participant, texture, pair: rating.pair.clone() });
            }
            values[cell] = rating.value;
        }
        Ok(Self { participants, textures, pairs, values })
    }

    /// Names of the participants.
    pub fn participants(&self) -> &[String] {
        &self.participants
    }

    /// Names of the textures.
    pub fn textures(&self) -> &[String] {
        &self.textures
    }

    /// Adjective pairs.
    pub fn pairs(&self) -> &[AdjectivePair] {
        &self.pairs
    }

    /// Rating, 0..100, by indices into the three lists; `None` if it is missing.
    ///
    /// # Panics
    /// If an index is out of range.
    pub fn value(&self, participant: usize, texture: usize, pair: usize) -> Option<f64> {
        assert!(
            texture < self.textures.len() && pair < self.pairs.len(),
            "texture or pair index out of range"
        );
        self.values[(participant * self.textures.len() + texture) * self.pairs.len() + pair]
    }

    /// Number of missing ratings among all possible ones.
    pub fn n_missing(&self) -> usize {
        self.values.iter().filter(|v| v.is_none()).count()
    }

    /// All ratings of one texture on one pair, without the missing ones.
    pub(super) fn raters_of(&self, texture: usize, pair: usize) -> Vec<f64> {
        (0..self.participants.len()).filter_map(|p| self.value(p, texture, pair)).collect()
    }
}

/// Checks that each pair has two different poles and that no two pairs share their words, whatever their case and
/// order.
///
/// # Errors
/// [`RatingsError::Poles`] or [`RatingsError::SamePair`].
pub(super) fn check_pairs(pairs: &[AdjectivePair]) -> Result<(), RatingsError> {
    let plain = |text: &str| text.trim().to_lowercase();
    let mut seen: Vec<([String; 2], &AdjectivePair)> = Vec::with_capacity(pairs.len());
    for pair in pairs {
        let mut poles = [plain(&pair.low), plain(&pair.high)];
        poles.sort();
        if poles[0].is_empty() || poles[0] == poles[1] {
            return Err(RatingsError::Poles(pair.clone()));
        }
        if let Some((_, first)) = seen.iter().find(|(other, _)| *other == poles) {
            return Err(RatingsError::SamePair { first: (*first).clone(), second: pair.clone() });
        }
        seen.push((poles, pair));
    }
    Ok(())
}

/// Names in the order of first appearance, and the index of each name.
fn names(ratings: &[Rating], name: impl Fn(&Rating) -> &String) -> (Vec<String>, BTreeMap<String, usize>) {
    let (mut order, mut index) = (Vec::new(), BTreeMap::new());
    for rating in ratings {
        let name = name(rating);
        if !index.contains_key(name) {
            index.insert(name.clone(), order.len());
            order.push(name.clone());
        }
    }
    (order, index)
}
