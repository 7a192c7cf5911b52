//! What a participant can do, by widgets, keys, or as a simulated one.

use super::draft::Entry;

/// Action of a participant, carried out after the frame.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Action {
    /// Agrees to the consent text, has read the instructions, or ends a break.
    GoOn,
    /// Does not agree to the consent text.
    Refuse,
    /// Starts a stimulus by its index, or stops it.
    Play(usize),
    /// Presents the stimuli that start by themselves again.
    Repeat,
    /// Starts or stops the automatic stroke.
    ToggleStroke,
    /// Selects an entry of a list for the keyboard.
    Select(usize),
    /// Enters a value.
    Enter(Entry),
    /// Writes the text of a question.
    Write(String),
    /// Makes the texture of this text.
    Describe,
    /// Moves the texture of a text along an axis of the space, by its index, to a coordinate from 0 to 100.
    Move(usize, f64),
    /// Gives the answer.
    Answer,
    /// Saves once more what could not be saved.
    TryAgain,
    /// Asks whether to leave the study.
    AskToLeave,
    /// Leaves the study.
    Leave,
    /// Goes on after the question.
    Stay,
}

/// Widget that takes values, so that keys can go on without it losing them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Field {
    Slider,
    Number,
    Check,
    Text,
}

/// What a view asks for, and its widgets that take values.
#[derive(Debug, Default)]
pub(super) struct Asked {
    pub(super) actions: Vec<Action>,
    pub(super) fields: Vec<(egui::Id, Field)>,
}

impl Asked {
    /// Adds an action.
    pub(super) fn ask(&mut self, action: Action) {
        self.actions.push(action);
    }

    /// Adds what a part of the view asks for.
    pub(super) fn merge(&mut self, other: Self) {
        self.actions.extend(other.actions);
        self.fields.extend(other.fields);
    }
}
