//! Figures of a space: one tab for each, and a menu that saves the figure.

use std::sync::Arc;

use egui::{Align, Layout, Ui, UiBuilder, vec2};
use shagreen_core::space::LabelSource;

use crate::command::Command;
use crate::figure_ui::figure_ui;
use crate::look::theme::GAP;
use crate::state::figure_file::{FigureFile, FigureFormat};
use crate::strings::build as strings;
use shagreen_studio::space::BuiltSpace;

/// Height of the row of buttons below a figure, in points.
const FOOT: f32 = 28.0;

/// Draws the tabs and the figure with index `shown`; returns the requested command.
pub(super) fn figures_ui(ui: &mut Ui, built: &BuiltSpace, shown: &mut usize) -> Option<Command> {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(2.0, 2.0);
        ui.spacing_mut().button_padding.x = 7.0;
        for (index, (name, _)) in built.figures.iter().enumerate() {
            ui.selectable_value(shown, index, strings::figure(name));
        }
    });
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
                (*name).to_owned()
            } else {
                format!("{}-{name}", source.id())
            };
            asked = Some(Command::SaveFigure(FigureFile { stem, figure: Arc::clone(figure), format }));
        }
    }
    asked
}
