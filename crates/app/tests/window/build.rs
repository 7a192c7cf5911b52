//! The Build workspace: reading judgments, building, viewing, saving and using a space, and undo.

use std::path::Path;

use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT, Queryable};
use shagreen_app::command::Command;
use shagreen_app::command::axes::AxesCommand;
use shagreen_app::strings::{self, build, import};
use shagreen_app::workspace::Workspace;
use shagreen_core::people::panel::{PanelConfig, simulated_ratings, simulated_sorts};
use shagreen_core::space::LabelSource;
use shagreen_core::space::space_build::FeatureKind;
use shagreen_formats::library::read_library;
use shagreen_formats::questionnaire::{is_blank_ratings, questionnaires};
use shagreen_formats::ratings_csv::ratings_csv;
use shagreen_formats::sorting_csv::sorting_csv;
use shagreen_formats::space_report::RATING_FIGURE;
use shagreen_formats::starter::starter_library;
use shagreen_studio::questionnaire::ExperimentFile;

use crate::support::{
    Author, author, author_on, choose, click, drop_files, enter_path, painted, says, shown, unnamed_controls,
    wait, window, words, write_into,
};
use crate::views::carry_out;

/// Window in the Build workspace.
fn builder() -> Author {
    let mut harness = author();
    click(&mut harness, Workspace::Build.info().name);
    assert_eq!(window(&harness).workspace(), Workspace::Build);
    harness
}

/// Space built from simulated raters, with the fastest options.
fn built() -> Author {
    let mut harness = builder();
    click(&mut harness, build::SIMULATE);
    wait(&mut harness, "the panel has judged", |h| !window(h).build().judgments().is_reading());
    harness.run_steps(2);
    set_number(&mut harness, build::PERMUTATIONS, 19.0);
    choose(&mut harness, build::FEATURES, build::features(FeatureKind::Physical));
    click(&mut harness, build::BUILD_SPACE);
    assert!(window(&harness).build().is_building());
    wait(&mut harness, "the space is built", |h| !window(h).build().is_building());
    assert!(window(&harness).build().built().is_some(), "{:?}", shown(&harness));
    harness.run_steps(2);
    harness
}

/// Uses the built space and shows the Author workspace.
fn use_space(harness: &mut Author) {
    click(harness, build::USE_SPACE);
    harness.run_steps(2);
    click(harness, build::GO_TO_AUTHOR);
    harness.run_steps(2);
}

fn set_number(harness: &mut Author, name: &str, value: f64) {
    harness.get_by_role_and_label(Role::SpinButton, name).set_value_accesskit(value);
    harness.run_steps(2);
}

/// Shows the figure with this name; those of mean ratings share a tab, in which the adjective pair is chosen.
fn show_figure(harness: &mut Author, name: &str) {
    let tab = build::figure(name);
    click(harness, tab);
    harness.run_steps(2);
    if let Some(number) = name.strip_prefix(RATING_FIGURE) {
        let number: usize = number.parse().unwrap();
        let pair = window(harness).build().built().unwrap().build.adjectives[number - 1].pair.name();
        choose(harness, build::RATED_PAIR, &pair);
    }
}

/// Saves the shown figure to a file.
fn save(harness: &mut Author, button: &str, path: &Path) {
    click(harness, button);
    harness.run_steps(2);
    enter_path(harness, build::SAVE_PATH, path);
}

/// Types a path into the field of a table and reads the file.
fn read(harness: &mut Author, what: &str, path: &Path) {
    let field = build::path_of(what);
    write_into(harness, &field, &path.display().to_string());
    click(harness, &build::read(what));
    wait(harness, "the table is read", |h| !window(h).build().judgments().is_reading());
    harness.run_steps(2);
}

/// What is typed after a table was read reaches the field under the pointer.
#[test]
fn fields_stay_where_they_are_when_a_table_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let sorts = folder.path().join("sorts.csv");
    std::fs::write(&sorts, &tables("person ")[0]).unwrap();
    let mut harness = author();
    click(&mut harness, Workspace::Build.info().name);
    harness.run_steps(2);
    let top =
        |h: &Author, what: &str| h.get_by_role_and_label(Role::TextInput, &build::path_of(what)).rect().top();
    let before = [build::RATINGS, build::VOTES].map(|what| top(&harness, what));
    read(&mut harness, build::SORTING, &sorts);
    assert!(window(&harness).build().judgments().sorting.read.is_some());
    let after = [build::RATINGS, build::VOTES].map(|what| top(&harness, what));
    for (before, after) in before.into_iter().zip(after) {
        assert!((before - after).abs() < 1.0, "{before} became {after}");
    }
}

/// Main use: from judgments to a space in use, and back.
#[test]
fn a_space_is_built_looked_at_used_and_undone() {
    let mut harness = built();
    let space = window(&harness).build().built().unwrap().build.clone();
    assert_eq!(space.source, LabelSource::SimulatedRaters);
    for (name, figure) in window(&harness).build().built().unwrap().figures.clone() {
        show_figure(&mut harness, &name);
        assert!(says(&harness, &figure.title()), "{name} is not shown");
        assert!(figure.title().contains("simulated raters"), "{}", figure.title());
    }
    assert!(says(&harness, "nested cross-validation") && says(&harness, "no person felt the textures"));

    let before = window(&harness).session().library().clone();
    let (space_before, source_before) =
        (window(&harness).session().space().clone(), window(&harness).session().label_source());
    click(&mut harness, build::USE_SPACE);
    harness.run_steps(2);
    let session = window(&harness).session();
    assert_eq!(session.label_source(), "simulated raters");
    assert!(says(&harness, "positions: simulated raters"));
    for (index, texture) in session.textures().iter().enumerate() {
        let at = space.textures.iter().position(|id| *id == texture.id).map(|i| space.positions[i]);
        assert_eq!(session.space().position(index), at);
        assert!(texture.attributes.as_ref().is_some_and(|a| a.source == LabelSource::SimulatedRaters));
    }
    assert!(session.library().space_report.is_some());

    // The interpolated texture has the new contributing textures and is audible.
    click(&mut harness, build::GO_TO_AUTHOR);
    assert_eq!(window(&harness).workspace(), Workspace::Author);
    click(&mut harness, strings::HAND_START);
    wait(&mut harness, "it sounds", |h| window(h).session().scope().rms(0.3) > 1e-4);
    click(&mut harness, strings::HAND_STOP);

    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.run_steps(3);
    let session = window(&harness).session();
    assert_eq!(*session.library(), before, "places, attributes and report are as they were");
    assert_eq!((session.space(), session.label_source()), (&space_before, source_before));
    harness.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    harness.run_steps(3);
    assert_eq!(window(&harness).session().label_source(), "simulated raters");
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

/// Tables of sortings and ratings with participants of this name prefix, for human or simulated raters.
fn tables(prefix: &str) -> [Vec<u8>; 2] {
    let library = starter_library().unwrap();
    let placed = library.textures.iter().map(|t| (t.id.clone(), t.at().unwrap()));
    let (names, labels): (Vec<String>, Vec<Vec<f64>>) =
        placed.map(|(id, at)| (id, vec![at.x(), at.y()])).unzip();
    let config = PanelConfig {
        n_participants: 12,
        noise_points: 5.0,
        bias_points: 2.0,
        scale_log_spread: 0.1,
        seed: 9,
    };
    let pairs = ["rough-smooth", "hard-soft"].map(|name| name.parse().unwrap());
    let mut sorts = simulated_sorts(&names, &labels, &[4, 8], &config).unwrap();
    let mut ratings = simulated_ratings(&names, &labels, &pairs, &config).unwrap();
    for name in
        sorts.iter_mut().map(|s| &mut s.participant).chain(ratings.iter_mut().map(|r| &mut r.participant))
    {
        *name = name.replace("simulated-", prefix);
    }
    [sorting_csv(&sorts), ratings_csv(&ratings)]
}

/// The columns identify dropped tables, and the names of the participants identify simulated raters.
#[test]
fn dropped_tables_become_a_space_that_says_who_judged() {
    for (prefix, source) in [("person ", "human ratings"), ("simulated-", "simulated raters")] {
        let mut harness = builder();
        let [sorting, ratings] = tables(prefix);
        drop_files(&mut harness, &[("b.csv", &ratings), ("a.csv", &sorting)]);
        wait(&mut harness, "both are read", |h| !window(h).build().judgments().is_reading());
        harness.run_steps(2);
        assert!(window(&harness).import().is_none(), "they are no recordings");
        assert!(says(&harness, "12 participants, 24 sorts, 25 textures"));
        assert!(says(&harness, "12 participants, 600 ratings, 25 textures, 2 pairs"));
        set_number(&mut harness, build::PERMUTATIONS, 0.0);
        choose(&mut harness, build::FEATURES, build::features(FeatureKind::Physical));
        click(&mut harness, build::BUILD_SPACE);
        wait(&mut harness, "the space is built", |h| !window(h).build().is_building());
        harness.run_steps(2);
        assert!(window(&harness).build().built().is_some(), "{:?}", shown(&harness));
        let is_simulated = source == "simulated raters";
        let figures = &window(&harness).build().built().unwrap().figures;
        assert!(figures.iter().all(|(_, figure)| figure.title().contains("simulated") == is_simulated));
        assert_eq!(says(&harness, build::ASSUMED_PEOPLE), !is_simulated);
        // Positions that features predict are estimates, even if people rated the textures.
        let from = match window(&harness).build().built().unwrap().build.place_source() {
            LabelSource::Estimated => strings::PREDICTED_FROM_RATINGS,
            placed => placed.label(),
        };
        assert_eq!(window(&harness).build().built().unwrap().build.source.label(), source);
        use_space(&mut harness);
        assert!(says(&harness, &format!("Positions: {from}")));
    }
}

/// Without a sorting table, the positions are the mean ratings, and every figure that needs sorts says why it is empty.
#[test]
fn ratings_alone_become_a_space() {
    let mut harness = builder();
    let [_, ratings] = tables("person ");
    drop_files(&mut harness, &[("b.csv", &ratings)]);
    wait(&mut harness, "they are read", |h| !window(h).build().judgments().is_reading());
    harness.run_steps(2);
    for name in [build::DIMENSIONS, build::PERMUTATIONS] {
        let control = harness.get_by_role_and_label(Role::SpinButton, name);
        assert_eq!(control.accesskit_node().is_disabled(), name == build::DIMENSIONS, "{name}");
    }
    set_number(&mut harness, build::PERMUTATIONS, 0.0);
    choose(&mut harness, build::FEATURES, build::features(FeatureKind::Physical));
    click(&mut harness, build::BUILD_SPACE);
    wait(&mut harness, "the space is built", |h| !window(h).build().is_building());
    harness.run_steps(2);
    let built = window(&harness).build().built().unwrap().build.clone();
    assert!(built.perceptual.is_none() && built.source == LabelSource::HumanRatings);
    // The mean ratings are shown first.
    assert!(says(&harness, "rough–smooth: mean ratings of 12 raters"), "{:?}", shown(&harness));
    assert!(says(&harness, "Built from ratings alone") && says(&harness, "nested correlation"));
    for (name, figure) in window(&harness).build().built().unwrap().figures.clone() {
        show_figure(&mut harness, &name);
        assert!(says(&harness, &figure.title()), "{name} is not shown");
        let needs_sorts = ["stress", "perceptual-space", "shepard"].contains(&name.as_str());
        assert_eq!(figure.title().contains("empty, because there are no sorts"), needs_sorts, "{name}");
    }
    use_space(&mut harness);
    assert!(says(&harness, "Positions: human ratings"));
    let session = window(&harness).session();
    for (index, texture) in session.textures().iter().enumerate() {
        let at = built.textures.iter().position(|id| *id == texture.id).map(|i| built.positions[i]);
        assert_eq!(session.space().position(index), at);
    }
}

/// A blank table of a questionnaire is saved, and replaces no table with answers.
#[test]
fn a_questionnaire_is_saved_and_replaces_no_answers() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = builder();
    let name = questionnaires().unwrap()[0].name.clone();
    let path = folder.path().join("ratings.csv");
    let ask = |harness: &mut Author| {
        click(harness, build::QUESTIONNAIRES);
        harness.run_steps(2);
        click(harness, &build::blank_file_of(ExperimentFile::Ratings, &name));
        harness.run_steps(2);
        enter_path(harness, build::BLANK_PATH, &path);
    };
    ask(&mut harness);
    let saved = import::saved(&path.display().to_string());
    wait(&mut harness, "it is saved", |h| h.query_by_label(&saved).is_some());
    click(&mut harness, import::CLOSE);
    let bytes = std::fs::read(&path).unwrap();
    assert!(is_blank_ratings(&bytes));
    let text = String::from_utf8(bytes).unwrap();
    assert!(text.starts_with("participant,texture,rough-smooth,flat-bumpy,sticky-slippery,"), "{text}");
    assert_eq!(text.lines().count(), 1 + 12 * 25);
    let filled = text.replacen(",,,,,", ",41,,,,", 1);
    std::fs::write(&path, &filled).unwrap();
    ask(&mut harness);
    wait(&mut harness, "it refuses", |h| says(h, build::NOT_BLANK));
    assert_eq!(std::fs::read_to_string(&path).unwrap(), filled);
    click(&mut harness, import::CANCEL);
}

/// Ratings on another scale are converted; a rating outside the scale is named.
#[test]
fn the_scale_of_the_ratings_can_be_stated() {
    let mut harness = builder();
    let [sorting, ratings] = tables("person ");
    drop_files(&mut harness, &[("b.csv", &ratings), ("a.csv", &sorting)]);
    wait(&mut harness, "both are read", |h| !window(h).build().judgments().is_reading());
    harness.run_steps(2);
    set_number(&mut harness, build::SCALE_HIGH, 7.0);
    click(&mut harness, build::BUILD_SPACE);
    assert!(!window(&harness).build().is_building());
    harness.run_steps(2);
    assert!(says(&harness, "which is not on the stated scale"), "{:?}", shown(&harness));
    set_number(&mut harness, build::SCALE_HIGH, 100.0);
    assert!(!says(&harness, "which is not on the stated scale"));
    set_number(&mut harness, build::PERMUTATIONS, 19.0);
    click(&mut harness, build::BUILD_SPACE);
    let is_done = |h: &Author| window(h).build().built().is_some();
    wait(&mut harness, "it is built", is_done);
}

#[test]
fn two_attributes_of_a_space_become_the_axes() {
    let mut harness = built();
    use_space(&mut harness);
    let places = window(&harness).session().space().clone();
    // The positions have an axis of the same name.
    let axes = ["attribute:rough-smooth", "sticky-slippery"].map(str::to_owned).to_vec();
    carry_out(&mut harness, Command::Axes(AxesCommand::Use(axes.clone())));
    let session = window(&harness).session();
    assert_eq!(window(&harness).project().axes, Some(axes));
    assert_eq!(session.poles(), &[["rough", "smooth"], ["sticky", "slippery"]]);
    for (index, texture) in session.textures().iter().enumerate() {
        let at = session.space().position(index).unwrap();
        let attributes = texture.attributes.as_ref().unwrap();
        assert_eq!(Some(at.x()), attributes.get("rough-smooth"));
        assert_eq!(Some(at.y()), attributes.get("sticky-slippery"));
    }
    assert!(harness.query_by_role_and_label(Role::Slider, "Sticky to slippery").is_some());
    assert!(harness.query_by_role_and_label(Role::Slider, strings::HARD_SOFT).is_none());
    click(&mut harness, strings::UNDO);
    assert_eq!(*window(&harness).session().space(), places);
    assert!(harness.query_by_role_and_label(Role::Slider, strings::HARD_SOFT).is_some());
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
    assert!(std::fs::read_to_string(&csv).unwrap().starts_with("series,label,x,y,source\n"));
    // A different kind of file is not overwritten, and the folder is remembered.
    save(&mut harness, build::SAVE_SVG, &csv);
    wait(&mut harness, "it refuses", |h| says(h, &build::no_figure("SVG")));
    assert!(std::fs::read_to_string(&csv).unwrap().starts_with("series,label,x,y,source\n"));
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

#[test]
fn a_bad_table_says_why_and_nothing_is_lost() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = builder();
    assert!(says(&harness, build::SORTING_EXAMPLE), "an example is shown");
    let good = folder.path().join("good.csv");
    std::fs::write(&good, "participant,trial,groups,cork,felt,glass\np1,1,2,a,a,b\np2,1,2,x,,y\n").unwrap();
    read(&mut harness, build::SORTING, &good);
    assert!(says(&harness, "2 participants, 2 sorts, 3 textures"));
    let bad = folder.path().join("bad.csv");
    std::fs::write(&bad, "participant,trial,groups,cork\np,1,many,a\n").unwrap();
    read(&mut harness, build::SORTING, &bad);
    assert!(says(&harness, "groups in line 2 is \"many\""), "{:?}", shown(&harness));
    assert!(says(&harness, "2 participants, 2 sorts, 3 textures"), "what was read stays");
    assert_eq!(window(&harness).build().judgments().sorting.values().len(), 2);
    read(&mut harness, build::RATINGS, &folder.path().join("nowhere.csv"));
    assert!(says(&harness, "cannot be read"));

    // An unknown texture is named when the table is read, and again when building fails.
    let unknown = folder.path().join("unknown.csv");
    std::fs::write(&unknown, "participant,texture,rough-smooth,hard-soft\np1,cork,3,4\np1,moon-dust,5,6\n")
        .unwrap();
    read(&mut harness, build::RATINGS, &unknown);
    assert!(says(&harness, "moon-dust"));
    click(&mut harness, build::BUILD_SPACE);
    wait(&mut harness, "it fails", |h| !window(h).build().is_building());
    harness.run_steps(2);
    assert!(says(&harness, "\"moon-dust\" was rated, but no texture of the library has this id"));
    assert!(window(&harness).build().built().is_none());
    click(&mut harness, &build::remove(build::RATINGS));
    harness.run_steps(2);
    assert!(says(&harness, build::NEEDS_RATINGS), "{:?}", shown(&harness));
}

#[test]
fn building_can_be_cancelled_and_what_was_built_stays() {
    let mut harness = built();
    let before = window(&harness).build().built().unwrap().build.clone();
    set_number(&mut harness, build::SEED, 7.0);
    set_number(&mut harness, build::PERMUTATIONS, 200.0);
    assert!(says(&harness, build::CHANGED));
    click(&mut harness, build::BUILD_AGAIN);
    assert!(window(&harness).build().is_building());
    click(&mut harness, build::CANCEL);
    assert!(!window(&harness).build().is_building());
    // The job checks for cancellation many times a second, so it may have stopped before the next frame. Until then the
    // button is disabled.
    if says(&harness, build::STOPPING) {
        assert!(harness.get_by_label(build::CANCEL).accesskit_node().is_disabled());
    }
    wait(&mut harness, "it has stopped", |h| !window(h).build().is_stopping());
    harness.run_steps(2);
    let now = window(&harness).build().built().unwrap().build.clone();
    assert!(std::sync::Arc::ptr_eq(&before, &now), "what is late reaches nobody");
    assert!(harness.query_by_label(build::BUILD_AGAIN).is_some(), "it can be tried again");
}

/// All build options are visible without scrolling, with and without judgments.
#[test]
fn nothing_of_the_options_is_cut_off() {
    for size in [[1280.0, 720.0], [1000.0, 700.0]] {
        let mut harness = author_on(starter_library().unwrap(), size);
        click(&mut harness, Workspace::Build.info().name);
        for is_read in [false, true] {
            if is_read {
                click(&mut harness, build::SIMULATE);
                wait(&mut harness, "the panel has judged", |h| !window(h).build().judgments().is_reading());
            }
            harness.run_steps(3);
            let button = harness.get_by_label(build::BUILD_SPACE).rect();
            let rows = [build::DIMENSIONS, build::PERMUTATIONS, build::SEED]
                .map(|name| harness.get_by_role_and_label(Role::SpinButton, name).rect());
            let last = harness.get_by_role_and_label(Role::CheckBox, build::ORTHOGONAL).rect();
            let ties = harness.get_by_role_and_label(Role::ComboBox, build::TIES).rect();
            for rect in rows.into_iter().chain([last, ties]) {
                assert!(rect.bottom() <= button.top(), "{rect:?} is below {button:?} at {size:?}, {is_read}");
                assert!(
                    rect.right() <= button.right() + 1.0,
                    "{rect:?} is wider than {button:?} at {size:?}"
                );
            }
        }
    }
}

#[test]
fn the_keyboard_changes_workspaces_and_the_hand_does_not_start_unseen() {
    let mut harness = author();
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Num2);
    harness.run_steps(2);
    assert_eq!(window(&harness).workspace(), Workspace::Build);
    harness.key_press(Key::Space);
    harness.run_steps(2);
    assert!(!window(&harness).session().hand_is_running());
    assert!(harness.query_by_role_and_label(Role::ComboBox, strings::OUTPUT).is_some(), "the status stays");
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Num1);
    harness.run_steps(2);
    assert_eq!(window(&harness).workspace(), Workspace::Author);
}

#[test]
fn every_control_has_a_name() {
    let harness = builder();
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
    for name in [build::TIES, build::FIRST_AXIS, build::SECOND_AXIS, build::FEATURES, build::SELECTION] {
        assert!(harness.query_by_role_and_label(Role::ComboBox, name).is_some(), "{name}");
    }
    for name in [build::DIMENSIONS, build::PERMUTATIONS, build::SEED, build::SCALE_LOW, build::SCALE_HIGH] {
        assert!(harness.query_by_role_and_label(Role::SpinButton, name).is_some(), "{name}");
    }
    let harness = built();
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
}
