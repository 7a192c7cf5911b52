//! The figures of a space: a tab for each, one large, and its way into a file.

use std::sync::Arc;

use egui::{Align, Layout, Ui, UiBuilder, vec2};
use shagreen_core::space::LabelSource;

use crate::build::page::Built;
use crate::command::Command;
use crate::figure_ui::figure_ui;
use crate::save::{FigureFile, FigureFormat};
use crate::strings::build as strings;
use crate::theme::GAP;

/// Height of the row of buttons under a figure, in points.
const FOOT: f32 = 28.0;

/// Draws the tabs and the figure that is `shown`, and returns what the user asked of it.
pub(super) fn figures_ui(ui: &mut Ui, built: &Built, shown: &mut usize) -> Option<Command> {
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
