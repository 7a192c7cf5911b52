//! Opening of the window.

use std::path::PathBuf;

use shagreen_formats::project::Project;
use shagreen_studio::models::ModelFolder;

use crate::author::prompt::Prompts;
use crate::look::icons;
use crate::look::motion::set_reduced;
use crate::look::scale::Scale;
use crate::look::theme::install;
use crate::session::{OutputChoice, Session};
use crate::sheets::Sheet;
use crate::state::compare::Compare;
use crate::state::document::DocumentFile;
use crate::state::files::{Files, StoragePaths};
use crate::state::history::History;
use crate::state::pictures::Pictures;
use crate::window::gesture_counter::GestureCounter;
use crate::window::hints::recall_hints;
use crate::window::pages::Pages;
use crate::window::preview::Preview;
use crate::window::rig::{SelectedOutput, open_as_left};
use crate::window::tour::Tour;
use crate::window::{Readers, Window};

/// Initial content of the window.
#[derive(Clone, Debug)]
pub struct Begin {
    /// Open project.
    pub project: Project,
    /// File of the project, or `None` for an unsaved project.
    pub file: Option<DocumentFile>,
    /// File to open or import at the start: a recording, a model, a stroke, a photo, or a project about which a question
    /// must be answered first.
    pub take: Option<PathBuf>,
    /// Output to open.
    pub output: OutputChoice,
    /// Paths of the files that outlive the program.
    pub keeping: StoragePaths,
    /// Seed of a simulated participant who takes part in the study of the file to open.
    pub simulation_seed: Option<u64>,
}

impl Window {
    /// Opens a window on a project; the output is opened in the background.
    ///
    /// # Errors
    /// The library cannot be read, or its positions do not form a space.
    pub fn new(ctx: &egui::Context, begin: Begin) -> anyhow::Result<Self> {
        install(ctx);
        icons::install(ctx);
        let Begin { mut project, file, take, output, keeping, simulation_seed } = begin;
        // A new project on a library has a point in the middle of the usual axes.
        project.fit_points();
        let mut session = Session::new(project.library.clone())?;
        session.list_outputs(ctx);
        let leftovers = Files::leftovers(&keeping);
        // Without a settings file the tour would start at every program start, so it is not shown.
        let can_remember = keeping.settings.is_some();
        let sheet = if leftovers.is_empty() { Sheet::Closed } else { Sheet::Recovered(leftovers) };
        let mut prompts = Prompts::new(keeping.models.clone().map(ModelFolder::new));
        let files = Files::new(&project, file, keeping);
        prompts.use_networks(files.settings.photo_networks.clone());
        let selected_output = SelectedOutput::at_start(&output);
        open_as_left(&mut session, output, &files, ctx);
        session.follow(&project, None, ctx);
        let pictures = Pictures::new(project.library.clone(), &project.joined, session.textures());
        recall_hints(&files.settings, ctx);
        set_reduced(ctx, files.reduces_motion());
        let is_new_here = can_remember && !files.settings.has_seen_tour;
        let mut tour = Tour::default();
        if is_new_here {
            tour.begin();
        }
        if let Some(is_light) = files.settings.is_light {
            ctx.set_theme(if is_light { egui::Theme::Light } else { egui::Theme::Dark });
        }
        let scale = Scale::new(files.settings.scale);
        ctx.set_zoom_factor(scale.set());
        let mut pages = Pages::default();
        pages.studies.simulate(simulation_seed);
        pages.signals.remember_model(files.settings.quality_model.clone());
        Ok(Self {
            project,
            history: History::default(),
            session,
            pictures,
            readers: Readers::default(),
            prompts,
            files,
            compare: Compare::by_chance(),
            scale,
            has_been_shown: false,
            gesture: GestureCounter::default(),
            sheet,
            tour,
            pages,
            // Without a current folder, the user completes the path.
            exports_folder: std::env::current_dir().unwrap_or_default(),
            output: selected_output,
            preview: Preview::default(),
            take,
        })
    }
}
