//! What the tests of documents share: reading a project file, and waiting for the background.

use std::path::Path;
use std::time::Instant;

use shagreen_formats::project::Project;
use shagreen_studio::open::{Opened, open};
use shagreen_studio::permitted_libraries::Permitted;

use super::{Came, Document, DocumentFile};

pub(super) fn read(path: &Path) -> (Project, DocumentFile) {
    let Ok(Opened::Project(opened)) = open(path, &Permitted::All) else {
        panic!("{} is no project", path.display())
    };
    (opened.project, DocumentFile { path: path.to_owned(), sha256: Some(opened.sha256) })
}

pub(super) fn wait(document: &mut Document) -> Came {
    let begun = Instant::now();
    loop {
        if let Some(came) = document.collect() {
            return came;
        }
        assert!(begun.elapsed().as_secs() < 20, "nothing came");
        std::thread::yield_now();
    }
}
