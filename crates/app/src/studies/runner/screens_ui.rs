//! The whole window while a study runs: the bar above, and below it a trial or a page of text.

use egui::{
    Align, Button, CentralPanel, FontFamily, FontId, Frame, Label, Layout, Margin, Panel as Side, RichText,
    ScrollArea, TextStyle, Ui, vec2,
};

use shagreen_core::people::study::plan::Part;

use super::actions::{Action, Asked};
use super::stimuli_ui::TARGET;
use super::trial_ui::{Around, trial_ui};
use super::{Runner, RunnerInput, Screen, Unsaved};
use crate::look::icons::close_button;
use crate::look::primary::primary_button;
use crate::look::theme::{GAP, GROUP_GAP, tokens};
use crate::state::mouse_report::MouseReport;
use crate::strings::studies as strings;

/// Height of the bar above, in points.
const HEAD: f32 = 56.0;
/// Greatest width of a text, in points.
const TEXT_WIDTH: f32 = 680.0;
/// Sizes of the texts that participants read, in points.
const SIZES: [(TextStyle, f32); 4] = [
    (TextStyle::Small, 14.0),
    (TextStyle::Body, 16.0),
    (TextStyle::Button, 16.0),
    (TextStyle::Heading, 22.0),
];

/// A page of text with its buttons.
struct Page<'a> {
    title: String,
    text: &'a str,
    /// Whether the text says that something is wrong.
    is_problem: bool,
    /// Buttons, the main one first.
    buttons: Vec<(&'a str, Action)>,
}

impl Runner {
    /// Draws the window; returns what is asked for, and the pointer while it strokes.
    pub(super) fn screen_ui(&mut self, ui: &mut Ui, input: &RunnerInput<'_>) -> (Asked, Option<MouseReport>) {
        for (style, size) in SIZES {
            ui.style_mut().text_styles.insert(style, FontId::new(size, FontFamily::Proportional));
        }
        ui.spacing_mut().interact_size.y = TARGET;
        let t = tokens(ui.ctx());
        let bar = Frame::new().fill(t.raised).inner_margin(Margin::symmetric(14, 4));
        let mut asked = Asked::default();
        Side::top("head of a study").exact_size(HEAD).frame(bar).show(ui, |ui| {
            asked.merge(self.head_ui(ui));
        });
        let is_hidden = self.is_asked_to_leave || self.unsaved.is_some();
        if let Screen::Trial(state) = &self.screen
            && !is_hidden
        {
            let part = self.session.plan().part(&state.trial.part);
            let around = Around {
                instructions: part.map_or("", |part| part.instructions.as_str()),
                is_stroking: self.is_stroking,
                problem: self.problem.as_deref(),
            };
            let (of_trial, mouse) = trial_ui(ui, input, &mut self.stage, state, around);
            asked.merge(of_trial);
            return (asked, mouse);
        }
        let frame = Frame::new().fill(t.panel).inner_margin(Margin::same(14));
        CentralPanel::default().frame(frame).show(ui, |ui| asked.merge(page_ui(ui, &self.page())));
        (asked, None)
    }

    /// Draws the title, who takes part, the progress, and the button that leaves the study.
    fn head_ui(&self, ui: &mut Ui) -> Asked {
        let t = tokens(ui.ctx());
        let mut asked = Asked::default();
        let plan = self.session.plan();
        let title = self.session.next_part().map_or(plan.name.as_str(), title_of);
        ui.horizontal_centered(|ui| {
            let close = close_button(ui.ctx()).min_size(vec2(TARGET, TARGET));
            let close = ui.add(close).accessible_name(strings::LEAVE).on_hover_text(strings::LEAVE_HELP);
            if close.clicked() {
                asked.ask(Action::AskToLeave);
            }
            // The title comes last, because it takes what the others leave.
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let label =
                    |text: String, color| Label::new(RichText::new(text).color(color)).selectable(false);
                if matches!(self.screen, Screen::Trial(_) | Screen::Pause { .. }) {
                    ui.add(label(strings::progress(self.session.counts()), t.text));
                    ui.add_space(GROUP_GAP);
                }
                if self.session.is_practice() || self.is_practice_trial() {
                    ui.add(label(strings::PRACTICE.to_owned(), t.accent));
                    ui.add_space(GROUP_GAP);
                }
                if self.session.is_simulated() {
                    ui.add(label(strings::SIMULATED.to_owned(), t.warning));
                }
                ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                    ui.add(Label::new(RichText::new(title).heading().strong()).truncate().selectable(false));
                });
            });
        });
        asked
    }

    fn is_practice_trial(&self) -> bool {
        matches!(&self.screen, Screen::Trial(state) if state.trial.is_practice)
    }

    /// Page of text on the screen; a trial has none.
    fn page(&self) -> Page<'_> {
        let page =
            |title: &str, text, buttons| Page { title: title.to_owned(), text, is_problem: false, buttons };
        if self.is_asked_to_leave {
            let text = if self.session.is_practice() {
                strings::LEAVE_PRACTICE
            } else if self.unsaved.is_some() {
                strings::LEAVE_UNSAVED
            } else if self.session.counts().n_answered == 0 {
                strings::LEAVE_BEFORE
            } else {
                strings::LEAVE_SAVED
            };
            let buttons = vec![(strings::STAY, Action::Stay), (strings::LEAVE_NOW, Action::Leave)];
            return page(strings::LEAVE_TITLE, text, buttons);
        }
        if let Some(Unsaved { reason, .. }) = &self.unsaved {
            let buttons =
                vec![(strings::TRY_AGAIN, Action::TryAgain), (strings::LEAVE_PAGE, Action::AskToLeave)];
            return Page { is_problem: true, ..page(strings::NOT_SAVED_TITLE, reason, buttons) };
        }
        let go_on = |name| vec![(name, Action::GoOn)];
        match &self.screen {
            Screen::Consent => {
                let buttons = vec![(strings::AGREE, Action::GoOn), (strings::DISAGREE, Action::Refuse)];
                page(strings::CONSENT, self.session.plan().consent.trim(), buttons)
            }
            Screen::Instructions => {
                let part = self.session.next_part();
                let text = part.map_or("", |part| part.instructions.trim());
                Page { title: self.part_title(), ..page("", text, go_on(strings::BEGIN)) }
            }
            Screen::PracticeOver => {
                page(strings::PRACTICE_OVER, strings::PRACTICE_OVER_HELP, go_on(strings::BEGIN))
            }
            Screen::Break => page(strings::BREAK, strings::BREAK_HELP, go_on(strings::CONTINUE)),
            Screen::Pause { is_right: Some(is_right), .. } => {
                page(if *is_right { strings::RIGHT_ANSWER } else { strings::WRONG_ANSWER }, "", Vec::new())
            }
            Screen::Pause { is_right: None, .. } | Screen::Trial(_) => page("", "", Vec::new()),
            Screen::Done => {
                let text =
                    if self.session.is_practice() { strings::PRACTICE_DONE } else { strings::DONE_HELP };
                page(strings::DONE, text, vec![(strings::CLOSE, Action::Leave)])
            }
            Screen::Refused => {
                page(strings::REFUSED, strings::REFUSED_HELP, vec![(strings::CLOSE, Action::Leave)])
            }
            Screen::Broken(reason) => {
                let buttons = vec![(strings::LEAVE_PAGE, Action::AskToLeave)];
                Page { is_problem: true, ..page(strings::BROKEN, reason, buttons) }
            }
        }
    }

    /// Heading of the part that comes next, with its number.
    fn part_title(&self) -> String {
        let title = self.session.next_part().map_or("", title_of);
        match self.session.place() {
            Some(place) if place.n_parts > 1 => strings::part_title(place.part_number, place.n_parts, title),
            _ => title.to_owned(),
        }
    }
}

/// Heading of a part.
fn title_of(part: &Part) -> &str {
    if part.title.trim().is_empty() { &part.id } else { &part.title }
}

/// Draws a page of text in the middle.
fn page_ui(ui: &mut Ui, page: &Page<'_>) -> Asked {
    let t = tokens(ui.ctx());
    let mut asked = Asked::default();
    ScrollArea::vertical().id_salt("page of a study").auto_shrink(false).show(ui, |ui| {
        ui.add_space(0.12 * ui.clip_rect().height());
        let width = ui.available_width().min(TEXT_WIDTH);
        ui.horizontal_top(|ui| {
            ui.add_space(0.5 * (ui.available_width() - width));
            ui.vertical(|ui| {
                ui.set_max_width(width);
                if !page.title.is_empty() {
                    let title = RichText::new(&page.title).heading().strong();
                    ui.add(Label::new(title).wrap().selectable(false));
                    ui.add_space(GROUP_GAP);
                }
                let color = if page.is_problem { t.error } else { t.text };
                if !page.text.is_empty() {
                    ui.add(Label::new(RichText::new(page.text).color(color)).wrap());
                    ui.add_space(2.0 * GROUP_GAP);
                }
                ui.horizontal(|ui| {
                    ui.spacing_mut().item_spacing.x = 2.0 * GAP;
                    for (index, (name, action)) in page.buttons.iter().enumerate() {
                        let text = RichText::new(*name).strong();
                        let button =
                            if index == 0 { primary_button(t, text, true) } else { Button::new(text) };
                        if ui.add(button.min_size(vec2(3.0 * TARGET, TARGET))).clicked() {
                            asked.ask(action.clone());
                        }
                    }
                });
            });
        });
    });
    asked
}
