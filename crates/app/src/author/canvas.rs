//! Canvas of the space: textures, triangulation, convex hull and the draggable authored points.

mod foot;
mod map;
mod path_tool;
mod site_labels;
mod tool_bar;
mod view;

use egui::{
    Align2, Color32, CursorIcon, FontId, Key, PointerButton, Popup, Pos2, Rect, Response, Role, Sense, Shape,
    Stroke, Ui, Vec2, WidgetInfo, pos2, vec2,
};
use shagreen_core::space::authoring::{Authored, Weights};
use shagreen_core::space::{LabelSource, SpacePoint};
use shagreen_core::texture::blend::Mode;
use shagreen_formats::project::AuthoredTexture;

use self::foot::foot_ui;
pub use self::map::ShownMap;
use self::map::map_ui;
pub use self::path_tool::PathTool;
use self::path_tool::{added, path_line, path_marker, path_points};
use self::site_labels::{Around, site_labels};
use self::tool_bar::tool_bar;
use self::view::follow_view;
use crate::author::authored_panel::authored_menu;
use crate::author::locks::lock_mark;
use crate::author::prompt::Guess;
use crate::author::texture_menu::texture_menu;
use crate::author::texture_picture::place_in_words;
use crate::command::Command;
use crate::look::axes::{Axes, View};
use crate::look::drag::dragged_to;
use crate::look::theme::{Tokens, tokens};
use crate::panel::Panel;
use crate::state::edit::Edit;
use crate::strings::{self, authored};

/// Radius of a texture's picture on the canvas, in points.
const SITE_RADIUS: f32 = 13.0;
/// Size of the authored point while it is not pointed at, in points.
const POINT_SIZE: Vec2 = vec2(22.0, 22.0);
/// Number of vertices of an ellipse.
const ELLIPSE_POINTS: usize = 96;
/// Maximum number of textures shown as pictures; if there are more, each texture is a dot.
const MAX_PICTURES: usize = 60;
/// Step of an arrow key, in axis units (0 to 100). With Shift it is [`BIG_STEP`].
const STEP: f64 = 1.0;
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
    /// Height of the controls above the canvas in the last frame, in points.
    bar_height: f32,
}

/// Canvas width below which the path controls take a second row, in points. That row is reserved before the first path
/// point exists, so that the canvas does not move while points are placed.
const WRAPPING_WIDTH: f32 = 900.0;
/// Height of one row of controls, in points.
const BAR_ROW: f32 = 25.0;

/// Distance beyond the view within which items are still drawn, in points.
const AROUND_VIEW: f32 = 30.0;

/// Draws the canvas; returns the requested commands.
pub fn canvas_ui(
    ui: &mut Ui,
    panel: &Panel<'_>,
    state: &mut CanvasState,
    map: Option<&ShownMap>,
    guess: Option<&Guess>,
) -> Vec<Command> {
    let t = tokens(ui.ctx());
    let mut commands = Vec::new();
    let (outer, background) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
    background.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, strings::CANVAS));
    // Further rows of controls move the canvas down, so that they cover no texture.
    let may_wrap = state.tool.is_on && outer.width() < WRAPPING_WIDTH;
    let bar_height = if may_wrap { state.bar_height.max(2.0 * BAR_ROW) } else { state.bar_height };
    let top = 40.0 + (bar_height - BAR_ROW).max(0.0);
    let rect = Rect::from_min_max(outer.min + vec2(36.0, top), outer.max - vec2(36.0, 48.0));
    state.view = follow_view(ui, Axes { rect, view: state.view }, &background);
    let axes = Axes { rect, view: state.view };
    let tool = &mut state.tool;
    ui.painter().rect_filled(outer, f32::from(crate::look::theme::RADIUS), t.background);
    if let Some(map) = map {
        map_ui(ui, axes, map);
    }
    let mut words = grid(ui, axes, outer, panel.session.poles(), t);
    let source = source_ui(ui, pos2(axes.rect.right(), outer.top() + 5.0), panel, t);
    words.push(source);
    let seen = ui.clip_rect();
    // Items beyond the view must not overlap the axis labels.
    ui.set_clip_rect(rect.expand(AROUND_VIEW).intersect(seen));
    triangles(ui, axes, panel, t);
    path_line(ui, axes, panel, t);
    if let Some(guess) = guess {
        ellipse_ui(ui, axes, guess, t);
    }
    let clicked_at = background.interact_pointer_pos().filter(|_| background.clicked());
    if tool.is_on {
        commands.extend(tool.follow(ui, axes, panel, &background));
    } else if let Some(pos) = dragged_by_primary(ui, &background).or(clicked_at) {
        commands.push(move_to(axes.space_from_ui(pos)));
    }
    commands.extend(sites_ui(ui, axes, panel, tool, &words, map.is_some(), t));
    if panel.session.space().sites().is_empty() {
        let font = FontId::proportional(15.0);
        let message =
            if panel.session.textures().is_empty() { strings::NO_TEXTURES } else { strings::NO_PLACES };
        ui.painter().text(axes.rect.center(), Align2::CENTER_CENTER, message, font, t.warning);
    }
    commands.extend(authored_points_ui(ui, axes, panel, tool, t));
    commands.extend(path_points(ui, axes, panel, tool, t));
    path_marker(ui, axes, panel, t);
    ui.set_clip_rect(seen);
    let width = source.left() - outer.left() - 44.0;
    let bar = tool_bar(ui, axes, outer, width, panel, tool, map, t);
    commands.extend(bar.commands);
    state.view = bar.view.unwrap_or(state.view);
    state.bar_height = bar.height;
    foot_ui(ui, axes, panel, t);
    commands
}

/// Draws an ellipse around the position estimated from a prompt or photo: one standard deviation along each axis.
fn ellipse_ui(ui: &Ui, axes: Axes, guess: &Guess, t: &Tokens) {
    let [across, up] = guess.axes;
    let at = |angle: f64| {
        axes.ui_from_space(SpacePoint {
            rough_smooth: across.mean + across.deviation * angle.cos(),
            hard_soft: up.mean + up.deviation * angle.sin(),
        })
    };
    let n = ELLIPSE_POINTS;
    let mut outline: Vec<Pos2> = (0..n).map(|i| at(std::f64::consts::TAU * i as f64 / n as f64)).collect();
    let fill = t.accent.gamma_multiply(0.07);
    ui.painter().add(Shape::convex_polygon(outline.clone(), fill, Stroke::NONE));
    outline.extend(outline.first().copied());
    ui.painter().extend(Shape::dashed_line(
        &outline,
        Stroke::new(1.4, t.accent.gamma_multiply(0.8)),
        6.0,
        4.0,
    ));
}

/// Position to which the primary button drags the background. Other buttons move the view.
fn dragged_by_primary(ui: &Ui, background: &Response) -> Option<Pos2> {
    let is_primary =
        background.dragged_by(PointerButton::Primary) || background.drag_stopped_by(PointerButton::Primary);
    dragged_to(ui, background).filter(|_| is_primary)
}

fn move_to(point: SpacePoint) -> Command {
    Command::Edit(Edit::MovePoint(point))
}

/// Draws the grid lines and the labels at the ends of the axes; returns the rectangles of these labels.
fn grid(ui: &Ui, axes: Axes, outer: Rect, [across, up]: &[[String; 2]; 2], t: &Tokens) -> Vec<Rect> {
    let painter = ui.painter();
    let faint = Stroke::new(1.0, t.line.gamma_multiply(0.5));
    let r = axes.rect;
    for i in 0..=4 {
        let line = axes
            .ui_from_space(SpacePoint { rough_smooth: 25.0 * f64::from(i), hard_soft: 25.0 * f64::from(i) });
        if r.x_range().expand(1.0).contains(line.x) {
            painter.vline(line.x, r.y_range(), faint);
        }
        if r.y_range().expand(1.0).contains(line.y) {
            painter.hline(r.x_range(), line.y, faint);
        }
    }
    let font = FontId::proportional(13.0);
    let label =
        |pos: Pos2, align: Align2, text: &str| painter.text(pos, align, text, font.clone(), t.text_weak);
    let mut words = vec![
        label(pos2(r.left(), outer.bottom() - 6.0), Align2::LEFT_BOTTOM, &across[0]),
        label(pos2(r.right(), outer.bottom() - 6.0), Align2::RIGHT_BOTTOM, &across[1]),
    ];
    for (text, y) in [(&up[1], r.top()), (&up[0], r.bottom())] {
        let galley = painter.layout_no_wrap(text.clone(), font.clone(), t.text_weak);
        let size = galley.size();
        let y = if y == r.top() { y + size.x } else { y };
        let pos = pos2(outer.left() + 8.0, y);
        let shape = egui::epaint::TextShape::new(pos, galley, t.text_weak);
        painter.add(Shape::Text(shape.with_angle(-std::f32::consts::FRAC_PI_2)));
        words.push(Rect::from_min_max(pos2(pos.x, y - size.x), pos2(pos.x + size.y, y)));
    }
    words
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
    let space = panel.session.space();
    let at = |texture: usize| space.position(texture).map(|p| axes.ui_from_space(p));
    let painter = ui.painter();
    // The triangle is highlighted only in modes that interpolate its corners.
    let blending = panel.session.blending(&panel.project.texture().blend);
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

/// Draws the textures; a click moves the authored point to one of them. Texture names avoid the axis labels in `words`.
fn sites_ui(
    ui: &mut Ui,
    axes: Axes,
    panel: &Panel<'_>,
    tool: &PathTool,
    words: &[Rect],
    on_map: bool,
    t: &Tokens,
) -> Vec<Command> {
    let mut commands = Vec::new();
    let sites = panel.session.space().sites();
    let with_pictures = sites.len() <= MAX_PICTURES;
    let radius = if with_pictures { SITE_RADIUS } else { 3.0 };
    // Contributing textures are drawn last, on top of the others.
    let rank = |texture: usize| panel.session.parent_rank(texture);
    let mut order: Vec<&(usize, SpacePoint)> = sites.iter().collect();
    order.sort_by_key(|(texture, _)| rank(*texture).is_some());
    let mut pointed = None;
    let has_open_menu = Popup::is_any_open(ui.ctx());
    for (texture, at) in order {
        let pos = axes.ui_from_space(*at);
        let entry = &panel.session.textures()[*texture];
        let area = Rect::from_center_size(pos, vec2(2.0 * radius, 2.0 * radius));
        let response = ui.interact(area, ui.scope_id().with(("site", texture)), Sense::click());
        response.widget_info(|| WidgetInfo::labeled(Role::Button, true, strings::go_to(&entry.name)));
        if response.clicked() {
            let added = if tool.is_on { added(panel, *at) } else { Some(move_to(*at)) };
            commands.extend(added);
        }
        site(ui, panel, *texture, pos, radius, &response, t);
        if response.hovered() || response.has_focus() {
            pointed = Some(*texture);
        }
        // With a thousand textures, tooltips and menus are built only where they can be needed.
        if response.hovered() || response.has_focus() || has_open_menu {
            response.context_menu(|ui| commands.extend(texture_menu(ui, panel, *texture)));
            response.on_hover_text(site_help(panel, *texture, *at));
        }
    }
    let named: Vec<(usize, Pos2)> = sites
        .iter()
        .filter(|(texture, _)| with_pictures || rank(*texture).is_some() || pointed == Some(*texture))
        .map(|(texture, at)| (*texture, axes.ui_from_space(*at)))
        .collect();
    let point = Rect::from_center_size(axes.ui_from_space(panel.project.texture().at), POINT_SIZE);
    site_labels(ui, panel, &named, radius, &Around { words, point, on_map }, pointed, t);
    commands
}

/// Tooltip of a texture: its name, position and source, and how the field treats it there.
fn site_help(panel: &Panel<'_>, texture: usize, at: SpacePoint) -> String {
    let name = &panel.session.textures()[texture].name;
    let help = format!("{name}\n{}", place_in_words(panel, texture, at));
    if !panel.project.texture().blend.can_lock() {
        return help;
    }
    let is_locked = panel.is_locked(texture);
    format!("{help}\n{}", if is_locked { strings::LOCKED } else { strings::SMOOTHED })
}

fn site(ui: &Ui, panel: &Panel<'_>, texture: usize, pos: Pos2, radius: f32, response: &Response, t: &Tokens) {
    let painter = ui.painter();
    let rank = panel.session.parent_rank(texture);
    let has_picture = radius >= SITE_RADIUS;
    match panel.pictures.thumbnail(texture) {
        Some(picture) if has_picture => {
            let area = Rect::from_center_size(pos, vec2(2.0 * radius, 2.0 * radius));
            // The middle 40 % of the picture in each direction: at this size its grain remains visible.
            let uv = Rect::from_min_max(pos2(0.3, 0.3), pos2(0.7, 0.7));
            let mesh =
                egui::epaint::RectShape::filled(area, radius, Color32::WHITE).with_texture(picture.id(), uv);
            painter.add(mesh);
        }
        // A dot is one textured disc. Rings around a thousand dots would make up most of all drawn triangles.
        _ => {
            painter.circle_filled(pos, radius, t.text_weak);
        }
    }
    let ring = match rank {
        Some(rank) => Some(Stroke::new(3.0, t.parents[rank.min(2)])),
        None if response.hovered() || response.has_focus() => Some(Stroke::new(2.0, t.text)),
        None => has_picture.then(|| Stroke::new(1.0, t.text_weak.gamma_multiply(0.8))),
    };
    if let Some(ring) = ring {
        painter.circle_stroke(pos, radius, ring);
    }
    if panel.is_locked(texture) {
        let corner = pos + Vec2::angled(-std::f32::consts::FRAC_PI_4) * (radius + 2.0);
        painter.circle_filled(corner, 8.0, t.background);
        lock_mark(painter, corner, true, t.text);
    }
}

/// Draws the authored points, the selected one on top. A click or drag selects another one.
fn authored_points_ui(
    ui: &mut Ui,
    axes: Axes,
    panel: &Panel<'_>,
    tool: &PathTool,
    t: &Tokens,
) -> Vec<Command> {
    let mut commands = Vec::new();
    for (index, texture) in panel.project.authored.iter().enumerate() {
        if index != panel.project.selected {
            commands.extend(other_point_ui(ui, axes, panel, texture, tool, t));
        }
    }
    commands.extend(point_ui(ui, axes, panel, tool, t));
    commands
}

/// Interaction of the authored points: only hovering while a path is drawn, so that clicks and drags reach the canvas.
fn point_sense(tool: &PathTool) -> Sense {
    if tool.is_on { Sense::hover() } else { Sense::click_and_drag() }
}

/// Draws an authored point that is not selected.
fn other_point_ui(
    ui: &mut Ui,
    axes: Axes,
    panel: &Panel<'_>,
    texture: &AuthoredTexture,
    tool: &PathTool,
    t: &Tokens,
) -> Vec<Command> {
    let mut commands = Vec::new();
    let pos = axes.ui_from_space(texture.at);
    let area = Rect::from_center_size(pos, vec2(20.0, 20.0));
    let response = ui.interact(area, point_id(texture.key), point_sense(tool));
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, authored::on_canvas(&texture.name)));
    if response.clicked() || response.drag_started() {
        response.request_focus();
        commands.push(Command::Edit(Edit::Select(texture.key)));
    }
    commands.extend(authored_menu(&response, panel, texture));
    let is_pointed = response.hovered() || response.has_focus();
    let radius = if is_pointed { 8.0 } else { 6.5 };
    ui.painter().circle_filled(pos, radius + 2.0, t.background);
    ui.painter().circle_filled(pos, radius, t.authored[usize::from(texture.color)]);
    ui.painter().circle_filled(pos, 2.5, t.background);
    let name = format!("{} {}", texture.name, texture.at);
    response.on_hover_text(name);
    commands
}

/// Draws the selected authored point with lines to the contributing textures, and handles its drags and arrow keys.
fn point_ui(ui: &mut Ui, axes: Axes, panel: &Panel<'_>, tool: &PathTool, t: &Tokens) -> Vec<Command> {
    let mut commands = Vec::new();
    let texture = panel.project.texture();
    let point = texture.at;
    let pos = axes.ui_from_space(point);
    let id = point_id(texture.key);
    let response = ui.interact(Rect::from_center_size(pos, vec2(28.0, 28.0)), id, point_sense(tool));
    response.widget_info(|| WidgetInfo {
        current_text_value: Some(strings::place_in_words(point, panel.session.poles())),
        ..WidgetInfo::labeled(Role::Slider, true, strings::POINT)
    });
    let response = response.on_hover_and_drag_cursor(CursorIcon::Grab);
    if response.clicked() || response.drag_started() {
        response.request_focus();
    }
    if let Some(pointer) = dragged_to(ui, &response) {
        commands.push(move_to(axes.space_from_ui(pointer)));
    }
    commands.extend(authored_menu(&response, panel, texture));
    if let Some(to) = nudged(ui, id, point) {
        commands.push(move_to(to));
    }
    if let Some(authored) = panel.session.authored() {
        lines_to_parents(ui, axes, panel, authored, t);
        outside_ui(ui, axes, panel, authored, t);
    }
    let grown = if response.hovered() || response.dragged() || response.has_focus() { 11.0 } else { 9.0 };
    ui.painter().circle_filled(pos, grown + 2.0, t.background);
    ui.painter().circle_filled(pos, grown, t.accent);
    ui.painter().circle_filled(pos, 4.5, t.on_accent);
    ui.painter().circle_filled(pos, 3.0, t.authored[usize::from(texture.color)]);
    if response.has_focus() {
        ui.painter().circle_stroke(pos, grown + 4.0, Stroke::new(1.5, t.accent));
    }
    response.on_hover_text(format!("{} {}\n{}", panel.project.texture().name, point, strings::POINT_HELP));
    commands
}

fn lines_to_parents(ui: &Ui, axes: Axes, panel: &Panel<'_>, authored: &Authored, t: &Tokens) {
    let on = axes.ui_from_space(authored.location.at);
    for ((texture, weight), color) in panel.session.shown_parents().iter().zip(t.parents) {
        if let Some(site) = panel.session.space().position(*texture) {
            let width = 1.0 + 4.0 * (*weight as f32).clamp(0.0, 1.0);
            let site = axes.ui_from_space(site);
            let start = site + (on - site).normalized() * SITE_RADIUS.min((on - site).length());
            ui.painter().line_segment([on, start], Stroke::new(width, color.gamma_multiply(0.75)));
        }
    }
}

/// Outside the convex hull: marks the nearest point of the hull that plays instead, or the distance of extrapolation.
fn outside_ui(ui: &Ui, axes: Axes, panel: &Panel<'_>, authored: &Authored, t: &Tokens) {
    let wanted = panel.session.path_point().unwrap_or(panel.project.texture().at);
    let pos = axes.ui_from_space(wanted);
    let on = axes.ui_from_space(authored.location.at);
    let painter = ui.painter();
    if authored.is_extrapolated
        && let Some(nearest) = panel.session.space().locate(wanted)
    {
        let outline = axes.ui_from_space(nearest.at);
        painter.extend(Shape::dashed_line(&[outline, on], Stroke::new(2.0, t.accent), 8.0, 5.0));
        painter.circle_stroke(outline, 4.0, Stroke::new(1.5, t.accent));
        let words =
            painter.layout_no_wrap(strings::EXTRAPOLATED.to_owned(), FontId::proportional(11.5), t.accent);
        // Below the line, and not over the point at its end.
        let below = outline.lerp(on, 0.5) + vec2(0.0, 0.5 * words.size().y + 4.0);
        let area = Rect::from_center_size(below, words.size());
        let point = Rect::from_center_size(pos, POINT_SIZE);
        let overlap = if area.intersects(point) { point.bottom() - area.top() } else { 0.0 };
        let shift = (axes.rect.right() + 30.0 - area.right()).min(0.0);
        let area = area.translate(vec2(shift, overlap));
        painter.rect_filled(area.expand(2.0), 3.0, t.background.gamma_multiply(0.9));
        painter.galley(area.min, words, t.accent);
    }
    if authored.location.clamped {
        painter.extend(Shape::dashed_line(&[pos, on], Stroke::new(1.5, t.warning), 5.0, 4.0));
        painter.circle_filled(on, 4.0, t.warning);
    }
}

/// New position of the point after arrow keys, if it has the keyboard focus or nothing has.
fn nudged(ui: &Ui, id: egui::Id, from: SpacePoint) -> Option<SpacePoint> {
    let focused = ui.memory(egui::Memory::focused);
    if focused.is_some_and(|f| f != id) {
        return None;
    }
    // With the focus on the point, arrow keys move the point and not the focus.
    if focused == Some(id) {
        let filter =
            egui::EventFilter { horizontal_arrows: true, vertical_arrows: true, ..Default::default() };
        ui.memory_mut(|m| m.set_focus_lock_filter(id, filter));
    }
    let (dx, dy) = ui.input(|i| {
        let step = if i.modifiers.shift { BIG_STEP } else { STEP };
        let count = |key: Key| f64::from(i.num_presses(key) as u32);
        (
            step * (count(Key::ArrowRight) - count(Key::ArrowLeft)),
            step * (count(Key::ArrowUp) - count(Key::ArrowDown)),
        )
    });
    (dx != 0.0 || dy != 0.0).then(|| SpacePoint {
        rough_smooth: (from.rough_smooth + dx).clamp(0.0, 100.0),
        hard_soft: (from.hard_soft + dy).clamp(0.0, 100.0),
    })
}
