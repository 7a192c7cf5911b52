//! Title bar: file menu, workspaces, undo, output and help.

use egui::{RichText, Ui};

use super::Window;
use crate::command::Command;
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
            for (command, name, label) in [
                (Command::Undo, strings::UNDO, painting[0].or(self.history.undo_label())),
                (Command::Redo, strings::REDO, painting[1].or(self.history.redo_label())),
            ] {
                let what = label.map_or(name.to_owned(), |l| strings::verb(name, l));
                let keys = command.shortcut_text(ui.ctx());
                let button = ui.add_enabled(label.is_some(), egui::Button::new(name));
                if button.on_hover_text(format!("{what} ({keys})")).clicked() {
                    commands.push(command);
                }
            }
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                let to = if ui.visuals().dark_mode { strings::TO_LIGHT } else { strings::TO_DARK };
                commands.extend(help_menu(ui));
                if ui.button(to).clicked() {
                    commands.push(Command::ToggleTheme);
                }
                let keys = Command::OpenDevices.shortcut_text(ui.ctx());
                let help = format!("{} ({keys})", strings::devices::OPEN_HELP);
                if ui.button(strings::devices::OPEN).on_hover_text(help).clicked() {
                    commands.push(Command::OpenDevices);
                }
                let mute = if self.session.is_muted() { strings::UNMUTE } else { strings::MUTE };
                let mute = ui.selectable_label(self.session.is_muted(), mute);
                if mute.on_hover_text(strings::MUTE_HELP).clicked() {
                    commands.push(Command::ToggleMute);
                }
                // In the middle, so that a long name moves no button.
                ui.with_layout(egui::Layout::left_to_right(egui::Align::Center), |ui| {
                    ui.add_space(10.0);
                    project_name_ui(ui, &self.files.document);
                });
            });
        });
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
        ] {
            if ui.button(name).clicked() {
                asked = Some(command);
            }
        }
    });
    asked
}
