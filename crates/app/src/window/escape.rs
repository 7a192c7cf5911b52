//! Escape: reverts the present drag, leaves the path tool, ends the comparison, or leaves the texture that plays alone.

use egui::{Context, Key, Modifiers, Popup};

use super::Window;
use crate::command::{Command, was_writing};
use crate::panel::Panel;
use crate::state::compare::CompareCommand;
use crate::state::edit::Edit;
use crate::workspace::Workspace;

impl Window {
    /// Command of Escape, if it was pressed and nothing else uses it. Called before the shortcuts of the frame.
    pub(super) fn escaped(&self, ctx: &Context) -> Option<Command> {
        // A popup and a text field are left by the same key, a drag is reverted by it.
        let is_used = self.sheet.is_open()
            || self.tour.is_on()
            || Popup::is_any_open(ctx)
            || was_writing(ctx)
            || ctx.input(|i| i.pointer.any_down());
        if is_used || self.pages.workspace != Workspace::Author {
            return None;
        }
        let panel = Panel::new(&self.project, &self.session, &self.compare, &self.pictures);
        let plays_alone = panel.solo().is_some();
        let command = if self.pages.author.canvas.tool.is_on {
            Command::TogglePathTool
        } else if let Some(side) = self.compare.heard() {
            // To hear the audible side once more ends the comparison.
            Command::Compare(CompareCommand::Hear(side))
        } else if plays_alone {
            Command::Edit(Edit::Solo(None))
        } else {
            return None;
        };
        ctx.input_mut(|i| i.consume_key(Modifiers::NONE, Key::Escape)).then_some(command)
    }

    /// Reverts the present drag if Escape was pressed, and removes what it asks for in this frame from `commands`.
    pub(super) fn revert_escaped_drag(&mut self, commands: &mut Vec<Command>, ctx: &Context) {
        if self.sheet.is_open() || !ctx.input(|i| i.pointer.primary_down() && i.key_pressed(Key::Escape)) {
            return;
        }
        commands.retain(|command| !matches!(command, Command::Edit(edit) if edit.is_dragged()));
        self.history.abandon_drag(&mut self.project, self.gesture.current());
    }
}
