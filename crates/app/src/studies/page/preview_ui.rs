//! Preview of the open plan: what a participant meets.

use egui::{Label, RichText, ScrollArea, Ui};
use shagreen_studio::study::preview::PartPreview;

use super::StudiesPage;
use crate::look::theme::{GAP, GROUP_GAP, tokens};
use crate::strings::studies as strings;
use crate::studies::open_study::OpenStudy;

/// Greatest width of a text, in points.
const TEXT_WIDTH: f32 = 640.0;
/// Number of trials that are listed of a part.
const MOST_TRIALS: usize = 12;

/// Draws the preview, or the steps to follow.
pub(super) fn preview_ui(ui: &mut Ui, page: &StudiesPage) {
    ScrollArea::vertical().id_salt("preview of a study").auto_shrink(false).show(ui, |ui| {
        ui.set_max_width(ui.available_width().min(TEXT_WIDTH));
        match &page.open {
            Some(open) => open_ui(ui, open),
            None => empty_ui(ui),
        }
    });
}

fn open_ui(ui: &mut Ui, open: &OpenStudy) {
    let t = tokens(ui.ctx());
    let weak = |ui: &mut Ui, text: &str| {
        ui.add(Label::new(RichText::new(text).color(t.text_weak)).wrap());
    };
    let plan = &open.study.plan;
    ui.add(Label::new(RichText::new(&plan.name).heading().strong()).wrap());
    ui.label(strings::session_length(open.preview.n_trials, open.preview.minutes));
    if open.preview.balanced_multiple > 1 {
        ui.label(strings::balanced(open.preview.balanced_multiple));
    }
    ui.add_space(GAP);
    weak(ui, plan.description.trim());
    ui.add_space(GROUP_GAP);
    for part in &open.preview.parts {
        part_ui(ui, part);
        ui.add_space(GROUP_GAP);
    }
    ui.add(Label::new(RichText::new(strings::CONSENT_TEXT).strong()).selectable(false));
    let consent = plan.consent.trim();
    weak(ui, if consent.is_empty() { strings::NO_CONSENT_TEXT } else { consent });
}

fn part_ui(ui: &mut Ui, part: &PartPreview) {
    let t = tokens(ui.ctx());
    ui.add(Label::new(RichText::new(&part.title).strong()).wrap());
    let n_scored = (part.n_scored, part.is_estimated);
    ui.label(strings::part_line(part.design, part.n_practice, n_scored, part.minutes));
    if !part.stimuli.is_empty() {
        let text = format!("{}: {}", strings::STIMULI, part.stimuli.join(", "));
        ui.add(Label::new(RichText::new(text).color(t.text_weak)).wrap());
    }
    let n_more = part.trials.len().saturating_sub(MOST_TRIALS);
    let listed = part.trials.iter().take(MOST_TRIALS).cloned();
    let more = (n_more > 0).then(|| strings::more_trials(n_more));
    for line in listed.chain(more) {
        ui.add(Label::new(RichText::new(line).small().color(t.text_weak)).wrap());
    }
}

/// Draws the steps to follow before a plan is open.
fn empty_ui(ui: &mut Ui) {
    let t = tokens(ui.ctx());
    ui.add_space(0.1 * ui.clip_rect().height());
    ui.add(Label::new(RichText::new(strings::EMPTY_TITLE).heading().strong()).selectable(false));
    ui.add_space(GAP);
    for (number, step) in (1..).zip(strings::EMPTY_STEPS) {
        ui.add(Label::new(RichText::new(format!("{number}.  {step}")).color(t.text_weak)).wrap());
    }
    ui.add_space(GROUP_GAP);
    ui.add(Label::new(RichText::new(strings::ETHICS).color(t.text_weak)).wrap());
}
