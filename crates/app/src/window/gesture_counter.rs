//! Number of the present gesture. All edits of one gesture are undone together.

use crate::state::history::Gesture;

/// Counts gestures. A gesture lasts while a button or key is held or a text field has the focus, and one frame longer.
#[derive(Default)]
pub(super) struct GestureCounter {
    number: u64,
    /// Whether a gesture lasted in the last frame.
    pub(super) was_holding: bool,
    /// Widget with the keyboard focus in the last frame.
    focused: Option<egui::Id>,
}

impl GestureCounter {
    /// Counts the gesture that begins in this frame, if any. Called once a frame.
    pub(super) fn follow(&mut self, ctx: &egui::Context) {
        let focused = ctx.memory(egui::Memory::focused);
        // Typing in one text field is one gesture, regardless of the number of keys.
        let is_writing = focused == self.focused && ctx.text_edit_focused();
        self.focused = focused;
        let holding = is_writing || ctx.input(|i| i.pointer.any_down() || !i.keys_down.is_empty());
        if !holding && !self.was_holding {
            self.number += 1;
        }
        self.was_holding = holding;
    }

    /// Begins another gesture, although a text field may keep the focus: the result of a job is a step of its own.
    pub(super) fn begin_another(&mut self) {
        self.number += 1;
    }

    /// Present gesture.
    pub(super) fn current(&self) -> Gesture {
        Gesture(self.number)
    }
}
