//! The texture libraries built into the program, by name.

use crate::library::Library;
use crate::starter::{SimulatedLibraryError, simulated_library, starter_library};

/// A built-in texture library.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BuiltIn {
    /// Everyday materials, positioned by physical labels.
    Starter,
    /// The same materials, positioned by the sorting and rating of simulated raters.
    Simulated,
}

impl BuiltIn {
    /// All built-in libraries, in menu order.
    pub const ALL: [Self; 2] = [Self::Starter, Self::Simulated];

    /// The identifier in files and on the command line.
    pub fn id(self) -> &'static str {
        match self {
            Self::Starter => "starter",
            Self::Simulated => "simulated",
        }
    }

    /// Returns the library with this [`BuiltIn::id`].
    pub fn from_id(id: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|each| each.id() == id)
    }

    /// Reads the library, which takes some milliseconds.
    ///
    /// # Errors
    /// Fails only if the program file is damaged.
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
