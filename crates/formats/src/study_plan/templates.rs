//! Built-in plans: one for each published experiment, and one for each further design.

/// A built-in plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StudyTemplate {
    /// Identifier on the command line.
    pub id: &'static str,
    /// The plan file with its comments, to be changed by its user.
    pub text: &'static str,
}

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
