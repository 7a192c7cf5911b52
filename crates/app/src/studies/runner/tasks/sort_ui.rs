//! Sort of stimuli into groups: by drag and drop, by taps, or by keys.

use egui::{
    Align2, CursorIcon, FontId, Label, Pos2, Rect, RichText, Role, Sense, Stroke, StrokeKind, Ui, WidgetInfo,
    pos2, vec2,
};

use crate::look::drag::dragged_to;
use crate::look::theme::{GAP, RADIUS, tokens};
use crate::strings::studies as strings;
use crate::studies::runner::actions::{Action, Asked};
use crate::studies::runner::draft::{Draft, Entry};
use crate::studies::runner::stimuli_ui::play_help;
use crate::studies::runner::trial_state::TrialState;

/// Side of a tile, in points.
const TILE: f32 = 48.0;
/// Smallest width of a group, in points.
const GROUP_WIDTH: f32 = 230.0;
/// Height of the heading of a group, in points.
const HEADING: f32 = 48.0;

/// A place for tiles: a group, or the place of those without one.
struct Place {
    /// Group, from 0; `None` for stimuli without one.
    group: Option<usize>,
    area: Rect,
}

/// Draws the stimuli that are in no group, and the groups.
pub(super) fn sort_ui(ui: &mut Ui, state: &TrialState) -> Asked {
    let mut asked = Asked::default();
    let Draft::Groups(groups, n_groups) = &state.draft else { return asked };
    ui.add(Label::new(RichText::new(strings::sort_help(*n_groups)).color(tokens(ui.ctx()).text_weak)).wrap());
    ui.add_space(GAP);
    let places = places(ui, groups, *n_groups);
    let mut dragged = None;
    for place in &places {
        asked.merge(place_ui(ui, state, place));
        let members = (0..groups.len()).filter(|index| groups[*index] == place.group);
        for (position, index) in members.enumerate() {
            let (tile, held) = tile_ui(ui, state, index, tile_area(place.area, position));
            asked.merge(tile);
            dragged = held.map(|held| (index, held)).or(dragged);
        }
    }
    if let Some((index, Held { pos, is_released })) = dragged {
        if is_released {
            if let Some(place) = places.iter().find(|place| place.area.contains(pos)) {
                asked.ask(Action::Enter(Entry::Group(index, place.group)));
            }
        } else {
            ghost_ui(ui, &state.shown[index].label, pos);
        }
    }
    asked
}

/// Pointer that holds a tile.
struct Held {
    pos: Pos2,
    /// Whether the tile is released there.
    is_released: bool,
}

/// Number of tiles beside each other.
fn n_columns(width: f32) -> usize {
    (((width - GAP) / (TILE + GAP)) as usize).max(1)
}

/// Height of a place with so many tiles.
fn height_of(n_tiles: usize, width: f32) -> f32 {
    let n_rows = n_tiles.div_ceil(n_columns(width)).max(1);
    HEADING + n_rows as f32 * (TILE + GAP) + GAP
}

/// Area of a tile at a position of a place.
fn tile_area(place: Rect, position: usize) -> Rect {
    let n_columns = n_columns(place.width());
    let (row, column) = (position / n_columns, position % n_columns);
    let left = place.left() + GAP + column as f32 * (TILE + GAP);
    let top = place.top() + HEADING + row as f32 * (TILE + GAP);
    Rect::from_min_size(pos2(left, top), vec2(TILE, TILE))
}

/// Allocates the place of the stimuli without a group, and the groups in rows below it.
fn places(ui: &mut Ui, groups: &[Option<usize>], n_groups: usize) -> Vec<Place> {
    let width = ui.available_width();
    let n_in = |group: Option<usize>| groups.iter().filter(|of| **of == group).count();
    let (_, area) = ui.allocate_space(vec2(width, height_of(n_in(None), width)));
    let mut places = vec![Place { group: None, area }];
    let n_beside = ((width / GROUP_WIDTH) as usize).clamp(1, 3);
    let group_width = (width - GAP * (n_beside - 1) as f32) / n_beside as f32;
    for first in (0..n_groups).step_by(n_beside) {
        let row: Vec<usize> = (first..n_groups.min(first + n_beside)).collect();
        let height = row.iter().map(|group| height_of(n_in(Some(*group)), group_width)).fold(0.0, f32::max);
        let (_, area) = ui.allocate_space(vec2(width, height));
        for (column, group) in row.into_iter().enumerate() {
            let left = area.left() + column as f32 * (group_width + GAP);
            let area = Rect::from_min_size(pos2(left, area.top()), vec2(group_width, height));
            places.push(Place { group: Some(group), area });
        }
    }
    places
}

/// Draws a place. A tap on its heading moves the selected stimulus there.
fn place_ui(ui: &Ui, state: &TrialState, place: &Place) -> Asked {
    let t = tokens(ui.ctx());
    let mut asked = Asked::default();
    let heading = place.area.with_max_y(place.area.top() + HEADING).shrink(2.0);
    let response = ui.interact(heading, ui.scope_id().with(("place", place.group)), Sense::click());
    let name = place.group.map_or(strings::NO_GROUP.to_owned(), strings::group);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &name));
    ui.painter().rect(place.area, f32::from(RADIUS), t.raised, Stroke::new(1.0, t.line), StrokeKind::Inside);
    if response.has_focus() || response.hovered() {
        let stroke = Stroke::new(1.5, t.accent);
        ui.painter().rect_stroke(heading, f32::from(RADIUS), stroke, StrokeKind::Inside);
    }
    let at = heading.left_center() + vec2(GAP, 0.0);
    ui.painter().text(at, Align2::LEFT_CENTER, &name, FontId::proportional(15.0), t.text);
    if response.clicked() {
        asked.ask(Action::Enter(Entry::Group(state.selected, place.group)));
    }
    if let Some(shown) = state.shown.get(state.selected) {
        response.on_hover_text(strings::move_here(&shown.label, &name));
    }
    asked
}

/// Draws the tile of a stimulus. A tap starts the stimulus; a drag moves it.
fn tile_ui(ui: &Ui, state: &TrialState, index: usize, area: Rect) -> (Asked, Option<Held>) {
    let t = tokens(ui.ctx());
    let mut asked = Asked::default();
    let label = &state.shown[index].label;
    let response = ui.interact(area, ui.scope_id().with(("tile", index)), Sense::click_and_drag());
    let is_playing = state.presenter.playing() == Some(index);
    response.widget_info(|| WidgetInfo::selected(Role::Button, true, is_playing, strings::play(label)));
    let (fill, text) = if is_playing { (t.chosen, t.on_chosen) } else { (t.control, t.text) };
    let is_marked = index == state.selected || response.has_focus() || response.hovered();
    let stroke = if is_marked { Stroke::new(2.0, t.accent) } else { Stroke::new(1.0, t.line) };
    ui.painter().rect(area, f32::from(RADIUS), fill, stroke, StrokeKind::Inside);
    ui.painter().text(area.center(), Align2::CENTER_CENTER, label, FontId::proportional(18.0), text);
    if response.clicked() {
        asked.ask(Action::Play(index));
    }
    if response.drag_started() {
        asked.ask(Action::Select(index));
    }
    let pos = dragged_to(ui, &response);
    let is_released = response.drag_stopped();
    let response = response.on_hover_and_drag_cursor(CursorIcon::Grab);
    if pos.is_none() {
        response.on_hover_text(play_help(&state.presenter, index));
    }
    (asked, pos.map(|pos| Held { pos, is_released }))
}

/// Draws a copy of the dragged tile at the pointer.
fn ghost_ui(ui: &Ui, label: &str, pos: Pos2) {
    let t = tokens(ui.ctx());
    let area = Rect::from_center_size(pos, vec2(TILE, TILE));
    let stroke = Stroke::new(2.0, t.accent);
    ui.painter().rect(area, f32::from(RADIUS), t.chosen, stroke, StrokeKind::Inside);
    ui.painter().text(pos, Align2::CENTER_CENTER, label, FontId::proportional(18.0), t.on_chosen);
}
