//! Solo button of a contributing texture.

use egui::{Align2, FontId, Rect, Role, Sense, Stroke, StrokeKind, Ui, WidgetInfo};

use crate::command::Command;
use crate::look::theme::tokens;
use crate::panel::Panel;
use crate::state::edit::Edit;
use crate::strings;

/// Draws the button in `area` that plays one texture alone or returns to the interpolated texture. Its letter S is that
/// of mixing consoles.
pub(crate) fn solo_button(ui: &Ui, panel: &Panel<'_>, texture: usize, area: Rect) -> Option<Command> {
    let t = tokens(ui.ctx());
    let entry = &panel.session.textures()[texture];
    let is_alone = panel.solo() == Some(texture);
    let name = strings::solo(&entry.name);
    let response = ui.interact(area, ui.scope_id().with(("solo", texture)), Sense::click());
    response.widget_info(|| WidgetInfo::selected(Role::Button, true, is_alone, &name));
    let is_hot = response.hovered() || response.has_focus();
    let (fill, color) = match (is_alone, is_hot) {
        (true, _) => (t.chosen, t.on_chosen),
        (false, true) => (t.control_hovered, t.text),
        (false, false) => (t.raised, t.text_weak),
    };
    let mark = area.shrink(2.5);
    ui.painter().rect(mark, 4.0, fill, Stroke::new(1.0, color), StrokeKind::Inside);
    ui.painter().text(mark.center(), Align2::CENTER_CENTER, strings::SOLO, FontId::proportional(11.0), color);
    let is_clicked = response.clicked();
    response.on_hover_text(format!("{name}\n{}", strings::SOLO_HELP));
    is_clicked.then(|| Command::Edit(Edit::Solo((!is_alone).then(|| entry.id.clone()))))
}
