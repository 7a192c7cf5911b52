//! List of the axes, with the places of the chosen ones. Its order stays while the sheet is open, so that the next click does not hit
//! another axis.

use egui::{Checkbox, Grid, Label, RichText, Ui};
use shagreen_core::space::MOST_AXES;

use super::{Change, Offer, Offered, is_chosen};
use crate::look::icons::{ICON_ARROW_DOWNWARD, ICON_ARROW_UPWARD, icon_button};
use crate::look::theme::{GAP, tokens};
use crate::strings::axes as strings;

/// Distance between rows, in points.
const ROW_GAP: f32 = 2.0;

/// Draws the list of the axes of `n` textures; returns the requested change.
pub(super) fn list_ui(ui: &mut Ui, offer: &Offer, chosen: &[String], n: usize) -> Option<Change> {
    let mut change = None;
    Grid::new("axes").num_columns(4).spacing([2.0 * GAP, ROW_GAP]).show(ui, |ui| {
        for axis in &offer.axes {
            let place = chosen.iter().position(|name| *name == axis.name);
            change = row_ui(ui, axis, place, chosen, n).or(change.take());
        }
    });
    change
}

/// Draws the row of an axis, which is chosen at a place or not at all.
fn row_ui(ui: &mut Ui, axis: &Offered, place: Option<usize>, chosen: &[String], n: usize) -> Option<Change> {
    let t = tokens(ui.ctx());
    let mut change = None;
    let mut is_on = place.is_some();
    let (can_switch, reason) = match place {
        Some(_) => (chosen.len() > 1, strings::NEEDS_ONE.to_owned()),
        None if is_chosen(chosen, &axis.name) => (false, strings::SAME_NAME.to_owned()),
        None => (chosen.len() < MOST_AXES, strings::most()),
    };
    let tick = ui.add_enabled(can_switch, Checkbox::new(&mut is_on, strings::name(&axis.name)));
    if tick.on_disabled_hover_text(reason).changed() {
        let name = axis.name.clone();
        change = Some(if is_on { Change::Add(name) } else { Change::Remove(name) });
    }
    let weak = |text: String| Label::new(RichText::new(text).color(t.text_weak)).selectable(false);
    ui.add(weak(place.map_or_else(String::new, strings::place)));
    ui.horizontal(|ui| {
        let Some(place) = place else { return };
        ui.spacing_mut().item_spacing.x = 2.0;
        let up = ui.add_enabled(place > 0, icon_button(ICON_ARROW_UPWARD).small().frame(false));
        let name = strings::earlier(&axis.name);
        if up.accessible_name(&name).on_hover_text(&name).clicked() {
            change = Some(Change::MoveUp(place));
        }
        let can_sink = place + 1 < chosen.len();
        let down = ui.add_enabled(can_sink, icon_button(ICON_ARROW_DOWNWARD).small().frame(false));
        let name = strings::later(&axis.name);
        if down.accessible_name(&name).on_hover_text(&name).clicked() {
            change = Some(Change::MoveUp(place + 1));
        }
    });
    let n_known = axis.values.iter().flatten().count();
    ui.add(weak(strings::source(axis.source, n_known, n)));
    ui.end_row();
    change
}
