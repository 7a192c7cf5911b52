//! Options for building a space.

use egui::{Checkbox, ComboBox, DragValue, Grid, Label, Response, RichText, Ui};
use shagreen_core::people::mds::{MAX_DIMS, Transform};
use shagreen_core::people::ratings::{AdjectivePair, Rating};
use shagreen_core::space::selection::Method;
use shagreen_core::space::space_build::{FeatureKind, PlacedBy, SpaceOptions};

use crate::look::list::ShowList as _;
use crate::look::theme::{GAP, tokens};
use crate::strings::build as strings;

/// Width of the controls, in points.
const CONTROL_WIDTH: f32 = 182.0;
/// Distance between rows, in points: all options are visible in a window 720 points high.
const ROW_GAP: f32 = 4.0;
/// Maximum number of permutations: enough to resolve a p-value of 0.0001.
const MAX_PERMUTATIONS: usize = 10_000;

/// Treatments of ties; `None` selects one.
const TIES: [Option<Transform>; 4] =
    [None, Some(Transform::PrimaryTies), Some(Transform::SecondaryTies), Some(Transform::Interval)];

/// Draws the options; the adjective pairs in `ratings` can be chosen as axes. If there are ratings without sorts, options of
/// the perceptual space are disabled.
pub(super) fn options_ui(ui: &mut Ui, options: &mut SpaceOptions, ratings: &[Rating], is_rated_alone: bool) {
    ui.heading(strings::OPTIONS);
    Grid::new("build options").num_columns(2).spacing([2.0 * GAP, ROW_GAP]).show(ui, |ui| {
        row(ui, strings::DIMENSIONS, strings::DIMENSIONS_HELP, |ui| {
            let dimensions = DragValue::new(&mut options.n_dims).range(2..=MAX_DIMS).speed(0.05);
            let response = ui.add_enabled(!is_rated_alone, dimensions);
            let response = response.on_disabled_hover_text(strings::NEEDS_SORTS);
            beside(ui, strings::TIES, strings::TIES_HELP);
            let width = ui.max_rect().left() + CONTROL_WIDTH - ui.cursor().left();
            let ties = ui.add_enabled_ui(!is_rated_alone, |ui| {
                combo(ui, strings::TIES, width, &mut options.transform, &TIES, |ties| {
                    strings::ties(*ties).to_owned()
                })
            });
            ties.inner
                .accessible_name(strings::TIES)
                .on_hover_text(strings::TIES_HELP)
                .on_disabled_hover_text(strings::NEEDS_SORTS);
            response
        });
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
        let placements = [None, Some(PlacedBy::Felt), Some(PlacedBy::Predicted)];
        choice(
            ui,
            strings::PLACEMENT,
            strings::PLACEMENT_HELP,
            &mut options.placement,
            &placements,
            |placement| strings::placement(*placement).to_owned(),
        );
        row(ui, strings::PERMUTATIONS, strings::PERMUTATIONS_HELP, |ui| {
            let permutations = DragValue::new(&mut options.n_permutations);
            let response = ui.add(permutations.range(0..=MAX_PERMUTATIONS).speed(5.0));
            beside(ui, strings::SEED, strings::SEED_HELP);
            ui.add(DragValue::new(&mut options.seed).speed(0.1))
                .accessible_name(strings::SEED)
                .on_hover_text(strings::SEED_HELP);
            response
        });
    });
    let orthogonal = Checkbox::new(&mut options.is_orthogonal, strings::ORTHOGONAL);
    ui.add_enabled(!is_rated_alone, orthogonal)
        .on_hover_text(strings::ORTHOGONAL_HELP)
        .on_disabled_hover_text(strings::NEEDS_SORTS);
}

/// Draws a row with the label of its first control; other controls may follow in it.
fn row(ui: &mut Ui, name: &str, help: &str, controls: impl FnOnce(&mut Ui) -> Response) {
    word(ui, name, help);
    ui.horizontal(|ui| controls(ui).accessible_name(name).on_hover_text(help));
    ui.end_row();
}

/// Draws the label of a second control in a row.
fn beside(ui: &mut Ui, name: &str, help: &str) {
    ui.add_space(GAP);
    word(ui, name, help);
}

fn word(ui: &mut Ui, name: &str, help: &str) {
    let text = RichText::new(name).color(tokens(ui.ctx()).text_weak);
    ui.add(Label::new(text).selectable(false)).on_hover_text(help);
}

fn choice<T: Clone + PartialEq>(
    ui: &mut Ui,
    name: &str,
    help: &str,
    current: &mut T,
    all: &[T],
    word: impl Fn(&T) -> String,
) {
    row(ui, name, help, |ui| combo(ui, name, CONTROL_WIDTH, current, all, word));
}

fn combo<T: Clone + PartialEq>(
    ui: &mut Ui,
    name: &str,
    width: f32,
    current: &mut T,
    all: &[T],
    word: impl Fn(&T) -> String,
) -> Response {
    let combo = ComboBox::from_id_salt(name).width(width).truncate().selected_text(word(current));
    let combo = combo.show_list(ui, |ui| {
        for each in all {
            ui.selectable_value(current, each.clone(), word(each));
        }
    });
    combo.response
}

/// Draws the choice of the two axes: both automatic, or both chosen.
fn axes_ui(ui: &mut Ui, axes: &mut Option<[AdjectivePair; 2]>, pairs: &[AdjectivePair]) {
    if axes.iter().flatten().any(|pair| !pairs.contains(pair)) {
        // Other ratings have been read since.
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

/// Adjective pairs of the ratings, in the order of their first appearance.
fn pairs_of(ratings: &[Rating]) -> Vec<AdjectivePair> {
    let mut pairs: Vec<AdjectivePair> = Vec::new();
    for rating in ratings {
        if !pairs.contains(&rating.pair) {
            pairs.push(rating.pair.clone());
        }
    }
    pairs
}

/// Returns both axes after `chosen` from `all` is assigned to the axis with index `axis`.
/// The other axis keeps its attribute. If that is `chosen` itself, it takes the previous attribute of this axis.
/// Without previous axes it takes the first free attribute. `None` if there is no other attribute.
fn with_axis<T: Clone + PartialEq>(
    before: Option<&[T; 2]>,
    all: &[T],
    axis: usize,
    chosen: &T,
) -> Option<[T; 2]> {
    let known = before.into_iter().flat_map(|axes| [&axes[1 - axis], &axes[axis]]);
    let other = known.chain(all).find(|other| *other != chosen)?.clone();
    Some(if axis == 0 { [chosen.clone(), other] } else { [other, chosen.clone()] })
}

#[cfg(test)]
mod tests {
    use super::with_axis;

    #[test]
    fn choosing_one_axis_never_leaves_two_of_the_same() {
        let check = |before: Option<[char; 2]>, axis: usize, chosen: char, expected: [char; 2]| {
            assert_eq!(with_axis(before.as_ref(), &['a', 'b', 'c'], axis, &chosen), Some(expected));
        };
        check(None, 0, 'a', ['a', 'b']);
        check(None, 1, 'c', ['a', 'c']);
        check(Some(['a', 'b']), 1, 'c', ['a', 'c']);
        // The two axes swap their attributes.
        check(Some(['a', 'b']), 0, 'b', ['b', 'a']);
        assert_eq!(with_axis(None, &['a'], 0, &'a'), None);
    }
}
