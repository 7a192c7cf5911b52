//! Card of a slot: its signal, the source of the next one, and buttons that play or feel it.

use egui::{Align, Button, ComboBox, DragValue, Frame, Key, Label, Layout, RichText, TextEdit, Ui, vec2};
use shagreen_core::signals::codec::bitrate::Bitrate;
use shagreen_core::units::{MetersPerSecond, Newtons};

use super::ResynthesisSettings;
use super::number_ui::number_ui;
use super::reading::{FileKind, Terms};
use super::slot::Place;
use crate::choices::signals::FromA;
use crate::choices::signals::Slot;
use crate::command::Command;
use crate::command::signals::SignalsCommand;
use crate::look::icons::{ICON_PLAY_ARROW, ICON_STOP, close_button, icon_button};
use crate::look::list::ShowList as _;
use crate::look::theme::{RADIUS, SCROLL_BAR_ROOM, tokens};
use crate::state::source::paths_in;
use crate::strings::signals as strings;

/// Range of tip speeds, in mm/s.
const SPEEDS_MM_PER_S: std::ops::RangeInclusive<f64> = 1.0..=1000.0;
/// Range of normal forces, in N.
const FORCES_N: std::ops::RangeInclusive<f64> = 0.05..=10.0;
/// Range of picture widths, in mm.
const WIDTHS_MM: std::ops::RangeInclusive<f64> = 1.0..=2000.0;
/// Range of RMS levels, in m/s².
const LEVELS_MPS2: std::ops::RangeInclusive<f64> = 0.01..=100.0;
/// Highest row of a picture that can be entered. A row that does not exist is reported.
const MAX_ROW: f64 = 100_000.0;
/// Range of accelerations of a sample of 1.0, in m/s².
const FULL_SCALES_MPS2: std::ops::RangeInclusive<f64> = 0.001..=10_000.0;
/// Highest channel that can be entered. A channel that does not exist is reported.
const MAX_CHANNEL: f64 = 64.0;
/// Maximum number of Griffin-Lim iterations.
const MAX_REFINEMENTS: usize = 200;

/// Requests of the user about a slot.
#[derive(Default)]
pub(super) struct Asked {
    pub(super) commands: Vec<Command>,
    /// Whether the signal is to be made from its file again.
    pub(super) is_again: bool,
    /// Whether the slot is to be emptied.
    pub(super) is_cleared: bool,
}

/// Present use of the signal in a slot.
#[derive(Clone, Copy)]
pub(super) struct State {
    /// Whether the pen feels it.
    pub(super) is_felt: bool,
    /// Whether it is played at its own speed.
    pub(super) is_playing: bool,
}

/// Draws the card of a slot.
pub(super) fn place_ui(ui: &mut Ui, slot: Slot, place: &mut Place, state: State) -> Asked {
    let t = tokens(ui.ctx());
    let mut asked = Asked::default();
    Frame::new().fill(t.raised).corner_radius(RADIUS).inner_margin(8.0).show(ui, |ui| {
        ui.set_width(ui.available_width() - SCROLL_BAR_ROOM);
        head_ui(ui, slot, place, state, &mut asked);
        facts_ui(ui, place);
        ui.add_space(2.0);
        source_ui(ui, slot, place, &mut asked);
        asked.is_again = terms_ui(ui, slot, place);
        for (lines, color) in [(place.warnings.as_slice(), t.warning), (place.failure.as_slice(), t.error)] {
            for line in lines {
                ui.add(Label::new(RichText::new(line).small().color(color)).wrap());
            }
        }
    });
    asked
}

/// Draws the letter and the buttons that need a signal, and the name below them.
fn head_ui(ui: &mut Ui, slot: Slot, place: &Place, state: State, asked: &mut Asked) {
    let State { is_felt, is_playing } = state;
    let t = tokens(ui.ctx());
    let has_signal = place.signal().is_some();
    ui.horizontal(|ui| {
        let letter = RichText::new(slot.name()).heading().strong().color(slot_color(ui, slot));
        ui.add(Label::new(letter).selectable(false));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            // It is there without a signal too, so that the buttons beside it do not move.
            let cross = ui.add_enabled(has_signal, close_button(ui.ctx()));
            let name = strings::remove(slot);
            asked.is_cleared = cross.accessible_name(&name).on_hover_text(name).clicked();
            let feel = Button::selectable(is_felt, strings::FEEL);
            let feel = ui.add_enabled(has_signal, feel).accessible_name(strings::feel(slot));
            if feel.on_hover_text(strings::feel_help(slot)).clicked() {
                let wanted = (!is_felt).then_some(slot);
                asked.commands.push(Command::Signals(SignalsCommand::Feel(wanted)));
            }
            let (icon, name) = if is_playing {
                (ICON_STOP, strings::stop(slot))
            } else {
                (ICON_PLAY_ARROW, strings::play(slot))
            };
            // As high as the button beside it.
            let play = icon_button(icon).small().min_size(vec2(0.0, ui.spacing().interact_size.y));
            let play = ui.add_enabled(has_signal, play);
            let play = play.accessible_name(name);
            if play.on_hover_text(strings::PLAY_HELP).clicked() {
                let play = Command::Signals(SignalsCommand::Play(slot));
                asked.commands.push(if is_playing { Command::StopTone } else { play });
            }
        });
    });
    // A row of its own: beside the buttons, two names of the same texture would be cut to the same words.
    let name = place.signal().map_or(strings::NOTHING_THERE, |signal| &signal.name);
    let color = if has_signal { t.text } else { t.text_weak };
    let label = Label::new(RichText::new(name).color(color)).truncate().selectable(false);
    ui.add(label.show_tooltip_when_elided(false)).on_hover_text(name);
}

/// Draws the facts of the signal. The row is there without a signal too, so that nothing below it moves.
fn facts_ui(ui: &mut Ui, place: &Place) {
    let t = tokens(ui.ctx());
    let said = match place.signal() {
        _ if place.is_making() => strings::MAKING.to_owned(),
        Some(signal) => strings::facts(
            signal.seconds(),
            1e3 * signal.profile.length_m(),
            signal.level_mps2(),
            signal.speed.mm_per_s(),
        ),
        None => " ".to_owned(),
    };
    ui.add(Label::new(RichText::new(said).small().color(t.text_weak)).truncate().selectable(false));
}

/// Draws the sources of the next signal.
fn source_ui(ui: &mut Ui, slot: Slot, place: &mut Place, asked: &mut Asked) {
    ui.horizontal(|ui| {
        let heard = Button::new(strings::TAKE_HEARD);
        if ui
            .add(heard)
            .accessible_name(strings::take_heard(slot))
            .on_hover_text(strings::TAKE_HEARD_HELP)
            .clicked()
        {
            asked.commands.push(Command::Signals(SignalsCommand::TakeHeard(slot)));
        }
        let open = Button::new(strings::OPEN);
        if ui.add(open).accessible_name(strings::open(slot)).on_hover_text(strings::OPEN_HELP).clicked() {
            asked.commands.push(Command::Signals(SignalsCommand::AskWhatToOpen(slot)));
        }
        let field = TextEdit::singleline(&mut place.path).hint_text(strings::PATH_HINT);
        let field = ui.add(field.desired_width(ui.available_width() - 4.0));
        let field = field.accessible_name(strings::path_of(slot)).on_hover_text(strings::OPEN_HELP);
        if field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter)) {
            let sources = paths_in(&place.path).into_iter();
            let read = |source| Command::Signals(SignalsCommand::Read(slot, source));
            asked.commands.extend(sources.take(1).map(read));
        }
    });
}

/// Draws fields for information that the file does not contain; returns whether any has changed.
fn terms_ui(ui: &mut Ui, slot: Slot, place: &mut Place) -> bool {
    let Some(kind) = place.file().map(|file| file.kind) else { return false };
    let terms = &mut place.terms;
    let before = *terms;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        let mut speed = terms.speed.mm_per_s();
        let value = DragValue::new(&mut speed).range(SPEEDS_MM_PER_S).suffix(" mm/s").speed(1.0);
        number(ui, slot, strings::SPEED, strings::SPEED_HELP, value);
        terms.speed = MetersPerSecond::from_mm_per_s(speed);
        let mut force = terms.force.0;
        let value = DragValue::new(&mut force).range(FORCES_N).suffix(" N").speed(0.01);
        let value = value.min_decimals(2).max_decimals(4);
        number(ui, slot, strings::FORCE, strings::FORCE_HELP, value);
        terms.force = Newtons(force);
    });
    if kind == FileKind::Recording {
        recording_ui(ui, slot, terms);
        return *terms != before;
    }
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        let level = DragValue::new(&mut terms.level_mps2).range(LEVELS_MPS2).suffix(" m/s²").speed(0.02);
        number(ui, slot, strings::LEVEL, strings::LEVEL_HELP, level.min_decimals(2).max_decimals(4));
        if kind == FileKind::Picture {
            let width = DragValue::new(&mut terms.width_mm).range(WIDTHS_MM).suffix(" mm").speed(0.5);
            number(ui, slot, strings::WIDTH, strings::WIDTH_HELP, width.min_decimals(1).max_decimals(3));
        }
    });
    if kind == FileKind::Picture {
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 4.0;
            let mut row = terms.row.map_or(-1.0, f64::from);
            let value = DragValue::new(&mut row).range(-1.0..=MAX_ROW).max_decimals(0).speed(0.5);
            let value = value.custom_formatter(|row, _| strings::row(row));
            number(ui, slot, strings::ROW, strings::ROW_HELP, value);
            terms.row = (row >= 0.0).then_some(row as u32);
        });
    }
    *terms != before
}

/// Draws fields that a recording may need: its channel, and the acceleration of a sample of 1.0.
fn recording_ui(ui: &mut Ui, slot: Slot, terms: &mut Terms) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        let mut full_scale = terms.full_scale_mps2.unwrap_or(1.0);
        let value = DragValue::new(&mut full_scale).range(FULL_SCALES_MPS2).suffix(" m/s²").speed(0.05);
        let value = value.min_decimals(2).max_decimals(4);
        number(ui, slot, strings::FULL_SCALE, strings::FULL_SCALE_HELP, value);
        if full_scale != terms.full_scale_mps2.unwrap_or(1.0) {
            terms.full_scale_mps2 = Some(full_scale);
        }
        let mut channel = terms.channel.map_or(0.0, |channel| channel as f64 + 1.0);
        let value = DragValue::new(&mut channel).range(0.0..=MAX_CHANNEL).max_decimals(0).speed(0.05);
        let value = value.custom_formatter(|channel, _| strings::channel(channel));
        number(ui, slot, strings::CHANNEL, strings::CHANNEL_HELP, value);
        terms.channel = (channel >= 1.0).then(|| channel as usize - 1);
    });
}

fn number(ui: &mut Ui, slot: Slot, name: &str, help: &str, value: DragValue<'_>) {
    number_ui(ui, name, &format!("{name} {}", slot.name()), help, value);
}

/// Draws the ways to make B from A; returns the requested command.
pub(super) fn remaking_ui(
    ui: &mut Ui,
    remaking: &mut ResynthesisSettings,
    window_mm: f64,
) -> Option<Command> {
    let mut asked = None;
    ui.horizontal(|ui| {
        if ui.button(strings::COPY_OF_A).on_hover_text(strings::COPY_OF_A_HELP).clicked() {
            asked = Some(FromA::Copy);
        }
        if ui.button(strings::CODEC).on_hover_text(strings::CODEC_HELP).clicked() {
            asked = Some(FromA::Codec);
        }
        let combo = ComboBox::from_id_salt("bitrate").width(84.0);
        let combo = combo.selected_text(strings::kbps(remaking.rate.kbps())).show_list(ui, |ui| {
            for rate in Bitrate::ALL {
                ui.selectable_value(&mut remaking.rate, rate, strings::kbps(rate.kbps()));
            }
        });
        combo.response.accessible_name(strings::BITRATE).on_hover_text(strings::CODEC_HELP);
    });
    ui.horizontal(|ui| {
        let remake = ui.button(strings::remake(window_mm));
        if remake.accessible_name(strings::REMAKE).on_hover_text(strings::REMAKE_HELP).clicked() {
            asked = Some(FromA::Spectrogram);
        }
        let steps = DragValue::new(&mut remaking.n_steps).range(0..=MAX_REFINEMENTS).speed(0.2);
        let steps = ui.add(steps.suffix(strings::STEPS)).accessible_name(strings::REFINEMENTS);
        steps.on_hover_text(strings::REFINEMENTS_HELP);
    });
    asked.map(|how| Command::Signals(SignalsCommand::MakeB(how)))
}

/// Color of a slot throughout the window.
pub(super) fn slot_color(ui: &Ui, slot: Slot) -> egui::Color32 {
    let t = tokens(ui.ctx());
    match slot {
        Slot::A => t.accent,
        Slot::B => t.parents[0],
    }
}
