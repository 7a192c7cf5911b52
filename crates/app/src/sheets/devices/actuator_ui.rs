//! Actuator section: its profile, load, amplifier and limits.

use std::sync::mpsc::{Receiver, TryRecvError};

use anyhow::{Context as _, anyhow};
use egui::{Button, Checkbox, ComboBox, DragValue, TextEdit, Ui};
use egui_plot::{GridMark, Line, Plot, PlotPoints};
use shagreen_core::actuator::{Actuator, MAX_CHANNEL};
use shagreen_core::units::{Hertz, Kilograms};
use shagreen_device::synth::equalizer::Biquad;
use shagreen_formats::actuator_toml::read_actuator;
use shagreen_studio::driven_channels::possible_channels;

use super::{DevicesSheet, heading, note, row, warning};
use crate::browse::Asked;
use crate::look::list::ShowList as _;
use crate::look::plot::fixed;
use crate::look::theme::tokens;
use crate::session::Session;
use crate::state::background::in_background;
use crate::state::rig::{FULL_SCALES_MPS2, FULL_SCALES_VOLTS, Mounted};
use crate::state::source::Source;
use crate::strings::devices as strings;

/// Height of the graph, in points.
const HEIGHT: f32 = 110.0;
/// Sample rate at which the equalizer is drawn, in Hz.
const DRAWN_RATE_HZ: f64 = 48_000.0;

impl DevicesSheet {
    pub(super) fn actuator_ui(&mut self, ui: &mut Ui, session: &Session) {
        heading(ui, strings::ACTUATOR);
        if session.haptic_reading().is_some() {
            self.of_haptic_pen_ui(ui);
            return;
        }
        row(ui, strings::DEVICE, |ui| self.choice_ui(ui));
        row(ui, strings::PROFILE_PATH, |ui| self.file_ui(ui));
        self.browse.missing_ui(ui);
        if let Some(message) = &self.message {
            warning(ui, message);
        }
        if let Some(missing) = &self.rig.missing {
            warning(ui, &missing.reason);
            return;
        }
        let Some(mounted) = self.rig.mounted.clone() else {
            self.full_scale_ui(ui);
            return;
        };
        if mounted.actuator().is_proportional() {
            self.full_scale_ui(ui);
            note(ui, strings::PROPORTIONAL);
            note(ui, &mounted.actuator().source);
            return;
        }
        row(ui, strings::VOLTS, |ui| {
            let value = DragValue::new(&mut self.rig.full_scale_volts).range(FULL_SCALES_VOLTS).speed(0.01);
            ui.add(value.suffix(" V")).accessible_name(strings::VOLTS).on_hover_text(strings::VOLTS_HELP);
        });
        if let Some(load_g) = &mut self.load_g {
            let before = *load_g;
            row(ui, strings::LOAD, |ui| {
                let value = DragValue::new(load_g).range(1.0..=2000.0).speed(1.0).suffix(" g");
                ui.add(value).accessible_name(strings::LOAD).on_hover_text(strings::LOAD_HELP);
            });
            if *load_g != before {
                let load = Kilograms::from_g(*load_g);
                self.take(Some(mounted.profile().clone()), Some(load));
            }
        }
        let actuator = mounted.actuator();
        match actuator.response() {
            Ok(response) => {
                let equalize = Checkbox::new(&mut self.rig.equalizes, strings::EQUALIZE);
                ui.add(equalize).on_hover_text(strings::EQUALIZE_HELP);
                let load_g = actuator.measured.and_then(|m| m.load).map(Kilograms::g);
                let (hz, q, gain) = (response.resonance().0, response.q(), response.gain_mps2_per_v());
                note(ui, &strings::response(hz, q, gain, load_g));
                response_ui(ui, actuator, self.rig.equalizes);
            }
            Err(error) => warning(ui, &error.to_string()),
        }
        let limits = actuator.limits_in_volts();
        note(ui, &strings::limits(limits.rated_volts_rms.map(|v| v.0), limits.peak_volts.map(|v| v.0)));
        if let Some(text) = actuator.limits_warning() {
            warning(ui, &text.to_string());
        }
        note(ui, &actuator.source);
    }

    /// Draws the section for a haptic pen: an actuator that was chosen for another output can be left out.
    fn of_haptic_pen_ui(&mut self, ui: &mut Ui) {
        note(ui, strings::NO_ACTUATOR_ON_PEN);
        let is_chosen = self.rig.mounted.is_some() || self.rig.missing.is_some();
        if is_chosen && ui.button(strings::LEAVE_ACTUATOR_OUT).clicked() {
            self.take(None, None);
        }
        if self.rig.actuator().is_none_or(Actuator::is_proportional) {
            self.full_scale_ui(ui);
        }
    }

    fn full_scale_ui(&mut self, ui: &mut Ui) {
        row(ui, strings::FULL_SCALE, |ui| {
            let value = DragValue::new(&mut self.rig.full_scale_mps2).range(FULL_SCALES_MPS2).speed(0.1);
            let value = value.suffix(" m/s²");
            ui.add(value).accessible_name(strings::FULL_SCALE).on_hover_text(strings::FULL_SCALE_HELP);
        });
    }

    fn choice_ui(&mut self, ui: &mut Ui) {
        let is_missing = self.rig.missing.is_some();
        let none = if is_missing { strings::MISSING } else { strings::UNCALIBRATED };
        let chosen = self.rig.actuator().map_or(none, |a| a.name.as_str()).to_owned();
        let mut taken = None;
        let combo = ComboBox::from_id_salt("actuator").width(260.0).truncate().selected_text(&chosen);
        let shown = combo.show_list(ui, |ui| {
            if ui.selectable_label(self.rig.mounted.is_none() && !is_missing, strings::UNCALIBRATED).clicked()
            {
                taken = Some(None);
            }
            for actuator in &self.built_in {
                let is_chosen = self.rig.mounted.as_ref().is_some_and(|m| m.profile() == actuator);
                if ui.selectable_label(is_chosen, &actuator.name).on_hover_text(&actuator.maker).clicked() {
                    taken = Some(Some(actuator.clone()));
                }
            }
        });
        shown.response.accessible_name(strings::ACTUATOR).on_hover_text(strings::ACTUATOR_HELP);
        if let Some(actuator) = taken {
            self.take(actuator, None);
        }
    }

    fn file_ui(&mut self, ui: &mut Ui) {
        let field = TextEdit::singleline(&mut self.profile_path).hint_text(strings::PROFILE_HINT);
        ui.add(field.desired_width(130.0)).accessible_name(strings::PROFILE_PATH);
        let asked = Asked {
            title: strings::ACTUATOR,
            kind: strings::PROFILES,
            endings: &["toml"],
            ..Asked::default()
        };
        let chosen = self.browse.show(ui, strings::PROFILE_PATH, &asked).into_iter().next();
        let is_chosen = chosen.is_some();
        if let Some(chosen) = chosen {
            self.profile_path = chosen.display().to_string();
        }
        let path = self.profile_path.trim().to_owned();
        let can_read = !path.is_empty() && self.reading.is_none();
        if ui.add_enabled(can_read, Button::new(strings::OPEN_PROFILE)).clicked() || is_chosen {
            let read = move || {
                let bytes = Source::Path(path.clone().into()).bytes().map_err(anyhow::Error::msg);
                let actuator = bytes.and_then(|bytes| Ok(read_actuator(&bytes)?));
                actuator.with_context(|| strings::unreadable_profile(&path))
            };
            self.reading = Some(in_background(ui.ctx().clone(), read));
        }
        let read = match self.reading.as_ref().map(Receiver::try_recv) {
            None | Some(Err(TryRecvError::Empty)) => return,
            Some(Err(TryRecvError::Disconnected)) => Err(anyhow!(strings::READING_BROKEN)),
            Some(Ok(read)) => read,
        };
        self.reading = None;
        match read {
            Ok(actuator) => {
                if let Some(volts) = actuator.calibrated.map(|c| c.full_scale.0) {
                    // The profile was measured at this full-scale voltage and is valid for it.
                    self.rig.full_scale_volts = volts;
                }
                self.take(Some(actuator), None);
            }
            Err(error) => self.message = Some(format!("{error:#}")),
        }
    }

    /// Uses an actuator profile, on another load than its own if `load` is given.
    pub(super) fn take(&mut self, profile: Option<Actuator>, load: Option<Kilograms>) {
        match profile.map(|profile| Mounted::new(profile, load)).transpose() {
            Ok(mounted) => {
                if load.is_none() {
                    self.load_g = mounted.as_ref().and_then(Mounted::load).map(Kilograms::g);
                }
                (self.rig.mounted, self.rig.missing, self.message) = (mounted, None, None);
                let possible = possible_channels(self.rig.actuator(), usize::from(MAX_CHANNEL));
                self.rig.channel = self.rig.channel.filter(|channel_idx| possible.contains(channel_idx));
            }
            Err(error) => self.message = Some(error.to_string()),
        }
    }
}

/// Draws the frequency response of the actuator, with and without the equalizer.
fn response_ui(ui: &mut Ui, actuator: &Actuator, equalizes: bool) {
    let t = tokens(ui.ctx());
    let Ok(response) = actuator.response() else { return };
    let inverse = Biquad::bounded_inverse((&response).into(), actuator.lowest.0, DRAWN_RATE_HZ);
    let frequencies = (0..120).map(|i| 10.0 * 100.0_f64.powf(f64::from(i) / 119.0));
    let db = |share: f64| 20.0 * share.max(1e-6).log10();
    let gain = response.gain_mps2_per_v();
    let bare: PlotPoints<'_> =
        frequencies.clone().map(|hz| [hz.log10(), db(response.magnitude_at(Hertz(hz)) / gain)]).collect();
    let equalized: PlotPoints<'_> = frequencies
        .map(|hz| [hz.log10(), db(response.magnitude_at(Hertz(hz)) * inverse.gain(hz, DRAWN_RATE_HZ))])
        .collect();
    let marks = |_: egui_plot::GridInput| {
        [10.0_f64, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0]
            .map(|hz| GridMark { value: hz.log10(), step_size: 0.3 })
            .to_vec()
    };
    fixed(Plot::new("response"), t.line)
        .height(HEIGHT)
        .x_grid_spacer(marks)
        .x_axis_formatter(|mark, _| format!("{:.0} Hz", 10.0_f64.powf(mark.value)))
        .y_axis_formatter(|mark, _| format!("{:.0} dB", mark.value + 0.0))
        .y_grid_spacer(egui_plot::uniform_grid_spacer(|_| [40.0, 20.0, 20.0]))
        .show(ui, |plot| {
            plot.set_plot_bounds_x(0.96..=3.06);
            plot.set_plot_bounds_y(-40.0..=30.0);
            let (weak, strong) = (t.text_weak, t.accent);
            plot.line(Line::new("", bare).color(if equalizes { weak } else { strong }).width(1.5));
            if equalizes {
                plot.line(Line::new("", equalized).color(strong).width(2.0));
            }
        });
}
