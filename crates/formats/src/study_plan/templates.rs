//! Built-in plans: one for each published experiment, and one for each further design.

use shagreen_core::people::study::plan::Plan;

/// A built-in plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StudyTemplate {
    /// Identifier on the command line.
    pub id: &'static str,
    /// The plan file with its comments, to be changed by its user.
    pub text: &'static str,
}

/// Sentence in the consent text of the built-in plans, which must not reach participants.
const PLACEHOLDER: &str = "Replace this text by the one that your ethics committee approved.";

macro_rules! template {
    ($id:literal) => {
        StudyTemplate { id: $id, text: include_str!(concat!("../../../../assets/studies/", $id, ".toml")) }
    };
}

/// The built-in plans, in the order of lists and menus.
const TEMPLATES: [StudyTemplate; 11] = [
    template!("cluster-sorting"),
    template!("adjective-relevance"),
    template!("bipolar-rating"),
    template!("authored-dissimilarity"),
    template!("same-different"),
    template!("gap-detection"),
    template!("reconstruction-similarity"),
    template!("text-to-texture"),
    template!("abx"),
    template!("mushra"),
    template!("anchor-rating"),
];

/// Returns the built-in plans.
pub fn study_templates() -> &'static [StudyTemplate] {
    &TEMPLATES
}

/// Returns the built-in plan with this identifier.
pub fn study_template(id: &str) -> Option<StudyTemplate> {
    TEMPLATES.into_iter().find(|template| template.id == id)
}

/// Whether the consent text of a plan still asks to be replaced.
pub fn has_placeholder_consent(plan: &Plan) -> bool {
    plan.consent.contains(PLACEHOLDER)
}
