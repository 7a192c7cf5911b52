//! Message of a canvas without textures, with a button that chooses other axes if these are the reason.

use egui::{Align, Button, Label, Layout, Rect, RichText, Ui, UiBuilder, vec2};

use crate::command::Command;
use crate::command::axes::AxesCommand;
use crate::look::axes::Axes;
use crate::look::theme::{GAP, Tokens};
use crate::panel::Panel;
use crate::strings::{self, axes as words};

/// Largest width and height of the message with its button, in points.
const AREA: [f32; 2] = [460.0, 90.0];
/// Distance of its middle above that of the space, where the point of a new project lies, in points.
const ABOVE: f32 = 70.0;
/// Font size of the message, in points.
const SIZE: f32 = 15.0;

/// Says why the canvas shows no texture, if it shows none; returns the requested command.
pub(super) fn no_sites_ui(ui: &mut Ui, axes: Axes, panel: &Panel<'_>, t: &Tokens) -> Option<Command> {
    if !panel.session.space().sites().is_empty() {
        return None;
    }
    let missing = panel.session.missing_axes();
    let (message, is_choice) = if panel.session.textures().is_empty() {
        (strings::NO_TEXTURES.to_owned(), false)
    } else if !missing.is_empty() {
        (words::missing(&missing), true)
    } else if panel.project.axes.is_some() {
        (words::NONE_HAS_ALL.to_owned(), true)
    } else {
        (strings::NO_PLACES.to_owned(), false)
    };
    let size = vec2(AREA[0].min(axes.rect.width()), AREA[1]);
    let area = Rect::from_center_size(axes.rect.center() - vec2(0.0, ABOVE), size);
    let layout = Layout::top_down(Align::Center);
    let mut inside = ui.new_child(UiBuilder::new().max_rect(area).layout(layout));
    let message = RichText::new(message).size(SIZE).color(t.warning);
    inside.add(Label::new(message).wrap().selectable(false));
    if !is_choice {
        return None;
    }
    inside.add_space(GAP);
    let button = inside.add(Button::new(words::CHOOSE)).on_hover_text(words::BUTTON_HELP);
    button.clicked().then_some(Command::Axes(AxesCommand::Open))
}
