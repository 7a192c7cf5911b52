//! Left column: the choice of the plan, its problems, and where it is saved.

use std::path::PathBuf;

use egui::{Button, Label, RichText, TextEdit, Ui, vec2};
use shagreen_formats::study_plan::{StudyTemplate, study_templates};
use shagreen_studio::open::PLAN_ENDING;

use super::{Shown, StudiesPage};
use crate::browse::{Asked, BROWSE_WIDTH};
use crate::look::motion::busy_ui;
use crate::look::theme::{GAP, GROUP_GAP, tokens};
use crate::panel::Panel;
use crate::state::source::Source;
use crate::strings::studies as strings;
use crate::studies::open_study::Origin;

/// Built-in plan in which the authored textures of a project are rated.
const OF_PROJECT: &str = "bipolar-rating";

/// Draws the column.
pub(super) fn plan_ui(ui: &mut Ui, page: &mut StudiesPage, panel: &Panel<'_>) {
    let heading = |ui: &mut Ui, text: &str| {
        ui.add(Label::new(RichText::new(text).strong()).selectable(false));
    };
    let mut origin = None;
    heading(ui, strings::PLAN);
    origin = path_ui(ui, page).or(origin);
    if page.reading.is_some() {
        ui.horizontal(|ui| {
            busy_ui(ui);
            ui.label(strings::READING);
        });
    }
    open_ui(ui, page, &mut origin);
    problems_ui(ui, page);
    ui.add_space(GROUP_GAP);
    let wide = vec2(ui.available_width(), 30.0);
    let rate = ui.add_sized(wide, Button::new(strings::RATE_PROJECT));
    if rate.on_hover_text(strings::RATE_PROJECT_HELP).clicked() {
        origin = Some(Origin::OfProject(OF_PROJECT));
    }
    ui.add_space(GROUP_GAP);
    heading(ui, strings::TEMPLATES);
    origin = templates_ui(ui).or(origin);
    if let Some(origin) = origin {
        page.begin_reading(origin, panel.project, ui.ctx());
    }
}

/// Draws the field for the path of a plan; returns the plan to open.
fn path_ui(ui: &mut Ui, page: &mut StudiesPage) -> Option<Origin> {
    let mut wanted: Option<PathBuf> = None;
    ui.horizontal(|ui| {
        let field = TextEdit::singleline(&mut page.typed).hint_text(strings::PLAN_HINT);
        let field = field.desired_width(ui.available_width() - BROWSE_WIDTH);
        let field = ui.add(field).accessible_name(strings::PLAN_PATH);
        let is_typed = !page.typed.trim().is_empty();
        let is_entered = field.lost_focus() && ui.input(|i| i.key_pressed(egui::Key::Enter));
        if is_typed {
            let button = ui.button(strings::OPEN).accessible_name(strings::OPEN_PLAN);
            if button.clicked() || is_entered {
                wanted = Some(PathBuf::from(page.typed.trim()));
            }
        } else {
            let asked = Asked {
                title: strings::OPEN_PLAN,
                kind: strings::PLANS,
                endings: &[PLAN_ENDING],
                folder: Some(page.folder.as_path()),
                ..Asked::default()
            };
            wanted = page.browse.show(ui, strings::OPEN_PLAN, &asked).into_iter().next();
        }
    });
    page.browse.missing_ui(ui);
    wanted.map(|path| Origin::File(Source::Path(path)))
}

/// Draws the open plan: its name, and its file or the path at which it will be saved.
fn open_ui(ui: &mut Ui, page: &mut StudiesPage, origin: &mut Option<Origin>) {
    let t = tokens(ui.ctx());
    if let Some(open) = &page.open {
        ui.add_space(GAP);
        ui.add(Label::new(RichText::new(&open.study.plan.name).heading()).wrap().selectable(false));
        if let Some(path) = &open.path {
            let text = RichText::new(path.display().to_string()).small().color(t.text_weak);
            ui.add(Label::new(text).truncate()).on_hover_text(path.display().to_string());
        } else {
            let field = TextEdit::singleline(&mut page.save_to).desired_width(f32::INFINITY);
            let field = ui.add(field).accessible_name(strings::SAVED_TO);
            field.on_hover_text(strings::SAVED_TO_HELP);
            ui.add(Label::new(RichText::new(strings::SAVED_TO).small().color(t.text_weak)).wrap());
        }
        if page.shown != Shown::Preview && ui.button(strings::PREVIEW).clicked() {
            page.shown = Shown::Preview;
        }
    }
    if let Some(file) = &page.file {
        let again = ui.button(strings::READ_AGAIN).on_hover_text(strings::READ_AGAIN_HELP);
        if again.clicked() {
            *origin = Some(Origin::File(file.clone()));
        }
    }
}

/// Draws what is wrong with the plan.
fn problems_ui(ui: &mut Ui, page: &StudiesPage) {
    let t = tokens(ui.ctx());
    if page.problems.is_empty() {
        return;
    }
    ui.add_space(GAP);
    let heading = RichText::new(strings::problems(page.problems.len())).strong().color(t.error);
    ui.add(Label::new(heading).wrap());
    for problem in &page.problems {
        ui.add(Label::new(RichText::new(problem).color(t.error)).wrap());
    }
    ui.add(Label::new(RichText::new(strings::CORRECT).color(t.text_weak)).wrap());
}

/// Draws the built-in plans; returns the one to open.
fn templates_ui(ui: &mut Ui) -> Option<Origin> {
    let mut wanted = None;
    for StudyTemplate { id, .. } in study_templates() {
        let name = strings::template_title(id);
        let button = Button::new(&name).min_size(vec2(ui.available_width(), 0.0));
        let button = ui.add(button).accessible_name(strings::template(&name));
        if button.on_hover_text(strings::TEMPLATES_HELP).clicked() {
            wanted = Some(Origin::Template(id));
        }
    }
    wanted
}
