//! Input data of a space: the tables that were read, and fields to read others.

use std::collections::BTreeSet;

use egui::{Align, Button, DragValue, Key, Label, Layout, RichText, TextEdit, TextStyle, Ui};
use shagreen_formats::questionnaire::questionnaires;

use crate::browse::{Asked as Dialog, Browse};
use crate::build::judgments::{Judgments, Slot};
use crate::command::Command;
use crate::look::icons::{ICON_ASSIGNMENT, close_button};
use crate::look::theme::{GAP, GROUP_GAP, tokens};
use crate::session::Session;
use crate::state::blank_file::BlankFile;
use crate::state::source::paths_in;
use crate::strings::build as strings;
use shagreen_studio::judgments::JudgmentKind;
use shagreen_studio::questionnaire::ExperimentFile;

/// Height of the window from which rows are kept for what is not read yet, in points.
const ROOMY_HEIGHT: f32 = 720.0;

/// Size of an icon beside a button, in points: not higher than the text of the button.
const ICON_SIZE: f32 = 14.0;

/// One field for the path of a table.
#[derive(Default)]
struct PathField {
    text: String,
    browse: Browse,
}

/// Fields for the paths of the tables.
#[derive(Default)]
pub(super) struct Paths {
    sorting: PathField,
    ratings: PathField,
    votes: PathField,
}

/// Status of one table.
struct Said {
    /// Counts of what was read, as text.
    read: Option<String>,
    name: String,
    warnings: Vec<String>,
    failure: Option<String>,
    unknown: Option<String>,
}

/// Requested actions on the inputs.
#[derive(Default)]
pub(super) struct InputsAsked {
    /// A simulated panel is to sort and rate.
    pub(super) simulate: bool,
    pub(super) command: Option<Command>,
}

/// Requested actions on one table.
#[derive(Default)]
struct Asked {
    read: bool,
    clear: bool,
}

/// Draws the tables and the `scale` of the ratings, its low end first; returns the requested actions.
pub(super) fn inputs_ui(
    ui: &mut Ui,
    judgments: &mut Judgments,
    paths: &mut Paths,
    scale: &mut [f64; 2],
    session: &Session,
) -> InputsAsked {
    let t = tokens(ui.ctx());
    ui.horizontal(|ui| {
        ui.heading(strings::MADE_OF);
        let n_textures = strings::of_the_library(session.textures().len());
        let text = RichText::new(n_textures).color(t.text_weak);
        ui.add(Label::new(text).truncate().selectable(false));
    });
    for kind in [JudgmentKind::Sorting, JudgmentKind::Ratings, JudgmentKind::Votes] {
        ui.add_space(GAP);
        let said = said(judgments, kind, session);
        let path = match kind {
            JudgmentKind::Sorting => &mut paths.sorting,
            JudgmentKind::Ratings => &mut paths.ratings,
            JudgmentKind::Votes => &mut paths.votes,
        };
        let scale = (kind == JudgmentKind::Ratings).then_some(&mut *scale);
        let asked = table_ui(ui, kind, path, &said, scale);
        if asked.read {
            judgments.read(paths_in(&path.text), Some(kind), ui.ctx());
        }
        if asked.clear {
            judgments.clear(kind);
            path.text.clear();
        }
    }
    for alike in judgments.alike() {
        ui.add(Label::new(RichText::new(alike).small().color(t.warning)).wrap());
    }
    if judgments.are_people() {
        let text = RichText::new(strings::ASSUMED_PEOPLE).small().color(t.text_weak);
        ui.add(Label::new(text).wrap());
    }
    if judgments.is_reading() {
        ui.add(Label::new(RichText::new(strings::READING).small().color(t.text_weak)).selectable(false));
    }
    ui.add_space(GROUP_GAP);
    let mut asked = InputsAsked::default();
    ui.horizontal(|ui| {
        asked.command = questionnaires_ui(ui, session);
        let size = egui::vec2(ui.available_width(), ui.spacing().interact_size.y);
        let simulate = ui.add_sized(size, Button::new(strings::SIMULATE));
        asked.simulate = simulate.on_hover_text(strings::SIMULATE_HELP).clicked();
    });
    asked
}

/// Draws the menu of questionnaires, which saves blank tables and instructions; returns the requested command.
fn questionnaires_ui(ui: &mut Ui, session: &Session) -> Option<Command> {
    let mut asked = None;
    let menu = ui.menu_button(ICON_ASSIGNMENT.rich_text().size(ICON_SIZE), |ui| {
        let all = match questionnaires() {
            Ok(all) => all,
            Err(error) => {
                ui.label(error.to_string());
                return;
            }
        };
        for questionnaire in all {
            let name = Label::new(RichText::new(&questionnaire.name).strong()).selectable(false);
            ui.add(name).on_hover_text(format!("{}. {}", questionnaire.source, questionnaire.note));
            for file in ExperimentFile::ALL {
                let entry = ui.button(strings::blank_file(file));
                let entry = entry.accessible_name(strings::blank_file_of(file, &questionnaire.name));
                if entry.clicked() {
                    asked = Some(Command::SaveBlank(BlankFile::new(file, questionnaire, session.textures())));
                    ui.close();
                }
            }
        }
    });
    let help = strings::questionnaires_help();
    menu.response.accessible_name(strings::QUESTIONNAIRES).on_hover_text(help);
    asked
}

fn table_ui(
    ui: &mut Ui,
    kind: JudgmentKind,
    path: &mut PathField,
    said: &Said,
    scale: Option<&mut [f64; 2]>,
) -> Asked {
    let t = tokens(ui.ctx());
    let mut asked = Asked::default();
    let (title, help, nothing) = match kind {
        JudgmentKind::Sorting => (strings::SORTING, strings::SORTING_HELP, strings::OPTIONAL),
        JudgmentKind::Ratings => (strings::RATINGS, strings::RATINGS_HELP, strings::NOTHING_YET),
        JudgmentKind::Votes => (strings::VOTES, strings::VOTES_HELP, strings::OPTIONAL),
    };
    ui.horizontal(|ui| {
        ui.add(Label::new(RichText::new(title).strong()).selectable(false)).on_hover_text(help);
        if let Some(scale) = scale {
            scale_ui(ui, scale);
        }
        if said.read.is_none() {
            ui.add(Label::new(RichText::new(nothing).small().color(t.text_weak)).selectable(false));
            return;
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let cross = close_button(ui.ctx());
            let name = strings::remove(title);
            asked.clear = ui.add(cross).accessible_name(&name).on_hover_text(&name).clicked();
            let name = Label::new(RichText::new(&said.name).small().color(t.text_weak)).truncate();
            ui.add(name.selectable(false)).on_hover_text(&said.name);
        });
    });
    ui.horizontal(|ui| {
        let button_width = 78.0;
        let field = TextEdit::singleline(&mut path.text)
            .hint_text(strings::PATH_HINT)
            .desired_width(ui.available_width() - button_width - GAP);
        let field = ui.add(field).accessible_name(strings::path_of(title)).on_hover_text(help);
        let is_entered = field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
        let is_typed = !path.text.trim().is_empty();
        if is_typed {
            let button = Button::new(crate::strings::import::READ).min_size(egui::vec2(button_width, 0.0));
            asked.read = ui.add(button).accessible_name(strings::read(title)).clicked() || is_entered;
        } else {
            let dialog =
                Dialog { title, kind: strings::TABLES, endings: &["csv", "tsv", "txt"], ..Dialog::default() };
            if let Some(chosen) = path.browse.show(ui, title, &dialog).into_iter().next() {
                path.text = chosen.display().to_string();
                asked.read = true;
            }
        }
    });
    path.browse.missing_ui(ui);
    let line = |ui: &mut Ui, text: &str, color| {
        ui.add(Label::new(RichText::new(text).small().color(color)).wrap());
    };
    if let Some(read) = &said.read {
        line(ui, read, t.text);
    } else if kind != JudgmentKind::Votes
        && said.failure.is_none()
        && ui.ctx().content_rect().height() >= ROOMY_HEIGHT
    {
        // The row of the counts is kept, so that the fields below do not move under the pointer when a table is read.
        // In a low window, the options below need the space.
        ui.allocate_space(egui::vec2(0.0, ui.text_style_height(&TextStyle::Small)));
    }
    for warning in &said.warnings {
        line(ui, warning, t.warning);
    }
    if let Some(unknown) = &said.unknown {
        line(ui, unknown, t.warning);
    }
    if let Some(failure) = &said.failure {
        line(ui, failure, t.error);
    }
    asked
}

/// Draws the low and the high end of a rating scale.
fn scale_ui(ui: &mut Ui, scale: &mut [f64; 2]) {
    for (end, name) in scale.iter_mut().zip([strings::SCALE_LOW, strings::SCALE_HIGH]) {
        let value = DragValue::new(end).range(0.0..=100.0).speed(0.1).max_decimals(2);
        ui.add(value).accessible_name(name).on_hover_text(strings::SCALE_HELP);
    }
}

fn said(judgments: &Judgments, kind: JudgmentKind, session: &Session) -> Said {
    let unknown = |names: BTreeSet<&str>| {
        let known = |name: &&str| session.library().index_of(name).is_some();
        let unknown: Vec<&str> = names.into_iter().filter(|name| !known(name)).collect();
        (!unknown.is_empty()).then(|| strings::not_in_library(&unknown))
    };
    match kind {
        JudgmentKind::Sorting => {
            let slot = &judgments.sorting;
            let placements = slot.values().iter().flat_map(|sort| &sort.placements);
            let unknown = unknown(placements.map(|placement| placement.texture.as_str()).collect());
            said_of(slot, strings::sorting, unknown)
        }
        JudgmentKind::Ratings => {
            let slot = &judgments.ratings;
            let unknown = unknown(slot.values().iter().map(|rating| rating.texture.as_str()).collect());
            said_of(slot, strings::ratings, unknown)
        }
        JudgmentKind::Votes => said_of(&judgments.votes, strings::votes, None),
    }
}

/// Status of a table; `in_figures` turns its values into counts.
fn said_of<T>(slot: &Slot<T>, in_figures: fn(&[T]) -> String, unknown: Option<String>) -> Said {
    Said {
        read: slot.read.as_ref().map(|(_, values)| in_figures(values)),
        name: slot.read.as_ref().map_or_else(String::new, |(name, _)| name.clone()),
        warnings: slot.warnings.clone(),
        failure: slot.failure.clone(),
        unknown,
    }
}
