//! Title bar: file menu, workspaces, undo, output and help.

use egui::{RichText, Ui, vec2};

use super::Window;
use crate::command::Command;
use crate::look::icons::{
    ICON_DARK_MODE, ICON_LIGHT_MODE, ICON_REDO, ICON_UNDO, ICON_VOLUME_OFF, ICON_VOLUME_UP, icon_button,
};
use crate::look::theme::tokens;
use crate::strings;
use crate::window::file_menu::{MenuState, file_menu, project_name_ui};
use crate::workspace::Workspace;

impl Window {
    /// Names of the undo and redo steps of the spectrogram editor in the Signals workspace. They take precedence over
    /// edits of the project.
    pub(super) fn painting_labels(&self) -> [Option<&'static str>; 2] {
        if self.pages.workspace == Workspace::Signals {
            self.pages.signals.painting_labels()
        } else {
            [None; 2]
        }
    }

    /// Draws the title bar and returns the commands of the user.
    pub(super) fn title_ui(&mut self, ui: &mut Ui) -> Vec<Command> {
        let mut commands = Vec::new();
        ui.horizontal_centered(|ui| {
            let t = tokens(ui.ctx());
            ui.add(
                egui::Label::new(RichText::new(strings::APP).heading().strong().color(t.accent))
                    .selectable(false),
            );
            ui.add_space(6.0);
            let files = MenuState {
                project: &self.project,
                document: &self.files.document,
                settings: &self.files.settings,
                can_export: self.session.authored().is_some() || self.session.felt_name().is_some(),
            };
            let menu = file_menu(ui, files);
            self.tour.places[3] = menu.area;
            commands.extend(menu.commands);
            ui.add_space(10.0);
            for workspace in Workspace::ALL {
                let command = Command::Show(workspace);
                let keys = command.shortcut_text(ui.ctx());
                let tab = ui.selectable_label(self.pages.workspace == workspace, workspace.info().name);
                if tab.on_hover_text(format!("{} ({keys})", workspace.info().help)).clicked() {
                    commands.push(command);
                }
            }
            ui.add_space(10.0);
            let painting = self.painting_labels();
            for (command, icon, name, label) in [
                (Command::Undo, ICON_UNDO, strings::UNDO, painting[0].or(self.history.undo_label())),
                (Command::Redo, ICON_REDO, strings::REDO, painting[1].or(self.history.redo_label())),
            ] {
                let what = label.map_or(name.to_owned(), |l| strings::verb(name, l));
                let keys = command.shortcut_text(ui.ctx());
                let button = ui.add_enabled(label.is_some(), icon_button(icon)).accessible_name(name);
                if button.on_hover_text(format!("{what} ({keys})")).clicked() {
                    commands.push(command);
                }
            }
            // The name is in the middle, so that a long one moves no button. The buttons follow in the order in which
            // they are read, which needs their width: that of the last frame.
            ui.add_space(10.0);
            let key = ui.scope_id().with("width of the buttons at the right");
            let width: f32 = ui.data(|data| data.get_temp(key)).unwrap_or_default();
            let room = vec2((ui.available_width() - width).max(0.0), ui.available_height());
            ui.allocate_ui_with_layout(room, egui::Layout::left_to_right(egui::Align::Center), |ui| {
                ui.set_min_size(room);
                commands.extend(project_name_ui(ui, &self.project, &self.files.document));
            });
            let begin = ui.cursor().left();
            commands.extend(self.device_buttons(ui));
            commands.extend(help_menu(ui));
            let drawn = ui.min_rect().right() - begin + ui.spacing().item_spacing.x;
            if (drawn - width).abs() > 0.5 {
                ui.data_mut(|data| data.insert_temp(key, drawn));
                ui.ctx().request_discard("the width of the title bar's buttons has changed");
            }
        });
        commands
    }

    /// Draws the buttons for the output, the devices and the theme.
    fn device_buttons(&self, ui: &mut Ui) -> Vec<Command> {
        let mut commands = Vec::new();
        let is_muted = self.session.is_muted();
        let (icon, name) =
            if is_muted { (ICON_VOLUME_OFF, strings::UNMUTE) } else { (ICON_VOLUME_UP, strings::MUTE) };
        let mute = ui.add(icon_button(icon).selected(is_muted)).accessible_name(name);
        if mute.on_hover_text(format!("{name}\n{}", strings::MUTE_HELP)).clicked() {
            commands.push(Command::ToggleMute);
        }
        let keys = Command::OpenDevices.shortcut_text(ui.ctx());
        let help = format!("{} ({keys})", strings::devices::OPEN_HELP);
        if ui.button(strings::devices::OPEN).on_hover_text(help).clicked() {
            commands.push(Command::OpenDevices);
        }
        let (icon, to) = if ui.visuals().dark_mode {
            (ICON_LIGHT_MODE, strings::TO_LIGHT)
        } else {
            (ICON_DARK_MODE, strings::TO_DARK)
        };
        if ui.add(icon_button(icon)).accessible_name(to).on_hover_text(to).clicked() {
            commands.push(Command::ToggleTheme);
        }
        commands
    }
}

fn help_menu(ui: &mut Ui) -> Option<Command> {
    let mut asked = None;
    ui.menu_button(strings::help::HELP, |ui| {
        for (name, command) in [
            (strings::help::GUIDE, Command::OpenGuide),
            (strings::help::PALETTE, Command::OpenPalette),
            (strings::help::TOUR, Command::BeginTour),
            (strings::help::SHORTCUTS, Command::OpenShortcuts),
            (strings::papers::MENU, Command::OpenPapers),
            (strings::about::ABOUT, Command::OpenAbout),
        ] {
            if ui.button(name).clicked() {
                asked = Some(command);
            }
        }
    });
    asked
}
