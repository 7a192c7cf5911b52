//! Sheet that chooses the axes of the space: which, and in which order. A worker reads the axes of the textures; another one
//! evaluates what each adds.

mod evaluation;
mod evaluation_ui;
mod list_ui;

use std::sync::Arc;

use egui::{Button, Context, Label, RichText, ScrollArea, Ui};
use shagreen_core::space::MOST_AXES;
use shagreen_formats::library::Library;
use shagreen_formats::project::is_same_axis;
use shagreen_studio::axes::{AxisPreset, AxisSource, axis_values, known_axes, presets};

use self::evaluation::Evaluation;
use self::evaluation_ui::{evaluate_ui, outcome_ui};
use self::list_ui::list_ui;
use crate::command::Command;
use crate::command::axes::AxesCommand;
use crate::look::motion::busy_ui;
use crate::look::primary::primary_ui;
use crate::look::scroll_to_focus::scroll_to_focus;
use crate::look::sheet_frame::{foot_ui, sheet};
use crate::look::theme::{GAP, SCROLL_BAR_ROOM, tokens};
use crate::state::background::LatestJob;
use crate::strings::{axes as strings, sentence};

/// Width of the sheet, in points.
const WIDTH: f32 = 600.0;
/// Height of the sheet around the list of axes, and least height of the list, in points.
const AROUND: f32 = 320.0;
const LEAST_LIST: f32 = 140.0;

/// Axis that can be chosen.
struct Offered {
    /// Name in the project.
    name: String,
    /// Where its coordinates come from; `None` if no texture has it.
    source: Option<AxisSource>,
    /// Coordinate of each texture.
    values: Vec<Option<f64>>,
}

/// What can be chosen.
struct Offer {
    /// The axes that were chosen when the sheet opened, in their order, then the others. The order stays while the sheet is open.
    axes: Vec<Offered>,
    presets: Vec<AxisPreset>,
}

/// Request of the user that changes the choice.
enum Change {
    Add(String),
    Remove(String),
    /// Moves the axis at this place before the one that precedes it.
    MoveUp(usize),
    /// These axes instead.
    Choose(Vec<String>),
}

/// State of the open sheet.
pub(crate) struct AxesSheet {
    /// The textures with their own positions.
    library: Arc<Library>,
    /// Names of the chosen axes, in their order.
    chosen: Vec<String>,
    reading: LatestJob<Offer>,
    /// What can be chosen, once it is read, or why it could not be read.
    offer: Option<Result<Offer, &'static str>>,
    evaluation: Evaluation,
}

impl AxesSheet {
    /// Sheet that begins with the axes in use. `library` has the positions that its textures have without chosen axes.
    pub(crate) fn new(library: &Library, axes: &[String], ctx: &Context) -> Self {
        let library = Arc::new(library.clone());
        let mut reading = LatestJob::default();
        let (textures, chosen) = (Arc::clone(&library), axes.to_vec());
        reading.ask(ctx, move || offer_of(&textures, &chosen));
        let evaluation = Evaluation::last(&library, ctx);
        Self { library, chosen: axes.to_vec(), reading, offer: None, evaluation }
    }

    /// Draws the sheet; returns the requested commands.
    pub(crate) fn show(&mut self, ctx: &Context) -> Vec<Command> {
        if let Some(done) = self.reading.collect(ctx) {
            self.offer = Some(done.map_err(|_| strings::BROKEN));
        }
        self.evaluation.collect(&self.library, ctx);
        sheet(ctx, "axes of the space", |ui| {
            ui.set_width(WIDTH);
            self.content_ui(ui)
        })
        .inner
    }

    fn content_ui(&mut self, ui: &mut Ui) -> Vec<Command> {
        let t = tokens(ui.ctx());
        ui.add(Label::new(RichText::new(strings::TITLE).heading().strong()).selectable(false));
        ui.add(Label::new(RichText::new(strings::PURPOSE).color(t.text_weak)).wrap());
        ui.add_space(GAP);
        let change = match &self.offer {
            Some(Ok(offer)) => self.offer_ui(ui, offer),
            Some(Err(reason)) => {
                ui.add(Label::new(RichText::new(*reason).color(t.error)).wrap());
                None
            }
            None => {
                ui.horizontal(|ui| {
                    busy_ui(ui);
                    ui.add(Label::new(strings::LOADING).selectable(false));
                });
                None
            }
        };
        if let Some(change) = change {
            changed(&mut self.chosen, change);
        }
        ui.add_space(GAP);
        evaluate_ui(ui, &mut self.evaluation, &self.library, &self.chosen, matches!(self.offer, Some(Ok(_))));
        ui.add_space(GAP);
        self.foot_ui(ui)
    }

    /// Draws the presets, the list of the axes, and the result of the evaluation; returns the requested change.
    fn offer_ui(&self, ui: &mut Ui, offer: &Offer) -> Option<Change> {
        let mut change = self.presets_ui(ui, offer);
        let height = (ui.ctx().content_rect().height() - AROUND).max(LEAST_LIST);
        ScrollArea::vertical().max_height(height).auto_shrink([false, true]).show(ui, |ui| {
            ui.set_max_width(ui.available_width() - SCROLL_BAR_ROOM);
            change = list_ui(ui, offer, &self.chosen, self.library.textures.len()).or(change.take());
            if let Some(outcome) = self.evaluation.outcome() {
                change = outcome_ui(ui, outcome, &self.chosen).or(change.take());
            }
            scroll_to_focus(ui);
        });
        change
    }

    /// Draws the buttons that choose several axes at once.
    fn presets_ui(&self, ui: &mut Ui, offer: &Offer) -> Option<Change> {
        let mut change = None;
        ui.horizontal_wrapped(|ui| {
            ui.add(Label::new(strings::PRESETS).selectable(false));
            if ui.button(strings::AS_PLACED).on_hover_text(strings::AS_PLACED_HELP).clicked() {
                let own = self.library.axis_names().into_iter().map(str::to_owned);
                change = Some(Change::Choose(own.collect()));
            }
            for preset in &offer.presets {
                if ui.button(sentence(preset.name)).on_hover_text(preset.axes.join(", ")).clicked() {
                    change = Some(Change::Choose(preset.axes.clone()));
                }
            }
            let swap = ui.add_enabled(self.chosen.len() > 1, Button::new(strings::SWAP_FIRST));
            if swap.on_hover_text(strings::SWAP_FIRST_HELP).clicked() {
                change = Some(Change::MoveUp(1));
            }
        });
        change
    }

    /// Draws the number of textures that have all chosen axes, and the buttons that use them or close the sheet.
    fn foot_ui(&self, ui: &mut Ui) -> Vec<Command> {
        let t = tokens(ui.ctx());
        let mut commands = Vec::new();
        let n_placed = match &self.offer {
            Some(Ok(offer)) => n_placed(offer, &self.chosen, self.library.textures.len()),
            _ => 0,
        };
        let is_read = matches!(self.offer, Some(Ok(_)));
        let (text, color) = match (is_read, n_placed) {
            (false, _) => (String::new(), t.text_weak),
            (true, 0) => (strings::NO_TEXTURE.to_owned(), t.warning),
            (true, n) => (strings::n_placed(n, self.library.textures.len()), t.text_weak),
        };
        ui.add(Label::new(RichText::new(text).color(color)).selectable(false));
        foot_ui(ui, |ui| {
            if primary_ui(ui, strings::USE, n_placed > 0).on_hover_text(strings::USE_HELP).clicked() {
                let chosen = AxesCommand::Use(self.chosen.clone());
                commands.extend([Command::CloseSheet, Command::Axes(chosen)]);
            }
            if ui.button(strings::CANCEL).clicked() {
                commands.push(Command::CloseSheet);
            }
        });
        commands
    }
}

/// Axes of a library and presets, with the chosen axes even if no texture has them.
fn offer_of(library: &Library, chosen: &[String]) -> Offer {
    let offered = |name: &str, source| Offered {
        name: name.to_owned(),
        source,
        values: axis_values(library, name).unwrap_or_else(|| vec![None; library.textures.len()]),
    };
    let known = known_axes(library);
    let mut axes: Vec<Offered> = known.iter().map(|axis| offered(&axis.name, Some(axis.source))).collect();
    for name in chosen {
        if !axes.iter().any(|axis| axis.name == *name) {
            let axis = offered(name, None);
            let is_attribute = axis.values.iter().any(Option::is_some);
            axes.push(Offered { source: is_attribute.then_some(AxisSource::Attribute), ..axis });
        }
    }
    axes.sort_by_key(|axis| chosen.iter().position(|name| *name == axis.name).unwrap_or(chosen.len()));
    Offer { axes, presets: presets(library) }
}

/// Number of the textures that have all chosen axes, of `n` textures.
fn n_placed(offer: &Offer, chosen: &[String], n: usize) -> usize {
    let value = |name: &String, texture: usize| {
        let axis = offer.axes.iter().find(|axis| axis.name == *name)?;
        *axis.values.get(texture)?
    };
    (0..n).filter(|texture| chosen.iter().all(|name| value(name, *texture).is_some())).count()
}

/// Whether one of the chosen axes has this name, or is an attribute of it ([`is_same_axis`]).
fn is_chosen(chosen: &[String], name: &str) -> bool {
    chosen.iter().any(|known| is_same_axis(known, name))
}

/// Carries out a change: there are always one to six different axes.
fn changed(chosen: &mut Vec<String>, change: Change) {
    match change {
        Change::Add(name) => {
            if chosen.len() < MOST_AXES && !is_chosen(chosen, &name) {
                chosen.push(name);
            }
        }
        Change::Remove(name) => {
            if chosen.len() > 1 {
                chosen.retain(|known| *known != name);
            }
        }
        Change::MoveUp(place) => {
            if place > 0 && place < chosen.len() {
                chosen.swap(place - 1, place);
            }
        }
        Change::Choose(axes) => *chosen = axes,
    }
}

#[cfg(test)]
mod tests {
    use super::{AxisSource, Change, changed, n_placed, offer_of};
    use shagreen_formats::starter::{simulated_library, starter_library};

    fn names(axes: &[&str]) -> Vec<String> {
        axes.iter().map(|name| (*name).to_owned()).collect()
    }

    #[test]
    fn a_choice_has_one_to_six_different_axes() {
        let mut chosen = names(&["a"]);
        changed(&mut chosen, Change::Remove("a".to_owned()));
        assert_eq!(chosen, ["a"]);
        for name in ["b", "b", "B", "attribute:a", "attribute:A", "c", "d", "e", "f", "g"] {
            changed(&mut chosen, Change::Add(name.to_owned()));
        }
        assert_eq!(chosen, ["a", "b", "c", "d", "e", "f"]);
        changed(&mut chosen, Change::MoveUp(0));
        changed(&mut chosen, Change::MoveUp(6));
        changed(&mut chosen, Change::MoveUp(2));
        assert_eq!(chosen[..3], ["a", "c", "b"]);
        changed(&mut chosen, Change::Choose(names(&["x", "y"])));
        assert_eq!(chosen, ["x", "y"]);
    }

    #[test]
    fn known_and_chosen_axes_are_offered_with_the_textures_that_have_them() {
        let library = simulated_library().unwrap();
        let chosen = names(&["attribute:rough-smooth", "sour-sweet"]);
        let offer = offer_of(&library, &chosen);
        let source = |name: &str| offer.axes.iter().find(|axis| axis.name == name).unwrap().source;
        assert_eq!(source("rough-smooth"), Some(AxisSource::Position(0)));
        assert_eq!(
            (source("sour-sweet"), source("attribute:rough-smooth")),
            (None, Some(AxisSource::Attribute))
        );
        let n = library.textures.len();
        assert_eq!(n_placed(&offer, &chosen, n), 0);
        assert_eq!(n_placed(&offer, &names(&["rough-smooth", "flat-bumpy", "centroid"]), n), n);
        let order: Vec<&str> = offer.axes.iter().map(|axis| axis.name.as_str()).collect();
        assert_eq!(order[..3], ["attribute:rough-smooth", "sour-sweet", "rough-smooth"]);
        assert_eq!(offer.presets.len(), 2);
        assert_eq!(offer_of(&starter_library().unwrap(), &[]).presets.len(), 1);
    }
}
