//! Pages of the workspaces. The Author page belongs to the window itself, because it shows most of the window's state.

use egui::{Context, Ui};

use crate::build::page::BuildPage;
use crate::choices::signals::Slot;
use crate::command::Command;
use crate::command::signals::SignalsCommand;
use crate::command::studies::StudiesCommand;
use crate::panel::Panel;
use crate::sheets::DropTarget;
use crate::signals::page::SignalsPage;
use crate::state::compare::{CompareCommand, Side};
use crate::strings;
use crate::studies::page::StudiesPage;
use crate::window::author_page::AuthorPage;
use crate::window::stage::Stage;
use crate::workspace::Workspace;

/// Behavior of a workspace in a frame.
pub(super) trait Page {
    /// Takes in results of workers.
    fn collect(&mut self, ctx: &Context);

    /// Draws the page and returns the commands of the user.
    fn show(&mut self, ui: &mut Ui, panel: &Panel<'_>) -> Vec<Command>;

    /// Whether the pad and the scope are shown below the page.
    fn has_stage(&self) -> bool {
        false
    }

    /// Command that a shortcut gives on this page, or `None` if it has no effect here.
    fn accept(&self, command: Command) -> Option<Command> {
        Some(command)
    }

    /// Target of dropped files; `None` imports them.
    fn drop_target(&self) -> Option<DropTarget> {
        None
    }
}

/// Pages of the workspaces, and which one is visible.
#[derive(Default)]
pub(super) struct Pages {
    /// Visible workspace.
    pub(super) workspace: Workspace,
    pub(super) author: AuthorPage,
    /// Lower row of the pages that have one.
    pub(super) stage: Stage,
    pub(super) build: BuildPage,
    pub(super) signals: SignalsPage,
    pub(super) studies: StudiesPage,
}

impl Pages {
    /// Visible page, or `None` for Author.
    pub(super) fn current(&mut self) -> Option<&mut dyn Page> {
        self.page(self.workspace)
    }

    /// Page of a workspace, or `None` for Author.
    pub(super) fn page(&mut self, workspace: Workspace) -> Option<&mut dyn Page> {
        match workspace {
            Workspace::Author => None,
            Workspace::Build => Some(&mut self.build),
            Workspace::Signals => Some(&mut self.signals),
            Workspace::Studies => Some(&mut self.studies),
        }
    }

    pub(super) fn collect(&mut self, ctx: &Context) {
        for workspace in Workspace::ALL {
            if let Some(page) = self.page(workspace) {
                page.collect(ctx);
            }
        }
    }
}

impl Page for BuildPage {
    fn collect(&mut self, _: &Context) {
        Self::collect(self);
    }

    fn show(&mut self, ui: &mut Ui, panel: &Panel<'_>) -> Vec<Command> {
        Self::show(self, ui, panel)
    }

    fn drop_target(&self) -> Option<DropTarget> {
        Some(DropTarget {
            command: Command::ReadJudgments,
            takes_strokes: false,
            here: strings::build::DROP_HERE,
            kinds: strings::build::DROP_KINDS,
        })
    }
}

impl Page for SignalsPage {
    fn collect(&mut self, ctx: &Context) {
        Self::collect(self, ctx);
    }

    fn show(&mut self, ui: &mut Ui, panel: &Panel<'_>) -> Vec<Command> {
        Self::show(self, ui, panel)
    }

    fn has_stage(&self) -> bool {
        true
    }

    /// The shortcuts of sides A and B select the signal that plays under the pen.
    fn accept(&self, command: Command) -> Option<Command> {
        let Command::Compare(CompareCommand::Hear(side)) = command else { return Some(command) };
        let slot = match side {
            Side::A => Slot::A,
            Side::B => Slot::B,
            Side::X => return None,
        };
        Some(Command::Signals(SignalsCommand::Feel(Some(slot))))
    }

    fn drop_target(&self) -> Option<DropTarget> {
        Some(DropTarget {
            command: |sources| Command::Signals(SignalsCommand::ReadAll(sources)),
            takes_strokes: true,
            here: strings::signals::DROP_HERE,
            kinds: strings::signals::DROP_KINDS,
        })
    }
}

impl Page for StudiesPage {
    fn collect(&mut self, ctx: &Context) {
        Self::collect(self, ctx);
    }

    fn show(&mut self, ui: &mut Ui, panel: &Panel<'_>) -> Vec<Command> {
        Self::show(self, ui, panel)
    }

    fn drop_target(&self) -> Option<DropTarget> {
        Some(DropTarget {
            command: |sources| Command::Studies(StudiesCommand::Open(sources)),
            takes_strokes: false,
            here: strings::studies::DROP_HERE,
            kinds: strings::studies::DROP_KINDS,
        })
    }
}
