//! Row of controls at the top of the canvas.

use egui::{Button, Rect, Shape, Ui, pos2, vec2};
use shagreen_core::space::texture_path::UserPath;

use super::BAR_TOP;
use crate::author::canvas::map::{ShownMap, map_choice_ui, scale_ui};
use crate::author::canvas::path_tool::{PathTool, path_settings_ui};
use crate::author::canvas::view::view_buttons;
use crate::command::Command;
use crate::look::axes::{Axes, View};
use crate::look::theme::{RADIUS, Tokens};
use crate::look::together::together_ui;
use crate::panel::Panel;
use crate::strings::path as strings;

/// Result of drawing the controls.
pub(super) struct BarOutcome {
    pub(super) commands: Vec<Command>,
    /// Requested view.
    pub(super) view: Option<View>,
    /// Area of the rows.
    pub(super) area: Rect,
}

/// Draws the controls of the map, the view and the path, in rows no wider than `width` points.
#[expect(clippy::too_many_arguments, reason = "what a row of controls looks at")]
pub(super) fn tool_bar(
    ui: &mut Ui,
    axes: Axes,
    outer: Rect,
    width: f32,
    panel: &Panel<'_>,
    tool: &PathTool,
    map: Option<&ShownMap>,
    t: &Tokens,
) -> BarOutcome {
    let mut commands = Vec::new();
    let mut view = None;
    let area = Rect::from_min_size(pos2(outer.left() + 32.0, outer.top() + BAR_TOP), vec2(width, 24.0));
    let mut row = ui.new_child(egui::UiBuilder::new().max_rect(area));
    let shape = row.painter().add(Shape::Noop);
    row.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(4.0, 3.0);
        ui.spacing_mut().button_padding = vec2(7.0, 2.0);
        ui.spacing_mut().interact_size.y = 22.0;
        commands.extend(map_choice_ui(ui, map));
        if let Some(map) = map {
            scale_ui(ui, map, t);
        }
        view = together_ui(ui, "view", |ui| view_buttons(ui, axes, panel));
        let button = Button::new(strings::PATH).selected(tool.is_on);
        if ui.add(button).on_hover_text(strings::PATH_HELP).clicked() {
            commands.push(Command::TogglePathTool);
        }
        match &panel.project.texture().path {
            Some(path) => commands.extend(path_settings_ui(ui, panel, path)),
            None if tool.is_on => {
                // They have their place before the first point, so that the canvas does not move while points are placed.
                ui.disable();
                path_settings_ui(ui, panel, &UserPath::default());
            }
            None => {}
        }
    });
    let back = row.min_rect();
    row.painter().set(shape, Shape::rect_filled(back, f32::from(RADIUS), t.background.gamma_multiply(0.85)));
    BarOutcome { commands, view, area: back }
}
