//! Checkbox in a menu. The style of menus has no outlines, without which an unchecked box could hardly be seen.

use egui::{Checkbox, Response, Stroke, Ui};

use crate::look::theme::tokens;

pub(crate) fn menu_checkbox(ui: &mut Ui, is_checked: &mut bool, text: &str, is_enabled: bool) -> Response {
    let t = tokens(ui.ctx());
    let checkbox = |ui: &mut Ui| {
        let widgets = &mut ui.visuals_mut().widgets;
        widgets.inactive.bg_stroke = Stroke::new(1.0, t.control_line);
        widgets.hovered.bg_stroke = Stroke::new(1.0, t.text_weak);
        widgets.active.bg_stroke = Stroke::new(1.0, t.accent);
        ui.add_enabled(is_enabled, Checkbox::new(is_checked, text))
    };
    ui.scope(checkbox).inner
}

#[cfg(test)]
mod tests {
    use egui::{Context, RawInput, Shape, Ui};

    use super::menu_checkbox;
    use crate::look::theme::{install, tokens};

    /// Outlines that a box of a menu draws.
    fn n_outlines(draw: impl Fn(&mut Ui)) -> usize {
        let ctx = Context::default();
        install(&ctx);
        let mut output = ctx.run_ui(RawInput::default(), |ui| {
            egui::containers::menu::menu_style(ui.style_mut());
            draw(ui);
        });
        output.textures_delta.clear();
        let line = tokens(&ctx).control_line;
        let is_outline = |shape: &Shape| matches!(shape, Shape::Rect(rect) if rect.stroke.color == line && rect.stroke.width > 0.0);
        output.shapes.iter().filter(|clipped| is_outline(&clipped.shape)).count()
    }

    #[test]
    fn an_unchecked_box_of_a_menu_has_an_outline() {
        assert_eq!(n_outlines(|ui| drop(menu_checkbox(ui, &mut false, "box", true))), 1);
        // A plain one has none.
        assert_eq!(n_outlines(|ui| drop(ui.checkbox(&mut false, "box"))), 0);
    }
}
