//! Workspaces of the window, in the order of the workflow: one row each.
//!
//! A new workspace needs a module, its line in `lib.rs`, a row here, and its page in `window/pages.rs`.

use egui::Key;

/// Workspace of the window.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Workspace {
    /// Finds a texture in the space and plays it.
    #[default]
    Author,
    /// Builds a space from sorting and rating data.
    Build,
    /// Compares, compresses and edits signals.
    Signals,
    /// Runs experiments with people.
    Studies,
}

/// Description of a workspace.
#[derive(Clone, Copy, Debug)]
pub struct WorkspaceInfo {
    /// Name on its tab.
    pub name: &'static str,
    /// Tooltip of its tab.
    pub help: &'static str,
    /// Label of the command that shows it.
    pub show: &'static str,
    /// Key that shows it, together with Ctrl or Cmd.
    pub key: Key,
}

impl Workspace {
    /// All workspaces, in the order of their tabs.
    pub const ALL: [Self; 4] = [Self::Author, Self::Build, Self::Signals, Self::Studies];

    /// Returns the description of the workspace.
    pub const fn info(self) -> WorkspaceInfo {
        match self {
            Self::Author => WorkspaceInfo {
                name: "Author",
                help: "Choose a point of the space and feel its texture",
                show: "Show the Author workspace",
                key: Key::Num1,
            },
            Self::Build => WorkspaceInfo {
                name: "Build",
                help: "Build a space from sorting and rating data",
                show: "Show the Build workspace",
                key: Key::Num2,
            },
            Self::Signals => WorkspaceInfo {
                name: "Signals",
                help: "Compare, compress and edit signals",
                show: "Show the Signals workspace",
                key: Key::Num3,
            },
            Self::Studies => WorkspaceInfo {
                name: "Studies",
                help: "Run experiments with people and analyze them",
                show: "Show the Studies workspace",
                key: Key::Num4,
            },
        }
    }
}
