//! From a project to bytes, always the same for the same project.

use std::path::{Component, Path};

use serde_json::Map;
use shagreen_core::authoring::{Outside, Weights};

use crate::layout;
use crate::library::write::{CONVERSION_DIGITS, digits, picture, place, texture, wire as library_wire};
use crate::library::{Unknown, attributes};
use crate::placed_space::{PlacedSpace, PlacedTexture};
use crate::project::v1::{
    AuthoredV1, BlendV1, DrawnPathV1, PlacedSpaceV1, PlacedTextureV1, ProjectLibraryV1, ProjectV1, UnitsV1,
};
use crate::project::{
    AuthoredTexture, BlendChoice, FORMAT, LibraryFile, Project, ProjectLibrary, VERSION_MAJOR, VERSION_MINOR,
};

/// Quantities of the format and their units, in the order of [`UnitsV1`].
pub(super) const UNITS: [(&str, &str); 2] = [("length", "mm"), ("time", "s")];
/// Words for the neighbors that have a say.
pub(super) const WEIGHTS: [(Weights, &str); 2] =
    [(Weights::Barycentric, "barycentric"), (Weights::Natural, "natural")];
/// Words for what happens outside the hull.
pub(super) const OUTSIDES: [(Outside, &str); 2] =
    [(Outside::Clamped, "clamped"), (Outside::Extrapolated, "extrapolated")];

/// An anchor of a library inside stands on one line: it lies in project, library, library, textures, texture, anchors.
const OPEN_DEPTH: usize = 6;

/// Writes a project that is to lie in `folder`, by the program of this name. What the library holds is written as
/// [`crate::library::write_library`] does; places of authored textures in full, so that reading it back gives the same.
pub fn write_project(project: &Project, folder: &Path, created_by: &str) -> Vec<u8> {
    let [length, time] = UNITS.map(|(_, unit)| unit.to_owned());
    let wire = ProjectV1 {
        format: FORMAT.to_owned(),
        version: format!("{VERSION_MAJOR}.{VERSION_MINOR}"),
        units: UnitsV1 { length, time, unknown: Map::new() },
        created_by: created_by.to_owned(),
        notes: project.notes.clone(),
        axes: project.axes.clone(),
        renamed: project.renamed.clone(),
        starred: project.starred.clone(),
        selected: project.selected,
        solo: project.solo.clone(),
        unknown: project.unknown.clone(),
        authored: project.authored.iter().map(|texture| authored(texture)).collect(),
        snapshots: project.snapshots.iter().map(|texture| authored(texture)).collect(),
        space: project.space.as_deref().map(placed_space),
        joined: project.joined.iter().map(|entry| texture(entry)).collect(),
        library: library(&project.library, folder),
    };
    layout::to_bytes(&wire, OPEN_DEPTH)
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

/// The path of a library as a project in `folder` has it: relative where it lies in there, so that both may be moved
/// together, with slashes as on every system.
fn path_from(folder: &Path, file: &LibraryFile) -> String {
    match file.path.strip_prefix(folder) {
        // What is below no folder at all is still absolute.
        Ok(inside) if inside.is_relative() => {
            let parts = inside.components().map(Component::as_os_str);
            parts.map(|part| part.to_string_lossy()).collect::<Vec<_>>().join("/")
        }
        _ => file.path.to_string_lossy().into_owned(),
    }
}

fn placed_space(space: &PlacedSpace) -> PlacedSpaceV1 {
    let texture = |texture: &PlacedTexture| PlacedTextureV1 {
        id: texture.id.clone(),
        space: place(texture.place),
        attributes: texture.attributes.as_ref().map(|known| attributes::write(known, &Unknown::default())),
    };
    PlacedSpaceV1 {
        axes: space.axes.clone().map(Vec::from),
        textures: space.textures.iter().map(texture).collect(),
        report: space.report.clone(),
    }
}

fn authored(texture: &AuthoredTexture) -> AuthoredV1 {
    AuthoredV1 {
        key: texture.key,
        name: texture.name.clone(),
        color: texture.color,
        notes: texture.notes.clone(),
        tags: texture.tags.clone(),
        rough_smooth: texture.at.rough_smooth,
        hard_soft: texture.at.hard_soft,
        blend: blend(&texture.blend),
        unknown: texture.unknown.clone(),
        path: texture.path.as_ref().map(|path| DrawnPathV1 {
            along: path.along.id().to_owned(),
            at_end: path.at_end.id().to_owned(),
            length_mm: digits(1e3 * path.length_m, CONVERSION_DIGITS),
            length_s: path.length_secs,
            points: path.points.iter().map(|point| [point.rough_smooth, point.hard_soft]).collect(),
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
