//! Studies: their commands, and the session that runs over the whole window.

use std::sync::Arc;

use egui::{Context, Ui, ViewportCommand};
use shagreen_studio::study::stimuli::SIGNAL_CONTACT;

use super::Window;
use super::focus_ring::focus_ring_ui;
use crate::command::studies::StudiesCommand;
use crate::session::Presented;
use crate::sheets::Sheet;
use crate::studies::page::{points_per_mm, screen_scale};
use crate::studies::runner::{RunnerAudible, RunnerInput};
use crate::workspace::Workspace;

impl Window {
    /// Executes a command of the Studies workspace.
    pub(super) fn carry_out_studies(&mut self, command: StudiesCommand, ctx: &Context) {
        match command {
            StudiesCommand::Open(sources) => {
                self.sheet = Sheet::Closed;
                self.pages.workspace = Workspace::Studies;
                self.pages.studies.open_file(sources, &self.project, ctx);
            }
            StudiesCommand::Start(start) => {
                // Nothing of the authoring plays during a study.
                self.compare.end();
                self.session.set_hand(None);
                self.pages.studies.start(start, &self.project, ctx);
                self.keep_log_folder();
            }
            StudiesCommand::ChooseLogFolder(folder) => {
                self.pages.studies.choose_log_folder(folder, ctx);
                self.keep_log_folder();
            }
            StudiesCommand::UseInBuild => {
                if let Some((name, judgments)) = self.pages.studies.judgments() {
                    self.pages.build.take_study(&name, judgments);
                    self.pages.workspace = Workspace::Build;
                }
            }
            StudiesCommand::SetScale(pixels_per_mm) => {
                self.files.settings.studies.pixels_per_mm = Some(pixels_per_mm);
            }
            StudiesCommand::SelectMaskingOutput(id) => self.files.settings.studies.masking_output = id,
        }
    }

    /// Remembers the folder that was chosen for the logs of the open plan, once the plan has a file.
    fn keep_log_folder(&mut self) {
        let studies = &mut self.files.settings.studies;
        if let Some((plan, folder)) = self.pages.studies.chosen_log_folder()
            && studies.log_folder_of(plan) != Some(folder)
        {
            studies.choose_log_folder(plan, folder);
        }
    }

    /// Passes what the Studies workspace needs to know, once a frame while it is visible.
    pub(super) fn follow_studies(&mut self, ctx: &Context) {
        if self.pages.workspace != Workspace::Studies {
            return;
        }
        let folder = self.usual_folder();
        if let Some(command) = self.pages.studies.follow(&self.files.settings.studies, folder) {
            self.carry_out(command, ctx);
        }
    }

    /// Draws the session of a study over the whole window, and plays what it presents. Returns whether one runs.
    pub(super) fn study_ui(&mut self, ui: &mut Ui, ctx: &Context) -> bool {
        let pixels_per_mm = self.files.settings.studies.pixels_per_mm;
        let masking = self.pages.studies.masking_name(&self.session);
        let Some(runner) = self.pages.studies.runner() else { return false };
        let input = RunnerInput {
            project: &self.project,
            session: &self.session,
            prompts: &self.prompts,
            points_per_mm: points_per_mm(pixels_per_mm, ctx),
            screen: screen_scale(pixels_per_mm, ctx),
            masking: masking.as_deref(),
        };
        let mouse = runner.show(ui, &input);
        let (stroke, has_left) = (runner.stroke(), runner.has_left());
        if let Some(report) = mouse {
            self.session.mouse(report, SIGNAL_CONTACT.force.0 as f32);
        }
        self.session.set_hand(stroke);
        self.present(ctx);
        focus_ring_ui(ctx);
        if has_left {
            self.session.set_hand(None);
            self.pages.studies.leave(ctx);
        }
        self.keep_scale(ctx);
        self.keep_going(ctx);
        true
    }

    /// Plays what the running session presents.
    fn present(&mut self, ctx: &Context) {
        self.session.set_hidden(false);
        let touch = self.session.touch();
        let Some(runner) = self.pages.studies.runner() else { return };
        let heard = match runner.audible(touch) {
            RunnerAudible::Nothing(rate) => {
                self.session.present(Presented::Silence(rate));
                None
            }
            RunnerAudible::Stimulus(stimulus) => {
                self.session.present(Presented::Stimulus(stimulus));
                None
            }
            RunnerAudible::Authored(texture) => {
                self.session.feel(None);
                Some(Arc::clone(texture))
            }
        };
        self.session.follow(&self.project, heard.as_deref(), ctx);
    }

    /// Asks the participant before the window closes while a session runs; returns whether one does.
    pub(super) fn asks_to_leave_study(&mut self, ctx: &Context) -> bool {
        let Some(runner) = self.pages.studies.runner() else { return false };
        ctx.send_viewport_cmd(ViewportCommand::CancelClose);
        runner.ask_to_leave();
        true
    }
}
