//! Adjective pairs: which count, how textures were rated on them, where they point.

use crate::property::{PropertyError, PropertyLine, fit_property};
use crate::ratings::{
    AdjectivePair, Agreement, AgreementError, Average, RatingTable, RelevanceVote, SHORT_SCALE, agreement,
    averages, relevances,
};
use crate::space_build::SpaceBuildError;
use crate::words::counted;

/// An adjective pair that was rated.
#[derive(Clone, Debug, PartialEq)]
pub struct Adjective {
    /// The pair.
    pub pair: AdjectivePair,
    /// Share of the votes that find it relevant, 0..1: the lower of its two poles; `None` without votes.
    pub relevance: Option<f64>,
    /// Whether it counts: no votes, or at least half of them.
    pub is_relevant: bool,
    /// How each texture was rated.
    pub ratings: Vec<Average>,
    /// How far raters agree.
    pub agreement: Result<Agreement, AgreementError>,
    /// Where it points in the perceptual space.
    pub line: Result<PropertyLine, PropertyError>,
}

impl Adjective {
    /// Mean rating of each texture that was rated, with its index.
    pub fn rated(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.ratings.iter().enumerate().filter_map(|(texture, average)| Some((texture, average.mean?)))
    }

    /// The line, where the pair counts and has one.
    pub(super) fn usable_line(&self) -> Option<&PropertyLine> {
        self.line.as_ref().ok().filter(|_| self.is_relevant)
    }
}

/// What a vote on a pair may call it: either pole, or both in either order.
fn words_of(pair: &AdjectivePair) -> [String; 4] {
    let turned = AdjectivePair { low: pair.high.clone(), high: pair.low.clone() };
    [pair.low.clone(), pair.high.clone(), pair.name(), turned.name()]
}

/// All pairs of the table, textures in the order of `textures`, which lie at `points`.
pub(super) fn fit_adjectives(
    table: &RatingTable,
    votes: &[RelevanceVote],
    textures: &[String],
    points: &[Vec<f64>],
    findings: &mut Vec<String>,
) -> Result<Vec<Adjective>, SpaceBuildError> {
    let relevances = relevances(votes)?;
    let share = |word: &str| {
        let is_it = |name: &str| name.trim().eq_ignore_ascii_case(word.trim());
        relevances.iter().find(|r| is_it(&r.adjective)).map(|r| (r.share, r.kept))
    };
    let words = || table.pairs().iter().flat_map(words_of);
    let is_in_a_pair =
        |adjective: &str| words().any(|word| word.trim().eq_ignore_ascii_case(adjective.trim()));
    let stray: Vec<&str> = relevances
        .iter()
        .map(|r| r.adjective.as_str())
        .filter(|adjective| !is_in_a_pair(adjective))
        .collect();
    if !stray.is_empty() {
        findings.push(format!("voted on, but in no pair that was rated: {}", stray.join(", ")));
    }
    let values = (0..table.participants().len()).flat_map(|p| {
        let of = move |texture: usize| {
            (0..table.pairs().len()).filter_map(move |pair| table.value(p, texture, pair))
        };
        (0..table.textures().len()).flat_map(of)
    });
    let highest = values.fold(0.0, f64::max);
    if highest <= SHORT_SCALE {
        findings.push(format!(
            "no rating is above {highest}: ratings are taken to run from 0 to 100; if they were given on another scale, say so (--scale LOW,HIGH), or bring them to it first"
        ));
    }
    let row_of: Vec<Option<usize>> =
        textures.iter().map(|id| table.textures().iter().position(|t| t == id)).collect();
    let unrated: Vec<&str> =
        textures.iter().zip(&row_of).filter(|(_, row)| row.is_none()).map(|(id, _)| id.as_str()).collect();
    if !unrated.is_empty() {
        findings.push(format!("placed by sorting alone, since nobody rated them: {}", unrated.join(", ")));
    }
    let unsorted: Vec<&str> =
        table.textures().iter().filter(|id| !textures.contains(id)).map(String::as_str).collect();
    if !unsorted.is_empty() {
        findings.push(format!("rated but not sorted, and so without a place: {}", unsorted.join(", ")));
    }
    let adjectives = table.pairs().iter().enumerate().map(|(index, pair)| {
        let votes: Vec<(f64, bool)> = words_of(pair).iter().filter_map(|word| share(word)).collect();
        let in_table = averages(table, index);
        let none = Average { n_raters: 0, mean: None, half_width: None };
        let ratings: Vec<Average> = row_of.iter().map(|row| row.map_or(none, |row| in_table[row])).collect();
        let (coordinates, means): (Vec<Vec<f64>>, Vec<f64>) = points
            .iter()
            .zip(&ratings)
            .filter_map(|(point, average)| Some((point.clone(), average.mean?)))
            .unzip();
        Adjective {
            pair: pair.clone(),
            relevance: votes.iter().map(|(share, _)| *share).reduce(f64::min),
            is_relevant: votes.iter().all(|(_, kept)| *kept),
            ratings,
            agreement: agreement(table, index),
            line: fit_property(&coordinates, &means),
        }
    });
    let adjectives: Vec<Adjective> = adjectives.collect();
    for adjective in &adjectives {
        if !adjective.is_relevant {
            let percent = 100.0 * adjective.relevance.unwrap_or_default();
            findings.push(format!(
                "{} does not count: {percent:.0} % of the votes find it relevant, fewer than half",
                adjective.pair
            ));
        }
        if let Err(error) = &adjective.line {
            findings.push(format!("{} points nowhere: {error}", adjective.pair));
        }
        let n_unrated = adjective.ratings.iter().filter(|a| a.mean.is_none()).count() - unrated.len();
        if n_unrated > 0 {
            findings.push(format!(
                "{}: no rating of {} on it",
                adjective.pair,
                counted(n_unrated, "texture")
            ));
        }
    }
    Ok(adjectives)
}
