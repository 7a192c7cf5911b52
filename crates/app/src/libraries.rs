//! The libraries that are built into the program: either can be open instead of the one that the window started with.

use anyhow::Context as _;
use shagreen_formats::library::Library;
use shagreen_formats::starter::{simulated_library, starter_library};

use crate::strings;

/// A library of the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BuiltIn {
    /// Everyday materials, placed by physical labels.
    Starter,
    /// The same materials, placed as a simulated panel sorted and rated them.
    Simulated,
}

impl BuiltIn {
    /// All of them, in the order of the menu.
    pub const ALL: [Self; 2] = [Self::Starter, Self::Simulated];

    /// Its name in the menu.
    pub fn name(self) -> &'static str {
        match self {
            Self::Starter => strings::STARTER,
            Self::Simulated => strings::SIMULATED,
        }
    }

    /// What it is, and whom its places come from.
    pub fn help(self) -> &'static str {
        match self {
            Self::Starter => strings::STARTER_HELP,
            Self::Simulated => strings::SIMULATED_HELP,
        }
    }

    /// What opening it is called in the history.
    pub fn edit_label(self) -> &'static str {
        match self {
            Self::Starter => "Open starter library",
            Self::Simulated => "Open simulated library",
        }
    }

    /// The library itself; reading it takes some milliseconds.
    ///
    /// # Errors
    /// The program is damaged.
    pub fn read(self) -> anyhow::Result<Library> {
        match self {
            Self::Starter => starter_library().context(strings::DAMAGED_LIBRARY),
            Self::Simulated => simulated_library().context(strings::DAMAGED_LIBRARY),
        }
    }

    /// Which of them a library is, where it is one; `library` is as its file has it.
    pub fn of(library: &Library) -> Option<Self> {
        // What cannot be read is not this one.
        Self::ALL.into_iter().find(|each| each.read().is_ok_and(|read| read == *library))
    }
}

#[cfg(test)]
mod tests {
    use super::BuiltIn;
    use shagreen_formats::library::Library;

    #[test]
    fn each_is_told_from_the_other_and_from_what_was_changed() {
        for each in BuiltIn::ALL {
            let mut library = each.read().unwrap();
            assert_eq!(BuiltIn::of(&library), Some(each));
            library.textures[3].name.push('!');
            assert_eq!(BuiltIn::of(&library), None);
        }
        assert_eq!(BuiltIn::of(&Library::default()), None);
    }
}
