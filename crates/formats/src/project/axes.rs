//! Names of the axes of a project, in memory and in its file.
//!
//! Before version 1.3, the two axes of a project were attributes. Since then, a name can also be that of an axis of the
//! positions or of a feature of the vibration, which may have the same name as an attribute. Reading an older file marks such
//! names as those of attributes, so that the textures keep their positions.

use shagreen_core::space::signal_axes::SignalAxis;

use crate::library::{USUAL_AXES, are_axes};
use crate::placed_space::PlacedSpace;
use crate::project::{Project, ProjectError, ProjectLibrary};

/// Begin of the name of an axis that is an attribute, although an axis of the positions or a feature of the vibration has the
/// same name: `attribute:rough-smooth`.
pub const ATTRIBUTE_PREFIX: &str = "attribute:";

/// Returns the name of an axis without [`ATTRIBUTE_PREFIX`].
pub fn plain_axis_name(name: &str) -> &str {
    name.strip_prefix(ATTRIBUTE_PREFIX).unwrap_or(name)
}

/// Validates the axes of a file, and converts those of a file before version 1.3. `own` are the axes of the positions.
pub(super) fn read(
    wire: Option<Vec<String>>,
    is_older: bool,
    own: impl FnOnce() -> Vec<String>,
) -> Result<Option<Vec<String>>, ProjectError> {
    let Some(names) = wire else { return Ok(None) };
    if is_older {
        // Nothing else was ever checked.
        return if names.len() == 2 { Ok(Some(of_older(names, &own()))) } else { Err(ProjectError::Axes) };
    }
    let plain: Vec<&str> = names.iter().map(|name| plain_axis_name(name)).collect();
    if are_axes(&plain) { Ok(Some(names)) } else { Err(ProjectError::Axes) }
}

/// The axes in the form of a file before version 1.3.
pub(super) fn write_older(project: &Project) -> Option<Vec<String>> {
    project.axes.as_ref().map(|names| names.iter().map(|name| plain_axis_name(name).to_owned()).collect())
}

/// Whether the axes of a project need version 1.3: an older file would give others.
pub(super) fn is_needed(project: &Project) -> bool {
    let (Some(axes), Some(older)) = (&project.axes, write_older(project)) else { return false };
    axes.len() != 2 || of_older(older, &own(&project.library, project.space.as_deref())) != *axes
}

/// The names of a file before version 1.3, which are those of attributes.
fn of_older(names: Vec<String>, own: &[String]) -> Vec<String> {
    let is_ambiguous = |name: &String| own.contains(name) || SignalAxis::from_name(name).is_some();
    let marked = |name: String| if is_ambiguous(&name) { format!("{ATTRIBUTE_PREFIX}{name}") } else { name };
    names.into_iter().map(marked).collect()
}

/// Names of the axes of the positions: those of the space that was built in the project, if there is one, or else those of the
/// library.
pub(super) fn own(library: &ProjectLibrary, space: Option<&PlacedSpace>) -> Vec<String> {
    let owned = |names: Vec<&str>| names.into_iter().map(str::to_owned).collect();
    if let Some(space) = space {
        return owned(space.axis_names());
    }
    match library {
        // A built-in library that cannot be read has no positions either.
        ProjectLibrary::BuiltIn(built_in) => {
            built_in.read().map_or_else(|_| owned(USUAL_AXES.to_vec()), |library| owned(library.axis_names()))
        }
        ProjectLibrary::File(file) => owned(file.library.axis_names()),
        ProjectLibrary::Inside(library) => owned(library.axis_names()),
    }
}
