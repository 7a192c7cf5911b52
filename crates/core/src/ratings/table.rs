//! Ratings as a table, with everything refused that would make two answers of one.

use std::collections::BTreeMap;

use super::{AdjectivePair, Rating};

/// Ratings by participant, texture and pair, each in the order of its first appearance.
#[derive(Clone, Debug, PartialEq)]
pub struct RatingTable {
    participants: Vec<String>,
    textures: Vec<String>,
    pairs: Vec<AdjectivePair>,
    /// Participant by participant, in each texture by texture, in each pair by pair.
    values: Vec<Option<f64>>,
}

/// The most adjective pairs of a table: more are columns of something else.
const MAX_PAIRS: usize = 1000;

/// The most ratings that a table has room for: a thousand people, a hundred textures and a hundred pairs.
const MAX_CELLS: usize = 10_000_000;

/// Why ratings make no table.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RatingsError {
    /// There is none.
    #[error("there is no rating")]
    Empty,
    /// Somebody rated the same twice.
    #[error("{participant} rated \"{texture}\" twice on {pair}; keep one of the two")]
    Twice {
        /// Who.
        participant: String,
        /// What.
        texture: String,
        /// On which pair.
        pair: AdjectivePair,
    },
    /// A rating lies outside the scale.
    #[error(
        "{participant} rated \"{texture}\" {value} on {pair}; a rating lies between 0 ({}) and 100 ({}), or is left empty", pair.low, pair.high
    )]
    OutOfRange {
        /// Who.
        participant: String,
        /// What.
        texture: String,
        /// On which pair.
        pair: AdjectivePair,
        /// The rating.
        value: f64,
    },
    /// There are more pairs than anybody rates.
    #[error(
        "{n_pairs} adjective pairs are more than the {MAX_PAIRS} that a table takes; check which column names the pair"
    )]
    TooManyPairs {
        /// The pairs.
        n_pairs: usize,
    },
    /// The table would be too large.
    #[error(
        "{n_participants} participants, {n_textures} textures and {n_pairs} pairs make more than the {MAX_CELLS} ratings that a table takes; check which column is which"
    )]
    TooMany {
        /// The participants.
        n_participants: usize,
        /// The textures.
        n_textures: usize,
        /// The pairs.
        n_pairs: usize,
    },
    /// Both poles of a pair are one word, or one is empty.
    #[error("the pair \"{}\"\u{2013}\"{}\" has no two poles; name two different adjectives", .0.low, .0.high)]
    Poles(AdjectivePair),
    /// Two pairs are of the same words.
    #[error("{first} and {second} are the same adjectives; write them in one way, low pole first")]
    SamePair {
        /// The pair that came first.
        first: AdjectivePair,
        /// The other.
        second: AdjectivePair,
    },
}

impl RatingTable {
    /// The table of ratings. An answer that was not given may be a rating without a value or no rating at all.
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

    /// Who rated.
    pub fn participants(&self) -> &[String] {
        &self.participants
    }

    /// What was rated.
    pub fn textures(&self) -> &[String] {
        &self.textures
    }

    /// Between which adjectives.
    pub fn pairs(&self) -> &[AdjectivePair] {
        &self.pairs
    }

    /// The rating, 0..100, by indices into the three lists; `None` where it is missing.
    ///
    /// # Panics
    /// If an index is not in its list.
    pub fn value(&self, participant: usize, texture: usize, pair: usize) -> Option<f64> {
        assert!(texture < self.textures.len() && pair < self.pairs.len(), "an index is not in its list");
        self.values[(participant * self.textures.len() + texture) * self.pairs.len() + pair]
    }

    /// How many of all possible ratings are missing.
    pub fn n_missing(&self) -> usize {
        self.values.iter().filter(|v| v.is_none()).count()
    }

    /// The ratings that one texture got on one pair, missing ones left out.
    pub(super) fn raters_of(&self, texture: usize, pair: usize) -> Vec<f64> {
        (0..self.participants.len()).filter_map(|p| self.value(p, texture, pair)).collect()
    }
}

/// Checks that pairs can stand beside each other: two words each, and no words twice, whatever their case and order.
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

/// Names in the order of their first appearance, and where each is in that order.
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
