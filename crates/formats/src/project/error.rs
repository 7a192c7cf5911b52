//! Errors of reading a project.

use std::io;
use std::path::PathBuf;

use shagreen_core::space::SpacePointError;
use shagreen_core::texture::shape::ShapeError;
use shagreen_core::words::counted;

use crate::foreign_file::Found;
use crate::library::{CoordinatesError, LibraryError};
use crate::project::{FORMAT, VERSION_MAJOR, VERSION_MINOR};
use crate::text_limits::TooLong;

/// Why bytes are not a project.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ProjectError {
    /// Not JSON, truncated, or a field is missing or of the wrong type.
    #[error("the project is damaged: {reason}; restore it from a copy")]
    Damaged {
        /// The parser's message, with line and column.
        reason: String,
    },
    /// The file is of another format.
    #[error("{}", .found.instead_of("a project", FORMAT))]
    Format {
        /// What the file is.
        found: Found,
    },
    /// `version` is not of the form `major.minor`.
    #[error(
        "the version {found} of the project is not of the form \"{VERSION_MAJOR}.{VERSION_MINOR}\"; restore the project from a copy"
    )]
    Version {
        /// Value of the `version` field.
        found: String,
    },
    /// The file has an unsupported major version.
    #[error(
        "the project has version {found}, but this program reads {VERSION_MAJOR}.x; open it with the version of Shagreen that wrote it, or a newer one"
    )]
    Major {
        /// The version of the file.
        found: String,
    },
    /// Lengths or times have an unsupported unit.
    #[error(
        "the project gives {quantity} in {found}, but this program reads {expected}; convert the numbers and the unit"
    )]
    Unit {
        /// The quantity.
        quantity: &'static str,
        /// The unit in the file.
        found: String,
        /// The supported unit.
        expected: &'static str,
    },
    /// A text is too long.
    #[error(transparent)]
    TooLong(#[from] TooLong),
    /// The library lies on another computer.
    #[error(
        "the library of the project is on another computer, which is not contacted; copy it into the folder of the project: {}",
        path.display()
    )]
    Network {
        /// The path in the file.
        path: PathBuf,
    },
    /// A drawn path has too many points.
    #[error("the path of \"{name}\" has {n} points, but at most {most} are possible; remove some")]
    PathPoints {
        /// Name of the texture.
        name: String,
        /// Number of points.
        n: usize,
        /// Maximum number of points.
        most: usize,
    },
    /// The named built-in library does not exist.
    #[error(
        "the project uses the built-in library \"{found}\", which this version of Shagreen does not have; use a newer version"
    )]
    BuiltIn {
        /// The name in the file.
        found: String,
    },
    /// A built-in library cannot be read.
    #[error("the built-in library \"{id}\" is damaged ({reason}); reinstall Shagreen")]
    DamagedBuiltIn {
        /// Identifier of the library.
        id: &'static str,
        /// What is wrong.
        reason: String,
    },
    /// The library file cannot be read.
    #[error(
        "the library of the project cannot be read ({source}); restore the file at this path: {}",
        path.display()
    )]
    LibraryFile {
        /// Expected path of the file.
        path: PathBuf,
        /// The error of the operating system.
        #[source]
        source: io::Error,
    },
    /// The library of the project, or an added texture, is invalid.
    #[error("the library of the project is invalid: {source}{}", at(.path.as_ref()))]
    Library {
        /// Path of the library file, if there is one.
        path: Option<PathBuf>,
        /// What is wrong.
        #[source]
        source: LibraryError,
    },
    /// `library` states no location.
    #[error(
        "`library` must have exactly one of the fields \"built_in\", \"file\" and \"inside\"; restore the project from a copy"
    )]
    NoLibrary,
    /// A field holds an unknown word.
    #[error("\"{name}\" has the {field} \"{found}\"; it must be {expected}")]
    Word {
        /// Name of the authored texture.
        name: String,
        /// Name of the field.
        field: &'static str,
        /// The word in the file.
        found: String,
        /// The permitted words.
        expected: &'static str,
    },
    /// A position is outside the space.
    #[error(
        "the position of \"{name}\" is invalid: {source}; correct it, or remove the texture from the project"
    )]
    Place {
        /// Name of the authored texture.
        name: String,
        /// What is wrong.
        source: CoordinatesError,
    },
    /// The position of a texture on the clipboard has another number of coordinates than its space has axes.
    #[error(
        "the position of \"{name}\" has {}, but the number of axes is {n_axes}; copy the texture again",
        counted(*.n, "coordinate")
    )]
    AxisCount {
        /// Name of the authored texture.
        name: String,
        /// Number of its coordinates.
        n: usize,
        /// Number of axes.
        n_axes: usize,
    },
    /// A point of a drawn path is outside the space.
    #[error(
        "the position of point {number} of the path of \"{name}\" is invalid: {source}; correct or remove it"
    )]
    PathPoint {
        /// Name of the authored texture.
        name: String,
        /// Number of the point, from one.
        number: usize,
        /// What is wrong.
        source: SpacePointError,
    },
    /// A point of a drawn path has another number of coordinates than the position of its texture.
    #[error(
        "point {number} of the path of \"{name}\" has {}, but its position has {expected}; give both the same number",
        counted(*.n, "coordinate")
    )]
    PathPointCount {
        /// Name of the authored texture.
        name: String,
        /// Number of the point, from one.
        number: usize,
        /// Number of its coordinates.
        n: usize,
        /// Number of coordinates of the position.
        expected: usize,
    },
    /// `axes` is not one to six different names.
    #[error(
        "`axes` must be one to six different names of axes; correct them, or remove `axes` to use the positions of the textures"
    )]
    Axes,
    /// The axes of a snapshot do not fit its position.
    #[error(
        "`axes` of the snapshot of \"{name}\" must be one different name for each of its coordinates ({n}); correct or remove them"
    )]
    SnapshotAxes {
        /// Name of the texture.
        name: String,
        /// Number of coordinates of its position.
        n: usize,
    },
    /// A number is out of range.
    #[error("\"{name}\" has {field} {value}; {needs}")]
    Number {
        /// Name of the authored texture.
        name: String,
        /// Name of the field.
        field: &'static str,
        /// The value in the file.
        value: f64,
        /// The permitted range.
        needs: &'static str,
    },
    /// A shape is invalid.
    #[error("the shape of \"{name}\" is invalid: {source}")]
    Shape {
        /// Name of the authored texture.
        name: String,
        /// What is wrong.
        source: ShapeError,
    },
    /// Two authored textures have the same key.
    #[error(
        "\"{first}\" and \"{second}\" have the same key {key}; change the `key` of one of them to an unused number"
    )]
    Key {
        /// Name of the first texture.
        first: String,
        /// Name of the second texture.
        second: String,
        /// The key.
        key: u32,
    },
}

fn at(path: Option<&PathBuf>) -> String {
    path.map_or_else(String::new, |path| format!(": {}", path.display()))
}
