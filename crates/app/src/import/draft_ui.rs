//! A recording and the texture that is fitted to it: questions, plots, figures, what can be adjusted.

use egui::{Align, ComboBox, Grid, Label, Layout, RichText, ScrollArea, TextEdit, Ui, vec2};
use shagreen_core::fit::FitReport;
use shagreen_core::texture::Interpolation;

use crate::import::batch::{Batch, Content, RecordingState};
use crate::import::draft::{Draft, FitState, ORDERS, RATES_HZ};
use crate::import::plane_plot::{Dot, color_of_gfc, gfc_legend_ui, plane_plot};
use crate::import::questions_ui::questions_ui;
use crate::import::sheet::Surroundings;
use crate::import::spectrum_plot::spectrum_plot;
use crate::import::trace_plot::trace_plot;
use crate::scope::title;
use crate::strings::import as strings;
use crate::theme::{GAP, GROUP_GAP, tokens};

/// Width of the column of figures, in points.
const DETAILS_WIDTH: f32 = 268.0;
/// Least height of the traces, in points.
const TRACES: f32 = 250.0;
/// Least height of the plane and the spectrum, in points.
const SPECTRA: f32 = 190.0;

/// Draws what belongs to the recording `id`.
pub(super) fn draft_ui(
    ui: &mut Ui,
    batch: &mut Batch,
    id: u64,
    for_all: &mut bool,
    around: Surroundings<'_>,
) {
    let area = ui.available_rect_before_wrap();
    let (left, right) = area.split_left_right_at_x(area.right() - DETAILS_WIDTH);
    let left = egui::Rect::from_min_max(left.min, left.max - vec2(GROUP_GAP + GAP, 0.0));
    let top_down = Layout::top_down(Align::Min);
    let mut main = ui.new_child(egui::UiBuilder::new().max_rect(left).layout(top_down));
    let mut details = ui.new_child(egui::UiBuilder::new().max_rect(right).layout(top_down));
    ScrollArea::vertical().id_salt(("main", id)).auto_shrink(false).show(&mut main, |ui| {
        ask_ui(ui, batch, id, for_all);
        plots_ui(ui, batch, id);
    });
    ScrollArea::vertical().id_salt(("details", id)).auto_shrink(false).show(&mut details, |ui| {
        let Some(draft) = batch.draft_of_mut(id) else { return };
        if adjust_ui(ui, draft) {
            batch.fit_with(id);
        }
        ui.add_space(GAP);
        let Some(draft) = batch.draft_of(id) else { return };
        fit_ui(ui, draft, around);
        for file in batch.files().iter().filter(|file| draft.files.contains(&file.id)) {
            let Content::Recording(state) = &file.content else { continue };
            list_ui(ui, strings::WARNINGS, &state.outcome.warnings, tokens(ui.ctx()).warning);
        }
    });
}

fn recording(batch: &mut Batch, id: u64) -> Option<&mut RecordingState> {
    match &mut batch.file_mut(id)?.content {
        Content::Recording(state) => Some(state),
        _ => None,
    }
}

/// The questions, and what keeps the recording from being read.
fn ask_ui(ui: &mut Ui, batch: &mut Batch, id: u64, for_all: &mut bool) {
    let t = tokens(ui.ctx());
    let Some(state) = recording(batch, id) else { return };
    let given = questions_ui(ui, state);
    let has_questions = !(state.outcome.questions.is_empty() && state.answered.is_empty());
    let asked: Vec<_> = state.outcome.questions.clone();
    match &state.outcome.recording {
        Some(Err(reason)) => {
            ui.add_space(GAP);
            ui.add(Label::new(RichText::new(reason).color(t.error)).wrap());
        }
        None => {
            ui.add_space(GAP);
            ui.add(
                Label::new(RichText::new(strings::ANSWER_FIRST).color(t.text_weak)).wrap().selectable(false),
            );
        }
        Some(Ok(_)) => {}
    }
    if asked.iter().any(|question| batch.n_asking(question) > 1) {
        ui.checkbox(for_all, strings::FOR_ALL);
    }
    if let Some(answer) = given {
        batch.answer(id, &answer.question, &answer.text, *for_all);
    }
    if has_questions {
        ui.add_space(GAP);
    }
}

fn plots_ui(ui: &mut Ui, batch: &mut Batch, id: u64) {
    let Some(draft) = batch.draft_of(id) else { return };
    let place = batch.drawn_of(draft).position(|(file, _)| file.id == id);
    let Some(drawn) =
        place.and_then(|place| batch.drawn_of(draft).nth(place)).map(|(_, d)| std::sync::Arc::clone(d))
    else {
        return;
    };
    let chosen = draft
        .fitted()
        .and_then(|f| f.report.segments.get(draft.segment))
        .filter(|s| Some(s.recording) == place);
    let chosen = chosen.map(|s| [s.start_secs, s.start_secs + s.seconds]);
    // The plots share what is left of the height, and scroll where that is too little.
    let left = ui.available_height();
    let traces = (0.55 * left).max(TRACES);
    trace_plot(ui, &drawn.trace, chosen, traces);
    ui.add_space(GAP);
    let spectra = (left - traces - 64.0).max(SPECTRA);
    let Some(draft) = batch.draft_of_mut(id) else { return };
    let FitState::Done(fitted) = &draft.fit else { return };
    let report = &fitted.report;
    let n = report.segments.len();
    let mut segment = draft.segment.min(n.saturating_sub(1));
    let width = ui.available_width();
    let size = |share: f32| vec2(share * (width - GROUP_GAP), spectra + 44.0);
    ui.horizontal_top(|ui| {
        ui.allocate_ui_with_layout(size(0.42), Layout::top_down(Align::Min), |ui| {
            ui.set_width(size(0.42).x);
            segments_ui(ui, report, &mut segment, spectra);
        });
        ui.add_space(GROUP_GAP - GAP);
        ui.allocate_ui_with_layout(size(0.58), Layout::top_down(Align::Min), |ui| {
            ui.set_width(size(0.58).x);
            segment_spectrum_ui(ui, report, &mut segment, spectra);
        });
    });
    draft.segment = segment;
}

/// The segments on the plane; a click chooses one.
fn segments_ui(ui: &mut Ui, report: &FitReport, segment: &mut usize, height: f32) {
    let t = tokens(ui.ctx());
    title(ui, strings::PLANE, strings::PLANE_UNIT);
    let dots: Vec<Dot> = report
        .segments
        .iter()
        .map(|s| Dot {
            speed_mm_per_s: s.speed.mm_per_s(),
            force_n: s.force.0,
            color: color_of_gfc(s.comparison.gfc, t),
        })
        .collect();
    if let Some(clicked) = plane_plot(ui, strings::PLANE, &dots, *segment, height) {
        *segment = clicked;
    }
    gfc_legend_ui(ui);
}

/// The spectrum of the chosen segment, with its figures and a way to the next.
fn segment_spectrum_ui(ui: &mut Ui, report: &FitReport, segment: &mut usize, height: f32) {
    let t = tokens(ui.ctx());
    let n = report.segments.len();
    let Some(chosen) = report.segments.get(*segment) else { return };
    ui.horizontal(|ui| {
        title(ui, strings::SPECTRUM, strings::SPECTRUM_UNIT);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.spacing_mut().interact_size.y = 18.0;
            let next = egui::Button::new(">").small();
            if ui.add_enabled(*segment + 1 < n, next).accessible_name(strings::NEXT_SEGMENT).clicked() {
                *segment += 1;
            }
            let text = RichText::new(strings::segment(*segment + 1, n)).small().color(t.text_weak);
            ui.add(Label::new(text).selectable(false));
            let previous = egui::Button::new("<").small();
            if ui.add_enabled(*segment > 0, previous).accessible_name(strings::PREVIOUS_SEGMENT).clicked() {
                *segment -= 1;
            }
        });
    });
    let comparison = &chosen.comparison;
    spectrum_plot(ui, &report.frequencies, Some(&comparison.measured_psd), &comparison.model_psd, height);
    let figures = strings::of_segment(chosen);
    ui.add(Label::new(RichText::new(figures).small().color(t.text_weak)).truncate().selectable(false));
}

/// Name, tags, and how to fit; returns whether it has to be fitted anew.
fn adjust_ui(ui: &mut Ui, draft: &mut Draft) -> bool {
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
        let combo = combo.show_ui(ui, |ui| {
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
    let combo = combo.show_ui(ui, |ui| {
        for choice in std::iter::once(None).chain(RATES_HZ.map(Some)) {
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
    let combo = combo.show_ui(ui, |ui| {
        for choice in std::iter::once(None).chain(ORDERS.map(Some)) {
            ui.selectable_value(order, choice, words(choice));
        }
    });
    combo.response.accessible_name(strings::ORDER).on_hover_text(strings::ORDER_HELP);
}

/// Figures of the fit, or why there is none.
fn fit_ui(ui: &mut Ui, draft: &Draft, around: Surroundings<'_>) {
    let t = tokens(ui.ctx());
    match &draft.fit {
        FitState::Nothing => {
            ui.add(Label::new(RichText::new(strings::NO_FIT).color(t.text_weak)).selectable(false));
        }
        FitState::Working => {
            ui.add(Label::new(RichText::new(strings::READING).color(t.text_weak)).selectable(false));
        }
        FitState::Failed(reason) => {
            ui.add(Label::new(RichText::new(reason).color(t.error)).wrap());
        }
        FitState::Done(fitted) => {
            figures_ui(ui, &fitted.report);
            let (rate_hz, space_rate_hz) = (fitted.report.rate.0, around.space_rate_hz);
            if rate_hz != space_rate_hz {
                let text = strings::other_rate(rate_hz, space_rate_hz);
                ui.add(Label::new(RichText::new(text).small().color(t.warning)).wrap().selectable(false));
            }
            let text = RichText::new(strings::JOINS_UNPLACED).small().color(t.text_weak);
            ui.add(Label::new(text).wrap().selectable(false));
            list_ui(ui, strings::NOTES, &fitted.report.notes, t.text_weak);
        }
    }
}

fn figures_ui(ui: &mut Ui, report: &FitReport) {
    let t = tokens(ui.ctx());
    ui.add(Label::new(RichText::new(strings::FIGURES).strong()).selectable(false));
    let held_out = if report.held_out { strings::HELD_OUT } else { strings::NOT_HELD_OUT };
    let color = if report.held_out { t.text_weak } else { t.warning };
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

/// Names and values in two columns, each with what it means.
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

/// Sentences under a heading; nothing where there are none.
pub(super) fn list_ui(ui: &mut Ui, heading: &str, sentences: &[String], color: egui::Color32) {
    if sentences.is_empty() {
        return;
    }
    ui.add_space(GAP);
    ui.add(Label::new(RichText::new(heading).strong()).selectable(false));
    for sentence in sentences {
        ui.add(Label::new(RichText::new(strings::answer(sentence)).small().color(color)).wrap());
    }
}
