mod dragged_points;
mod exact_textures;
mod further_axes;
mod messages;
mod shaped_reliefs;
mod unheard_spaces;

use std::sync::Arc;

use shagreen_core::space::{LabelSource, SpacePoint};
use shagreen_core::texture::blend::Mode;
use shagreen_core::texture::rate::at_rate;
use shagreen_core::texture::shape::{Shape, ShapeControl};
use shagreen_core::units::{Contact, Hertz, MetersPerSecond, Newtons};
use shagreen_device::track::PenSample;
use shagreen_formats::actuator_toml::built_in_actuators;
use shagreen_formats::built_in::BuiltIn;
use shagreen_formats::library::{Attribute, Attributes, Library, Place, TextureEntry};
use shagreen_formats::project::{AuthoredTexture, Project, ProjectLibrary};
use shagreen_formats::starter::starter_library;

use super::{OutputChoice, Session};
use crate::state::axes_change::AxesChange;
use crate::state::edit::{Edit, edited};
use crate::state::recorder::LONGEST_SECS;
use crate::state::rig::{Mounted, Rig};
use crate::strings::stroke;
use shagreen_studio::project::new_project;

fn starter() -> ProjectLibrary {
    ProjectLibrary::BuiltIn(BuiltIn::Starter)
}

/// Project with an embedded library.
fn project_on(library: Library) -> Project {
    Project { library: ProjectLibrary::Inside(library.into()), ..new_project() }
}

/// First eight textures of the starter library, six of them rated. The last rated one has twice the sample rate and no
/// position.
fn mixed_library() -> Library {
    let mut library = starter_library().unwrap();
    library.textures.truncate(8);
    for (i, texture) in library.textures[..6].iter_mut().enumerate() {
        let value = |name: &str, value: usize| Attribute { name: name.to_owned(), value: value as f64 };
        let values = vec![value("flat-bumpy", i * 17 % 100), value("warm-cold", i * 61 % 100)];
        texture.attributes = Some(Attributes { source: LabelSource::HumanRatings, values });
    }
    let fast = &mut library.textures[5];
    fast.place = None;
    fast.model = at_rate(&fast.model, Hertz(2000.0)).unwrap().model;
    library
}

/// Edit that chooses these axes.
fn set_axes(project: &Project, session: &Session, axes: &[&str]) -> Edit {
    let axes: Vec<String> = axes.iter().map(|name| (*name).to_owned()).collect();
    let change = AxesChange::new(project, session.library(), &session.positions(), &axes);
    Edit::SetAxes(Box::new(change))
}

/// The axes determine which textures are interpolated, and thereby the sample rate. Undo restores everything.
#[test]
fn axes_take_places_and_rate_along_and_give_them_back() {
    let ctx = egui::Context::default();
    let placed = project_on(mixed_library());
    let mut session = Session::new(placed.library.clone()).unwrap();
    session.follow(&placed, None, &ctx);
    let (library, space) = (session.library().clone(), session.space().clone());
    let planes = session.textures.planes.clone();
    assert_eq!((session.space_rate_hz(), session.sound.rate_hz), (1000.0, 1000.0));
    assert_eq!(session.label_source(), "physical labels");

    let turned = edited(&placed, set_axes(&placed, &session, &["warm-cold", "flat-bumpy"]));
    session.follow(&turned, None, &ctx);
    assert_eq!((session.space_rate_hz(), session.sound.rate_hz), (2000.0, 2000.0));
    assert_eq!(session.label_source(), "human ratings");
    let sites: Vec<usize> = session.space().sites().iter().map(|(texture, _)| *texture).collect();
    assert_eq!(sites, [0, 1, 2, 3, 4, 5]);
    assert_eq!(session.poles(), &[["warm", "cold"], ["flat", "bumpy"]]);
    assert_eq!(session.library(), &library, "what a file of it holds is as it was");
    assert!(Arc::ptr_eq(&session.textures.planes[5], &planes[5]), "this one has the rate already");
    assert!(!Arc::ptr_eq(&session.textures.planes[0], &planes[0]));

    session.follow(&placed, None, &ctx);
    assert_eq!((session.library(), session.space()), (&library, &space));
    assert_eq!((session.space_rate_hz(), session.sound.rate_hz), (1000.0, 1000.0));
}

/// An added texture with a higher sample rate than the space is left out of it, with a message.
#[test]
fn a_texture_too_fast_for_the_space_stays_out() {
    let ctx = egui::Context::default();
    let mut library = mixed_library();
    let mut fast = library.textures.remove(5);
    fast.place = library.textures[0].place;
    let begun = project_on(library);
    let mut session = Session::new(begun.library.clone()).unwrap();
    let project = edited(&begun, Edit::AddTextures(vec![Arc::new(fast)]));
    session.follow(&project, None, &ctx);
    assert_eq!(session.space().position(7), None);
    assert_eq!(session.space_rate_hz(), 1000.0);
    assert!(session.message().is_some_and(|message| message.contains("cannot be mixed")));
    session.follow(&begun, None, &ctx);
    assert_eq!(session.textures().len(), 7);
}

/// Another library replaces positions and their source, an added texture gets a unique id, and undo restores
/// everything.
#[test]
fn another_library_is_opened_and_the_first_comes_back() {
    let ctx = egui::Context::default();
    let mut first = mixed_library();
    first.name = "Mine".to_owned();
    first.textures.retain(|texture| texture.id != "glass");
    let joined = Arc::new(starter_library().unwrap().textures[0].clone());
    assert_eq!(joined.id, "glass");
    let begun = project_on(first);
    let mut session = Session::new(begun.library.clone()).unwrap();
    let mine = edited(&begun, Edit::AddTextures(vec![Arc::clone(&joined)]));
    session.follow(&mine, None, &ctx);
    let (library, space) = (session.library().clone(), session.space().clone());

    let simulated = edited(&mine, Edit::OpenLibrary(ProjectLibrary::BuiltIn(BuiltIn::Simulated)));
    assert_eq!((simulated.texture().at, simulated.joined.len()), (mine.texture().at, 1));
    session.follow(&simulated, None, &ctx);
    assert_eq!(session.base(), &ProjectLibrary::BuiltIn(BuiltIn::Simulated));
    assert_eq!(session.other_libraries(), std::slice::from_ref(&begun.library));
    assert_eq!(session.label_source(), "mixed, not comparable");
    assert!(session.is_simulated());
    let read = BuiltIn::Simulated.read().unwrap();
    assert_eq!(session.textures()[..25], read.textures[..]);
    assert_eq!(session.textures()[25].id, "glass-2");
    assert_eq!(session.textures()[25].model, joined.model);
    assert_eq!(session.library().space_report, read.space_report);
    let planes = session.textures.planes.clone();

    // The same materials at other positions need no new preparation.
    let on_starter = edited(&simulated, Edit::OpenLibrary(starter()));
    session.follow(&on_starter, None, &ctx);
    assert!(planes.iter().zip(&session.textures.planes).all(|(a, b)| Arc::ptr_eq(a, b)));
    assert_eq!(session.label_source(), "physical labels");
    assert_eq!(session.library().space_report, None);

    session.follow(&mine, None, &ctx);
    assert_eq!((session.library(), session.space()), (&library, &space));
    assert_eq!((session.base(), session.label_source()), (&begun.library, "physical labels"));
    assert!(session.other_libraries().is_empty(), "those of the program are always offered");
    session.follow(&simulated, None, &ctx);
    assert_eq!(session.textures()[..25], read.textures[..]);
}

/// Opening a library resets the space in use, axes that it does not have, and solo, which belong to the previous textures.
#[test]
fn a_library_is_opened_as_its_file_has_it() {
    let ctx = egui::Context::default();
    let begun = Project { library: ProjectLibrary::BuiltIn(BuiltIn::Simulated), ..new_project() };
    let mut session = Session::new(begun.library.clone()).unwrap();
    let axes = set_axes(&begun, &session, &["hard-soft", "flat-bumpy"]);
    let id = session.textures()[3].id.clone();
    let edits = [Edit::SetMode(Mode::Shared), axes, Edit::Solo(Some(id))];
    let turned = edits.into_iter().fold(begun, |project, edit| edited(&project, edit));
    session.follow(&turned, None, &ctx);
    let opened = edited(&turned, Edit::OpenLibrary(starter()));
    assert_eq!((&opened.axes, &opened.solo), (&None, &None));
    session.follow(&opened, None, &ctx);
    assert_eq!(session.library(), &starter_library().unwrap());
    assert_eq!(session.authored().unwrap().parents.len(), 3);
    session.follow(&turned, None, &ctx);
    assert_eq!(session.parent_rank(3), Some(0));
    assert_eq!(session.poles()[0], ["hard", "soft"]);
}

/// A new name holds in the session, and undo removes it.
#[test]
fn a_texture_is_renamed_and_named_as_before() {
    let ctx = egui::Context::default();
    let begun = new_project();
    let mut session = Session::new(begun.library.clone()).unwrap();
    session.follow(&begun, None, &ctx);
    let (planes, id) = (session.textures.planes.clone(), session.textures()[2].id.clone());
    let named = edited(&begun, Edit::RenameTexture { id, name: "Mine".to_owned() });
    session.follow(&named, None, &ctx);
    assert_eq!(session.textures()[2].name, "Mine");
    assert!(
        planes.iter().zip(&session.textures.planes).all(|(a, b)| Arc::ptr_eq(a, b)),
        "it is the same texture"
    );
    session.follow(&begun, None, &ctx);
    assert_eq!(session.library(), &starter_library().unwrap());
}

/// In every mode the audible textures have the shape. Library textures in a shape are made once and not at every movement
/// of the point.
#[test]
fn all_that_is_audible_has_the_shape() {
    let ctx = egui::Context::default();
    let contact = Contact { speed: MetersPerSecond(0.1), force: Newtons(1.0) };
    let frequencies = [Hertz(60.0), Hertz(150.0), Hertz(300.0)];
    let begun = new_project();
    let mut session = Session::new(begun.library.clone()).unwrap();
    follow_until_ready(&mut session, &begun);
    for mode in Mode::ALL {
        let plain = edited(&begun, Edit::SetMode(mode));
        session.follow(&plain, None, &ctx);
        let before = session.sound.heard.psd(contact, &frequencies);
        let shaped = edited(&plain, Edit::SetShape(ShapeControl::Level, -6.0));
        session.follow(&shaped, None, &ctx);
        let after = session.sound.heard.psd(contact, &frequencies);
        for (a, b) in after.iter().zip(&before) {
            assert!((10.0 * (a / b).log10() + 6.0).abs() < 1e-6, "{mode:?}: {a} and {b}");
        }
        let numbers = |session: &Session| -> Vec<u64> {
            session.sound.heard.made.iter().map(|made| made.number).collect()
        };
        let made = numbers(&session);
        assert_eq!(made.len(), session.sound.heard.voices.len(), "{mode:?}: all of them are made");
        let mut at = shaped.texture().at;
        at = at.with(0, at.x() + 0.01);
        session.follow(&edited(&shaped, Edit::MovePoint(at)), None, &ctx);
        assert_eq!(numbers(&session) == made, !mode.makes_a_model(), "{mode:?}");
        session.follow(&plain, None, &ctx);
        assert_eq!(session.sound.heard.psd(contact, &frequencies), before, "{mode:?}: undone");
        assert_eq!(numbers(&session).is_empty(), !mode.makes_a_model());
    }
}

/// A texture that plays alone is as the library has it.
#[test]
fn a_soloed_texture_has_no_shape() {
    let ctx = egui::Context::default();
    let shaped = edited(&new_project(), Edit::SetShape(ShapeControl::Grain, 3.0));
    let mut session = Session::new(shaped.library.clone()).unwrap();
    let id = session.textures()[3].id.clone();
    session.follow(&edited(&shaped, Edit::Solo(Some(id))), None, &ctx);
    assert_eq!(session.authored().unwrap().shape, Shape::default());
    assert!(session.sound.heard.made.is_empty());
    assert!(Arc::ptr_eq(&session.sound.heard.voices[0].plane, &session.textures.planes[3]));
}

/// Follows a project until the models of its selected texture are there.
fn follow_until_ready(session: &mut Session, project: &Project) {
    let ctx = egui::Context::default();
    let start = std::time::Instant::now();
    session.follow(project, None, &ctx);
    while session.is_preparing() {
        assert!(start.elapsed().as_secs() < 300, "the field is computed");
        session.begin_work(&ctx);
        session.follow(project, None, &ctx);
        std::thread::yield_now();
    }
}

/// A generated texture belongs to the authored texture that it was made for. The models of the others are kept, and the
/// switch changes them until it is undone.
#[test]
fn a_generated_texture_changes_no_other_authored_texture() {
    let ctx = egui::Context::default();
    let contact = Contact { speed: MetersPerSecond(0.1), force: Newtons(1.0) };
    let frequencies = [Hertz(60.0), Hertz(150.0), Hertz(300.0)];
    let generated = |id: &str, at: SpacePoint| {
        let texture = starter_library().unwrap().textures[3].clone();
        let place = Some(Place::new(at, LabelSource::Estimated));
        Arc::new(TextureEntry { id: id.to_owned(), place, ..texture })
    };
    let [first, second] = [(40.0, 60.0), (43.0, 57.0)].map(|(rs, hs)| SpacePoint::new(rs, hs).unwrap());
    let join = |key: u32, id: &str, at| Edit::JoinSimulated { key, entry: generated(id, at), earlier: None };
    let one = [join(1, "first", first), Edit::MovePoint(SpacePoint::new(42.0, 58.0).unwrap())];
    let one = one.into_iter().fold(new_project(), |project, edit| edited(&project, edit));
    let mut session = Session::new(one.library.clone()).unwrap();
    let heard = |session: &Session| {
        let authored = session.authored().cloned().unwrap();
        (authored, session.sound.heard.psd(contact, &frequencies))
    };
    let entry = |session: &Session, project: &Project| {
        session.authored_sources(project, contact).unwrap().entries().unwrap().remove(0)
    };
    follow_until_ready(&mut session, &one);
    let (before, exported) = (heard(&session), entry(&session, &one));
    assert!(before.0.parents.iter().any(|(texture, _)| *texture == 25), "its own takes part");

    let another = AuthoredTexture { blend: one.blend_of_new(), ..AuthoredTexture::new(0, "Second") };
    assert!(another.blend.locked.is_empty());
    let two = [Edit::Author(Box::new(another)), join(2, "second", second), Edit::Solo(None)];
    let two = two.into_iter().fold(one.clone(), |project, edit| edited(&project, edit));
    follow_until_ready(&mut session, &two);
    let of_second = session.authored().unwrap().clone();
    assert!(of_second.parents.iter().all(|(texture, _)| *texture != 25), "nor does the first change it");
    assert_eq!(entry(&session, &two), exported);
    // Models that are not kept are computed for an export.
    let mut later = Session::new(two.library.clone()).unwrap();
    follow_until_ready(&mut later, &two);
    assert_eq!(entry(&later, &two), exported);
    let back = edited(&two, Edit::Select(1));
    session.follow(&back, None, &ctx);
    assert!(!session.is_preparing(), "the models of the first are kept");
    assert_eq!(heard(&session), before);
    assert_eq!((session.left_out(&back.texture().blend), session.position(26)), (vec![26], Some(second)));
    assert_eq!(session.space().position(26), None);

    let switch = Edit::SetOwn { joined: 1, name: "Second".to_owned(), is_own: false };
    assert_eq!(switch.label(&back), "Use Second in whole space");
    let everywhere = edited(&back, switch);
    follow_until_ready(&mut session, &everywhere);
    assert_ne!(heard(&session), before);
    assert!(session.authored().unwrap().parents.iter().any(|(texture, _)| *texture == 26));
    session.follow(&back, None, &ctx);
    assert!(!session.is_preparing() && heard(&session) == before, "undone");

    // Another library keeps the pins of what belongs to the authored textures.
    let opened = edited(&back, Edit::OpenLibrary(ProjectLibrary::BuiltIn(BuiltIn::Simulated)));
    assert!(opened.texture().blend.locked.contains("first"));
    let removed = edited(&back, Edit::RemoveTexture(1));
    assert!(!removed.own.contains("second") && removed.own.contains("first"));
}

/// Updates the session until the condition holds.
fn go_on(session: &mut Session, what: &str, is_so: impl Fn(&Session) -> bool) {
    let begun = std::time::Instant::now();
    while !is_so(session) {
        assert!(begun.elapsed().as_secs() < 30, "{what}");
        session.update(Contact { speed: MetersPerSecond(0.1), force: Newtons(1.0) });
        std::thread::yield_now();
    }
}

fn null() -> OutputChoice {
    OutputChoice::Id("null".to_owned())
}

fn frames(session: &Session) -> Option<u32> {
    session.stream().and_then(|(.., frames)| frames)
}

/// A change of the device setup while an output is being opened opens the same output again.
#[test]
fn a_rig_that_changes_during_the_opening_holds_for_what_was_asked_for() {
    let ctx = egui::Context::default();
    let mut session = Session::new(starter()).unwrap();
    session.open_output(null(), &ctx);
    session.set_rig(Rig { buffer_frames: 512, ..Rig::default() }, &ctx);
    go_on(&mut session, "it opens", |s| !s.is_opening() && s.status().is_some());
    assert_eq!(frames(&session), Some(512));
}

/// An output that was let go of during its opening is reopened on request, even before it was closed.
#[test]
fn an_output_that_was_let_go_of_during_the_opening_comes_back() {
    let ctx = egui::Context::default();
    let mut session = Session::new(starter()).unwrap();
    session.open_output(null(), &ctx);
    session.let_go_of_output();
    session.set_rig(Rig { buffer_frames: 128, ..Rig::default() }, &ctx);
    session.take_output_back(&ctx);
    go_on(&mut session, "it opens", |s| !s.is_opening() && s.status().is_some());
    assert_eq!(frames(&session), Some(128));
    session.let_go_of_output();
    session.set_rig(Rig::default(), &ctx);
    go_on(&mut session, "it is closed", Session::is_output_released);
    assert!(session.status().is_none() && !session.is_opening(), "a change of the rig takes nothing back");
}

/// An actuator that cannot be driven closes the output, even the first one. Another actuator reopens it.
#[test]
fn an_actuator_that_can_be_driven_opens_what_another_closed() {
    let ctx = egui::Context::default();
    let mut session = Session::new(starter()).unwrap();
    let mounted = |name: &str| {
        let profile = built_in_actuators().unwrap().into_iter().find(|a| a.name.contains(name)).unwrap();
        Rig { mounted: Some(Mounted::new(profile, None).unwrap()), ..Rig::default() }
    };
    session.open_output(null(), &ctx);
    session.set_rig(mounted("MM1C"), &ctx);
    go_on(&mut session, "it is closed", Session::is_output_released);
    session.set_rig(mounted("Mark II-D"), &ctx);
    go_on(&mut session, "it opens", |s| !s.is_opening() && s.status().is_some());
}

/// A recording that stops at its maximum duration becomes the stroke, or the message states why not.
#[test]
fn a_full_recording_is_said_to_be_kept_only_where_it_is() {
    let mut session = Session::new(starter()).unwrap();
    for (force_n, words, n_strokes) in [
        (-1.0, "negative force (-1 N); remove it or correct its sign", 0),
        (1.0, stroke::KEPT, 1),
        (1.0, stroke::REPLACED, 2),
    ] {
        session.begin_recording();
        assert_eq!(session.message(), None, "what was said of the one before is over");
        let recorder = session.hand.recorder.as_mut().unwrap();
        for _ in 0..2 {
            recorder.take_mouse(PenSample { force_n, touching: true, ..PenSample::default() });
        }
        recorder.age(2.0 * LONGEST_SECS);
        session.follow_strokes();
        let message = session.message().unwrap();
        assert!(message.starts_with(&stroke::full(LONGEST_SECS)) && message.ends_with(words), "{message}");
        assert_eq!((session.n_strokes(), session.recording()), (n_strokes, None));
    }
}
