//! Surface that the participant strokes, without anything that tells one texture from another.

use std::sync::Arc;

use egui::{Label, Rect, RichText, Role, Sense, Stroke, StrokeKind, Ui, WidgetInfo};
use shagreen_core::people::study::plan::ShownControls;
use shagreen_core::units::Radians;

use super::RunnerInput;
use super::text_texture::TextTexture;
use super::trial_state::TrialState;
use crate::author::pad::PadPicture;
use crate::author::pad::surface::{CURSOR, ReportedPressure, stroke_report, tip_ui};
use crate::look::theme::{RADIUS, tokens};
use crate::state::mouse_report::MouseReport;
use crate::state::own_surface::{OwnSurface, SurfacePicture};
use crate::state::pad_surface::USUAL_LIGHT;
use crate::strings::studies as strings;

/// View state of the surface.
#[derive(Default)]
pub(super) struct StageState {
    pressure: ReportedPressure,
    /// Picture of the texture of a question.
    picture: OwnSurface,
}

/// Draws the surface into the available space. Returns the pointer while it strokes.
pub(super) fn stage_ui(
    ui: &mut Ui,
    input: &RunnerInput<'_>,
    stage: &mut StageState,
    state: &TrialState,
) -> Option<MouseReport> {
    let t = tokens(ui.ctx());
    ui.add(Label::new(RichText::new(label(state)).color(t.text_weak)).wrap().selectable(false));
    let (area, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, strings::SURFACE));
    match picture(ui, stage, state) {
        Some(picture) => picture.show(ui.painter(), area),
        None => {
            ui.painter().rect_filled(area, f32::from(RADIUS), t.background);
        }
    }
    ui.painter().rect_stroke(area, f32::from(RADIUS), Stroke::new(1.0, t.line), StrokeKind::Inside);
    if response.has_focus() {
        ui.painter().rect_stroke(area, f32::from(RADIUS), Stroke::new(2.0, t.accent), StrokeKind::Inside);
    }
    sides_ui(ui, area, state);
    tip_ui(ui, area, input.session.touch());
    ui.input(|i| stage.pressure.follow(&i.events));
    let mouse = stroke_report(ui, area, &response, stage.pressure);
    response.on_hover_cursor(CURSOR);
    mouse
}

/// What the participant does on the surface.
fn label(state: &TrialState) -> String {
    if let Some(text) = &state.text {
        let is_made = text.authored().is_some();
        return if is_made { strings::MOVE_HERE } else { strings::MOVE_LATER }.to_owned();
    }
    let playing = state.presenter.playing().and_then(|index| state.shown.get(index));
    match playing.filter(|shown| !shown.label.is_empty()) {
        _ if state.presenter.is_passive() => strings::STROKED.to_owned(),
        Some(shown) => strings::move_here_to_feel(&shown.label),
        None if state.is_detection() => strings::MOVE_BOTH.to_owned(),
        None if state.shown.len() > 1 => strings::SELECT_FIRST.to_owned(),
        None => strings::MOVE_HERE.to_owned(),
    }
}

/// Picture of the texture of a question, where the condition shows it.
fn picture(ui: &Ui, stage: &mut StageState, state: &TrialState) -> Option<PadPicture> {
    let text = state.text.as_ref();
    let picture = text.filter(|text| text.shown() != ShownControls::Nothing).and_then(TextTexture::picture);
    let own = picture.map(|picture| SurfacePicture { picture: Arc::clone(picture), is_felt: false });
    let (texture, size_mm) = stage.picture.follow(own, ui.ctx(), USUAL_LIGHT)?;
    Some(PadPicture { texture, size_mm, is_felt: false, turn: Radians(0.0) })
}

/// Draws the border between the two sides of a detection.
fn sides_ui(ui: &Ui, area: Rect, state: &TrialState) {
    if state.is_detection() {
        let t = tokens(ui.ctx());
        ui.painter().vline(area.center().x, area.y_range(), Stroke::new(1.0, t.text_weak));
    }
}
