//! Icons of quiet buttons, from the icon font of `egui_material_icons`.
//!
//! An icon says nothing to a screen reader, so every such button also needs an accessible name and a tooltip.

use egui::{Button, Context};
use egui_material_icons::MaterialIcon;
use egui_material_icons::icons::ICON_CLOSE;
pub(crate) use egui_material_icons::icons::{
    ICON_ARROW_DOWNWARD, ICON_ARROW_UPWARD, ICON_ASSIGNMENT, ICON_DARK_MODE, ICON_FIT_SCREEN,
    ICON_LIGHT_MODE, ICON_PLAY_ARROW, ICON_REDO, ICON_RESTART_ALT, ICON_STOP, ICON_TUNE, ICON_UNDO,
    ICON_VOLUME_OFF, ICON_VOLUME_UP, ICON_ZOOM_IN, ICON_ZOOM_OUT,
};

use crate::look::theme::tokens;

/// Size of an icon, in points: as high as a line of text with its ascenders and descenders.
const ICON_SIZE: f32 = 17.0;

/// Adds the icon font to a context.
pub(crate) fn install(ctx: &Context) {
    egui_material_icons::initialize(ctx);
}

/// A button that shows an icon.
pub(crate) fn icon_button(icon: MaterialIcon) -> Button<'static> {
    Button::new(icon.rich_text().size(ICON_SIZE))
}

/// A button without a frame that removes or closes what it stands on.
pub(crate) fn close_button(ctx: &Context) -> Button<'static> {
    Button::new(ICON_CLOSE.rich_text().size(ICON_SIZE).color(tokens(ctx).text_weak)).frame(false)
}
