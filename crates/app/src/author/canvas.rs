//! Canvas of the space: textures, triangulation, convex hull and the draggable authored points.

mod axis_words;
mod canvas_menu;
mod drop_ui;
mod estimates_ui;
mod map;
mod no_sites_ui;
mod path_tool;
mod points_ui;
mod site_labels;
mod sites_ui;
mod slice;
mod status_line;
mod tool_bar;
mod view;

use egui::{
    Align2, Context, FontId, PointerButton, Pos2, Rect, Response, Role, Sense, Shape, Stroke, Ui, Vec2,
    WidgetInfo, pos2, vec2,
};
use shagreen_core::space::authoring::Weights;
use shagreen_core::space::{LabelSource, SpacePoint};
use shagreen_core::texture::blend::Mode;

use self::axis_words::{axis_words, grid_ui};
use self::canvas_menu::canvas_menu;
use self::drop_ui::drop_ui;
use self::estimates_ui::{ellipse_ui, site_ellipses_ui};
pub use self::map::ShownMap;
use self::map::map_ui;
use self::no_sites_ui::no_sites_ui;
pub use self::path_tool::PathTool;
use self::path_tool::{number_areas, path_line, path_marker, path_points};
use self::points_ui::{authored_points_ui, lines_to_parents};
use self::sites_ui::sites_ui;
use self::slice::{legend, legend_ui};
use self::status_line::foot_ui;
use self::tool_bar::tool_bar;
use self::view::follow_view;
use crate::author::context_menu::had_open_menu;
use crate::author::prompt::PositionEstimate;
use crate::command::Command;
use crate::look::axes::{Axes, View};
use crate::look::drag::dragged_to;
use crate::look::notice::show_notice;
use crate::look::theme::{Tokens, tokens};
use crate::panel::Panel;
use crate::state::edit::Edit;
use crate::strings::{self};

/// Radius of a texture's picture on the canvas, in points.
const SITE_RADIUS: f32 = 13.0;
/// Radius of such a picture as a share of the height of the canvas, up to a limit in points: it is larger on a large
/// screen.
const SITE_SHARE: f32 = 0.03;
const MAX_SITE_RADIUS: f32 = 28.0;
/// Size of the authored point while it is not pointed at, in points.
const POINT_SIZE: Vec2 = vec2(22.0, 22.0);
const BIG_STEP: f64 = 5.0;

/// Widget id of an authored point, by its key. It does not depend on the selection, so that a drag continues when the
/// selection changes.
pub fn point_id(key: u32) -> egui::Id {
    egui::Id::unique(("authored point", key))
}

/// View state of the canvas.
#[derive(Default)]
pub struct CanvasState {
    /// Tool that draws paths.
    pub tool: PathTool,
    /// Visible part of the space.
    pub view: View,
    /// Texture under the pointer in the last frame.
    pub(crate) pointed: Option<usize>,
    /// Area of the controls above the canvas in the last frame.
    bar: Option<Rect>,
    /// Whether the canvas is too narrow to state the source of the positions beside its controls.
    pub(crate) is_narrow: bool,
    /// Whether the last press was beside the view, where it moves nothing.
    is_pressed_beside: bool,
}

/// Canvas width below which the controls need the width of all rows, in points.
const NARROW_WIDTH: f32 = 520.0;
/// Height of one row of controls, in points.
const BAR_ROW: f32 = 25.0;
/// Distance between the source of the positions and the legend of a slice, in points.
const LEGEND_GAP: f32 = 1.0;
/// Distances of the controls from the upper edge of the canvas, and of the textures from the controls, in points.
const BAR_TOP: f32 = 3.0;
const BELOW_BAR: f32 = 4.0;
/// Width of the strip left of the textures, with the words of the y axis, and margin on the right, in points.
const LEFT_OF_SITES: f32 = 23.0;
const RIGHT: f32 = 36.0;

/// Distance beyond the view within which items are still drawn, in points.
const AROUND_VIEW: f32 = 30.0;
/// Height of the strip below the items, with the words of the x axis and the message about the audible texture, in points.
const FOOT: f32 = 26.0;

/// Draws the canvas; returns the requested commands.
pub fn canvas_ui(
    ui: &mut Ui,
    panel: &Panel<'_>,
    state: &mut CanvasState,
    map: Option<&ShownMap>,
    guess: Option<&PositionEstimate>,
) -> Vec<Command> {
    let t = tokens(ui.ctx());
    let mut commands = Vec::new();
    let (outer, background) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
    background.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, strings::CANVAS));
    // Further rows of controls move the canvas down, so that they cover no texture.
    let bar_height = state.bar.as_ref().map_or(0.0, Rect::height).max(BAR_ROW);
    // The picture of a texture at the upper edge of the space is below the controls, too.
    let top = BAR_TOP + bar_height + radius_for(outer.height()) + BELOW_BAR;
    let left = LEFT_OF_SITES + radius_for(outer.height());
    let rect = Rect::from_min_max(outer.min + vec2(left, top), outer.max - vec2(RIGHT, FOOT + AROUND_VIEW));
    state.view = follow_view(ui, Axes { rect, view: state.view }, &background);
    let axes = Axes { rect, view: state.view };
    if let Some(pressed_at) = ui.input(|i| i.pointer.press_origin()) {
        state.is_pressed_beside = !rect.expand(SITE_RADIUS).contains(pressed_at);
    }
    let tool = &mut state.tool;
    ui.painter().rect_filled(outer, f32::from(crate::look::theme::RADIUS), t.background);
    if let Some(map) = map {
        map_ui(ui, axes, map);
    }
    grid_ui(ui, axes, t);
    let axis_words = axis_words(ui, axes, outer, panel.session.poles(), t);
    let mut words: Vec<Rect> = axis_words.iter().map(|word| word.area).collect();
    state.is_narrow = outer.width() < NARROW_WIDTH;
    let corner = pos2(axes.rect.right(), outer.top() + 5.0);
    let source = (!state.is_narrow).then(|| source_ui(ui, corner, panel, t));
    words.extend(source);
    // In a narrow canvas, the strip below the items has the legend.
    let below = source.map(|source| pos2(corner.x, source.bottom() + LEGEND_GAP));
    let lines = legend(panel, map);
    let legend = below.and_then(|below| legend_ui(ui, below, &lines, t));
    words.extend(legend);
    // Names of textures keep clear of the controls and of the numbers of the path points, too.
    words.extend(state.bar);
    words.extend(number_areas(ui, axes, panel, tool));
    let (seen, beside_view) = (ui.clip_rect(), ui.painter().clone());
    // Items beyond the view must not overlap the axis labels.
    ui.set_clip_rect(rect.expand(AROUND_VIEW).intersect(seen));
    triangles(ui, axes, panel, t);
    path_line(ui, axes, panel, t);
    lines_to_parents(ui, axes, panel, t);
    site_ellipses_ui(ui, axes, panel, t);
    if let Some(on_canvas) = guess.and_then(PositionEstimate::on_canvas) {
        ellipse_ui(ui, axes, on_canvas, t.accent);
    }
    // A click beside an open menu only closes it.
    let is_click = background.clicked() && !had_open_menu(ui.ctx());
    let clicked_at = background.interact_pointer_pos().filter(|_| is_click);
    if tool.is_on {
        commands.extend(tool.follow(ui, axes, panel, &background));
    } else if let Some(pos) =
        dragged_by_primary(ui, &background).or(clicked_at).filter(|_| !state.is_pressed_beside)
    {
        let to = panel.on_slice(axes.space_from_ui(pos));
        if clicked_at.is_some() && to != panel.project.texture().at {
            say_moved(ui.ctx(), &panel.project.texture().name);
        }
        commands.push(move_to(to));
    }
    let sites = sites_ui(ui, axes, panel, tool, &words, t);
    commands.extend(sites.commands);
    state.pointed = sites.pointed;
    // A texture at the left edge may reach into the strip of these words.
    for word in axis_words {
        word.show(&beside_view, t);
    }
    commands.extend(no_sites_ui(ui, axes, panel, t));
    commands.extend(authored_points_ui(ui, axes, panel, tool, &sites.covered, t));
    commands.extend(path_points(ui, axes, panel, tool, t));
    path_marker(ui, axes, panel, t);
    ui.set_clip_rect(seen);
    let beside = [source, legend].into_iter().flatten().map(|words| words.left());
    let width = beside.fold(outer.right(), f32::min) - outer.left() - 44.0;
    let bar = tool_bar(ui, axes, outer, width, panel, tool, map, t);
    commands.extend(bar.commands);
    state.view = bar.view.unwrap_or(state.view);
    state.bar = Some(bar.area);
    commands.extend(drop_ui(ui, axes, outer, panel, t));
    commands.extend(canvas_menu(&background, axes, panel, map));
    let asks_for_path = state.tool.is_on && panel.project.texture().path.is_none();
    let lines: &[String] = if state.is_narrow { &lines } else { &[] };
    commands.extend(foot_ui(ui, outer, &words, panel, (asks_for_path, lines), t));
    commands
}

/// Says in the status bar that a click has moved a texture, and how to undo that.
fn say_moved(ctx: &Context, name: &str) {
    let keys = Command::Undo.shortcut_text(ctx);
    show_notice(ctx, strings::moved_by_click(name, &keys));
}

/// Position to which the primary button drags the background. Other buttons move the view.
fn dragged_by_primary(ui: &Ui, background: &Response) -> Option<Pos2> {
    let is_primary =
        background.dragged_by(PointerButton::Primary) || background.drag_stopped_by(PointerButton::Primary);
    dragged_to(ui, background).filter(|_| is_primary)
}

/// Radius of the picture of a texture, in points.
fn site_radius(axes: Axes) -> f32 {
    radius_for(axes.rect.height())
}

fn radius_for(height: f32) -> f32 {
    (SITE_SHARE * height).clamp(SITE_RADIUS, MAX_SITE_RADIUS)
}

fn move_to(point: SpacePoint) -> Command {
    Command::Edit(Edit::MovePoint(point))
}

/// Draws the source of the positions with its upper right corner at `corner`; returns its rectangle.
fn source_ui(ui: &Ui, corner: Pos2, panel: &Panel<'_>, t: &Tokens) -> Rect {
    let is_simulated = panel.session.is_simulated();
    let mut words = strings::places_from(panel.session.label_source());
    if panel.session.common_source() == Some(LabelSource::SimulatedRaters) {
        words.push_str(strings::NOBODY_FELT);
    } else if is_simulated {
        words.push_str(strings::SOME_SIMULATED);
    }
    let color = if is_simulated { t.warning } else { t.text_weak };
    let area = ui.painter().text(corner, Align2::RIGHT_TOP, &words, FontId::proportional(11.5), color);
    let response = ui.interact(area, ui.scope_id().with("source of places"), Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, &words));
    response.on_hover_text(strings::SOURCE_HELP);
    area
}

fn triangles(ui: &Ui, axes: Axes, panel: &Panel<'_>, t: &Tokens) {
    let authoring = panel.session.authoring_of(panel.inspected());
    let space = authoring.space();
    let at = |texture: usize| space.position(texture).map(|p| axes.ui_from_space(p));
    let painter = ui.painter();
    // The triangle is highlighted only in modes that interpolate its corners.
    let blending = panel.session.blending(&panel.inspected().blend);
    let is_of_corners = blending.mode != Mode::Field && blending.weights == Weights::Barycentric;
    let authored = panel.session.authored().filter(|_| is_of_corners);
    let corners: Vec<usize> =
        authored.map_or(Vec::new(), |a| a.location.corners.iter().map(|(texture, _)| *texture).collect());
    // Each edge is a separate line: the joins of a thin triangle's outline would extend far beyond its corners.
    let thin = Stroke::new(1.0, t.line);
    for triangle in space.triangles() {
        let points: Vec<Pos2> = triangle.iter().filter_map(|i| at(*i)).collect();
        let [a, b, c] = points[..] else { continue };
        let [i, j, k] = triangle;
        let edges = [([i, j], [a, b]), ([j, k], [b, c]), ([k, i], [c, a])];
        if corners.len() == 3 && triangle.iter().all(|i| corners.contains(i)) {
            let mut fill = egui::Mesh::default();
            for p in [a, b, c] {
                fill.colored_vertex(p, t.accent.gamma_multiply(0.14));
            }
            fill.add_triangle(0, 1, 2);
            painter.add(Shape::mesh(fill));
            for (_, edge) in edges {
                painter.line_segment(edge, Stroke::new(1.6, t.accent.gamma_multiply(0.6)));
            }
        } else {
            // All triangles have the same orientation, so a shared edge occurs once in each direction. Edges of a
            // single triangle form the convex hull.
            for (_, edge) in edges.into_iter().filter(|([from, to], _)| from < to) {
                painter.line_segment(edge, thin);
            }
        }
    }
    for [a, b] in space.hull() {
        if let (Some(a), Some(b)) = (at(a), at(b)) {
            painter.line_segment([a, b], Stroke::new(1.6, t.text_weak.gamma_multiply(0.55)));
        }
    }
}
