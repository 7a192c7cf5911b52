//! Options of an exported signal.

use egui::{Checkbox, ComboBox, DragValue, Ui};
use shagreen_device::track::MAX_TRACK_SECS;
use shagreen_formats::wav_encoding::{Level, SampleType};
use shagreen_studio::render::SEAM_SECS;

use crate::look::list::ShowList as _;
use crate::state::signal_file::{SignalFile, SignalOptions};
use crate::strings::signal as strings;

/// Shortest and longest duration, in seconds.
const SECS: std::ops::RangeInclusive<f64> = 0.05..=MAX_TRACK_SECS;
/// Sample rates to choose from, in Hz.
const RATES_HZ: [u32; 6] = [4000, 8000, 16_000, 44_100, 48_000, 96_000];

/// Space between a choice and the circle of the next one, in addition to the usual distance, in points.
const BETWEEN_CHOICES: f32 = 14.0;

/// Draws the options; returns whether any has changed. Those of samples are for formats that store samples. `is_all` states
/// whether all authored textures are exported; `None` if there is one only.
pub(super) fn options_ui(
    ui: &mut Ui,
    signal: &SignalFile,
    options: &mut SignalOptions,
    stores_samples: bool,
    is_all: Option<bool>,
) -> bool {
    let before = options.clone();
    let is_of_bench = signal.is_of_bench();
    let has_stroke = signal.stroke.is_some() && !is_of_bench;
    ui.horizontal(|ui| {
        if has_stroke {
            ComboBox::from_id_salt("motion")
                .selected_text(strings::motion(options.follows_stroke))
                .show_list(ui, |ui| {
                    for follows in [false, true] {
                        ui.selectable_value(&mut options.follows_stroke, follows, strings::motion(follows));
                    }
                })
                .response
                .accessible_name(strings::MOTION);
        }
        let has_length = !is_of_bench && !options.follows_stroke;
        ui.label(strings::LENGTH);
        // A loop is rendered a seam longer.
        let longest = SECS.end() - if options.loops { SEAM_SECS } else { 0.0 };
        let length = DragValue::new(&mut options.seconds)
            .range(*SECS.start()..=longest)
            .speed(0.1)
            .suffix(" s")
            .max_decimals(2);
        ui.add_enabled(has_length, length).accessible_name(strings::LENGTH);
        let loops = Checkbox::new(&mut options.loops, strings::LOOP);
        ui.add_enabled(has_length, loops).on_hover_text(strings::LOOP_HELP);
    });
    ui.horizontal(|ui| {
        ui.label(strings::RATE);
        // At least the rate of the model, or its highest frequencies would be folded back.
        let lowest_hz = signal.model_rate.0;
        ComboBox::from_id_salt("rate")
            .selected_text(strings::rate(options.rate_hz))
            .show_list(ui, |ui| {
                for rate_hz in RATES_HZ.into_iter().filter(|rate_hz| f64::from(*rate_hz) >= lowest_hz) {
                    ui.selectable_value(&mut options.rate_hz, rate_hz, strings::rate(rate_hz));
                }
            })
            .response
            .accessible_name(strings::RATE);
        if stores_samples {
            ui.label(strings::SAMPLES);
            let samples = &mut options.encoding.samples;
            ComboBox::from_id_salt("samples")
                .selected_text(strings::samples(*samples))
                .show_list(ui, |ui| {
                    for each in SampleType::ALL {
                        ui.selectable_value(samples, each, strings::samples(each));
                    }
                })
                .response
                .accessible_name(strings::SAMPLES);
        }
        if let Some(is_all) = is_all {
            let is_scaled = !stores_samples || options.encoding.level == Level::Peak;
            let scale = Checkbox::new(&mut options.shares_scale, strings::ONE_SCALE);
            let scale = ui.add_enabled(is_all && is_scaled, scale);
            scale.on_hover_text(strings::ONE_SCALE_HELP).on_disabled_hover_text(strings::NO_ONE_SCALE);
        }
    });
    if stores_samples {
        level_ui(ui, options);
    }
    before != *options
}

/// Draws the choice of the level of samples.
fn level_ui(ui: &mut Ui, options: &mut SignalOptions) {
    ui.horizontal_wrapped(|ui| {
        ui.label(strings::LEVEL);
        let can_keep = options.encoding.samples == SampleType::Float32;
        if !can_keep {
            options.encoding.level = Level::Peak;
        }
        for level in [Level::Peak, Level::Kept] {
            if level != Level::Peak {
                ui.add_space(BETWEEN_CHOICES);
            }
            ui.add_enabled_ui(can_keep || level == Level::Peak, |ui| {
                let choice = ui.radio_value(&mut options.encoding.level, level, strings::level(level));
                choice.on_hover_text(strings::level_help(level));
            });
        }
    });
}
