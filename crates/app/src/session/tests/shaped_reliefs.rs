//! Height maps of textures of the library in a shape, which a worker prepares.

use std::sync::Arc;
use std::time::{Duration, Instant};

use shagreen_core::space::{LabelSource, SpacePoint};
use shagreen_core::texture::blend::Mode;
use shagreen_core::texture::height_map::{HeightMap, HeightMapOptions};
use shagreen_core::texture::shape::ShapeControl;
use shagreen_core::units::{Contact, MetersPerSecond, Newtons};
use shagreen_formats::library::{Place, TextureEntry};
use shagreen_formats::project::Project;
use shagreen_formats::starter::starter_library;

use super::follow_until_ready;
use crate::session::Session;
use crate::state::edit::{Edit, edited};
use crate::state::signal_file::Sounding;
use shagreen_studio::project::new_project;

const SIDE_M: f64 = 0.02;

/// Project whose texture is exactly an added one with a height map, in a mode without a model.
fn on_relief() -> Project {
    let base = starter_library().unwrap().textures[3].clone();
    let heights_m = (0..256).map(|i| 1e-6 * f64::from(i % 16)).collect();
    let map = HeightMap::new(heights_m, SIDE_M, HeightMapOptions::HARD_PLASTIC).unwrap();
    let at = SpacePoint::new(43.0, 57.0).unwrap();
    let entry = TextureEntry {
        id: "relief".to_owned(),
        place: Some(Place::new(at, LabelSource::Estimated)),
        model: base.model.clone().with_height_map(Some(Arc::new(map))),
        ..base
    };
    let edits = [Edit::AddTextures(vec![Arc::new(entry)]), Edit::MovePoint(at), Edit::SetMode(Mode::Shared)];
    edits.into_iter().fold(new_project(), |project, edit| edited(&project, edit))
}

/// Sides of the height maps that play, in m.
fn sides_m(session: &Session) -> Vec<f64> {
    let planes = session.sound.heard.voices.iter().map(|voice| &voice.plane);
    planes.filter_map(|plane| Some(plane.height_map()?.side_m())).collect()
}

/// Follows a project until what it plays is prepared.
pub(super) fn follow_until_prepared(session: &mut Session, project: &Project) {
    let (ctx, begun) = (egui::Context::default(), Instant::now());
    while session.authored.audible.is_behind() {
        assert!(begun.elapsed() < Duration::from_mins(1), "it is prepared");
        session.follow(project, None, &ctx);
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// At each value of the slider, the worker makes the texture. Meanwhile the previous one plays.
#[test]
fn a_relief_of_the_library_is_stretched_by_the_worker() {
    let ctx = egui::Context::default();
    let plain = on_relief();
    let mut session = Session::new(plain.library.clone()).unwrap();
    session.follow(&plain, None, &ctx);
    assert_eq!(sides_m(&session), [SIDE_M]);
    let mut before = SIDE_M;
    for grain in [2.0, 2.5] {
        let shaped = edited(&plain, Edit::SetShape(ShapeControl::Grain, grain));
        session.follow(&shaped, None, &ctx);
        assert!(session.authored.audible.is_behind());
        assert_eq!(sides_m(&session), [before], "{grain}");
        follow_until_prepared(&mut session, &shaped);
        before = grain * SIDE_M;
        assert_eq!(sides_m(&session), [before], "{grain}");
        // It is kept while its weight changes.
        let at = SpacePoint::new(43.1, 57.0).unwrap();
        session.follow(&edited(&shaped, Edit::MovePoint(at)), None, &ctx);
        assert!(!session.authored.audible.is_behind());
        session.follow(&shaped, None, &ctx);
    }
}

#[test]
fn a_signal_is_that_of_the_texture_while_its_height_map_is_prepared() {
    let ctx = egui::Context::default();
    let contact = Contact { speed: MetersPerSecond(0.1), force: Newtons(1.0) };
    let plain = on_relief();
    let mut session = Session::new(plain.library.clone()).unwrap();
    follow_until_ready(&mut session, &plain);
    let shaped = edited(&plain, Edit::SetShape(ShapeControl::Grain, 2.0));
    session.follow(&shaped, None, &ctx);
    assert!(session.authored.audible.is_behind());
    let Ok(Sounding::Mix(voices, Mode::Shared)) =
        session.signal(&shaped, None, contact).map(|file| file.sounding)
    else {
        panic!("a signal of voices");
    };
    let sides_m: Vec<f64> = voices.iter().map(|(plane, _)| plane.height_map().unwrap().side_m()).collect();
    assert_eq!(sides_m, [2.0 * SIDE_M]);
}
