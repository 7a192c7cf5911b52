//! The page: two places at the left, what is known of them beside it.

use std::sync::Arc;

use egui::{CentralPanel, ComboBox, Context, Frame, Label, Margin, Panel as Side, RichText, ScrollArea, Ui};
use shagreen_core::codec::bitrate::Bitrate;
use shagreen_core::spatial_spectrogram::{ProfileFidelity, Transform};
use shagreen_formats::figure::{Figure, Tone};

use super::analysis::{AtRate, ByRate, Compared, compare, remade, through_codec};
use super::bench_signal::BenchSignal;
use super::editor::Editor;
use super::editor_ui::{Asked, tools_ui};
use super::features_ui::features_ui;
use super::figures::{Levels, features_figure, fidelity_figure, rates_figure};
use super::known::Known;
use super::slot::{Place, Slot};
use super::slot_ui::{State, place_ui, remaking_ui};
use super::spatial_ui::{ShownMm, Spatial, places_map_ui, spatial_ui};
use super::{Remaking, SignalsCommand};
use crate::background::BrokenOff;
use crate::command::Command;
use crate::figure_ui::framed_figure_ui;
use crate::import::source::Source;
use crate::panel::Panel;
use crate::strings::signals as strings;
use crate::theme::{BUILD_INPUTS_WIDTH, GAP, GROUP_GAP, tokens};

/// Windows of the slider, in mm: those of the paper, and all between.
const WINDOWS_MM: (f64, f64) = (0.2, 20.0);
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

/// The levels of a signal, and what they were drawn of.
struct Drawn {
    of: Arc<BenchSignal>,
    view: View,
    window_mm: f64,
    shown_mm: ShownMm,
    levels: Result<Levels, String>,
}

/// Both signals.
type Pair = [Arc<BenchSignal>; 2];

/// A signal that is played as it was recorded.
#[derive(Clone, Copy)]
struct Playing {
    slot: Slot,
    /// Whether the output said so.
    was_seen: bool,
    /// How long it may take to.
    frames_left: u32,
}

/// Frames in which an output says that it plays, or never will.
const PATIENCE_FRAMES: u32 = 60;

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
    drawn: [Option<Drawn>; 2],
    maps: [Option<Result<Arc<Figure>, String>>; 2],
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
            drawn: [None, None],
            maps: [None, None],
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
    pub(crate) fn remake(&mut self, command: &SignalsCommand, ctx: &Context) {
        let Some(first) = self.signal(Slot::A).map(Arc::clone) else { return };
        let (Remaking { rate, n_steps }, window_m) = (self.remaking, self.window_m());
        match command {
            SignalsCommand::CopyOfA => {
                let before = self.signal(Slot::B).map(Arc::clone);
                self.places[Slot::B.index()].put(first);
                self.note_replaced(before.as_ref());
            }
            SignalsCommand::ThroughCodec => {
                self.make(Slot::B, ctx, move || through_codec(&first, rate));
            }
            SignalsCommand::Remake => {
                self.make(Slot::B, ctx, move || remade(&first, window_m, n_steps));
            }
            _ => {}
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
        self.playing = Some(Playing { slot, was_seen: false, frames_left: PATIENCE_FRAMES });
    }

    /// Follows what the output plays; it tells so a block later than it was asked.
    fn follow_playing(&mut self, plays_signal: bool) {
        if let Some(playing) = &mut self.playing {
            playing.was_seen |= plays_signal;
            playing.frames_left = playing.frames_left.saturating_sub(1);
            if !plays_signal && (playing.was_seen || playing.frames_left == 0) {
                self.playing = None;
            }
        }
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
        self.follow_playing(panel.session.status().is_some_and(|status| status.plays_signal));
        for slot in Slot::ALL {
            let state = State {
                is_felt: self.felt == Some(slot),
                is_playing: self.playing.is_some_and(|playing| playing.slot == slot),
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

    fn views_ui(&mut self, ui: &mut Ui, commands: &mut Vec<Command>) {
        ui.horizontal(|ui| {
            for view in View::ALL {
                ui.selectable_value(&mut self.view, view, strings::view(view))
                    .on_hover_text(strings::view_help(view));
            }
            if self.view == View::Places {
                ui.add_space(GROUP_GAP);
                self.window_ui(ui);
                let is_zoomed = self.spatial.shown_mm.is_some();
                let whole = ui.add_enabled(is_zoomed, egui::Button::new(strings::SHOW_ALL));
                if whole
                    .on_hover_text(strings::ZOOM_HELP)
                    .on_disabled_hover_text(strings::ZOOM_HELP)
                    .clicked()
                {
                    self.spatial.shown_mm = None;
                }
            }
        });
        ui.add_space(GAP);
        self.draw();
        match self.view {
            View::Times => self.times_ui(ui, commands),
            View::Places => self.places_ui(ui, commands),
            View::Differences => self.differences_ui(ui, commands),
        }
    }

    fn window_ui(&mut self, ui: &mut Ui) {
        let t = tokens(ui.ctx());
        let text = RichText::new(strings::WINDOW).color(t.text_weak);
        ui.add(Label::new(text).selectable(false)).on_hover_text(strings::WINDOW_HELP);
        ui.spacing_mut().slider_width = 220.0;
        let slider = egui::Slider::new(&mut self.window_mm, WINDOWS_MM.0..=WINDOWS_MM.1);
        let slider = slider.logarithmic(true).suffix(" mm").max_decimals(2);
        ui.add(slider).accessible_name(strings::WINDOW).on_hover_text(strings::WINDOW_HELP);
    }

    /// Draws the maps anew where they are of something else than they were.
    fn draw(&mut self) {
        if self.view == View::Differences {
            return;
        }
        let mut is_new = false;
        for slot in Slot::ALL {
            let signal = self.signal(slot).map(Arc::clone);
            let (view, window_mm, shown_mm) = (self.view, self.window_mm, self.spatial.shown_mm);
            let is_drawn = match (&self.drawn[slot.index()], &signal) {
                (Some(drawn), Some(signal)) => {
                    let is_same_window = view == View::Times || drawn.window_mm == window_mm;
                    let is_same_part = view == View::Times || drawn.shown_mm == shown_mm;
                    Arc::ptr_eq(&drawn.of, signal) && drawn.view == view && is_same_window && is_same_part
                }
                (drawn, signal) => drawn.is_none() && signal.is_none(),
            };
            if !is_drawn {
                is_new = true;
                self.drawn[slot.index()] = signal.map(|signal| {
                    let levels = self.levels(&signal);
                    Drawn { of: signal, view, window_mm, shown_mm, levels }
                });
            }
        }
        if is_new {
            let drawn = || self.drawn.iter().flatten().filter_map(|drawn| drawn.levels.as_ref().ok());
            let highest_db = drawn().map(Levels::highest_db).fold(f64::NEG_INFINITY, f64::max);
            self.maps = self.drawn.each_ref().map(|drawn| Some(self.figure(drawn.as_ref()?, highest_db)));
        }
    }

    fn figure(&self, drawn: &Drawn, highest_db: f64) -> Result<Arc<Figure>, String> {
        let levels = drawn.levels.clone()?;
        let window_mm = 1e3 * drawn.of.window_m(drawn.of.framing(self.window_m()));
        let title = strings::map_title(self.view, &drawn.of.name, window_mm);
        Ok(Arc::new(levels.figure(title, strings::map_axes(self.view), highest_db)))
    }

    fn levels(&self, signal: &BenchSignal) -> Result<Levels, String> {
        if self.view != View::Places {
            return Levels::over_time(signal).ok_or_else(|| strings::TOO_SHORT_TO_DRAW.to_owned());
        }
        // Of the signal as it is: what was painted is what is wanted of it.
        let transform = Transform::new(signal.framing(self.window_m()));
        let power = transform.power(signal.profile.values()).map_err(|error| error.to_string())?;
        let length_mm = 1e3 * signal.profile.length_m();
        // The other signal may be longer.
        let shown = self.spatial.shown_mm.filter(|(from, _)| *from < length_mm);
        let (from, to) = shown.unwrap_or((0.0, length_mm));
        Ok(Levels::over_places(&power, signal, (from, to.min(length_mm))))
    }

    fn map(&self, slot: Slot) -> Option<Result<Arc<Figure>, String>> {
        self.maps[slot.index()].clone()
    }

    fn times_ui(&self, ui: &mut Ui, commands: &mut Vec<Command>) {
        let maps = Slot::ALL.map(|slot| self.map(slot));
        ui.columns_const(|columns: &mut [Ui; 2]| {
            for ((ui, map), slot) in columns.iter_mut().zip(&maps).zip(Slot::ALL) {
                commands.extend(map_ui(ui, slot, map.as_ref(), strings::stem(self.view, slot)));
            }
        });
    }

    fn places_ui(&mut self, ui: &mut Ui, commands: &mut Vec<Command>) {
        let signal = self.signal(Slot::B).map(Arc::clone);
        let window_m = self.window_m();
        let asked = ui.add_enabled_ui(signal.is_some(), |ui| tools_ui(ui, &mut self.editor)).inner;
        match (asked, &signal) {
            (Some(Asked::Stretch), Some(signal)) => {
                let stretched = self.editor.stretch(signal, window_m);
                self.take_painted(stretched.map(Some));
            }
            (Some(Asked::Undo), _) => self.undo(),
            (Some(Asked::Redo), _) => self.redo(),
            _ => {}
        }
        ui.add_space(GAP);
        let known = self.of_each(Place::by_window);
        let is_waiting = known.len() < self.n_signals();
        let fidelity = Arc::new(fidelity_figure(&known, window_m));
        let maps = Slot::ALL.map(|slot| self.map(slot));
        let mut painted = None;
        ui.columns_const(|columns: &mut [Ui; 3]| {
            let [first, second, third] = columns;
            let stem = strings::stem(View::Places, Slot::A);
            match (&maps[0], self.signal(Slot::A).map(|signal| 1e3 * signal.profile.length_m())) {
                (Some(Ok(figure)), Some(length_mm)) => {
                    let (save, _) = places_map_ui(first, Slot::A, figure, stem, &mut self.spatial, length_mm);
                    commands.extend(save);
                }
                (map, _) => commands.extend(map_ui(first, Slot::A, map.as_ref(), stem)),
            }
            match (&maps[1], &signal) {
                (Some(Ok(figure)), Some(signal)) => {
                    let stem = strings::stem(View::Places, Slot::B);
                    let editor = &mut self.editor;
                    let shown = spatial_ui(second, figure, stem, &mut self.spatial, editor, signal, window_m);
                    commands.extend(shown.save);
                    painted = shown.painted;
                }
                (map, _) => commands.extend(map_ui(second, Slot::B, map.as_ref(), "")),
            }
            waiting_ui(third, is_waiting);
            commands.extend(framed_figure_ui(third, "fidelity by window", &fidelity, "fidelity-by-window"));
        });
        if let Some(painted) = painted {
            self.take_painted(painted);
        }
    }

    fn n_signals(&self) -> usize {
        self.places.iter().filter(|place| place.signal().is_some()).count()
    }

    /// What is known of the signals as they are, in their colors.
    fn of_each<'a, T: ?Sized>(
        &'a self,
        known: impl Fn(&'a Place) -> Option<&'a T>,
    ) -> Vec<(Tone, &'static str, &'a T)> {
        let of = Slot::ALL.into_iter().zip([Tone::Main, Tone::Second]);
        of.filter_map(|(slot, tone)| Some((tone, slot.name(), known(&self.places[slot.index()])?))).collect()
    }

    fn differences_ui(&self, ui: &mut Ui, commands: &mut Vec<Command>) {
        let known: Vec<(Tone, &str, &ByRate)> = self.of_each(Place::by_rate);
        let rates = Arc::new(rates_figure(&known));
        let names = Slot::ALL.map(|slot| self.signal(slot).map_or("", |signal| &signal.name));
        let compared = self.compared();
        ui.columns_const(|columns: &mut [Ui; 2]| {
            let [left, right] = columns;
            match compared {
                Some(Ok(compared)) => {
                    let figure = Arc::new(features_figure(compared, names));
                    let scroll = ScrollArea::both().id_salt("features").auto_shrink(false);
                    commands.extend(scroll.show(left, |ui| features_ui(ui, compared, &figure)).inner);
                }
                Some(Err(reason)) => {
                    let text = RichText::new(reason).color(tokens(left.ctx()).warning);
                    left.add(Label::new(text).wrap());
                }
                None => {
                    let is_pair = self.pair().is_some();
                    let said = if is_pair { strings::MAKING } else { strings::NEEDS_PAIR };
                    let text = RichText::new(said).color(tokens(left.ctx()).text_weak);
                    left.add(Label::new(text).wrap());
                }
            }
            waiting_ui(right, known.len() < self.n_signals());
            for (_, name, of) in &known {
                if let Err(reason) = of {
                    let text = RichText::new(format!("{name}: {reason}")).small();
                    right.add(Label::new(text).wrap());
                }
            }
            commands.extend(framed_figure_ui(right, "d' by rate", &rates, "d-prime-by-rate"));
        });
    }
}

/// Says that something is still being worked out.
fn waiting_ui(ui: &mut Ui, is_waiting: bool) {
    if is_waiting {
        let text = RichText::new(strings::MAKING).small().color(tokens(ui.ctx()).text_weak);
        ui.add(Label::new(text).selectable(false));
    }
}

/// The map of a place, or why there is none.
fn map_ui(ui: &mut Ui, slot: Slot, map: Option<&Result<Arc<Figure>, String>>, stem: &str) -> Option<Command> {
    let t = tokens(ui.ctx());
    match map {
        Some(Ok(figure)) => framed_figure_ui(ui, strings::map_name(slot), figure, stem),
        Some(Err(reason)) => {
            ui.add(Label::new(RichText::new(reason).color(t.error)).wrap());
            None
        }
        None => {
            let text = RichText::new(strings::nothing_in(slot)).color(t.text_weak);
            ui.add(Label::new(text).wrap().selectable(false));
            None
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
