//! Shape of an authored texture: seven sliders, each with a button that makes it neutral. A slider that has nothing to act
//! on is disabled and says why.

use egui::{Align, Button, CollapsingHeader, Label, Layout, Slider, SliderClamping, Ui, vec2};
use shagreen_core::texture::TextureModel;
use shagreen_core::texture::shape::{Shape, ShapeControl};

use crate::command::Command;
use crate::look::icons::{ICON_RESTART_ALT, icon_button};
use crate::look::notice::show_notice;
use crate::look::theme::GAP;
use crate::panel::Panel;
use crate::state::edit::Edit;
use crate::strings::shape as words;

/// Width of the names of the controls, in points.
const NAME_WIDTH: f32 = 80.0;
/// Width that the widest number with its unit needs, in points.
const NUMBER_WIDTH: f32 = 82.0;
/// Width of a button that makes a control neutral, in points.
const RESET_WIDTH: f32 = 22.0;
/// Width of a slider in a narrow panel, in points.
const LEAST_SLIDER_WIDTH: f32 = 40.0;

/// Draws the group, which is closed at first; returns the requested command.
pub(crate) fn shape_ui(ui: &mut Ui, panel: &Panel<'_>) -> Option<Command> {
    let shape = panel.inspected().shape;
    let header = CollapsingHeader::new(words::heading(shape.changed().count())).id_salt("shape");
    let shown = header.show_unindented(ui, |ui| controls_ui(ui, panel, &shape));
    shown.header_response.on_hover_text(words::HELP);
    shown.body_returned.flatten().map(Command::Edit)
}

fn controls_ui(ui: &mut Ui, panel: &Panel<'_>, shape: &Shape) -> Option<Edit> {
    let mut asked = None;
    for control in ShapeControl::ALL {
        let is_useful = acts(panel, control);
        asked = control_ui(ui, control, shape.get(control), is_useful).or(asked);
    }
    let reset = ui.add_enabled(!shape.is_neutral(), Button::new(words::RESET_ALL));
    if reset.on_hover_text(words::RESET_ALL_HELP).clicked() {
        asked = Some(Edit::ResetShape);
    }
    asked
}

/// Whether a control has something to act on in the texture at the point. The textures that contribute are asked, because
/// the interpolated one has the shape already: at a depth of 0, its relief is gone.
fn acts(panel: &Panel<'_>, control: ShapeControl) -> bool {
    let parents = panel.session.parents();
    if parents.is_empty() || panel.solo().is_some() {
        // The textures at the point are not known yet, or another one plays.
        return true;
    }
    let models = parents.iter().filter_map(|(texture, _)| panel.session.textures().get(*texture));
    models.map(|entry| &entry.model).any(|model| acts_on(control, model))
}

/// Whether a control has something to act on in one texture.
fn acts_on(control: ShapeControl, model: &TextureModel) -> bool {
    let has_heights = || model.relief().is_some() || model.height_map().is_some();
    match control {
        ShapeControl::Level | ShapeControl::Grain | ShapeControl::Brightness => true,
        ShapeControl::Softness => model.tap().is_some(),
        ShapeControl::Friction => model.friction().is_some(),
        ShapeControl::Relief => has_heights(),
        ShapeControl::Direction => model.along().is_some() || has_heights(),
    }
}

/// Draws the name, the slider, the number and the reset button of a control in one row. Without something to act on, only
/// the button works.
fn control_ui(ui: &mut Ui, control: ShapeControl, before: f64, is_useful: bool) -> Option<Edit> {
    let (mut value, mut is_reset) = (before, false);
    let row = vec2(ui.available_width(), ui.spacing().interact_size.y);
    ui.allocate_ui_with_layout(row, Layout::left_to_right(Align::Center), |ui| {
        ui.spacing_mut().button_padding.x = 4.0;
        let name = vec2(NAME_WIDTH, row.y);
        ui.allocate_ui_with_layout(name, Layout::left_to_right(Align::Center), |ui| {
            ui.set_min_width(NAME_WIDTH);
            let name = ui.add_enabled(is_useful, Label::new(words::name(control)).selectable(false));
            name.on_hover_text(words::help(control)).on_disabled_hover_text(words::nothing(control));
        });
        let rest = NUMBER_WIDTH + RESET_WIDTH + 2.0 * GAP;
        ui.spacing_mut().slider_width = (ui.available_width() - rest).max(LEAST_SLIDER_WIDTH);
        let slider = ui.add_enabled(is_useful, slider(control, &mut value));
        let slider = slider.accessible_name(words::slider(control));
        slider.on_hover_text(words::help(control)).on_disabled_hover_text(words::nothing(control));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let button = icon_button(ICON_RESTART_ALT).small().frame(false);
            let reset = ui.add_enabled(before != control.neutral(), button);
            let reset = reset.accessible_name(words::reset(control));
            is_reset = reset.on_hover_text(words::reset(control)).clicked();
        });
    });
    if is_reset {
        return Some(Edit::SetShape(control, control.neutral()));
    }
    let limits = control.limits();
    if is_useful && value != before && !limits.contains(&value) {
        show_notice(ui.ctx(), words::limited(control));
        value = value.clamp(*limits.start(), *limits.end());
    }
    // A number field that loses the keyboard focus reads its rounded text again, which is no change by the user. A screen
    // reader may set a slider that is not enabled.
    let is_own_text = words::number(control, before).parse() == Ok(value);
    (is_useful && value != before && !is_own_text).then_some(Edit::SetShape(control, value))
}

fn slider(control: ShapeControl, value: &mut f64) -> Slider<'_> {
    // A factor has equal steps for equal ratios, unless it can be zero.
    let is_logarithmic = matches!(control, ShapeControl::Grain | ShapeControl::Softness);
    // The number is not rounded: a slider that rounds would edit the project by itself.
    let slider = Slider::new(value, control.limits())
        // A number that is out of range is said to be so.
        .clamping(SliderClamping::Never)
        .logarithmic(is_logarithmic)
        .smart_aim(false)
        .custom_formatter(move |value, _| words::number(control, value));
    match (words::prefix(control), words::suffix(control)) {
        ("", "") => slider,
        (prefix, "") => slider.prefix(prefix),
        (_, suffix) => slider.suffix(suffix),
    }
}
