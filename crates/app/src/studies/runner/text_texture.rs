//! Texture of a question of a questionnaire: made from a text at the position that is estimated from it.

use std::sync::Arc;

use egui::Context;
use shagreen_core::people::study::plan::ShownControls;
use shagreen_core::space::SpacePoint;
use shagreen_formats::picture::Picture;
use shagreen_formats::project::{AuthoredTexture, Project};

use crate::author::prompt::{PositionEstimate, Prompts, WordsEstimate};
use crate::session::Session;

/// Text of a question and the texture that is made from it.
pub(super) struct TextTexture {
    text: String,
    shown: ShownControls,
    state: TextState,
    /// Texture at the position to which the participant has moved it.
    authored: Option<Arc<AuthoredTexture>>,
}

enum TextState {
    /// The participant writes the text.
    Writing,
    /// The texture is being made.
    Making(WordsEstimate),
    Made(Arc<Picture>),
    Failed(String),
}

impl TextTexture {
    /// Question about a text that the participant still has to write.
    pub(super) fn to_write(shown: ShownControls) -> Self {
        Self { text: String::new(), shown, state: TextState::Writing, authored: None }
    }

    /// Question about a text that is known; its texture is not made yet.
    pub(super) fn of_text(text: String, shown: ShownControls) -> Self {
        Self { text, ..Self::to_write(shown) }
    }

    /// The text.
    pub(super) fn text(&self) -> &str {
        &self.text
    }

    /// What the screen shows beside what is felt.
    pub(super) fn shown(&self) -> ShownControls {
        self.shown
    }

    /// Whether the participant still writes the text.
    pub(super) fn is_writing(&self) -> bool {
        matches!(self.state, TextState::Writing | TextState::Failed(_))
    }

    /// Whether the texture is being made.
    pub(super) fn is_making(&self) -> bool {
        matches!(self.state, TextState::Making(_))
    }

    /// Why the texture could not be made.
    pub(super) fn failure(&self) -> Option<&str> {
        if let TextState::Failed(reason) = &self.state { Some(reason) } else { None }
    }

    /// Picture of the texture, once it is made.
    pub(super) fn picture(&self) -> Option<&Arc<Picture>> {
        if let TextState::Made(picture) = &self.state { Some(picture) } else { None }
    }

    /// The texture, once it is made.
    pub(super) fn authored(&self) -> Option<&Arc<AuthoredTexture>> {
        self.authored.as_ref()
    }

    /// Changes the text while it is written.
    pub(super) fn write(&mut self, text: String) {
        if self.is_writing() {
            self.text = text;
        }
    }

    /// Begins to make the texture of the text. The same text and seed give the same texture.
    pub(super) fn describe(&mut self, prompts: &Prompts, session: &Session, seed: u64, ctx: &Context) {
        if self.is_writing() && !self.text.trim().is_empty() {
            let job = prompts.estimate(self.text.trim().to_owned(), seed, session.axes(), ctx);
            self.state = TextState::Making(job);
        }
    }

    /// Takes in the texture once it is made, once a frame.
    pub(super) fn follow(&mut self, project: &Project, session: &Session) {
        let TextState::Making(job) = &mut self.state else { return };
        match job.collect() {
            None => {}
            Some(Ok(estimate)) => {
                let estimate = estimate.in_space(session);
                self.authored = Some(Arc::new(authored(project, &estimate)));
                self.state = TextState::Made(estimate.picture);
            }
            Some(Err(reason)) => self.state = TextState::Failed(reason),
        }
    }

    /// Moves the texture along an axis to a coordinate from 0 to 100, if the participant sees its sliders.
    pub(super) fn go_to(&mut self, axis: usize, value: f64) {
        if let Some(before) = &self.authored
            && self.shown == ShownControls::PictureAndSliders
        {
            let at = before.at.with(axis, value.clamp(0.0, 100.0));
            self.authored = Some(Arc::new(AuthoredTexture { at, ..AuthoredTexture::clone(before) }));
        }
    }

    /// Position of the texture, once it is made.
    pub(super) fn at(&self) -> Option<SpacePoint> {
        self.authored.as_ref().map(|authored| authored.at)
    }
}

/// The texture at an estimated position, with the options of new textures of the project.
fn authored(project: &Project, estimate: &PositionEstimate) -> AuthoredTexture {
    AuthoredTexture {
        at: estimate.at(),
        blend: project.blend_of_new(),
        ..AuthoredTexture::new(0, &estimate.name)
    }
}
