//! Page of the Signals workspace: the two slots on the left, the views of their signals beside them.

mod model;
mod views;

use std::sync::Arc;

use egui::{CentralPanel, ComboBox, Context, Frame, Label, Margin, Panel as Side, RichText, ScrollArea, Ui};
use shagreen_core::signals::codec::bitrate::Bitrate;
use shagreen_core::signals::spatial_spectrogram::ProfileFidelity;

use super::ResynthesisSettings;
use super::analysis::{AtRate, Compared, compare, remade, through_codec};
use super::cached_analysis::Known;
use super::editor::Editor;
use super::maps::Maps;
use super::model_choice::ModelChoice;
use super::playing::Playing;
use super::slot::Place;
use super::slot_ui::{State, place_ui, remaking_ui};
use super::spatial_ui::Spatial;
use crate::choices::signals::FromA;
use crate::choices::signals::Slot;
use crate::choices::signals::View;
use crate::command::Command;
use crate::command::signals::SignalsCommand;
use crate::look::list::ShowList as _;
use crate::look::scroll_to_focus::scroll_to_focus;
use crate::look::theme::{BUILD_INPUTS_WIDTH, GAP, tokens};
use crate::panel::Panel;
use crate::state::background::JobPanicked;
use crate::state::bench_signal::BenchSignal;
use crate::state::source::Source;
use crate::strings::signals as strings;

/// Width of the text shown before there is a signal, in points.
const EMPTY_WIDTH: f32 = 560.0;

impl View {
    /// All views, in the order of their tabs.
    pub const ALL: [Self; 3] = [Self::Times, Self::Places, Self::Differences];
}

type Pair = [Arc<BenchSignal>; 2];

/// State of the Signals workspace.
pub struct SignalsPage {
    places: [Place; 2],
    view: View,
    window_mm: f64,
    remaking: ResynthesisSettings,
    editor: Editor,
    felt: Option<Slot>,
    /// Identifier of the texture whose noise, friction and taps are added when a signal is kept as a relief.
    over: Option<String>,
    /// Name of the last texture that was kept.
    last_kept: Option<String>,
    /// Signal that was exported last.
    exported: Option<Arc<BenchSignal>>,
    /// Signal that is played at its own speed, regardless of the pen.
    playing: Option<Playing>,
    compared: Known<Result<Compared, String>, 2>,
    model: ModelChoice,
    maps: Maps,
    spatial: Spatial,
}

impl Default for SignalsPage {
    fn default() -> Self {
        Self {
            places: Default::default(),
            view: View::default(),
            window_mm: 2.0,
            remaking: ResynthesisSettings { rate: Bitrate::ALL[2], n_steps: 0 },
            editor: Editor::default(),
            felt: None,
            over: None,
            last_kept: None,
            exported: None,
            playing: None,
            compared: Known::default(),
            model: ModelChoice::default(),
            maps: Maps::default(),
            spatial: Spatial::default(),
        }
    }
}

impl SignalsPage {
    /// Signal in a slot.
    pub fn signal(&self, slot: Slot) -> Option<&Arc<BenchSignal>> {
        self.places[slot.index()].signal()
    }

    /// Fidelity of the signal in a slot at each bit rate of the codec, once computed. It is only requested while
    /// [`View::Differences`] is shown.
    pub fn by_rate(&self, slot: Slot) -> Option<Result<&[AtRate], &str>> {
        let by_rate = self.places[slot.index()].by_rate()?;
        Some(by_rate.as_ref().map(Vec::as_slice).map_err(String::as_str))
    }

    /// Fidelity of the spatial spectrogram for each window length, once computed. It is only requested while
    /// [`View::Places`] is shown.
    pub fn by_window(&self, slot: Slot) -> Option<&[ProfileFidelity]> {
        self.places[slot.index()].by_window()
    }

    /// Difference between both signals, once computed. It is only requested while [`View::Differences`] is shown.
    pub fn compared(&self) -> Option<Result<&Compared, &str>> {
        Some(match self.compared.of(&self.pair()?)? {
            Ok(compared) => compared.as_ref().map_err(String::as_str),
            Err(JobPanicked) => Err(strings::BROKE_OFF),
        })
    }

    /// Why the last request for a slot failed.
    pub fn failure(&self, slot: Slot) -> Option<&str> {
        self.places[slot.index()].failure.as_deref()
    }

    /// Slot of the signal that the pen feels.
    pub fn felt(&self) -> Option<Slot> {
        self.felt
    }

    /// Signal that the pen feels.
    pub(crate) fn felt_signal(&self) -> Option<&Arc<BenchSignal>> {
        self.signal(self.felt?)
    }

    /// Window length of the spatial spectrogram, in m.
    fn window_m(&self) -> f64 {
        1e-3 * self.window_mm
    }

    fn pair(&self) -> Option<Pair> {
        Some([Arc::clone(self.signal(Slot::A)?), Arc::clone(self.signal(Slot::B)?)])
    }

    /// Takes over the results of the workers, and requests what is to be shown next.
    pub fn collect(&mut self, ctx: &Context) {
        for slot in Slot::ALL {
            let before = self.signal(slot).map(Arc::clone);
            if self.places[slot.index()].collect(ctx) && slot == Slot::B {
                self.note_replaced(before.as_ref());
            }
        }
        let predicts = self.collect_model(ctx);
        for place in &mut self.places {
            match self.view {
                View::Places => place.ask_for_windows(ctx),
                View::Differences if predicts => place.ask_for_rates(self.model.own(), ctx),
                View::Times | View::Differences => {}
            }
        }
        if let Some(pair) = self.pair().filter(|_| predicts) {
            let model = self.model.own().cloned();
            let work = move |[first, second]: &Pair| compare(first, second, model.as_deref());
            self.compared.follow(pair, ctx, work);
        }
        if self.felt_signal().is_none() {
            self.felt = None;
        }
    }

    /// Adds an undo step for the previous signal in B; without one, discards all steps.
    fn note_replaced(&mut self, before: Option<&Arc<BenchSignal>>) {
        match before {
            Some(before) => self.editor.replaced(before),
            None => self.editor.forget(),
        }
    }

    /// Reads a file into a slot.
    pub(crate) fn read(&mut self, slot: Slot, source: Source, ctx: &Context) {
        let place = &mut self.places[slot.index()];
        source.path().display().to_string().clone_into(&mut place.path);
        place.read(source, ctx);
    }

    /// Reads one file into the slot that is empty, or else into B. Of several files, the first two go into A and B.
    pub(crate) fn read_all(&mut self, sources: Vec<Source>, ctx: &Context) {
        let is_free = |slot: &Slot| self.signal(*slot).is_none();
        let mut wanted: Vec<Slot> = Slot::ALL.into_iter().filter(is_free).collect();
        wanted.extend(Slot::ALL.into_iter().rev().filter(|slot| !is_free(slot)));
        if sources.len() > 1 {
            wanted = Slot::ALL.to_vec();
        }
        for (slot, source) in wanted.into_iter().zip(sources) {
            self.read(slot, source, ctx);
        }
    }

    /// Makes a signal for a slot in the background.
    pub(crate) fn make(
        &mut self,
        slot: Slot,
        ctx: &Context,
        work: impl FnOnce() -> Result<BenchSignal, String> + Send + 'static,
    ) {
        self.places[slot.index()].make(ctx, work);
    }

    /// Shows why a request for a slot failed.
    pub(crate) fn say(&mut self, slot: Slot, reason: String) {
        self.places[slot.index()].failure = Some(reason);
    }

    /// Lets the pen feel the signal in a slot; `None` lets it feel the authored texture.
    pub(crate) fn feel(&mut self, slot: Option<Slot>) {
        self.felt = slot.filter(|slot| self.signal(*slot).is_some());
    }

    /// Makes signal B from A.
    pub(crate) fn make_b(&mut self, how: FromA, ctx: &Context) {
        let Some(first) = self.signal(Slot::A).map(Arc::clone) else { return };
        let (ResynthesisSettings { rate, n_steps }, window_m) = (self.remaking, self.window_m());
        match how {
            FromA::Copy => {
                let before = self.signal(Slot::B).map(Arc::clone);
                self.places[Slot::B.index()].put(first);
                self.note_replaced(before.as_ref());
            }
            FromA::Codec => self.make(Slot::B, ctx, move || through_codec(&first, rate)),
            FromA::Spectrogram => self.make(Slot::B, ctx, move || remade(&first, window_m, n_steps)),
        }
    }

    /// Signal to be kept as a texture, and the identifier of the texture that is added to the relief.
    pub(crate) fn kept(&self, slot: Slot) -> Option<(Arc<BenchSignal>, Option<String>)> {
        Some((Arc::clone(self.signal(slot)?), self.over.clone()))
    }

    /// Stores the name of a texture that was kept.
    pub(crate) fn note_kept(&mut self, name: &str) {
        self.last_kept = Some(name.to_owned());
    }

    /// Remembers that a signal was sent to the output.
    pub(crate) fn note_playing(&mut self, slot: Slot) {
        self.playing = Some(Playing::new(slot));
    }

    /// Names of the next undo step and of the next redo step of the editor.
    pub(crate) fn painting_labels(&self) -> [Option<&'static str>; 2] {
        self.editor.labels()
    }

    /// Whether B was edited by hand, which no project keeps, and was not exported since.
    pub(crate) fn has_unsaved_painting(&self) -> bool {
        let is_exported = match (self.signal(Slot::B), &self.exported) {
            (Some(signal), Some(exported)) => Arc::ptr_eq(signal, exported),
            _ => false,
        };
        self.painting_labels()[0].is_some() && !is_exported
    }

    /// Notes that a signal was exported.
    pub(crate) fn note_exported(&mut self, signal: Arc<BenchSignal>) {
        self.exported = Some(signal);
    }

    /// Undoes the last change of B.
    pub(crate) fn undo(&mut self) {
        if let Some(then) = self.signal(Slot::B).map(Arc::clone).and_then(|now| self.editor.undo(&now)) {
            self.places[Slot::B.index()].put(then);
        }
    }

    /// Redoes the change of B that was undone last.
    pub(crate) fn redo(&mut self) {
        if let Some(then) = self.signal(Slot::B).map(Arc::clone).and_then(|now| self.editor.redo(&now)) {
            self.places[Slot::B.index()].put(then);
        }
    }

    /// Puts an edited signal into B, where the pen feels it at once.
    fn take_painted(&mut self, painted: Result<Option<Arc<BenchSignal>>, String>) {
        match painted {
            Ok(Some(signal)) => {
                self.places[Slot::B.index()].put(signal);
                self.felt = Some(Slot::B);
            }
            Ok(None) => {}
            Err(reason) => self.places[Slot::B.index()].failure = Some(reason),
        }
    }

    /// Draws the page; returns the requested commands.
    pub(crate) fn show(&mut self, ui: &mut Ui, panel: &Panel<'_>) -> Vec<Command> {
        let mut commands = Vec::new();
        let t = tokens(ui.ctx());
        Side::left("signals").exact_size(BUILD_INPUTS_WIDTH).resizable(false).show(ui, |ui| {
            let foot = Frame::new().inner_margin(Margin::symmetric(0, 6));
            Side::bottom("keep").frame(foot).show(ui, |ui| self.keep_ui(ui, panel, &mut commands));
            ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                self.left_ui(ui, panel, &mut commands);
                scroll_to_focus(ui);
            });
        });
        let frame = Frame::new().fill(t.panel).inner_margin(Margin::same(8));
        CentralPanel::default().frame(frame).show(ui, |ui| {
            if self.signal(Slot::A).is_none() && self.signal(Slot::B).is_none() {
                empty_ui(ui);
            } else {
                self.views_ui(ui, &mut commands);
            }
        });
        commands
    }

    fn left_ui(&mut self, ui: &mut Ui, panel: &Panel<'_>, commands: &mut Vec<Command>) {
        ui.add_space(GAP);
        let plays_signal = panel.session.status().is_some_and(|status| status.plays_signal);
        self.playing = self.playing.and_then(|playing| playing.followed(plays_signal));
        for slot in Slot::ALL {
            let state = State {
                is_felt: self.felt == Some(slot),
                is_playing: self.playing.is_some_and(|playing| playing.slot() == slot),
            };
            let asked = place_ui(ui, slot, &mut self.places[slot.index()], state);
            commands.extend(asked.commands);
            if asked.is_again {
                self.places[slot.index()].read_again(ui.ctx());
            }
            if asked.is_cleared {
                if state.is_playing {
                    commands.push(Command::StopTone);
                }
                self.places[slot.index()].clear();
                if slot == Slot::B {
                    self.editor.forget();
                }
            }
            ui.add_space(GAP);
        }
        let has_first = self.signal(Slot::A).is_some();
        ui.add_enabled_ui(has_first, |ui| {
            commands.extend(remaking_ui(ui, &mut self.remaking, self.window_mm));
        });
    }

    /// Draws the section that keeps a signal as a texture.
    fn keep_ui(&mut self, ui: &mut Ui, panel: &Panel<'_>, commands: &mut Vec<Command>) {
        let t = tokens(ui.ctx());
        let textures = panel.session.textures();
        let named = |id: &String| textures.iter().find(|texture| texture.id == *id).map(|t| t.name.as_str());
        if self.over.as_ref().is_some_and(|id| named(id).is_none()) {
            self.over = None;
        }
        ui.horizontal(|ui| {
            ui.add(Label::new(RichText::new(strings::KEEP).color(t.text_weak)).selectable(false));
            for slot in Slot::ALL {
                let button = egui::Button::new(slot.name());
                let button = ui.add_enabled(self.signal(slot).is_some(), button);
                let button = button.accessible_name(strings::keep(slot)).on_hover_text(strings::KEEP_HELP);
                if button.clicked() {
                    commands.push(Command::Signals(SignalsCommand::Keep(slot)));
                }
            }
            ui.add(Label::new(RichText::new(strings::OVER).color(t.text_weak)).selectable(false));
            let shown = self.over.as_ref().and_then(named).unwrap_or(strings::NOTHING).to_owned();
            let combo = ComboBox::from_id_salt("over").width(ui.available_width() - 8.0).truncate();
            let combo = combo.selected_text(shown).show_list(ui, |ui| {
                ui.selectable_value(&mut self.over, None, strings::NOTHING);
                // A texture that changes along a path is left out, because its own textures play it.
                for texture in textures.iter().filter(|texture| texture.path.is_none()) {
                    ui.selectable_value(&mut self.over, Some(texture.id.clone()), &texture.name);
                }
            });
            combo.response.accessible_name(strings::OVER_WHICH).on_hover_text(strings::OVER_HELP);
        });
        if let Some(name) = &self.last_kept {
            let text = RichText::new(strings::kept(name)).small().color(t.text_weak);
            ui.add(Label::new(text).wrap());
        }
    }
}

/// Draws the text shown before there is a signal.
fn empty_ui(ui: &mut Ui) {
    let t = tokens(ui.ctx());
    ui.add_space(0.08 * ui.available_height());
    let width = ui.available_width().min(EMPTY_WIDTH);
    ui.horizontal_top(|ui| {
        ui.add_space(0.5 * (ui.available_width() - width));
        ui.vertical(|ui| {
            ui.set_max_width(width);
            ui.add(Label::new(RichText::new(strings::EMPTY_TITLE).heading().strong()).selectable(false));
            ui.add_space(GAP);
            for (number, step) in (1..).zip(strings::EMPTY_STEPS) {
                ui.add(Label::new(RichText::new(format!("{number}.  {step}")).color(t.text_weak)).wrap());
                ui.add_space(2.0);
            }
        });
    });
}
