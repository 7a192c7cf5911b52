//! Execution of commands about the axes of the space.

use egui::Context;

use super::Window;
use crate::command::Command;
use crate::command::axes::AxesCommand;
use crate::look::notice::show_notice;
use crate::sheets::Sheet;
use crate::sheets::axes_sheet::AxesSheet;
use crate::state::axes_change::AxesChange;
use crate::state::edit::Edit;
use crate::strings::axes as strings;
use crate::workspace::Workspace;

impl Window {
    /// Executes a command about axes.
    pub(super) fn carry_out_axes(&mut self, command: AxesCommand, ctx: &Context) {
        match command {
            AxesCommand::Open => {
                let sheet = AxesSheet::new(self.session.library(), self.session.axes(), ctx);
                self.sheet = Sheet::Axes(Box::new(sheet));
            }
            AxesCommand::Use(axes) => self.use_axes(&axes, ctx),
            AxesCommand::Swap => {
                let mut axes = self.session.axes().to_vec();
                if axes.len() < 2 {
                    return self.session.say(strings::NOTHING_TO_SWAP.to_owned());
                }
                axes.swap(0, 1);
                self.use_axes(&axes, ctx);
            }
            AxesCommand::Reset(axis) => {
                let at = self.session.at_local_mean(self.project.texture().at, axis);
                self.gesture.begin_another();
                self.carry_out(Command::Edit(Edit::MovePoint(at)), ctx);
            }
        }
    }

    /// Chooses axes and moves all points to them, in one step.
    fn use_axes(&mut self, axes: &[String], ctx: &Context) {
        // What changes must be visible.
        self.pages.workspace = Workspace::Author;
        if self.session.axes() == axes {
            return;
        }
        let change = AxesChange::new(&self.project, self.session.library(), &self.session.positions(), axes);
        let former = self.session.axes();
        let dropped: Vec<String> = former.iter().filter(|name| !axes.contains(name)).cloned().collect();
        self.gesture.begin_another();
        self.carry_out(Command::Edit(Edit::SetAxes(Box::new(change))), ctx);
        let keys = Command::Undo.shortcut_text(ctx);
        show_notice(ctx, strings::chosen(self.project.n_axes(), &dropped, &keys));
    }
}
