//! Model of d' of the view Differences: the built-in one, or a file of `shagreen quality fit` that the user has opened.

use std::path::PathBuf;
use std::sync::Arc;

use egui::Context;
use shagreen_studio::file::one_line;
use shagreen_studio::quality_model::{ChosenModel, load_quality_model};

use crate::state::background::{JobPanicked, LatestJob};
use crate::strings::signals as strings;

/// A model file and its content, or why it was refused.
type Read = (PathBuf, Result<ChosenModel, String>);

/// Present model, and the one that is being read.
#[derive(Default)]
pub(super) struct ModelChoice {
    /// Opened model; `None` is the built-in one.
    own: Option<Arc<ChosenModel>>,
    /// File of the opened model.
    path: Option<PathBuf>,
    /// File of the settings, until it is needed.
    remembered: Option<PathBuf>,
    reading: LatestJob<Read>,
    /// Whether the file that is being read was chosen in this session, so that the settings must keep it.
    is_new: bool,
    /// Why the last file was refused. The previous model is kept.
    failure: Option<String>,
    /// Whether the settings do not have the choice of the user yet.
    is_unsaved: bool,
}

impl ModelChoice {
    /// The model of the settings, which is read when it is needed.
    pub(super) fn remember(&mut self, path: Option<PathBuf>) {
        self.remembered = path;
    }

    /// Opened model; `None` is the built-in one.
    pub(super) fn own(&self) -> Option<&Arc<ChosenModel>> {
        self.own.as_ref()
    }

    /// Why the last file was refused.
    pub(super) fn failure(&self) -> Option<&str> {
        self.failure.as_deref()
    }

    /// Whether a model is being read, so that a prediction would be out of date at once.
    pub(super) fn is_reading(&self) -> bool {
        self.reading.is_busy()
    }

    /// Reads a file in the background.
    pub(super) fn open(&mut self, path: PathBuf, ctx: &Context) {
        // A relative path would have another meaning at the next start.
        let path = std::path::absolute(&path).unwrap_or(path);
        (self.remembered, self.is_new, self.failure) = (None, true, None);
        self.read(path, ctx);
    }

    /// Returns to the built-in model; a file that is being read is discarded.
    pub(super) fn use_built_in(&mut self) {
        *self = Self { is_unsaved: true, ..Self::default() };
    }

    /// Begins to read the model of the settings.
    pub(super) fn begin(&mut self, ctx: &Context) {
        if let Some(path) = self.remembered.take() {
            self.is_new = false;
            self.read(path, ctx);
        }
    }

    /// Takes over a file that was read; returns whether the model has changed.
    pub(super) fn collect(&mut self, ctx: &Context) -> bool {
        let Some(done) = self.reading.collect(ctx) else { return false };
        match done {
            Ok((path, Ok(model))) => {
                self.is_unsaved |= self.is_new;
                (self.own, self.path, self.failure) = (Some(Arc::new(model)), Some(path), None);
                true
            }
            Ok((_, Err(reason))) => {
                self.failure = Some(reason);
                false
            }
            Err(JobPanicked) => {
                self.failure = Some(strings::BROKE_OFF.to_owned());
                false
            }
        }
    }

    /// Puts a new choice of the user into the settings.
    pub(super) fn store(&mut self, setting: &mut Option<PathBuf>) {
        if std::mem::take(&mut self.is_unsaved) {
            setting.clone_from(&self.path);
        }
    }

    fn read(&mut self, path: PathBuf, ctx: &Context) {
        self.reading.ask(ctx, move || {
            let model = load_quality_model(Some(&path)).map_err(|error| one_line(&error));
            (path, model)
        });
    }
}

#[cfg(test)]
mod tests {
    use super::ModelChoice;
    use shagreen_formats::quality_model::{built_in_quality_model, write_quality_model};
    use std::time::{Duration, Instant};

    fn wait(choice: &mut ModelChoice, ctx: &egui::Context) -> bool {
        let start = Instant::now();
        let mut has_changed = false;
        while choice.is_reading() {
            has_changed |= choice.collect(ctx);
            assert!(start.elapsed() < Duration::from_mins(1), "nothing came");
        }
        has_changed
    }

    #[test]
    fn a_model_is_opened_kept_and_replaced_by_nothing_foreign() {
        let (ctx, folder) = (egui::Context::default(), tempfile::tempdir().unwrap());
        let path = folder.path().join("lab.json");
        std::fs::write(&path, write_quality_model(&built_in_quality_model().unwrap())).unwrap();
        let mut choice = ModelChoice::default();
        choice.open(path.clone(), &ctx);
        assert!(choice.is_reading() && wait(&mut choice, &ctx));
        assert_eq!(choice.own().unwrap().name, "lab.json");
        let mut setting = None;
        choice.store(&mut setting);
        assert_eq!(setting, Some(path.clone()));
        let other = folder.path().join("other.json");
        std::fs::write(&other, "{}").unwrap();
        choice.open(other, &ctx);
        assert!(!wait(&mut choice, &ctx));
        let failure = choice.failure().unwrap();
        assert!(
            failure.starts_with("this is not a quality model") && failure.ends_with("other.json"),
            "{failure}"
        );
        choice.store(&mut setting);
        assert_eq!((choice.own().unwrap().name.as_str(), &setting), ("lab.json", &Some(path.clone())));
        choice.use_built_in();
        choice.store(&mut setting);
        assert!(choice.own().is_none() && choice.failure().is_none() && setting.is_none());
        // The model of the settings is read when it is needed, and need not be kept again.
        choice.remember(Some(path));
        assert!(!choice.is_reading());
        choice.begin(&ctx);
        assert!(wait(&mut choice, &ctx) && choice.own().is_some());
        choice.store(&mut setting);
        assert_eq!(setting, None);
    }
}
