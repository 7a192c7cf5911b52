//! Another choice of axes, with every point of a project moved to it.

use std::sync::Arc;

use shagreen_core::space::{SpacePoint, local_mean};
use shagreen_formats::library::{Library, USUAL_AXES};
use shagreen_formats::project::{AuthoredTexture, Project, ProjectLibrary};
use shagreen_studio::axes::axis_values;

/// Coordinate on an axis on which no texture has one.
const MIDDLE: f64 = 50.0;

/// Other axes of the space, and where the points of a project lie on them.
#[derive(Clone, Debug, PartialEq)]
pub struct AxesChange {
    /// Names of the axes; `None` for those of the positions.
    axes: Option<Vec<String>>,
    n_axes: usize,
    /// Each different point of the project on the axes before, and the same point on the new ones.
    moved: Vec<(SpacePoint, SpacePoint)>,
}

impl AxesChange {
    /// Change to the axes with these names, one to six different ones. `library` is the list of textures of the project, and
    /// `positions` are those of the textures on the axes before, by index. Points keep their coordinates on axes that stay; on a
    /// new axis, they have the local mean of the textures, as in [`shagreen_studio::axes::moved_to_axes`].
    pub fn new(
        project: &Project,
        library: &Library,
        positions: &[Option<SpacePoint>],
        axes: &[String],
    ) -> Self {
        let own: Vec<String> = library.axis_names().into_iter().map(str::to_owned).collect();
        let before = project.axes.as_ref().unwrap_or(&own);
        // For all points together: an axis that is computed from the vibration takes about a millisecond a texture.
        let coordinate = |name: &String| match before.iter().position(|known| known == name) {
            Some(axis) => Coordinate::Kept(axis),
            None => Coordinate::Mean(axis_values(library, name).unwrap_or_default()),
        };
        let coordinates: Vec<Coordinate> = axes.iter().map(coordinate).collect();
        let mut moved: Vec<(SpacePoint, SpacePoint)> = Vec::new();
        for at in points(project) {
            if !moved.iter().any(|(known, _)| *known == at) {
                moved.push((at, moved_to(at.on(before.len()), &coordinates, positions)));
            }
        }
        Self { n_axes: axes.len(), axes: (own != *axes).then(|| axes.to_vec()), moved }
    }

    /// Sets the axes of the project and moves its points. A point that the project did not have when the change was made keeps
    /// its first coordinates.
    pub(super) fn apply(self, project: &mut Project) {
        let Self { axes, n_axes, moved } = self;
        project.axes = axes;
        let after = |at: SpacePoint| {
            let known = moved.iter().find(|(before, _)| *before == at);
            known.map_or_else(|| at.on(n_axes), |(_, after)| *after)
        };
        move_points(project, after);
    }
}

/// Where the coordinate of a point on an axis comes from.
enum Coordinate {
    /// The point has it on the axis with this index.
    Kept(usize),
    /// Local mean of these values of the textures, by index; empty if no texture has one.
    Mean(Vec<Option<f64>>),
}

/// A point with other coordinates.
fn moved_to(at: SpacePoint, coordinates: &[Coordinate], positions: &[Option<SpacePoint>]) -> SpacePoint {
    let value = |coordinate: &Coordinate| match coordinate {
        Coordinate::Kept(axis) => at.get(*axis),
        Coordinate::Mean(values) => local_mean(positions, values, at),
    };
    let values: Vec<f64> = coordinates.iter().map(|of| value(of).unwrap_or(MIDDLE)).collect();
    SpacePoint::of(&values).unwrap_or(at)
}

/// Points of all authored textures and snapshots, and of their paths.
fn points(project: &Project) -> impl Iterator<Item = SpacePoint> {
    let textures = project.authored.iter().chain(&project.snapshots);
    textures.flat_map(|texture| points_of(texture))
}

fn points_of(texture: &AuthoredTexture) -> impl Iterator<Item = SpacePoint> {
    let of_path = texture.path.iter().flat_map(|path| path.points.iter().copied());
    std::iter::once(texture.at).chain(of_path)
}

/// Moves every point of the project; textures whose points stay are shared with its earlier states.
fn move_points(project: &mut Project, after: impl Fn(SpacePoint) -> SpacePoint) {
    for texture in project.authored.iter_mut().chain(&mut project.snapshots) {
        if points_of(texture).all(|at| after(at) == at) {
            continue;
        }
        let texture = Arc::make_mut(texture);
        texture.at = after(texture.at);
        if let Some(path) = &mut texture.path {
            for point in &mut path.points {
                *point = after(*point);
            }
        }
    }
}

/// Gives every point of the project as many coordinates as the positions of its textures have, after another library or space
/// took the place of the former one: further coordinates are in the middle, or left out. Axes are not chosen.
pub(super) fn fit_points(project: &mut Project) {
    let n_axes = match (&project.space, &project.library) {
        (Some(space), _) => space.axis_names().len(),
        (None, ProjectLibrary::BuiltIn(_)) => USUAL_AXES.len(),
        (None, ProjectLibrary::File(file)) => file.library.axis_names().len(),
        (None, ProjectLibrary::Inside(library)) => library.axis_names().len(),
    };
    move_points(project, |at| at.on(n_axes));
}

#[cfg(test)]
mod tests {
    use super::{AxesChange, fit_points};
    use crate::state::edit::{Edit, PathChange, edited};
    use crate::state::history::{Gesture, History};
    use shagreen_core::space::SpacePoint;
    use shagreen_core::space::texture_path::UserPath;
    use shagreen_formats::built_in::BuiltIn;
    use shagreen_formats::library::Library;
    use shagreen_formats::project::{AuthoredTexture, Project, ProjectLibrary};
    use shagreen_formats::starter::starter_library;
    use shagreen_studio::axes::{moved_to_axes, placed_on};
    use std::sync::Arc;

    fn names(axes: &[&str]) -> Vec<String> {
        axes.iter().map(|name| (*name).to_owned()).collect()
    }

    /// Project with a texture, its snapshot at another point, and a path.
    fn project() -> (Project, Library) {
        let start = Project::new(ProjectLibrary::BuiltIn(BuiltIn::Starter), "Oak copy");
        let at = SpacePoint::plane(20.0, 30.0);
        let path = UserPath { points: vec![at, SpacePoint::plane(60.0, 70.0)], ..UserPath::default() };
        let edits = [
            Edit::KeepSnapshot,
            Edit::MovePoint(at),
            Edit::ChangePath(PathChange::Draw, Some(path)),
            Edit::Author(Box::new(AuthoredTexture::new(0, "Felt"))),
        ];
        let project = edits.into_iter().fold(start, |project, edit| edited(&project, edit));
        (project, starter_library().unwrap())
    }

    fn change(project: &Project, library: &Library, axes: &[&str]) -> Edit {
        let own = names(&library.axis_names());
        let positions = placed_on(library, project.axes.as_ref().unwrap_or(&own)).unwrap().positions();
        Edit::SetAxes(Box::new(AxesChange::new(project, library, &positions, &names(axes))))
    }

    fn changed(project: &Project, library: &Library, axes: &[&str]) -> Project {
        edited(project, change(project, library, axes))
    }

    #[test]
    fn swapped_axes_keep_every_point() {
        let (project, library) = project();
        let swapped = changed(&project, &library, &["hard-soft", "rough-smooth"]);
        assert_eq!(swapped.axes, Some(names(&["hard-soft", "rough-smooth"])));
        for (before, after) in
            [(&project.authored, &swapped.authored), (&project.snapshots, &swapped.snapshots)]
        {
            for (before, after) in before.iter().zip(after) {
                assert_eq!(after.at, SpacePoint::plane(before.at.y(), before.at.x()));
            }
        }
        let points = &swapped.authored[0].path.as_ref().unwrap().points;
        assert_eq!(points[1], SpacePoint::plane(70.0, 60.0));
        // Back again, nothing has changed: the axes are those of the positions.
        assert_eq!(changed(&swapped, &library, &["rough-smooth", "hard-soft"]), project);
    }

    #[test]
    fn a_further_axis_is_at_its_local_mean_and_undo_restores_everything() {
        let (project, library) = project();
        let mut now = project.clone();
        let mut history = History::default();
        let edit = change(&now, &library, &["rough-smooth", "hard-soft", "centroid"]);
        history.apply(&mut now, edit, Gesture(1));
        for texture in now.authored.iter().chain(&now.snapshots) {
            assert_eq!(texture.at.n_axes(), 3);
            assert!(texture.at.get(2).is_some_and(|mean| (0.0..=100.0).contains(&mean)), "{}", texture.at);
        }
        let path = now.authored[0].path.as_ref().unwrap();
        assert_eq!((path.points[0], path.points[1].n_axes()), (now.authored[0].at, 3), "the same point");
        let further = now.clone();
        assert!(history.undo(&mut now) && now == project);
        assert!(history.redo(&mut now) && now == further);
        assert_eq!(changed(&further, &library, &["rough-smooth", "hard-soft"]), project);
    }

    /// Many points at once move as each alone.
    #[test]
    fn points_move_as_the_command_line_moves_them() {
        let (project, library) = project();
        let further = ["hard-soft", "centroid", "speed exponent", "rough-smooth"];
        let other = ["speed exponent", "force exponent", "hard-soft"];
        let (now, plane) = (changed(&project, &library, &further), names(&library.axis_names()));
        let then = changed(&now, &library, &other);
        for (index, texture) in project.authored.iter().enumerate() {
            let moved = moved_to_axes(&library, texture.at, &plane, &names(&further));
            assert_eq!(now.authored[index].at, moved);
            let moved = moved_to_axes(&library, moved, &names(&further), &names(&other));
            assert_eq!(then.authored[index].at, moved);
        }
    }

    #[test]
    fn another_library_fits_the_points_to_its_axes() {
        let (mut project, library) = project();
        let before = project.clone();
        fit_points(&mut project);
        assert!(project == before && Arc::ptr_eq(&project.authored[0], &before.authored[0]));
        let further = changed(&project, &library, &["rough-smooth", "hard-soft", "centroid"]);
        let built_in = ProjectLibrary::BuiltIn(BuiltIn::Simulated);
        let opened = edited(&further, Edit::OpenLibrary(built_in));
        assert_eq!(opened.axes, None);
        assert!(opened.authored.iter().all(|texture| texture.at.n_axes() == 2));
        assert_eq!(opened.authored[0].at, before.authored[0].at);
    }
}
