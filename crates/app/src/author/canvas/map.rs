//! Map behind the canvas: choice of its quantity, image and color scale.

use egui::{Color32, ComboBox, FontId, Mesh, Rect, Role, Sense, TextureId, Ui, WidgetInfo, pos2, vec2};
use shagreen_core::space::heat_map::Quantity;

use crate::command::Command;
use crate::look::axes::Axes;
use crate::look::theme::{Tokens, map_color};
use crate::strings::map as strings;

/// Opacity of the map.
const OPACITY: f32 = 0.62;
/// Size of the color scale, in points.
const SCALE: egui::Vec2 = vec2(80.0, 8.0);
/// Number of color steps of the scale.
const STEPS: usize = 32;

/// Map behind the canvas, shown or still being computed.
#[derive(Clone, Copy, Debug)]
pub struct ShownMap {
    /// Quantity that the map shows.
    pub quantity: Quantity,
    /// Image of the map; `None` until it is computed.
    pub picture: Option<TextureId>,
    /// Lowest and highest value, in the unit of the quantity.
    pub range: Option<(f64, f64)>,
}

/// Draws the choice of the quantity; returns the requested command.
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

/// Draws the map over the square of the whole space.
pub(super) fn map_ui(ui: &Ui, axes: Axes, map: &ShownMap) {
    let Some(picture) = map.picture else { return };
    let mut mesh = Mesh::with_texture(picture);
    let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
    mesh.add_rect_with_uv(axes.whole(), whole, Color32::WHITE.gamma_multiply(OPACITY));
    ui.painter_at(axes.rect).add(mesh);
}

/// Draws the color scale between the lowest and the highest value.
pub(super) fn scale_ui(ui: &mut Ui, map: &ShownMap, t: &Tokens) {
    let (low, high) = match map.range {
        Some((low, high)) => (strings::value(map.quantity, low), strings::value(map.quantity, high)),
        None => (strings::WAITING.to_owned(), String::new()),
    };
    let font = FontId::proportional(11.5);
    let [low_text, high_text] =
        [&low, &high].map(|text| ui.painter().layout_no_wrap(text.clone(), font.clone(), t.text_weak));
    let width = low_text.size().x + SCALE.x + high_text.size().x + 10.0;
    let (area, response) = ui.allocate_exact_size(vec2(width, ui.spacing().interact_size.y), Sense::hover());
    let title = strings::name(Some(map.quantity));
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, strings::scale(title, &low, &high)));
    let line = area.center().y;
    let left = area.left() + low_text.size().x + 5.0;
    ui.painter().galley(pos2(area.left(), line - 0.5 * low_text.size().y), low_text, t.text_weak);
    let step = SCALE.x / STEPS as f32;
    for i in 0..STEPS {
        let corner = pos2(left + i as f32 * step, line - 0.5 * SCALE.y);
        let part = Rect::from_min_size(corner, vec2(step + 0.5, SCALE.y));
        ui.painter().rect_filled(part, 0.0, map_color((i as f32 + 0.5) / STEPS as f32));
    }
    let corner = pos2(left + SCALE.x + 5.0, line - 0.5 * high_text.size().y);
    ui.painter().galley(corner, high_text, t.text_weak);
    response.on_hover_text(strings::help(Some(map.quantity)));
}
