use std::path::Path;

use shagreen_core::units::Contact;
use shagreen_studio::export::WAV;

use super::paths::has_ending;
use super::{ExportSheet, ExportSubject};
use crate::state::audible_texture::AudibleTexture;

/// Sheet for two authored textures, with this path.
fn sheet(path: &Path) -> ExportSheet {
    let missing = || "missing".to_owned();
    let audible = AudibleTexture {
        name: "Oak".to_owned(),
        signal: Err(missing()),
        entry: Err(missing()),
        has_path: false,
    };
    let contact = Contact::default();
    let subject = ExportSubject { audible, is_solo: false, n_authored: 2, contact };
    let mut sheet = ExportSheet::new(subject, WAV, Path::new("/home/u"), "oak");
    assert_eq!(Path::new(sheet.path.text()), Path::new("/home/u/oak.wav"));
    sheet.path.set(path);
    sheet
}

#[test]
fn only_the_ending_of_a_format_makes_a_file() {
    for (path, folder) in [
        ("/home/u/oak.wav", Some("/home/u")),
        ("/home/u/OAK.WAV", Some("/home/u")),
        ("/home/u/oak.android.json", Some("/home/u")),
        ("/home/u/.wav", None),
        ("/home/u/set.v2", None),
        ("/home/u/set", None),
    ] {
        assert_eq!(sheet(Path::new(path)).folder().as_deref(), folder.map(Path::new), "{path}");
    }
}

#[test]
fn a_name_with_dots_comes_back_whole() {
    let path = Path::new("/home/u/a.b.wav");
    let mut sheet = sheet(path);
    for (is_all, shown) in [(true, Path::new("/home/u")), (false, path)] {
        sheet.is_all = is_all;
        sheet.follow_number();
        assert_eq!(Path::new(sheet.path.text()), shown);
    }
}

#[test]
fn the_ending_follows_the_format_and_may_have_dots() {
    for (path, ending, expected) in [
        ("/home/u/oak.wav", "wav", true),
        ("/home/u/oak.android.json", "android.json", true),
        ("/home/u/oak.json", "android.json", false),
        ("/home/u/oakwav", "wav", false),
        ("/home/u/.wav", "wav", false),
    ] {
        assert_eq!(has_ending(Path::new(path), ending), expected, "{path}");
    }
}
