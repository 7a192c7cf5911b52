//! Coordinates of added textures on axes of the space that nothing else gives.
//!
//! An added texture, such as one that was made for an authored texture, has a coordinate on an axis if it has a position or an
//! attribute there, or if the axis is computed from the vibration. Coordinates on other axes are stored here. They are estimates:
//! that of the point that the texture was made for, or a local mean of the other textures.

use std::collections::BTreeMap;

use serde_json::{Map, Value};
use shagreen_core::space::{LabelSource, SpacePoint};

use crate::library::v1::TextureV1;
use crate::library::{Library, Place, TextureEntry};
use crate::project::{Project, ProjectError};

/// Name of the coordinates among the fields of an added texture.
const FIELD: &str = "coordinates";

/// Estimated coordinates of added textures, by the identifier of the texture and the name of the axis in the project.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AddedCoordinates(BTreeMap<String, BTreeMap<String, f64>>);

impl AddedCoordinates {
    /// Whether there is no coordinate.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Coordinate of the texture with this identifier on the axis with this name, 0 to 100.
    pub fn get(&self, id: &str, axis: &str) -> Option<f64> {
        self.0.get(id)?.get(axis).copied()
    }

    /// Position of the texture with this identifier on the axes with these names, if there is a coordinate on each of them.
    pub fn on(&self, id: &str, axes: &[&str]) -> Option<SpacePoint> {
        let coordinates: Option<Vec<f64>> = axes.iter().map(|axis| self.get(id, axis)).collect();
        SpacePoint::of(&coordinates?).ok() // There are too many axes, or none.
    }

    /// Sets a coordinate, which is limited to the axis.
    pub fn set(&mut self, id: &str, axis: &str, value: f64) {
        self.0.entry(id.to_owned()).or_default().insert(axis.to_owned(), value.clamp(0.0, 100.0));
    }

    /// Removes all coordinates of the texture with this identifier.
    pub fn remove(&mut self, id: &str) {
        self.0.remove(id);
    }

    /// Follows new identifiers of textures, by the former ones.
    pub fn rename(&mut self, renamed: &BTreeMap<String, String>) {
        let now = |(id, of): (String, BTreeMap<String, f64>)| (renamed.get(&id).cloned().unwrap_or(id), of);
        self.0 = std::mem::take(&mut self.0).into_iter().map(now).collect();
    }

    /// Adds the coordinates of a texture in a file.
    pub(super) fn add(&mut self, id: &str, of_file: BTreeMap<String, f64>) {
        if !of_file.is_empty() {
            self.0.insert(id.to_owned(), of_file);
        }
    }
}

impl Project {
    /// Whether coordinates of the added texture with this index may be estimated where nothing gives them: it takes part only
    /// where it is pinned, or its position is an estimate itself.
    pub fn takes_estimates(&self, joined: usize) -> bool {
        let is_estimated = |entry: &TextureEntry| entry.label_source() == Some(LabelSource::Estimated);
        self.is_own(joined) || self.joined.get(joined).is_some_and(|entry| is_estimated(entry))
    }

    /// Gives textures of the list that have no position on its axes the one of their [`AddedCoordinates`], if it is complete.
    pub(super) fn place_added(&self, library: &mut Library) {
        if self.coordinates.is_empty() {
            return;
        }
        let axes = library.axis_names();
        let placed = |(index, texture): (usize, &TextureEntry)| {
            let is_whole = texture.at().is_some_and(|at| at.n_axes() == axes.len());
            let at = if is_whole { None } else { self.coordinates.on(&texture.id, &axes) };
            Some((index, Place::new(at?, LabelSource::Estimated)))
        };
        let found: Vec<(usize, Place)> = library.textures.iter().enumerate().filter_map(placed).collect();
        for (index, place) in found {
            library.textures[index].place = Some(place);
        }
    }
}

/// Takes the coordinates out of an added texture.
pub(super) fn read(wire: &mut TextureV1) -> Result<BTreeMap<String, f64>, ProjectError> {
    let Some(found) = wire.unknown.remove(FIELD) else { return Ok(BTreeMap::new()) };
    let damaged = || ProjectError::Damaged {
        reason: format!(
            "`{FIELD}` of the added texture \"{}\" are not numbers from 0 to 100 by axis",
            wire.id
        ),
    };
    let read: BTreeMap<String, f64> = serde_json::from_value(found).map_err(|_| damaged())?;
    if read.values().all(|value| (0.0..=100.0).contains(value)) { Ok(read) } else { Err(damaged()) }
}

/// Puts the coordinates into an added texture.
pub(super) fn write(coordinates: &AddedCoordinates, wire: &mut TextureV1) {
    wire.unknown.remove(FIELD);
    if let Some(of_texture) = coordinates.0.get(&wire.id) {
        let values: Map<String, Value> =
            of_texture.iter().map(|(axis, value)| (axis.clone(), Value::from(*value))).collect();
        wire.unknown.insert(FIELD.to_owned(), Value::Object(values));
    }
}

/// Whether a project needs a version with coordinates of added textures.
pub(super) fn is_needed(project: &Project) -> bool {
    project.joined.iter().any(|entry| project.coordinates.0.contains_key(&entry.id))
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;
    use std::path::Path;
    use std::sync::Arc;

    use serde_json::{Value, json};
    use shagreen_core::space::{LabelSource, SpacePoint};

    use super::AddedCoordinates;
    use crate::built_in::BuiltIn;
    use crate::library::{Place, TextureEntry};
    use crate::project::{Project, ProjectLibrary, read_project, write_project};
    use crate::starter::starter_library;

    /// Project with an own texture that has no position.
    fn project() -> Project {
        let mut project = Project::new(ProjectLibrary::BuiltIn(BuiltIn::Starter), "Oak copy");
        let texture = starter_library().unwrap().textures[3].clone();
        let own = TextureEntry { id: "own".to_owned(), place: None, ..texture };
        project.joined.push(Arc::new(own));
        project.own.insert("own".to_owned());
        project
    }

    fn read(bytes: &[u8]) -> Result<Project, String> {
        let nothing = |_: &Path| Err(std::io::ErrorKind::NotFound.into());
        let read = read_project(bytes, Path::new("/somewhere"), &nothing);
        read.map(|read| read.value).map_err(|error| error.to_string())
    }

    #[test]
    fn coordinates_of_added_textures_go_there_and_back() {
        let mut project = project();
        let write = |project: &Project| write_project(project, Path::new("/somewhere"), "test");
        let wire = |project: &Project| -> Value { serde_json::from_slice(&write(project)).unwrap() };
        assert_eq!(wire(&project)["version"], "1.2", "as before there were coordinates");
        project.coordinates.set("own", "flat-bumpy", 100.0 / 3.0);
        project.coordinates.set("own", "sticky-slippery", 130.0);
        let written = wire(&project);
        assert_eq!(written["version"], "1.3");
        let expected = json!({"flat-bumpy": 100.0 / 3.0, "sticky-slippery": 100.0});
        assert_eq!(written["joined"][0]["coordinates"], expected);
        assert_eq!(read(&write(&project)).unwrap(), project);
        for wrong in [json!(3), json!({"flat-bumpy": "much"}), json!({"flat-bumpy": 101.0})] {
            let mut written = written.clone();
            written["joined"][0]["coordinates"] = wrong;
            let error = read(written.to_string().as_bytes()).unwrap_err();
            assert!(error.contains("`coordinates` of the added texture \"own\""), "{error}");
        }
        // Those of a texture that is gone are in no file.
        project.joined.clear();
        assert_eq!(wire(&project)["version"], "1.0");
    }

    #[test]
    fn a_complete_position_places_a_texture_that_has_none() {
        let mut project = project();
        let place = |project: &Project| {
            let list = project.textures_on(starter_library().unwrap());
            list.textures[list.index_of("own").unwrap()].place
        };
        project.coordinates.set("own", "hard-soft", 70.0);
        assert_eq!(place(&project), None, "an axis is missing");
        project.coordinates.set("own", "rough-smooth", 30.0);
        let estimated = Place::new(SpacePoint::plane(30.0, 70.0), LabelSource::Estimated);
        assert_eq!(place(&project), Some(estimated));
        let entry = Arc::make_mut(&mut project.joined[0]);
        let stated = Some(Place::new(SpacePoint::plane(1.0, 2.0), LabelSource::HumanRatings));
        entry.place = stated;
        assert_eq!(place(&project), stated, "a position of its own comes first");
    }

    #[test]
    fn own_textures_and_estimates_take_estimates() {
        let mut project = project();
        assert!(project.takes_estimates(0) && !project.takes_estimates(1));
        project.own.clear();
        assert!(!project.takes_estimates(0));
        let at = SpacePoint::plane(1.0, 2.0);
        Arc::make_mut(&mut project.joined[0]).place = Some(Place::new(at, LabelSource::Estimated));
        assert!(project.takes_estimates(0));
    }

    #[test]
    fn coordinates_follow_new_identifiers() {
        let mut coordinates = AddedCoordinates::default();
        coordinates.set("a", "x", 1.0);
        coordinates.set("b", "x", 2.0);
        coordinates
            .rename(&BTreeMap::from([("a", "b"), ("b", "c")].map(|(a, b)| (a.to_owned(), b.to_owned()))));
        assert_eq!(["a", "b", "c"].map(|id| coordinates.get(id, "x")), [None, Some(1.0), Some(2.0)]);
        coordinates.remove("b");
        coordinates.remove("c");
        assert!(coordinates.is_empty());
    }
}
