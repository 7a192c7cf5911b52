//! Axes on which points lose their coordinates, or have only a local mean.

use shagreen_formats::project::{AuthoredTexture, Project, is_same_axis};

/// Names of the axes on which the points of a project have lost their coordinates, because another library or space took the
/// place of the one before. Without chosen axes and without a common name, points keep their coordinates in their order.
pub(crate) fn dropped_axes(before: &Project, now: &Project) -> Vec<String> {
    let (former, names) = (before.axis_names(), now.axis_names());
    let is_dropped = |name: &&str| !names.iter().any(|known| is_same_axis(known, name));
    let dropped: Vec<String> = former.iter().copied().filter(is_dropped).map(str::to_owned).collect();
    let keeps_order = before.axes.is_none() && dropped.len() == former.len() && names.len() >= former.len();
    if keeps_order { Vec::new() } else { dropped }
}

/// Names of the axes of the space of which a snapshot states nothing, because it was taken on others.
pub(crate) fn unstated_axes(project: &Project, snapshot: &AuthoredTexture) -> Vec<String> {
    let Some(axes) = &snapshot.axes else { return Vec::new() };
    let is_unstated = |name: &&str| !axes.iter().any(|known| known == name);
    project.axis_names().into_iter().filter(is_unstated).map(str::to_owned).collect()
}

#[cfg(test)]
mod tests {
    use super::{dropped_axes, unstated_axes};
    use shagreen_formats::library::Library;
    use shagreen_formats::project::{AuthoredTexture, Project, ProjectLibrary};

    fn names(axes: &[&str]) -> Vec<String> {
        axes.iter().map(|name| (*name).to_owned()).collect()
    }

    /// Project on a library with these axes, which chooses others.
    fn project(axes: &[&str], chosen: Option<&[&str]>) -> Project {
        let library = Library { axes: Some(names(axes)), ..Library::default() };
        let project = Project::new(ProjectLibrary::Inside(library.into()), "Oak copy");
        Project { axes: chosen.map(names), ..project }
    }

    #[test]
    fn axes_that_the_new_textures_lack_are_named() {
        let usual = ["rough-smooth", "hard-soft"];
        let chosen = project(&usual, Some(&["rough-smooth", "a-b", "centroid"]));
        assert_eq!(dropped_axes(&chosen, &project(&usual, None)), ["a-b", "centroid"]);
        assert_eq!(dropped_axes(&chosen, &chosen), Vec::<String>::new());
        let others = project(&["c-d", "e-f"], None);
        assert_eq!(dropped_axes(&chosen, &others), ["rough-smooth", "a-b", "centroid"]);
        // Without a choice, two others take the place of two axes.
        assert_eq!(dropped_axes(&project(&usual, None), &others), Vec::<String>::new());
        assert_eq!(
            dropped_axes(&project(&["rough-smooth", "hard-soft", "a-b"], None), &project(&usual, None)),
            ["a-b"]
        );
    }

    #[test]
    fn axes_of_which_a_snapshot_states_nothing_are_named() {
        let project = project(&["rough-smooth", "hard-soft"], None);
        let snapshot = |axes: Option<&[&str]>| AuthoredTexture {
            axes: axes.map(names),
            ..AuthoredTexture::new(1, "Oak copy")
        };
        assert_eq!(unstated_axes(&project, &snapshot(None)), Vec::<String>::new());
        assert_eq!(unstated_axes(&project, &snapshot(Some(&["centroid", "hard-soft"]))), ["rough-smooth"]);
    }
}
