//! Pins that have no effect, because their textures have no position in the space.

use egui::{Label, RichText, Ui};

use crate::look::theme::tokens;
use crate::panel::Panel;
use crate::strings::textures as words;

/// Draws a line that names the textures that are pinned without effect; nothing without any.
pub(crate) fn lost_pins_ui(ui: &mut Ui, panel: &Panel<'_>) {
    let blend = panel.session.blend_in_space(&panel.inspected().blend);
    if !blend.can_lock() {
        return;
    }
    let textures = panel.session.textures();
    let pinned = blend.locked.iter().filter_map(|id| panel.session.index_of(id));
    let lost = pinned.filter(|texture| panel.session.position(*texture).is_none());
    let names: Vec<&str> = lost.map(|texture| textures[texture].name.as_str()).collect();
    if !names.is_empty() {
        let line = RichText::new(words::lost_pins(&names)).small().color(tokens(ui.ctx()).warning);
        ui.add(Label::new(line).wrap().selectable(false)).on_hover_text(words::LOST_PIN_HELP);
    }
}
