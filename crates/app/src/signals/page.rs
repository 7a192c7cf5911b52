//! The page: two places at the left, what is known of them beside it.

mod views;

use std::sync::Arc;

use egui::{CentralPanel, ComboBox, Context, Frame, Label, Margin, Panel as Side, RichText, ScrollArea, Ui};
use shagreen_core::codec::bitrate::Bitrate;
use shagreen_core::spatial_spectrogram::ProfileFidelity;

use super::analysis::{AtRate, Compared, compare, remade, through_codec};
use super::bench_signal::BenchSignal;
use super::editor::Editor;
use super::known::Known;
use super::maps::Maps;
use super::playing::Playing;
use super::slot::{Place, Slot};
use super::slot_ui::{State, place_ui, remaking_ui};
use super::spatial_ui::Spatial;
use super::{FromA, Remaking, SignalsCommand};
use crate::background::BrokenOff;
use crate::command::Command;
use crate::import::source::Source;
use crate::panel::Panel;
use crate::strings::signals as strings;
use crate::theme::{BUILD_INPUTS_WIDTH, GAP, tokens};

/// Width of what stands there before there is a signal, in points.
const EMPTY_WIDTH: f32 = 560.0;

/// What is shown beside the places.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum View {
    /// Frequencies over time.
    #[default]
    Times,
    /// Spatial frequencies over places, and the editor.
    Places,
    /// How the two differ.
    Differences,
}

impl View {
    /// All of them, in the order of their tabs.
    pub const ALL: [Self; 3] = [Self::Times, Self::Places, Self::Differences];
}

/// Both signals.
type Pair = [Arc<BenchSignal>; 2];

/// The state of the workspace.
pub struct SignalsPage {
    places: [Place; 2],
    view: View,
    window_mm: f64,
    remaking: Remaking,
    editor: Editor,
    felt: Option<Slot>,
    /// The texture whose noise and taps a relief is kept with, by its identifier.
    over: Option<String>,
    /// The name of the texture that was kept last.
    last_kept: Option<String>,
    /// Which signal is played as it was recorded.
    playing: Option<Playing>,
    compared: Known<Result<Compared, String>, 2>,
    maps: Maps,
    spatial: Spatial,
}

impl Default for SignalsPage {
    fn default() -> Self {
        Self {
            places: Default::default(),
            view: View::default(),
            window_mm: 2.0,
            remaking: Remaking { rate: Bitrate::ALL[2], n_steps: 0 },
            editor: Editor::default(),
            felt: None,
            over: None,
            last_kept: None,
            playing: None,
            compared: Known::default(),
            maps: Maps::default(),
            spatial: Spatial::default(),
        }
    }
}

impl SignalsPage {
    /// The signal in a place.
    pub fn signal(&self, slot: Slot) -> Option<&Arc<BenchSignal>> {
        self.places[slot.index()].signal()
    }

    /// What the codec keeps of the signal in a place, once that is known; it is asked about where differences are shown.
    pub fn by_rate(&self, slot: Slot) -> Option<Result<&[AtRate], &str>> {
        let by_rate = self.places[slot.index()].by_rate()?;
        Some(by_rate.as_ref().map(Vec::as_slice).map_err(String::as_str))
    }

    /// What windows of each width keep of the signal in a place, once that is known; it is asked about where places are shown.
    pub fn by_window(&self, slot: Slot) -> Option<&[ProfileFidelity]> {
        self.places[slot.index()].by_window()
    }

    /// How the two differ, once that is known; it is asked about where differences are shown.
    pub fn compared(&self) -> Option<Result<&Compared, &str>> {
        Some(match self.compared.of(&self.pair()?)? {
            Ok(compared) => compared.as_ref().map_err(String::as_str),
            Err(BrokenOff) => Err(strings::BROKE_OFF),
        })
    }

    /// Why what was tried last for a place came to nothing.
    pub fn failure(&self, slot: Slot) -> Option<&str> {
        self.places[slot.index()].failure.as_deref()
    }

    /// Which signal the pen feels.
    pub fn felt(&self) -> Option<Slot> {
        self.felt
    }

    /// What the pen feels.
    pub(crate) fn felt_signal(&self) -> Option<&Arc<BenchSignal>> {
        self.signal(self.felt?)
    }

    /// The window that is looked through, in m.
    fn window_m(&self) -> f64 {
        1e-3 * self.window_mm
    }

    fn pair(&self) -> Option<Pair> {
        Some([Arc::clone(self.signal(Slot::A)?), Arc::clone(self.signal(Slot::B)?)])
    }

    /// Takes in what the workers have done, and sets them to what is shown next.
    pub fn collect(&mut self, ctx: &Context) {
        for slot in Slot::ALL {
            let before = self.signal(slot).map(Arc::clone);
            if self.places[slot.index()].collect(ctx) && slot == Slot::B {
                self.note_replaced(before.as_ref());
            }
        }
        for place in &mut self.places {
            match self.view {
                View::Times => {}
                View::Places => place.ask_for_windows(ctx),
                View::Differences => place.ask_for_rates(ctx),
            }
        }
        if let Some(pair) = self.pair().filter(|_| self.view == View::Differences) {
            self.compared.follow(pair, ctx, |[first, second]| compare(first, second));
        }
        if self.felt_signal().is_none() {
            self.felt = None;
        }
    }

    /// Another signal lies in B: the one before can be had back.
    fn note_replaced(&mut self, before: Option<&Arc<BenchSignal>>) {
        match before {
            Some(before) => self.editor.replaced(before),
            None => self.editor.forget(),
        }
    }

    /// Reads a file into a place.
    pub(crate) fn read(&mut self, slot: Slot, source: Source, ctx: &Context) {
        let place = &mut self.places[slot.index()];
        source.path().display().to_string().clone_into(&mut place.path);
        place.read(source, ctx);
    }

    /// Reads one file into the place that is free, or else into B; of several the first two into both.
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

    /// Has a signal made for a place.
    pub(crate) fn make(
        &mut self,
        slot: Slot,
        ctx: &Context,
        work: impl FnOnce() -> Result<BenchSignal, String> + Send + 'static,
    ) {
        self.places[slot.index()].make(ctx, work);
    }

    /// Says why nothing came to a place.
    pub(crate) fn say(&mut self, slot: Slot, reason: String) {
        self.places[slot.index()].failure = Some(reason);
    }

    /// Lets the pen feel a signal, or what is authored.
    pub(crate) fn feel(&mut self, slot: Option<Slot>) {
        self.felt = slot.filter(|slot| self.signal(*slot).is_some());
    }

    /// Makes B of A.
    pub(crate) fn make_b(&mut self, how: FromA, ctx: &Context) {
        let Some(first) = self.signal(Slot::A).map(Arc::clone) else { return };
        let (Remaking { rate, n_steps }, window_m) = (self.remaking, self.window_m());
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

    /// What is to be kept as a texture: the signal, and the identifier of the texture that it lies over.
    pub(crate) fn kept(&self, slot: Slot) -> Option<(Arc<BenchSignal>, Option<String>)> {
        Some((Arc::clone(self.signal(slot)?), self.over.clone()))
    }

    /// A texture of this name was kept.
    pub(crate) fn note_kept(&mut self, name: &str) {
        self.last_kept = Some(name.to_owned());
    }

    /// A signal is on its way to the output.
    pub(crate) fn note_playing(&mut self, slot: Slot) {
        self.playing = Some(Playing::new(slot));
    }

    /// What painting could take back or make again.
    pub(crate) fn painting_labels(&self) -> [Option<&'static str>; 2] {
        self.editor.labels()
    }

    /// Takes the last change of B back.
    pub(crate) fn undo(&mut self) {
        if let Some(then) = self.signal(Slot::B).map(Arc::clone).and_then(|now| self.editor.undo(&now)) {
            self.places[Slot::B.index()].put(then);
        }
    }

    /// Makes it again.
    pub(crate) fn redo(&mut self) {
        if let Some(then) = self.signal(Slot::B).map(Arc::clone).and_then(|now| self.editor.redo(&now)) {
            self.places[Slot::B.index()].put(then);
        }
    }

    /// What painting made of B is there, and felt at once.
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

    /// Draws the page and returns what the user asked of the rest.
    pub(crate) fn show(&mut self, ui: &mut Ui, panel: &Panel<'_>) -> Vec<Command> {
        let mut commands = Vec::new();
        let t = tokens(ui.ctx());
        Side::left("signals").exact_size(BUILD_INPUTS_WIDTH).resizable(false).show(ui, |ui| {
            let foot = Frame::new().inner_margin(Margin::symmetric(0, 6));
            Side::bottom("keep").frame(foot).show(ui, |ui| self.keep_ui(ui, panel, &mut commands));
            ScrollArea::vertical().auto_shrink(false).show(ui, |ui| self.left_ui(ui, panel, &mut commands));
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

    /// A signal becomes a texture.
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
            let combo = combo.selected_text(shown).show_ui(ui, |ui| {
                ui.selectable_value(&mut self.over, None, strings::NOTHING);
                // One that changes along a path is played by its own textures.
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

/// What stands there before there is a signal.
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
