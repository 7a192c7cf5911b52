//! Fits of the textures of a batch to their recordings.

use std::sync::Arc;

use shagreen_core::units::Hertz;

use crate::sheets::import::batch::{Batch, Content, File};
use crate::sheets::import::draft::{Draft, FitState};
use crate::sheets::import::worker::{Drawn, Request};

impl Batch {
    /// Fits a texture again at the rate of the space if its automatic rate is too high for a position.
    pub(super) fn lower_rate(&mut self, draft: u64) {
        let Some(rate_hz) = self.space_rate_hz else { return };
        let is_meant = |other: &Draft| other.id == draft && other.exceeds(rate_hz);
        if let Some(index) = self.drafts.iter().position(is_meant) {
            self.fit_at(index, Some(rate_hz));
        }
    }

    /// Fits the texture of a file again.
    pub fn fit_with(&mut self, file: u64) {
        if let Some(draft) = self.drafts.iter().position(|draft| draft.files.contains(&file)) {
            self.fit(draft);
        }
    }

    pub(super) fn fit(&mut self, index: usize) {
        self.fit_at(index, None);
    }

    /// Fits a texture with its options; `lowered_hz` takes the place of an automatic rate.
    fn fit_at(&mut self, index: usize, lowered_hz: Option<f64>) {
        let recordings: Vec<Arc<Drawn>> =
            self.drawn_of(&self.drafts[index]).map(|(_, d)| Arc::clone(d)).collect();
        let draft = &mut self.drafts[index];
        draft.generation += 1;
        if recordings.is_empty() {
            draft.fit = FitState::Nothing;
            return;
        }
        draft.fit = FitState::Working;
        draft.is_lowered = lowered_hz.is_some();
        let mut options = draft.options.clone();
        options.rate = options.rate.or(lowered_hz.map(Hertz));
        let (draft, generation) = (draft.id, draft.generation);
        self.worker.ask(Request::Fit { draft, generation, recordings, options });
    }

    /// Readable recordings of a texture, in the order that the segments of its fit refer to.
    pub fn drawn_of<'a>(&'a self, draft: &'a Draft) -> impl Iterator<Item = (&'a File, &'a Arc<Drawn>)> + 'a {
        let in_draft = self.files.iter().filter(|file| draft.files.contains(&file.id));
        in_draft.filter_map(|file| match &file.content {
            Content::Recording(state) => match &state.outcome.recording {
                Some(Ok(drawn)) => Some((file, drawn)),
                _ => None,
            },
            _ => None,
        })
    }
}
