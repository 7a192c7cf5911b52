//! How the space is made.

use egui::{ComboBox, DragValue, Grid, Label, RichText, Ui};
use shagreen_core::mds::{MAX_DIMS, Ties};
use shagreen_core::ratings::{AdjectivePair, Rating};
use shagreen_core::selection::Method;
use shagreen_core::space_build::{FeatureKind, Placement, SpaceOptions};

use crate::axes_choice::with_axis;
use crate::strings::build as strings;
use crate::theme::{GAP, tokens};

/// Width of the controls, in points.
const CONTROL_WIDTH: f32 = 182.0;
/// The most permutations that can be asked for: a chance is then known to a ten thousandth.
const MAX_PERMUTATIONS: usize = 10_000;

/// Draws the options; the pairs of the `ratings` can be axes.
pub(super) fn options_ui(ui: &mut Ui, options: &mut SpaceOptions, ratings: &[Rating]) {
    ui.heading(strings::OPTIONS);
    Grid::new("build options").num_columns(2).spacing([2.0 * GAP, GAP]).show(ui, |ui| {
        row(ui, strings::DIMENSIONS, strings::DIMENSIONS_HELP, |ui| {
            ui.add(DragValue::new(&mut options.n_dims).range(2..=MAX_DIMS).speed(0.05))
        });
        choice(
            ui,
            strings::TIES,
            strings::TIES_HELP,
            &mut options.mds.ties,
            &[Ties::Primary, Ties::Secondary],
            |ties| strings::ties(*ties).to_owned(),
        );
        axes_ui(ui, &mut options.axes, &pairs_of(ratings));
        choice(
            ui,
            strings::FEATURES,
            strings::FEATURES_HELP,
            &mut options.features,
            &FeatureKind::ALL,
            |kind| strings::features(*kind).to_owned(),
        );
        choice(
            ui,
            strings::SELECTION,
            strings::SELECTION_HELP,
            &mut options.method,
            &Method::ALL,
            |method| strings::selection(*method).to_owned(),
        );
        let placements = [Placement::Felt, Placement::Predicted];
        choice(
            ui,
            strings::PLACEMENT,
            strings::PLACEMENT_HELP,
            &mut options.placement,
            &placements,
            |placement| strings::placement(*placement).to_owned(),
        );
        row(ui, strings::PERMUTATIONS, strings::PERMUTATIONS_HELP, |ui| {
            ui.add(DragValue::new(&mut options.n_permutations).range(0..=MAX_PERMUTATIONS).speed(5.0))
        });
        row(ui, strings::SEED, strings::SEED_HELP, |ui| ui.add(DragValue::new(&mut options.seed).speed(0.1)));
    });
    ui.checkbox(&mut options.is_orthogonal, strings::ORTHOGONAL).on_hover_text(strings::ORTHOGONAL_HELP);
}

fn row(ui: &mut Ui, name: &str, help: &str, control: impl FnOnce(&mut Ui) -> egui::Response) {
    let t = tokens(ui.ctx());
    ui.add(Label::new(RichText::new(name).color(t.text_weak)).selectable(false)).on_hover_text(help);
    control(ui).accessible_name(name).on_hover_text(help);
    ui.end_row();
}

fn choice<T: Clone + PartialEq>(
    ui: &mut Ui,
    name: &str,
    help: &str,
    current: &mut T,
    all: &[T],
    word: impl Fn(&T) -> String,
) {
    row(ui, name, help, |ui| {
        let combo = ComboBox::from_id_salt(name).width(CONTROL_WIDTH).truncate().selected_text(word(current));
        let combo = combo.show_ui(ui, |ui| {
            for each in all {
                ui.selectable_value(current, each.clone(), word(each));
            }
        });
        combo.response
    });
}

/// The two axes: both automatic, or both chosen.
fn axes_ui(ui: &mut Ui, axes: &mut Option<[AdjectivePair; 2]>, pairs: &[AdjectivePair]) {
    if axes.iter().flatten().any(|pair| !pairs.contains(pair)) {
        // Other ratings were read since.
        *axes = None;
    }
    for (axis, name) in [(0, strings::FIRST_AXIS), (1, strings::SECOND_AXIS)] {
        let all: Vec<Option<&AdjectivePair>> = std::iter::once(None).chain(pairs.iter().map(Some)).collect();
        let before = axes.clone();
        let mut current = before.as_ref().map(|axes| &axes[axis]);
        let was = current;
        choice(ui, name, strings::AXIS_HELP, &mut current, &all, |pair| {
            pair.map_or_else(|| strings::AUTOMATIC.to_owned(), AdjectivePair::name)
        });
        if current != was {
            *axes = current.and_then(|chosen| with_axis(before.as_ref(), pairs, axis, chosen));
        }
    }
}

/// The pairs of ratings, in the order of their first appearance.
fn pairs_of(ratings: &[Rating]) -> Vec<AdjectivePair> {
    let mut pairs: Vec<AdjectivePair> = Vec::new();
    for rating in ratings {
        if !pairs.contains(&rating.pair) {
            pairs.push(rating.pair.clone());
        }
    }
    pairs
}
