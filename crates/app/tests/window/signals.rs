//! The Signals workspace: loading, processing, comparing, feeling, editing and adding signals.

use egui::accesskit::Role;
use egui::{Key, Modifiers, pos2};
use egui_kittest::kittest::Queryable as _;
use shagreen_app::Begin;
use shagreen_app::choices::signals::Slot;
use shagreen_app::choices::signals::Tool;
use shagreen_app::choices::signals::View;
use shagreen_app::state::bench_signal::BenchSignal;
use shagreen_app::state::files::StoragePaths;
use shagreen_app::strings::{self, differences, signals};
use shagreen_app::workspace::Workspace;
use shagreen_core::signals::quality::{QualityModel, Relation, Term};
use shagreen_formats::quality_model::{built_in_quality_model, write_quality_model};
use shagreen_formats::settings::read_settings;
use shagreen_formats::wav::{SidecarV1, write_wav};
use shagreen_studio::project::new_project;

use crate::support::{
    Author, author, author_of, begin, choose, click, drag, drop_files, enter_path, says, unnamed_controls,
    wait, wait_for_field, window,
};

/// Window with the audible texture as signal A.
fn with_heard() -> Author {
    heard_in(author())
}

/// The window, with the audible texture as signal A.
fn heard_in(mut harness: Author) -> Author {
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Num3);
    harness.run_steps(2);
    assert_eq!(window(&harness).workspace(), Workspace::Signals);
    wait_for_field(&mut harness);
    click(&mut harness, &signals::take_heard(Slot::A));
    wait_for(&mut harness, Slot::A);
    harness
}

fn wait_for(harness: &mut Author, slot: Slot) {
    wait(harness, "a signal is there", |h| window(h).signals().signal(slot).is_some());
    harness.run_steps(2);
}

fn signal(harness: &Author, slot: Slot) -> &BenchSignal {
    window(harness).signals().signal(slot).expect("a signal")
}

/// Level of a signal between two fractions of its length, in m/s².
fn level(signal: &BenchSignal, from: f64, to: f64) -> f64 {
    let values = signal.profile.values();
    let at = |share: f64| (share * values.len() as f64) as usize;
    let part = &values[at(from)..at(to)];
    (part.iter().map(|x| x * x).sum::<f64>() / part.len() as f64).sqrt()
}

#[test]
fn the_buttons_of_a_slot_are_equally_high_on_one_line() {
    let harness = with_heard();
    let [play, feel] =
        [signals::play(Slot::A), signals::feel(Slot::A)].map(|name| harness.get_by_label(&name).rect());
    let shift = (play.center().y - feel.center().y).abs();
    assert!(shift < 1.0 && (play.height() - feel.height()).abs() < 2.0, "{play:?}, {feel:?}");
}

#[test]
fn what_is_heard_goes_through_the_codec_and_both_are_compared() {
    let mut harness = with_heard();
    let name = window(&harness).project().texture().name.clone();
    assert_eq!(signal(&harness, Slot::A).name, name);
    assert!(says(&harness, "5.00 s at"));
    choose(&mut harness, signals::BITRATE, &signals::kbps(1.75));
    click(&mut harness, signals::CODEC);
    wait_for(&mut harness, Slot::B);
    assert!(signal(&harness, Slot::B).name.contains("1.75 kbit/s"));
    click(&mut harness, signals::view(View::Differences));
    wait(&mut harness, "both are known", |h| {
        let page = window(h).signals();
        page.compared().is_some() && Slot::ALL.iter().all(|slot| page.by_rate(*slot).is_some())
    });
    harness.run_steps(2);
    let page = window(&harness).signals();
    let compared = page.compared().unwrap().unwrap();
    let rates = page.by_rate(Slot::A).unwrap().unwrap();
    // B is A encoded at the lowest bit rate, so the curve and the pair have the same predicted d'.
    assert!((rates[0].d_prime - compared.d_prime).abs() < 1e-6);
    assert!(rates[0].d_prime > rates[4].d_prime && rates[0].snr_db < rates[4].snr_db);
    // A decoded signal is a processed version of the original.
    assert_eq!(compared.relation, Relation::Processed);
    assert!(says(&harness, &differences::d_prime(compared.d_prime, compared.relation)));
    assert!(says(&harness, differences::meaning(compared.d_prime, compared.relation)));
    assert!(says(&harness, "not rated by people"));
    for slot in Slot::ALL {
        assert!(says(&harness, &differences::named(slot, &signal(&harness, slot).name)), "{slot:?} in full");
    }
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
}

/// Shows the differences of A and its coded version; returns the predicted d'.
fn predicted(harness: &mut Author) -> f64 {
    click(harness, signals::CODEC);
    wait_for(harness, Slot::B);
    click(harness, signals::view(View::Differences));
    wait_for_prediction(harness)
}

fn wait_for_prediction(harness: &mut Author) -> f64 {
    wait(harness, "both are compared", |h| window(h).signals().compared().is_some());
    harness.run_steps(2);
    window(harness).signals().compared().unwrap().unwrap().d_prime
}

/// A model with twice the weights of the built-in one predicts twice its d'.
#[test]
fn a_model_is_opened_kept_in_the_settings_and_never_replaced_by_a_foreign_file() {
    let folder = tempfile::tempdir().unwrap();
    let [settings, lab, other] =
        ["settings.json", "lab.json", "other.json"].map(|name| folder.path().join(name));
    std::fs::write(&settings, r#"{"has_seen_tour": true}"#).unwrap();
    std::fs::write(&other, r#"{"format": "shagreen-library", "version": "1.0"}"#).unwrap();
    let mut file = built_in_quality_model().unwrap();
    let terms = file.model.terms().iter().map(|term| Term { weight: 2.0 * term.weight, ..*term });
    file.model = QualityModel::of_terms(terms.collect()).unwrap();
    std::fs::write(&lab, write_quality_model(&file)).unwrap();
    let keeping = StoragePaths { settings: Some(settings.clone()), ..StoragePaths::default() };
    let opened = || author_of(Begin { keeping: keeping.clone(), ..begin(new_project()) }, [1280.0, 720.0]);
    let kept = || read_settings(&std::fs::read(&settings).unwrap()).0.quality_model;

    let mut harness = heard_in(opened());
    let built_in = predicted(&mut harness);
    click(&mut harness, differences::OPEN_MODEL_NAME);
    enter_path(&mut harness, strings::document::OPEN_PATH, &lab);
    wait(&mut harness, "the model is there", |h| window(h).signals().model().is_some());
    let by_lab = wait_for_prediction(&mut harness);
    assert!((by_lab / built_in - 2.0).abs() < 1e-9, "{by_lab} {built_in}");
    assert!(says(&harness, "lab.json: published weights"));
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
    wait(&mut harness, "the settings keep it", |_| kept().as_ref() == Some(&lab));

    click(&mut harness, differences::OPEN_MODEL_NAME);
    enter_path(&mut harness, strings::document::OPEN_PATH, &other);
    wait(&mut harness, "it is refused", |h| window(h).signals().model_failure().is_some());
    harness.run_steps(2);
    assert!(says(&harness, "this is not a quality model") && says(&harness, "lab.json"));
    assert_eq!(window(&harness).signals().model().map(|model| model.name.as_str()), Some("lab.json"));
    drop(harness);

    let mut harness = heard_in(opened());
    assert!(window(&harness).signals().model().is_none(), "it is read when it is needed");
    predicted(&mut harness);
    assert_eq!(window(&harness).signals().model().map(|model| model.name.as_str()), Some("lab.json"));
    click(&mut harness, differences::BUILT_IN_NAME);
    assert!(window(&harness).signals().model().is_none());
    wait(&mut harness, "the settings forget it", |_| kept().is_none());
}

#[test]
fn signals_are_felt_in_turn_and_what_is_authored_comes_back() {
    let mut harness = with_heard();
    // Waves of 1 mm: 100 Hz at the speed of the automatic stroke.
    let wave = |mm: f64| (std::f64::consts::TAU * mm).sin();
    let rows: Vec<String> =
        (0..4000).map(|i| format!("{},{}", 0.02 * f64::from(i), wave(0.02 * f64::from(i)))).collect();
    drop_files(&mut harness, &[("wave.csv", rows.join("\n").as_bytes())]);
    wait_for(&mut harness, Slot::B);
    let share_at_100_hz = |h: &Author| {
        let scope = window(h).session().scope();
        let all: f64 = scope.density().iter().map(|(_, density)| density).sum();
        let near = scope.density().iter().filter(|(hz, _)| (90.0..110.0).contains(&hz.0));
        if scope.rms(0.1) > 0.01 { near.map(|(_, density)| density).sum::<f64>() / all } else { 0.0 }
    };
    let at_first = window(&harness).session().authored().map(|authored| authored.location.at);
    click(&mut harness, &signals::feel(Slot::A));
    assert_eq!(window(&harness).signals().felt(), Some(Slot::A));
    assert!(window(&harness).session().felt_name().is_some());
    // The automatic stroke plays the signal, too.
    harness.key_press(Key::Space);
    wait(&mut harness, "something is felt", |h| window(h).session().scope().rms(0.1) > 0.01);
    harness.key_press(Key::Num2);
    harness.run_steps(2);
    assert_eq!(window(&harness).signals().felt(), Some(Slot::B));
    wait(&mut harness, "the wave is felt", |h| share_at_100_hz(h) > 0.8);
    harness.key_press(Key::Num1);
    harness.run_steps(2);
    assert_eq!(window(&harness).signals().felt(), Some(Slot::A));
    wait(&mut harness, "noise is felt", |h| (0.001..0.5).contains(&share_at_100_hz(h)));
    click(&mut harness, &signals::feel(Slot::A));
    assert_eq!(window(&harness).signals().felt(), None);
    click(&mut harness, &signals::feel(Slot::B));
    // In another workspace the authored texture plays.
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Num1);
    harness.run_steps(3);
    assert!(window(&harness).session().felt_name().is_none());
    let now = window(&harness).session().authored().map(|authored| authored.location.at);
    assert_eq!(now, at_first);
    wait(&mut harness, "what is authored is felt", |h| (0.001..0.5).contains(&share_at_100_hz(h)));
    harness.key_press(Key::Space);
    harness.run_steps(2);
}

#[test]
fn a_spectrogram_is_painted_felt_at_once_and_taken_back() {
    let mut harness = with_heard();
    click(&mut harness, signals::COPY_OF_A);
    click(&mut harness, signals::view(View::Places));
    harness.run_steps(2);
    let map = harness.get_by_role_and_label(Role::Canvas, signals::PAINTED_MAP).rect();
    let at = |across: f32, up: f32| pos2(map.left() + across * map.width(), map.bottom() - up * map.height());
    let before = level(signal(&harness, Slot::A), 0.3, 0.6);
    drag(&mut harness, at(0.35, 0.1), at(0.55, 0.1));
    let painted = signal(&harness, Slot::B);
    assert!(painted.name.ends_with("edited") && level(painted, 0.3, 0.6) > 1.2 * before);
    assert_eq!(level(signal(&harness, Slot::A), 0.3, 0.6), before, "A stays as it is");
    assert_eq!(window(&harness).signals().felt(), Some(Slot::B), "it is felt at once");
    // The only Undo button applies to the spectrogram editor here, and one stroke is one step.
    assert_eq!(harness.get_all_by_label(strings::UNDO).count(), 1);
    assert_eq!(harness.get_all_by_label(strings::REDO).count(), 1);
    click(&mut harness, strings::UNDO);
    assert_eq!(level(signal(&harness, Slot::B), 0.3, 0.6), before);
    harness.key_press_modifiers(Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::Z);
    harness.run_steps(2);
    assert!(level(signal(&harness, Slot::B), 0.3, 0.6) > 1.2 * before);

    click(&mut harness, signals::tool(Tool::Erase));
    drag(&mut harness, at(0.7, 0.005), at(0.999, 0.995));
    assert!(level(signal(&harness, Slot::B), 0.75, 0.9) < 0.6 * level(signal(&harness, Slot::A), 0.75, 0.9));
    click(&mut harness, signals::tool(Tool::Copy));
    drag(&mut harness, at(0.3, 0.01), at(0.55, 0.99));
    let erased = level(signal(&harness, Slot::B), 0.75, 0.9);
    // A short click.
    harness.hover_at(at(0.7, 0.5));
    harness.run_steps(2);
    harness.drag_at(at(0.7, 0.5));
    harness.drop_at(at(0.7, 0.5));
    harness.run_steps(2);
    assert!(level(signal(&harness, Slot::B), 0.75, 0.9) > 1.5 * erased, "what was copied is there");
    let length = signal(&harness, Slot::B).profile.length_m();
    click(&mut harness, signals::STRETCH);
    assert!((signal(&harness, Slot::B).profile.length_m() / length - 2.0).abs() < 0.02);
    // Undo also restores a replaced signal.
    click(&mut harness, signals::COPY_OF_A);
    assert_eq!(signal(&harness, Slot::B).name, signal(&harness, Slot::A).name);
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.run_steps(2);
    assert!((signal(&harness, Slot::B).profile.length_m() / length - 2.0).abs() < 0.02);
}

#[test]
fn a_signal_is_kept_as_the_relief_of_a_texture() {
    let mut harness = with_heard();
    let n_textures = window(&harness).session().textures().len();
    click(&mut harness, &signals::keep(Slot::A));
    harness.run_steps(2);
    assert_eq!(window(&harness).session().textures().len(), n_textures + 1);
    let first = window(&harness).session().textures()[0].clone();
    choose(&mut harness, signals::OVER_WHICH, &first.name);
    click(&mut harness, &signals::keep(Slot::A));
    harness.run_steps(2);
    let textures = window(&harness).session().textures();
    let [alone, over] = [&textures[n_textures], &textures[n_textures + 1]];
    assert!(alone.model.relief().is_some() && over.model.relief().is_some());
    assert!(over.model.clone().with_relief(None) == first.model);
    assert!(alone.id != over.id && over.place.is_none());
    // Nothing was edited, so undo applies to the project.
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.run_steps(3);
    assert_eq!(window(&harness).session().textures().len(), n_textures + 1);
}

#[test]
fn files_are_opened_dropped_and_refused_with_a_reason() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("carpet.wav");
    let samples: Vec<f32> = (0..4000_u16).map(|i| f32::from(i % 9) * 0.1 - 0.4).collect();
    write_wav(&path, &samples, &SidecarV1::new(2000, 2.0, 1, "test")).unwrap();
    let mut harness = author();
    click(&mut harness, Workspace::Signals.info().name);
    assert!(says(&harness, signals::EMPTY_TITLE));
    enter_path(&mut harness, &signals::path_of(Slot::A), &path);
    wait_for(&mut harness, Slot::A);
    assert_eq!((signal(&harness, Slot::A).name.as_str(), signal(&harness, Slot::A).speed.0), ("carpet", 0.1));
    // A dropped file goes to the empty slot.
    let rows: Vec<String> = (0..500).map(|i| format!("{},{}", 0.1 * f64::from(i), i % 5)).collect();
    drop_files(&mut harness, &[("bumps.csv", rows.join("\n").as_bytes())]);
    wait_for(&mut harness, Slot::B);
    assert!((signal(&harness, Slot::B).profile.length_m() - 0.05).abs() < 1e-9);
    // An invalid file leaves the slot unchanged.
    drop_files(&mut harness, &[("bumps.csv", b"hello")]);
    wait(&mut harness, "it is refused", |h| window(h).signals().failure(Slot::B).is_some());
    let reason = window(&harness).signals().failure(Slot::B).unwrap();
    assert!(reason.starts_with("bumps.csv: "), "{reason}");
    assert_eq!(signal(&harness, Slot::B).name, "bumps");
    click(&mut harness, &signals::remove(Slot::B));
    assert!(window(&harness).signals().signal(Slot::B).is_none());
    // Plays at its own speed until it is stopped.
    click(&mut harness, &signals::play(Slot::A));
    let plays = |h: &Author| window(h).session().status().is_some_and(|status| status.plays_signal);
    wait(&mut harness, "it is played", plays);
    harness.run_steps(2);
    click(&mut harness, &signals::stop(Slot::A));
    wait(&mut harness, "it is stopped", |h| !plays(h));
    // The sheet with the folder view.
    click(&mut harness, &signals::open(Slot::B));
    enter_path(&mut harness, strings::document::OPEN_PATH, &path);
    wait_for(&mut harness, Slot::B);
    assert_eq!(signal(&harness, Slot::B).name, "carpet");
}
