//! Hints that the user has learned, which the settings remember.

use egui::Context;
use shagreen_formats::settings::Settings;

use super::Window;
use crate::look::tooltips::{Hint, is_learned, learn};

/// Marks the hints that the settings list as learned.
pub(super) fn recall_hints(settings: &Settings, ctx: &Context) {
    for hint in Hint::ALL {
        if settings.learned_hints.iter().any(|id| id == hint.id()) {
            learn(ctx, hint);
        }
    }
}

impl Window {
    /// Adds the hints that were learned in this frame to the settings.
    pub(super) fn remember_hints(&mut self, ctx: &Context) {
        let known = &mut self.files.settings.learned_hints;
        for hint in Hint::ALL {
            if is_learned(ctx, hint) && !known.iter().any(|id| id == hint.id()) {
                known.push(hint.id().to_owned());
            }
        }
    }
}
