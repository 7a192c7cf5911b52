//! Textures generated from prompts, and photos with predicted positions.

use egui::accesskit::Role;
use egui::{Event, Key, Shape};
use egui_kittest::kittest::Queryable as _;
use shagreen_app::author::prompt::Origin;
use shagreen_app::strings;
use shagreen_app::strings::{authored, import, prompt as words, relief, textures};
use shagreen_formats::picture::encode_png;
use shagreen_formats::picture::{Rgb, decode};
use shagreen_formats::starter::starter_library;

use crate::support::{
    Author, author, click, drop_files, painted, says, unnamed_controls, wait, wait_for_field, window,
    write_into,
};

/// Generates a texture from a prompt and waits for it, until it is simulated.
fn describe(harness: &mut Author, prompt: &str) {
    let n = window(harness).project().authored.len();
    write_into(harness, words::FIELD, prompt);
    harness.key_press(Key::Enter);
    wait(harness, "it was made", |h| window(h).project().authored.len() > n);
    wait_for_simulation(harness);
    harness.run_steps(4);
}

fn wait_for_simulation(harness: &mut Author) {
    wait(harness, "it was simulated", |h| !window(h).prompts().is_simulating());
}

fn seed(harness: &Author) -> u64 {
    let texture = window(harness).project().texture();
    match &window(harness).prompts().guess_of(texture).expect("it was guessed").origin {
        Origin::Words { seed, .. } => *seed,
        Origin::Photo { name, .. } => panic!("{name} is a photo"),
    }
}

#[test]
fn words_become_a_texture_with_a_picture_a_place_and_an_ellipse() {
    let mut harness = author();
    describe(&mut harness, "a rough, soft carpet-like surface");
    let texture = window(&harness).project().texture().clone();
    assert_eq!(texture.name, "a rough, soft carpet-like surface");
    assert!(texture.at.x() < 45.0 && texture.at.y() > 60.0, "{}", texture.at);
    assert!(texture.picture.is_some() && texture.notes.contains("seed 1"));
    let guess = window(&harness).prompts().guess_of(&texture).unwrap().clone();
    assert_eq!(guess.at(), texture.at);
    for said in ["Understood:", "procedural generator, seed 1", "nobody rated it"] {
        assert!(says(&harness, said), "{said}");
    }
    // The contour of the ellipse is dashed; its filled area is one shape, as wide as two standard deviations.
    let width = |shape: &Shape| {
        matches!(shape, Shape::Path(path) if path.points.len() == 96)
            .then(|| f64::from(shape.visual_bounding_rect().width()))
    };
    assert_eq!(painted(&harness, strings::CANVAS).iter().filter_map(width).count(), 1);
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());

    click(&mut harness, words::ANOTHER);
    wait(&mut harness, "another was made", |h| !window(h).prompts().is_busy());
    wait_for_simulation(&mut harness);
    harness.run_steps(3);
    assert_eq!(seed(&harness), 2);
    assert_eq!(window(&harness).project().joined.len(), 1, "the second simulation replaces the first");
    let other = window(&harness).project().texture().clone();
    assert_eq!((window(&harness).project().authored.len(), other.key), (2, texture.key), "in its place");
    assert_ne!(other.picture, texture.picture);

    // The sliders move the point, and the ellipse keeps the predicted position.
    harness.get_by_role_and_label(Role::Slider, strings::ROUGH_SMOOTH).set_value_accesskit(60.0);
    harness.run_steps(3);
    assert_eq!(window(&harness).project().texture().at.x(), 60.0);
    let moved = window(&harness).project().texture().clone();
    assert!(window(&harness).prompts().guess_of(&moved).unwrap().at().x() < 50.0);
    click(&mut harness, words::DISMISS);
    assert!(!says(&harness, "Understood:"));
    // The slider, and twice the texture with its simulation.
    for _ in 0..3 {
        click(&mut harness, strings::UNDO);
    }
    assert_eq!(window(&harness).project().authored.len(), 1, "undone");
    assert!(window(&harness).project().joined.is_empty());
}

#[test]
fn a_generated_texture_is_its_picture_once_it_is_simulated() {
    let mut harness = author();
    write_into(&mut harness, words::FIELD, "grooved hard plastic with 5 mm ridges");
    harness.key_press(Key::Enter);
    wait(&mut harness, "it was made", |h| window(h).project().authored.len() == 2);
    wait_for_simulation(&mut harness);
    harness.run_steps(3);
    let project = window(&harness).project().clone();
    let [simulated] = &project.joined[..] else { panic!("{} joined", project.joined.len()) };
    assert_eq!(project.solo.as_deref(), Some(simulated.id.as_str()));
    assert!(project.texture().blend.locked.contains(&simulated.id));
    assert_eq!(simulated.at(), Some(project.texture().at));
    assert_eq!(simulated.picture.as_ref(), project.texture().picture.as_deref());
    let map = simulated.model.height_map().expect("the ridges are felt where the tip is");
    // A whole number of ridges, and the whole picture.
    let n_ridges = map.side_m() / 5e-3;
    assert!((n_ridges - n_ridges.round()).abs() < 1e-9, "{n_ridges}");
    assert!((1e3 * map.side_m() - simulated.picture.as_ref().unwrap().millimeters).abs() < 1e-9);
    assert!(says(&harness, words::SIMULATED));
    // It is the authored texture, so there is nothing to choose or to leave.
    assert!(!says(&harness, &strings::plays_alone(&simulated.name)));
    assert!(harness.query_by_label(textures::BACK_NAME).is_none());
    // One step with the texture.
    click(&mut harness, strings::UNDO);
    let undone = window(&harness).project();
    assert_eq!((undone.authored.len(), undone.joined.len(), &undone.solo), (1, 0, &None));
}

/// What was finished stays: a second prompt changes nothing of the first, unless its texture is used in the whole space.
#[test]
fn a_second_prompt_leaves_the_first_texture_as_it_is() {
    let mut harness = author();
    describe(&mut harness, "a rough, soft carpet-like surface");
    let at = window(&harness).project().texture().at.x();
    let moved = if at > 50.0 { at - 3.0 } else { at + 3.0 };
    harness.get_by_role_and_label(Role::Slider, strings::ROUGH_SMOOTH).set_value_accesskit(moved);
    harness.run_steps(3);
    wait_for_field(&mut harness);
    let heard = |harness: &Author| {
        let session = window(harness).session();
        (session.authored().expect("it is shown").clone(), session.spectra().blend.clone())
    };
    let (first, before) = (window(&harness).project().texture().clone(), heard(&harness));
    assert!(before.0.parents.iter().any(|(texture, _)| *texture == 25), "its own texture takes part");

    describe(&mut harness, "grooved hard plastic with 5 mm ridges");
    let second = window(&harness).project().joined[1].name.clone();
    click(&mut harness, &authored::select(&first.name));
    wait_for_field(&mut harness);
    assert_eq!(heard(&harness), before);
    write_into(&mut harness, strings::SEARCH, &second);
    click(&mut harness, &textures::more(&second));
    harness.run_steps(3);
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
    click(&mut harness, textures::WHOLE_SPACE);
    harness.run_steps(2);
    wait_for_field(&mut harness);
    assert!(window(&harness).project().own.len() == 1 && heard(&harness) != before);
    click(&mut harness, strings::UNDO);
    wait_for_field(&mut harness);
    assert_eq!((window(&harness).project().own.len(), heard(&harness)), (2, before));
}

/// While another authored texture is selected, the list and the menu of the first one say where its own texture is, and offer it
/// for the whole space.
#[test]
fn a_generated_texture_is_offered_for_the_whole_space_where_it_is_missing() {
    let mut harness = author();
    describe(&mut harness, "a rough, soft carpet-like surface");
    let generated = window(&harness).project().texture().name.clone();
    let others = window(&harness).project().authored[0].name.clone();
    click(&mut harness, &authored::select(&others));
    let row = harness.get_by_label(&authored::select(&generated)).rect().center();
    harness.hover_at(row);
    wait(&mut harness, "the tooltip says why", |h| says(h, textures::OWN_HELP));
    harness.get_by_label(&authored::select(&generated)).click_secondary();
    harness.run_steps(3);
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
    click(&mut harness, textures::WHOLE_SPACE);
    harness.run_steps(2);
    assert!(window(&harness).project().own.is_empty());
    assert!(harness.query_by_label(textures::WHOLE_SPACE).is_none(), "the menu closes");
}

#[test]
fn a_simulation_that_is_stopped_leaves_the_interpolated_texture() {
    let mut harness = author();
    write_into(&mut harness, words::FIELD, "a brushed aluminium plate");
    harness.key_press(Key::Enter);
    wait(&mut harness, "it was made", |h| window(h).project().authored.len() == 2);
    if window(&harness).prompts().is_simulating() {
        harness.run_steps(1);
        if let Some(stop) = harness.query_by_label(words::STOP_SIMULATION) {
            stop.click();
        }
    }
    wait_for_simulation(&mut harness);
    harness.run_steps(3);
    assert!(harness.query_by_label(words::STOP_SIMULATION).is_none());
    assert_eq!(window(&harness).project().authored.len(), 2);
}

#[test]
fn words_that_say_nothing_are_answered_and_earlier_ones_come_back() {
    let mut harness = author();
    describe(&mut harness, "the meaning of life");
    assert!(says(&harness, "any surface is equally likely"));
    describe(&mut harness, "polished steel");
    let steel = window(&harness).project().texture().clone();
    click(&mut harness, words::EARLIER);
    // Waits until the layout is complete.
    harness.run_steps(6);
    click(&mut harness, &words::earlier("polished steel", 1, false));
    wait(&mut harness, "it was made again", |h| window(h).project().authored.len() == 4);
    wait_for_simulation(&mut harness);
    let again = window(&harness).project().texture();
    assert_eq!((again.at, &again.picture), (steel.at, &steel.picture), "the same words and seed");
    assert_eq!(again.name, "polished steel 2");
    // An empty prompt is allowed and describes an arbitrary surface, but Enter alone means nothing.
    write_into(&mut harness, words::FIELD, "x");
    harness.key_press(Key::Backspace);
    harness.run_steps(2);
    harness.key_press(Key::Enter);
    harness.run_steps(3);
    assert!(!window(&harness).prompts().is_busy());
    click(&mut harness, words::MAKE);
    wait(&mut harness, "something was made", |h| window(h).project().authored.len() == 5);
    assert!(window(&harness).project().texture().name.starts_with(words::NOTHING_SAID));
}

/// Letters that are shortcuts elsewhere are text, also while the texture is made and afterwards.
#[test]
fn typing_goes_on_while_a_texture_is_made_and_each_result_is_one_step() {
    let mut harness = author();
    write_into(&mut harness, words::FIELD, "rough");
    harness.key_press(Key::Enter);
    harness.run_steps(1);
    let type_m = |harness: &mut Author| {
        harness.key_press(Key::M);
        harness.event(Event::Text("m".to_owned()));
        harness.run_steps(1);
        assert!(!window(harness).session().is_muted(), "M is a letter here");
        assert!(harness.get_by_role_and_label(Role::TextInput, words::FIELD).is_focused());
    };
    type_m(&mut harness);
    wait(&mut harness, "it was made", |h| window(h).project().authored.len() == 2);
    wait_for_simulation(&mut harness);
    type_m(&mut harness);
    let typed = harness.get_by_role_and_label(Role::TextInput, words::FIELD).value();
    assert_eq!(typed.as_deref(), Some("roughmm"));
    harness.key_press(Key::Enter);
    wait(&mut harness, "another was made", |h| window(h).project().authored.len() == 3);
    wait_for_simulation(&mut harness);
    click(&mut harness, strings::UNDO);
    assert_eq!(window(&harness).project().authored.len(), 2, "each is undone on its own");
    // Elsewhere the letter is a shortcut again.
    harness.run_steps(2);
    harness.key_press(Key::M);
    harness.run_steps(2);
    assert!(window(&harness).session().is_muted());
}

/// A search field loses the focus by Enter. A key in the frame after that is not a shortcut, but later ones are.
#[test]
fn a_key_in_the_frame_after_a_text_field_is_not_a_shortcut() {
    let mut harness = author();
    write_into(&mut harness, strings::SEARCH, "wood");
    harness.key_down(Key::Enter);
    harness.step();
    assert!(!harness.get_by_role_and_label(Role::TextInput, strings::SEARCH).is_focused());
    harness.key_down(Key::M);
    harness.step();
    assert!(!window(&harness).session().is_muted());
    harness.key_up(Key::Enter);
    harness.key_up(Key::M);
    harness.key_press(Key::M);
    harness.run_steps(2);
    assert!(window(&harness).session().is_muted());
}

#[test]
fn a_photo_finds_its_place_and_what_is_none_is_told() {
    let library = starter_library().unwrap();
    let texture = &library.textures[library.index_of("brick").unwrap()];
    let Rgb { width, height, pixels } = decode(texture.picture.as_ref().unwrap()).unwrap();
    let bytes = encode_png(&Rgb { width, height, pixels }).unwrap();
    let mut harness = author();
    drop_files(&mut harness, &[("a wall.png", &bytes)]);
    click(&mut harness, relief::FIND_POINT);
    wait(&mut harness, "it landed", |h| window(h).project().authored.len() == 2);
    harness.run_steps(4);
    let landed = window(&harness).project().texture();
    assert_eq!(landed.name, "a wall");
    assert!(landed.at.distance(texture.at().unwrap()) < 35.0, "{}", landed.at);
    assert!(landed.picture.is_some() && says(&harness, "is not known"));
    drop_files(&mut harness, &[("broken.png", &bytes[..300])]);
    click(&mut harness, relief::FIND_POINT);
    wait(&mut harness, "the error is shown", |h| says(h, "broken.png"));
    assert_eq!(window(&harness).project().authored.len(), 2);
}

#[test]
fn photos_dropped_together_land_one_after_another_beside_other_files() {
    let library = starter_library().unwrap();
    let photo = |id: &str| {
        let texture = &library.textures[library.index_of(id).unwrap()];
        let Rgb { width, height, pixels } = decode(texture.picture.as_ref().unwrap()).unwrap();
        encode_png(&Rgb { width, height, pixels }).unwrap()
    };
    let (brick, glass) = (photo("brick"), photo("glass"));
    let mut harness = author();
    // At most one photo is done in a frame, and typing takes ten, so enough are left when Enter arrives. The bad one,
    // whose message replaces any other, comes after that.
    let bad = brick[..300].to_vec();
    let mut photos: Vec<(String, &[u8])> =
        (1..=14).map(|n| (format!("photo {n}.png"), if n % 2 == 0 { &*glass } else { &*brick })).collect();
    photos.push(("bad.png".to_owned(), &bad));
    photos.push(("last.png".to_owned(), &brick));
    let dropped: Vec<(&str, &[u8])> = photos.iter().map(|(name, bytes)| (name.as_str(), *bytes)).collect();
    drop_files(&mut harness, &dropped);
    write_into(&mut harness, words::FIELD, "steel");
    // The present job continues, and a message says so.
    harness.key_press(Key::Enter);
    wait(&mut harness, "one cannot be had twice", |h| says(h, words::STILL_BUSY));
    wait(&mut harness, "all landed", |h| window(h).project().authored.len() == 16);
    let names: Vec<&str> =
        window(&harness).project().authored.iter().skip(1).map(|texture| texture.name.as_str()).collect();
    let of_good = dropped.iter().filter(|(name, _)| *name != "bad.png");
    let expected: Vec<&str> = of_good.map(|(name, _)| name.trim_end_matches(".png")).collect();
    assert_eq!(names, expected);
    assert!(!window(&harness).prompts().is_busy());

    // Stopping discards all waiting photos. Afterwards only the newly dropped photo is added, apart from the imported
    // file.
    let many: Vec<(&str, &[u8])> = vec![("six.png", &brick); 12];
    drop_files(&mut harness, &many);
    wait(&mut harness, "it is said how many wait", |h| (1..many.len()).any(|n| says(h, &words::waiting(n))));
    click(&mut harness, words::STOP);
    assert!(
        !window(&harness).prompts().is_busy() && (1..many.len()).all(|n| !says(&harness, &words::waiting(n)))
    );
    let n = window(&harness).project().authored.len();
    drop_files(&mut harness, &[("nine.png", &glass), ("a recording.wav", b"none")]);
    wait(&mut harness, "the recording is looked at", |h| says(h, "a recording.wav"));
    click(&mut harness, import::CANCEL);
    wait(&mut harness, "it landed", |h| window(h).project().authored.len() > n);
    harness.run_steps(20);
    assert!(!window(&harness).prompts().is_busy());
    assert_eq!(window(&harness).project().authored.len(), n + 1);
    assert_eq!(window(&harness).project().texture().name, "nine");
}
