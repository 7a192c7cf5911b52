//! Drags of the point and of the shape: a worker makes their textures, and the previous one plays until they are ready.

use std::time::Duration;

use egui::{Context, Event, Modifiers, PointerButton, Pos2, RawInput};
use shagreen_core::space::texture_path::UserPath;
use shagreen_core::texture::blend::Mode;
use shagreen_core::texture::plane::{Grain, Plane};
use shagreen_core::texture::shape::ShapeControl;
use shagreen_core::units::{Contact, Hertz, MetersPerSecond, Newtons};
use shagreen_formats::project::Project;

use super::follow_until_ready;
use super::shaped_reliefs::follow_until_prepared;
use crate::session::Session;
use crate::session::audible::Audible;
use crate::state::edit::{Edit, PathChange, edited};
use crate::state::signal_file::Sounding;
use shagreen_studio::project::new_project;

const CONTACT: Contact = Contact { speed: MetersPerSecond(0.1), force: Newtons(1.0) };

fn frame(ctx: &Context, events: Vec<Event>) {
    let mut output = ctx.run_ui(RawInput { events, ..RawInput::default() }, |_| {});
    output.textures_delta.clear();
}

/// Context in whose last frame a button of the pointer was pressed.
fn pressed() -> Context {
    let ctx = Context::default();
    let (pos, button, modifiers) = (Pos2::ZERO, PointerButton::Primary, Modifiers::NONE);
    frame(&ctx, vec![Event::PointerButton { pos, button, pressed: true, modifiers }]);
    ctx
}

/// Context in which a button of the pointer was pressed before its last frame, and is held.
fn held() -> Context {
    let ctx = pressed();
    frame(&ctx, Vec::new());
    ctx
}

/// Project with the point moved by a distance along the first axis.
fn moved(project: &Project, distance: f64) -> Project {
    let at = project.texture().at;
    edited(project, Edit::MovePoint(at.with(0, at.x() + distance)))
}

/// New project, and a session that plays it.
fn ready() -> (Session, Project) {
    let project = new_project();
    let mut session = Session::new(project.library.clone()).unwrap();
    follow_until_ready(&mut session, &project);
    (session, project)
}

/// Numbers of the textures that play and are not those of the library.
fn numbers(session: &Session) -> Vec<u64> {
    session.sound.heard.made.iter().map(|made| made.number).collect()
}

/// Grain of the only texture that plays.
fn heard(session: &Session) -> Grain {
    let [voice] = &session.sound.heard.voices[..] else { panic!("one texture plays") };
    voice.plane.at(CONTACT)
}

/// Grain of the texture at the point.
fn at_point(session: &Session) -> Grain {
    let authored = session.authored.current.as_ref().unwrap();
    Plane::new(authored.model.as_ref().unwrap()).at(CONTACT)
}

#[test]
fn the_previous_texture_plays_until_the_worker_has_made_that_of_a_dragged_point() {
    let (mut session, begun) = ready();
    let (ctx, first, before) = (held(), numbers(&session), heard(&session));
    session.follow(&moved(&begun, 1.0), None, &ctx);
    assert!(session.authored.audible.is_behind());
    assert_eq!((numbers(&session), heard(&session)), (first.clone(), before));
    assert_ne!(heard(&session), at_point(&session));
    for distance in [2.0, 3.0, 4.0] {
        session.follow(&moved(&begun, distance), None, &ctx);
        assert_eq!(session.sound.heard.voices.len(), 1, "it is never silent");
    }
    follow_until_prepared(&mut session, &moved(&begun, 4.0));
    assert_eq!(heard(&session), at_point(&session));
    assert!(numbers(&session)[0] > first[0], "the output must not take it for the previous one");
}

#[test]
fn what_is_saved_during_a_drag_is_the_texture_at_the_point() {
    let (mut session, begun) = ready();
    let dragged = moved(&begun, 1.0);
    session.follow(&dragged, None, &held());
    assert!(session.authored.audible.is_behind());
    let file = session.signal(&dragged, None, CONTACT).unwrap();
    let Sounding::Mix(voices, Mode::Shared) = file.sounding else { panic!("a signal of voices") };
    assert_eq!(voices.len(), 1);
    assert_eq!(voices[0].0.at(CONTACT), at_point(&session));
    assert_ne!(voices[0].0.at(CONTACT), heard(&session), "the previous texture plays");
    let model = session.authored.current.as_ref().unwrap().model.as_ref();
    assert_eq!(Some(&session.texture_entry(&dragged, None).unwrap().model), model);
}

/// Asserts that the texture at the point plays.
#[track_caller]
fn check(session: &Session, what: &str) {
    assert!(!session.authored.audible.is_behind(), "{what}");
    assert_eq!(heard(session), at_point(session), "{what}");
}

#[test]
fn everything_but_a_drag_plays_at_once() {
    let (mut session, begun) = ready();
    session.follow(&moved(&begun, 1.0), None, &Context::default());
    check(&session, "a step by a key");
    session.follow(&moved(&begun, 2.0), None, &pressed());
    check(&session, "a press");
    let ctx = held();
    let other = moved(&begun, 3.0);
    session.follow(&other, Some(other.texture()), &ctx);
    check(&session, "a comparison or a study");
    session.set_hidden(true);
    session.follow(&moved(&begun, 4.0), None, &ctx);
    check(&session, "a hidden texture");
    session.set_hidden(false);
    session.sound.heard = Audible::default();
    session.follow(&moved(&begun, 5.0), None, &ctx);
    check(&session, "the first texture");
    let path = UserPath { points: vec![begun.texture().at, other.texture().at], ..UserPath::default() };
    let on_path = edited(&moved(&begun, 6.0), Edit::ChangePath(PathChange::Draw, Some(path)));
    session.play_path(true);
    session.follow(&on_path, None, &ctx);
    check(&session, "a path");
    session.play_path(false);
    let averaged = edited(&moved(&begun, 7.0), Edit::SetMode(Mode::Parametric));
    session.follow(&averaged, None, &ctx);
    check(&session, "another mode");
    session.follow(&moved(&averaged, 1.0), None, &ctx);
    assert!(session.authored.audible.is_behind(), "a drag does not");
    // A change that plays at once replaces the texture of the drag, also if its worker still runs.
    session.follow(&moved(&averaged, 2.0), None, &Context::default());
    check(&session, "after a drag");
    std::thread::sleep(Duration::from_millis(50));
    session.follow(&moved(&averaged, 2.0), None, &ctx);
    check(&session, "later");
}

/// In a mode that mixes textures of the library, each of them is made in the shape.
#[test]
fn a_dragged_control_of_the_shape_leaves_textures_of_the_library_to_the_worker() {
    let (ctx, mixed) = (held(), edited(&new_project(), Edit::SetMode(Mode::Shared)));
    let shaped = |level_db: f64| edited(&mixed, Edit::SetShape(ShapeControl::Level, level_db));
    let psd = |session: &Session| session.sound.heard.psd(CONTACT, &[60.0, 150.0, 300.0].map(Hertz));
    let mut session = Session::new(mixed.library.clone()).unwrap();
    session.follow(&shaped(-6.0), None, &Context::default());
    let (first, before) = (numbers(&session), psd(&session));
    assert!(first.len() > 1 && !session.authored.audible.is_behind());
    let louder = shaped(-3.0);
    session.follow(&louder, None, &ctx);
    assert!(session.authored.audible.is_behind());
    assert_eq!((numbers(&session), psd(&session)), (first.clone(), before.clone()));
    follow_until_prepared(&mut session, &louder);
    assert!(numbers(&session).iter().all(|number| !first.contains(number)));
    for (after, before) in psd(&session).iter().zip(&before) {
        assert!((10.0 * (after / before).log10() - 3.0).abs() < 1e-6, "{after} and {before}");
    }
    // They are kept while only their weights change.
    let made = numbers(&session);
    session.follow(&moved(&louder, 0.01), None, &ctx);
    assert!(!session.authored.audible.is_behind());
    assert_eq!(numbers(&session), made);
}
