//! A changed project file that names another library.

use shagreen_formats::built_in::BuiltIn;
use shagreen_formats::project::{Project, ProjectLibrary};

use super::support::wait;
use super::{Came, Document};
use crate::choices::conflict::{Change, Part};
use crate::state::edit::{Edit, edited};

/// The library is not read, because the user has not permitted it, and the projects are still compared.
#[test]
fn a_changed_file_with_another_library_is_compared() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("Woods.shagreen");
    let ctx = egui::Context::default();
    let begun = Project::new(ProjectLibrary::BuiltIn(BuiltIn::Starter), "New texture");
    let mut document = Document::new(&begun, None);
    document.save(&begun, path.clone(), &ctx);
    assert!(matches!(wait(&mut document), Came::Saved(_)));
    for library in ["/nowhere/mine.json", "//server/share/mine.json"] {
        let mut wire: serde_json::Value = serde_json::from_slice(&std::fs::read(&path).unwrap()).unwrap();
        wire["library"] = serde_json::json!({ "file": library });
        std::fs::write(&path, wire.to_string()).unwrap();
        document.save(&edited(&begun, Edit::Rename("Oak".to_owned())), path.clone(), &ctx);
        let Came::Conflict(conflict) = wait(&mut document) else { panic!("a conflict") };
        let found = conflict.differences.unwrap();
        assert!(
            found.iter().any(|one| (&one.part, one.change) == (&Part::Library, Change::There)),
            "{found:?}"
        );
    }
}
