//! Recording and the texture fitted to it: questions, plots, fit results and options.

use egui::{Align, Label, Layout, RichText, ScrollArea, Ui, vec2};
use shagreen_core::recording::fit::FitReport;

use crate::look::plot::title;
use crate::look::scroll_to_focus::scroll_to_focus;
use crate::look::spectrum_plot::spectrum_plot;
use crate::look::theme::{GAP, GROUP_GAP, tokens};
use crate::sheets::import::batch::{Batch, Content};
use crate::sheets::import::draft::FitState;
use crate::sheets::import::fit_ui::{DETAILS_WIDTH, adjust_ui, fit_ui, list_ui};
use crate::sheets::import::import_context::ImportContext;
use crate::sheets::import::plane_plot::{Dot, color_of_gfc, gfc_legend_ui, plane_plot};
use crate::sheets::import::questions_ui::questions_ui;
use crate::sheets::import::recording_state::RecordingState;
use crate::sheets::import::trace_plot::trace_plot;
use crate::strings::import as strings;
use crate::strings::sentence;

/// Minimum height of the traces, in points.
const TRACES: f32 = 196.0;
/// Minimum height of the plane and of the spectrum, in points.
const SPECTRA: f32 = 136.0;
/// Width from which the plane and the spectrum fit beside each other, in points.
const SIDE_BY_SIDE: f32 = 540.0;

/// Draws the recording with this id and its texture.
pub(super) fn draft_ui(
    ui: &mut Ui,
    batch: &mut Batch,
    id: u64,
    for_all: &mut bool,
    around: ImportContext<'_>,
) {
    let area = ui.available_rect_before_wrap();
    let (left, right) = area.split_left_right_at_x(area.right() - DETAILS_WIDTH);
    let left = egui::Rect::from_min_max(left.min, left.max - vec2(GROUP_GAP + GAP, 0.0));
    let top_down = Layout::top_down(Align::Min);
    let mut main = ui.new_child(egui::UiBuilder::new().max_rect(left).layout(top_down));
    let mut details = ui.new_child(egui::UiBuilder::new().max_rect(right).layout(top_down));
    ScrollArea::vertical().id_salt(("main", id)).auto_shrink(false).show(&mut main, |ui| {
        // Leaves room for the scroll bar.
        ui.set_max_width(ui.available_width() - 10.0);
        ask_ui(ui, batch, id, for_all);
        plots_ui(ui, batch, id);
        scroll_to_focus(ui);
    });
    ScrollArea::vertical().id_salt(("details", id)).auto_shrink(false).show(&mut details, |ui| {
        let Some(draft) = batch.draft_of_mut(id) else { return };
        if adjust_ui(ui, draft) {
            batch.fit_with(id);
        }
        ui.add_space(GAP);
        let Some(draft) = batch.draft_of(id) else { return };
        fit_ui(ui, draft, around, batch.are_placed());
        for file in batch.files().iter().filter(|file| draft.files.contains(&file.id)) {
            let Content::Recording(state) = &file.content else { continue };
            list_ui(ui, strings::WARNINGS, &state.outcome.warnings, tokens(ui.ctx()).warning);
        }
        scroll_to_focus(ui);
    });
}

fn recording(batch: &mut Batch, id: u64) -> Option<&mut RecordingState> {
    match &mut batch.file_mut(id)?.content {
        Content::Recording(state) => Some(state),
        _ => None,
    }
}

/// Draws the questions, and errors that prevent reading the recording.
fn ask_ui(ui: &mut Ui, batch: &mut Batch, id: u64, for_all: &mut bool) {
    let t = tokens(ui.ctx());
    let Some(state) = recording(batch, id) else { return };
    let has_questions =
        !(state.outcome.questions.is_empty() && state.answered.is_empty() && state.wrong.is_empty());
    if let Some(Err(reason)) = &state.outcome.recording {
        // Before the questions: a file with such a fault may not be usable whatever the answers are.
        ui.add(Label::new(RichText::new(sentence(reason)).color(t.error)).wrap());
        if !has_questions {
            ui.add(Label::new(RichText::new(strings::ACCEPTED).small().color(t.text_weak)).wrap());
        }
        ui.add_space(GAP);
    }
    let given = questions_ui(ui, state);
    let asked: Vec<_> = state.outcome.questions.clone();
    if state.outcome.recording.is_none() {
        ui.add_space(GAP);
        ui.add(Label::new(RichText::new(strings::ANSWER_FIRST).color(t.text_weak)).wrap().selectable(false));
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
    // The plots share the remaining height, and scroll if it is too small.
    let left = ui.available_height();
    let traces = (0.48 * left).max(TRACES);
    trace_plot(ui, &drawn.trace, chosen, traces);
    ui.add_space(GAP);
    let spectra = (ui.available_height() - 74.0).max(SPECTRA);
    let Some(draft) = batch.draft_of_mut(id) else { return };
    let FitState::Done(fitted) = &draft.fit else { return };
    let report = &fitted.report;
    let n = report.segments.len();
    let mut segment = draft.segment.min(n.saturating_sub(1));
    let width = ui.available_width();
    let size = |share: f32| vec2(share * (width - GROUP_GAP), spectra + 44.0);
    if width < SIDE_BY_SIDE {
        segments_ui(ui, report, &mut segment, spectra);
        ui.add_space(GAP);
        segment_spectrum_ui(ui, report, &mut segment, spectra);
    } else {
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
    }
    draft.segment = segment;
}

/// Draws the segments in the speed–force plane; a click selects one.
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

/// Draws the spectrum of the selected segment with its fit results, and buttons to other segments.
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
    let model_name = if report.held_out.is_any() { strings::HELD_OUT_LINE } else { strings::MODEL_LINE };
    let model = (model_name, comparison.model_psd.as_slice());
    spectrum_plot(ui, &report.frequencies, Some(&comparison.measured_psd), model, height);
    let figures = strings::of_segment(chosen);
    ui.add(Label::new(RichText::new(figures).small().color(t.text_weak)).truncate().selectable(false));
}
