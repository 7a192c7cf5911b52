//! Strokes in a folder and its subfolders, grouped by texture.

use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use shagreen_core::words::counted;

use crate::recording::directional::name::{Quantity, StrokeName, stroke_of};

/// Greatest depth of subfolders that are searched. Links to folders are not followed, so there are no circles.
const MAX_DEPTH: usize = 8;

/// Largest number of tables in a folder: about three times those of the largest published data set of this layout.
const MAX_FILES: usize = 200_000;

/// Endings of tables in lower case.
const ENDINGS: [&str; 3] = ["csv", "tsv", "txt"];

/// Files of one stroke.
#[derive(Clone, Debug, PartialEq)]
pub struct StrokeFiles {
    /// What the names of the files state.
    pub name: StrokeName,
    /// Table of accelerations.
    pub acceleration: PathBuf,
    /// Table of forces, if there is one.
    pub force: Option<PathBuf>,
    /// Table of positions, if there is one.
    pub position: Option<PathBuf>,
}

/// Strokes on one texture.
#[derive(Clone, Debug, PartialEq)]
pub struct TextureStrokes {
    /// Name of the texture as the files write it.
    pub texture: String,
    /// Strokes by direction, speed, force and repeat; at least one.
    pub strokes: Vec<StrokeFiles>,
}

/// Strokes in a folder.
#[derive(Clone, Debug, PartialEq)]
pub struct StrokeFolder {
    /// Textures by name; at least one.
    pub textures: Vec<TextureStrokes>,
    /// Tables that are no strokes, by their names and folders; sorted.
    pub others: Vec<PathBuf>,
    /// Sentences for the user on tables of strokes that are not used.
    pub warnings: Vec<String>,
}

/// Why a folder has no strokes.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StrokeFolderError {
    /// A folder cannot be listed.
    #[error("cannot list the folder {}: {source}; check its name and your permissions", folder.display())]
    List {
        /// The folder.
        folder: PathBuf,
        /// Reason of the system.
        source: io::Error,
    },
    /// There are more tables than a data set has.
    #[error("the folder has more than {MAX_FILES} tables; choose the folder of the strokes")]
    TooMany,
    /// No table is the acceleration of a stroke.
    #[error(
        "the folder has no acceleration of a stroke among {}; name the files TEXTURE_DIRECTION_SPEED_FORCE_REPEAT with mm/s and mN, as in cork_45_20_200_1.csv, in a folder named acceleration",
        counted(*n_tables, "table")
    )]
    NoStrokes {
        /// Number of tables in the folder.
        n_tables: usize,
    },
}

impl StrokeFiles {
    /// Paths of all files, the acceleration first.
    pub fn paths(&self) -> impl Iterator<Item = &PathBuf> {
        std::iter::once(&self.acceleration).chain(&self.force).chain(&self.position)
    }

    /// Path of the file of a quantity, or that of the acceleration if there is none.
    pub fn path_of(&self, quantity: Quantity) -> &Path {
        let path = match quantity {
            Quantity::Acceleration => None,
            Quantity::Force => self.force.as_deref(),
            Quantity::Position => self.position.as_deref(),
        };
        path.unwrap_or(&self.acceleration)
    }
}

impl TextureStrokes {
    /// Directions as they are written, in alphabetical order.
    pub fn directions(&self) -> BTreeSet<&str> {
        self.strokes.iter().map(|stroke| stroke.name.direction.as_str()).collect()
    }
}

impl StrokeFolder {
    /// Whether a file in the folder is no table of a stroke. The path begins with that of the folder.
    pub fn is_other(&self, path: &Path) -> bool {
        !is_table(path) || self.others.binary_search_by(|other| other.as_path().cmp(path)).is_ok()
    }
}

/// Sentence for the user on [`StrokeFolder::others`] that are not used; `None` without any.
pub fn unused_others(others: &[PathBuf]) -> Option<String> {
    unused(others, "the name and the folders do not state a stroke and a quantity")
}

/// Finds the strokes in a folder and its subfolders, and groups their files.
///
/// # Errors
/// See [`StrokeFolderError`].
pub fn find_strokes(folder: &Path) -> Result<StrokeFolder, StrokeFolderError> {
    let mut tables = Vec::new();
    walk(folder, 0, &mut tables)?;
    tables.sort();
    let n_tables = tables.len();
    let found = grouped(folder, tables);
    if found.textures.is_empty() { Err(StrokeFolderError::NoStrokes { n_tables }) } else { Ok(found) }
}

/// Collects the tables in a folder and its subfolders.
fn walk(folder: &Path, depth: usize, tables: &mut Vec<PathBuf>) -> Result<(), StrokeFolderError> {
    let list = |source: io::Error| StrokeFolderError::List { folder: folder.to_owned(), source };
    for entry in fs::read_dir(folder).map_err(list)? {
        let entry = entry.map_err(list)?;
        let (kind, path) = (entry.file_type().map_err(list)?, entry.path());
        if kind.is_dir() {
            if depth < MAX_DEPTH {
                walk(&path, depth + 1, tables)?;
            }
        } else if is_table(&path) {
            if tables.len() == MAX_FILES {
                return Err(StrokeFolderError::TooMany);
            }
            tables.push(path);
        }
    }
    Ok(())
}

fn is_table(path: &Path) -> bool {
    let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
    ENDINGS.iter().any(|known| known.eq_ignore_ascii_case(ending))
}

/// Texture, direction, speed in μm/s, force in μN and repeat, in the order of the result.
type Key = (String, String, u64, u64, u32);

/// Groups tables by stroke, and strokes by texture.
fn grouped(folder: &Path, tables: Vec<PathBuf>) -> StrokeFolder {
    let mut strokes: BTreeMap<Key, (StrokeName, BTreeMap<Quantity, PathBuf>)> = BTreeMap::new();
    let (mut others, mut doubles, mut lonely) = (Vec::new(), Vec::new(), Vec::new());
    // The name of the folder itself may be the quantity.
    let above = folder.parent().unwrap_or(Path::new(""));
    for path in tables {
        let Some((name, quantity)) = path.strip_prefix(above).ok().and_then(stroke_of) else {
            others.push(path);
            continue;
        };
        let (_, files) = strokes.entry(key(&name)).or_insert_with(|| (name, BTreeMap::new()));
        match files.entry(quantity) {
            Entry::Vacant(free) => {
                free.insert(path);
            }
            Entry::Occupied(_) => doubles.push(path),
        }
    }
    let mut textures: Vec<TextureStrokes> = Vec::new();
    for (name, mut files) in strokes.into_values() {
        let Some(acceleration) = files.remove(&Quantity::Acceleration) else {
            lonely.extend(files.into_values());
            continue;
        };
        let (force, position) = (files.remove(&Quantity::Force), files.remove(&Quantity::Position));
        let texture = name.texture.clone();
        let stroke = StrokeFiles { name, acceleration, force, position };
        match textures.last_mut().filter(|last| last.texture == texture) {
            Some(last) => last.strokes.push(stroke),
            None => textures.push(TextureStrokes { texture, strokes: vec![stroke] }),
        }
    }
    let warnings = [
        unused(&doubles, "another file has this quantity of the same stroke"),
        unused(&lonely, "the stroke has no acceleration"),
    ];
    StrokeFolder { textures, others, warnings: warnings.into_iter().flatten().collect() }
}

fn key(name: &StrokeName) -> Key {
    let micro = |value: f64| (1e6 * value).round() as u64;
    let (texture, direction) = (name.texture.clone(), name.direction.clone());
    (texture, direction, micro(name.speed.0), micro(name.force.0), name.repeat)
}

/// Sentence for the user on tables that are not used, for one reason.
fn unused(tables: &[PathBuf], reason: &str) -> Option<String> {
    let first = tables.first()?;
    Some(format!("{} not used: {reason}, first {}", counted(tables.len(), "table"), first.display()))
}
