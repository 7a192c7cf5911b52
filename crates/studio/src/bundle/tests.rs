use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use shagreen_core::space::SpacePoint;
use shagreen_core::space::texture_path::UserPath;
use shagreen_formats::bundle::{Bundle, BundleRole};
use shagreen_formats::library::{Library, Provenance, write_library};
use shagreen_formats::picture::{Picture, PictureFormat};
use shagreen_formats::project::{AuthoredTexture, Project, ProjectLibrary, write_project};
use shagreen_formats::starter::starter_library;

use super::{BundleOptions, BundleSource, Bundled, bundle, check_bundle, extract_bundle};
use crate::open::{Opened, open};
use crate::permitted_libraries::Permitted;
use crate::project::new_project;
use crate::report::Warnings;

fn options(exports: &[PathBuf]) -> BundleOptions<'_> {
    BundleOptions { name: "Woods", created_by: "test", exports, overrides_restriction: false }
}

fn bundled(source: &BundleSource, options: &BundleOptions<'_>) -> anyhow::Result<Bundled> {
    bundle(source, options, &Warnings::default())
}

/// A project in a folder with a library beside it, where the authored texture lies on the texture with the index `on`.
fn project_on_file(folder: &Path, library: &Library, on: usize) -> BundleSource {
    fs::create_dir_all(folder.join("data")).unwrap();
    fs::write(folder.join("data/My woods.json"), write_library(library)).unwrap();
    let Opened::Library(imported) = open(&folder.join("data/My woods.json"), &Permitted::All).unwrap() else {
        panic!("this is a library");
    };
    let mut project = Project::new(ProjectLibrary::File(imported.value.into()), "Mine");
    let picture =
        Picture { width: 1, height: 1, millimeters: 20.0, format: PictureFormat::Png, bytes: vec![1, 2] };
    let authored = AuthoredTexture {
        at: library.textures[on].at().unwrap(),
        picture: Some(Arc::new(picture)),
        ..AuthoredTexture::new(7, "Mine")
    };
    project.authored = vec![Arc::new(authored)];
    BundleSource::Project(Box::new(project))
}

#[test]
fn a_project_comes_back_with_its_library() {
    let folder = tempfile::tempdir().unwrap();
    let library = starter_library().unwrap();
    let source = project_on_file(folder.path(), &library, 3);
    let export = folder.path().join("run 1");
    fs::create_dir(&export).unwrap();
    fs::write(export.join("a.wav"), b"RIFF").unwrap();
    fs::write(export.join(".hidden"), b"").unwrap();
    let made = bundled(&source, &options(std::slice::from_ref(&export))).unwrap();
    let again = bundled(&source, &options(&[export])).unwrap();
    assert_eq!(made.bytes, again.bytes);
    let paths: Vec<&str> = made.manifest.files.iter().map(|file| file.path.as_str()).collect();
    assert!(paths.contains(&"exports/run 1/a.wav") && paths.contains(&"library/my-woods.json"), "{paths:?}");
    assert!(
        paths.contains(&"pictures/026-authored-7-mine.png") && paths.contains(&"woods.shagreen"),
        "{paths:?}"
    );
    assert!(!paths.iter().any(|path| path.contains("hidden")), "{paths:?}");
    let authored = made.manifest.textures.last().unwrap();
    assert!(authored.authored && authored.parents.contains(&library.textures[3].id), "{authored:?}");
    assert_eq!(made.manifest.textures.len(), 26);

    let file = folder.path().join("woods.zip");
    fs::write(&file, &made.bytes).unwrap();
    assert_eq!(check_bundle(&file).unwrap(), made.manifest);
    let unpacked = folder.path().join("unpacked");
    assert_eq!(extract_bundle(&file, &unpacked).unwrap(), made.manifest);
    let Opened::Project(opened) =
        open(&unpacked.join("woods.shagreen"), &Permitted::Only(Vec::new())).unwrap()
    else {
        panic!("this is a project");
    };
    assert_eq!(opened.warnings, Vec::<String>::new());
    assert_eq!(opened.project.library.read().unwrap(), library);
    // Nothing is written over what is there.
    let error = extract_bundle(&file, &unpacked).unwrap_err().to_string();
    assert!(error.contains("could be overwritten"), "{error}");
    let mut damaged = made.bytes;
    let middle = damaged.len() / 2;
    damaged[middle] ^= 1;
    fs::write(&file, &damaged).unwrap();
    assert!(check_bundle(&file).is_err());
    let other = folder.path().join("other");
    assert!(extract_bundle(&file, &other).is_err() && !other.exists());
}

#[test]
fn built_in_and_embedded_libraries_stay_what_they_are() {
    let made = bundled(&BundleSource::Project(Box::new(new_project())), &options(&[])).unwrap();
    assert_eq!(made.manifest.files.len(), 1);
    let mut library = starter_library().unwrap();
    library.textures.truncate(4);
    let inside = Project::new(ProjectLibrary::Inside(Arc::new(library.clone())), "Mine");
    let made = bundled(&BundleSource::Project(Box::new(inside)), &options(&[])).unwrap();
    let n_pictures = library.textures.iter().filter(|entry| entry.picture.is_some()).count();
    assert_eq!(made.manifest.files.len(), 1 + n_pictures);
    let made = bundled(&BundleSource::Library(Box::new(library.clone())), &options(&[])).unwrap();
    let mut opened = Bundle::open(&made.bytes).unwrap();
    let index = opened.manifest().files.iter().position(|file| file.role == BundleRole::Library).unwrap();
    assert_eq!(opened.file(index).unwrap(), write_library(&library));
    assert_eq!(made.manifest.licence, library.license);
}

#[test]
fn restricted_textures_stop_a_bundle_unless_their_owner_says_otherwise() {
    let folder = tempfile::tempdir().unwrap();
    let mut library = starter_library().unwrap();
    library.textures[3].provenance = Provenance::Restricted;
    let name = library.textures[3].name.clone();
    let source = project_on_file(folder.path(), &library, 3);
    let error = bundled(&source, &options(&[])).map(drop).unwrap_err().to_string();
    for words in
        ["must not be redistributed", &format!("1 texture: \"{name}\""), "1 authored texture: \"Mine\""]
    {
        assert!(error.contains(words), "{words}: {error}");
    }
    let overriding = BundleOptions { overrides_restriction: true, ..options(&[]) };
    let manifest = bundled(&source, &overriding).unwrap().manifest;
    let stated = manifest.override_restriction.unwrap();
    assert_eq!(stated.textures, [name, "Mine".to_owned()]);
    assert!(manifest.textures[3].restricted && manifest.textures.last().unwrap().restricted);
    let error = bundled(&BundleSource::Library(Box::new(library)), &options(&[])).map(drop).unwrap_err();
    assert!(error.to_string().contains("1 texture"), "{error}");
}

/// The path of an authored texture leads through others than its position.
#[test]
fn a_path_is_made_of_all_textures_along_it() {
    let library = starter_library().unwrap();
    let at = |index: usize| -> SpacePoint { library.textures[index].at().unwrap() };
    let mut project = new_project();
    let path = UserPath { points: vec![at(3), at(9)], ..UserPath::default() };
    let authored = AuthoredTexture { at: at(3), path: Some(path), ..AuthoredTexture::new(1, "Way") };
    project.authored = vec![Arc::new(authored)];
    let made = bundled(&BundleSource::Project(Box::new(project)), &options(&[])).unwrap();
    let parents = &made.manifest.textures.last().unwrap().parents;
    assert!([3, 9].iter().all(|index| parents.contains(&library.textures[*index].id)), "{parents:?}");
}

#[test]
fn an_added_file_that_says_it_is_restricted_stops_a_bundle() {
    let folder = tempfile::tempdir().unwrap();
    let mut library = starter_library().unwrap();
    library.textures[0].provenance = Provenance::Restricted;
    let project = Project::new(ProjectLibrary::Inside(Arc::new(library)), "Mine");
    let path = folder.path().join("other.shagreen");
    fs::write(&path, write_project(&project, folder.path(), "test")).unwrap();
    let source = BundleSource::Project(Box::new(new_project()));
    let error = bundled(&source, &options(std::slice::from_ref(&path))).map(drop).unwrap_err().to_string();
    assert!(error.contains("1 added file: \"exports/other.shagreen\""), "{error}");
    fs::write(&path, b"notes").unwrap();
    assert!(bundled(&source, &options(&[path])).is_ok());
    let error = bundled(&source, &options(&[folder.path().join("none")])).map(drop).unwrap_err();
    assert!(format!("{error:#}").contains("no such file"), "{error:#}");
}
