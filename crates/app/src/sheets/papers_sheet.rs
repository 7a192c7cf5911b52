//! Sheet that repeats the procedure of a paper in the background, and shows the printed numbers beside ours.

mod results_ui;

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};

use egui::{ComboBox, Context, Label, RichText, ScrollArea, Ui};
use shagreen_formats::printed_results::Paper;
use shagreen_formats::reproduction_report::Reproduction;
use shagreen_studio::file::one_line;
use shagreen_studio::report::Warnings;
use shagreen_studio::reproduce::{
    Extent, ReproduceOptions, check_reproduction_folder, reproduce, write_reproductions,
};

use self::results_ui::results_ui;
use crate::command::Command;
use crate::look::list::ShowList as _;
use crate::look::motion::busy_ui;
use crate::look::primary::primary_ui;
use crate::look::sheet_frame::sheet;
use crate::look::theme::{GAP, SCROLL_BAR_ROOM, tokens};
use crate::look::together::at_right_ui;
use crate::sheets::path_field::{PathField, PathTexts, completed};
use crate::state::background::in_background;
use crate::strings::{help, papers as strings, sentence};

/// Width of the sheet, and of the list of papers, in points.
const WIDTH: f32 = 720.0;
const LIST_WIDTH: f32 = 300.0;
/// Height of the sheet around the results, and least height of the results, in points.
const AROUND: f32 = 330.0;
const LEAST_RESULTS: f32 = 140.0;
/// Seed of all random numbers; that of the command line without `--seed`.
const SEED: u64 = 1;

/// A repeated paper.
struct Repeated {
    reproduction: Reproduction,
    /// Path of the written index, or why it could not be written; `None` without a folder.
    written: Option<Result<PathBuf, String>>,
}

/// Work that runs. Without a receiver of its steps, it ends after the present one.
struct Job {
    steps: Receiver<&'static str>,
    /// Step that was begun last.
    step: Option<&'static str>,
    arriving: Receiver<Result<Repeated, String>>,
}

/// State of the open sheet.
pub(crate) struct PapersSheet {
    paper: Paper,
    folder: PathField,
    job: Option<Job>,
    /// Result of the last work, or why there is none.
    outcome: Option<Result<Repeated, String>>,
}

impl PapersSheet {
    pub(crate) fn new() -> Self {
        Self { paper: Paper::S0, folder: PathField::new(String::new()), job: None, outcome: None }
    }

    /// Draws the sheet; returns the requested command.
    pub(crate) fn show(&mut self, ctx: &Context) -> Option<Command> {
        self.collect();
        let shown = sheet(ctx, "papers sheet", |ui| {
            ui.set_width(WIDTH);
            self.content_ui(ui)
        });
        shown.inner.then_some(Command::CloseSheet)
    }

    /// Chooses a paper. The results of another one vanish.
    fn choose(&mut self, paper: Paper) {
        if paper != self.paper {
            (self.paper, self.outcome) = (paper, None);
        }
    }

    /// Takes in what the worker has done.
    fn collect(&mut self) {
        let Some(job) = &mut self.job else { return };
        job.step = job.steps.try_iter().last().or(job.step);
        let outcome = match job.arriving.try_recv() {
            Ok(outcome) => outcome,
            Err(TryRecvError::Empty) => return,
            Err(TryRecvError::Disconnected) => Err(strings::BROKEN.to_owned()),
        };
        (self.job, self.outcome) = (None, Some(outcome));
    }

    /// Folder to write to; `None` if the field is empty.
    fn folder(&self) -> Option<PathBuf> {
        let text = self.folder.text();
        (!text.is_empty()).then(|| completed(text, ""))
    }

    fn begin(&mut self, ctx: &Context) {
        let (paper, folder, screen) = (self.paper, self.folder(), ctx.clone());
        let (sender, steps) = channel();
        let work = move || repeated(paper, folder.as_deref(), &sender, &screen);
        self.outcome = None;
        self.job = Some(Job { steps, step: None, arriving: in_background(ctx.clone(), work) });
    }

    /// Draws the content; returns whether the user closes the sheet.
    fn content_ui(&mut self, ui: &mut Ui) -> bool {
        let t = tokens(ui.ctx());
        let is_free = self.job.is_none();
        ui.add(Label::new(RichText::new(strings::TITLE).heading().strong()).selectable(false));
        ui.add(Label::new(RichText::new(strings::PURPOSE).color(t.text_weak)).wrap());
        ui.add_space(GAP);
        ui.add_enabled_ui(is_free, |ui| self.paper_ui(ui));
        ui.add(Label::new(RichText::new(strings::FOLDER).color(t.text_weak)).selectable(false));
        let texts = PathTexts {
            title: strings::FOLDER,
            name: strings::FOLDER,
            hint: strings::FOLDER_HINT,
            ending: "",
        };
        let input = self.folder.show(ui, texts, is_free);
        if input.is_entered && is_free {
            self.begin(ui.ctx());
        }
        ui.add_space(GAP);
        self.outcome_ui(ui);
        ui.add_space(GAP);
        self.foot_ui(ui)
    }

    fn paper_ui(&mut self, ui: &mut Ui) {
        let list = ComboBox::from_id_salt("paper").width(LIST_WIDTH);
        let mut chosen = self.paper;
        let list = list.selected_text(strings::name(chosen)).show_list(ui, |ui| {
            for paper in Paper::ALL {
                ui.selectable_value(&mut chosen, paper, strings::name(paper));
            }
        });
        self.choose(chosen);
        list.response.accessible_name(strings::PAPER);
    }

    /// Draws the numbers and figures, or why there are none.
    fn outcome_ui(&self, ui: &mut Ui) {
        let t = tokens(ui.ctx());
        match &self.outcome {
            None => {}
            Some(Err(reason)) => {
                ui.add(Label::new(RichText::new(sentence(reason)).color(t.error)).wrap());
            }
            Some(Ok(Repeated { reproduction, written })) => {
                match written {
                    None => {}
                    Some(Ok(index)) => {
                        let text = strings::written(&index.display().to_string());
                        ui.add(Label::new(RichText::new(text).color(t.accent)).wrap());
                    }
                    Some(Err(reason)) => {
                        ui.add(Label::new(RichText::new(sentence(reason)).color(t.error)).wrap());
                    }
                }
                let height = (ui.ctx().content_rect().height() - AROUND).max(LEAST_RESULTS);
                // The height is fixed, so that the buttons below do not move.
                let area = ScrollArea::vertical().id_salt("results").min_scrolled_height(height);
                area.max_height(height).auto_shrink([false, false]).show(ui, |ui| {
                    ui.set_max_width(ui.available_width() - SCROLL_BAR_ROOM);
                    results_ui(ui, reproduction);
                });
            }
        }
    }

    /// Draws the progress and the buttons; returns whether the user closes the sheet.
    fn foot_ui(&mut self, ui: &mut Ui) -> bool {
        let mut is_closed = false;
        ui.horizontal(|ui| {
            if let Some(job) = &self.job {
                busy_ui(ui);
                let step = job.step.map_or_else(|| strings::BEGINNING.to_owned(), strings::step);
                ui.add(Label::new(step).selectable(false));
            }
            at_right_ui(ui, |ui| {
                if self.job.is_some() {
                    if ui.button(strings::STOP).on_hover_text(strings::STOP_HELP).clicked() {
                        self.job = None;
                    }
                } else if primary_ui(ui, strings::START, true).on_hover_text(strings::START_HELP).clicked() {
                    self.begin(ui.ctx());
                }
                is_closed = ui.button(help::CLOSE).clicked();
            });
        });
        is_closed
    }
}

/// Repeats a paper with its built-in data, and writes its files into a folder.
fn repeated(
    paper: Paper,
    folder: Option<&Path>,
    steps: &Sender<&'static str>,
    screen: &Context,
) -> Result<Repeated, String> {
    if let Some(folder) = folder {
        check_reproduction_folder(folder, &[paper]).map_err(|error| one_line(&error))?;
    }
    let options = ReproduceOptions {
        library: None,
        judgments: None,
        backbone: None,
        is_full: false,
        extent: Extent::paper(),
        seed: SEED,
        command: command(paper),
    };
    let mut on_step = |step: &'static str| {
        let goes_on = steps.send(step).is_ok();
        screen.request_repaint();
        goes_on
    };
    let reproduction = reproduce(paper, &options, &mut on_step, &Warnings::default());
    let reproduction = reproduction.map_err(|error| one_line(&error))?;
    let write = |folder: &Path| {
        write_reproductions(folder, std::slice::from_ref(&reproduction)).map_err(|error| one_line(&error))
    };
    let written = folder.map(write);
    Ok(Repeated { reproduction, written })
}

/// The command that gives the same numbers.
fn command(paper: Paper) -> String {
    // The window uses no downloaded network here.
    let backbone = if paper == Paper::S1 { " --backbone none" } else { "" };
    format!("shagreen reproduce {}{backbone} --seed {SEED}", paper.id())
}

#[cfg(test)]
mod tests {
    use super::{PapersSheet, command, repeated};
    use egui::Context;
    use shagreen_formats::printed_results::Paper;
    use std::sync::mpsc::channel;

    #[test]
    fn a_paper_is_written_and_ends_when_nobody_waits_for_it() {
        let folder = tempfile::tempdir().unwrap();
        let (sender, steps) = channel();
        let of = repeated(Paper::S4, Some(folder.path()), &sender, &Context::default()).unwrap();
        assert_eq!(of.written.unwrap().unwrap(), folder.path().join("index.md"));
        assert!(folder.path().join("S4.md").is_file() && of.reproduction.items.len() >= 5);
        assert!(steps.try_iter().count() >= 3);
        drop(steps);
        let ended = repeated(Paper::S4, None, &sender, &Context::default());
        assert!(ended.is_err_and(|reason| reason.contains("was ended")));
        // A file of another kind stays.
        std::fs::write(folder.path().join("S4.md"), "# Mine").unwrap();
        let refused = repeated(Paper::S4, Some(folder.path()), &sender, &Context::default());
        assert!(refused.is_err_and(|reason| reason.contains("would replace a file of another kind")));
    }

    #[test]
    fn the_results_of_another_paper_vanish() {
        let mut sheet = PapersSheet::new();
        sheet.outcome = Some(Err("no room".to_owned()));
        sheet.choose(Paper::S0);
        assert!(sheet.outcome.is_some(), "the same paper");
        sheet.choose(Paper::S4);
        assert!(sheet.paper == Paper::S4 && sheet.outcome.is_none());
    }

    #[test]
    fn no_folder_is_none_and_the_command_names_what_is_used() {
        assert_eq!(PapersSheet::new().folder(), None);
        assert_eq!(command(Paper::S3), "shagreen reproduce S3 --seed 1");
        assert_eq!(command(Paper::S1), "shagreen reproduce S1 --backbone none --seed 1");
    }
}
