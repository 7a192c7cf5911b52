//! Options and results of fitting a texture.

use egui::{ComboBox, Grid, Label, RichText, TextEdit, Ui};
use shagreen_core::recording::fit::{FitReport, HeldOut, MODEL_RATES_HZ};
use shagreen_core::texture::Interpolation;

use crate::look::list::ShowList as _;
use crate::look::theme::{GAP, tokens};
use crate::sheets::import::draft::{Draft, FitState, ORDERS};
use crate::sheets::import::import_context::ImportContext;
use crate::strings::import as strings;
use crate::strings::sentence;

/// Width of the column of results, in points.
pub(super) const DETAILS_WIDTH: f32 = 268.0;

/// Draws name, tags and fit options; returns whether the texture must be fitted again.
pub(super) fn adjust_ui(ui: &mut Ui, draft: &mut Draft) -> bool {
    let before = draft.options.clone();
    Grid::new("adjust").num_columns(2).spacing([2.0 * GAP, GAP]).show(ui, |ui| {
        let width = DETAILS_WIDTH - 96.0;
        let weak = |ui: &mut Ui, text: &str| {
            let t = tokens(ui.ctx());
            ui.add(Label::new(RichText::new(text).color(t.text_weak)).selectable(false));
        };
        weak(ui, strings::NAME_LABEL);
        ui.add(TextEdit::singleline(&mut draft.name).desired_width(width)).accessible_name(strings::NAME);
        ui.end_row();
        weak(ui, strings::TAGS_LABEL);
        let tags = TextEdit::singleline(&mut draft.tags).hint_text(strings::TAGS_HINT).desired_width(width);
        ui.add(tags).accessible_name(strings::TAGS);
        ui.end_row();
        weak(ui, strings::RATE);
        rate_ui(ui, draft, width);
        ui.end_row();
        weak(ui, strings::ORDER);
        order_ui(ui, draft, width);
        ui.end_row();
        weak(ui, strings::INTERPOLATION);
        let words = |way: Interpolation| match way {
            Interpolation::Barycentric => strings::BARYCENTRIC,
            Interpolation::RadialBasis => strings::RADIAL_BASIS,
        };
        let current = &mut draft.options.interpolation;
        let combo = ComboBox::from_id_salt("interpolation").width(width).selected_text(words(*current));
        let combo = combo.show_list(ui, |ui| {
            for way in [Interpolation::Barycentric, Interpolation::RadialBasis] {
                ui.selectable_value(current, way, words(way));
            }
        });
        combo.response.accessible_name(strings::INTERPOLATION).on_hover_text(strings::INTERPOLATION_HELP);
        ui.end_row();
    });
    draft.options != before
}

fn rate_ui(ui: &mut Ui, draft: &mut Draft, width: f32) {
    let words = |rate_hz: Option<f64>| rate_hz.map_or(strings::AUTOMATIC.to_owned(), strings::rate);
    let mut rate_hz = draft.rate_hz();
    let combo = ComboBox::from_id_salt("rate").width(width).selected_text(words(rate_hz));
    let combo = combo.show_list(ui, |ui| {
        for choice in std::iter::once(None).chain(MODEL_RATES_HZ.map(Some)) {
            ui.selectable_value(&mut rate_hz, choice, words(choice));
        }
    });
    combo.response.accessible_name(strings::RATE).on_hover_text(strings::RATE_HELP);
    draft.set_rate_hz(rate_hz);
}

fn order_ui(ui: &mut Ui, draft: &mut Draft, width: f32) {
    let words = |order: Option<usize>| order.map_or(strings::AUTOMATIC.to_owned(), |order| order.to_string());
    let order = &mut draft.options.order;
    let combo = ComboBox::from_id_salt("order").width(width).selected_text(words(*order));
    let combo = combo.show_list(ui, |ui| {
        for choice in std::iter::once(None).chain(ORDERS.map(Some)) {
            ui.selectable_value(order, choice, words(choice));
        }
    });
    combo.response.accessible_name(strings::ORDER).on_hover_text(strings::ORDER_HELP);
}

/// Draws the results of the fit, or why there are none. `is_placed` tells that textures get estimated positions.
pub(super) fn fit_ui(ui: &mut Ui, draft: &Draft, around: ImportContext<'_>, is_placed: bool) {
    let t = tokens(ui.ctx());
    match &draft.fit {
        FitState::Nothing => {
            ui.add(Label::new(RichText::new(strings::NO_FIT).color(t.text_weak)).selectable(false));
        }
        FitState::Working => {
            ui.add(Label::new(RichText::new(strings::READING).color(t.text_weak)).selectable(false));
        }
        FitState::Failed(reason) => {
            ui.add(Label::new(RichText::new(sentence(reason)).color(t.error)).wrap());
        }
        FitState::Done(fitted) => {
            figures_ui(ui, &fitted.report);
            let (rate_hz, space_rate_hz) = (fitted.report.rate.0, around.space_rate_hz);
            if rate_hz > space_rate_hz {
                let text = strings::other_rate(rate_hz, space_rate_hz);
                ui.add(Label::new(RichText::new(text).small().color(t.warning)).wrap().selectable(false));
            }
            let joins = if !is_placed {
                strings::JOINS_UNPLACED.to_owned()
            } else if rate_hz > space_rate_hz {
                strings::no_place_at(space_rate_hz)
            } else if draft.is_lowered {
                strings::placed_at(rate_hz)
            } else {
                strings::JOINS_PLACED.to_owned()
            };
            let text = RichText::new(joins).small().color(t.text_weak);
            ui.add(Label::new(text).wrap().selectable(false));
            list_ui(ui, strings::NOTES, &fitted.report.notes, t.text_weak);
        }
    }
}

fn figures_ui(ui: &mut Ui, report: &FitReport) {
    let t = tokens(ui.ctx());
    ui.add(Label::new(RichText::new(strings::FIGURES).strong()).selectable(false));
    let (held_out, color) = match report.held_out {
        HeldOut::Segments => (strings::HELD_OUT, t.text_weak),
        HeldOut::Blocks => (strings::HELD_OUT_BLOCKS, t.warning),
        HeldOut::Nothing => (strings::NOT_HELD_OUT, t.warning),
    };
    ui.add(Label::new(RichText::new(held_out).small().color(color)).wrap().selectable(false));
    let tap = report.tap.as_ref().map_or(strings::NO_TAP.to_owned(), strings::tap);
    let rows = [
        (strings::GFC_MEDIAN, format!("{:.3}", report.gfc_median()), strings::GFC_HELP),
        (
            strings::LEVEL_ERROR,
            format!("{:.2} dB", report.level_error_db_median()),
            strings::LEVEL_ERROR_HELP,
        ),
        (strings::N_SEGMENTS, report.segments.len().to_string(), ""),
        (strings::COVERAGE, format!("{:.0} %", 100.0 * report.coverage), strings::COVERAGE_HELP),
        (strings::MODEL_RATE, strings::rate(report.rate.0), strings::RATE_HELP),
        (strings::MODEL_ORDER, report.order.to_string(), strings::ORDER_HELP),
        (strings::TAP, tap, strings::TAP_HELP),
    ];
    figure_rows_ui(ui, &rows);
}

/// Draws names and values in two columns, with tooltips.
pub(super) fn figure_rows_ui(ui: &mut Ui, rows: &[(&str, String, &str)]) {
    let t = tokens(ui.ctx());
    Grid::new("figures").num_columns(2).spacing([2.0 * GAP, 2.0]).show(ui, |ui| {
        for (name, value, help) in rows {
            let name = ui.add(Label::new(RichText::new(*name).color(t.text_weak)).selectable(false));
            if !help.is_empty() {
                name.on_hover_text(*help);
            }
            ui.add(Label::new(value).wrap());
            ui.end_row();
        }
    });
}

/// Draws sentences below a heading; nothing if there are none.
pub(super) fn list_ui(ui: &mut Ui, heading: &str, sentences: &[String], color: egui::Color32) {
    if sentences.is_empty() {
        return;
    }
    ui.add_space(GAP);
    ui.add(Label::new(RichText::new(heading).strong()).selectable(false));
    for text in sentences {
        ui.add(Label::new(RichText::new(sentence(&strings::answer(text))).small().color(color)).wrap());
    }
}
