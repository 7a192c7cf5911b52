//! Tables of judgments: what they become, who judged, and what is refused.

use std::path::Path;

use egui::accesskit::Role;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use shagreen_app::strings::{self, build, import};
use shagreen_app::workspace::Workspace;
use shagreen_core::people::panel::{PanelConfig, simulated_ratings, simulated_sorts};
use shagreen_core::space::LabelSource;
use shagreen_core::space::space_build::FeatureKind;
use shagreen_formats::questionnaire::{is_blank_ratings, questionnaires};
use shagreen_formats::ratings_csv::ratings_csv;
use shagreen_formats::sorting_csv::sorting_csv;
use shagreen_formats::starter::starter_library;
use shagreen_studio::questionnaire::ExperimentFile;

use super::{builder, set_number, show_figure, use_space};
use crate::support::{
    Author, author, choose, click, drop_files, enter_path, says, shown, wait, window, write_into,
};

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
