//! Output section: device, settings, a test tone, and meters.

use egui::{Button, Color32, ComboBox, DragValue, ProgressBar, Response, Ui};
use shagreen_device::status::LinkState;
use shagreen_studio::driven_channels::{channel_name, possible_channels};

use super::{DevicesSheet, heading, note, row, warning};
use crate::command::Command;
use crate::look::list::ShowList as _;
use crate::look::theme::tokens;
use crate::session::Session;
use crate::sheets::devices::output_choice_ui::output_choice_ui;
use crate::state::rig::BUFFERS;
use crate::strings::devices as strings;

/// Number of channels offered if the output does not state its own.
const CHANNELS: usize = 8;
/// Height of a meter, and radius of its corners, in points.
const METER_HEIGHT: f32 = 8.0;
const METER_RADIUS: u8 = 2;
/// Sample rate that converts buffer lengths while no output is open, in Hz.
const USUAL_RATE_HZ: f64 = 48_000.0;

impl DevicesSheet {
    pub(super) fn output_ui(&mut self, ui: &mut Ui, session: &Session) -> Vec<Command> {
        let mut commands = Vec::new();
        heading(ui, strings::OUTPUT);
        row(ui, strings::DEVICE, |ui| commands.extend(output_choice_ui(ui, session)));
        let rate_hz = session.stream().map_or(USUAL_RATE_HZ, |(rate_hz, ..)| f64::from(rate_hz));
        row(ui, strings::BUFFER, |ui| {
            let combo = ComboBox::from_id_salt("buffer").width(210.0);
            let shown =
                combo.selected_text(strings::buffer(self.rig.buffer_frames, rate_hz)).show_list(ui, |ui| {
                    for frames in BUFFERS {
                        ui.selectable_value(
                            &mut self.rig.buffer_frames,
                            frames,
                            strings::buffer(frames, rate_hz),
                        );
                    }
                });
            shown.response.accessible_name(strings::BUFFER).on_hover_text(strings::BUFFER_HELP);
        });
        // A haptic pen has no channels.
        if session.haptic_reading().is_none() {
            row(ui, strings::CHANNELS, |ui| self.channels_ui(ui, session));
        }
        if let Some((rate_hz, channels, block_frames)) = session.stream() {
            note(ui, &strings::stream(rate_hz, channels, block_frames));
        }
        if let Some(reading) = session.haptic_reading() {
            let now = reading.now;
            note(
                ui,
                &now.waveform.map_or(strings::HAPTIC_PEN_SILENT.to_owned(), |waveform| {
                    strings::haptic_pen(waveform.name(), now.intensity_percent)
                }),
            );
        }
        if let Some(message) = session.output_message() {
            warning(ui, message);
        }
        meters_ui(ui, session);
        commands.extend(self.tone_ui(ui, session));
        commands
    }

    /// Draws the choice of the channel: all usual ones, or one that the actuator can be connected to.
    fn channels_ui(&mut self, ui: &mut Ui, session: &Session) {
        let n_channels = session.stream().map_or(CHANNELS, |(_, channels, _)| usize::from(channels));
        let possible = possible_channels(self.rig.actuator(), n_channels);
        let all = std::iter::once(None).chain(possible.into_iter().map(Some));
        let choices: Vec<_> = all.map(|channel| (channel, self.channel_label(channel, n_channels))).collect();
        let chosen = self.channel_label(self.rig.channel, n_channels);
        let combo = ComboBox::from_id_salt("channels").width(210.0).truncate().selected_text(chosen);
        let shown = combo.show_list(ui, |ui| {
            for (channel, label) in choices {
                ui.selectable_value(&mut self.rig.channel, channel, label);
            }
        });
        shown.response.accessible_name(strings::CHANNELS).on_hover_text(strings::CHANNELS_HELP);
    }

    /// Label of the driven channels: the only one with its name if it has one, or with `None` the usual ones.
    fn channel_label(&self, channel_idx: Option<usize>, n_channels: usize) -> String {
        let actuator = self.rig.actuator();
        match channel_idx {
            Some(channel_idx) => match channel_name(actuator, n_channels, channel_idx) {
                Some(name) => strings::named_channel(channel_idx, name),
                None => strings::channel(channel_idx),
            },
            None => match actuator.map(|actuator| actuator.channels.as_slice()) {
                None | Some([]) => strings::FIRST_TWO.to_owned(),
                Some(named) => {
                    let names: Vec<&str> = named.iter().map(|channel| channel.name.as_str()).collect();
                    names.join(", ")
                }
            },
        }
    }

    fn tone_ui(&mut self, ui: &mut Ui, session: &Session) -> Option<Command> {
        let mut command = None;
        row(ui, strings::TONE, |ui| {
            let hz = DragValue::new(&mut self.tone_hz).range(10.0..=1000.0).speed(1.0).suffix(" Hz");
            ui.add(hz).accessible_name(strings::TONE_HZ).on_hover_text(strings::TONE_HZ);
            let level = DragValue::new(&mut self.tone_mps2).range(0.01..=50.0).speed(0.05).suffix(" m/s²");
            let level = level.fixed_decimals(2);
            ui.add(level).accessible_name(strings::TONE_LEVEL).on_hover_text(strings::TONE_LEVEL);
            let status = session.status();
            let plays = status.is_some_and(|s| s.plays_signal);
            let can_play = status.is_some_and(|s| s.state == LinkState::Running);
            let button = Button::new(if plays { strings::STOP_TONE } else { strings::PLAY_TONE });
            if ui.add_enabled(can_play, button).on_hover_text(strings::TONE_HELP).clicked() {
                command = Some(if plays {
                    Command::StopTone
                } else {
                    Command::PlayTone { frequency_hz: self.tone_hz, amplitude_mps2: self.tone_mps2 }
                });
            }
        });
        command
    }
}

/// Draws meters of the output peak and of the thermal load of the coil, which is computed from the drive signal.
fn meters_ui(ui: &mut Ui, session: &Session) {
    let t = tokens(ui.ctx());
    let status = session.status().copied().unwrap_or_default();
    row(ui, strings::METER, |ui| {
        let color = if session.is_limiting() { t.warning } else { t.accent };
        meter(ui, status.peak, color).accessible_name(strings::METER).on_hover_text(strings::METER_HELP);
    });
    if session.rig().actuator().is_some_and(|a| a.limits_in_volts().rated_volts_rms.is_some()) {
        row(ui, strings::HEAT, |ui| {
            let color = if status.heat_gain < 0.99 { t.warning } else { t.accent };
            meter(ui, status.heat_used, color)
                .accessible_name(strings::HEAT)
                .on_hover_text(strings::HEAT_HELP);
        });
    }
}

/// Draws a bar with its number beside it, where the number is legible at any level.
fn meter(ui: &mut Ui, share: f32, color: Color32) -> Response {
    // As wide as a slider, but low and without round ends, which would look like its handle.
    let bar = ProgressBar::new(share).desired_width(ui.spacing().slider_width).desired_height(METER_HEIGHT);
    let bar = ui.add(bar.corner_radius(METER_RADIUS).fill(color));
    ui.label(strings::percent(share));
    bar
}
