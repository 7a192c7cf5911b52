//! Mark of an authored point during a comparison: its letter, filled if it is audible.

use egui::{Align2, FontId, Pos2, Stroke, Ui};
use shagreen_formats::project::AuthoredTexture;

use crate::look::theme::Tokens;
use crate::panel::Panel;
use crate::state::compare::Side;

/// Size of the letter relative to the radius of the point.
const LETTER_SHARE: f32 = 1.2;

/// Mark of a point during a comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct ComparedPoint {
    /// Letter of the side, unless the comparison is blind or the texture is on no side.
    letter: Option<&'static str>,
    is_audible: bool,
}

/// Mark of an authored texture; `None` outside a comparison, and for a texture that is neither compared nor selected. In a
/// blind comparison no texture is marked as audible.
pub(super) fn compared_point(panel: &Panel<'_>, texture: &AuthoredTexture) -> Option<ComparedPoint> {
    panel.compare.heard()?;
    let letter = panel.compare.side_of(texture.key).map(Side::letter);
    let is_audible = !panel.compare.is_hidden() && panel.compare.heard_key() == Some(texture.key);
    let is_selected = texture.key == panel.project.texture().key;
    (letter.is_some() || is_selected).then_some(ComparedPoint { letter, is_audible })
}

/// Draws the mark: a disc if the texture is audible, otherwise a muted ring.
pub(super) fn compared_point_ui(ui: &Ui, pos: Pos2, radius: f32, point: ComparedPoint, t: &Tokens) {
    let painter = ui.painter();
    painter.circle_filled(pos, radius + 2.5, t.background);
    let color = if point.is_audible {
        painter.circle_filled(pos, radius, t.accent);
        t.on_accent
    } else {
        painter.circle_stroke(pos, radius - 1.0, Stroke::new(2.0, t.text_weak));
        t.text_weak
    };
    if let Some(letter) = point.letter {
        let font = FontId::proportional(LETTER_SHARE * radius);
        painter.text(pos, Align2::CENTER_CENTER, letter, font, color);
    }
}
