//! Scope: two views of the output signal, side by side. They can be frozen, measured with the pointer and saved as
//! figures.

mod trace_ui;
pub mod view;

use std::sync::Arc;

use egui::{Align, Color32, ComboBox, Label, Layout, RichText, TextStyle, Ui, vec2};
use shagreen_formats::figure::Figure;
use shagreen_formats::library::id_from_name;
use shagreen_formats::thresholds::ThresholdKind;

use self::trace_ui::{Span, trace_ui};
use self::view::{Seen, level_now};
use crate::choices::scope::View;
use crate::command::Command;
use crate::look::list::ShowList as _;
use crate::look::theme::{GAP, tokens};
use crate::panel::Panel;
use crate::session::Spectra;
use crate::state::figure_file::{FigureFile, FigureFormat};
use crate::state::scope_buffer::ScopeBuffer;
use crate::strings::{self, scope as words};

/// Share of the width that the left view takes.
const LEFT_SHARE: f32 = 0.45;
/// Width needed for the threshold menu, in points.
const THRESHOLD_WIDTH: f32 = 96.0;
/// Width of the view choice, in points.
const CHOICE_WIDTH: f32 = 112.0;

/// State of the scope: views, measurements, detection threshold and frozen data.
pub struct ScopeState {
    views: [View; 2],
    spans: [Option<Span>; 2],
    kind: ThresholdKind,
    /// Whether each view had no room for the threshold menu in the last frame.
    is_crowded: [bool; 2],
    frozen: Option<Box<Frozen>>,
}

/// Data of a frozen scope.
struct Frozen {
    buffer: ScopeBuffer,
    spectra: Spectra,
    parents: Vec<String>,
    texture: String,
}

impl Default for ScopeState {
    fn default() -> Self {
        Self {
            views: [View::Waveform, View::Spectrum],
            spans: [None, None],
            kind: ThresholdKind::default(),
            is_crowded: [false; 2],
            frozen: None,
        }
    }
}

impl ScopeState {
    /// Whether the scope is frozen.
    pub fn is_frozen(&self) -> bool {
        self.frozen.is_some()
    }

    /// Freezes the data of `panel`, or returns to the live signal. A hidden signal of a blind comparison cannot be
    /// frozen.
    pub fn toggle_freeze(&mut self, panel: &Panel<'_>) {
        self.frozen = match self.frozen {
            Some(_) => None,
            None if panel.session.is_hidden() => None,
            None => Some(Box::new(Frozen {
                buffer: panel.session.scope().clone(),
                spectra: panel.session.spectra().clone(),
                parents: parents_of(panel),
                texture: panel.heard_name(),
            })),
        };
    }
}

/// Names of the contributing textures that are shown.
fn parents_of(panel: &Panel<'_>) -> Vec<String> {
    let name = |(texture, _): &(usize, f64)| panel.session.textures()[*texture].name.clone();
    panel.session.shown_parents().iter().map(name).collect()
}

/// Draws both views; returns the requested commands.
pub fn scope_ui(ui: &mut Ui, panel: &Panel<'_>, state: &mut ScopeState) -> Vec<Command> {
    let mut commands = Vec::new();
    if panel.session.is_hidden() {
        let text = RichText::new(strings::compare::HIDDEN).color(tokens(ui.ctx()).text_weak);
        ui.centered_and_justified(|ui| ui.add(Label::new(text).selectable(false)));
        return commands;
    }
    let threshold = match state.kind.read() {
        Ok(threshold) => threshold,
        Err(error) => {
            ui.colored_label(tokens(ui.ctx()).error, error.to_string());
            return commands;
        }
    };
    let (parents, texture) = (parents_of(panel), panel.heard_name());
    // Put back below: the frozen data is read while the rest of the state changes.
    let frozen = state.frozen.take();
    let live = Seen {
        buffer: panel.session.scope(),
        spectra: panel.session.spectra(),
        parents: &parents,
        texture: &texture,
        threshold: &threshold,
        kind: state.kind,
        is_simulated: panel.session.is_simulated(),
    };
    let seen = frozen.as_ref().map_or(live, |held| Seen {
        buffer: &held.buffer,
        spectra: &held.spectra,
        parents: &held.parents,
        texture: &held.texture,
        ..live
    });
    let (width, height) = ((ui.available_width() - GAP).max(0.0), ui.available_height().max(0.0));
    ui.horizontal_top(|ui| {
        for (side, share) in [(0, LEFT_SHARE), (1, 1.0 - LEFT_SHARE)] {
            let top_down = Layout::top_down(Align::Min);
            ui.allocate_ui_with_layout(vec2(share * width, height), top_down, |ui| {
                commands.extend(view_ui(ui, state, side, &seen, frozen.is_some()));
            });
        }
    });
    state.frozen = frozen;
    commands
}

/// Draws one view below its row of controls.
fn view_ui(
    ui: &mut Ui,
    state: &mut ScopeState,
    side: usize,
    seen: &Seen<'_>,
    is_frozen: bool,
) -> Vec<Command> {
    let mut commands = Vec::new();
    let figure = state.views[side].figure(seen);
    ui.horizontal(|ui| {
        choice_ui(ui, state, side);
        let view = state.views[side];
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            commands.extend(save_ui(ui, view, side, seen, &figure));
            if side == 1 {
                commands.extend(freeze_ui(ui, is_frozen));
            }
            // In a narrow view, the list of views has the thresholds.
            let has_threshold = matches!(view, View::Spectrum | View::Level);
            state.is_crowded[side] = has_threshold && ui.available_width() <= THRESHOLD_WIDTH;
            if has_threshold && !state.is_crowded[side] {
                ui.menu_button(words::THRESHOLD, |ui| thresholds_ui(ui, state))
                    .response
                    .on_hover_text(words::THRESHOLD_HELP);
            }
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                said_ui(ui, view, state.spans[side], seen);
            });
        });
    });
    trace_ui(ui, state.views[side], side, &figure, &mut state.spans[side]);
    commands
}

/// Draws the choice of the view.
fn choice_ui(ui: &mut Ui, state: &mut ScopeState, side: usize) {
    let before = state.views[side];
    let choice = ComboBox::from_id_salt(("view of the scope", side))
        .width(CHOICE_WIDTH)
        .selected_text(RichText::new(words::view(before)).strong());
    let shown = choice.show_list(ui, |ui| {
        for view in View::ALL {
            ui.selectable_value(&mut state.views[side], view, words::view(view))
                .on_hover_text(words::view_help(view));
        }
        if state.is_crowded[side] {
            ui.separator();
            let heading = Label::new(RichText::new(words::THRESHOLD).small()).selectable(false);
            ui.add(heading).on_hover_text(words::THRESHOLD_HELP);
            thresholds_ui(ui, state);
        }
    });
    shown.response.accessible_name(words::VIEWS[side]).on_hover_text(words::VIEW_HELP);
    if state.views[side] != before {
        state.spans[side] = None;
    }
}

/// Draws the measurement, or else the current level or the unit.
fn said_ui(ui: &mut Ui, view: View, span: Option<Span>, seen: &Seen<'_>) {
    let t = tokens(ui.ctx());
    let now = if view == View::Level { level_now(seen) } else { None };
    let (text, help, color) = match (span, now) {
        (Some(span), _) => {
            let measured = view.measured(seen, span.from, span.to);
            (measured.clone(), format!("{measured}\n{}", words::measured_help(view)), t.text)
        }
        (None, Some((level_db, multiple))) => {
            (words::level_now(level_db, multiple), words::level_now_in_full(level_db, multiple), t.text)
        }
        (None, None) if fits(ui, words::unit(view)) => {
            (words::unit(view).to_owned(), words::view_help(view).to_owned(), t.text_weak)
        }
        (None, None) => {
            let help = format!("{}\n{}", words::unit(view), words::view_help(view));
            (words::short_unit(view).to_owned(), help, t.text_weak)
        }
    };
    let label = Label::new(RichText::new(text).small().color(color)).truncate().selectable(false);
    ui.add(label.show_tooltip_when_elided(false)).on_hover_text(help);
}

/// Whether a small text fits into the rest of the row.
fn fits(ui: &Ui, text: &str) -> bool {
    let font = TextStyle::Small.resolve(ui.style());
    let galley = ui.painter().layout_no_wrap(text.to_owned(), font, Color32::PLACEHOLDER);
    galley.size().x <= ui.available_width()
}

/// Draws the choice of detection thresholds.
fn thresholds_ui(ui: &mut Ui, state: &mut ScopeState) {
    for kind in ThresholdKind::ALL {
        ui.selectable_value(&mut state.kind, kind, words::threshold(kind))
            .on_hover_text(words::threshold_help(kind));
    }
}

fn freeze_ui(ui: &mut Ui, is_frozen: bool) -> Option<Command> {
    let button = egui::Button::new(words::FREEZE).selected(is_frozen);
    ui.add(button).on_hover_text(words::FREEZE_HELP).clicked().then_some(Command::ToggleFreeze)
}

/// Draws the menu of file formats.
fn save_ui(ui: &mut Ui, view: View, side: usize, seen: &Seen<'_>, figure: &Figure) -> Option<Command> {
    let mut asked = None;
    let menu = ui.menu_button(words::SAVE, |ui| {
        for format in FigureFormat::ALL {
            if ui.button(format.word()).clicked() {
                asked = Some(format);
            }
        }
    });
    menu.response.accessible_name(words::SAVES[side]).on_hover_text(words::SAVE_HELP);
    asked.map(|format| {
        let simulated = if seen.is_simulated { "simulated-" } else { "" };
        let stem = format!("{simulated}{}-{}", view.stem(), id_from_name(seen.texture));
        Command::SaveFigure(FigureFile { stem, figure: Arc::new(figure.clone()), format })
    })
}
