//! Devices sheet: the output and its actuator, the pen, and their latency.

mod actuator_ui;
mod calibration;
mod calibration_ui;
mod latency_ui;
pub(crate) mod output_choice_ui;
mod output_ui;
mod pen_ui;

use std::sync::mpsc::Receiver;

use egui::{Align, Button, Context, Label, Layout, RichText, ScrollArea, Ui, vec2};
use shagreen_core::actuator::Actuator;
use shagreen_core::units::Kilograms;

use self::calibration_ui::Measurement;
use crate::browse::Browse;
use crate::command::Command;
use crate::look::scroll_to_focus::scroll_to_focus;
use crate::look::sheet_frame::{foot_ui, sheet};
use crate::look::theme::{GAP, GROUP_GAP, SCROLL_BAR_ROOM, tokens};
use crate::session::Session;
use crate::state::rig::{Mounted, Rig};
use crate::strings::devices as strings;

/// Margin around the sheet, in points.
const AROUND: f32 = 24.0;
/// Height of the row with the button that closes the sheet, with the space above it, in points.
const FOOT: f32 = 36.0;
/// Maximum size of the sheet, in points.
const MAX_SIZE: egui::Vec2 = vec2(1040.0, 760.0);

/// State of the open sheet.
pub struct DevicesSheet {
    /// Device setup being edited. It is applied when no control is held any more.
    rig: Rig,
    built_in: Vec<Actuator>,
    load_g: Option<f64>,
    profile_path: String,
    browse: Browse,
    /// Actuator profile that is being read.
    reading: Option<Receiver<anyhow::Result<Actuator>>>,
    message: Option<String>,
    tone_hz: f64,
    tone_mps2: f64,
    measurement: Measurement,
}

impl DevicesSheet {
    /// Sheet that edits a copy of the device setup `rig`.
    pub fn new(rig: &Rig, built_in: Vec<Actuator>) -> Self {
        Self {
            load_g: rig.mounted.as_ref().and_then(Mounted::load).map(Kilograms::g),
            rig: rig.clone(),
            built_in,
            profile_path: String::new(),
            browse: Browse::default(),
            reading: None,
            message: None,
            tone_hz: 100.0,
            tone_mps2: 1.0,
            measurement: Measurement::default(),
        }
    }

    /// Draws the sheet; returns the requested commands.
    pub fn show(&mut self, ctx: &Context, session: &Session) -> Vec<Command> {
        let size = (ctx.content_rect().size() - vec2(2.0 * AROUND, 2.0 * AROUND)).min(MAX_SIZE);
        let inner = size - vec2(28.0, 28.0);
        let shown = sheet(ctx, "devices sheet", |ui| {
            ui.set_min_size(inner);
            ui.set_max_size(inner);
            self.content_ui(ui, session)
        });
        let mut commands = shown.inner;
        self.carry_on_measuring(ctx, session);
        // Dragged values are applied on release: every change of the output interrupts it.
        let is_held = ctx.input(|i| i.pointer.any_down()) || ctx.text_edit_focused();
        if !is_held && !self.measurement.is_running() && self.rig != *session.rig() {
            commands.push(Command::SetRig(Box::new(self.rig.clone())));
        }
        if self.measurement.has_ended() {
            commands.push(Command::TakeOutputBack);
        }
        commands
    }

    /// Whether the actuator is being measured. The sheet then stays.
    pub(crate) fn is_measuring(&self) -> bool {
        self.measurement.is_running()
    }

    fn content_ui(&mut self, ui: &mut Ui, session: &Session) -> Vec<Command> {
        let mut commands = Vec::new();
        ui.add(Label::new(RichText::new(strings::TITLE).heading().strong()).selectable(false));
        ui.add_space(GAP);
        let height = ui.available_height() - FOOT;
        ScrollArea::vertical().max_height(height).auto_shrink(false).show(ui, |ui| {
            let width = 0.5 * (ui.available_width() - 2.0 * GROUP_GAP - SCROLL_BAR_ROOM);
            let column = Layout::top_down(Align::Min);
            ui.horizontal_top(|ui| {
                ui.allocate_ui_with_layout(vec2(width, 0.0), column, |ui| {
                    ui.set_width(width);
                    // During a measurement the output is neither changed nor used for anything else.
                    let is_free = !self.measurement.is_running();
                    commands.extend(ui.add_enabled_ui(is_free, |ui| self.output_ui(ui, session)).inner);
                    ui.add_space(GROUP_GAP);
                    latency_ui::latency_ui(ui, session);
                    // A haptic pen plays no sweep.
                    if session.haptic_reading().is_none() {
                        ui.add_space(GROUP_GAP);
                        commands.extend(self.calibration_ui(ui, session));
                    }
                });
                ui.add_space(GROUP_GAP);
                ui.allocate_ui_with_layout(vec2(width, 0.0), column, |ui| {
                    ui.set_width(width);
                    let is_free = !self.measurement.is_running();
                    ui.add_enabled_ui(is_free, |ui| self.actuator_ui(ui, session));
                    ui.add_space(GROUP_GAP);
                    commands.extend(self.pen_ui(ui, session));
                });
            });
            scroll_to_focus(ui);
        });
        ui.add_space(GAP);
        let is_free = !self.measurement.is_running();
        let close = foot_ui(ui, |ui| ui.add_enabled(is_free, Button::new(strings::CLOSE)));
        if close.clicked() {
            commands.push(Command::CloseSheet);
        }
        commands
    }
}

fn heading(ui: &mut Ui, text: &str) {
    ui.add_space(GAP);
    ui.add(Label::new(RichText::new(text).strong()).selectable(false));
}

fn note(ui: &mut Ui, text: &str) {
    let weak = tokens(ui.ctx()).text_weak;
    ui.add(Label::new(RichText::new(text).small().color(weak)).wrap());
}

fn warning(ui: &mut Ui, text: &str) {
    let color = tokens(ui.ctx()).warning;
    ui.add(Label::new(RichText::new(text).small().color(color)).wrap());
}

/// Draws a row with a label before its control.
fn row(ui: &mut Ui, text: &str, control: impl FnOnce(&mut Ui)) {
    ui.horizontal(|ui| {
        ui.allocate_ui_with_layout(vec2(ROW_LABEL_WIDTH, 20.0), Layout::left_to_right(Align::Center), |ui| {
            ui.set_min_width(ROW_LABEL_WIDTH);
            ui.add(Label::new(text).selectable(false));
        });
        control(ui);
    });
}

/// Width of row labels, in points.
const ROW_LABEL_WIDTH: f32 = 168.0;
