//! Check of files for other programs against the rules of their formats.
//!
//! To add a format, add a line to [`CHECKED_FORMATS`].

mod clips;

use std::path::Path;

use anyhow::{Context as _, bail};
use shagreen_core::words::counted;
use shagreen_formats::bounded_file::FileKind;
use shagreen_formats::haptic_maps::{ReferredFile, check_gltf};
use shagreen_formats::hjif::{Hjif, check_hjif};

use self::clips::{checked_ahap, checked_haptic};
use crate::file::{ending_of, in_file, read_file};

/// A format whose files can be checked.
#[derive(Clone, Copy, Debug)]
pub struct CheckedFormat {
    /// Identifier for scripts, also the ending of its files.
    pub id: &'static str,
    /// Name of the format.
    pub name: &'static str,
    check: fn(&[u8], &Path) -> anyhow::Result<Checked>,
}

/// Content of a file, and the rules that it breaks.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Checked {
    /// Content in a few words.
    pub about: String,
    /// Broken rules with their places, at most some hundred of them.
    pub faults: Vec<String>,
    /// Imperfections that players ignore.
    pub warnings: Vec<String>,
    /// Number of all places at which a rule is broken.
    pub n_faults: usize,
}

/// All formats whose files can be checked.
pub static CHECKED_FORMATS: [CheckedFormat; 4] = [
    CheckedFormat { id: "hjif", name: "MPEG haptics (HJIF)", check: checked_hjif },
    CheckedFormat { id: "gltf", name: "glTF scene with haptic materials", check: checked_gltf },
    CheckedFormat { id: "haptic", name: "haptic clips, version 1", check: |bytes, _| checked_haptic(bytes) },
    CheckedFormat { id: "ahap", name: "AHAP patterns", check: |bytes, _| checked_ahap(bytes) },
];

/// Checks a file, whose ending names the format.
///
/// # Errors
/// The ending is of no format that can be checked, or the file cannot be read at all. Broken rules are no error.
pub fn check_file(path: &Path) -> anyhow::Result<(CheckedFormat, Checked)> {
    let ending = ending_of(path);
    let Some(format) = CHECKED_FORMATS.into_iter().find(|format| format.id == ending) else {
        let endings = CHECKED_FORMATS.map(|format| format!(".{}", format.id)).join(", ");
        bail!(
            "files with this ending cannot be checked; choose a file with one of these: {endings}: {}",
            path.display()
        );
    };
    let bytes = read_file(path, FileKind::Document)?;
    let checked = (format.check)(&bytes, path).with_context(|| in_file(path))?;
    Ok((format, checked))
}

fn checked_hjif(bytes: &[u8], _: &Path) -> anyhow::Result<Checked> {
    let checked = check_hjif(bytes)?;
    let faults = checked.faults.iter().map(ToString::to_string).collect();
    let about = about_hjif(&checked.file);
    Ok(Checked { about, faults, warnings: Vec::new(), n_faults: checked.n_faults })
}

fn about_hjif(file: &Hjif) -> String {
    let channels = file.perceptions.iter().flat_map(|perception| &perception.channels);
    let in_bands = channels.clone().flat_map(|channel| &channel.bands).map(|band| band.effects.len());
    let in_libraries = file.perceptions.iter().map(|perception| perception.effect_library.len());
    [
        counted(file.perceptions.len(), "perception"),
        counted(channels.count(), "channel"),
        counted(in_bands.sum(), "effect"),
        format!("{} in libraries", counted(in_libraries.sum(), "effect")),
    ]
    .join(", ")
}

fn checked_gltf(bytes: &[u8], path: &Path) -> anyhow::Result<Checked> {
    let scene = check_gltf(bytes)?;
    let missing: Vec<String> = scene.files.iter().filter_map(|file| missing(file, path)).collect();
    let about = [counted(scene.n_haptic_materials, "haptic material"), counted(scene.files.len(), "file")];
    let n_faults = scene.n_faults + missing.len();
    let faults = scene.faults.iter().map(ToString::to_string).chain(missing).collect();
    Ok(Checked { about: about.join(", "), faults, warnings: Vec::new(), n_faults })
}

/// Says that a file to which a scene refers does not exist or is too short.
fn missing(file: &ReferredFile, scene: &Path) -> Option<String> {
    let ReferredFile { place, name, least_bytes } = file;
    let Ok(metadata) = scene.with_file_name(name).metadata() else {
        return Some(format!("{place}: there is no file \"{name}\" beside the scene; copy it there"));
    };
    let n_bytes = metadata.len();
    (n_bytes < *least_bytes).then(|| {
        format!("{place}: the file \"{name}\" has {n_bytes} bytes, fewer than {least_bytes}; copy it again")
    })
}

#[cfg(test)]
mod tests {
    use super::{CHECKED_FORMATS, check_file};
    use std::fs;

    #[test]
    fn broken_rules_and_missing_files_are_listed() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("oak.gltf");
        let buffers = r#""buffers": [{"uri": "my%20oak.bin", "byteLength": 140}]"#;
        fs::write(&path, format!("{{\"asset\": {{\"version\": \"2.0\"}}, {buffers}}}")).unwrap();
        let faults = || check_file(&path).unwrap().1.faults;
        assert!(faults()[0].contains("no file \"my oak.bin\""), "{:?}", faults());
        fs::write(folder.path().join("my oak.bin"), [0; 139]).unwrap();
        assert!(faults()[0].contains("139 bytes"), "{:?}", faults());
        fs::write(folder.path().join("my oak.bin"), [0; 140]).unwrap();
        assert!(faults().is_empty());

        let path = folder.path().join("OAK.HJIF");
        let file = r#"{"version": "2022", "profile": "Main", "level": 3, "date": "2026", "description": "",
            "avatars": [], "perceptions": [], "syncs": []}"#;
        fs::write(&path, file).unwrap();
        let (format, checked) = check_file(&path).unwrap();
        assert_eq!((format.id, checked.n_faults), ("hjif", 2));
        assert_eq!(checked.about, "0 perceptions, 0 channels, 0 effects, 0 effects in libraries");
        assert!(checked.faults[1].starts_with("level: "), "{:?}", checked.faults);
    }

    #[test]
    fn other_files_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let refused = |name: &str| format!("{:#}", check_file(&folder.path().join(name)).unwrap_err());
        let text = refused("oak.wav");
        assert!(CHECKED_FORMATS.iter().all(|format| text.contains(format.id)), "{text}");
        for format in CHECKED_FORMATS {
            let name = format!("oak.{}", format.id);
            assert!(refused(&name).contains("no such file"));
            fs::write(folder.path().join(&name), "my notes").unwrap();
            assert!(refused(&name).contains("choose another file"));
        }
    }
}
