//! Row of the texture list: picture, name, weight, star and menu button.

use egui::{
    Color32, Id, Label, Layout, Mesh, Painter, Popup, Pos2, Rect, Response, RichText, Role, Sense, Shape,
    Stroke, Ui, UiBuilder, WidgetInfo, pos2, vec2,
};
use shagreen_formats::library::{Provenance, TextureEntry};

use crate::author::context_menu::context_menu;
use crate::author::exact::clicked;
use crate::author::locks::lock_mark;
use crate::author::texture_drag::{follow_row_drag, row_sense};
use crate::author::texture_menu::{starred, texture_menu};
use crate::author::texture_picture::{picture_ui, place_in_words};
use crate::author::whole_space::only_in;
use crate::command::Command;
use crate::look::theme::{RADIUS, Tokens, tokens};
use crate::panel::Panel;
use crate::strings::edits::starred as star_name;
use crate::strings::{self, textures as words};

/// Height of a row, in points.
pub(crate) const ROW: f32 = 35.0;
/// Side of its picture, in points.
const PICTURE: f32 = 29.0;
/// Side of a button, in points.
const BUTTON: f32 = 20.0;
/// Width that the scroll bar covers on the right while the list is pointed at, in points.
const SCROLL_BAR: f32 = 9.0;

/// Draws the row of a texture, and scrolls to it if it is new; returns the requested commands.
pub(crate) fn texture_row(ui: &mut Ui, panel: &Panel<'_>, texture: usize, is_new: bool) -> Vec<Command> {
    let t = tokens(ui.ctx());
    let entry = &panel.session.textures()[texture];
    let (_, area) = ui.allocate_space(vec2(ui.available_width(), ROW));
    // Ids depend on the texture: a star moves the row, and the keyboard focus moves with it.
    let id = |part: &str| ui.scope_id().with((part, entry.id.as_str()));
    let (more_id, star_id) = (id("more"), id("star"));
    let response = ui.interact(area, id("texture"), row_sense(ui));
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, strings::texture(&entry.name)));
    let is_visible = ui.is_rect_visible(area);
    let has_inner_focus = ui.memory(|memory| memory.has_focus(more_id) || memory.has_focus(star_id));
    if response.gained_focus() || is_new || (has_inner_focus && !is_visible) {
        response.scroll_to_me(None);
    }
    follow_row_drag(&response, &entry.id);
    let mut commands = Vec::new();
    commands.extend(clicked(&response, panel, texture).map(Command::Edit));
    if !is_visible && !has_inner_focus {
        return commands;
    }
    let is_pointed = ui.rect_contains_pointer(area) || response.has_focus() || has_inner_focus;
    if is_pointed {
        ui.painter().rect_filled(area, f32::from(RADIUS), t.raised);
    }
    let star_area = Rect::from_center_size(
        pos2(area.right() - SCROLL_BAR - 0.5 * BUTTON, area.center().y),
        vec2(BUTTON, BUTTON),
    );
    let more_area = star_area.translate(vec2(-BUTTON, 0.0));
    let mut end = area.right() - 3.0;
    let more = more_button(ui, panel, texture, more_area, more_id, is_pointed);
    commands.extend(more.command);
    let is_starred = panel.is_starred(texture);
    let star = star_button(ui, entry, is_starred, star_area, star_id, is_pointed);
    if star.clicked() {
        commands.push(Command::Edit(starred(panel, texture)));
    }
    if more.is_shown {
        end = more_area.left();
    } else if is_starred {
        end = star_area.left();
    }
    text_ui(ui, panel, texture, area, end);
    context_menu(&response, |ui| commands.extend(texture_menu(ui, panel, texture)));
    response.on_hover_text(help(panel, texture));
    commands
}

/// Result of drawing the menu button.
struct More {
    is_shown: bool,
    command: Option<Command>,
}

/// Draws the button that opens the menu of a texture without a right click.
fn more_button(ui: &Ui, panel: &Panel<'_>, texture: usize, area: Rect, id: Id, is_row_pointed: bool) -> More {
    let t = tokens(ui.ctx());
    let response = ui.interact(area, id, Sense::click());
    let name = words::more(&panel.session.textures()[texture].name);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &name));
    let menu = Popup::menu(&response);
    let is_shown = is_row_pointed || menu.is_open();
    if is_shown {
        back_ui(ui, &response, area, t);
        for i in -1_i8..=1 {
            let center = area.center() + vec2(4.5 * f32::from(i), 0.0);
            ui.painter().circle_filled(center, 1.5, t.text);
        }
    }
    let shown = menu.show(|ui| texture_menu(ui, panel, texture));
    let command = shown.and_then(|shown| shown.inner);
    response.on_hover_text(format!("{name}\n{}", words::MORE_HELP));
    More { is_shown, command }
}

/// Draws the star of a texture: visible if the texture is starred or the row is pointed at.
fn star_button(
    ui: &Ui,
    entry: &TextureEntry,
    is_starred: bool,
    area: Rect,
    id: Id,
    is_row_pointed: bool,
) -> Response {
    let t = tokens(ui.ctx());
    let response = ui.interact(area, id, Sense::click());
    let name = star_name(&entry.name, !is_starred);
    response.widget_info(|| WidgetInfo::selected(Role::Button, true, is_starred, &name));
    if is_starred || is_row_pointed {
        back_ui(ui, &response, area, t);
        let is_pointed = response.hovered() || response.has_focus();
        let color = if is_starred || is_pointed { t.text } else { t.text_weak };
        star_mark(ui.painter(), area.center(), is_starred, color);
    }
    response.on_hover_text(format!("{name}\n{}", words::STAR_HELP))
}

fn back_ui(ui: &Ui, response: &Response, area: Rect, t: &Tokens) {
    if response.hovered() || response.has_focus() {
        ui.painter().rect_filled(area, f32::from(RADIUS), t.control_hovered);
    }
}

/// Draws a star at `center`, filled or as an outline.
fn star_mark(painter: &Painter, center: Pos2, is_filled: bool, color: Color32) {
    let corner = |i: i32| {
        let radius = if i % 2 == 0 { 6.5 } else { 2.8 };
        let angle = std::f32::consts::PI * (0.2 * i as f32 - 0.5);
        center + radius * vec2(angle.cos(), angle.sin())
    };
    let corners: Vec<Pos2> = (0..10).map(corner).collect();
    if is_filled {
        // As triangles around the center, because a star is not convex.
        let mut fill = Mesh::default();
        fill.colored_vertex(center, color);
        for corner in &corners {
            fill.colored_vertex(*corner, color);
        }
        for i in 0..10 {
            fill.add_triangle(0, 1 + i, 1 + (i + 1) % 10);
        }
        painter.add(Shape::mesh(fill));
    }
    painter.add(Shape::closed_line(corners, Stroke::new(1.0, color)));
}

/// Draws the picture, the name and a line of details, up to the horizontal position `end`.
fn text_ui(ui: &mut Ui, panel: &Panel<'_>, texture: usize, area: Rect, end: f32) {
    let t = tokens(ui.ctx());
    let entry = &panel.session.textures()[texture];
    let picture = Rect::from_min_size(area.min + vec2(3.0, 3.0), vec2(PICTURE, PICTURE));
    picture_ui(ui, panel, texture, picture);
    if panel.is_locked(texture) {
        let badge = picture.right_bottom() - vec2(6.0, 7.0);
        ui.painter().circle_filled(badge, 8.5, t.panel);
        let color = if panel.has_lost_pin(texture) { t.warning } else { t.text };
        lock_mark(ui.painter(), badge, true, color);
    }
    let room = Rect::from_min_max(pos2(picture.right() + 8.0, area.top() + 2.0), pos2(end, area.bottom()));
    let mut text = ui.new_child(UiBuilder::new().max_rect(room).layout(Layout::top_down(egui::Align::Min)));
    text.spacing_mut().item_spacing.y = 1.0;
    let rank = panel.session.parent_rank(texture);
    let color = rank.map_or(t.text, |r| t.parents[r.min(2)]);
    text.add(Label::new(RichText::new(&entry.name).color(color)).truncate().selectable(false));
    let is_placed = panel.session.position(texture).is_some();
    let below = match panel.session.parent_weight(texture) {
        Some(_) if panel.solo().is_some() => strings::HEARD_ALONE.to_owned(),
        Some(weight) => strings::of_the_blend(100.0 * weight),
        None if panel.has_lost_pin(texture) => words::LOST_PIN.to_owned(),
        None if entry.provenance == Provenance::Restricted && !is_placed => {
            format!("{} · {}", strings::NOT_PLACED_YET, strings::import::RESTRICTED_SHORT)
        }
        None if !is_placed => strings::NOT_PLACED_YET.to_owned(),
        None if entry.provenance == Provenance::Restricted => strings::import::RESTRICTED_SHORT.to_owned(),
        None => only_in(panel, texture).unwrap_or_else(|| entry.tags.join(", ")),
    };
    text.add(Label::new(RichText::new(below).small().color(t.text_weak)).truncate().selectable(false));
}

/// Tooltip of a row.
fn help(panel: &Panel<'_>, texture: usize) -> String {
    let entry = &panel.session.textures()[texture];
    let place = panel.session.position(texture);
    let mut help = place.map_or(strings::NOT_PLACED_HELP.to_owned(), |at| place_in_words(panel, texture, at));
    if entry.provenance == Provenance::Restricted {
        help = format!("{help}\n{}", strings::import::RESTRICTED);
    }
    if let Some(only_in) = only_in(panel, texture) {
        help = format!("{help}\n{only_in}");
    }
    if panel.is_locked(texture) {
        let pinned = if panel.has_lost_pin(texture) { words::LOST_PIN_HELP } else { strings::LOCKED };
        help = format!("{help}\n{pinned}");
    }
    format!("{}\n{help}\n{}", entry.name, words::CLICK_HELP)
}
