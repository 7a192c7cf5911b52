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

/// Whether two names are those of the same attribute, position or feature, or of an attribute and a position of the same name.
/// Case does not count.
pub fn is_same_axis(name: &str, other: &str) -> bool {
    plain_axis_name(name).eq_ignore_ascii_case(plain_axis_name(other))
}

/// Returns names of axes without those that are the same axis as an earlier one ([`is_same_axis`]): a project with both could not
/// be read again.
pub fn different_axes(names: &[String]) -> Vec<String> {
    let is_first =
        |(index, name): &(usize, &String)| !names[..*index].iter().any(|known| is_same_axis(known, name));
    names.iter().enumerate().filter(is_first).map(|(_, name)| name.clone()).collect()
}

/// Validates the axes of a file, and converts those of a file before version 1.3. `own` are the axes of the positions.
pub(super) fn read(
    wire: Option<Vec<String>>,
    is_older: bool,
    own: &[&str],
) -> Result<Option<Vec<String>>, ProjectError> {
    let Some(names) = wire else { return Ok(None) };
    if is_older {
        // Nothing else was ever checked.
        return if names.len() == 2 { Ok(Some(of_older(names, own))) } else { Err(ProjectError::Axes) };
    }
    if are_possible(&names) { Ok(Some(names)) } else { Err(ProjectError::Axes) }
}

/// Whether a space can have axes with these names: one to six different ones.
pub(super) fn are_possible(names: &[String]) -> bool {
    let plain: Vec<&str> = names.iter().map(|name| plain_axis_name(name)).collect();
    are_axes(&plain)
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
fn of_older(names: Vec<String>, own: &[&str]) -> Vec<String> {
    let is_ambiguous = |name: &String| own.contains(&name.as_str()) || SignalAxis::from_name(name).is_some();
    let marked = |name: String| if is_ambiguous(&name) { format!("{ATTRIBUTE_PREFIX}{name}") } else { name };
    names.into_iter().map(marked).collect()
}

/// Names of the axes of the positions: those of the space that was built in the project, if there is one, or else those of the
/// library.
pub(super) fn own<'a>(library: &'a ProjectLibrary, space: Option<&'a PlacedSpace>) -> Vec<&'a str> {
    match (space, library) {
        (Some(space), _) => space.axis_names(),
        // Reading them takes milliseconds; a test compares these names.
        (None, ProjectLibrary::BuiltIn(_)) => USUAL_AXES.to_vec(),
        (None, ProjectLibrary::File(file)) => file.library.axis_names(),
        (None, ProjectLibrary::Inside(library)) => library.axis_names(),
    }
}

#[cfg(test)]
mod tests {
    use super::{different_axes, is_same_axis};

    #[test]
    fn names_that_no_project_can_have_together_are_one_axis() {
        assert!(is_same_axis("rough-smooth", "attribute:Rough-Smooth") && !is_same_axis("a-b", "b-a"));
        let names = ["a-b", "A-b", "centroid", "attribute:a-B", "attribute:c-d", "c-d"].map(str::to_owned);
        assert_eq!(different_axes(&names), ["a-b", "centroid", "attribute:c-d"]);
        assert!(different_axes(&[]).is_empty());
    }
}
