//! Calibration of the screen with a bank card, so that lines have their true length.

use egui::{Label, Rect, RichText, Sense, Slider, Ui, vec2};
use shagreen_core::people::study::setup::ScreenScale;
use shagreen_formats::settings::PIXELS_PER_MM;

use super::{Shown, StudiesPage};
use crate::command::Command;
use crate::command::studies::StudiesCommand;
use crate::look::primary::primary_ui;
use crate::look::theme::{GAP, GROUP_GAP, RADIUS, tokens};
use crate::strings::studies as strings;

/// Width and height of a bank card (ISO/IEC 7810, ID-1), in mm.
const CARD_MM: [f32; 2] = [85.6, 53.98];
/// Range of the width of the bar, in points.
const WIDTHS: std::ops::RangeInclusive<f32> = 120.0..=900.0;

/// Width of the bar while it is adjusted, in points; `None` before.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct ScaleState(Option<f32>);

/// Draws the bar and its slider; returns the requested command.
pub(super) fn scale_ui(ui: &mut Ui, page: &mut StudiesPage) -> Option<Command> {
    let t = tokens(ui.ctx());
    let mut asked = None;
    ui.add(Label::new(RichText::new(strings::SCALE).heading().strong()).selectable(false));
    ui.add(Label::new(strings::SCALE_STEPS).wrap());
    ui.add_space(GROUP_GAP);
    let known = points_per_mm(page.settings.pixels_per_mm, ui.ctx()) * CARD_MM[0];
    let mut width = page.scale.0.unwrap_or(known).clamp(*WIDTHS.start(), *WIDTHS.end());
    ui.spacing_mut().slider_width = ui.available_width().min(*WIDTHS.end()) - GAP;
    let slider = Slider::new(&mut width, WIDTHS).show_value(false).step_by(1.0);
    if ui.add(slider).accessible_name(strings::CARD_WIDTH).changed() {
        page.scale.0 = Some(width);
    }
    ui.add_space(GROUP_GAP);
    let (area, _) = ui.allocate_exact_size(vec2(width, width * CARD_MM[1] / CARD_MM[0]), Sense::hover());
    ui.painter().rect_filled(area, f32::from(RADIUS), t.accent);
    for x in [area.left(), area.right()] {
        let edge = Rect::from_x_y_ranges(x - 0.5..=x + 0.5, area.top() - 14.0..=area.bottom() + 14.0);
        ui.painter().rect_filled(edge, 0.0, t.text);
    }
    ui.add_space(2.0 * GROUP_GAP);
    ui.horizontal(|ui| {
        if primary_ui(ui, strings::SAVE_SCALE, true).clicked() {
            let pixels_per_mm = width * ui.ctx().pixels_per_point() / CARD_MM[0];
            let pixels_per_mm = pixels_per_mm.clamp(*PIXELS_PER_MM.start(), *PIXELS_PER_MM.end());
            asked = Some(Command::Studies(StudiesCommand::SetScale(pixels_per_mm)));
            page.shown = Shown::Preview;
        }
        if ui.button(strings::CANCEL).clicked() {
            (page.scale.0, page.shown) = (None, Shown::Preview);
        }
    });
    asked
}

/// Scale of the screen for the log of a session.
pub(crate) fn screen_scale(pixels_per_mm: Option<f32>, ctx: &egui::Context) -> ScreenScale {
    // Digits beyond those of a measurement with a card would say nothing.
    let rounded = |pixels: f32| (1e3 * f64::from(pixels)).round() / 1e3;
    match pixels_per_mm {
        Some(pixels) => ScreenScale::Measured { pixels_per_mm: rounded(pixels) },
        None => {
            ScreenScale::Assumed { pixels_per_mm: rounded(points_per_mm(None, ctx) * ctx.pixels_per_point()) }
        }
    }
}

/// Scale of the screen in points per millimeter: the measured one, or 96 dots per inch.
pub(crate) fn points_per_mm(pixels_per_mm: Option<f32>, ctx: &egui::Context) -> f32 {
    pixels_per_mm.map_or(96.0 / 25.4 / ctx.zoom_factor(), |pixels| pixels / ctx.pixels_per_point())
}
