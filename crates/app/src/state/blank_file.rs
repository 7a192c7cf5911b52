//! Blank table or instructions of a questionnaire, to be saved for an experiment.

use std::sync::Arc;

use shagreen_formats::library::TextureEntry;
use shagreen_formats::questionnaire::{Questionnaire, USUAL_PARTICIPANTS};
use shagreen_studio::questionnaire::{Experiment, ExperimentFile};

use crate::strings::build as strings;

/// Seed of the order of the textures.
const SEED: u64 = 1;

/// File for an experiment with the textures of the open library.
#[derive(Clone, Debug)]
pub struct BlankFile {
    kind: ExperimentFile,
    bytes: Arc<[u8]>,
    about: String,
}

impl BlankFile {
    /// File of a questionnaire for the usual number of participants and these textures.
    pub(crate) fn new(
        kind: ExperimentFile,
        questionnaire: &Questionnaire,
        textures: &[TextureEntry],
    ) -> Self {
        let ids: Vec<&str> = textures.iter().map(|texture| texture.id.as_str()).collect();
        let experiment = Experiment {
            questionnaire,
            pairs: &questionnaire.pairs,
            textures: &ids,
            n_participants: USUAL_PARTICIPANTS,
            seed: SEED,
        };
        Self {
            kind,
            bytes: kind.bytes(&experiment).into(),
            about: strings::to_save_blank(kind, &questionnaire.name, ids.len()),
        }
    }

    /// File name with its ending.
    pub(crate) fn file_name(&self) -> String {
        format!("{}.{}", self.kind.stem(), self.kind.ending())
    }

    /// Ending of the file name.
    pub(crate) fn ending(&self) -> &'static str {
        self.kind.ending()
    }

    /// What the file contains, in a sentence.
    pub(crate) fn about(&self) -> &str {
        &self.about
    }

    pub(crate) fn bytes(&self) -> Vec<u8> {
        self.bytes.to_vec()
    }

    /// Whether the file may replace one with these bytes: a table only if nothing is filled in.
    pub(crate) fn may_replace(&self, bytes: &[u8]) -> bool {
        self.kind.may_replace(bytes)
    }
}
