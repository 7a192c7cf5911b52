//! Figures of a space: what their dots say, and their files.

use std::path::Path;

use egui::Key;
use egui::accesskit::Role;
use egui_kittest::kittest::Queryable as _;
use shagreen_app::strings::{self, build, import};
use shagreen_core::space::LabelSource;
use shagreen_formats::library::read_library;

use super::{built, use_space};
use crate::support::{Author, click, enter_path, painted, says, wait, window, words};

/// Saves the shown figure to a file.
fn save(harness: &mut Author, button: &str, path: &Path) {
    click(harness, button);
    harness.run_steps(2);
    enter_path(harness, build::SAVE_PATH, path);
}

/// The scatter plots are dense: almost every texture is labeled, and pointing at a dot shows its name and numbers.
#[test]
fn dots_of_a_figure_have_names_and_say_them() {
    let mut harness = built();
    click(&mut harness, build::figure("perceptual-space"));
    harness.run_steps(2);
    let figures = &window(&harness).build().built().unwrap().figures;
    let title = figures.iter().find(|(name, _)| name == "perceptual-space").unwrap().1.title();
    let written: Vec<String> = painted(&harness, &title).iter().filter_map(words).collect();
    let textures = window(&harness).session().textures();
    let n_named = textures.iter().filter(|texture| written.contains(&texture.id)).count();
    assert!(n_named >= 24, "{n_named} of 25 are named: {written:?}");
    let dots: Vec<egui::Pos2> = painted(&harness, &title)
        .iter()
        .filter_map(|shape| if let egui::Shape::Circle(dot) = shape { Some(dot.center) } else { None })
        .collect();
    assert_eq!(dots.len(), 25);
    for dot in [dots[0], dots[12]] {
        harness.hover_at(dot);
        harness.run_steps(3);
        let said: Vec<String> = painted(&harness, &title).iter().filter_map(words).collect();
        let textures = window(&harness).session().textures();
        let is_said = |words: &String| {
            words.split_once('\n').is_some_and(|(name, _)| textures.iter().any(|t| t.id == name))
        };
        assert_eq!(said.iter().filter(|words| is_said(words)).count(), 1, "{said:?}");
    }
}

#[test]
fn figures_and_the_library_are_saved_and_nothing_else_is_replaced() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = built();
    let (svg, csv) = (folder.path().join("stress.svg"), folder.path().join("stress.csv"));
    for (button, path) in [(build::SAVE_SVG, &svg), (build::SAVE_CSV, &csv)] {
        save(&mut harness, button, path);
        let saved = import::saved(&path.display().to_string());
        wait(&mut harness, "it is saved", |h| h.query_by_label(&saved).is_some());
        click(&mut harness, import::CLOSE);
    }
    assert!(std::fs::read_to_string(&svg).unwrap().contains("simulated raters"));
    assert!(std::fs::read_to_string(&csv).unwrap().starts_with("series,label,x: "));
    // A different kind of file is not overwritten, and the folder is remembered.
    save(&mut harness, build::SAVE_SVG, &csv);
    wait(&mut harness, "it refuses", |h| says(h, &build::no_figure("SVG")));
    assert!(std::fs::read_to_string(&csv).unwrap().starts_with("series,label,x: "));
    click(&mut harness, import::CANCEL);
    click(&mut harness, build::SAVE_CSV);
    harness.run_steps(2);
    assert!(says(&harness, &folder.path().join("simulated-stress.csv").display().to_string()));
    click(&mut harness, import::CANCEL);

    use_space(&mut harness);
    let path = folder.path().join("library.json");
    click(&mut harness, strings::SAVE_LIBRARY);
    harness.run_steps(2);
    harness.get_by_role_and_label(Role::TextInput, import::SAVE_PATH).type_text(&path.display().to_string());
    harness.run_steps(2);
    harness.key_press(Key::Enter);
    let saved = import::saved(&path.display().to_string());
    wait(&mut harness, "the library is saved", |h| h.query_by_label(&saved).is_some());
    let library = read_library(&std::fs::read(&path).unwrap()).unwrap().value;
    assert_eq!(library.label_source(), Some(LabelSource::SimulatedRaters));
    assert!(library.space_report.is_some() && library.textures[0].attributes.is_some());
}
