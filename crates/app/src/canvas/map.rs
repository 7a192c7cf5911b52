//! The map behind the canvas: its choice, its picture and its scale.

use egui::{
    Align2, Color32, ComboBox, FontId, Mesh, Rect, Role, Sense, TextureId, Ui, WidgetInfo, pos2, vec2,
};
use shagreen_core::heat_map::Quantity;

use crate::axes::Axes;
use crate::command::Command;
use crate::strings::map as strings;
use crate::theme::{Tokens, map_color};

/// How much of the map shows.
const OPACITY: f32 = 0.62;
/// Size of the scale, in points.
const SCALE: egui::Vec2 = vec2(120.0, 8.0);
/// Steps of color in the scale.
const STEPS: usize = 32;

/// A map that is shown, or being worked out.
#[derive(Clone, Copy, Debug)]
pub struct ShownMap {
    /// What it shows.
    pub quantity: Quantity,
    /// Its picture, once there is one.
    pub picture: Option<TextureId>,
    /// Its lowest and highest value.
    pub range: Option<(f64, f64)>,
}

/// The choice of what is shown behind the canvas.
pub(super) fn map_choice_ui(ui: &mut Ui, map: Option<&ShownMap>) -> Option<Command> {
    let shown = map.map(|map| map.quantity);
    let mut chosen = None;
    let combo = ComboBox::from_id_salt("map").width(104.0).truncate().selected_text(strings::name(shown));
    let response = combo.show_ui(ui, |ui| {
        for each in std::iter::once(None).chain(Quantity::ALL.map(Some)) {
            let entry = ui.selectable_label(shown == each, strings::name(each));
            if entry.on_hover_text(strings::help(each)).clicked() {
                chosen = Some(Command::ShowMap(each));
            }
        }
    });
    response.response.accessible_name(strings::MAP).on_hover_text(strings::help(shown));
    chosen
}

/// Draws the map over the square of the space.
pub(super) fn map_ui(ui: &Ui, axes: Axes, map: &ShownMap) {
    let Some(picture) = map.picture else { return };
    let mut mesh = Mesh::with_texture(picture);
    let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
    mesh.add_rect_with_uv(axes.whole(), whole, Color32::WHITE.gamma_multiply(OPACITY));
    ui.painter_at(axes.rect).add(mesh);
}

/// Draws what the colors of the map mean.
pub(super) fn scale_ui(ui: &Ui, axes: Axes, map: &ShownMap, t: &Tokens) {
    let corner = axes.rect.right_bottom() - vec2(6.0, 6.0);
    let bar = Rect::from_min_size(corner - SCALE, SCALE);
    let font = FontId::proportional(11.5);
    let (low, high) = match map.range {
        Some((low, high)) => (strings::value(map.quantity, low), strings::value(map.quantity, high)),
        None => (strings::WAITING.to_owned(), String::new()),
    };
    let title = strings::name(Some(map.quantity));
    let text = ui.painter().layout_no_wrap(title.to_owned(), font.clone(), t.text);
    let back = Rect::from_min_max(bar.min - vec2(6.0, 2.0 * text.size().y + 6.0), bar.max + vec2(4.0, 4.0));
    let response = ui.interact(back, ui.scope_id().with("scale of the map"), Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, strings::scale(title, &low, &high)));
    ui.painter().rect_filled(back, f32::from(crate::theme::RADIUS), t.background.gamma_multiply(0.85));
    let top = bar.top() - 2.0;
    ui.painter().galley(pos2(bar.left(), back.top() + 2.0), text, t.text);
    ui.painter().text(pos2(bar.left(), top), Align2::LEFT_BOTTOM, low, font.clone(), t.text_weak);
    ui.painter().text(pos2(bar.right(), top), Align2::RIGHT_BOTTOM, high, font, t.text_weak);
    let step = bar.width() / STEPS as f32;
    for i in 0..STEPS {
        let part = Rect::from_min_size(bar.min + vec2(i as f32 * step, 0.0), vec2(step + 0.5, bar.height()));
        ui.painter().rect_filled(part, 0.0, map_color((i as f32 + 0.5) / STEPS as f32));
    }
    response.on_hover_text(strings::help(Some(map.quantity)));
}
