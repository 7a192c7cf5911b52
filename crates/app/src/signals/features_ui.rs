//! Bars for the features of a pair of signals.

use std::sync::Arc;

use egui::{Align2, Color32, FontId, Grid, Label, Rect, RichText, Sense, Ui, pos2, vec2};
use shagreen_core::signals::quality::Feature;
use shagreen_formats::figure::Figure;

use super::analysis::Compared;
use super::slot_ui::slot_color;
use crate::choices::signals::Slot;
use crate::command::Command;
use crate::figure_ui::figure_head_ui;
use crate::look::theme::{GAP, tokens};
use crate::strings::differences as strings;
use crate::strings::digits::three_digits;

/// Size of a bar, in points.
const BAR: (f32, f32) = (74.0, 16.0);

/// Draws the names of both signals, the predicted d' in words, the features of both signals, their distances, and the
/// contribution of each distance to d'.
pub(super) fn features_ui(
    ui: &mut Ui,
    compared: &Compared,
    names: [&str; 2],
    figure: &Arc<Figure>,
) -> Option<Command> {
    let t = tokens(ui.ctx());
    let save = figure_head_ui(ui, figure, "features");
    let Figure::Table(table) = &**figure else { return save };
    for (slot, name) in Slot::ALL.into_iter().zip(names) {
        let text = RichText::new(strings::named(slot, name)).color(slot_color(ui, slot));
        ui.add(Label::new(text).wrap().selectable(false));
    }
    let large = RichText::new(strings::d_prime(compared.d_prime, compared.relation)).heading().color(t.text);
    ui.horizontal(|ui| {
        ui.add(Label::new(large).selectable(false)).on_hover_text(strings::D_PRIME_HELP);
        let meaning = RichText::new(strings::meaning(compared.d_prime, compared.relation));
        ui.add(Label::new(meaning).wrap().selectable(false)).on_hover_text(strings::D_PRIME_HELP);
    });
    let said = strings::compared(compared.snr_db, compared.seconds);
    ui.add(Label::new(RichText::new(said).small().color(t.text_weak)).wrap().selectable(false));
    ui.add_space(GAP);
    let most = compared.parts.iter().map(|(_, part)| *part).fold(1e-9, f64::max);
    Grid::new("features").num_columns(5).spacing([8.0, 6.0]).show(ui, |ui| {
        ui.label("");
        for (column, help) in table.columns.iter().zip(strings::FEATURE_COLUMNS_HELP) {
            let text = RichText::new(column).small().color(t.text_weak);
            ui.add(Label::new(text).selectable(false)).on_hover_text(help);
        }
        ui.end_row();
        for (feature, row) in Feature::ALL.into_iter().zip(&table.rows) {
            row_ui(ui, feature, row, most);
            ui.end_row();
        }
    });
    save
}

fn row_ui(ui: &mut Ui, feature: Feature, (name, numbers): &(String, Vec<Option<f64>>), most: f64) {
    let t = tokens(ui.ctx());
    ui.add(Label::new(name).selectable(false).extend()).on_hover_text(strings::feature_help(feature));
    let [a, b] = Slot::ALL.map(|slot| slot_color(ui, slot));
    let range = range_of(feature);
    let of = |value: f64| range.map(|(low, high)| ((value - low) / (high - low)).clamp(0.0, 1.0) as f32);
    let number = |index: usize| numbers.get(index).copied().flatten();
    let shown = |number: Option<f64>| number.map_or_else(|| strings::NONE.to_owned(), three_digits);
    bar(ui, &shown(number(0)), number(0).and_then(of), a);
    bar(ui, &shown(number(1)), number(1).and_then(of), b);
    ui.add(Label::new(RichText::new(shown(number(2))).small()).selectable(false).extend());
    let part = number(3);
    bar(ui, &shown(part), part.map(|part| (part / most) as f32), t.text_weak);
}

/// Range of the bar of a feature; `None` for features that are only compared.
fn range_of(feature: Feature) -> Option<(f64, f64)> {
    match feature {
        Feature::Roughness => Some((-5.0, 2.0)),
        Feature::Brightness => Some((0.0, 500.0)),
        Feature::Regularity => Some((0.0, 1.0)),
        Feature::Asymmetry => Some((-2.0, 2.0)),
        Feature::SpectralPower | Feature::SpectralAmplitude | Feature::Envelope => None,
    }
}

/// Draws a number over a bar that fills `share` of its width.
fn bar(ui: &mut Ui, number: &str, share: Option<f32>, color: Color32) {
    let t = tokens(ui.ctx());
    let (area, _) = ui.allocate_exact_size(vec2(BAR.0, BAR.1), Sense::hover());
    if let Some(share) = share {
        ui.painter().rect_filled(area, 3.0, t.control);
        let full = Rect::from_min_max(area.min, pos2(area.left() + share * area.width(), area.bottom()));
        ui.painter().rect_filled(full, 3.0, color.gamma_multiply(0.4));
    }
    let at = area.left_center() + vec2(6.0, 0.0);
    ui.painter().text(at, Align2::LEFT_CENTER, number, FontId::monospace(11.5), t.text);
}
