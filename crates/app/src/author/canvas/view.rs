//! Zooming and panning of the canvas.

use egui::{PointerButton, Response, Ui};
use shagreen_core::space::SpacePoint;

use crate::look::axes::{Axes, View};
use crate::look::icons::{ICON_FIT_SCREEN, ICON_ZOOM_IN, ICON_ZOOM_OUT, icon_button};
use crate::panel::Panel;
use crate::strings::view as strings;

/// Zoom factor of one button press.
const STEP: f64 = 1.5;
/// Zoom per point of wheel scrolling, as the natural logarithm of the factor.
const BY_WHEEL: f64 = 0.004;

/// View after the wheel, a pinch, or a drag with the middle or secondary button over the canvas.
pub(super) fn follow_view(ui: &Ui, axes: Axes, background: &Response) -> View {
    let mut view = axes.view;
    let pointer = ui.input(|i| i.pointer.hover_pos()).filter(|pos| axes.rect.contains(*pos));
    if let Some(pointer) = pointer.filter(|_| background.contains_pointer()) {
        let (wheel, pinch) = ui.input(|i| (i.smooth_scroll_delta.y, i.zoom_delta()));
        let factor = (BY_WHEEL * f64::from(wheel)).exp() * f64::from(pinch);
        if factor != 1.0 {
            view = view.zoomed(factor, axes.space_from_ui(pointer));
        }
    }
    let moves = [PointerButton::Middle, PointerButton::Secondary];
    if moves.into_iter().any(|button| background.dragged_by(button)) {
        let (along, up) = axes.space_step_from_ui(background.drag_delta());
        view = view.moved(-along, -up);
    }
    view
}

/// Draws the view buttons; returns the requested view.
pub(super) fn view_buttons(ui: &mut Ui, axes: Axes, panel: &Panel<'_>) -> Option<View> {
    let mut asked = None;
    let middle = axes.space_from_ui(axes.rect.center());
    let is_whole = axes.view == View::default();
    for (icon, name, view, can) in [
        (ICON_ZOOM_OUT, strings::FARTHER, axes.view.zoomed(1.0 / STEP, middle), !is_whole),
        (ICON_ZOOM_IN, strings::NEARER, axes.view.zoomed(STEP, middle), true),
    ] {
        let button = ui.add_enabled(can, icon_button(icon)).accessible_name(name);
        if button.on_hover_text(format!("{name}\n{}", strings::HELP)).clicked() {
            asked = Some(view);
        }
    }
    let sites: Vec<SpacePoint> = panel.session.placed().map(|(_, at)| at).collect();
    let fit = View::around(&sites);
    // If the view already fits all textures, the button shows the whole space instead.
    let (name, view) =
        if axes.view == fit && !is_whole { (strings::ALL, View::default()) } else { (strings::FIT, fit) };
    let whole = ui.add(icon_button(ICON_FIT_SCREEN)).accessible_name(name);
    if whole.on_hover_text(format!("{name}\n{}", strings::HELP)).clicked() {
        asked = Some(view);
    }
    asked
}

#[cfg(test)]
mod tests {
    use super::STEP;
    use crate::look::axes::View;
    use shagreen_core::space::SpacePoint;

    #[test]
    fn a_step_nearer_and_one_farther_is_none() {
        let middle = SpacePoint::plane(50.0, 50.0);
        let there = View::default().zoomed(STEP, middle).zoomed(1.0 / STEP, middle);
        assert!((there.zoom() - 1.0).abs() < 1e-12);
    }
}
