//! Import: dropping files, answering questions, fitting, adding the texture, playing it, and undo.

use std::fmt::Write as _;
use std::path::Path;

use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT, Queryable};
use shagreen_app::command::Command;
use shagreen_app::strings::{self, import};
use shagreen_core::space::LabelSource;
use shagreen_core::texture::blend::Mode;
use shagreen_core::texture::plane::Plane;
use shagreen_core::texture::render::{RenderPlan, render};
use shagreen_core::units::{Contact, Hertz};
use shagreen_formats::library::{Library, Provenance, TextureEntry, read_library, write_library};
use shagreen_formats::starter::starter_library;

use crate::support::{
    Author, author, choose, click, drop_files, enter_path, says, solo, unnamed_controls, wait, window,
};
use crate::views::carry_out;

fn names(harness: &Author) -> Vec<String> {
    window(harness).session().textures().iter().map(|texture| texture.name.clone()).collect()
}

fn starter(id: &str) -> TextureEntry {
    let library = starter_library().expect("the starter library");
    library.textures[library.index_of(id).expect("a texture of the starter library")].clone()
}

/// Simulated recording of a starter texture, stroked back and forth at many speeds and forces. The unit of acceleration
/// is not stated.
pub(crate) fn recording(id: &str, seconds: f64, rate: Hertz) -> String {
    let prepared = Plane::new(&starter(id).model).prepare();
    let speed_mm_per_s = |t: f64| 20.0 + 180.0 * (0.9 * t).sin().powi(2);
    let force_n = |t: f64| 1.2 + 0.8 * (0.23 * t).sin();
    let plan = RenderPlan { parents: &[(&prepared, 1.0)], mode: Mode::Shared, rate, seconds, seed: 5 };
    let samples =
        render(&plan, &mut |t: f64| Contact::from_mm_per_s_and_n(speed_mm_per_s(t), force_n(t))).unwrap();
    let mut text = "time_s,acc,speed_mm/s,force_N\n".to_owned();
    for (i, sample) in samples.iter().enumerate() {
        let t = i as f64 / rate.0;
        let _ = writeln!(text, "{t:.4},{sample:.6},{:.3},{:.4}", speed_mm_per_s(t), force_n(t));
    }
    text
}

/// Drops a recording and answers the questions, until it is fitted.
pub(crate) fn import_recording(harness: &mut Author, name: &str, text: &str) {
    drop_files(harness, &[(name, text.as_bytes())]);
    let unit = import::answer_of("acceleration_unit");
    wait(harness, "the unit is asked for", |h| h.query_by_role_and_label(Role::ComboBox, &unit).is_some());
    choose(harness, &unit, "m/s²");
    wait(harness, "the texture is fitted", |h| {
        h.query_by_label(&import::add(1)).is_some_and(|n| !n.accesskit_node().is_disabled())
    });
}

/// Main use: drop a recording, state its unit, inspect the fit, add the texture and play it.
#[test]
fn a_dropped_recording_becomes_a_texture_that_sounds_and_can_be_undone() {
    let mut harness = author();
    let before = names(&harness);
    import_recording(&mut harness, "oak_board.csv", &recording("sanded-wood", 20.0, Hertz(1000.0)));

    let sheet = window(&harness).import().expect("the sheet");
    let file = &sheet.batch().files()[0];
    let draft = sheet.batch().draft_of(file.id).expect("a texture in the making");
    let report = &draft.fitted().expect("a fit").report;
    assert!(report.segments.len() > 5 && report.rate.0 == 1000.0, "{}", report.segments.len());
    assert!(report.gfc_median() > 0.85 && report.level_error_db_median() < 2.0, "{report:?}");
    for words in [import::GFC_MEDIAN, import::LEVEL_ERROR, import::COVERAGE, import::TAP] {
        assert!(harness.query_by_label(words).is_some(), "{words} is not shown");
    }
    assert!(harness.query_by_label(&import::spectrum_of(import::HELD_OUT_LINE)).is_some());
    assert!(harness.query_by_label(&import::file("oak_board.csv", import::READY)).is_some());
    assert!(harness.query_by_label_contains("segment 1 of").is_some());
    click(&mut harness, import::NEXT_SEGMENT);
    assert!(harness.query_by_label_contains("segment 2 of").is_some());

    // Recordings get predicted positions unless the user turns that off.
    click(&mut harness, import::PLACE_THEM);
    click(&mut harness, &import::add(1));
    // The list scrolls to the new texture.
    harness.run_steps(60);
    assert!(window(&harness).import().is_none(), "the sheet closes");
    let after = names(&harness);
    assert_eq!(
        (&after[..before.len()], after[before.len()..].concat()),
        (&before[..], "Oak board".to_owned())
    );
    assert!(harness.query_by_label("Play Oak board").is_none(), "it has no place yet");

    click(&mut harness, &strings::texture("Oak board"));
    assert_eq!(solo(&harness), Some(before.len()));
    wait(&mut harness, "it has played for a moment", |h| !window(h).session().hand_is_running());
    click(&mut harness, strings::HAND_START);
    wait(&mut harness, "it sounds", |h| window(h).session().scope().rms(0.3) > 0.02);

    click(&mut harness, strings::UNDO);
    assert_eq!(solo(&harness), None);
    click(&mut harness, strings::UNDO);
    assert_eq!(names(&harness), before, "one step takes it away");
    harness.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    harness.run_steps(3);
    assert_eq!(names(&harness).len(), before.len() + 1);
}

#[test]
fn a_dropped_recording_lands_near_the_texture_it_was_made_of() {
    let mut harness = author();
    let space = window(&harness).session().space().clone();
    let index = window(&harness).session().textures().iter().position(|t| t.id == "loop-carpet").unwrap();
    let carpet = space.position(index).unwrap();
    import_recording(&mut harness, "rug.csv", &recording("loop-carpet", 20.0, Hertz(1000.0)));
    click(&mut harness, &import::add(1));
    harness.run_steps(60);
    let entry = window(&harness).session().textures().last().unwrap().clone();
    let place = entry.place.expect("it has a place");
    assert_eq!(place.source, LabelSource::Estimated);
    // The recording has no landing, so it does not determine the hardness: there it lies at the mean of the labels.
    assert!((place.at.x() - carpet.x()).abs() < 10.0, "{} for {carpet}", place.at);
    assert!(entry.description.contains("nobody rated it") && entry.description.contains('±'));
    assert!(harness.query_by_label("Play Rug").is_some(), "it is on the canvas");
}

/// Another model rate requires another fit. A texture that cannot be interpolated says so. When it is soloed, the
/// output uses its rate.
#[test]
fn another_model_rate_is_fitted_anew_and_is_heard_alone() {
    let mut harness = author();
    import_recording(&mut harness, "felt.csv", &recording("felt", 12.0, Hertz(4000.0)));
    choose(&mut harness, import::RATE, "2000 Hz");
    wait(&mut harness, "the fit at 2000 Hz", |h| {
        let batch = window(h).import().expect("the sheet").batch();
        let draft = batch.draft_of(batch.files()[0].id);
        draft.and_then(|d| d.fitted()).is_some_and(|f| f.report.rate.0 == 2000.0)
    });
    assert!(harness.query_by_label_contains("cannot be interpolated").is_some());
    click(&mut harness, &import::add(1));
    harness.run_steps(60);
    let before = window(&harness).session().textures().len();
    assert_eq!(window(&harness).session().textures()[before - 1].model.rate().0, 2000.0);
    harness.get_all_by_label(&strings::texture("Felt")).last().expect("two of that name").click();
    harness.run_steps(2);
    assert_eq!(solo(&harness), Some(before - 1));
    wait(&mut harness, "it has played for a moment", |h| !window(h).session().hand_is_running());
    click(&mut harness, strings::HAND_START);
    wait(&mut harness, "it sounds at its own rate", |h| window(h).session().scope().rms(0.3) > 1e-3);
    // A click on a texture of the space plays that one, and the output returns to the rate of the space.
    click(&mut harness, &strings::play_texture("Brick"));
    wait(&mut harness, "the brick sounds", |h| window(h).session().scope().rms(0.3) > 0.2);
}

#[test]
fn a_file_that_cannot_be_used_says_why_and_nothing_is_lost() {
    let mut harness = author();
    let before = names(&harness);
    drop_files(&mut harness, &[("broken.json", b"{ \"format\": \"shagreen-library\", ")]);
    wait(&mut harness, "the file is read", |h| {
        h.query_by_label(&import::file("broken.json", import::FAILED)).is_some()
    });
    assert!(harness.query_by_label_contains("The library is damaged").is_some(), "the reason is shown");
    assert!(harness.get_by_label(&import::add(0)).accesskit_node().is_disabled());
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    assert!(window(&harness).import().is_none());
    assert_eq!(names(&harness), before);
    assert!(harness.get_by_label(strings::UNDO).accesskit_node().is_disabled());
}

/// A file of another kind is not to be corrected, and a project is known.
#[test]
fn a_file_of_another_kind_gets_no_advice_for_recordings() {
    let mut harness = author();
    for (name, bytes, said) in [
        ("README.md", b"a,b\n1,2\n3,4,5\n".as_slice(), "Files of this kind cannot be imported"),
        ("woods.shagreen", b"{}".as_slice(), "This is a project of Shagreen"),
    ] {
        // A dropped project is opened. One in a folder, or whose path is typed, is read.
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        carry_out(&mut harness, Command::OpenImport);
        enter_path(&mut harness, import::PATHS, &path);
        wait(&mut harness, "the reason is shown", |h| says(h, said));
        assert!(!says(&harness, "correct the file") && says(&harness, import::ACCEPTED));
        carry_out(&mut harness, Command::CloseSheet);
    }
}

/// Textures of a dropped library are added. They keep their positions, because these have the same source.
#[test]
fn a_dropped_library_adds_its_textures_with_their_places() {
    let mut harness = author();
    let n = names(&harness).len();
    let cork = TextureEntry { name: "My cork".to_owned(), ..starter("cork") };
    let unplaced = TextureEntry { name: "My felt".to_owned(), place: None, ..starter("felt") };
    let library = Library { name: "Mine".to_owned(), textures: vec![cork, unplaced], ..Library::default() };
    drop_files(&mut harness, &[("mine.json", &write_library(&library))]);
    wait(&mut harness, "the library is read", |h| h.query_by_label(&import::add(2)).is_some());
    click(&mut harness, &import::add(2));
    harness.run_steps(2);
    let textures = window(&harness).session().textures();
    assert_eq!((textures[n].id.as_str(), textures[n].place), ("cork-2", starter("cork").place));
    assert_eq!((textures[n + 1].id.as_str(), textures[n + 1].place), ("felt-2", None));
    assert!(harness.query_by_label("Play My cork").is_some());
}

/// Shortcuts change nothing while a sheet is open, and every control of the sheet has a name.
#[test]
fn the_sheet_is_reached_by_keyboard_and_every_control_has_a_name() {
    let mut harness = author();
    let point = window(&harness).project().texture().at;
    click(&mut harness, strings::IMPORT);
    harness.run_steps(2);
    let theme = harness.ctx.theme();
    // The focus starts in the path field and then moves on.
    harness.get_by_role_and_label(Role::TextInput, import::PATHS).click();
    for (modifiers, key) in [
        (Modifiers::NONE, Key::ArrowRight),
        (Modifiers::COMMAND, Key::T),
        (Modifiers::COMMAND, Key::Z),
        (Modifiers::NONE, Key::Tab),
        (Modifiers::NONE, Key::ArrowRight),
        (Modifiers::NONE, Key::M),
        (Modifiers::COMMAND, Key::Z),
    ] {
        harness.key_press_modifiers(modifiers, key);
        harness.run_steps(2);
    }
    let below = window(&harness);
    assert_eq!((below.project().texture().at, harness.ctx.theme()), (point, theme));
    assert!(below.import().is_some() && !below.session().is_muted() && !below.session().hand_is_running());
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("cork.csv");
    std::fs::write(&path, recording("cork", 6.0, Hertz(1000.0))).unwrap();
    harness.get_by_role_and_label(Role::TextInput, import::PATHS).focus();
    harness.run_steps(2);
    let field = harness.get_by_role_and_label(Role::TextInput, import::PATHS);
    field.type_text(&path.display().to_string());
    harness.run_steps(2);
    harness.key_press(Key::Enter);
    let unit = import::answer_of("acceleration_unit");
    wait(&mut harness, "the file is read", |h| h.query_by_role_and_label(Role::ComboBox, &unit).is_some());
    let field = harness.get_by_role_and_label(Role::TextInput, import::PATHS);
    assert!(field.accesskit_node().is_focused(), "what is typed next goes into the field");
    harness.event(egui::Event::Text("m".to_owned()));
    harness.run_steps(2);
    let field = harness.get_by_role_and_label(Role::TextInput, import::PATHS);
    assert_eq!(field.accesskit_node().value().as_deref(), Some("m"));
    assert!(!window(&harness).session().is_muted());
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
    choose(&mut harness, &unit, "m/s²");
    wait(&mut harness, "the fit", |h| h.query_by_label(import::GFC_MEDIAN).is_some());
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
}

/// Saving asks before it replaces a library and refuses to replace other files. The saved file contains the whole list.
#[test]
fn the_library_is_saved_with_what_joined_it() {
    let mut harness = author();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.json");
    std::fs::write(&path, "something else").unwrap();
    click(&mut harness, strings::SAVE_LIBRARY);
    harness.run_steps(2);
    harness.get_by_role_and_label(Role::TextInput, import::SAVE_PATH).type_text(&path.display().to_string());
    harness.run_steps(2);
    harness.key_press(Key::Enter);
    let refused = "is not a readable Shagreen library";
    wait(&mut harness, "it refuses", |h| h.query_by_label_contains(refused).is_some());
    assert!(harness.query_by_label(import::REPLACE).is_none());
    assert_eq!(std::fs::read(&path).unwrap(), b"something else");

    // The sheet grows by the error message and is centered again.
    harness.run_steps(3);
    std::fs::write(&path, write_library(&Library::default())).unwrap();
    click(&mut harness, import::SAVE);
    wait(&mut harness, "it says that a library is there", |h| h.query_by_label(import::REPLACE).is_some());
    assert!(read_library(&std::fs::read(&path).unwrap()).unwrap().value.textures.is_empty());
    harness.run_steps(3);
    click(&mut harness, import::REPLACE);
    let saved = import::saved(&path.display().to_string());
    wait(&mut harness, "it is saved", |h| h.query_by_label(&saved).is_some());
    let library = read_library(&std::fs::read(&path).unwrap()).unwrap().value;
    assert_eq!(library.textures.len(), names(&harness).len());
}

/// A published texture is marked as not redistributable: in the sheet, in the list, and before saving.
#[test]
fn a_published_texture_joins_and_is_marked_as_restricted() {
    let mut harness = author();
    let n = names(&harness).len();
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../vectors/hatt/made_up.xml");
    drop_files(&mut harness, &[("made_up.xml", &std::fs::read(path).unwrap())]);
    wait(&mut harness, "the model is read", |h| {
        h.query_by_label(&import::file("made_up.xml", import::READY)).is_some()
    });
    assert!(harness.query_by_label(import::RESTRICTED).is_some(), "the terms are shown");
    assert!(harness.query_by_label(&import::spectrum_of(import::MODEL_LINE)).is_some());
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
    click(&mut harness, &import::add(1));
    harness.run_steps(60);

    let texture = window(&harness).session().textures()[n].clone();
    assert!(texture.provenance == Provenance::Restricted && texture.place.is_none());
    let label = format!("{} · {}", strings::NOT_PLACED_YET, import::RESTRICTED_SHORT);
    assert!(harness.query_by_label(&label).is_some(), "the list says so");
    click(&mut harness, &strings::texture(&texture.name));
    assert_eq!(solo(&harness), Some(n));
    click(&mut harness, strings::HAND_START);
    wait(&mut harness, "it sounds", |h| window(h).session().scope().rms(0.3) > 1e-4);

    click(&mut harness, strings::SAVE_LIBRARY);
    harness.run_steps(2);
    let warning = Provenance::warning(&[&texture.name]).unwrap();
    assert!(harness.query_by_label(&warning).is_some(), "saving warns");
}

/// Typed names and tags are kept when files are combined and separated again.
#[test]
fn names_and_tags_stay_when_recordings_become_one_texture_and_back() {
    let mut harness = author();
    let files =
        [("a.csv", recording("cork", 6.0, Hertz(1000.0))), ("b.csv", recording("felt", 6.0, Hertz(1000.0)))];
    drop_files(&mut harness, &files.each_ref().map(|(name, text)| (*name, text.as_bytes())));
    let name = |h: &Author| {
        let field = h.get_by_role_and_label(Role::TextInput, import::NAME);
        field.accesskit_node().value().unwrap_or_default()
    };
    wait(&mut harness, "both are read", |h| h.query_by_label(import::ARE_ONE).is_some());
    harness.run_steps(3);
    let typed = |h: &mut Author, label: &str, text: &str| {
        h.get_by_role_and_label(Role::TextInput, label).focus();
        h.run_steps(2);
        h.get_by_role_and_label(Role::TextInput, label).type_text(text);
        h.run_steps(2);
    };
    typed(&mut harness, import::NAME, "lone ");
    typed(&mut harness, import::TAGS, "soft");
    let lone = name(&harness);
    assert!(lone.contains("lone"), "{lone}");
    click(&mut harness, import::ARE_ONE);
    assert!(!name(&harness).contains("lone"));
    typed(&mut harness, import::NAME, "both ");
    let both = name(&harness);
    click(&mut harness, import::ARE_ONE);
    assert_eq!(name(&harness), lone);
    let batch = window(&harness).import().unwrap().batch();
    let tags: Vec<&str> =
        batch.files().iter().map(|file| batch.draft_of(file.id).unwrap().tags.as_str()).collect();
    assert_eq!(tags, ["soft", ""]);
    click(&mut harness, import::ARE_ONE);
    assert_eq!(name(&harness), both);
}
