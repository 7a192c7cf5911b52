//! Questionnaires: adjectives of published rating experiments, with the blank tables and the instructions for an
//! experiment.
//!
//! `assets/questionnaires` has one TOML file for each: `id`, `name`, `source` (the publication), `note` (what it does not
//! say), `adjectives` for a vote on their relevance, `pairs` to rate (the adjective at 0 first), and `further_pairs`, which a
//! vote can select too. [`Questionnaire::relevant_pairs`] selects pairs as published: those of whose adjectives at least
//! half of the votes find each one relevant.

use std::collections::BTreeSet;
use std::sync::OnceLock;

use serde::Deserialize;
use shagreen_core::maths::rng::{Random, derive_seed};
use shagreen_core::people::ratings::{AdjectivePair, PairNameError, RelevanceVote, VoteError, relevances};

use crate::named_table::write_table;
use crate::ratings_csv::{read_ratings_csv, read_relevance_csv};

/// Texts of the built-in questionnaires, in the order of lists and menus.
const TEXTS: [&str; 2] = [
    include_str!("../../../assets/questionnaires/vrst-2023.toml"),
    include_str!("../../../assets/questionnaires/authoring-2020.toml"),
];

/// Start of the instructions, by which a file of instructions is recognized.
const FIRST_WORDS: &str = "Questionnaire: ";

/// Number of participants of the experiment with the 25 adjectives, for tables without a stated number.
pub const USUAL_PARTICIPANTS: usize = 12;

/// Adjectives and adjective pairs of a rating experiment.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Questionnaire {
    /// Identifier on the command line.
    pub id: String,
    /// Name for display.
    pub name: String,
    /// Publication that the adjectives come from.
    pub source: String,
    /// What the publication does not state, or what was added to it.
    pub note: String,
    /// Adjectives for a vote on their relevance.
    pub adjectives: Vec<String>,
    /// Adjective pairs to rate, as published.
    pub pairs: Vec<AdjectivePair>,
    /// Other antonyms among the adjectives.
    pub further_pairs: Vec<AdjectivePair>,
}

/// Why text is not a questionnaire.
#[derive(Clone, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum QuestionnaireError {
    /// Not TOML, or a key is missing, unknown or of the wrong type.
    #[error("cannot read the questionnaire: {0}; correct the file")]
    Damaged(#[from] toml::de::Error),
    /// A name is not an adjective pair.
    #[error(transparent)]
    Pair(#[from] PairNameError),
    /// An adjective is listed twice.
    #[error("\"{adjective}\" is listed twice; remove one of the two")]
    Twice {
        /// The adjective.
        adjective: String,
    },
    /// A pair contains a word that is not among the adjectives.
    #[error("\"{adjective}\" of the pair {pair} is not among the adjectives; add it")]
    Stray {
        /// Name of the pair.
        pair: String,
        /// The word.
        adjective: String,
    },
    /// There are no pairs.
    #[error("the questionnaire has no adjective pair; add at least two")]
    NoPairs,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FileV1 {
    id: String,
    name: String,
    source: String,
    note: String,
    adjectives: Vec<String>,
    pairs: Vec<String>,
    further_pairs: Vec<String>,
}

/// Returns the built-in questionnaires.
///
/// # Errors
/// Fails only if the program file is damaged.
pub fn questionnaires() -> Result<&'static [Questionnaire], QuestionnaireError> {
    static ALL: OnceLock<Result<Vec<Questionnaire>, QuestionnaireError>> = OnceLock::new();
    let read = || TEXTS.into_iter().map(read_questionnaire).collect();
    ALL.get_or_init(read).as_ref().map(Vec::as_slice).map_err(Clone::clone)
}

/// Adjective pairs of the built-in questionnaires, published and further ones, each once.
pub fn known_pairs() -> Vec<AdjectivePair> {
    let mut pairs: Vec<AdjectivePair> = Vec::new();
    // A damaged program file has no questionnaires.
    for questionnaire in questionnaires().unwrap_or_default() {
        for pair in questionnaire.pairs.iter().chain(&questionnaire.further_pairs) {
            if !pairs.contains(pair) {
                pairs.push(pair.clone());
            }
        }
    }
    pairs
}

/// Whether a built-in questionnaire has this pair, with either adjective at 0.
pub fn is_known_pair(pair: &AdjectivePair) -> bool {
    let turned = AdjectivePair { low: pair.high.clone(), high: pair.low.clone() };
    known_pairs().iter().any(|known| is_same_pair(known, pair) || is_same_pair(known, &turned))
}

/// Whether two pairs have the same adjectives in the same order, whatever their case.
pub(crate) fn is_same_pair(one: &AdjectivePair, other: &AdjectivePair) -> bool {
    let is_same = |one: &str, other: &str| one.trim().eq_ignore_ascii_case(other.trim());
    is_same(&one.low, &other.low) && is_same(&one.high, &other.high)
}

/// Reads a questionnaire.
///
/// # Errors
/// See [`QuestionnaireError`].
pub fn read_questionnaire(text: &str) -> Result<Questionnaire, QuestionnaireError> {
    let FileV1 { id, name, source, note, adjectives, pairs, further_pairs } = toml::from_str(text)?;
    let mut known = BTreeSet::new();
    if let Some(twice) = adjectives.iter().find(|adjective| !known.insert(adjective.as_str())) {
        return Err(QuestionnaireError::Twice { adjective: twice.clone() });
    }
    let parsed = |names: &[String]| -> Result<Vec<AdjectivePair>, QuestionnaireError> {
        names.iter().map(|name| name.parse::<AdjectivePair>().map_err(QuestionnaireError::from)).collect()
    };
    let [pairs, further_pairs] = [parsed(&pairs)?, parsed(&further_pairs)?];
    if pairs.is_empty() {
        return Err(QuestionnaireError::NoPairs);
    }
    for pair in pairs.iter().chain(&further_pairs) {
        if let Some(stray) = [&pair.low, &pair.high].into_iter().find(|word| !known.contains(word.as_str())) {
            return Err(QuestionnaireError::Stray { pair: pair.name(), adjective: stray.clone() });
        }
    }
    drop(known);
    Ok(Questionnaire { id, name, source, note, adjectives, pairs, further_pairs })
}

impl Questionnaire {
    /// Returns the pairs of whose adjectives at least half of the votes find each one relevant: the published pairs first,
    /// then the further ones. An adjective without votes is not relevant.
    ///
    /// # Errors
    /// See [`VoteError`].
    pub fn relevant_pairs(&self, votes: &[RelevanceVote]) -> Result<Vec<AdjectivePair>, VoteError> {
        let relevances = relevances(votes)?;
        let is_kept = |word: &str| {
            relevances.iter().any(|of| of.kept && of.adjective.trim().eq_ignore_ascii_case(word.trim()))
        };
        let all = self.pairs.iter().chain(&self.further_pairs);
        Ok(all.filter(|pair| is_kept(&pair.low) && is_kept(&pair.high)).cloned().collect())
    }

    /// Returns the instructions for an experiment in which participants rate these pairs.
    pub fn instructions(&self, pairs: &[AdjectivePair]) -> String {
        let scale =
            |pair: &AdjectivePair| format!("  0 = extremely {}, 100 = extremely {}\n", pair.low, pair.high);
        let scales = pairs.iter().map(scale).collect::<Vec<_>>().concat();
        let Self { name, source, note, adjectives, .. } = self;
        format!(
            "{FIRST_WORDS}{name}
Adjectives from: {source}.
{note}

For the experimenter

1. Hide the samples from view, and mask the sound of the contact, for example with noise in headphones.
2. Give each participant the textures in the order of the rows with this participant's name. The order is random, and it differs between participants.
3. Let the participant stroke each texture with the same tool, as long and as often as they wish.
4. Enter each answer in the row of the participant and the texture. If there is no answer, leave the cell empty.
5. Use pseudonyms such as p01 in the tables, never the names of people.

For the participant: relevance of adjectives (table of votes)

Stroke the texture. For each adjective, decide whether it describes how the texture feels: 1 means yes, 0 means no.
The adjectives are: {}.

For the participant: ratings (table of ratings)

Stroke the texture. For each pair of adjectives, choose a number from 0 to 100 that describes how the texture feels.
The further the number is from 50, the more the adjective at this end applies. There are no right or wrong answers.

{scales}",
            adjectives.join(", ")
        )
    }
}

/// Returns a blank table of ratings: a row for each participant and texture, in a random order of the textures for each
/// participant, and an empty column for each pair. The same seed gives the same order.
pub fn blank_ratings(
    textures: &[&str],
    pairs: &[AdjectivePair],
    n_participants: usize,
    seed: u64,
) -> Vec<u8> {
    let columns: Vec<String> = pairs.iter().map(AdjectivePair::name).collect();
    blank("rates", textures, &columns, n_participants, seed)
}

/// Returns a blank table of votes on the relevance of adjectives: a row for each participant and texture, in a random order
/// of the textures for each participant, and an empty column for each adjective.
pub fn blank_votes(textures: &[&str], adjectives: &[String], n_participants: usize, seed: u64) -> Vec<u8> {
    blank("votes", textures, adjectives, n_participants, seed)
}

fn blank(what: &str, textures: &[&str], columns: &[String], n_participants: usize, seed: u64) -> Vec<u8> {
    let first = ["participant", "texture"].into_iter().map(str::to_owned).chain(columns.iter().cloned());
    let rows = (1..=n_participants).flat_map(|number| {
        let participant = format!("p{number:02}");
        let order = Random::new(derive_seed(seed, &format!("{participant} {what}"))).shuffled(textures.len());
        let row = move |texture: usize| -> Vec<String> {
            let names = [participant.clone(), textures[texture].to_owned()];
            names.into_iter().chain(columns.iter().map(|_| String::new())).collect()
        };
        order.into_iter().map(row)
    });
    write_table(std::iter::once(first.collect()).chain(rows))
}

/// Returns whether bytes are a table of ratings in which nothing is filled in.
pub fn is_blank_ratings(bytes: &[u8]) -> bool {
    read_ratings_csv(bytes).is_ok_and(|ratings| ratings.iter().all(|rating| rating.value.is_none()))
}

/// Returns whether bytes are a table of votes in which nothing is filled in.
pub fn is_blank_votes(bytes: &[u8]) -> bool {
    read_relevance_csv(bytes).is_ok_and(|votes| votes.is_empty())
}

/// Returns whether bytes are instructions from [`Questionnaire::instructions`].
pub fn is_instructions(bytes: &[u8]) -> bool {
    bytes.starts_with(FIRST_WORDS.as_bytes())
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use shagreen_core::people::ratings::{AdjectivePair, RelevanceVote};

    use super::{
        blank_ratings, blank_votes, is_blank_ratings, is_blank_votes, is_instructions, is_known_pair,
        known_pairs, questionnaires, read_questionnaire,
    };
    use crate::ratings_csv::{read_ratings, read_relevance_csv};

    fn names(pairs: &[AdjectivePair]) -> Vec<String> {
        pairs.iter().map(AdjectivePair::name).collect()
    }

    #[test]
    fn the_built_in_questionnaires_have_the_published_adjectives() {
        let [vrst, authoring] = questionnaires().unwrap() else { panic!("two are built in") };
        assert_eq!((vrst.id.as_str(), vrst.adjectives.len(), vrst.pairs.len()), ("vrst-2023", 25, 5));
        let expected = ["rough-smooth", "flat-bumpy", "sticky-slippery", "hard-soft", "irritating-pleasant"];
        assert_eq!(names(&vrst.pairs), expected);
        assert_eq!((authoring.id.as_str(), authoring.pairs.len()), ("authoring-2020", 4));
        assert!(names(&authoring.pairs).iter().all(|pair| expected.contains(&pair.as_str())));
    }

    #[test]
    fn pairs_are_known_in_either_order_and_listed_once() {
        let known = names(&known_pairs());
        assert_eq!(known.len(), 9);
        assert_eq!(known.iter().collect::<BTreeSet<_>>().len(), 9);
        let is_known = |name: &str| is_known_pair(&name.parse().unwrap());
        assert!(is_known("rough-smooth") && is_known("Smooth - Rough") && is_known("thick-thin"));
        assert!(!is_known("rogh-smooth") && !is_known("cold-warm") && !is_known("rough-soft"));
    }

    #[test]
    fn a_blank_table_has_every_texture_once_for_each_participant_in_a_random_order() {
        let [vrst, _] = questionnaires().unwrap() else { panic!("two are built in") };
        let textures = ["cork", "felt", "glass", "a, \"b\""];
        let table = blank_ratings(&textures, &vrst.pairs, 3, 1);
        assert!(is_blank_ratings(&table) && !is_blank_votes(b"nothing of it\n"));
        let read = read_ratings(&table).unwrap();
        assert_eq!((read.value.len(), read.warnings.len()), (3 * 4 * 5, 0));
        let cells: BTreeSet<(&str, &str, String)> = read
            .value
            .iter()
            .map(|rating| (rating.participant.as_str(), rating.texture.as_str(), rating.pair.name()))
            .collect();
        assert_eq!(cells.len(), 60, "no cell twice");
        let order = |participant: &str| -> Vec<String> {
            let of = read.value.iter().filter(|rating| rating.participant == participant);
            of.step_by(5).map(|rating| rating.texture.clone()).collect()
        };
        assert!(order("p01") != order("p02") || order("p02") != order("p03"));
        assert_eq!(table, blank_ratings(&textures, &vrst.pairs, 3, 1));
        // A table with an answer is not blank.
        let text = String::from_utf8(table).unwrap();
        assert!(!is_blank_ratings(text.replacen(",,,,,", ",,,41,,", 1).as_bytes()), "{text}");

        let votes = blank_votes(&textures, &vrst.adjectives, 2, 1);
        assert!(is_blank_votes(&votes));
        assert!(read_relevance_csv(&votes).unwrap().is_empty());
        assert!(String::from_utf8(votes).unwrap().starts_with("participant,texture,sticky,uneven,flat,"));
    }

    #[test]
    fn votes_select_the_pairs_of_relevant_adjectives() {
        let [vrst, _] = questionnaires().unwrap() else { panic!("two are built in") };
        let vote = |participant: &str, adjective: &str, relevant: bool| RelevanceVote {
            participant: participant.to_owned(),
            texture: None,
            adjective: adjective.to_owned(),
            relevant,
        };
        let mut votes: Vec<RelevanceVote> =
            ["Rough", "smooth", "hard", "thick", "thin"].map(|word| vote("a", word, true)).to_vec();
        votes.extend([vote("a", "soft", false), vote("b", "soft", false), vote("b", "thin", false)]);
        // Half of the votes find "thin" relevant, and nobody finds "soft" relevant.
        assert_eq!(names(&vrst.relevant_pairs(&votes).unwrap()), ["rough-smooth", "thick-thin"]);
        votes.push(vote("b", "thin", true));
        assert!(vrst.relevant_pairs(&votes).is_err(), "b voted twice");
    }

    #[test]
    fn the_instructions_state_the_scales_and_the_source() {
        for questionnaire in questionnaires().unwrap() {
            let text = questionnaire.instructions(&questionnaire.pairs);
            assert!(is_instructions(text.as_bytes()) && !is_instructions(b"my notes"));
            assert!(text.contains(&questionnaire.source) && text.contains(&questionnaire.note));
            assert!(text.contains("0 = extremely rough, 100 = extremely smooth"), "{text}");
            assert!(questionnaire.adjectives.iter().all(|adjective| text.contains(adjective.as_str())));
        }
    }

    #[test]
    fn files_that_make_no_sense_are_refused() {
        let frame = |adjectives: &str, pairs: &str| {
            let text = format!(
                "id = \"a\"\nname = \"b\"\nsource = \"c\"\nnote = \"\"\nadjectives = [{adjectives}]\npairs = [{pairs}]\nfurther_pairs = []\n"
            );
            read_questionnaire(&text).map(|_| ()).map_err(|error| error.to_string())
        };
        assert_eq!(frame("\"rough\", \"smooth\"", "\"rough-smooth\""), Ok(()));
        for (adjectives, pairs, words) in [
            ("\"rough\", \"rough\"", "", "\"rough\" is listed twice"),
            ("\"rough\"", "\"rough\"", "names only one pole"),
            ("\"rough\"", "\"rough-smooth\"", "\"smooth\" of the pair rough-smooth is not among"),
            ("\"rough\"", "", "no adjective pair"),
            ("3", "", "cannot read the questionnaire"),
        ] {
            let error = frame(adjectives, pairs).unwrap_err();
            assert!(error.contains(words), "{error}");
        }
    }
}
