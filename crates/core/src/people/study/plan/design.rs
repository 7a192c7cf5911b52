//! Designs: what a part of a study asks.

use crate::people::ratings::AdjectivePair;
use crate::people::study::staircase::StaircaseRule;

/// What a part of a study asks, and about which stimuli. Stimuli are named by their identifiers.
#[derive(Clone, Debug, PartialEq)]
pub enum Design {
    /// Sorting of all stimuli into groups that feel similar, once for each number of groups.
    Sorting {
        /// Stimuli to sort.
        stimuli: Vec<String>,
        /// Numbers of groups, each 2 or more.
        groups: Vec<usize>,
    },
    /// Selection of the adjectives that describe a stimulus.
    Relevance {
        /// Stimuli, one a trial.
        stimuli: Vec<String>,
        /// Adjectives to choose from.
        adjectives: Vec<String>,
    },
    /// Ratings of a stimulus on sliders without marks, one for each adjective pair.
    Rating {
        /// Stimuli, one a trial.
        stimuli: Vec<String>,
        /// Adjective pairs, the adjective at 0 first.
        pairs: Vec<AdjectivePair>,
        /// Length of a slider on the screen, in mm.
        slider_mm: f64,
    },
    /// Dissimilarities of pairs by magnitude estimation without modulus: any number, 0 if the two feel the same.
    Dissimilarity {
        /// Pairs to compare; a stimulus may be compared with itself.
        pairs: Vec<Comparison>,
        /// The two most different stimuli: compared with each other and each with itself, for the ends of the realism score.
        reference: Option<Comparison>,
    },
    /// Whether two stimuli in succession are the same. Each pair yields a trial with both stimuli and one in which the first
    /// is repeated.
    SameDifferent {
        /// Pairs of a stimulus and its processed version.
        pairs: Vec<Comparison>,
        /// Number of segments of the signals, each of which is compared by itself.
        n_segments: usize,
    },
    /// Detection between two alternatives, at a level that follows from the answers.
    Staircase {
        /// What the level changes.
        varied: Varied,
        /// Levels and end.
        rule: StaircaseRule,
        /// Number of first reversals up to which participants learn whether they were right.
        feedback_reversals: usize,
    },
    /// Similarity of two stimuli between which participants switch, on a scale from 1.
    Similarity {
        /// Pairs of an original and its reconstruction.
        pairs: Vec<Comparison>,
        /// Highest grade.
        n_points: u32,
        /// Meaning of 1.
        low: String,
        /// Meaning of the highest grade.
        high: String,
    },
    /// Agreement with statements on a scale from 1, under several conditions.
    Likert {
        /// Conditions, each tried with each prompt.
        conditions: Vec<Condition>,
        /// Statements.
        statements: Vec<Statement>,
        /// Texts from which textures are made.
        prompts: Prompts,
        /// Highest grade.
        n_points: u32,
        /// Meaning of 1.
        low: String,
        /// Meaning of the highest grade.
        high: String,
    },
    /// Which of two stimuli a third one equals.
    Abx {
        /// Pairs of two stimuli.
        pairs: Vec<Comparison>,
    },
    /// Ratings of several processed versions beside their reference, with the reference hidden among them.
    Mushra {
        /// References with their versions, one a trial.
        pages: Vec<MushraPage>,
    },
    /// Position of a stimulus on the line between two anchors.
    Anchors {
        /// Stimuli, one a trial.
        stimuli: Vec<String>,
        /// Stimulus at 0.
        low: String,
        /// Stimulus at 100.
        high: String,
    },
}

/// Two stimuli that are compared.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Comparison {
    /// The reference or original, if one of them is.
    pub first: String,
    /// The other stimulus.
    pub second: String,
}

impl Comparison {
    /// Comparison of two stimuli.
    pub fn new(first: impl Into<String>, second: impl Into<String>) -> Self {
        Self { first: first.into(), second: second.into() }
    }

    /// Name in tables: both identifiers, separated by a bar.
    pub fn name(&self) -> String {
        format!("{}|{}", self.first, self.second)
    }
}

/// Quantity that a staircase changes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Varied {
    /// Width of gaps in a noisy profile, in mm. The alternative is noise of the same spectrum without gaps.
    Gap,
    /// Difference in level, in dB. The alternative is the stimulus at its own level.
    Level {
        /// The stimulus.
        stimulus: String,
    },
}

impl Varied {
    /// Unit of the level.
    pub fn unit(&self) -> &'static str {
        match self {
            Self::Gap => "mm",
            Self::Level { .. } => "dB",
        }
    }
}

/// Condition of a questionnaire: what participants see beside what they feel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Condition {
    /// Identifier in tables.
    pub id: String,
    /// Controls that participants see.
    pub shown: ShownControls,
}

/// What the screen shows while a texture made from a text is felt.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShownControls {
    /// Nothing: a blank surface.
    Nothing,
    /// The picture of the texture.
    Picture,
    /// The picture, and sliders for the attributes.
    PictureAndSliders,
}

/// Statement of a questionnaire.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Statement {
    /// Identifier in tables.
    pub id: String,
    /// Sentence that participants read.
    pub text: String,
}

/// Texts from which textures are made.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Prompts {
    /// This number of texts of the participant's own.
    Own(usize),
    /// The same texts for all participants.
    Given(Vec<String>),
}

impl Prompts {
    /// Number of texts.
    pub fn n_texts(&self) -> usize {
        match self {
            Self::Own(n) => *n,
            Self::Given(texts) => texts.len(),
        }
    }
}

/// Page of ratings beside a reference (after ITU-R BS.1534).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MushraPage {
    /// The reference; participants also rate it without knowing it.
    pub reference: String,
    /// Versions to rate.
    pub tested: Vec<String>,
    /// Versions of known low quality, which keep the scale comparable.
    pub anchors: Vec<String>,
}

impl Design {
    /// Identifiers of all designs, in the order of lists.
    pub const IDS: [&'static str; 11] = [
        "sorting",
        "relevance",
        "rating",
        "dissimilarity",
        "same-different",
        "staircase",
        "similarity",
        "likert",
        "abx",
        "mushra",
        "anchors",
    ];

    /// Identifier in plans and tables.
    pub fn id(&self) -> &'static str {
        match self {
            Self::Sorting { .. } => "sorting",
            Self::Relevance { .. } => "relevance",
            Self::Rating { .. } => "rating",
            Self::Dissimilarity { .. } => "dissimilarity",
            Self::SameDifferent { .. } => "same-different",
            Self::Staircase { .. } => "staircase",
            Self::Similarity { .. } => "similarity",
            Self::Likert { .. } => "likert",
            Self::Abx { .. } => "abx",
            Self::Mushra { .. } => "mushra",
            Self::Anchors { .. } => "anchors",
        }
    }

    /// Number of trials of one repeat; `None` for a staircase, whose number depends on the answers.
    pub fn n_trials(&self) -> Option<usize> {
        Some(match self {
            Self::Sorting { groups, .. } => groups.len(),
            Self::Relevance { stimuli, .. }
            | Self::Rating { stimuli, .. }
            | Self::Anchors { stimuli, .. } => stimuli.len(),
            Self::Dissimilarity { pairs, reference } => pairs.len() + 3 * usize::from(reference.is_some()),
            Self::SameDifferent { pairs, n_segments } => {
                pairs.len().saturating_mul(*n_segments).saturating_mul(2)
            }
            Self::Similarity { pairs, .. } | Self::Abx { pairs } => pairs.len(),
            Self::Likert { conditions, prompts, .. } => conditions.len().saturating_mul(prompts.n_texts()),
            Self::Mushra { pages } => pages.len(),
            Self::Staircase { .. } => return None,
        })
    }

    /// All comparisons of a design of pairs, references last; none for other designs.
    pub fn comparisons(&self) -> Vec<Comparison> {
        match self {
            Self::Dissimilarity { pairs, reference } => {
                let ends = reference.iter().flat_map(|Comparison { first, second }| {
                    [(first, second), (first, first), (second, second)]
                });
                let ends = ends.map(|(one, other)| Comparison::new(one.as_str(), other.as_str()));
                pairs.iter().cloned().chain(ends).collect()
            }
            Self::SameDifferent { pairs, .. } | Self::Similarity { pairs, .. } | Self::Abx { pairs } => {
                pairs.clone()
            }
            Self::Sorting { .. }
            | Self::Relevance { .. }
            | Self::Rating { .. }
            | Self::Staircase { .. }
            | Self::Likert { .. }
            | Self::Mushra { .. }
            | Self::Anchors { .. } => Vec::new(),
        }
    }
}
