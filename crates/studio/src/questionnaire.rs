//! Files for a rating experiment with a questionnaire: blank tables and instructions.

use anyhow::{Context as _, bail};
use shagreen_core::people::ratings::AdjectivePair;
use shagreen_formats::questionnaire::{
    Questionnaire, blank_ratings, blank_votes, is_blank_ratings, is_blank_votes, is_instructions,
    questionnaires,
};

/// File for an experiment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ExperimentFile {
    /// Blank table of ratings on adjective pairs.
    Ratings,
    /// Blank table of votes on the relevance of adjectives.
    Votes,
    /// Instructions for experimenter and participants, as plain text.
    Instructions,
}

/// Participants of an experiment, and the order of the textures.
#[derive(Clone, Copy, Debug)]
pub struct Experiment<'a> {
    /// The questionnaire.
    pub questionnaire: &'a Questionnaire,
    /// Adjective pairs to rate.
    pub pairs: &'a [AdjectivePair],
    /// Identifiers of the textures.
    pub textures: &'a [&'a str],
    /// Number of participants.
    pub n_participants: usize,
    /// Seed of the order of the textures.
    pub seed: u64,
}

impl ExperimentFile {
    /// All files, in menu order.
    pub const ALL: [Self; 3] = [Self::Ratings, Self::Votes, Self::Instructions];

    /// Usual file name, without its ending.
    pub fn stem(self) -> &'static str {
        match self {
            Self::Ratings => "ratings",
            Self::Votes => "votes",
            Self::Instructions => "instructions",
        }
    }

    /// Ending of the file name.
    pub fn ending(self) -> &'static str {
        match self {
            Self::Ratings | Self::Votes => "csv",
            Self::Instructions => "txt",
        }
    }

    /// Content of the file.
    pub fn bytes(self, experiment: &Experiment<'_>) -> Vec<u8> {
        let Experiment { questionnaire, pairs, textures, n_participants, seed } = *experiment;
        match self {
            Self::Ratings => blank_ratings(textures, pairs, n_participants, seed),
            Self::Votes => blank_votes(textures, &questionnaire.adjectives, n_participants, seed),
            Self::Instructions => questionnaire.instructions(pairs).into_bytes(),
        }
    }

    /// Whether the file may replace one with these bytes: a table only if nothing is filled in.
    pub fn may_replace(self, bytes: &[u8]) -> bool {
        match self {
            Self::Ratings => is_blank_ratings(bytes),
            Self::Votes => is_blank_votes(bytes),
            Self::Instructions => is_instructions(bytes),
        }
    }
}

/// Returns the questionnaire with this id.
///
/// # Errors
/// There is none; the message lists the ids.
pub fn questionnaire(id: &str) -> anyhow::Result<&'static Questionnaire> {
    let all = questionnaires().context("reinstall the program")?;
    let Some(found) = all.iter().find(|questionnaire| questionnaire.id == id) else {
        let ids: Vec<&str> = all.iter().map(|questionnaire| questionnaire.id.as_str()).collect();
        bail!("there is no questionnaire \"{id}\"; choose {}", ids.join(" or "))
    };
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::{Experiment, ExperimentFile, questionnaire};

    /// A file replaces only its like, and a table only as long as it is blank.
    #[test]
    fn a_file_replaces_only_its_like() {
        let questionnaire = questionnaire("vrst-2023").unwrap();
        let experiment = Experiment {
            questionnaire,
            pairs: &questionnaire.pairs,
            textures: &["cork", "felt"],
            n_participants: 2,
            seed: 1,
        };
        let all = ExperimentFile::ALL.map(|file| file.bytes(&experiment));
        for (i, file) in ExperimentFile::ALL.into_iter().enumerate() {
            for (j, bytes) in all.iter().enumerate() {
                // A blank table of ratings also reads as a table of votes in which nobody voted.
                let is_like = i == j || (file, j) == (ExperimentFile::Votes, 0);
                assert_eq!(file.may_replace(bytes), is_like, "{file:?} over {j}");
            }
        }
        let filled = b"participant,texture,rough-smooth\np01,cork,41\n";
        assert!(!ExperimentFile::Ratings.may_replace(filled) && !ExperimentFile::Votes.may_replace(filled));
    }

    #[test]
    fn an_unknown_questionnaire_is_answered_with_the_known_ones() {
        let error = questionnaire("vrst").unwrap_err().to_string();
        assert!(error.contains("choose vrst-2023 or authoring-2020"), "{error}");
    }
}
