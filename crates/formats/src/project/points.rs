//! Points of a project: positions of its authored textures and snapshots, and points of their paths. In an open project, each has
//! one coordinate for each axis of the space. Snapshots that were taken on other axes keep their coordinates on those.

use std::sync::Arc;

use shagreen_core::space::{MIDDLE, SpacePoint};

use crate::project::axes::{is_same_axis, own};
use crate::project::{AuthoredTexture, Project};

impl AuthoredTexture {
    /// Moves the position and all points of the path.
    pub fn move_points(&mut self, after: impl Fn(SpacePoint) -> SpacePoint) {
        self.at = after(self.at);
        for point in self.path.iter_mut().flat_map(|path| &mut path.points) {
            *point = after(*point);
        }
    }

    /// Gives the position and all points of the path this number of coordinates (1 to
    /// [`MOST_AXES`](shagreen_core::space::MOST_AXES)): further coordinates are in the middle, or left out.
    pub fn fit(&mut self, n_axes: usize) {
        self.move_points(|at| at.on(n_axes));
    }

    /// Returns the texture with its position and all points of its path moved; the same one in memory if all of them stay.
    #[must_use]
    pub fn moved(self: &Arc<Self>, after: impl Fn(SpacePoint) -> SpacePoint) -> Arc<Self> {
        let mut moved = Self::clone(self);
        moved.move_points(after);
        let stays = moved.at == self.at && moved.path == self.path;
        if stays { Arc::clone(self) } else { Arc::new(moved) }
    }
}

impl Project {
    /// Names of the axes of the space, one to six: those that the project chooses, or else those of the positions.
    pub fn axis_names(&self) -> Vec<&str> {
        match &self.axes {
            Some(axes) => axes.iter().map(String::as_str).collect(),
            None => own(&self.library, self.space.as_deref()),
        }
    }

    /// Number of axes of the space, one to six.
    pub fn n_axes(&self) -> usize {
        self.axis_names().len()
    }

    /// Gives every point one coordinate for each axis of the space: further coordinates are in the middle, or left out. Returns
    /// whether a point had another number of them, as after a change of the library file.
    pub fn fit_points(&mut self) -> bool {
        let n_axes = self.n_axes();
        self.move_points(|at| at.on(n_axes))
    }

    /// Moves every point from the axes with these names to those of the space, after another library or space took the place of
    /// the former one. A point keeps its coordinates on axes of the same name ([`is_same_axis`]) and is in the middle of the
    /// others. If no axis has a former name, it keeps its first coordinates. Otherwise, snapshots stay on their axes
    /// ([`Project::note_axes_of_snapshots`]).
    pub fn follow_axes(&mut self, former: &[String]) {
        let same = |name: &str| former.iter().position(|known| is_same_axis(known, name));
        let from: Vec<Option<usize>> = self.axis_names().into_iter().map(same).collect();
        if from.iter().all(Option::is_none) {
            self.fit_points();
            return;
        }
        self.note_axes_of_snapshots(former);
        self.move_points(|at| {
            let at = at.on(former.len());
            let kept = from.iter().map(|axis| axis.and_then(|axis| at.get(axis)));
            let coordinates: Vec<f64> = kept.map(|kept| kept.unwrap_or(MIDDLE)).collect();
            SpacePoint::of(&coordinates).unwrap_or_else(|_| at.on(from.len()))
        });
    }

    /// Notes the axes of every snapshot after the axes with these names were replaced. It keeps its coordinates, and is moved
    /// to other axes only when it is restored.
    pub fn note_axes_of_snapshots(&mut self, former: &[String]) {
        let now: Vec<String> = self.axis_names().into_iter().map(str::to_owned).collect();
        for snapshot in &mut self.snapshots {
            let axes = snapshot.axes.as_deref().unwrap_or(former);
            let noted = (axes != now).then(|| axes.to_vec());
            if noted == snapshot.axes {
                continue;
            }
            let snapshot = Arc::make_mut(snapshot);
            if snapshot.axes.is_none() {
                snapshot.fit(former.len());
            }
            snapshot.axes = noted;
        }
    }

    /// Moves every point on the axes of the space; textures whose points all stay are shared with other copies of the project.
    /// Returns whether one moved.
    fn move_points(&mut self, after: impl Fn(SpacePoint) -> SpacePoint) -> bool {
        let mut has_moved = false;
        let snapshots = self.snapshots.iter_mut().filter(|snapshot| snapshot.axes.is_none());
        for texture in self.authored.iter_mut().chain(snapshots) {
            let moved = texture.moved(&after);
            has_moved |= !Arc::ptr_eq(&moved, texture);
            *texture = moved;
        }
        has_moved
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use serde_json::json;
    use shagreen_core::space::SpacePoint;
    use shagreen_core::space::texture_path::UserPath;

    use crate::built_in::BuiltIn;
    use crate::library::Library;
    use crate::placed_space::PlacedSpace;
    use crate::project::{AuthoredTexture, Project, ProjectLibrary};

    fn names(axes: &[&str]) -> Vec<String> {
        axes.iter().map(|name| (*name).to_owned()).collect()
    }

    fn at(coordinates: &[f64]) -> SpacePoint {
        SpacePoint::of(coordinates).unwrap()
    }

    /// Project on a library with these axes. Its texture has a path, and its snapshot lies at the end of that.
    fn project(axes: Option<&[&str]>) -> Project {
        let library = Library { axes: axes.map(names), ..Library::default() };
        let mut project = Project::new(ProjectLibrary::Inside(library.into()), "Oak copy");
        let texture = Arc::make_mut(&mut project.authored[0]);
        let points = vec![at(&[30.0, 20.0]), at(&[1.0, 2.0])];
        (texture.at, texture.path) = (points[0], Some(UserPath { points, ..UserPath::default() }));
        let snapshot = AuthoredTexture { at: at(&[1.0, 2.0]), path: None, ..AuthoredTexture::clone(texture) };
        project.snapshots.push(Arc::new(snapshot));
        project
    }

    /// All points of the project of [`project`].
    fn points(project: &Project) -> Vec<SpacePoint> {
        let texture = project.texture();
        let path = texture.path.iter().flat_map(|path| path.points.iter().copied());
        std::iter::once(texture.at).chain(path).chain([project.snapshots[0].at]).collect()
    }

    #[test]
    fn the_axes_are_those_of_the_project_then_the_space_then_the_library() {
        let mut project = project(Some(&["a-b"]));
        assert_eq!(project.axis_names(), ["a-b"]);
        let space = PlacedSpace {
            textures: Vec::new(),
            axes: Some(names(&["c-d", "e-f", "g-h"])),
            report: json!({}),
        };
        project.space = Some(Arc::new(space));
        assert_eq!((project.axis_names(), project.n_axes()), (vec!["c-d", "e-f", "g-h"], 3));
        project.axes = Some(names(&["centroid", "c-d"]));
        assert_eq!(project.axis_names(), ["centroid", "c-d"]);
        for library in BuiltIn::ALL {
            let project = Project::new(ProjectLibrary::BuiltIn(library), "New texture");
            assert_eq!(project.axis_names(), library.read().unwrap().axis_names());
        }
    }

    #[test]
    fn all_points_get_the_coordinates_of_the_space() {
        let mut project = project(None);
        let before = project.clone();
        assert!(!project.fit_points() && project == before);
        assert!(Arc::ptr_eq(&project.authored[0], &before.authored[0]), "shared");
        project.axes = Some(names(&["rough-smooth", "hard-soft", "centroid"]));
        assert!(project.fit_points());
        let expected = [[30.0, 20.0, 50.0], [30.0, 20.0, 50.0], [1.0, 2.0, 50.0], [1.0, 2.0, 50.0]];
        assert_eq!(points(&project), expected.map(|coordinates| at(&coordinates)));
        project.axes = Some(names(&["rough-smooth"]));
        assert!(project.fit_points() && points(&project).iter().all(|at| at.n_axes() == 1));
        // A texture whose points have several numbers of coordinates.
        let mut texture = AuthoredTexture::clone(&before.authored[0]);
        texture.at = at(&[1.0, 2.0, 3.0]);
        texture.fit(3);
        assert_eq!(texture.at, at(&[1.0, 2.0, 3.0]));
        assert!(texture.path.unwrap().points.iter().all(|point| point.n_axes() == 3));
    }

    #[test]
    fn points_keep_their_coordinates_on_axes_of_the_same_name() {
        let followed = |former: &[&str], axes: Option<&[&str]>| {
            let mut project = project(axes);
            project.follow_axes(&names(former));
            (project.texture().at, points(&project)[2])
        };
        // The order was swapped.
        let swapped = followed(&["hard-soft", "rough-smooth"], None);
        assert_eq!(swapped, (at(&[20.0, 30.0]), at(&[2.0, 1.0])));
        let further = followed(
            &["Hard-soft", "attribute:rough-smooth"],
            Some(&["centroid", "rough-smooth", "hard-soft"]),
        );
        assert_eq!(further, (at(&[50.0, 20.0, 30.0]), at(&[50.0, 2.0, 1.0])));
        assert_eq!(followed(&["rough-smooth", "warm-cold"], None).0, at(&[30.0, 50.0]));
        // Without a common name, the coordinates keep their order, as in projects with two axes before.
        assert_eq!(followed(&["warm-cold", "flat-bumpy"], None).0, at(&[30.0, 20.0]));
        assert_eq!(followed(&["a-b", "c-d"], Some(&["e-f", "g-h", "i-j"])).0, at(&[30.0, 20.0, 50.0]));
        assert_eq!(followed(&["rough-smooth", "hard-soft"], None).0, at(&[30.0, 20.0]));
    }

    #[test]
    fn snapshots_stay_on_their_axes() {
        let usual = names(&["rough-smooth", "hard-soft"]);
        let begun = project(Some(&["centroid", "hard-soft", "rough-smooth"]));
        let mut project = begun.clone();
        project.follow_axes(&usual);
        let snapshot = |project: &Project| (project.snapshots[0].at, project.snapshots[0].axes.clone());
        assert_eq!(project.texture().at, at(&[50.0, 20.0, 30.0]));
        assert_eq!(snapshot(&project), (at(&[1.0, 2.0]), Some(usual.clone())));
        // Neither further changes nor files with other numbers of coordinates move it.
        let three = names(&["centroid", "hard-soft", "rough-smooth"]);
        project.axes = Some(names(&["hard-soft"]));
        project.follow_axes(&three);
        project.fit_points();
        assert_eq!(project.texture().at, at(&[20.0]));
        assert_eq!(snapshot(&project), (at(&[1.0, 2.0]), Some(usual.clone())));
        // On its own axes, it is as it was taken.
        project.axes = Some(usual.clone());
        project.note_axes_of_snapshots(&names(&["hard-soft"]));
        assert_eq!(snapshot(&project), (at(&[1.0, 2.0]), None));
        // Without a common name, it keeps its first coordinates like all points.
        let mut project = begun;
        project.axes = Some(names(&["a-b", "c-d"]));
        project.follow_axes(&usual);
        assert_eq!(snapshot(&project), (at(&[1.0, 2.0]), None));
    }
}
