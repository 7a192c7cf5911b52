//! Left column: the authored textures, and the texture library with search and filter.

use egui::containers::menu::MenuButton;
use egui::{Button, Key, Label, RichText, Role, ScrollArea, TextEdit, Ui, WidgetInfo, vec2};

use shagreen_formats::built_in::BuiltIn;
use shagreen_formats::project::ProjectLibrary;

use crate::author::authored_panel::authored_ui;
use crate::author::filter_menu::filter_menu;
use crate::author::library_filter::{Candidate, Filter, listed};
use crate::author::texture_row::{ROW, texture_row};
use crate::command::Command;
use crate::look::icons::close_button;
use crate::look::theme::{GAP, tokens};
use crate::panel::Panel;
use crate::state::edit::Edit;
use crate::strings::{self, textures as words};
use shagreen_studio::library_names;

/// Width of the menu of libraries, in points.
const MENU_WIDTH: f32 = 220.0;
/// Width of the filter button, in points.
const FILTER_WIDTH: f32 = 66.0;
/// Width of the button that clears the search, in points.
const CROSS_WIDTH: f32 = 20.0;
/// Distance between the parts of the column, in points; a small distance leaves more room for textures.
const TIGHT: f32 = 3.0;
/// Heights of a row of small buttons and of a line of small text, in points.
const SMALL_BUTTON: f32 = 20.0;
const SMALL_LINE: f32 = 15.0;

/// View state of the texture list.
#[derive(Default)]
pub struct LibraryState {
    pub(crate) search: String,
    pub(crate) filter: Filter,
    /// Index of a texture that was just added, to which the list scrolls.
    pub(crate) reveal: Option<usize>,
}

/// Maximum number of textures for which all rows are drawn, so that keyboard and screen reader reach every row.
const MOST_ROWS: usize = 200;

impl LibraryState {
    /// Clears search and filter.
    pub(crate) fn show_all(&mut self) {
        self.search.clear();
        self.filter = Filter::default();
    }
}

/// Draws the column; returns the requested commands. Scrolls once to the texture to reveal.
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
        // Only rows in view: every row costs time even if it is not visible.
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

/// Draws the buttons for libraries, import and saving.
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

/// Draws the search field and the filter menu.
fn search_ui(ui: &mut Ui, panel: &Panel<'_>, state: &mut LibraryState) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = TIGHT;
        ui.spacing_mut().button_padding.x = 4.0;
        let has_text = !state.search.is_empty();
        let cross = if has_text { CROSS_WIDTH + TIGHT } else { 0.0 };
        let size = vec2(ui.available_width() - FILTER_WIDTH - TIGHT - cross, ui.spacing().interact_size.y);
        let field = TextEdit::singleline(&mut state.search).hint_text(strings::SEARCH_HINT);
        let field = ui.add_sized(size, field);
        field.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, strings::SEARCH));
        let mut is_cleared = field.lost_focus() && ui.input(|i| i.key_pressed(Key::Escape));
        if has_text {
            let button = close_button(ui.ctx());
            let button = ui.add_sized(vec2(CROSS_WIDTH, size.y), button).accessible_name(words::CLEAR_SEARCH);
            is_cleared |= button.on_hover_text(words::CLEAR_SEARCH).clicked();
        }
        if is_cleared {
            state.search.clear();
        }
        filter_menu(ui, panel, &mut state.filter, FILTER_WIDTH);
    });
}

/// Indices of the listed textures in the library.
fn found(panel: &Panel<'_>, state: &LibraryState) -> Vec<usize> {
    let textures = panel.session.textures();
    let candidates = textures.iter().enumerate().map(|(index, entry)| Candidate {
        name: &entry.name,
        tags: &entry.tags,
        at: panel.session.position(index),
        is_starred: panel.is_starred(index),
        is_joined: panel.joined_index(index).is_some(),
    });
    let candidates: Vec<Candidate<'_>> = candidates.collect();
    let point = panel.session.fitted(panel.project.texture().at);
    listed(&candidates, &state.search, &state.filter, point)
}

/// Draws the number of listed textures and the source of their positions.
fn count_ui(ui: &mut Ui, panel: &Panel<'_>, n_listed: usize) {
    let t = tokens(ui.ctx());
    let height = std::mem::replace(&mut ui.spacing_mut().interact_size.y, SMALL_LINE);
    ui.horizontal_wrapped(|ui| {
        let small =
            |text: String, color| Label::new(RichText::new(text).small().color(color)).selectable(false);
        ui.add(small(words::count(n_listed, panel.session.textures().len()), t.text_weak));
        // The canvas states the source too; that of simulated raters is worth saying twice.
        if panel.session.is_simulated() {
            let source = small(strings::places_from(panel.session.label_source()), t.warning);
            ui.add(source).on_hover_text(strings::SOURCE_HELP);
        } else {
            ui.add(small(panel.session.library().name.clone(), t.text_weak));
        }
    });
    ui.spacing_mut().interact_size.y = height;
}

/// Draws why no texture is listed, and a button that shows all.
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

/// Menu of libraries: the built-in ones, the open one, and others opened before.
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
            let entry = ui.selectable_label(library == *session.base(), library_names::name(&library));
            if entry.on_hover_text(library_names::help(&library)).clicked() {
                asked = Some(library);
            }
        }
    });
    response.on_hover_text(strings::LIBRARIES_HELP);
    asked.map(|library| Command::Edit(Edit::OpenLibrary(library)))
}
