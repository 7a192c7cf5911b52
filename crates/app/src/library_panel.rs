//! The column at the left: what is authored, and the textures of the library to look at, search and go to.

use egui::{Label, Response, Role, ScrollArea, Sense, TextEdit, Ui, WidgetInfo, vec2};

use shagreen_core::space::{LabelSource, SpacePoint};
use shagreen_formats::built_in::BuiltIn;
use shagreen_formats::library::Provenance;
use shagreen_formats::project::ProjectLibrary;

use crate::authored_panel::authored_ui;
use crate::command::Command;
use crate::edit::Edit;
use crate::libraries;
use crate::locks::{lock_mark, lock_menu};
use crate::panel::Panel;
use crate::strings;
use crate::theme::{GAP, tokens};

/// Side of a picture in the list, in points.
const PICTURE: f32 = 34.0;
/// Width of the menu of libraries, in points.
const MENU_WIDTH: f32 = 220.0;

/// Draws the list and returns what the user asked of it. `search` is the panel's own state; the texture to `reveal` is
/// scrolled to, once.
pub fn library_ui(
    ui: &mut Ui,
    panel: &Panel<'_>,
    search: &mut String,
    reveal: &mut Option<usize>,
) -> Vec<Command> {
    let t = tokens(ui.ctx());
    let mut commands = Vec::new();
    ui.add_space(GAP);
    commands.extend(authored_ui(ui, panel));
    ui.separator();
    ui.horizontal(|ui| {
        ui.heading(strings::LIBRARY);
        ui.label(egui::RichText::new(format!("{}", panel.session.textures().len())).color(t.text_weak));
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            commands.extend(libraries_ui(ui, panel));
        });
    });
    let source = egui::RichText::new(strings::places_from(panel.session.label_source()));
    let color = if panel.session.is_simulated() { t.warning } else { t.text_weak };
    let source = source.small().color(color);
    let about = format!("{}\n{}", panel.session.library().name, strings::SOURCE_HELP);
    ui.add(Label::new(source).wrap().selectable(false)).on_hover_text(about);
    ui.horizontal(|ui| {
        let width = 0.5 * (ui.available_width() - GAP);
        for (command, name, help) in [
            (Command::OpenImport, strings::IMPORT, strings::IMPORT_HELP),
            (Command::OpenSave, strings::SAVE_LIBRARY, strings::SAVE_LIBRARY_HELP),
        ] {
            let button = egui::Button::new(name).min_size(vec2(width, 0.0));
            if ui.add(button).on_hover_text(help).clicked() {
                commands.push(command);
            }
        }
    });
    let field =
        ui.add(TextEdit::singleline(search).hint_text(strings::SEARCH_HINT).desired_width(f32::INFINITY));
    field.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, strings::SEARCH));
    ui.add_space(2.0);
    let wanted: Vec<String> = search.to_lowercase().split_whitespace().map(str::to_owned).collect();
    // Every word must be found, each in the name or in a tag.
    let matches = |name: &str, tags: &[String]| {
        let is_in = |text: &str, word: &String| text.to_lowercase().contains(word);
        wanted.iter().all(|word| is_in(name, word) || tags.iter().any(|tag| is_in(tag, word)))
    };
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        let mut found = false;
        for (index, entry) in panel.session.textures().iter().enumerate() {
            if matches(&entry.name, &entry.tags) {
                found = true;
                let is_new = reveal.take_if(|wanted| *wanted == index).is_some();
                let response = row(ui, panel, index, is_new);
                commands.extend(lock_menu(&response, panel, index));
                if response.clicked() {
                    let place = panel.session.space().position(index);
                    commands.push(Command::Edit(
                        place.map_or_else(|| Edit::Solo(Some(entry.id.clone())), Edit::MovePoint),
                    ));
                }
            }
        }
        if panel.session.textures().is_empty() {
            ui.label(egui::RichText::new(strings::NO_TEXTURES).color(t.text_weak));
        } else if !found {
            ui.label(egui::RichText::new(strings::NO_MATCH).color(t.text_weak));
        }
    });
    commands
}

/// The menu of the libraries that can be open: those of the program, the one that is open, and others that were.
fn libraries_ui(ui: &mut Ui, panel: &Panel<'_>) -> Option<Command> {
    let session = panel.session;
    let mut asked = None;
    let menu = ui.menu_button(strings::LIBRARIES, |ui| {
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
    menu.response.on_hover_text(strings::LIBRARIES_HELP);
    asked.map(|library| Command::Edit(Edit::OpenLibrary(library)))
}

/// One texture, scrolled to where it is new.
fn row(ui: &mut Ui, panel: &Panel<'_>, index: usize, is_new: bool) -> Response {
    let t = tokens(ui.ctx());
    let entry = &panel.session.textures()[index];
    let (area, response) = ui.allocate_exact_size(vec2(ui.available_width(), PICTURE + 6.0), Sense::click());
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, strings::texture(&entry.name)));
    if response.gained_focus() || is_new {
        response.scroll_to_me(None);
    }
    if ui.is_rect_visible(area) {
        if response.hovered() || response.has_focus() {
            ui.painter().rect_filled(area, f32::from(crate::theme::RADIUS), t.raised);
        }
        let picture = egui::Rect::from_min_size(area.min + vec2(3.0, 3.0), vec2(PICTURE, PICTURE));
        picture_ui(ui, panel, index, picture);
        let mut room = egui::Rect::from_min_max(picture.right_top() + vec2(8.0, 0.0), area.max);
        if panel.is_locked(index) {
            lock_mark(ui.painter(), area.right_center() - vec2(10.0, 0.0), true, t.text_weak);
            room.max.x -= 18.0;
        }
        let mut text = ui.new_child(
            egui::UiBuilder::new().max_rect(room).layout(egui::Layout::top_down(egui::Align::Min)),
        );
        text.spacing_mut().item_spacing.y = 1.0;
        let rank = panel.session.parent_rank(index);
        let color = rank.map_or(t.text, |r| t.parents[r.min(2)]);
        text.add(Label::new(egui::RichText::new(&entry.name).color(color)).truncate().selectable(false));
        let is_placed = panel.session.space().position(index).is_some();
        let below = match panel.session.parent_weight(index) {
            Some(_) if panel.solo().is_some() => strings::HEARD_ALONE.to_owned(),
            Some(weight) => strings::of_the_blend(100.0 * weight),
            None if entry.provenance == Provenance::Restricted && !is_placed => {
                format!("{} · {}", strings::NOT_PLACED_YET, strings::import::RESTRICTED_SHORT)
            }
            None if !is_placed => strings::NOT_PLACED_YET.to_owned(),
            None if entry.provenance == Provenance::Restricted => {
                strings::import::RESTRICTED_SHORT.to_owned()
            }
            None => entry.tags.join(", "),
        };
        text.add(
            Label::new(egui::RichText::new(below).small().color(t.text_weak)).truncate().selectable(false),
        );
    }
    let place = panel.session.space().position(index);
    let mut help = place.map_or(strings::NOT_PLACED_HELP.to_owned(), |at| place_in_words(panel, index, at));
    if entry.provenance == Provenance::Restricted {
        help = format!("{help}\n{}", strings::import::RESTRICTED);
    }
    if panel.is_locked(index) {
        help = format!("{help}\n{}", strings::LOCKED);
    }
    response.on_hover_text(format!("{}\n{help}", entry.name))
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
