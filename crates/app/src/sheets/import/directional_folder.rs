//! Folder of strokes in several directions, whose textures are fitted one after another.

use std::collections::BTreeMap;
use std::path::PathBuf;

use shagreen_core::recording::fit::FitOptions;
use shagreen_formats::library::TextureEntry;
use shagreen_formats::recording::directional::{
    StrokeFolder, StrokeFolderError, find_strokes, unused_others,
};
use shagreen_studio::import::directional::{
    DirectionalError, DirectionalOptions, directions_of, import_texture,
};

use crate::state::source::{Source, files_in};
use crate::strings::import as strings;

/// Folder with strokes, or with a fault that hides them.
pub(super) struct FoundFolder {
    /// The strokes, or why they cannot be searched.
    pub(super) strokes: Result<StrokeFolder, String>,
    /// Other files directly in the folder that can be imported.
    pub(super) files: Vec<Source>,
}

/// Texture of a folder.
pub(super) struct FolderTexture {
    /// Name as the files write it.
    pub(super) name: String,
    /// The texture and warnings in sentences, or why it cannot be fitted.
    pub(super) made: Result<(TextureEntry, Vec<String>), String>,
}

/// Strokes and other files in a folder; `None` for a file, and for a folder without strokes.
pub(super) fn strokes_in(source: &Source) -> Option<FoundFolder> {
    let folder = source.path();
    if !folder.is_dir() {
        return None;
    }
    match find_strokes(folder) {
        Ok(mut found) => {
            let files = files_in(folder, |path| found.is_other(path)).unwrap_or_default();
            let is_deeper = |path: &&PathBuf| path.parent() != Some(folder);
            let deeper: Vec<PathBuf> = found.others.iter().filter(is_deeper).cloned().collect();
            found.warnings.extend(unused_others(&deeper));
            Some(FoundFolder { strokes: Ok(found), files })
        }
        Err(StrokeFolderError::NoStrokes { .. }) => None,
        Err(error) => {
            let files = files_in(folder, |_| true).unwrap_or_default();
            Some(FoundFolder { strokes: Err(error.to_string()), files })
        }
    }
}

/// Textures of a folder, each fitted when the iterator reaches it.
pub(super) fn textures(found: StrokeFolder) -> impl Iterator<Item = FolderTexture> {
    let named = directions_of(&found.textures);
    let options =
        DirectionalOptions { fit: FitOptions::usual(), stated_deg: BTreeMap::new(), license: String::new() };
    // Files that are not used concern the folder; the first texture shows them.
    let mut of_folder = found.warnings;
    found.textures.into_iter().map(move |texture| {
        let done = import_texture(&texture, &named, &options);
        let mut warnings = std::mem::take(&mut of_folder);
        let failed = done.failed.into_iter();
        warnings.extend(failed.map(|(file, reason)| format!("not imported: {reason}: {}", file.display())));
        let made = done.texture.map_err(|error| reason_of(&error)).map(|made| {
            warnings.extend(done.warnings);
            (made.entry, warnings)
        });
        FolderTexture { name: texture.texture, made }
    })
}

/// An error with what to do about it.
fn reason_of(error: &DirectionalError) -> String {
    match error {
        DirectionalError::UnknownDirections(_) => format!("{error}; {}", strings::STATE_DIRECTIONS),
        _ => error.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::{reason_of, strokes_in, textures};
    use crate::state::source::Source;
    use shagreen_studio::import::directional::DirectionalError;

    #[test]
    fn a_folder_of_strokes_is_told_from_one_of_recordings_and_keeps_its_other_files() {
        let folder = tempfile::tempdir().unwrap();
        let source = Source::Path(folder.path().to_owned());
        let file = folder.path().join("stroke.csv");
        std::fs::write(&file, "").unwrap();
        assert!(strokes_in(&source).is_none() && strokes_in(&Source::Path(file)).is_none());
        let strokes = folder.path().join("acceleration");
        std::fs::create_dir(&strokes).unwrap();
        for name in ["cork_0_20_200_1.csv", "notes.txt"] {
            std::fs::write(strokes.join(name), "time,X,Y,Z\n").unwrap();
        }
        for name in ["cork_0_20_200_1_force.csv", "map.toml", "oak.wav"] {
            std::fs::write(folder.path().join(name), "time,force\n").unwrap();
        }
        let found = strokes_in(&source).unwrap();
        let names: Vec<String> = found.files.iter().map(Source::name).collect();
        assert_eq!(names, ["map.toml", "oak.wav", "stroke.csv"]);
        let found = found.strokes.unwrap();
        assert!(found.warnings.len() == 1 && found.warnings[0].contains("notes.txt"), "{:?}", found.warnings);
        let made: Vec<_> = textures(found).collect();
        assert_eq!((made.len(), made[0].name.as_str()), (1, "cork"));
        // The table is empty.
        let reason = made[0].made.as_ref().unwrap_err();
        assert!(reason.contains("cork_0_20_200_1.csv"), "{reason}");
    }

    #[test]
    fn unknown_directions_are_stated_elsewhere() {
        let reason = reason_of(&DirectionalError::UnknownDirections(vec!["first".to_owned()]));
        assert!(reason.contains("directions first;") && reason.contains("shagreen import directional"));
        assert!(!reason.contains("--direction"), "{reason}");
    }
}
