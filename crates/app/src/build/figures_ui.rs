//! Figures of a space: one tab for each, one for the mean ratings on all pairs, and buttons that save the figure.

use std::sync::Arc;

use egui::{Align, ComboBox, Layout, Ui, UiBuilder, vec2};
use shagreen_core::space::LabelSource;
use shagreen_formats::space_report::RATING_FIGURE;

use crate::command::Command;
use crate::figure_ui::figure_ui;
use crate::look::list::ShowList as _;
use crate::look::theme::GAP;
use crate::state::figure_file::{FigureFile, FigureFormat};
use crate::strings::build as strings;
use shagreen_studio::space::BuiltSpace;

/// Height of the row of buttons below a figure, in points.
const FOOT: f32 = 28.0;
/// Width of the choice of an adjective pair, in points.
const PAIR_WIDTH: f32 = 200.0;

/// Draws the tabs and the figure with index `shown`; returns the requested command.
pub(super) fn figures_ui(ui: &mut Ui, built: &BuiltSpace, shown: &mut usize) -> Option<Command> {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(2.0, 2.0);
        ui.spacing_mut().button_padding.x = 7.0;
        let all = (0..built.figures.len()).filter(|index| !is_of_ratings(built, *index));
        for index in all {
            ui.selectable_value(shown, index, strings::figure(&built.figures[index].0));
        }
        // The figures of mean ratings share a tab.
        if let Some(first) = (0..built.figures.len()).find(|index| is_of_ratings(built, *index)) {
            let is_shown = is_of_ratings(built, *shown);
            let tab = ui.selectable_label(is_shown, strings::figure(&built.figures[first].0));
            if tab.clicked() && !is_shown {
                *shown = first;
            }
        }
    });
    rated_pair_ui(ui, built, shown);
    ui.add_space(GAP);
    let (name, figure) = built.figures.get(*shown)?;
    let area = ui.available_rect_before_wrap();
    let (above, foot) = area.split_top_bottom_at_y(area.bottom() - FOOT);
    let builder = UiBuilder::new()
        .max_rect(above.with_max_y(above.bottom() - GAP))
        .layout(Layout::top_down(Align::Min));
    figure_ui(&mut ui.new_child(builder), name, figure);
    let builder = UiBuilder::new().max_rect(foot).layout(Layout::right_to_left(Align::Center));
    let mut foot = ui.new_child(builder);
    let mut asked = None;
    for (word, format) in [
        (strings::SAVE_CSV, FigureFormat::Csv),
        (strings::SAVE_PNG, FigureFormat::Png),
        (strings::SAVE_SVG, FigureFormat::Svg),
    ] {
        if foot.button(word).clicked() {
            let source = built.build.source;
            let stem = if source == LabelSource::HumanRatings {
                name.clone()
            } else {
                format!("{}-{name}", source.id())
            };
            asked = Some(Command::SaveFigure(FigureFile { stem, figure: Arc::clone(figure), format }));
        }
    }
    asked
}

/// Whether the figure with this index shows the mean ratings on a pair.
fn is_of_ratings(built: &BuiltSpace, index: usize) -> bool {
    built.figures.get(index).is_some_and(|(name, _)| name.starts_with(RATING_FIGURE))
}

/// Draws the choice of the adjective pair, if mean ratings are shown.
fn rated_pair_ui(ui: &mut Ui, built: &BuiltSpace, shown: &mut usize) {
    if !is_of_ratings(built, *shown) {
        return;
    }
    let all: Vec<usize> = (0..built.figures.len()).filter(|index| is_of_ratings(built, *index)).collect();
    let pairs = built.build.adjectives.iter().map(|adjective| adjective.pair.name());
    let named: Vec<(usize, String)> = all.into_iter().zip(pairs).collect();
    let current = named.iter().find(|(index, _)| *index == *shown).map_or("", |(_, name)| name.as_str());
    ui.add_space(GAP);
    let combo =
        ComboBox::from_id_salt(strings::RATED_PAIR).width(PAIR_WIDTH).truncate().selected_text(current);
    let combo = combo.show_list(ui, |ui| {
        for (index, name) in &named {
            ui.selectable_value(shown, *index, name);
        }
    });
    combo.response.accessible_name(strings::RATED_PAIR).on_hover_text(strings::RATED_PAIR);
}
