//! Why bytes are not a project.

use std::io;
use std::path::PathBuf;

use shagreen_core::space::SpacePointError;

use crate::library::LibraryError;
use crate::project::{FORMAT, VERSION_MAJOR, VERSION_MINOR};

/// Why bytes are not a project.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ProjectError {
    /// Not JSON, cut off, or a field is missing or of the wrong kind.
    #[error("the project is damaged: {reason}; restore it from a copy")]
    Damaged {
        /// What the parser says, with line and column.
        reason: String,
    },
    /// The file is JSON but of another kind.
    #[error("this is not a project: `format` is {found}, not \"{FORMAT}\"; choose another file")]
    Format {
        /// What the field `format` holds.
        found: String,
    },
    /// `version` is not of the form `major.minor`.
    #[error(
        "the version {found} of the project is not of the form \"{VERSION_MAJOR}.{VERSION_MINOR}\"; restore it from a copy"
    )]
    Version {
        /// What the field `version` holds.
        found: String,
    },
    /// The file is of another major version.
    #[error(
        "the project has version {found}, this program reads {VERSION_MAJOR}.x; open it with the Shagreen that wrote it, or a newer one"
    )]
    Major {
        /// The version of the file.
        found: String,
    },
    /// Lengths or times have another unit.
    #[error(
        "the project gives {quantity} in {found}, this program reads {expected}; convert the numbers and the unit"
    )]
    Unit {
        /// The quantity.
        quantity: &'static str,
        /// The unit in the file.
        found: String,
        /// The unit that is read.
        expected: &'static str,
    },
    /// The program has no library of this name.
    #[error(
        "the project is made of the program's library \"{found}\", which this Shagreen does not have; open it with a newer one"
    )]
    BuiltIn {
        /// The name.
        found: String,
    },
    /// A library of the program cannot be read.
    #[error("the library \"{id}\" of the program is damaged ({reason}); install Shagreen again")]
    DamagedBuiltIn {
        /// Which.
        id: &'static str,
        /// What is wrong.
        reason: String,
    },
    /// The file of the library is not to be had.
    #[error(
        "the library of the project cannot be read ({source}); put it back where the project expects it: {}",
        path.display()
    )]
    LibraryFile {
        /// Where it should be.
        path: PathBuf,
        /// What the system says.
        #[source]
        source: io::Error,
    },
    /// The library of the project, or a texture that joined it, is none.
    #[error("the library of the project cannot be used: {source}{}", at(.path.as_ref()))]
    Library {
        /// Its file, where it has one.
        path: Option<PathBuf>,
        /// What is wrong.
        #[source]
        source: LibraryError,
    },
    /// `library` does not say where the library is.
    #[error(
        "`library` must have one of \"built_in\", \"file\" and \"inside\"; restore the project from a copy"
    )]
    NoLibrary,
    /// A word is not one that is known.
    #[error("\"{name}\" has the {field} \"{found}\"; it must be {expected}")]
    Word {
        /// Name of the authored texture.
        name: String,
        /// The field.
        field: &'static str,
        /// The word in the file.
        found: String,
        /// The words that are known.
        expected: &'static str,
    },
    /// A place is outside the space.
    #[error("\"{name}\" has no valid place: {source}; correct it, or take the texture out of the project")]
    Place {
        /// Name of the authored texture.
        name: String,
        /// What is wrong.
        source: SpacePointError,
    },
    /// A number has no meaning.
    #[error("\"{name}\" has {field} {value}; {needs}")]
    Number {
        /// Name of the authored texture.
        name: String,
        /// The field.
        field: &'static str,
        /// Its value.
        value: f64,
        /// What it must be.
        needs: &'static str,
    },
    /// Two authored textures have the same key.
    #[error("\"{first}\" and \"{second}\" have the same key {key}; give one of them another number")]
    Key {
        /// Name of the one.
        first: String,
        /// Name of the other.
        second: String,
        /// The key.
        key: u32,
    },
}

fn at(path: Option<&PathBuf>) -> String {
    path.map_or_else(String::new, |path| format!(": {}", path.display()))
}
