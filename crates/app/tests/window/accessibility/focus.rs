//! Order, names and marks of the widgets that the Tab key reaches.
//!
//! The order is split into runs. A run ends where the focus goes up, far down, or to the left in the same row: there the
//! next panel or column begins. A step to the left neighbor in a row is no end: groups at the right edge of a row are
//! visited from the right. The focus is in reading order if no two runs share an area, so that every panel is read
//! completely, from its top to its bottom, before the next one. Widgets on a canvas are left out, because they lie where
//! the data place them.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use egui::accesskit::{Action, NodeId, Role};
use egui::{Color32, Event, Key, Modifiers, Rect, Shape};
use egui_kittest::Harness;
use egui_kittest::kittest::NodeT as _;

use super::contrast::contrast;
use crate::frame::painted;

/// Greatest number of widgets of a view.
const MOST: usize = 400;
/// Greatest gap between neighbors in a row, in points.
const NEIGHBORS: f32 = 20.0;
/// Gap in points to the left of a control in a lower row from which it counts as part of another panel.
const ACROSS: f32 = 750.0;
/// Least gap below which the next panel begins, in points.
const FAR_BELOW: f32 = 120.0;
/// Width and height above which a shared area of two runs counts, in points.
const LEAST_OVERLAP: f32 = 3.0;
/// Distance from a widget within which its mark lies, in points.
const MARK_MARGIN: f32 = 7.0;
/// Least contrast of a mark to the panel.
const LEAST_CONTRAST: f64 = 3.0;

/// Widget that can have the keyboard focus.
#[derive(Clone, Debug)]
pub(super) struct Stop {
    pub(super) id: NodeId,
    name: String,
    role: Role,
    area: Rect,
    /// Whether its panel had scrolled when it was reached, so that its area says nothing about its place in the panel.
    is_scrolled: bool,
}

impl Stop {
    /// Whether this is a text that can be clicked.
    pub(super) fn is_label(&self) -> bool {
        self.role == Role::Label
    }
}

impl fmt::Display for Stop {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?} {:?} at {:?}", self.role, self.name, self.area)
    }
}

/// Result of pressing the Tab key until the focus returns.
pub(super) struct Walk {
    pub(super) stops: Vec<Stop>,
    /// For each stop, whether a shape with enough contrast appears at it with the focus.
    marked: Vec<bool>,
}

/// Widgets of the last frame that can have the focus and are enabled.
pub(super) fn focusable<State>(harness: &Harness<'_, State>) -> Vec<Stop> {
    stops(harness, |_| true)
}

/// Widget with the focus, if any.
fn focused<State>(harness: &Harness<'_, State>) -> Option<Stop> {
    let id =
        harness.root().children_recursive().find(egui_kittest::Node::is_focused)?.accesskit_node().locate().0;
    stops(harness, |other| other == id).into_iter().next()
}

fn stops<State>(harness: &Harness<'_, State>, is_wanted: impl Fn(NodeId) -> bool) -> Vec<Stop> {
    let mut found = Vec::new();
    for node in harness.root().children_recursive() {
        let inner = node.accesskit_node();
        let id = inner.locate().0;
        let can_focus = inner.data().supports_action(Action::Focus) && !inner.is_disabled();
        if can_focus && is_wanted(id) && inner.raw_bounds().is_some() {
            let hint = || inner.data().placeholder().map(str::to_owned);
            let text = || inner.value().filter(|_| inner.role() == Role::Label);
            let name = inner.label().or_else(hint).or_else(text).unwrap_or_default();
            found.push(Stop { id, name, role: inner.role(), area: node.rect(), is_scrolled: false });
        }
    }
    found
}

/// Presses the Tab key until the focus returns to the first widget. Areas are those before the walk, since the focus may
/// scroll.
pub(super) fn tab_through<State>(harness: &mut Harness<'_, State>) -> Walk {
    let areas: BTreeMap<NodeId, Rect> =
        focusable(harness).into_iter().map(|stop| (stop.id, stop.area)).collect();
    let (mut stops, mut marked) = (Vec::<Stop>::new(), Vec::new());
    // A field that has the focus from the beginning gives it up, so that the walk begins at the first widget.
    let given = harness.ctx.memory(egui::Memory::focused);
    if let Some(given) = given {
        harness.ctx.memory_mut(|memory| memory.surrender_focus(given));
    }
    harness.run_steps(2);
    let mut reached = BTreeSet::new();
    let mut outlined = Vec::new();
    let mut last: Option<(Stop, BTreeMap<[u8; 4], usize>)> = None;
    for _ in 0..MOST {
        press_tab(harness);
        if let Some((stop, with_focus)) = last.take() {
            marked.push(is_marked(harness, &stop, &with_focus));
        }
        let Some(stop) = focused(harness) else { break };
        if !reached.insert(stop.id) {
            break;
        }
        let colors = colors_at(harness, stop.area);
        outlined.push(is_outlined(harness, stop.area));
        last = Some((stop.clone(), colors));
        let area = areas.get(&stop.id).copied().unwrap_or(stop.area);
        stops.push(Stop { area, is_scrolled: area != stop.area, ..stop });
    }
    if let Some((stop, with_focus)) = last {
        marked.push(is_marked(harness, &stop, &with_focus));
    }
    for (marked, outlined) in marked.iter_mut().zip(outlined) {
        *marked |= outlined;
    }
    let focused = harness.ctx.memory(egui::Memory::focused);
    if let Some(id) = focused {
        harness.ctx.memory_mut(|memory| memory.surrender_focus(id));
    }
    harness.run_steps(2);
    Walk { stops, marked }
}

/// Presses and releases the Tab key within one frame, and shows another one: every frame of every stop takes time.
fn press_tab<State>(harness: &mut Harness<'_, State>) {
    let event = |pressed| Event::Key {
        key: Key::Tab,
        physical_key: None,
        pressed,
        repeat: false,
        modifiers: Modifiers::NONE,
    };
    harness.input_mut().events.extend([event(true), event(false)]);
    harness.run_steps(2);
}

/// Whether a color with enough contrast was painted more often at a widget while it had the focus. `harness` shows the
/// frame after that. A widget that has scrolled away since counts as marked, because its frames cannot be compared.
fn is_marked<State>(
    harness: &Harness<'_, State>,
    stop: &Stop,
    with_focus: &BTreeMap<[u8; 4], usize>,
) -> bool {
    let now = stops(harness, |id| id == stop.id).into_iter().next();
    if now.is_none_or(|now| now.area != stop.area) {
        return true;
    }
    let without = colors_at(harness, stop.area);
    let panel = harness.ctx.global_style().visuals.panel_fill;
    with_focus.iter().any(|(color, n)| {
        let [r, g, b, a] = *color;
        let seen = panel.blend(Color32::from_rgba_premultiplied(r, g, b, a));
        *n > without.get(color).copied().unwrap_or(0) && contrast(seen, panel) >= LEAST_CONTRAST
    })
}

/// Whether an outline with enough contrast encloses an area closely.
fn is_outlined<State>(harness: &Harness<'_, State>, area: Rect) -> bool {
    let panel = harness.ctx.global_style().visuals.panel_fill;
    painted(harness).iter().any(|painted| match painted.shape {
        Shape::Rect(rect) => {
            let is_close = rect.rect.contains_rect(area) && area.expand(MARK_MARGIN).contains_rect(rect.rect);
            is_close && rect.stroke.width > 0.0 && contrast(rect.stroke.color, panel) >= LEAST_CONTRAST
        }
        _ => false,
    })
}

/// Colors of outlines, fills and lines that lie within or directly around an area, with their number.
fn colors_at<State>(harness: &Harness<'_, State>, area: Rect) -> BTreeMap<[u8; 4], usize> {
    let around = area.expand(MARK_MARGIN);
    let mut found = BTreeMap::new();
    for painted in painted(harness) {
        if !around.contains_rect(painted.shape.visual_bounding_rect()) {
            continue;
        }
        let colors = match painted.shape {
            Shape::Rect(rect) => {
                vec![(rect.stroke.width > 0.0).then_some(rect.stroke.color), Some(rect.fill)]
            }
            Shape::Circle(circle) => {
                vec![(circle.stroke.width > 0.0).then_some(circle.stroke.color), Some(circle.fill)]
            }
            Shape::LineSegment { stroke, .. } => vec![Some(stroke.color)],
            _ => Vec::new(),
        };
        for color in colors.into_iter().flatten().filter(|color| color.a() > 0) {
            *found.entry(color.to_array()).or_insert(0) += 1;
        }
    }
    found
}

/// Widgets without a name.
pub(super) fn unnamed(stops: &[Stop]) -> Vec<String> {
    let without = stops.iter().filter(|stop| stop.name.trim().is_empty());
    without.map(|stop| format!("no name: {stop}")).collect()
}

/// Widgets on which the focus is not visible.
pub(super) fn unmarked(walk: &Walk) -> Vec<String> {
    let without = walk.stops.iter().zip(&walk.marked).filter(|(_, is_marked)| !**is_marked);
    without.map(|(stop, _)| format!("no mark: {stop}")).collect()
}

/// Widgets that the focus reaches after it has left their panel.
pub(super) fn out_of_order(stops: &[Stop]) -> Vec<String> {
    let canvases: Vec<Rect> =
        stops.iter().filter(|stop| stop.role == Role::Canvas).map(|stop| stop.area).collect();
    let is_on_canvas = |stop: &&Stop| {
        stop.role != Role::Canvas && canvases.iter().any(|canvas| canvas.contains(stop.area.center()))
    };
    let mut runs: Vec<(Rect, &Stop)> = Vec::new();
    let mut found = Vec::new();
    let mut before: Option<&Stop> = None;
    // Rows of the library, cards of contributions and controls of the shape scroll while the focus moves.
    let begins = ["Texture ", "Menu of ", "Star ", "Solo ", "Pin ", "Unpin ", "Shape", "Reset "];
    let is_row = |stop: &Stop| begins.iter().any(|begin| stop.name.starts_with(begin));
    for stop in stops.iter().filter(|stop| !is_on_canvas(stop) && !is_row(stop) && !stop.is_scrolled) {
        if before.is_none_or(|before| goes_back(before.area, stop.area)) {
            runs.push((stop.area, stop));
        } else if let Some((run, _)) = runs.last_mut() {
            *run = run.union(stop.area);
        }
        before = Some(stop);
    }
    for (i, (area, first)) in runs.iter().enumerate() {
        for (other, _) in &runs[..i] {
            let shared = area.intersect(*other);
            if shared.width() > LEAST_OVERLAP && shared.height() > LEAST_OVERLAP {
                found
                    .push(format!("not in reading order, from {first}: in {other:?}, which was left before"));
            }
        }
    }
    found
}

/// Whether the second area lies in another panel or column than the first, or before it in reading order.
fn goes_back(from: Rect, to: Rect) -> bool {
    let shared = from.bottom().min(to.bottom()) - from.top().max(to.top());
    if shared > 0.5 * from.height().min(to.height()) {
        to.left() < from.left() - 2.0 && from.left() - to.right() > NEIGHBORS
    } else {
        let is_across = to.left() - from.right() > ACROSS;
        to.center().y < from.center().y || to.top() - from.bottom() > FAR_BELOW || is_across
    }
}
