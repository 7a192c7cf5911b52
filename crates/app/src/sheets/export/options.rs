//! Options of the signals of an export, which the next export takes over.

use egui::{Context, Id, Ui, vec2};

use crate::sheets::export::ExportSheet;
use crate::sheets::export::signal_ui::options_ui;
use crate::state::signal_file::SignalOptions;

impl ExportSheet {
    /// Takes over the options of the last export, as far as this signal has them.
    pub(super) fn recall_options(&mut self, ctx: &Context) {
        if std::mem::replace(&mut self.has_recalled, true) {
            return;
        }
        let Ok(signal) = &self.audible.signal else { return };
        let last: Option<SignalOptions> = ctx.data(|data| data.get_temp(last_options()));
        if let Some(last) = last.filter(|last| f64::from(last.rate_hz) >= signal.model_rate.0) {
            self.options = SignalOptions { follows_stroke: false, ..last };
        }
    }

    /// Draws the options of a signal, or leaves their room; returns whether any has changed.
    pub(super) fn options_ui(&mut self, ui: &mut Ui) -> bool {
        let top = ui.cursor().top();
        let is_all = (self.n_authored > 1).then_some(self.is_all);
        let format = self.signal_format();
        let Ok(signal) = &self.audible.signal else { return false };
        let Some(format) = format else {
            ui.allocate_space(vec2(0.0, self.options_height));
            return false;
        };
        let is_changed = options_ui(ui, signal, &mut self.options, format.stores_samples(), is_all);
        let used = ui.min_rect().bottom() - top;
        if format.stores_samples() {
            self.options_height = used;
        } else {
            let left = self.options_height - used - ui.spacing().item_spacing.y;
            ui.allocate_space(vec2(0.0, left.max(0.0)));
        }
        is_changed
    }

    /// Notes the options for the next export.
    pub(super) fn note_options(&self, ctx: &Context) {
        ctx.data_mut(|data| data.insert_temp(last_options(), self.options.clone()));
    }
}

fn last_options() -> Id {
    Id::unique("options of the last exported signal")
}
