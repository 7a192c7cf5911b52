//! The libraries that are built into the program, by name.

use crate::library::Library;
use crate::starter::{SimulatedLibraryError, simulated_library, starter_library};

/// A library of the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BuiltIn {
    /// Everyday materials, placed by physical labels.
    Starter,
    /// The same materials, placed as a simulated panel sorted and rated them.
    Simulated,
}

impl BuiltIn {
    /// All of them, in the order of menus.
    pub const ALL: [Self; 2] = [Self::Starter, Self::Simulated];

    /// The word that stands for it in files and on the command line.
    pub fn id(self) -> &'static str {
        match self {
            Self::Starter => "starter",
            Self::Simulated => "simulated",
        }
    }

    /// The library that has this [`BuiltIn::id`].
    pub fn from_id(id: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|each| each.id() == id)
    }

    /// The library itself; reading it takes some milliseconds.
    ///
    /// # Errors
    /// The program is damaged.
    pub fn read(self) -> Result<Library, SimulatedLibraryError> {
        match self {
            Self::Starter => Ok(starter_library()?),
            Self::Simulated => simulated_library(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::BuiltIn;

    #[test]
    fn each_is_found_by_its_word() {
        for each in BuiltIn::ALL {
            assert_eq!(BuiltIn::from_id(each.id()), Some(each));
            assert!(!each.read().unwrap().textures.is_empty());
        }
        assert_eq!(BuiltIn::from_id("other"), None);
    }
}
