//! Conversion of bytes to a project.

use std::collections::{BTreeSet, HashMap};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use sha2::{Digest as _, Sha256};
use shagreen_core::space::SpacePoint;
use shagreen_core::space::authoring::{Outside, Weights};
use shagreen_core::space::texture_path::UserPath;
use shagreen_core::space::texture_path::{Along, AtEnd};
use shagreen_core::texture::blend::Mode;

use crate::built_in::BuiltIn;
use crate::imported::Imported;
use crate::library::read::{check_count, library_inside, picture, place, texture};
use crate::library::v1::PictureV1;
use crate::library::{Attributes, LibraryError, USUAL_AXES, Unknown, attributes, read_library};
use crate::own_json::{HeaderFault, minor_version};
use crate::parser_words::plain;
use crate::path_json;
use crate::picture::Picture;
use crate::placed_space::{PlacedSpace, PlacedTexture};
use crate::project::v1::{
    AuthoredV1, BlendV1, DrawnPathV1, PlacedSpaceV1, ProjectLibraryV1, ProjectV1, UnitsV1,
};
use crate::project::write::{OUTSIDES, UNITS, WEIGHTS, WITH_FURTHER_AXES};
use crate::project::{
    AddedCoordinates, AuthoredTexture, BlendChoice, FORMAT, LibraryFile, N_COLORS, Project, ProjectError,
    ProjectLibrary, VERSION_MAJOR, VERSION_MINOR, axes, coordinates, listed_ids, own, shape,
};
use crate::text_limits::{self, MAX_NAME, MAX_NOTES};

/// Reads a project that lies in `folder`; `read` returns the bytes of its library file, if it has one.
///
/// # Errors
/// See [`ProjectError`]; every number is checked.
pub fn read_project(
    bytes: &[u8],
    folder: &Path,
    read: &dyn Fn(&Path) -> io::Result<Vec<u8>>,
) -> Result<Imported<Project>, ProjectError> {
    read_with(bytes, |wire, warnings| library(wire, folder, read, warnings))
}

/// Reads a project with this library in place of the one that it names.
///
/// # Errors
/// As [`read_project`], except for errors of the library.
pub fn read_project_on(bytes: &[u8], library: ProjectLibrary) -> Result<Imported<Project>, ProjectError> {
    read_with(bytes, |_, _| Ok(library))
}

/// Reads a project; `library_of` returns its library and may add warnings.
fn read_with(
    bytes: &[u8],
    library_of: impl FnOnce(ProjectLibraryV1, &mut Vec<String>) -> Result<ProjectLibrary, ProjectError>,
) -> Result<Imported<Project>, ProjectError> {
    let minor = minor_version(bytes, FORMAT, VERSION_MAJOR)?;
    let mut warnings = Vec::new();
    if minor > VERSION_MINOR {
        warnings.push(format!(
            "the project has version {VERSION_MAJOR}.{minor}, newer than {VERSION_MAJOR}.{VERSION_MINOR}; fields that this program does not know are kept but have no effect"
        ));
    }
    let damaged = |error: serde_json::Error| ProjectError::Damaged { reason: plain(&error.to_string()) };
    let wire: ProjectV1 = serde_json::from_slice(bytes).map_err(damaged)?;
    check_units(&wire.units)?;
    let library = library_of(wire.library, &mut warnings)?;
    let inside = |source: LibraryError| ProjectError::Library { path: None, source };
    let (mut joined, mut marks, mut stated) = (Vec::with_capacity(wire.joined.len()), Vec::new(), Vec::new());
    for mut wire in wire.joined {
        marks.push(own::read(&mut wire)?);
        stated.push(coordinates::read(&mut wire)?);
        joined.push(Arc::new(texture(wire).map_err(inside)?));
    }
    let joined = listed_ids::listed(&library, joined);
    let marked = joined.iter().zip(&marks).filter(|(_, is_own)| **is_own);
    let own: BTreeSet<String> = marked.map(|(entry, _)| entry.id.clone()).collect();
    let mut coordinates = AddedCoordinates::default();
    for (entry, stated) in joined.iter().zip(stated) {
        coordinates.add(&entry.id, stated);
    }
    let space = wire.space.map(placed_space).transpose().map_err(inside)?.map(Arc::new);
    text_limits::check("the notes of the project", &wire.notes, MAX_NOTES)?;
    for texture in wire.authored.iter().chain(&wire.snapshots) {
        text_limits::check("the name of an authored texture", &texture.name, MAX_NAME)?;
        text_limits::check("the notes of an authored texture", &texture.notes, MAX_NOTES)?;
    }
    for name in wire.renamed.values() {
        text_limits::check("the name of a texture", name, MAX_NAME)?;
    }
    let is_older = minor < WITH_FURTHER_AXES;
    let axes = axes::read(wire.axes, is_older, &axes::own(&library, space.as_deref()))?;
    let mut authored: Vec<Arc<AuthoredTexture>> = wire
        .authored
        .into_iter()
        .map(|wire| authored_texture(wire).map(Arc::new))
        .collect::<Result<_, _>>()?;
    let snapshots = wire.snapshots.into_iter().map(|wire| snapshot(wire).map(Arc::new));
    let snapshots = snapshots.collect::<Result<_, _>>()?;
    check_keys(&authored)?;
    if authored.is_empty() {
        warnings.push(
            "the project has no authored texture; a new one is added at the center of the space".to_owned(),
        );
        authored.push(Arc::new(AuthoredTexture::new(1, "New texture")));
    }
    let selected = wire.selected.min(authored.len() - 1);
    Ok(Imported {
        value: Project {
            notes: wire.notes,
            library,
            joined,
            own,
            coordinates,
            renamed: wire.renamed,
            starred: wire.starred,
            space,
            axes,
            authored,
            selected,
            solo: wire.solo,
            compared: wire.compared,
            snapshots,
            unknown: wire.unknown,
        },
        warnings,
    })
}

/// SHA-256 of bytes, in hexadecimal digits.
pub fn sha256_hex(bytes: &[u8]) -> String {
    let nibbles = Sha256::digest(bytes).into_iter().flat_map(|byte| [byte >> 4, byte & 15]);
    nibbles.filter_map(|nibble| char::from_digit(u32::from(nibble), 16)).collect()
}

impl From<HeaderFault> for ProjectError {
    fn from(fault: HeaderFault) -> Self {
        match fault {
            HeaderFault::TooDense(reason) | HeaderFault::Damaged(reason) => Self::Damaged { reason },
            HeaderFault::Format(found) => Self::Format { found },
            HeaderFault::Version(found) => Self::Version { found },
            HeaderFault::Major(found) => Self::Major { found },
        }
    }
}

fn check_units(units: &UnitsV1) -> Result<(), ProjectError> {
    for (found, (quantity, expected)) in [&units.length, &units.time].into_iter().zip(UNITS) {
        if found != expected {
            return Err(ProjectError::Unit { quantity, found: found.clone(), expected });
        }
    }
    Ok(())
}

fn library(
    wire: ProjectLibraryV1,
    folder: &Path,
    read: &dyn Fn(&Path) -> io::Result<Vec<u8>>,
    warnings: &mut Vec<String>,
) -> Result<ProjectLibrary, ProjectError> {
    match wire {
        ProjectLibraryV1 { built_in: Some(id), .. } => {
            BuiltIn::from_id(&id).map(ProjectLibrary::BuiltIn).ok_or(ProjectError::BuiltIn { found: id })
        }
        ProjectLibraryV1 { inside: Some(wire), .. } => {
            let imported =
                library_inside(*wire).map_err(|source| ProjectError::Library { path: None, source })?;
            warnings.extend(imported.warnings);
            Ok(ProjectLibrary::Inside(Arc::new(imported.value)))
        }
        ProjectLibraryV1 { file: Some(file), sha256: told, .. } => {
            let stated = path_json::from_json(&file)
                .ok_or_else(|| ProjectError::Damaged { reason: "`library.file` is not a path".to_owned() })?;
            let host = host_of(&stated);
            if host.is_some() && host != host_of(folder) {
                return Err(ProjectError::Network { path: stated });
            }
            let path = folder.join(stated);
            let file = library_file(path, read, warnings)?;
            if told.is_some_and(|told| told != file.sha256) {
                warnings.push(format!(
                    "the library of the project was changed since the project was saved: {}",
                    file.path.display()
                ));
            }
            Ok(ProjectLibrary::File(Arc::new(file)))
        }
        ProjectLibraryV1 { .. } => Err(ProjectError::NoLibrary),
    }
}

/// Maximum number of points of a drawn path.
const MAX_PATH_POINTS: usize = 10_000;

/// Name of the other computer that a path of Windows names, in lower case; `None` for a path on this computer. Opening
/// such a path would send the user's name and password hash there. It is recognized on every system, so that a project
/// is refused everywhere.
fn host_of(path: &Path) -> Option<String> {
    let bytes = path.as_os_str().as_encoded_bytes();
    let is_slash = |byte: &u8| matches!(byte, b'/' | b'\\');
    let [first, second, rest @ ..] = bytes else { return None };
    // `\\\\?\\C:\\…` and `\\\\.\\C:\\…` are on this computer.
    let is_drive = matches!(rest, [b'?' | b'.', slash, _, b':', ..] if is_slash(slash));
    if !is_slash(first) || !is_slash(second) || is_drive {
        return None;
    }
    let named = rest.split(is_slash).filter(|part| !part.is_empty());
    let mut parts = named.map(|part| String::from_utf8_lossy(part).to_lowercase());
    let host = parts.next()?;
    // `\\\\?\\UNC\\server\\share` is `\\\\server\\share`.
    if host != "?" && host != "." {
        return Some(host);
    }
    parts.find(|part| part != "unc")
}

#[cfg(test)]
#[test]
fn paths_of_other_computers_are_known() {
    for (path, expected) in [
        (r"\\Server\share\woods.json", Some("server")),
        ("//server/share/woods.json", Some("server")),
        (r"\\?\UNC\server\share", Some("server")),
        (r"\\.\UNC\server\share", Some("server")),
        (r"/\server\share", Some("server")),
        (r"\\?\C:\woods.json", None),
        (r"\\.\C:\woods.json", None),
        (r"C:\woods.json", None),
        ("/home/woods.json", None),
        ("woods.json", None),
    ] {
        assert_eq!(host_of(Path::new(path)).as_deref(), expected, "{path}");
    }
}

/// Reads a library from a separate file.
fn library_file(
    path: PathBuf,
    read: &dyn Fn(&Path) -> io::Result<Vec<u8>>,
    warnings: &mut Vec<String>,
) -> Result<LibraryFile, ProjectError> {
    let bytes = match read(&path) {
        Ok(bytes) => bytes,
        Err(source) => return Err(ProjectError::LibraryFile { path, source }),
    };
    match read_library(&bytes) {
        Ok(imported) => {
            warnings.extend(imported.warnings);
            Ok(LibraryFile { sha256: sha256_hex(&bytes), path, library: imported.value })
        }
        Err(source) => Err(ProjectError::Library { path: Some(path), source }),
    }
}

fn placed_space(wire: PlacedSpaceV1) -> Result<PlacedSpace, LibraryError> {
    let axes = attributes::axes(wire.axes)?;
    let n_axes = axes.as_ref().map_or(USUAL_AXES.len(), Vec::len);
    let mut textures = Vec::with_capacity(wire.textures.len());
    for texture in wire.textures {
        // Unknown fields of positions that were computed in the project are dropped.
        let mut unknown = Unknown::default();
        let place = place(&texture.id, texture.space, &mut unknown)?;
        check_count(&texture.id, &place, n_axes)?;
        let of_wire = |wire| attributes::read(&texture.id, wire, &mut unknown);
        let attributes: Option<Attributes> = texture.attributes.map(of_wire).transpose()?;
        textures.push(PlacedTexture { id: texture.id, place, attributes });
    }
    Ok(PlacedSpace { textures, axes, report: wire.report })
}

fn check_keys(authored: &[Arc<AuthoredTexture>]) -> Result<(), ProjectError> {
    let mut names: HashMap<u32, &str> = HashMap::new();
    for texture in authored {
        if let Some(first) = names.insert(texture.key, &texture.name) {
            return Err(ProjectError::Key {
                first: first.to_owned(),
                second: texture.name.clone(),
                key: texture.key,
            });
        }
    }
    Ok(())
}

pub(super) fn authored_texture(wire: AuthoredV1) -> Result<AuthoredTexture, ProjectError> {
    let name = wire.name;
    let at = wire.at.point().map_err(|source| ProjectError::Place { name: name.clone(), source })?;
    if wire.color >= N_COLORS {
        return Err(ProjectError::Number {
            name,
            field: "color",
            value: f64::from(wire.color),
            needs: "it must be 0 to 7",
        });
    }
    let mut unknown = wire.unknown;
    let shape = shape::read(wire.shape, &mut unknown)
        .map_err(|source| ProjectError::Shape { name: name.clone(), source })?;
    Ok(AuthoredTexture {
        key: wire.key,
        color: wire.color,
        notes: wire.notes,
        tags: wire.tags,
        at,
        axes: None,
        blend: blend(&name, wire.blend)?,
        shape,
        path: wire.path.map(|wire| drawn_path(&name, at.n_axes(), wire)).transpose()?,
        picture: wire.picture.map(|wire| own_picture(&name, wire)).transpose()?,
        unknown,
        name,
    })
}

/// A snapshot, which may have axes of its own.
fn snapshot(mut wire: AuthoredV1) -> Result<AuthoredTexture, ProjectError> {
    let axes = wire.axes.take();
    let texture = authored_texture(wire)?;
    let n = texture.at.n_axes();
    if axes.as_ref().is_some_and(|axes| axes.len() != n || !axes::are_possible(axes)) {
        return Err(ProjectError::SnapshotAxes { name: texture.name, n });
    }
    Ok(AuthoredTexture { axes, ..texture })
}

fn blend(name: &str, wire: BlendV1) -> Result<BlendChoice, ProjectError> {
    let word =
        |field, found: String, expected| ProjectError::Word { name: name.to_owned(), field, found, expected };
    let mode = Mode::from_id(&wire.mode)
        .ok_or_else(|| word("blend.mode", wire.mode, "field, parametric, shared, power or paper"))?;
    let weights: Weights = of_word(WEIGHTS, &wire.weights)
        .ok_or_else(|| word("blend.weights", wire.weights, "barycentric or natural"))?;
    let outside: Outside = of_word(OUTSIDES, &wire.outside)
        .ok_or_else(|| word("blend.outside", wire.outside, "clamped or extrapolated"))?;
    Ok(BlendChoice { mode, weights, outside, locked: wire.locked })
}

fn of_word<T: Copy>(words: [(T, &str); 2], found: &str) -> Option<T> {
    words.into_iter().find(|(_, word)| *word == found).map(|(value, _)| value)
}

fn drawn_path(name: &str, n_axes: usize, wire: DrawnPathV1) -> Result<UserPath, ProjectError> {
    let word = |field, found: &str, expected| ProjectError::Word {
        name: name.to_owned(),
        field,
        found: found.to_owned(),
        expected,
    };
    let along =
        Along::from_id(&wire.along).ok_or_else(|| word("path.along", &wire.along, "distance or time"))?;
    let at_end = AtEnd::from_id(&wire.at_end)
        .ok_or_else(|| word("path.at_end", &wire.at_end, "hold, turn or repeat"))?;
    for (field, value) in [("length_mm", wire.length_mm), ("length_s", wire.length_s)] {
        // This form of the comparison also rejects NaN.
        if !(value > 0.0 && value.is_finite()) {
            let name = name.to_owned();
            return Err(ProjectError::Number { name, field, value, needs: "it must be greater than zero" });
        }
    }
    if wire.points.len() > MAX_PATH_POINTS {
        return Err(ProjectError::PathPoints {
            name: name.to_owned(),
            n: wire.points.len(),
            most: MAX_PATH_POINTS,
        });
    }
    let point = |(index, coordinates): (usize, Vec<f64>)| {
        let (name, number, n) = (name.to_owned(), index + 1, coordinates.len());
        if n != n_axes {
            return Err(ProjectError::PathPointCount { name, number, n, expected: n_axes });
        }
        let point = match coordinates[..] {
            // Errors of a point on two axes say what the ends of the usual axes mean.
            [first, second] => SpacePoint::new(first, second),
            _ => SpacePoint::of(&coordinates),
        };
        point.map_err(|source| ProjectError::PathPoint { name, number, source })
    };
    Ok(UserPath {
        points: wire.points.into_iter().enumerate().map(point).collect::<Result<_, _>>()?,
        along,
        length_m: wire.length_mm / 1e3,
        length_secs: wire.length_s,
        at_end,
    })
}

fn own_picture(name: &str, wire: PictureV1) -> Result<Arc<Picture>, ProjectError> {
    picture(name, wire, &mut Unknown::default())
        .map(Arc::new)
        .map_err(|source| ProjectError::Library { path: None, source })
}
