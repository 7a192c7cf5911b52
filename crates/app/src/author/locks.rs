//! Pinned textures, through which the field passes exactly: their mark, button and menu entry.

use egui::{Color32, Painter, Pos2, Rect, Role, Sense, Shape, Stroke, Ui, WidgetInfo, vec2};
use shagreen_formats::library::TextureEntry;

use crate::command::Command;
use crate::look::theme::tokens;
use crate::panel::Panel;
use crate::state::edit::Edit;
use crate::strings;

/// Draws a padlock at `center`; if not pinned, the padlock is open with its shackle lifted.
pub(crate) fn lock_mark(painter: &Painter, center: Pos2, is_locked: bool, color: Color32) {
    let body = Rect::from_center_size(center + vec2(0.0, 2.0), vec2(8.0, 6.0));
    let lift = if is_locked { 0.0 } else { -1.5 };
    let (left, right, top) = (center.x - 2.5, center.x + 2.5, body.top() - 2.5 + lift);
    let arch = (0..=8).map(|i| {
        let angle = std::f32::consts::PI * (1.0 + i as f32 / 8.0);
        egui::pos2(center.x + 2.5 * angle.cos(), top + 2.5 * angle.sin())
    });
    let mut shackle = vec![egui::pos2(left, body.top())];
    shackle.extend(arch);
    // The shackle of an open padlock ends above the body.
    shackle.push(egui::pos2(right, if is_locked { body.top() } else { top + 1.0 }));
    painter.add(Shape::line(shackle, Stroke::new(1.5, color)));
    if is_locked {
        painter.rect_filled(body, 1.5, color);
    } else {
        painter.rect_stroke(body, 1.5, Stroke::new(1.2, color), egui::StrokeKind::Inside);
    }
}

/// Draws the button in `area` that pins or unpins a texture.
pub(crate) fn lock_button(ui: &Ui, panel: &Panel<'_>, texture: usize, area: Rect) -> Option<Command> {
    let t = tokens(ui.ctx());
    let is_locked = panel.is_locked(texture);
    let name = strings::lock(&panel.session.textures()[texture].name, !is_locked);
    let response = ui.interact(area, ui.scope_id().with(("lock", texture)), Sense::click());
    response.widget_info(|| WidgetInfo::selected(Role::Button, true, is_locked, &name));
    if response.hovered() || response.has_focus() {
        ui.painter().rect_filled(area, 4.0, t.control_hovered);
    }
    let color = if is_locked || response.hovered() { t.text } else { t.text_weak };
    lock_mark(ui.painter(), area.center(), is_locked, color);
    let is_clicked = response.clicked();
    response.on_hover_text(format!("{name}\n{}", strings::LOCK_HELP));
    is_clicked.then(|| edit(panel, texture))
}

/// Whether a texture can be pinned or unpinned: it has a position or is pinned, and the interpolation mode uses a field.
pub(crate) fn can_lock(panel: &Panel<'_>, texture: usize) -> bool {
    panel.can_lock() && (panel.session.position(texture).is_some() || panel.is_locked(texture))
}

/// Draws the menu entry that pins or unpins a texture.
pub(crate) fn lock_entry(ui: &mut Ui, panel: &Panel<'_>, texture: usize) -> Option<Command> {
    let name = strings::lock(&panel.session.textures()[texture].name, !panel.is_locked(texture));
    let entry = ui.button(name).on_hover_text(strings::LOCK_HELP);
    entry.clicked().then(|| edit(panel, texture))
}

fn edit(panel: &Panel<'_>, texture: usize) -> Command {
    let TextureEntry { id, name, .. } = &panel.session.textures()[texture];
    let is_locked = !panel.is_locked(texture);
    Command::Edit(Edit::Lock { id: id.clone(), name: name.clone(), is_locked })
}
