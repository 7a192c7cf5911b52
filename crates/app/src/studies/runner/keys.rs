//! Keys of the runner: every action without a pointer.
//!
//! Letters start the stimulus of this label, Space starts and stops the automatic stroke, digits and arrows enter values, Enter
//! goes on, Escape asks whether to leave. Keys that a widget with the keyboard focus needs itself stay with it. Enter agrees to
//! the consent text only while the button for it has the keyboard focus.

use egui::{Context, Id, Key, Memory, Modifiers};
use shagreen_core::people::study::plan::Design;
use shagreen_core::people::study::trial::{Side, Task};

use super::actions::{Action, Field};
use super::draft::{Draft, Entry};
use super::text_texture::TextTexture;
use super::trial_state::TrialState;
use super::{Runner, Screen};

/// The keys 1 to 9.
const DIGITS: [Key; 9] =
    [Key::Num1, Key::Num2, Key::Num3, Key::Num4, Key::Num5, Key::Num6, Key::Num7, Key::Num8, Key::Num9];

/// Key of the automatic stroke where a check box takes the Space key, unless a stimulus has this label.
const STROKE: Key = Key::S;

/// What has the keyboard focus.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Focus {
    Nothing,
    /// A widget that takes values.
    Field(Field),
    /// Another widget, which acts on Space and Enter.
    Other,
}

/// Kind of a key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Letter,
    Digit,
    Arrow,
    Space,
    Enter,
}

impl Focus {
    /// Whether the runner may take a key of this kind, because no widget needs it. Arrows move the focus.
    fn leaves(self, kind: Kind) -> bool {
        match (self, kind) {
            (Self::Nothing, _) => true,
            (Self::Field(Field::Text), kind) => kind == Kind::Enter,
            (_, Kind::Arrow)
            | (Self::Other, Kind::Space | Kind::Enter)
            | (Self::Field(Field::Check), Kind::Space)
            | (Self::Field(Field::Number), Kind::Digit) => false,
            _ => true,
        }
    }
}

impl Runner {
    /// Actions of the keys that were pressed, before the widgets of the frame see them.
    pub(super) fn pressed(&self, ctx: &Context) -> Vec<Action> {
        let taken = |key: Key| ctx.input_mut(|i| i.consume_key(Modifiers::NONE, key));
        if taken(Key::Escape) {
            return vec![if self.is_asked_to_leave { Action::Stay } else { Action::AskToLeave }];
        }
        let field_of = |id: Id| {
            let field = self.fields.iter().find(|(field, _)| *field == id);
            field.map_or(Focus::Other, |(_, field)| Focus::Field(*field))
        };
        let focus = ctx.memory(Memory::focused).map_or(Focus::Nothing, field_of);
        let is_entered = || focus.leaves(Kind::Enter) && taken(Key::Enter);
        // The buttons of a question are reached by the Tab key.
        if self.is_asked_to_leave {
            return Vec::new();
        }
        if self.unsaved.is_some() {
            return if is_entered() { vec![Action::TryAgain] } else { Vec::new() };
        }
        match &self.screen {
            Screen::Trial(state) => trial_keys(ctx, state, focus),
            Screen::Instructions | Screen::PracticeOver | Screen::Break if is_entered() => vec![Action::GoOn],
            Screen::Done | Screen::Refused if is_entered() => vec![Action::Leave],
            _ => Vec::new(),
        }
    }
}

fn trial_keys(ctx: &Context, state: &TrialState, focus: Focus) -> Vec<Action> {
    let taken = |key: Key| ctx.input_mut(|i| i.consume_key(Modifiers::NONE, key));
    let mut actions = Vec::new();
    if focus.leaves(Kind::Space) && taken(Key::Space) {
        actions.push(Action::ToggleStroke);
    }
    if focus.leaves(Kind::Letter) {
        let is_pressed = |key: Key| ctx.input(|i| i.key_pressed(key) && i.modifiers.is_none());
        let mut of_labels = state
            .shown
            .iter()
            .enumerate()
            .filter_map(|(index, shown)| Some((index, label_key(&shown.label)?)));
        // The letter stays for a field, which leaves it out.
        if let Some((index, _)) = of_labels.clone().find(|(_, key)| is_pressed(*key)) {
            actions.push(Action::Play(index));
        }
        if !of_labels.any(|(_, key)| key == STROKE) && is_pressed(STROKE) {
            actions.push(Action::ToggleStroke);
        }
        if state.presenter.can_repeat() && is_pressed(Key::R) {
            actions.push(Action::Repeat);
        }
    }
    if focus.leaves(Kind::Digit) {
        for (digit, key) in (1..).zip(DIGITS) {
            if ctx.input(|i| i.key_pressed(key) && i.modifiers.is_none()) {
                actions.extend(digit_actions(state, digit));
            }
        }
        let is_out = |key| ctx.input(|i| i.key_pressed(key) && i.modifiers.is_none());
        if matches!(state.draft, Draft::Groups(..))
            && [Key::Num0, Key::Delete, Key::Backspace].into_iter().any(is_out)
        {
            actions.push(Action::Enter(Entry::Group(state.selected, None)));
        }
    }
    if focus.leaves(Kind::Arrow) {
        actions.extend(arrow_actions(ctx, state));
    }
    if focus.leaves(Kind::Enter) && taken(Key::Enter) {
        let is_writing = state.text.as_ref().is_some_and(TextTexture::is_writing);
        actions.push(if is_writing { Action::Describe } else { Action::Answer });
    }
    actions
}

/// Key that starts a stimulus: the first letter of its label, if that is all or a word.
fn label_key(label: &str) -> Option<Key> {
    let first = label.get(..1)?;
    let is_word = label.chars().skip(1).all(char::is_lowercase);
    if is_word { Key::from_name(&first.to_uppercase()) } else { None }
}

/// What a digit from 1 means in a trial.
fn digit_actions(state: &TrialState, digit: u32) -> Vec<Action> {
    let enter = |entry| vec![Action::Enter(entry)];
    match (&state.draft, &state.trial.task) {
        (Draft::Groups(_, n_groups), _) if digit as usize <= *n_groups => {
            enter(Entry::Group(state.selected, Some(digit as usize - 1)))
        }
        (Draft::IsDifferent(_), _) if digit <= 2 => enter(Entry::IsDifferent(digit == 2)),
        (Draft::Side(_), Task::Detect { .. } | Task::Match { .. }) if digit <= 2 => {
            enter(Entry::Side(Side::second_if(digit == 2)))
        }
        (Draft::Grade(_), _) if digit <= n_points(&state.part.design) => enter(Entry::Grade(0, digit)),
        (Draft::Grades(grades), _) if digit <= n_points(&state.part.design) => {
            let next = (state.selected + 1).min(grades.len().saturating_sub(1));
            vec![Action::Enter(Entry::Grade(state.selected, digit)), Action::Select(next)]
        }
        _ => Vec::new(),
    }
}

/// What the arrow keys mean in a trial: another entry of a list.
fn arrow_actions(ctx: &Context, state: &TrialState) -> Vec<Action> {
    let presses = |key: Key| ctx.input(|i| i.num_presses(key)).cast_signed();
    let (n, is_playing) = match &state.draft {
        Draft::Groups(groups, _) => (groups.len(), true),
        Draft::Grades(grades) => (grades.len(), false),
        _ => return Vec::new(),
    };
    let steps =
        presses(Key::ArrowDown) + presses(Key::ArrowRight) - presses(Key::ArrowUp) - presses(Key::ArrowLeft);
    if steps == 0 || n == 0 {
        return Vec::new();
    }
    let selected = state.selected.saturating_add_signed(steps).min(n - 1);
    // A selected stimulus can be felt at once, unless this would use up its plays.
    let plays = is_playing
        && selected != state.selected
        && state.presenter.n_plays_left(selected).is_none()
        && state.presenter.playing() != Some(selected);
    vec![if plays { Action::Play(selected) } else { Action::Select(selected) }]
}

/// Highest grade of a design.
fn n_points(design: &Design) -> u32 {
    match design {
        Design::Similarity { n_points, .. } | Design::Likert { n_points, .. } => *n_points,
        _ => 0,
    }
}

#[cfg(test)]
mod tests {
    use egui::Key;

    use super::{Field, Focus, Kind, label_key};

    #[test]
    fn labels_are_played_by_their_letter() {
        for (label, key) in [
            ("A", Some(Key::A)),
            ("X", Some(Key::X)),
            ("Reference", Some(Key::R)),
            ("Left", Some(Key::L)),
            ("AB", None),
            ("", None),
        ] {
            assert_eq!(label_key(label), key, "{label}");
        }
    }

    #[test]
    fn a_widget_with_the_focus_keeps_the_keys_that_it_needs() {
        let all = [Kind::Letter, Kind::Digit, Kind::Arrow, Kind::Space, Kind::Enter];
        let left =
            |focus: Focus| -> Vec<Kind> { all.into_iter().filter(|kind| focus.leaves(*kind)).collect() };
        assert_eq!(left(Focus::Nothing), all);
        assert_eq!(left(Focus::Other), [Kind::Letter, Kind::Digit]);
        assert_eq!(left(Focus::Field(Field::Text)), [Kind::Enter]);
        assert_eq!(left(Focus::Field(Field::Check)), [Kind::Letter, Kind::Digit, Kind::Enter]);
        assert_eq!(left(Focus::Field(Field::Number)), [Kind::Letter, Kind::Space, Kind::Enter]);
        let of_slider = [Kind::Letter, Kind::Digit, Kind::Space, Kind::Enter];
        assert_eq!(left(Focus::Field(Field::Slider)), of_slider);
    }
}
