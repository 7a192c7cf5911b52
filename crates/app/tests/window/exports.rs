//! The export sheet: signals and texture models, one or all, and what a format cannot store.

use std::ffi::OsStr;
use std::path::Path;

use egui::accesskit::Role;
use egui::{Key, Modifiers, pos2};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use shagreen_app::choices::signals::{Slot, View};
use shagreen_app::command::Command;
use shagreen_app::state::edit::{Edit, PathChange};
use shagreen_app::strings::{authored, document, export, import, signal, signals};
use shagreen_core::space::SpacePoint;
use shagreen_core::space::texture_path::UserPath;
use shagreen_core::texture::blend::Mode;
use shagreen_core::texture::shape::ShapeControl;
use shagreen_formats::wav::SidecarV1;
use shagreen_studio::export::{FORMATS, SIGNAL_FORMATS, WAV};

use crate::projects::{menu, rename};
use crate::support::{
    Author, author, choose, choose_mode, click, drag, drop_files, enter_path, says, unnamed_controls, wait,
    wait_for_field, window, write_into,
};
use crate::views::carry_out;

#[test]
fn all_authored_textures_are_exported_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = author();
    wait_for_field(&mut harness);
    rename(&mut harness, "Oak");
    click(&mut harness, authored::ADD);
    harness.run_steps(4);
    rename(&mut harness, "Oak");
    wait_for_field(&mut harness);
    menu(&mut harness, export::EXPORT);
    harness.run_steps(4);
    click(&mut harness, &export::all_of(2));
    click(&mut harness, signal::LOOP);
    harness.run_steps(2);
    let path = folder.path().join("any.wav");
    enter_path(&mut harness, export::PATH, &path);
    let saved = export::saved_all(2, &folder.path().display().to_string());
    wait(&mut harness, "they are exported", |h| h.query_by_label(&saved).is_some());
    let mut names: Vec<String> = std::fs::read_dir(folder.path())
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    assert_eq!(names, ["oak-2.json", "oak-2.wav", "oak.json", "oak.wav"]);
    assert_eq!(std::fs::read(folder.path().join("oak.wav")).unwrap().len(), 68 + 4 * 240_000);
    click(&mut harness, import::CLOSE);
    harness.run_steps(3);
    // They are replaced only when that was said.
    menu(&mut harness, export::EXPORT);
    harness.run_steps(4);
    click(&mut harness, &export::all_of(2));
    enter_path(&mut harness, export::PATH, &path);
    wait(&mut harness, "it asks", |h| says(h, &export::exists("oak.wav, oak-2.wav", 2)));
    click(&mut harness, import::CANCEL);
    harness.run_steps(3);

    // The same in every other format; without heights, there are no maps of them.
    // Something that each of them loses.
    let lost = ["tags, description, license and origin", "the randomness", "the editable model"];
    for format in FORMATS.into_iter().filter(|format| format.id() != "maps") {
        menu(&mut harness, export::EXPORT);
        harness.run_steps(4);
        click(&mut harness, format.name());
        // What the format cannot store is listed above the choice, and moves it.
        wait(&mut harness, "it is checked", |h| lost.iter().any(|lost| says(h, lost)));
        harness.run_steps(3);
        click(&mut harness, &export::all_of(2));
        enter_path(&mut harness, export::PATH, &path);
        let saved = export::saved_all(2, &folder.path().display().to_string());
        wait(&mut harness, "they are exported", |h| h.query_by_label(&saved).is_some());
        for name in ["oak", "oak-2"] {
            let bytes = std::fs::read(folder.path().join(name).with_extension(format.ending())).unwrap();
            assert!(format.is_like(&bytes), "{name}");
        }
        click(&mut harness, import::CLOSE);
        harness.run_steps(3);
    }
}

/// The audible texture is exported at the speed and force of the automatic stroke, and the sidecar describes the
/// signal.
#[test]
fn what_is_heard_is_exported_as_a_signal() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("oak.wav");
    let mut harness = author();
    wait_for_field(&mut harness);
    rename(&mut harness, "Oak copy");
    menu(&mut harness, export::EXPORT);
    harness.run_steps(4);
    let field = harness.get_by_role_and_label(Role::TextInput, export::PATH);
    assert!(field.accesskit_node().value().unwrap().ends_with("oak-copy.wav"));
    enter_path(&mut harness, export::PATH, &path);
    let saved = import::saved(&path.display().to_string());
    wait(&mut harness, "it is exported", |h| h.query_by_label(&saved).is_some());
    click(&mut harness, import::CLOSE);
    harness.run_steps(3);

    let sidecar: SidecarV1 =
        serde_json::from_slice(&std::fs::read(folder.path().join("oak.json")).unwrap()).unwrap();
    assert_eq!((sidecar.rate_hz, sidecar.seconds, sidecar.at), (48_000, 5.0, Some(vec![50.0, 50.0])));
    let named: Vec<(String, f64)> = sidecar.at_named.into_iter().flatten().collect();
    assert_eq!(named, [("hard-soft".to_owned(), 50.0), ("rough-smooth".to_owned(), 50.0)]);
    assert_eq!((sidecar.trace.speed_mm_per_s[0], sidecar.blend.as_str()), (100.0, "field"));
    assert_eq!(sidecar.label_source.as_deref(), Some("physical"));
    let bytes = std::fs::read(&path).unwrap();
    let (head, samples) = bytes.split_at(bytes.len() - 4 * 240_000);
    assert!(head.starts_with(b"RIFF"));
    let squares =
        samples.as_chunks::<4>().0.iter().map(|bytes| f64::from(f32::from_le_bytes(*bytes)).powi(2));
    // Players get at most −1 dB; the sidecar states the acceleration at full scale.
    let level = sidecar.full_scale * (squares.sum::<f64>() / 240_000.0).sqrt();
    let peak =
        samples.as_chunks::<4>().0.iter().map(|bytes| f32::from_le_bytes(*bytes).abs()).fold(0.0, f32::max);
    assert!((peak - 0.891).abs() < 1e-3, "{peak}");
    // The level equals that of the shown spectrum, within the noise of five seconds.
    let spectra = window(&harness).session().spectra();
    let steps = spectra.frequencies.windows(2).map(|f| f[1].0 - f[0].0);
    let modeled = steps.zip(&spectra.blend).map(|(df, p)| df * p).sum::<f64>().sqrt();
    assert!((level / modeled - 1.0).abs() < 0.15, "{level} m/s² for {modeled}");

    let refused = |path: &Path| export::not_replaced(&path.display().to_string());
    // A WAV file without a sidecar of Shagreen is not overwritten.
    let other = folder.path().join("recorded.wav");
    std::fs::copy(&path, &other).unwrap();
    menu(&mut harness, export::EXPORT);
    write_into(&mut harness, export::PATH, &other.display().to_string());
    harness.key_press(Key::Enter);
    wait(&mut harness, "it refuses", |h| says(h, &refused(&other)));
    click(&mut harness, document::CANCEL);
    harness.run_steps(4);

    // Neither is another kind of file at the path of the sidecar.
    let other = folder.path().join("other.wav");
    let beside = folder.path().join("other.json");
    std::fs::write(&beside, "{\"mine\": 1}").unwrap();
    menu(&mut harness, export::EXPORT);
    enter_path(&mut harness, export::PATH, &other);
    wait(&mut harness, "it refuses", |h| says(h, &refused(&beside)));
    assert!(!other.exists());
}

/// Every other format of signals names what it lacks before it is written.
#[test]
fn what_is_heard_is_exported_as_envelopes() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = author();
    wait_for_field(&mut harness);
    for format in SIGNAL_FORMATS.into_iter().filter(|format| !format.stores_samples()) {
        menu(&mut harness, export::EXPORT);
        harness.run_steps(4);
        click(&mut harness, format.name());
        wait(&mut harness, "it is checked", |h| says(h, "the fine structure of the vibration"));
        assert!(harness.query_by_role_and_label(Role::ComboBox, signal::SAMPLES).is_none());
        let field = harness.get_by_role_and_label(Role::TextInput, export::PATH);
        let shown = field.accesskit_node().value().unwrap();
        assert!(shown.ends_with(&format!(".{}", format.ending())), "{shown}");
        harness.run_steps(3);
        let path = folder.path().join("oak").with_extension(format.ending());
        enter_path(&mut harness, export::PATH, &path);
        let saved = import::saved(&path.display().to_string());
        wait(&mut harness, "it is exported", |h| h.query_by_label(&saved).is_some());
        assert!(format.may_replace(&path, &std::fs::read(&path).unwrap()), "{}", format.id());
        click(&mut harness, import::CLOSE);
        harness.run_steps(3);
    }
}

/// A signal without vibration is written, and the sheet warns of it, as the command line does.
#[test]
fn a_silent_export_is_warned_of() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("still.wav");
    let mut harness = author();
    wait_for_field(&mut harness);
    // A tip that rests on the surface.
    let mut table = "t_s,x_mm,y_mm,force_n\n".to_owned();
    table.extend((0..50).map(|i| format!("{:.2},0,0,1\n", 0.01 * f64::from(i))));
    drop_files(&mut harness, &[("still.csv", table.as_bytes())]);
    wait(&mut harness, "it is read", |h| window(h).session().n_strokes() == 1);
    menu(&mut harness, export::EXPORT);
    harness.run_steps(4);
    choose(&mut harness, signal::MOTION, signal::motion(true));
    enter_path(&mut harness, export::PATH, &path);
    let saved = import::saved(&path.display().to_string());
    wait(&mut harness, "it is exported", |h| h.query_by_label(&saved).is_some());
    assert!(says(&harness, &export::warning("the signal is silent: the speed is 0")));
}

/// A format that needs heights says so before the export, and nothing is written.
#[test]
fn a_format_that_cannot_hold_the_texture_says_why() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = author();
    wait_for_field(&mut harness);
    menu(&mut harness, export::EXPORT);
    harness.run_steps(4);
    let maps = FORMATS.into_iter().find(|format| format.id() == "maps").unwrap();
    click(&mut harness, maps.name());
    wait(&mut harness, "it is checked", |h| says(h, "the texture has no height map"));
    enter_path(&mut harness, export::PATH, &folder.path().join("oak.gltf"));
    harness.run_steps(20);
    assert!(says(&harness, "the texture has no height map"));
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn each_format_lists_what_it_cannot_store() {
    let mut harness = author();
    wait_for_field(&mut harness);
    menu(&mut harness, export::EXPORT);
    harness.run_steps(4);
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
    let one_stroke = export::lost("all tip speeds and normal forces except those of this stroke");
    wait(&mut harness, "it is checked", |h| says(h, &one_stroke));
    let has_length = |h: &Author| h.query_by_role_and_label(Role::SpinButton, signal::LENGTH).is_some();
    assert!(has_length(&harness) && says(&harness, WAV.help));
    let terms = export::lost("tags, description, license and origin");
    assert!(!says(&harness, &terms));
    let hatt = FORMATS[0];
    click(&mut harness, hatt.name());
    wait(&mut harness, "it is checked", |h| says(h, &terms));
    assert!(!says(&harness, &one_stroke) && !has_length(&harness));
    let field = harness.get_by_role_and_label(Role::TextInput, export::PATH);
    let path = field.accesskit_node().value().unwrap();
    assert_eq!(Path::new(&path).extension(), Some(OsStr::new("xml")), "the ending follows the format");
    harness.run_steps(3);
    click(&mut harness, import::CANCEL);
    harness.run_steps(4);
    // A mode that mixes signals has no texture model.
    choose_mode(&mut harness, Mode::Shared);
    menu(&mut harness, export::EXPORT);
    harness.run_steps(4);
    assert!(harness.get_by_label(hatt.name()).accesskit_node().is_disabled());
    assert!(!harness.get_by_label(WAV.name).accesskit_node().is_disabled());
}

/// A painted signal is asked about before it is lost, but not after it was exported.
#[test]
fn an_exported_signal_counts_as_saved() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("painted.wav");
    let mut harness = author();
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Num3);
    harness.run_steps(2);
    wait_for_field(&mut harness);
    click(&mut harness, &signals::take_heard(Slot::A));
    wait(&mut harness, "a signal is there", |h| window(h).signals().signal(Slot::A).is_some());
    harness.run_steps(2);
    click(&mut harness, signals::COPY_OF_A);
    click(&mut harness, signals::view(View::Places));
    harness.run_steps(2);
    let map = harness.get_by_role_and_label(Role::Canvas, signals::PAINTED_MAP).rect();
    let at = |across: f32| pos2(map.left() + across * map.width(), map.bottom() - 0.1 * map.height());
    drag(&mut harness, at(0.35), at(0.55));
    assert_eq!(window(&harness).signals().felt(), Some(Slot::B), "it is felt at once");
    menu(&mut harness, document::QUIT);
    assert!(says(&harness, document::LEAVE_PAINTING));
    click(&mut harness, document::CANCEL);
    harness.run_steps(3);
    menu(&mut harness, export::EXPORT);
    enter_path(&mut harness, export::PATH, &path);
    let saved = import::saved(&path.display().to_string());
    wait(&mut harness, "it is exported", |h| h.query_by_label(&saved).is_some());
    click(&mut harness, import::CLOSE);
    harness.run_steps(3);
    menu(&mut harness, document::QUIT);
    assert!(!says(&harness, document::LEAVE_PAINTING));
    // Painted once more, it is asked about again.
    drag(&mut harness, at(0.35), at(0.55));
    menu(&mut harness, document::QUIT);
    assert!(says(&harness, document::LEAVE_PAINTING));
}

/// Samples of a WAV file of 32-bit floats, and the acceleration at full scale in its sidecar.
fn exported(path: &Path) -> (Vec<f32>, f64) {
    let bytes = std::fs::read(path).unwrap();
    let sidecar: SidecarV1 =
        serde_json::from_slice(&std::fs::read(path.with_extension("json")).unwrap()).unwrap();
    let (_, samples) = bytes.split_at(bytes.len() - 4 * 240_000);
    let samples = samples.as_chunks::<4>().0.iter().map(|bytes| f32::from_le_bytes(*bytes));
    (samples.collect(), sidecar.full_scale)
}

/// All textures are written at one scale, into a folder that is created. What the files lack is listed: a path, and the levels
/// if each file has a scale of its own.
#[test]
fn textures_that_are_exported_together_keep_their_levels() {
    let parent = tempfile::tempdir().unwrap();
    let folder = parent.path().join("new folder");
    let mut harness = author();
    wait_for_field(&mut harness);
    rename(&mut harness, "loud");
    carry_out(&mut harness, Command::DuplicateTexture);
    rename(&mut harness, "quiet");
    carry_out(&mut harness, Command::Edit(Edit::SetShape(ShapeControl::Level, -12.0)));
    let points = [30.0, 60.0].map(|rough_smooth| SpacePoint::new(rough_smooth, 50.0).unwrap());
    let path = UserPath { points: points.to_vec(), ..UserPath::default() };
    carry_out(&mut harness, Command::Edit(Edit::ChangePath(PathChange::Draw, Some(path))));
    wait_for_field(&mut harness);
    menu(&mut harness, export::EXPORT);
    harness.run_steps(4);
    wait(&mut harness, "the path is named", |h| says(h, &export::lost(export::PATH_LOST)));
    click(&mut harness, &export::all_of(2));
    wait(&mut harness, "it is named", |h| says(h, &export::lost(&export::paths_lost(&["quiet"]))));
    click(&mut harness, signal::ONE_SCALE);
    wait(&mut harness, "the levels are named", |h| says(h, &export::lost(export::LEVELS_LOST)));
    click(&mut harness, signal::ONE_SCALE);
    wait(&mut harness, "they are stored", |h| !says(h, export::LEVELS_LOST));
    enter_path(&mut harness, export::PATH, &folder);
    let saved = export::saved_all(2, &folder.display().to_string());
    wait(&mut harness, "they are exported", |h| h.query_by_label(&saved).is_some());
    let [loud, quiet] = ["loud", "quiet"].map(|name| exported(&folder.join(name).with_extension("wav")));
    assert_eq!(loud.1, quiet.1, "one scale");
    let peak = |samples: &[f32]| samples.iter().fold(0.0_f32, |peak, x| peak.max(x.abs()));
    assert!((peak(&loud.0) - 0.891).abs() < 1e-3, "{}", peak(&loud.0));
    // The same noise, 12 dB weaker.
    let ratio = f64::from(peak(&quiet.0) / peak(&loud.0));
    assert!((ratio - 10_f64.powf(-0.6)).abs() < 1e-3, "{ratio}");
    click(&mut harness, import::CLOSE);
}
