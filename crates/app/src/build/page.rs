//! Page of the Build workspace: input data, running build and built space.

use egui::{
    Align, Button, CentralPanel, Context, Frame, Label, Layout, Margin, Panel as Side, ProgressBar, RichText,
    ScrollArea, Ui, vec2,
};
use shagreen_core::people::mds::MdsOptions;
use shagreen_core::space::space_build::{SpaceOptions, Step};
use shagreen_formats::figure::Figure;
use shagreen_formats::project::ProjectLibrary;
use shagreen_formats::space_report::RATING_FIGURE;

use crate::build::figures_ui::figures_ui;
use crate::build::input_ui::{Paths, inputs_ui};
use crate::build::job::{Job, Order, Outcome};
use crate::build::judgments::Judgments;
use crate::build::options_ui::options_ui;
use crate::build::validation_ui::validation_ui;
use crate::command::Command;
use crate::look::primary::primary_button;
use crate::look::scroll_to_focus::scroll_to_focus;
use crate::look::theme::{BUILD_INPUTS_WIDTH, GAP, GROUP_GAP, RADIUS, VERDICT_WIDTH, tokens};
use crate::panel::Panel;
use crate::session::Session;
use crate::state::source::Source;
use crate::strings::build as strings;

pub use shagreen_studio::space::BuiltSpace;
use shagreen_studio::study::analysis::StudyJudgments;

/// Width of the text shown before a space is built, in points.
const EMPTY_WIDTH: f32 = 520.0;
/// Width reserved for the scroll bar, in points.
const SCROLL_BAR: i8 = 8;

/// State of the Build workspace.
pub struct BuildPage {
    judgments: Judgments,
    paths: Paths,
    options: SpaceOptions,
    /// Lowest and highest possible rating.
    scale: [f64; 2],
    library: Option<ProjectLibrary>,
    job: Option<(Job, Recipe)>,
    /// Why the last build failed, and its input.
    failure: Option<(String, Recipe)>,
    built: Option<(BuiltSpace, Recipe)>,
    /// Index of the figure that is shown.
    shown: usize,
}

/// Input of a build, to detect later changes.
#[derive(Clone, Debug, PartialEq)]
struct Recipe {
    judgments: u64,
    options: SpaceOptions,
    scale: [f64; 2],
    library: Option<ProjectLibrary>,
}

impl Default for BuildPage {
    fn default() -> Self {
        Self {
            judgments: Judgments::default(),
            paths: Paths::default(),
            options: SpaceOptions::usual(1),
            scale: [0.0, 100.0],
            library: None,
            job: None,
            failure: None,
            built: None,
            shown: 0,
        }
    }
}

impl BuildPage {
    /// Judgments that were read.
    pub fn judgments(&self) -> &Judgments {
        &self.judgments
    }

    /// Space that was built last.
    pub fn built(&self) -> Option<&BuiltSpace> {
        self.built.as_ref().map(|(built, _)| built)
    }

    /// Whether a space is being built and has not been cancelled.
    pub fn is_building(&self) -> bool {
        self.job.as_ref().is_some_and(|(job, _)| !job.is_stopping())
    }

    /// Whether a cancelled build is still running.
    pub fn is_stopping(&self) -> bool {
        self.job.as_ref().is_some_and(|(job, _)| job.is_stopping())
    }

    /// Reads dropped files, each as the kind detected from its name and columns.
    pub fn read(&mut self, sources: Vec<Source>, ctx: &Context) {
        self.judgments.read(sources, None, ctx);
    }

    /// Takes the judgments of a study with this name, in place of all tables.
    pub(crate) fn take_study(&mut self, name: &str, judgments: StudyJudgments) {
        self.judgments.take_study(name, judgments);
        self.scale = [0.0, 100.0];
    }

    /// Takes over the results of the background jobs.
    pub fn collect(&mut self) {
        self.judgments.collect();
        let Some(outcome) = self.job.as_mut().and_then(|(job, _)| job.collect()) else { return };
        let Some((_, recipe)) = self.job.take() else { return };
        match outcome {
            Outcome::Built(built) => {
                self.shown = with_data(&built, self.shown);
                (self.built, self.failure) = (Some((*built, recipe)), None);
            }
            Outcome::Failed(reason) => self.failure = Some((reason, recipe)),
            Outcome::Cancelled => {}
        }
    }

    /// Draws the page; returns the requested commands.
    pub(crate) fn show(&mut self, ui: &mut Ui, panel: &Panel<'_>) -> Vec<Command> {
        let mut commands = Vec::new();
        let t = tokens(ui.ctx());
        self.library = Some(panel.project.library.clone());
        Side::left("build inputs").exact_size(BUILD_INPUTS_WIDTH).resizable(false).show(ui, |ui| {
            commands.extend(self.left_ui(ui, panel.session));
        });
        Side::right("verdict").exact_size(VERDICT_WIDTH).resizable(false).show(ui, |ui| {
            commands.extend(validation_ui(ui, panel, self.built(), self.has_changed()));
        });
        let frame = Frame::new().fill(t.panel).inner_margin(Margin::same(10));
        CentralPanel::default().frame(frame).show(ui, |ui| match &self.built {
            Some((built, _)) => commands.extend(figures_ui(ui, built, &mut self.shown)),
            None => empty_ui(ui),
        });
        commands
    }

    fn recipe(&self) -> Recipe {
        Recipe {
            judgments: self.judgments.generation(),
            options: self.options.clone(),
            scale: self.scale,
            library: self.library.clone(),
        }
    }

    /// Whether library, judgments or options differ from those of the space that is shown.
    fn has_changed(&self) -> bool {
        self.built.as_ref().is_some_and(|(_, recipe)| *recipe != self.recipe())
    }

    fn left_ui(&mut self, ui: &mut Ui, session: &Session) -> Option<Command> {
        let mut asked = None;
        // The scroll bar is drawn over the content at its side.
        let beside_bar = Frame::new().inner_margin(Margin { right: SCROLL_BAR, ..Margin::ZERO });
        let frame = Frame::new().inner_margin(Margin::symmetric(0, 8));
        Side::bottom("build button").frame(frame).show(ui, |ui| {
            beside_bar.show(ui, |ui| self.build_ui(ui, session));
        });
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            ui.set_max_width(ui.available_width() - f32::from(SCROLL_BAR));
            ui.add_space(GAP);
            let inputs = inputs_ui(ui, &mut self.judgments, &mut self.paths, &mut self.scale, session);
            if inputs.simulate {
                let library = session.library_as_opened();
                self.judgments.simulate(library, self.options.seed, ui.ctx());
            }
            asked = inputs.command;
            ui.add_space(GROUP_GAP);
            let is_rated_alone =
                self.judgments.ratings.read.is_some() && self.judgments.sorting.read.is_none();
            options_ui(ui, &mut self.options, self.judgments.ratings.values(), is_rated_alone);
            scroll_to_focus(ui);
        });
        asked
    }

    /// Draws the build button, or the progress of the build.
    fn build_ui(&mut self, ui: &mut Ui, session: &Session) {
        let t = tokens(ui.ctx());
        let weak = |ui: &mut Ui, text: &str, color| {
            ui.add(Label::new(RichText::new(text).small().color(color)).wrap());
        };
        if let Some((job, _)) = &self.job {
            progress_ui(ui, job);
            return;
        }
        if let Some((reason, recipe)) = &self.failure
            && *recipe == self.recipe()
        {
            ui.add(Label::new(RichText::new(reason).color(t.error)).wrap());
        }
        let can_build = self.judgments.ratings.read.is_some();
        let name = if self.has_changed() { strings::BUILD_AGAIN } else { strings::BUILD_SPACE };
        let button = primary_button(t, name, can_build);
        let size = vec2(ui.available_width(), 30.0);
        let is_wanted = ui.add_enabled_ui(can_build, |ui| ui.add_sized(size, button).clicked()).inner;
        if is_wanted {
            self.start(session, ui.ctx());
        }
        if !can_build {
            weak(ui, strings::NEEDS_RATINGS, t.text_weak);
        }
    }

    fn start(&mut self, session: &Session, ctx: &Context) {
        let ratings = match self.judgments.ratings_on(self.scale) {
            Ok(ratings) => ratings,
            Err(reason) => {
                self.failure = Some((reason, self.recipe()));
                return;
            }
        };
        let seed = self.options.seed;
        let options =
            SpaceOptions { mds: MdsOptions { seed, ..self.options.mds.clone() }, ..self.options.clone() };
        let order = Order {
            textures: session.textures().iter().map(|t| (t.id.clone(), t.model.clone())).collect(),
            sorts: self.judgments.sorting.shared(),
            ratings,
            votes: self.judgments.votes.shared(),
            source: self.judgments.source(),
            options,
        };
        self.failure = None;
        self.job = Some((Job::start(order, ctx), self.recipe()));
    }
}

/// Index of the figure to show: `shown`, or the first mean ratings if it is empty, because there are no sorts.
fn with_data(built: &BuiltSpace, shown: usize) -> usize {
    let is_empty = |figure: &Figure| matches!(figure, Figure::Chart(chart) if chart.series.is_empty());
    let is_kept = built.figures.get(shown).is_some_and(|(_, figure)| !is_empty(figure));
    let of_ratings = || built.figures.iter().position(|(name, _)| name.starts_with(RATING_FIGURE));
    if is_kept { shown } else { of_ratings().unwrap_or(0) }
}

/// Draws the progress of the build and the button that cancels it.
fn progress_ui(ui: &mut Ui, job: &Job) {
    let t = tokens(ui.ctx());
    let (step, secs, is_stopping) = (job.step(), job.elapsed().as_secs(), job.is_stopping());
    let share = (step.index() as f32 + 0.5) / Step::COUNT as f32;
    let color = if is_stopping { t.text_weak } else { t.accent };
    ui.add(ProgressBar::new(share).desired_height(8.0).fill(color));
    ui.horizontal(|ui| {
        let said = if is_stopping { strings::STOPPING.to_owned() } else { strings::step(step) };
        let text = RichText::new(said).small();
        ui.add(Label::new(if is_stopping { text.color(t.warning) } else { text }).selectable(false));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let cancel = ui.add_enabled(!is_stopping, Button::new(strings::CANCEL));
            if cancel.on_hover_text(strings::CANCEL_HELP).clicked() {
                job.cancel();
                ui.ctx().request_repaint();
            }
            let secs = RichText::new(format!("{secs} s")).small().color(t.text_weak);
            ui.add(Label::new(secs).selectable(false));
        });
    });
}

/// Draws the text shown before a space is built.
fn empty_ui(ui: &mut Ui) {
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        ui.add_space(0.1 * ui.clip_rect().height());
        let width = ui.available_width().min(EMPTY_WIDTH);
        ui.horizontal_top(|ui| {
            ui.add_space(0.5 * (ui.available_width() - width));
            ui.vertical(|ui| {
                ui.set_max_width(width);
                lesson_ui(ui);
            });
        });
    });
}

/// Draws the steps to follow and examples of the tables.
fn lesson_ui(ui: &mut Ui) {
    let t = tokens(ui.ctx());
    ui.add(Label::new(RichText::new(strings::EMPTY_TITLE).heading().strong()).selectable(false));
    ui.add_space(GAP);
    for (number, step) in (1..).zip(strings::EMPTY_STEPS) {
        ui.add(Label::new(RichText::new(format!("{number}.  {step}")).color(t.text_weak)).wrap());
    }
    for (title, example) in [
        (strings::SORTING_EXAMPLE_TITLE, strings::SORTING_EXAMPLE),
        (strings::RATINGS_EXAMPLE_TITLE, strings::RATINGS_EXAMPLE),
    ] {
        ui.add_space(GROUP_GAP);
        ui.add(Label::new(title).wrap().selectable(false));
        Frame::new().fill(t.background).corner_radius(RADIUS).inner_margin(GROUP_GAP).show(ui, |ui| {
            ui.set_width(ui.available_width());
            ui.add(Label::new(RichText::new(example).monospace()).wrap());
        });
    }
    ui.add_space(GAP);
    ui.add(Label::new(RichText::new(strings::EXAMPLE_NOTE).small().color(t.text_weak)).wrap());
}
