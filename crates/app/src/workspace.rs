//! The workspaces of the window, in the order of the work.

use crate::strings;

/// A workspace.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Workspace {
    /// A texture is found in the space and felt.
    #[default]
    Author,
    /// A space is made of what people sorted and rated.
    Build,
    /// Signals are compared, compressed and painted.
    Signals,
}

impl Workspace {
    /// All workspaces, in the order of their tabs.
    pub const ALL: [Self; 3] = [Self::Author, Self::Build, Self::Signals];

    /// Name on its tab.
    pub fn name(self) -> &'static str {
        match self {
            Self::Author => strings::AUTHOR,
            Self::Build => strings::BUILD,
            Self::Signals => strings::signals::SIGNALS,
        }
    }

    /// What it is for.
    pub fn help(self) -> &'static str {
        match self {
            Self::Author => strings::AUTHOR_HELP,
            Self::Build => strings::BUILD_HELP,
            Self::Signals => strings::signals::SIGNALS_HELP,
        }
    }
}
