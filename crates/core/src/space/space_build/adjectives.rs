//! Adjective pairs: their relevance, their mean ratings, and their directions in the perceptual space.

use crate::people::property::{PropertyError, PropertyLine, fit_property};
use crate::people::ratings::{
    AdjectivePair, Agreement, AgreementError, Average, RatingTable, RelevanceVote, SHORT_SCALE, agreement,
    averages, relevances,
};
use crate::space::space_build::SpaceBuildError;
use crate::words::counted;

/// A rated adjective pair.
#[derive(Clone, Debug, PartialEq)]
pub struct Adjective {
    /// The adjective pair.
    pub pair: AdjectivePair,
    /// Fraction of the votes that find the pair relevant, 0..1. People vote on a pole or on the whole pair; this is the
    /// lowest fraction among these names. `None` if nobody voted on any of them.
    pub relevance: Option<f64>,
    /// Whether the pair is used: there are no votes on it, or the fraction is at least
    /// [`RELEVANCE_LIMIT`](crate::people::ratings::RELEVANCE_LIMIT).
    pub is_relevant: bool,
    /// Mean rating of each texture of the space.
    pub ratings: Vec<Average>,
    /// Agreement of the raters.
    pub agreement: Result<Agreement, AgreementError>,
    /// Fitted line in the perceptual space, which has the direction of the pair; without sorts,
    /// [`PropertyError::NoConfiguration`].
    pub line: Result<PropertyLine, PropertyError>,
}

impl Adjective {
    /// Index and mean rating of each rated texture.
    pub fn rated(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.ratings.iter().enumerate().filter_map(|(texture, average)| Some((texture, average.mean?)))
    }
}

/// Names that a vote on a pair may use: either pole, or both in either order.
fn words_of(pair: &AdjectivePair) -> [String; 4] {
    let turned = AdjectivePair { low: pair.high.clone(), high: pair.low.clone() };
    [pair.low.clone(), pair.high.clone(), pair.name(), turned.name()]
}

/// Fits all pairs of the table; `textures` gives the order of the textures and `points` their coordinates in the perceptual
/// space, if there are sorts.
pub(super) fn fit_adjectives(
    table: &RatingTable,
    votes: &[RelevanceVote],
    textures: &[String],
    points: Option<&[Vec<f64>]>,
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
        findings.push(format!("voted on but not part of any rated adjective pair: {}", stray.join(", ")));
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
            "no rating is above {highest}, but the scale is assumed to be 0 to 100; if the ratings use another scale, state it (in the window: scale beside Ratings; on the command line: --scale LOW,HIGH)"
        ));
    }
    let row_of: Vec<Option<usize>> =
        textures.iter().map(|id| table.textures().iter().position(|t| t == id)).collect();
    let unrated: Vec<&str> =
        textures.iter().zip(&row_of).filter(|(_, row)| row.is_none()).map(|(id, _)| id.as_str()).collect();
    if !unrated.is_empty() {
        findings.push(format!("not rated, so positioned by sorting alone: {}", unrated.join(", ")));
    }
    let unsorted: Vec<&str> =
        table.textures().iter().filter(|id| !textures.contains(id)).map(String::as_str).collect();
    if !unsorted.is_empty() {
        findings.push(format!("rated but not sorted, so without a position: {}", unsorted.join(", ")));
    }
    let adjectives = table.pairs().iter().enumerate().map(|(index, pair)| {
        let votes: Vec<(f64, bool)> = words_of(pair).iter().filter_map(|word| share(word)).collect();
        let in_table = averages(table, index);
        let ratings: Vec<Average> =
            row_of.iter().map(|row| row.map_or(Average::NONE, |row| in_table[row])).collect();
        let line = points.map_or(Err(PropertyError::NoConfiguration), |points| {
            let (coordinates, means): (Vec<Vec<f64>>, Vec<f64>) = points
                .iter()
                .zip(&ratings)
                .filter_map(|(point, average)| Some((point.clone(), average.mean?)))
                .unzip();
            fit_property(&coordinates, &means)
        });
        Adjective {
            pair: pair.clone(),
            relevance: votes.iter().map(|(share, _)| *share).reduce(f64::min),
            is_relevant: votes.iter().all(|(_, kept)| *kept),
            ratings,
            agreement: agreement(table, index),
            line,
        }
    });
    let adjectives: Vec<Adjective> = adjectives.collect();
    for adjective in &adjectives {
        if !adjective.is_relevant {
            let percent = 100.0 * adjective.relevance.unwrap_or_default();
            findings.push(format!(
                "{} is excluded: only {percent:.0} % of the votes find it relevant, fewer than half",
                adjective.pair
            ));
        }
        if let Err(error) = &adjective.line
            && points.is_some()
        {
            findings.push(format!("{} has no direction in the perceptual space: {error}", adjective.pair));
        }
        let n_unrated = adjective.ratings.iter().filter(|a| a.mean.is_none()).count() - unrated.len();
        if n_unrated > 0 {
            findings.push(format!("{}: no rating for {}", adjective.pair, counted(n_unrated, "texture")));
        }
    }
    Ok(adjectives)
}
