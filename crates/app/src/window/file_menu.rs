//! File menu, and the name of the project in the title bar.

use std::path::Path;

use egui::containers::menu::{MenuButton, MenuConfig};
use egui::{Button, Label, PopupCloseBehavior, RichText, TextEdit, Ui};
use shagreen_formats::project::{Project, ProjectLibrary};
use shagreen_formats::settings::Settings;
use shagreen_studio::export::WAV;

use crate::command::networks::NetworksCommand;
use crate::command::{Command, FileCommand};
use crate::look::menu_checkbox::menu_checkbox;
use crate::look::motion::is_reduced;
use crate::look::theme::tokens;
use crate::state::document::Document;
use crate::state::edit::Edit;
use crate::strings::{document as strings, export, gallery, motion, networks as networks_words};

/// Maximum number of recent projects in the menu.
const MOST_RECENT: usize = 6;
/// Width of the menu, in points.
const WIDTH: f32 = 240.0;

#[derive(Clone, Copy)]
pub(crate) struct MenuState<'a> {
    /// Open project.
    pub(crate) project: &'a Project,
    /// File of the project.
    pub(crate) document: &'a Document,
    /// Settings, for the recent projects and the template.
    pub(crate) settings: &'a Settings,
    /// Whether a texture is audible and not hidden by a blind comparison.
    pub(crate) can_export: bool,
}

pub(crate) struct MenuOutcome {
    /// Commands of the user.
    pub(crate) commands: Vec<Command>,
    /// Rectangle of the menu button.
    pub(crate) area: egui::Rect,
}

pub(crate) fn file_menu(ui: &mut Ui, files: MenuState<'_>) -> MenuOutcome {
    let t = tokens(ui.ctx());
    let mut commands = Vec::new();
    let menu = ui.menu_button(strings::FILE, |ui| {
        ui.set_min_width(WIDTH);
        commands
            .extend(entry(ui, strings::NEW, &Command::File(FileCommand::New)).on_hover(strings::NEW_HELP));
        commands.extend(
            entry(ui, gallery::GALLERY, &Command::File(FileCommand::OpenGallery)).on_hover(gallery::HELP),
        );
        commands.extend(entry(ui, strings::OPEN, &Command::File(FileCommand::AskWhatToOpen)).asked);
        ui.separator();
        commands.extend(entry(ui, strings::SAVE, &Command::File(FileCommand::Save)).asked);
        commands.extend(entry(ui, strings::SAVE_AS, &Command::File(FileCommand::SaveAs)).asked);
        let to_export = Command::File(FileCommand::Export(WAV.id));
        ui.add_enabled_ui(files.can_export, |ui| {
            commands.extend(entry(ui, export::EXPORT, &to_export).on_hover(export::EXPORT_HELP));
        });
        ui.separator();
        let open = files.document.path();
        let is_template = open.is_some() && files.settings.template.as_deref() == open;
        let mut is_ticked = is_template;
        let template = menu_checkbox(ui, &mut is_ticked, strings::TEMPLATE, open.is_some());
        if template
            .on_hover_text(strings::TEMPLATE_HELP)
            .on_disabled_hover_text(strings::TEMPLATE_NEEDS_FILE)
            .clicked()
        {
            let path = open.filter(|_| !is_template).map(Path::to_owned);
            commands.push(Command::File(FileCommand::SetTemplate(path)));
        }
        let is_inside = matches!(files.project.library, ProjectLibrary::Inside(_));
        let keep = ui.add_enabled(!is_inside, Button::new(strings::KEEP_INSIDE));
        if keep.on_hover_text(strings::KEEP_INSIDE_HELP).clicked() {
            commands.push(Command::File(FileCommand::KeepLibraryInside));
        }
        ui.separator();
        for (name, help, mut is_on, command) in [
            (
                strings::DRAG_STROKE,
                strings::DRAG_STROKE_HELP,
                !files.settings.is_silent_while_dragging,
                Command::ToggleDragStroke,
            ),
            (strings::HOVER, strings::HOVER_HELP, files.settings.plays_on_hover, Command::ToggleHover),
            (motion::REDUCE, motion::REDUCE_HELP, is_reduced(ui.ctx()), Command::ToggleMotion),
        ] {
            if menu_checkbox(ui, &mut is_on, name, true).on_hover_text(help).clicked() {
                commands.push(command);
            }
        }
        let networks = Command::Networks(NetworksCommand::Open);
        commands.extend(entry(ui, networks_words::MENU, &networks).on_hover(networks_words::MENU_HELP));
        ui.separator();
        let recent =
            files.settings.recent.iter().filter(|path| Some(path.as_path()) != open).take(MOST_RECENT);
        let mut has_recent = false;
        for path in recent {
            if !std::mem::replace(&mut has_recent, true) {
                ui.add(
                    Label::new(RichText::new(strings::RECENT).small().color(t.text_weak)).selectable(false),
                );
            }
            let name = path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy();
            if ui.button(name).on_hover_text(path.display().to_string()).clicked() {
                commands.push(Command::File(FileCommand::Open(path.clone())));
            }
        }
        if has_recent {
            ui.separator();
        }
        commands.extend(entry(ui, strings::QUIT, &Command::File(FileCommand::Quit)).asked);
    });
    MenuOutcome { commands, area: menu.response.rect }
}

/// Draws the name of the project, with a dot for unsaved changes; a click opens the notes on the project. The name is
/// cut off where there is no room.
pub(crate) fn project_name_ui(ui: &mut Ui, project: &Project, document: &Document) -> Option<Command> {
    let dot = if document.is_changed() { " •" } else { "" };
    let name = RichText::new(format!("{}{dot}", document.name())).strong();
    let path = document.path().map_or_else(|| document.name(), |path| path.display().to_string());
    let help = strings::kept_at(&path, document.is_changed());
    let config = MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    let button = MenuButton::from_button(Button::new(name).truncate().frame_when_inactive(false));
    let mut asked = None;
    let (response, _) = button.config(config).ui(ui, |ui| {
        ui.set_width(WIDTH);
        ui.add(Label::new(RichText::new(strings::PROJECT_NOTES).strong()).selectable(false));
        let mut notes = project.notes.clone();
        let field = TextEdit::multiline(&mut notes)
            .hint_text(strings::PROJECT_NOTES_HINT)
            .desired_rows(6)
            .desired_width(f32::INFINITY);
        if ui.add(field).accessible_name(strings::PROJECT_NOTES).changed() {
            asked = Some(Command::Edit(Edit::SetProjectNotes(notes)));
        }
    });
    response.on_hover_text(strings::with_notes(&help, &project.notes));
    asked
}

struct Entry {
    response: egui::Response,
    asked: Option<Command>,
}

impl Entry {
    fn on_hover(self, help: &str) -> Option<Command> {
        self.response.on_hover_text(help);
        self.asked
    }
}

/// Menu entry with its shortcut.
fn entry(ui: &mut Ui, name: &str, command: &Command) -> Entry {
    let keys = command.shortcut_text(ui.ctx());
    let response = ui.add(Button::new(name).shortcut_text(keys)).accessible_name(name);
    let asked = response.clicked().then(|| command.clone());
    Entry { response, asked }
}

/// Edit that embeds the library in the project, or `None` if the library cannot be read.
pub(crate) fn kept_inside(project: &Project) -> Option<Edit> {
    // An unreadable library was reported when it was opened.
    let library = project.library.read().ok()?;
    Some(Edit::KeepLibraryInside(ProjectLibrary::Inside(library.into())))
}
