//! The column at the left: what is authored, and the textures of the library to look at, find and go to.

use egui::containers::menu::MenuButton;
use egui::{Button, Label, RichText, Role, ScrollArea, TextEdit, Ui, WidgetInfo, vec2};

use shagreen_core::space::{LabelSource, SpacePoint};
use shagreen_formats::built_in::BuiltIn;
use shagreen_formats::project::ProjectLibrary;

use crate::authored_panel::authored_ui;
use crate::command::Command;
use crate::edit::Edit;
use crate::filter_menu::filter_menu;
use crate::libraries;
use crate::library_filter::{Candidate, Filter, listed};
use crate::panel::Panel;
use crate::strings::{self, textures as words};
use crate::texture_row::{ROW, texture_row};
use crate::theme::{GAP, tokens};

/// Width of the menu of libraries, in points.
const MENU_WIDTH: f32 = 220.0;
/// Width of the button of the filters, in points.
const FILTER_WIDTH: f32 = 66.0;
/// Distance between the parts of the column, in points: what they leave is room for textures.
const TIGHT: f32 = 3.0;
/// Height of a row of small buttons, and of a line of small text, in points.
const SMALL_BUTTON: f32 = 20.0;
const SMALL_LINE: f32 = 15.0;

/// What the list remembers by itself.
#[derive(Default)]
pub struct LibraryState {
    /// What is searched for.
    pub(crate) search: String,
    /// What is shown.
    pub(crate) filter: Filter,
    /// A texture that has just joined, to be scrolled to.
    pub(crate) reveal: Option<usize>,
}

/// Textures up to which all rows are there, for the keyboard and a screen reader to go through.
const MOST_ROWS: usize = 200;

impl LibraryState {
    /// Clears search and filter.
    pub(crate) fn show_all(&mut self) {
        self.search.clear();
        self.filter = Filter::default();
    }
}

/// Draws the column and returns what the user asked of it; the texture to reveal is scrolled to, once.
pub fn library_ui(ui: &mut Ui, panel: &Panel<'_>, state: &mut LibraryState) -> Vec<Command> {
    let mut commands = Vec::new();
    ui.spacing_mut().item_spacing.y = TIGHT;
    ui.add_space(GAP);
    commands.extend(authored_ui(ui, panel));
    ui.separator();
    commands.extend(files_ui(ui, panel));
    search_ui(ui, panel, state);
    let found = found(panel, state);
    count_ui(ui, panel, found.len());
    ui.spacing_mut().item_spacing.y = 0.0;
    let mut area = ScrollArea::vertical().auto_shrink(false);
    if found.is_empty() {
        area.show(ui, |ui| nothing_ui(ui, panel, state));
    } else if found.len() <= MOST_ROWS {
        area.show(ui, |ui| {
            for texture in &found {
                let is_new = state.reveal.take_if(|wanted| *wanted == *texture).is_some();
                commands.extend(texture_row(ui, panel, *texture, is_new));
            }
        });
    } else {
        // Only those in view: a row costs something even where nobody sees it.
        let new = state.reveal.take().and_then(|wanted| found.iter().position(|texture| *texture == wanted));
        if let Some(row) = new {
            area = area.vertical_scroll_offset(row as f32 * ROW);
        }
        area.show_rows(ui, ROW, found.len(), |ui, rows| {
            for texture in &found[rows] {
                commands.extend(texture_row(ui, panel, *texture, false));
            }
        });
    }
    commands
}

/// Where textures come from and go to: libraries, import, saving.
fn files_ui(ui: &mut Ui, panel: &Panel<'_>) -> Vec<Command> {
    let mut commands = Vec::new();
    let height = std::mem::replace(&mut ui.spacing_mut().interact_size.y, SMALL_BUTTON);
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = TIGHT;
        ui.spacing_mut().button_padding = vec2(4.0, 2.0);
        let width = (ui.available_width() - 2.0 * TIGHT) / 3.0;
        let small = |name| Button::new(RichText::new(name).small()).min_size(vec2(width, 0.0));
        commands.extend(libraries_ui(ui, panel, small(strings::LIBRARIES)));
        for (command, name, help) in [
            (Command::OpenImport, strings::IMPORT, strings::IMPORT_HELP),
            (Command::OpenSave, strings::SAVE_LIBRARY, strings::SAVE_LIBRARY_HELP),
        ] {
            if ui.add(small(name)).on_hover_text(help).clicked() {
                commands.push(command);
            }
        }
    });
    ui.spacing_mut().interact_size.y = height;
    commands
}

/// The field to search by, and the menu of filters.
fn search_ui(ui: &mut Ui, panel: &Panel<'_>, state: &mut LibraryState) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = TIGHT;
        ui.spacing_mut().button_padding.x = 4.0;
        let size = vec2(ui.available_width() - FILTER_WIDTH - TIGHT, ui.spacing().interact_size.y);
        let field = TextEdit::singleline(&mut state.search).hint_text(strings::SEARCH_HINT);
        let field = ui.add_sized(size, field);
        field.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, strings::SEARCH));
        filter_menu(ui, panel, &mut state.filter, FILTER_WIDTH);
    });
}

/// The textures that are listed, by their places in the library.
fn found(panel: &Panel<'_>, state: &LibraryState) -> Vec<usize> {
    let textures = panel.session.textures();
    let candidates = textures.iter().enumerate().map(|(index, entry)| Candidate {
        name: &entry.name,
        tags: &entry.tags,
        at: panel.session.space().position(index),
        is_starred: panel.is_starred(index),
        is_joined: panel.joined_index(index).is_some(),
    });
    let candidates: Vec<Candidate<'_>> = candidates.collect();
    listed(&candidates, &state.search, &state.filter, panel.project.texture().at)
}

/// How many textures are listed, and whom their places come from.
fn count_ui(ui: &mut Ui, panel: &Panel<'_>, n_listed: usize) {
    let t = tokens(ui.ctx());
    let height = std::mem::replace(&mut ui.spacing_mut().interact_size.y, SMALL_LINE);
    ui.horizontal_wrapped(|ui| {
        let small =
            |text: String, color| Label::new(RichText::new(text).small().color(color)).selectable(false);
        ui.add(small(words::count(n_listed, panel.session.textures().len()), t.text_weak));
        let color = if panel.session.is_simulated() { t.warning } else { t.text_weak };
        let source = small(strings::places_from(panel.session.label_source()), color);
        let about = format!("{}\n{}", panel.session.library().name, strings::SOURCE_HELP);
        ui.add(source).on_hover_text(about);
    });
    ui.spacing_mut().interact_size.y = height;
}

/// Why nothing is listed, and the way back.
fn nothing_ui(ui: &mut Ui, panel: &Panel<'_>, state: &mut LibraryState) {
    let is_searched = !state.search.trim().is_empty();
    let reason = match (state.filter.n_on() > 0, is_searched) {
        _ if panel.session.textures().is_empty() => strings::NO_TEXTURES,
        (true, true) => words::NONE_FOUND,
        (true, false) => words::NONE_PASSES,
        (false, _) => strings::NO_MATCH,
    };
    ui.add_space(GAP);
    ui.label(RichText::new(reason).color(tokens(ui.ctx()).text_weak));
    if !panel.session.textures().is_empty() {
        ui.add_space(GAP);
        if ui.button(words::SHOW_ALL).clicked() {
            state.show_all();
        }
    }
}

/// The menu of the libraries that can be open: those of the program, the one that is open, and others that were.
fn libraries_ui(ui: &mut Ui, panel: &Panel<'_>, button: Button<'_>) -> Option<Command> {
    let session = panel.session;
    let mut asked = None;
    let (response, _) = MenuButton::from_button(button).ui(ui, |ui| {
        ui.set_min_width(MENU_WIDTH);
        let of_program = BuiltIn::ALL.into_iter().map(ProjectLibrary::BuiltIn);
        let mut offered: Vec<ProjectLibrary> =
            of_program.chain(session.other_libraries().iter().cloned()).collect();
        if !offered.contains(session.base()) {
            offered.push(session.base().clone());
        }
        for library in offered {
            let entry = ui.selectable_label(library == *session.base(), libraries::name(&library));
            if entry.on_hover_text(libraries::help(&library)).clicked() {
                asked = Some(library);
            }
        }
    });
    response.on_hover_text(strings::LIBRARIES_HELP);
    asked.map(|library| Command::Edit(Edit::OpenLibrary(library)))
}

/// Where a texture lies, in numbers, and whom that comes from.
pub(crate) fn place_in_words(panel: &Panel<'_>, index: usize, at: SpacePoint) -> String {
    let source = panel.session.place_source(index).map_or(strings::NO_SOURCE, LabelSource::label);
    strings::lies_at(at, source)
}

/// A texture's picture in `area`, or a plain square while there is none.
pub fn picture_ui(ui: &Ui, panel: &Panel<'_>, index: usize, area: egui::Rect) {
    let radius = f32::from(crate::theme::RADIUS) - 1.0;
    match panel.pictures.thumbnail(index) {
        Some(picture) => {
            let uv = egui::Rect::from_min_max(egui::pos2(0.2, 0.2), egui::pos2(0.8, 0.8));
            let shape = egui::epaint::RectShape::filled(area, radius, egui::Color32::WHITE);
            ui.painter().add(shape.with_texture(picture.id(), uv));
        }
        None => {
            ui.painter().rect_filled(area, radius, tokens(ui.ctx()).control);
        }
    }
}
