//! Reduced motion: a choice of the user, or else of the desktop.

use std::path::Path;

use egui_kittest::kittest::Queryable as _;
use shagreen_app::Begin;
use shagreen_app::state::files::StoragePaths;
use shagreen_app::strings::{document, motion};
use shagreen_formats::settings::read_settings;
use shagreen_studio::project::new_project;

use crate::support::{Author, begin, click, wait, window_of};

fn opened(folder: &Path) -> Author {
    let keeping = StoragePaths {
        settings: Some(folder.join("settings.json")),
        desktop: Some(folder.to_owned()),
        ..StoragePaths::default()
    };
    window_of(Begin { keeping, ..begin(new_project()) }, [1280.0, 720.0])
}

fn is_animated(harness: &Author) -> bool {
    harness.ctx.global_style().animation_time > 0.0
}

#[test]
fn motion_is_reduced_as_the_user_or_the_desktop_asks() {
    let folder = tempfile::tempdir().unwrap();
    let settings = folder.path().join("settings.json");
    std::fs::write(&settings, r#"{"has_seen_tour": true}"#).unwrap();
    assert!(is_animated(&opened(folder.path())));
    std::fs::write(folder.path().join("kdeglobals"), "[KDE]\nAnimationDurationFactor=0\n").unwrap();
    let mut harness = opened(folder.path());
    assert!(!is_animated(&harness), "the desktop asks for it");
    for is_reduced in [false, true, false] {
        click(&mut harness, document::FILE);
        harness.run_steps(2);
        assert!(harness.query_by_label(motion::REDUCE).is_some());
        click(&mut harness, motion::REDUCE);
        harness.run_steps(2);
        assert_eq!(is_animated(&harness), !is_reduced);
    }
    wait(&mut harness, "it is remembered", |_| {
        std::fs::read(&settings).is_ok_and(|bytes| read_settings(&bytes).0.reduces_motion == Some(false))
    });
    drop(harness);
    assert!(is_animated(&opened(folder.path())), "the choice of the user counts more");
}
