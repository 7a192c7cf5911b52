//! Faults of the texts of a frame.
//!
//! A text is cut off if its letters cross the edge of the area in which they are visible. Two cases are meant, and are
//! recognized by the accessibility tree. The content of a scroll area may be cut off at the edges between which its
//! scroll bar lies. The content of a text field may be cut off by the field, because it follows the cursor.
//!
//! Two texts are on each other if their letters share an area and no opaque rectangle was painted between them. So the
//! content of a sheet does not count as being on the texts of the window below it.

use std::fmt;

use egui::accessibility::is_input;
use egui::accesskit::Role;
use egui::{Rect, Shape};
use egui_kittest::Harness;
use egui_kittest::kittest::NodeT as _;

use crate::frame::{painted, rows};

/// Distance by which letters may cross an edge, in points: their images have a margin.
const MARGIN: f32 = 1.5;
/// Width and height above which a shared area counts, in points.
const LEAST_OVERLAP: f32 = 3.0;
/// Greatest distance between the end of a scroll bar and the edge of its scroll area, in points.
const NEAR: f32 = 4.0;

/// Kind of a fault.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Problem {
    /// The letters cross the edge of their area.
    CutOff,
    /// The text ends in "…".
    Shortened,
    /// The text is on this other one.
    Over(String),
    /// The control is not completely in the window, and nothing scrolls to it.
    OutsideWindow,
}

/// Fault of a text or of a control.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Fault {
    pub(super) problem: Problem,
    /// The whole text, or the name of the control.
    pub(super) text: String,
    /// Area of the letters or of the control.
    pub(super) area: Rect,
    /// Visible area.
    pub(super) clip: Rect,
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { problem, text, area, clip } = self;
        write!(f, "{problem:?}: {text:?} at {area:?}, visible {clip:?}")
    }
}

/// Text of a frame.
struct Text {
    words: String,
    rows: Vec<Rect>,
    clip: Rect,
    is_elided: bool,
    /// Position in the painting order.
    order: usize,
}

impl Text {
    fn fault(&self, problem: Problem, area: Rect) -> Fault {
        Fault { problem, text: self.words.clone(), area, clip: self.clip }
    }
}

/// Opaque rectangle of a frame, and its position in the painting order.
struct Cover {
    area: Rect,
    order: usize,
}

/// Scroll bars and text fields of a frame.
struct Scrolled {
    bars: Vec<Rect>,
    fields: Vec<Rect>,
}

impl Scrolled {
    fn of<State>(harness: &Harness<'_, State>) -> Self {
        let areas = |roles: &[Role]| -> Vec<Rect> {
            let nodes = harness.root().children_recursive();
            let nodes = nodes.filter(|node| roles.contains(&node.accesskit_node().role()));
            nodes
                .filter(|node| node.accesskit_node().raw_bounds().is_some())
                .map(|node| node.rect())
                .collect()
        };
        Self {
            bars: areas(&[Role::ScrollBar]),
            fields: areas(&[Role::TextInput, Role::MultilineTextInput, Role::SearchInput, Role::SpinButton]),
        }
    }

    fn upright(&self) -> impl Iterator<Item = &Rect> {
        self.bars.iter().filter(|bar| bar.height() > bar.width())
    }

    fn level(&self) -> impl Iterator<Item = &Rect> {
        self.bars.iter().filter(|bar| bar.width() >= bar.height())
    }

    /// Whether letters that cross the edge of `clip` can be scrolled into view.
    fn explains(&self, letters: Rect, clip: Rect) -> bool {
        if self.fields.iter().any(|field| field.expand(NEAR).contains_rect(clip)) {
            return true;
        }
        let near = |a: f32, b: f32| (a - b).abs() <= NEAR;
        let is_beside = |bar: &Rect| (clip.left()..=clip.right() + 4.0 * NEAR).contains(&bar.center().x);
        let is_below = |bar: &Rect| (clip.top()..=clip.bottom() + 4.0 * NEAR).contains(&bar.center().y);
        let [left, right, top, bottom] = crossed(letters, clip);
        (!top || self.upright().any(|bar| is_beside(bar) && near(bar.top(), clip.top())))
            && (!bottom || self.upright().any(|bar| is_beside(bar) && near(bar.bottom(), clip.bottom())))
            && (!left || self.level().any(|bar| is_below(bar) && near(bar.left(), clip.left())))
            && (!right || self.level().any(|bar| is_below(bar) && near(bar.right(), clip.right())))
    }
}

/// Whether letters cross the left, right, top and bottom edge.
fn crossed(letters: Rect, clip: Rect) -> [bool; 4] {
    [
        letters.left() < clip.left() - MARGIN,
        letters.right() > clip.right() + MARGIN,
        letters.top() < clip.top() - MARGIN,
        letters.bottom() > clip.bottom() + MARGIN,
    ]
}

/// Faults of the last frame. Texts for which `may_be_shortened` returns true may end in "…".
pub(super) fn faults<State>(
    harness: &Harness<'_, State>,
    may_be_shortened: &dyn Fn(&str) -> bool,
) -> Vec<Fault> {
    let (texts, covers) = texts(harness);
    let scrolled = Scrolled::of(harness);
    let mut found = Vec::new();
    for text in &texts {
        for row in &text.rows {
            if is_visible(*row, text, &covers)
                && crossed(*row, text.clip).contains(&true)
                && !scrolled.explains(*row, text.clip)
            {
                found.push(text.fault(Problem::CutOff, *row));
            }
        }
        if text.is_elided
            && !may_be_shortened(&text.words)
            && let Some(row) = text.rows.iter().find(|row| is_visible(**row, text, &covers))
        {
            found.push(text.fault(Problem::Shortened, *row));
        }
    }
    found.extend(overlaps(&texts, &covers));
    found.extend(outside(harness, &scrolled));
    found
}

/// Texts and opaque rectangles of the last frame. Shadows and outlines that repeat a text beside itself count once.
fn texts<State>(harness: &Harness<'_, State>) -> (Vec<Text>, Vec<Cover>) {
    let (mut texts, mut covers) = (Vec::<Text>::new(), Vec::new());
    for (order, painted) in painted(harness).into_iter().enumerate() {
        let clip = painted.clip;
        match painted.shape {
            Shape::Text(text) if text.opacity_factor > 0.0 => {
                let words = text.galley.text().to_owned();
                let rows = rows(text);
                let repeats = |other: &Text| {
                    let (Some(a), Some(b)) = (rows.first(), other.rows.first()) else { return false };
                    other.words == words && a.min.distance(b.min) < LEAST_OVERLAP
                };
                if !rows.is_empty() && !texts.iter().any(repeats) {
                    texts.push(Text { words, rows, clip, is_elided: text.galley.elided, order });
                }
            }
            Shape::Rect(rect) if rect.fill.is_opaque() && rect.blur_width == 0.0 && rect.angle == 0.0 => {
                covers.push(Cover { area: rect.rect.intersect(clip), order });
            }
            _ => {}
        }
    }
    (texts, covers)
}

/// Whether a row is at least partly in its area and not covered.
fn is_visible(row: Rect, text: &Text, covers: &[Cover]) -> bool {
    let visible = row.intersect(text.clip);
    let is_covered = |cover: &Cover| cover.order > text.order && cover.area.contains_rect(visible);
    visible.is_positive() && !covers.iter().any(is_covered)
}

/// Texts that are on earlier ones.
fn overlaps(texts: &[Text], covers: &[Cover]) -> Vec<Fault> {
    let mut found = Vec::new();
    for (i, upper) in texts.iter().enumerate() {
        for lower in &texts[..i] {
            let shared = |a: &Rect, b: &Rect| {
                let shared = a.intersect(upper.clip).intersect(b.intersect(lower.clip));
                let is_large = shared.width() > LEAST_OVERLAP && shared.height() > LEAST_OVERLAP;
                let is_covered =
                    |cover: &Cover| cover.order > lower.order && cover.area.contains_rect(shared);
                (is_large && !covers.iter().any(is_covered)).then_some(shared)
            };
            let shared = upper.rows.iter().find_map(|a| lower.rows.iter().find_map(|b| shared(a, b)));
            if let Some(shared) = shared {
                found.push(upper.fault(Problem::Over(lower.words.clone()), shared));
            }
        }
    }
    found
}

/// Controls that are not completely in the window, and that no scroll bar brings there.
fn outside<State>(harness: &Harness<'_, State>, scrolled: &Scrolled) -> Vec<Fault> {
    let window = harness.ctx.content_rect();
    let mut found = Vec::new();
    for node in harness.root().children_recursive() {
        let inner = node.accesskit_node();
        if !is_input(inner.role()) || inner.is_hidden() || inner.raw_bounds().is_none() {
            continue;
        }
        let area = node.rect();
        let [left, right, top, bottom] = crossed(area, window);
        let is_scrolled_across = scrolled.level().next().is_some();
        let is_scrolled_up = scrolled.upright().any(|bar| bar.right() >= area.left());
        if ((left || right) && !is_scrolled_across) || ((top || bottom) && !is_scrolled_up) {
            let text = inner.label().unwrap_or_else(|| format!("{:?}", inner.role()));
            found.push(Fault { problem: Problem::OutsideWindow, text, area, clip: window });
        }
    }
    found
}
