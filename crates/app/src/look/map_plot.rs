//! Plot of a map: a value over two axes as colors.

use egui::{ColorImage, Id, Label, RichText, Sense, TextureHandle, TextureOptions, Ui, vec2};
use egui_plot::{AxisHints, Plot, PlotImage, PlotPoint, PlotResponse, uniform_grid_spacer};
use shagreen_formats::figure::Map;

use crate::look::color_bar::color_bar;
use crate::look::plot::{after_start, fixed, nice_step, short, x_axis, y_axis};
use crate::look::theme::{map_color, tokens};

/// Draws a map into the available space; `name` is its id.
pub(crate) fn map_plot(ui: &mut Ui, name: &str, map: &Map) -> PlotResponse<()> {
    show(ui, name, map, x_axis(), y_axis())
}

/// Same as [`map_plot`], with axis labels.
pub(crate) fn labeled_map_plot(ui: &mut Ui, name: &str, map: &Map) -> PlotResponse<()> {
    let label = |text: &str| RichText::new(text).small();
    let across = x_axis().label(label(&map.x_label));
    show(ui, name, map, across, y_axis().label(label(&map.y_label)))
}

/// Draws the color key of a map in a row: lowest value, colors, highest value.
pub(crate) fn color_key_ui(ui: &mut Ui, map: &Map) {
    const WIDTH: f32 = 44.0;
    let t = tokens(ui.ctx());
    let word = |ui: &mut Ui, text: String| {
        let text = RichText::new(text).small().color(t.text_weak);
        ui.add(Label::new(text).selectable(false)).on_hover_text(&map.value_label);
    };
    word(ui, format!("{:.0} {}", map.range.1 + 0.0, map.value_unit));
    let (area, _) = ui.allocate_exact_size(vec2(WIDTH, 8.0), Sense::hover());
    ui.painter().add(color_bar(area, map_color));
    word(ui, format!("{:.0}", map.range.0 + 0.0));
}

fn show(ui: &mut Ui, name: &str, map: &Map, across: AxisHints<'_>, up: AxisHints<'_>) -> PlotResponse<()> {
    let t = tokens(ui.ctx());
    let picture = picture(ui, Id::unique(("colors of a map", name)), map);
    let middle = PlotPoint::new(0.5 * (map.x.0 + map.x.1), 0.5 * (map.y.0 + map.y.1));
    let size = vec2((map.x.1 - map.x.0) as f32, (map.y.1 - map.y.0) as f32);
    let (x, y) = (map.x, map.y);
    // At least five numbers.
    let step = nice_step(0.4 * (x.1 - x.0));
    let across = across.formatter(after_start(x.0, short));
    let plot = fixed(Plot::new(name.to_owned()), t.line)
        .custom_x_axes(vec![across])
        .custom_y_axes(vec![up])
        .x_grid_spacer(uniform_grid_spacer(move |_| [5.0 * step, step, step]))
        .height(ui.available_height());
    plot.show(ui, move |plot| {
        plot.set_plot_bounds_x(x.0..=x.1);
        plot.set_plot_bounds_y(y.0..=y.1);
        plot.image(PlotImage::new("", &picture, middle, size).allow_hover(false));
    })
}

/// Image of the map on the graphics card, which is reused from frame to frame.
fn picture(ui: &Ui, id: Id, map: &Map) -> TextureHandle {
    let width = map.rows.first().map_or(0, Vec::len);
    // The first row of an image is the highest row of the map.
    let pixels = map.rows.iter().rev().flatten().map(|value| map_color(map.share(*value) as f32)).collect();
    let image = ColorImage::new([width, map.rows.len()], pixels);
    let kept = ui.data(|data| data.get_temp::<TextureHandle>(id));
    if let Some(mut handle) = kept {
        handle.set(image, TextureOptions::LINEAR);
        handle
    } else {
        let handle = ui.ctx().load_texture("colors of a map", image, TextureOptions::LINEAR);
        ui.data_mut(|data| data.insert_temp(id, handle.clone()));
        handle
    }
}
