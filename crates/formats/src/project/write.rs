//! Conversion of a project to bytes; the same project always gives the same bytes.

use std::path::Path;

use serde_json::Value;

use serde_json::Map;
use shagreen_core::space::SpacePoint;
use shagreen_core::space::authoring::{Outside, Weights};

use crate::layout;
use crate::library::numbers::{CONVERSION_DIGITS, digits};
use crate::library::write::{picture, place, wire as library_wire};
use crate::library::{CoordinatesV1, USUAL_AXES, Unknown, attributes};
use crate::path_json;
use crate::placed_space::{PlacedSpace, PlacedTexture};
use crate::project::v1::{
    AuthoredV1, BlendV1, DrawnPathV1, PlacedSpaceV1, PlacedTextureV1, ProjectLibraryV1, ProjectV1, UnitsV1,
};
use crate::project::{
    AuthoredTexture, BlendChoice, FORMAT, LibraryFile, Project, ProjectLibrary, VERSION_MAJOR, axes,
    coordinates, own, shape,
};

/// Quantities of the format and their units, in the order of [`UnitsV1`].
pub(super) const UNITS: [(&str, &str); 2] = [("length", "mm"), ("time", "s")];
/// Identifiers of the weightings.
pub(super) const WEIGHTS: [(Weights, &str); 2] =
    [(Weights::Barycentric, "barycentric"), (Weights::Natural, "natural")];
/// Identifiers of the behaviors outside the convex hull.
pub(super) const OUTSIDES: [(Outside, &str); 2] =
    [(Outside::Clamped, "clamped"), (Outside::Extrapolated, "extrapolated")];

/// The minor version that introduced shapes.
const WITH_SHAPES: u32 = 1;
/// The minor version that introduced added textures that only some authored textures use.
const WITH_OWN: u32 = 2;
/// The minor version that introduced spaces with another number of axes than two, axes that are no attributes, axes of snapshots,
/// and coordinates of added textures.
pub(super) const WITH_FURTHER_AXES: u32 = 3;

/// Nesting depth up to which values get their own lines. Each anchor of an embedded library (in project, library,
/// library, textures, texture, anchors) fills one line.
const OPEN_DEPTH: usize = 6;

/// Serializes a project that will lie in `folder`; `created_by` names the program. The library is written as by
/// [`crate::library::write_library`]. Positions of authored textures have full precision, so reading restores them
/// exactly.
pub fn write_project(project: &Project, folder: &Path, created_by: &str) -> Vec<u8> {
    let [length, time] = UNITS.map(|(_, unit)| unit.to_owned());
    let minor = minor_version(project);
    let wire = ProjectV1 {
        format: FORMAT.to_owned(),
        version: format!("{VERSION_MAJOR}.{minor}"),
        units: UnitsV1 { length, time, unknown: Map::new() },
        created_by: created_by.to_owned(),
        notes: project.notes.clone(),
        axes: if minor < WITH_FURTHER_AXES { axes::write_older(project) } else { project.axes.clone() },
        renamed: project.renamed.clone(),
        starred: project.starred.clone(),
        selected: project.selected,
        solo: project.solo.clone(),
        compared: project.compared,
        unknown: project.unknown.clone(),
        authored: project.authored.iter().map(|texture| authored(texture)).collect(),
        snapshots: project.snapshots.iter().map(|texture| authored(texture)).collect(),
        space: project.space.as_deref().map(placed_space),
        joined: own::write(project),
        library: library(&project.library, folder),
    };
    layout::to_bytes(&wire, OPEN_DEPTH)
}

/// Returns the lowest minor version that has all features of a project, so that older programs can read as much as
/// possible.
fn minor_version(project: &Project) -> u32 {
    let textures = || project.authored.iter().chain(&project.snapshots);
    let is_plane = |at: &SpacePoint| at.n_axes() == USUAL_AXES.len();
    let placed = project.space.iter().flat_map(|space| &space.textures).map(|texture| &texture.place);
    let mut places = placed.chain(project.joined.iter().filter_map(|entry| entry.place.as_ref()));
    if axes::is_needed(project)
        || coordinates::is_needed(project)
        || !textures().all(|texture| is_plane(&texture.at) && texture.axes.is_none())
        || !places.all(|place| is_plane(&place.at))
    {
        return WITH_FURTHER_AXES;
    }
    if own::is_needed(project) {
        return WITH_OWN;
    }
    if textures().any(|texture| shape::is_needed(texture)) { WITH_SHAPES } else { 0 }
}

fn library(library: &ProjectLibrary, folder: &Path) -> ProjectLibraryV1 {
    match library {
        ProjectLibrary::BuiltIn(built_in) => {
            ProjectLibraryV1 { built_in: Some(built_in.id().to_owned()), ..ProjectLibraryV1::default() }
        }
        ProjectLibrary::Inside(library) => {
            ProjectLibraryV1 { inside: Some(Box::new(library_wire(library))), ..ProjectLibraryV1::default() }
        }
        ProjectLibrary::File(file) => ProjectLibraryV1 {
            file: Some(path_from(folder, file)),
            sha256: Some(file.sha256.clone()),
            ..ProjectLibraryV1::default()
        },
    }
}

/// Returns the path of a library as a project in `folder` stores it: relative if it lies inside, so that both can be
/// moved together, with slashes on every system.
fn path_from(folder: &Path, file: &LibraryFile) -> Value {
    match file.path.strip_prefix(folder) {
        // Without a project folder the path stays absolute.
        Ok(inside) if inside.is_relative() => {
            let parts = inside.components().map(|part| part.as_os_str().to_str());
            match parts.collect::<Option<Vec<&str>>>() {
                Some(parts) => parts.join("/").into(),
                None => path_json::to_json(inside),
            }
        }
        _ => path_json::to_json(&file.path),
    }
}

fn placed_space(space: &PlacedSpace) -> PlacedSpaceV1 {
    let texture = |texture: &PlacedTexture| PlacedTextureV1 {
        id: texture.id.clone(),
        space: place(texture.place),
        attributes: texture.attributes.as_ref().map(|known| attributes::write(known, &Unknown::default())),
    };
    PlacedSpaceV1 {
        axes: space.axes.clone(),
        textures: space.textures.iter().map(texture).collect(),
        report: space.report.clone(),
    }
}

pub(super) fn authored(texture: &AuthoredTexture) -> AuthoredV1 {
    let mut unknown = texture.unknown.clone();
    let shape = shape::write(&texture.shape, &mut unknown);
    AuthoredV1 {
        key: texture.key,
        name: texture.name.clone(),
        color: texture.color,
        notes: texture.notes.clone(),
        tags: texture.tags.clone(),
        at: CoordinatesV1::of(texture.at, |coordinate| coordinate),
        axes: texture.axes.clone(),
        blend: blend(&texture.blend),
        shape,
        unknown,
        path: texture.path.as_ref().map(|path| DrawnPathV1 {
            along: path.along.id().to_owned(),
            at_end: path.at_end.id().to_owned(),
            length_mm: digits(1e3 * path.length_m, CONVERSION_DIGITS),
            length_s: path.length_secs,
            // A point with another number of coordinates would be refused when the project is opened again.
            points: path
                .points
                .iter()
                .map(|point| point.on(texture.at.n_axes()).coordinates().to_vec())
                .collect(),
        }),
        picture: texture.picture.as_deref().map(picture),
    }
}

fn blend(choice: &BlendChoice) -> BlendV1 {
    BlendV1 {
        mode: choice.mode.id().to_owned(),
        weights: word(WEIGHTS, choice.weights).to_owned(),
        outside: word(OUTSIDES, choice.outside).to_owned(),
        locked: choice.locked.clone(),
    }
}

fn word<T: Copy + PartialEq>(words: [(T, &'static str); 2], value: T) -> &'static str {
    let [(first, word), (_, other)] = words;
    if value == first { word } else { other }
}
