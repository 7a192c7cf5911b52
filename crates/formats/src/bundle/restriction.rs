//! What files say about the restriction of their content.

use super::Bundle;
use crate::batch_record::BatchRecordV1;
use crate::hatt::RESTRICTED_TERMS;
use crate::runtime_table::is_restricted_table;

/// How libraries and projects mark a restricted texture, on a line of its own or on a longer one.
const MARKS: [&[u8]; 2] = [b"\"provenance\": \"restricted\"", b"\"provenance\":\"restricted\""];

/// Returns whether a file of this program says that it was made from data that must not be redistributed: a library or a project of
/// one of its textures, the terms of use in a model or beside a signal, a runtime table, the record of a batch, or a bundle.
pub fn is_restricted_file(bytes: &[u8]) -> bool {
    let has = |text: &[u8]| bytes.windows(text.len()).any(|window| window == text);
    MARKS.into_iter().any(has)
        || has(RESTRICTED_TERMS.as_bytes())
        || is_restricted_table(bytes)
        || BatchRecordV1::read(bytes).is_some_and(|record| !record.restricted.is_empty())
        || Bundle::open(bytes).is_ok_and(|bundle| {
            let manifest = bundle.manifest();
            manifest.override_restriction.is_some() || manifest.textures.iter().any(|of| of.restricted)
        })
}

#[cfg(test)]
mod tests {
    use std::path::Path;
    use std::sync::Arc;

    use super::is_restricted_file;
    use crate::batch_record::{BatchRecordV1, FORMAT, VERSION};
    use crate::bundle::{BundleKind, BundleManifestV1, OverrideV1, write_bundle};
    use crate::hatt::write_hatt;
    use crate::library::{Library, Provenance, write_library};
    use crate::project::{Project, ProjectLibrary, write_project};
    use crate::runtime_table::write_runtime_table;
    use crate::starter::starter_library;

    #[test]
    fn files_say_that_they_are_restricted() {
        let mut library = starter_library().unwrap();
        library.textures.truncate(2);
        let files = |library: &Library| {
            let project = Project::new(ProjectLibrary::Inside(Arc::new(library.clone())), "One");
            [
                write_library(library),
                write_project(&project, Path::new("a"), "test"),
                write_hatt(&library.textures[1], "test").unwrap(),
                write_runtime_table(&library.textures[1], "test").unwrap(),
            ]
        };
        assert!(files(&library).iter().all(|bytes| !is_restricted_file(bytes)));
        library.textures[1].provenance = Provenance::Restricted;
        assert!(files(&library).iter().all(|bytes| is_restricted_file(bytes)));
        assert!(!is_restricted_file(b""));
    }

    #[test]
    fn records_of_batches_and_other_bundles_say_so_too() {
        let record = |restricted: &[&str]| {
            let of = BatchRecordV1 {
                format: FORMAT.to_owned(),
                version: VERSION.to_owned(),
                inputs: String::new(),
                files: Vec::new(),
                licence: String::new(),
                restricted: restricted.iter().map(|name| (*name).to_owned()).collect(),
                lost: Vec::new(),
                warnings: Vec::new(),
            };
            is_restricted_file(&of.to_bytes())
        };
        assert_eq!((record(&[]), record(&["Oak, measured"])), (false, true));
        let bundle = |override_restriction| {
            let manifest = BundleManifestV1::new("test", "Woods", BundleKind::Library);
            let manifest = BundleManifestV1 { override_restriction, ..manifest };
            is_restricted_file(&write_bundle(manifest, Vec::new()).unwrap())
        };
        let shared = OverrideV1 { textures: vec!["Oak".to_owned()], statement: "Mine.".to_owned() };
        assert_eq!((bundle(None), bundle(Some(shared))), (false, true));
    }
}
