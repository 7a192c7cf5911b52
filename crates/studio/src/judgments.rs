//! Judgments of people: tables of sortings, ratings and votes, and simulated raters in their place.

use shagreen_core::people::panel::{
    PanelConfig, USUAL_GROUPS, is_simulated, simulated_ratings, simulated_sorts,
};
use shagreen_core::people::ratings::{Rating, RelevanceVote};
use shagreen_core::people::sorting::Sort;
use shagreen_core::space::LabelSource;
use shagreen_formats::imported::Imported;
use shagreen_formats::library::Library;
use shagreen_formats::places_csv::Scale;
use shagreen_formats::ratings_csv::{read_ratings, read_ratings_csv, read_relevance_csv};
use shagreen_formats::simulated_rater_labels::{SimulatedRaterLabels, panel_labels};
use shagreen_formats::sorting_csv::read_sorting_csv;

/// What a file holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JudgmentKind {
    /// Textures in groups.
    Sorting,
    /// Textures on adjective pairs.
    Ratings,
    /// Which adjectives are relevant.
    Votes,
}

/// The table of a file, by its kind.
#[derive(Clone, Debug)]
pub enum JudgmentTable {
    /// Textures in groups.
    Sorting(Imported<Vec<Sort>>),
    /// Textures on adjective pairs.
    Ratings(Imported<Vec<Rating>>),
    /// Which adjectives are relevant.
    Votes(Vec<RelevanceVote>),
}

/// Sorts and ratings of simulated raters.
#[derive(Clone, Debug)]
pub struct SimulatedJudgments {
    /// The sorts.
    pub sorts: Vec<Sort>,
    /// The ratings.
    pub ratings: Vec<Rating>,
}

/// Reads a table of this kind.
///
/// # Errors
/// The table is damaged or of another kind, in one sentence.
pub fn read_judgments(kind: JudgmentKind, bytes: &[u8]) -> Result<JudgmentTable, String> {
    match kind {
        JudgmentKind::Sorting => read_sorting_csv(bytes)
            .map(|table| JudgmentTable::Sorting(Imported { value: table.sorts, warnings: table.warnings }))
            .map_err(|error| error.to_string()),
        JudgmentKind::Ratings => {
            read_ratings(bytes).map(JudgmentTable::Ratings).map_err(|error| error.to_string())
        }
        JudgmentKind::Votes => {
            read_relevance_csv(bytes).map(JudgmentTable::Votes).map_err(|error| error.to_string())
        }
    }
}

/// What a file holds, by its columns. Almost any table may be a sorting with a column for each texture, votes with a
/// column for each adjective too, so that a name that says what it is goes first.
pub fn kind_of(name: &str, bytes: &[u8]) -> JudgmentKind {
    let name = name.to_lowercase();
    if ["vote", "relevan"].iter().any(|word| name.contains(word)) {
        JudgmentKind::Votes
    } else if read_ratings_csv(bytes).is_ok() || name.contains("rating") {
        JudgmentKind::Ratings
    } else if read_sorting_csv(bytes).is_ok() {
        JudgmentKind::Sorting
    } else if read_relevance_csv(bytes).is_ok() {
        JudgmentKind::Votes
    } else {
        JudgmentKind::Sorting
    }
}

/// Converts a rating from its scale to 0..100; a missing rating stays missing.
///
/// # Errors
/// The rating is not on the scale, in one sentence.
pub fn rescaled(rating: Rating, scale: Scale) -> Result<Rating, String> {
    let Some(value) = rating.value else { return Ok(rating) };
    if !scale.contains(value) {
        let Rating { participant, texture, pair, .. } = rating;
        return Err(format!(
            "{participant} rated {texture} {value} on {pair}, which is not on the stated scale; correct the rating or the scale"
        ));
    }
    Ok(Rating { value: Some(scale.to_space(value)), ..rating })
}

/// The source of judgments: simulated as soon as one participant is.
pub fn source_of<P: AsRef<str>>(mut participants: impl Iterator<Item = P>) -> LabelSource {
    if participants.any(|name| is_simulated(name.as_ref())) {
        LabelSource::SimulatedRaters
    } else {
        LabelSource::HumanRatings
    }
}

/// Simulated raters who sort and rate the textures that have a position.
///
/// # Errors
/// No texture has a position, in one sentence.
pub fn simulate(library: &Library, seed: u64) -> Result<SimulatedJudgments, String> {
    let SimulatedRaterLabels { pairs, ids, labels } =
        panel_labels(library).map_err(|error| error.to_string())?;
    let config = PanelConfig::usual(seed);
    // Few textures make few groups.
    let groups: Vec<usize> = USUAL_GROUPS.into_iter().filter(|n| *n <= ids.len()).collect();
    let sorts = simulated_sorts(&ids, &labels, &groups, &config).map_err(|error| error.to_string())?;
    let ratings = simulated_ratings(&ids, &labels, &pairs, &config).map_err(|error| error.to_string())?;
    Ok(SimulatedJudgments { sorts, ratings })
}

#[cfg(test)]
mod tests {
    use super::{JudgmentKind, kind_of, rescaled, simulate, source_of};
    use shagreen_core::people::ratings::Rating;
    use shagreen_core::space::LabelSource;
    use shagreen_formats::library::Library;
    use shagreen_formats::places_csv::Scale;
    use shagreen_formats::starter::starter_library;

    #[test]
    fn the_panel_sorts_and_rates_every_placed_texture() {
        let library = starter_library().unwrap();
        let n_textures = library.textures.len();
        let simulated = simulate(&library, 1).unwrap();
        assert_eq!(simulated.sorts.len(), 10 * 3);
        assert!(simulated.sorts.iter().all(|sort| sort.placements.len() == n_textures));
        assert!(simulated.sorts.iter().all(|sort| sort.participant.starts_with("simulated-")));
        assert_eq!(simulated.ratings.len(), 10 * n_textures * 5);
        assert_eq!(simulate(&library, 1).unwrap().ratings, simulated.ratings);
        assert_ne!(simulate(&library, 2).unwrap().ratings, simulated.ratings);
        assert!(simulate(&Library::default(), 1).is_err_and(|reason| reason.contains("position")));
    }

    #[test]
    fn a_file_is_known_by_its_columns() {
        let check = |name: &str, text: &str, expected: JudgmentKind| {
            assert_eq!(kind_of(name, text.as_bytes()), expected, "{text}");
        };
        check("a.csv", "participant,trial,groups,texture,group\np,1,3,cork,a\n", JudgmentKind::Sorting);
        check("a.csv", "participant,trial,cork,felt\np,1,a,b\n", JudgmentKind::Sorting);
        check("a.csv", "participant,texture,rough-smooth\np,cork,41\n", JudgmentKind::Ratings);
        check(
            "a.csv",
            "participant,texture,adjective,value\np,cork,rough-smooth,41\n",
            JudgmentKind::Ratings,
        );
        check("a.csv", "participant,adjective,relevant\np,rough,1\np,warm,0\n", JudgmentKind::Votes);
        check("votes.csv", "participant,rough,warm\np,1,0\n", JudgmentKind::Votes);
        check("ratings.csv", "participant,texture\np,cork\n", JudgmentKind::Ratings);
        check("a.csv", "nothing of it\n", JudgmentKind::Sorting);
    }

    #[test]
    fn ratings_are_converted_from_their_scale() {
        let rating = |value: Option<f64>| Rating {
            participant: "p1".to_owned(),
            texture: "cork".to_owned(),
            pair: "rough-smooth".parse().unwrap(),
            value,
        };
        let scale = Scale::new(1.0, 7.0).unwrap();
        let value = |of: Option<f64>| rescaled(rating(of), scale).map(|rating| rating.value);
        assert_eq!(
            [value(Some(1.0)), value(Some(4.0)), value(None)],
            [Ok(Some(0.0)), Ok(Some(50.0)), Ok(None)]
        );
        assert!(value(Some(8.0)).is_err_and(|reason| reason.contains("p1 rated cork 8")));
    }

    #[test]
    fn one_simulated_participant_makes_the_source_simulated() {
        assert_eq!(source_of(["p1", "simulated-01"].into_iter()), LabelSource::SimulatedRaters);
        assert_eq!(source_of(["p1", "p2"].into_iter()), LabelSource::HumanRatings);
    }
}
