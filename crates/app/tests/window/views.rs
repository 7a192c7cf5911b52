//! Every workspace, menu and sheet of the window in turn, for tests that apply to all of them.
//!
//! Not included: results of prompts and photos, which need a network; they have tests of their own.

use std::path::Path;
use std::time::{Duration, Instant};

use egui::Key;
use egui::accesskit::Role;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use shagreen_app::Begin;
use shagreen_app::choices::signals::{FromA, Slot, View};
use shagreen_app::choices::tour::Step;
use shagreen_app::command::axes::AxesCommand;
use shagreen_app::command::relief::ReliefCommand;
use shagreen_app::command::signals::SignalsCommand;
use shagreen_app::command::stroke::StrokeCommand;
use shagreen_app::command::{Command, FileCommand};
use shagreen_app::state::compare::{CompareCommand, Side};
use shagreen_app::state::edit::Edit;
use shagreen_app::state::files::StoragePaths;
use shagreen_app::strings::{
    self, build, conflict, document, help, import, map, shape, signals, studies as words,
};
use shagreen_app::workspace::Workspace;
use shagreen_core::space::heat_map::Quantity;
use shagreen_core::space::space_build::FeatureKind;
use shagreen_core::texture::blend::Mode;
use shagreen_core::texture::shape::ShapeControl;
use shagreen_core::units::Hertz;
use shagreen_formats::project::write_project;
use shagreen_studio::export::WAV;
use shagreen_studio::project::new_project;

use crate::import::recording;
use crate::studies;
use crate::studies::plans::{RATING, RELEVANCE, RUN, SIMILARITY, SORTING, plan_text};
use crate::support::{Author, begin, choose, click, drop_files, says, wait, wait_for_field, window};

/// Supported sizes of the window in pixels, each with pixels per point of usual screens. Smaller windows than 960 by 600 points
/// are not supported. Equal scales follow each other, because another one needs other images of all letters.
pub(crate) const SIZES: [([f32; 2], f32); 7] = [
    ([960.0, 600.0], 1.0),
    ([1280.0, 720.0], 1.0),
    ([1920.0, 1080.0], 1.0),
    ([2560.0, 1440.0], 1.0),
    ([1920.0, 1080.0], 1.5),
    ([2560.0, 1440.0], 1.5),
    ([2560.0, 1440.0], 2.0),
];

/// Size in points of a window with this number of pixels at a scale.
pub(crate) fn points(pixels: [f32; 2], scale: f32) -> [f32; 2] {
    pixels.map(|length| (length / scale).floor())
}

/// Kind of a view.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// A workspace in some state.
    Workspace,
    /// A menu or the tour, over a workspace that stays usable.
    Menu,
    /// A sheet, over a workspace that is not usable.
    Sheet,
}

/// Test of a view with this name and kind.
type Look<'a> = dyn FnMut(&mut Author, &str, Kind) + 'a;

/// Calls `look` for every view of a window on a new project. Files are written into `folder`.
pub(crate) fn each_view(harness: &mut Author, folder: &Path, look: &mut Look<'_>) {
    wait_for_field(harness);
    author_views(harness, look);
    menus(harness, look);
    build_views(harness, look);
    signals_views(harness, look);
    studies_views(harness, folder, look);
    carry_out(harness, Command::Show(Workspace::Author));
    show(harness, look, "Author, several textures", Kind::Workspace);
    sheets(harness, look);
    import_views(harness, look);
    questions(harness, folder, look);
}

/// Initial content of a window that offers a project which a crashed program left in `folder`.
pub(crate) fn with_leftover(folder: &Path) -> Begin {
    let recovery = folder.join("recovery");
    std::fs::create_dir_all(&recovery).unwrap();
    let bytes = write_project(&new_project(), Path::new(""), "test");
    std::fs::write(recovery.join("1-1.shagreen"), bytes).unwrap();
    std::fs::write(recovery.join("1-1.origin"), "/somewhere/Woods.shagreen").unwrap();
    std::fs::write(recovery.join("1-1.lock"), "").unwrap();
    let keeping = StoragePaths { recovery: Some(recovery), ..StoragePaths::default() };
    Begin { keeping, ..begin(new_project()) }
}

/// Executes a command as if the user had asked for it.
pub(crate) fn carry_out(harness: &mut Author, command: Command) {
    let ctx = harness.ctx.clone();
    harness.state_mut().as_mut().expect("a window after the first frame").carry_out(command, &ctx);
    harness.run_steps(4);
}

/// Looks at the present view, with the pointer outside the window and all animations ended.
fn show(harness: &mut Author, look: &mut Look<'_>, name: &str, kind: Kind) {
    harness.remove_cursor();
    harness.run_steps(4);
    look(harness, name, kind);
}

fn author_views(harness: &mut Author, look: &mut Look<'_>) {
    show(harness, look, "Author", Kind::Workspace);
    let first = window(harness).session().textures()[0].id.clone();
    carry_out(harness, Command::Edit(Edit::Solo(Some(first))));
    show(harness, look, "Author, texture selected", Kind::Workspace);
    carry_out(harness, Command::Edit(Edit::Solo(None)));
    click(harness, shape::HEADING);
    for control in ShapeControl::ALL {
        carry_out(harness, Command::Edit(Edit::SetShape(control, *control.limits().start())));
    }
    show(harness, look, "Author, shape", Kind::Workspace);
    carry_out(harness, Command::Edit(Edit::ResetShape));
    click(harness, shape::HEADING);
    carry_out(harness, Command::TogglePathTool);
    show(harness, look, "Author, path tool", Kind::Workspace);
    for name in ["Brick", "Cotton weave"] {
        click(harness, &strings::play_texture(name));
    }
    assert!(window(harness).project().texture().path.is_some());
    show(harness, look, "Author, path", Kind::Workspace);
    carry_out(harness, Command::TogglePathTool);
    carry_out(harness, Command::Edit(Edit::SetMode(Mode::Shared)));
    carry_out(harness, Command::ShowMap(Some(Quantity::Centroid)));
    wait(harness, "the map is there", |h| says(h, ", from ") && !says(h, map::WAITING));
    show(harness, look, "Author, heat map", Kind::Workspace);
    carry_out(harness, Command::ShowMap(None));
    let axes = ["rough-smooth", "hard-soft", "centroid", "speed exponent", "force exponent"];
    let axes = axes.map(str::to_owned).to_vec();
    carry_out(harness, Command::Axes(AxesCommand::Use(axes)));
    wait_for_field(harness);
    show(harness, look, "Author, five axes", Kind::Workspace);
    carry_out(harness, Command::Undo);
    wait_for_field(harness);
    carry_out(harness, Command::DuplicateTexture);
    carry_out(harness, Command::Compare(CompareCommand::Hear(Side::A)));
    show(harness, look, "Author, comparison", Kind::Workspace);
    carry_out(harness, Command::Compare(CompareCommand::SetBlind(true)));
    carry_out(harness, Command::Compare(CompareCommand::Hear(Side::X)));
    show(harness, look, "Author, blind comparison", Kind::Workspace);
    carry_out(harness, Command::Compare(CompareCommand::SetBlind(false)));
    // An edit ends the comparison.
    carry_out(harness, Command::DuplicateTexture);
}

fn menus(harness: &mut Author, look: &mut Look<'_>) {
    for menu in [document::FILE, help::HELP] {
        click(harness, menu);
        show(harness, look, &format!("menu {menu}"), Kind::Menu);
        harness.key_press(Key::Escape);
        harness.run_steps(4);
    }
    carry_out(harness, Command::BeginTour);
    for i in 1..=Step::ALL.len() {
        show(harness, look, &format!("tour, card {i}"), Kind::Menu);
        click(harness, if i == Step::ALL.len() { help::DONE } else { help::NEXT });
    }
}

fn build_views(harness: &mut Author, look: &mut Look<'_>) {
    carry_out(harness, Command::Show(Workspace::Build));
    show(harness, look, "Build", Kind::Workspace);
    harness.get_by_label(build::SIMULATE).click_accesskit();
    harness.run_steps(2);
    wait(harness, "the panel has judged", |h| !window(h).build().judgments().is_reading());
    harness.run_steps(2);
    show(harness, look, "Build, judgments read", Kind::Workspace);
    harness.get_by_role_and_label(Role::SpinButton, build::PERMUTATIONS).set_value_accesskit(19.0);
    harness.run_steps(2);
    harness.get_by_role_and_label(Role::ComboBox, build::FEATURES).scroll_to_me();
    harness.run_steps(4);
    choose(harness, build::FEATURES, build::features(FeatureKind::Physical));
    harness.get_by_label(build::BUILD_SPACE).click_accesskit();
    harness.run_steps(2);
    wait(harness, "the space is built", |h| !window(h).build().is_building());
    show(harness, look, "Build, space built", Kind::Workspace);
}

fn signals_views(harness: &mut Author, look: &mut Look<'_>) {
    carry_out(harness, Command::Show(Workspace::Signals));
    show(harness, look, "Signals", Kind::Workspace);
    let of_signals = [SignalsCommand::TakeHeard(Slot::A), SignalsCommand::MakeB(FromA::Copy)];
    for (command, slot) in of_signals.into_iter().zip(Slot::ALL) {
        carry_out(harness, Command::Signals(command));
        wait(harness, "a signal is there", |h| window(h).signals().signal(slot).is_some());
        harness.run_steps(2);
    }
    for view in [View::Times, View::Places, View::Differences] {
        click(harness, signals::view(view));
        if view == View::Differences {
            wait(harness, "both are compared", |h| {
                let page = window(h).signals();
                page.compared().is_some() && Slot::ALL.iter().all(|slot| page.by_rate(*slot).is_some())
            });
        } else {
            // Spectrograms are computed in the background; their labels do not wait for them.
            let start = Instant::now();
            wait(harness, "some time", |_| start.elapsed() > Duration::from_secs(1));
        }
        show(harness, look, &format!("Signals, {}", signals::view(view)), Kind::Workspace);
    }
}

/// The Studies workspace, and what a participant sees.
fn studies_views(harness: &mut Author, folder: &Path, look: &mut Look<'_>) {
    carry_out(harness, Command::Show(Workspace::Studies));
    show(harness, look, "Studies", Kind::Workspace);
    let problem = folder.join("problem.toml");
    std::fs::write(&problem, plan_text("")).unwrap();
    studies::open(harness, &problem);
    show(harness, look, "Studies, problems", Kind::Workspace);
    let plan = studies::plan_file(folder, &[SORTING, RATING, SIMILARITY, RELEVANCE].concat());
    studies::open(harness, &plan);
    show(harness, look, "Studies, plan", Kind::Workspace);
    harness.get_by_label(words::CALIBRATE).click_accesskit();
    harness.run_steps(2);
    show(harness, look, "Studies, screen scale", Kind::Workspace);
    click(harness, words::CANCEL);
    // A session of each design, left at its first trial.
    studies::start(harness, words::START);
    show(harness, look, "study, consent", Kind::Workspace);
    click(harness, words::AGREE);
    show(harness, look, "study, instructions", Kind::Workspace);
    assert!(studies::go_to_trial(harness));
    show(harness, look, "study, sort", Kind::Workspace);
    click(harness, words::LEAVE);
    show(harness, look, "study, question", Kind::Workspace);
    click(harness, words::LEAVE_NOW);
    wait(harness, "the sessions are listed", |h| !window(h).studies().is_busy());
    studies::start(harness, words::START);
    click(harness, words::DISAGREE);
    show(harness, look, "study, refused", Kind::Workspace);
    click(harness, words::CLOSE);
    wait(harness, "the sessions are listed", |h| !window(h).studies().is_busy());
    show(harness, look, "Studies, sessions", Kind::Workspace);
    click(harness, &words::template(&words::template_title("abx")));
    wait(harness, "the plan is read", |h| !window(h).studies().is_busy());
    harness.get_by_label(words::START).click_accesskit();
    harness.run_steps(2);
    show(harness, look, "Studies, placeholder of a consent text", Kind::Workspace);
    harness.get_by_label(words::CANCEL).click_accesskit();
    harness.run_steps(2);
    for (name, parts) in RUN {
        let folder = folder.join(name);
        std::fs::create_dir_all(&folder).unwrap();
        let plan = studies::plan_file(&folder, parts);
        studies::open(harness, &plan);
        studies::start(harness, words::START);
        assert!(studies::go_to_trial(harness));
        show(harness, look, &format!("study, {name}"), Kind::Workspace);
        studies::leave(harness);
    }
}

fn sheets(harness: &mut Author, look: &mut Look<'_>) {
    let first = window(harness).session().textures()[0].id.clone();
    for (name, command) in [
        ("import, empty", Command::OpenImport),
        ("save library", Command::OpenSave),
        ("save project", Command::File(FileCommand::SaveAs)),
        ("export signal", Command::File(FileCommand::Export(WAV.id))),
        ("export texture", Command::File(FileCommand::Export("hatt"))),
        ("axes", Command::Axes(AxesCommand::Open)),
        ("devices", Command::OpenDevices),
        ("open", Command::File(FileCommand::AskWhatToOpen)),
        ("open stroke", Command::Stroke(StrokeCommand::AskWhatToOpen)),
        ("open signal", Command::Signals(SignalsCommand::AskWhatToOpen(Slot::A))),
        ("gallery", Command::File(FileCommand::OpenGallery)),
        ("shortcuts", Command::OpenShortcuts),
        ("palette", Command::OpenPalette),
        ("guide", Command::OpenGuide),
        ("papers", Command::OpenPapers),
        ("about", Command::OpenAbout),
        ("texture", Command::OpenTexture(first)),
        ("relief", Command::Relief(ReliefCommand::Begin(None, None))),
        ("use of a picture", Command::File(FileCommand::Open("leather.png".into()))),
    ] {
        carry_out(harness, command);
        // Lists of outputs, pens and folders come from the background.
        harness.run_steps(4);
        wait(harness, "the axes are read", |h| !says(h, strings::axes::LOADING));
        harness.run_steps(4);
        show(harness, look, &format!("sheet {name}"), Kind::Sheet);
        carry_out(harness, Command::CloseSheet);
    }
}

fn import_views(harness: &mut Author, look: &mut Look<'_>) {
    let text = recording("cork", 6.0, Hertz(1000.0));
    drop_files(harness, &[("cork_floor.csv", text.as_bytes())]);
    let unit = import::answer_of("acceleration_unit");
    wait(harness, "the unit is asked for", |h| h.query_by_role_and_label(Role::ComboBox, &unit).is_some());
    show(harness, look, "sheet import, with a question", Kind::Sheet);
    choose(harness, &unit, "m/s²");
    wait(harness, "the texture is fitted", |h| {
        h.query_by_label(&import::add(1)).is_some_and(|n| !n.accesskit_node().is_disabled())
    });
    show(harness, look, "sheet import, fitted", Kind::Sheet);
    carry_out(harness, Command::CloseSheet);
}

/// Sheets that ask about unsaved changes and about a project file that has changed.
fn questions(harness: &mut Author, folder: &Path, look: &mut Look<'_>) {
    carry_out(harness, Command::File(FileCommand::New));
    assert!(says(harness, document::LEAVE_TITLE));
    show(harness, look, "sheet unsaved changes", Kind::Sheet);
    carry_out(harness, Command::CloseSheet);
    let path = folder.join("Woods.shagreen");
    carry_out(harness, Command::File(FileCommand::SaveTo(path.clone())));
    wait(harness, "it is saved", |h| !window(h).document().is_changed());
    std::fs::write(&path, write_project(&new_project(), Path::new(""), "test")).unwrap();
    carry_out(harness, Command::DuplicateTexture);
    show(harness, look, "Author, project with a file", Kind::Workspace);
    carry_out(harness, Command::File(FileCommand::Save));
    wait(harness, "the conflict is shown", |h| says(h, conflict::TITLE));
    show(harness, look, "sheet conflict", Kind::Sheet);
    carry_out(harness, Command::CloseSheet);
}
