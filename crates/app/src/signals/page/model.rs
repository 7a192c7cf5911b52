//! The model that predicts d' of the signals.

use std::path::PathBuf;
use std::sync::Arc;

use egui::Context;
use shagreen_studio::quality_model::ChosenModel;

use super::{SignalsPage, View};

impl SignalsPage {
    /// Model of d' that the user has opened; `None` is the built-in one.
    pub fn model(&self) -> Option<&ChosenModel> {
        self.model.own().map(Arc::as_ref)
    }

    /// Why the last file of a model was refused.
    pub fn model_failure(&self) -> Option<&str> {
        self.model.failure()
    }

    /// The model of the settings, which is read once [`View::Differences`] is shown.
    pub(crate) fn remember_model(&mut self, path: Option<PathBuf>) {
        self.model.remember(path);
    }

    /// Reads a model of d' in the background.
    pub(crate) fn open_model(&mut self, path: PathBuf, ctx: &Context) {
        self.model.open(path, ctx);
    }

    /// Returns to the built-in model of d'.
    pub(crate) fn use_built_in_model(&mut self) {
        self.model.use_built_in();
        self.forget_predictions();
    }

    /// Puts a model that the user has chosen into the settings.
    pub(crate) fn store_model(&mut self, setting: &mut Option<PathBuf>) {
        self.model.store(setting);
    }

    /// Takes over a model that was read. Returns whether d' is to be predicted now: the view shows it, and no other model is
    /// being read.
    pub(super) fn collect_model(&mut self, ctx: &Context) -> bool {
        let is_shown = self.view == View::Differences;
        if is_shown {
            self.model.begin(ctx);
        }
        if self.model.collect(ctx) {
            self.forget_predictions();
        }
        is_shown && !self.model.is_reading()
    }

    fn forget_predictions(&mut self) {
        self.compared.forget();
        for place in &mut self.places {
            place.forget_rates();
        }
    }
}
