//! Trials: what a participant is presented with once, under blind labels.

use crate::people::study::plan::{Comparison, Design};

/// One question to a participant.
#[derive(Clone, Debug, PartialEq)]
pub struct Trial {
    /// Identifier of the part.
    pub part: String,
    /// Number within the part, from 1, practice included.
    pub number: usize,
    /// Whether the answer is not analyzed.
    pub is_practice: bool,
    /// Seed of the noise in the stimuli of this trial, up to 2⁶³ - 1.
    pub seed: u64,
    /// What is asked.
    pub task: Task,
}

/// What a trial asks. Stimuli are named by their identifiers in the plan.
#[derive(Clone, Debug, PartialEq)]
pub enum Task {
    /// Sort stimuli into groups.
    Sort {
        /// The stimuli, in the order of the screen.
        stimuli: Vec<String>,
        /// Number of groups to make.
        n_groups: usize,
    },
    /// Select the adjectives of the part that describe a stimulus.
    Vote {
        /// The stimulus.
        stimulus: String,
    },
    /// Rate a stimulus on the adjective pairs of the part.
    Rate {
        /// The stimulus.
        stimulus: String,
    },
    /// State a number for the dissimilarity of two stimuli.
    Compare {
        /// The stimuli.
        pair: Comparison,
        /// Whether the second one of the pair is presented first.
        is_swapped: bool,
    },
    /// Say whether two stimuli in succession are the same.
    Discriminate {
        /// The reference and its processed version.
        pair: Comparison,
        /// Whether the processed version comes second; otherwise the reference is repeated.
        is_different: bool,
        /// Segment of the signals, from 0.
        segment: usize,
    },
    /// Name the alternative that contains the target.
    Detect {
        /// Staircase of the part, from 0.
        track: usize,
        /// Level, in the unit of what the part varies.
        level: f64,
        /// Where the target is.
        target: Side,
        /// Whether the participant learns if the answer was right.
        has_feedback: bool,
    },
    /// Grade the similarity of two stimuli.
    Grade {
        /// The original and its reconstruction.
        pair: Comparison,
        /// Whether the second one of the pair has the first label.
        is_swapped: bool,
    },
    /// Grade the statements of the part under a condition.
    Question {
        /// Prompt, from 0.
        prompt: usize,
        /// Identifier of the condition.
        condition: String,
    },
    /// Name the stimulus that a third one equals.
    Match {
        /// The stimuli.
        pair: Comparison,
        /// Whether the second one of the pair is A.
        is_swapped: bool,
        /// Which of A (first) and B (second) the third one is.
        x: Side,
    },
    /// Rate stimuli beside their reference.
    Page {
        /// The reference.
        reference: String,
        /// What to rate, the hidden reference among it, in the order of the screen.
        stimuli: Vec<String>,
    },
    /// Place a stimulus between two anchors.
    Place {
        /// The stimulus.
        stimulus: String,
        /// Stimulus at 0.
        low: String,
        /// Stimulus at 100.
        high: String,
    },
}

/// One of two alternatives: the first or second interval, left or right, A or B.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// First interval, left side, or A.
    First,
    /// Second interval, right side, or B.
    Second,
}

impl Side {
    /// The second side if `is_second`, else the first.
    pub fn second_if(is_second: bool) -> Self {
        if is_second { Self::Second } else { Self::First }
    }
}

/// A stimulus with the label that participants see.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Shown {
    /// The label, which does not tell what the stimulus is; empty if there is one stimulus only.
    pub label: String,
    /// Identifier of the stimulus in the plan.
    pub stimulus: String,
}

/// Label of the stimulus at a position of the screen: `A` to `Z`, then `AA`, `AB` and so on.
pub fn blind_label(position: usize) -> String {
    let letter = char::from(b'A' + (position % 26) as u8);
    if position < 26 { letter.to_string() } else { format!("{}{letter}", blind_label(position / 26 - 1)) }
}

impl Task {
    /// Stimuli in the order in which they are presented, with their labels. A detection has none: its signals are made from its
    /// level and its seed. A question has none: its texture is made from a prompt.
    pub fn shown(&self) -> Vec<Shown> {
        let labeled =
            |label: &str, stimulus: &str| Shown { label: label.to_owned(), stimulus: stimulus.to_owned() };
        let two = |pair: &Comparison, is_swapped: bool| {
            let [first, second] = presented(pair, is_swapped);
            vec![labeled("A", first), labeled("B", second)]
        };
        let many = |stimuli: &[String]| -> Vec<Shown> {
            let with_label = |(position, id): (usize, &String)| labeled(&blind_label(position), id);
            stimuli.iter().enumerate().map(with_label).collect()
        };
        match self {
            Self::Sort { stimuli, .. } => many(stimuli),
            Self::Vote { stimulus } | Self::Rate { stimulus } => vec![labeled("", stimulus)],
            Self::Compare { pair, is_swapped } | Self::Grade { pair, is_swapped } => two(pair, *is_swapped),
            Self::Discriminate { pair, is_different, .. } => {
                let second = if *is_different { &pair.second } else { &pair.first };
                vec![labeled("A", &pair.first), labeled("B", second)]
            }
            Self::Match { pair, is_swapped, x } => {
                let sides = presented(pair, *is_swapped);
                let third = sides[usize::from(*x == Side::Second)];
                let mut shown = two(pair, *is_swapped);
                shown.push(labeled("X", third));
                shown
            }
            Self::Page { reference, stimuli } => {
                let mut shown = vec![labeled("Reference", reference)];
                shown.extend(many(stimuli));
                shown
            }
            Self::Place { stimulus, low, high } => {
                vec![labeled("Left", low), labeled("Right", high), labeled("A", stimulus)]
            }
            Self::Detect { .. } | Self::Question { .. } => Vec::new(),
        }
    }

    /// Whether this task belongs to a part with this design.
    pub fn fits(&self, design: &Design) -> bool {
        matches!(
            (self, design),
            (Self::Sort { .. }, Design::Sorting { .. })
                | (Self::Vote { .. }, Design::Relevance { .. })
                | (Self::Rate { .. }, Design::Rating { .. })
                | (Self::Compare { .. }, Design::Dissimilarity { .. })
                | (Self::Discriminate { .. }, Design::SameDifferent { .. })
                | (Self::Detect { .. }, Design::Staircase { .. })
                | (Self::Grade { .. }, Design::Similarity { .. })
                | (Self::Question { .. }, Design::Likert { .. })
                | (Self::Match { .. }, Design::Abx { .. })
                | (Self::Page { .. }, Design::Mushra { .. })
                | (Self::Place { .. }, Design::Anchors { .. })
        )
    }
}

/// The two stimuli of a pair in the order in which they are presented.
fn presented(pair: &Comparison, is_swapped: bool) -> [&str; 2] {
    let (first, second) = (pair.first.as_str(), pair.second.as_str());
    if is_swapped { [second, first] } else { [first, second] }
}

#[cfg(test)]
mod tests {
    use super::{Side, Task, blind_label};
    use crate::people::study::plan::Comparison;

    fn shown(task: &Task) -> Vec<String> {
        task.shown().into_iter().map(|shown| format!("{}:{}", shown.label, shown.stimulus)).collect()
    }

    #[test]
    fn labels_are_letters_like_the_columns_of_a_spreadsheet() {
        let labels = [0, 1, 25, 26, 27, 51, 52, 701, 702].map(blind_label);
        assert_eq!(labels, ["A", "B", "Z", "AA", "AB", "AZ", "BA", "ZZ", "AAA"]);
    }

    #[test]
    fn labels_do_not_tell_which_stimulus_is_the_reference() {
        let pair = Comparison::new("cork", "cork-low");
        let compare = |is_swapped| Task::Compare { pair: pair.clone(), is_swapped };
        assert_eq!(shown(&compare(false)), ["A:cork", "B:cork-low"]);
        assert_eq!(shown(&compare(true)), ["A:cork-low", "B:cork"]);
        let same = Task::Discriminate { pair: pair.clone(), is_different: false, segment: 0 };
        assert_eq!(shown(&same), ["A:cork", "B:cork"]);
        let matched = |is_swapped, x| Task::Match { pair: pair.clone(), is_swapped, x };
        assert_eq!(shown(&matched(true, Side::First)), ["A:cork-low", "B:cork", "X:cork-low"]);
        assert_eq!(shown(&matched(false, Side::second_if(true))), ["A:cork", "B:cork-low", "X:cork-low"]);
        let page =
            Task::Page { reference: "cork".to_owned(), stimuli: vec!["low".to_owned(), "cork".to_owned()] };
        assert_eq!(shown(&page), ["Reference:cork", "A:low", "B:cork"]);
        assert_eq!(shown(&Task::Rate { stimulus: "felt".to_owned() }), [":felt"]);
    }
}
