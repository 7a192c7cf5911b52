//! When tooltips appear: after the pointer has rested, and not soon after a drag. A hint that teaches a gesture appears
//! until the gesture was made.

use egui::{Context, Id};

use crate::look::theme::TOOLTIP_DELAY_SECS;

/// Time after a drag in which no tooltip appears, in seconds.
const QUIET_SECS: f64 = 1.0;
/// Delay of tooltips in that time, in seconds: the pointer never rests for so long.
const QUIET_DELAY_SECS: f32 = 1e6;

/// Hint that teaches a gesture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Hint {
    /// The point of the canvas is dragged.
    DragPoint,
    /// The pad is stroked.
    StrokePad,
}

impl Hint {
    /// All hints.
    pub(crate) const ALL: [Self; 2] = [Self::DragPoint, Self::StrokePad];

    /// Identifier in the settings.
    pub(crate) fn id(self) -> &'static str {
        match self {
            Self::DragPoint => "drag-point",
            Self::StrokePad => "stroke-pad",
        }
    }

    fn key(self) -> Id {
        Id::unique(("learned hint", self.id()))
    }
}

/// Marks a hint as learned: it does not appear again.
pub(crate) fn learn(ctx: &Context, hint: Hint) {
    ctx.data_mut(|data| data.insert_temp(hint.key(), true));
}

/// Whether a hint was learned.
pub(crate) fn is_learned(ctx: &Context, hint: Hint) -> bool {
    ctx.data(|data| data.get_temp(hint.key())).unwrap_or(false)
}

fn last_drag_id() -> Id {
    Id::unique("time of the last drag")
}

/// Time until tooltips may appear, in seconds; 0 or less if they may.
fn quiet_secs_left(ctx: &Context) -> f64 {
    let last: Option<f64> = ctx.data(|data| data.get_temp(last_drag_id()));
    last.map_or(0.0, |last| last + QUIET_SECS - ctx.input(|i| i.time))
}

/// Whether tooltips may appear. Asked where an open tooltip would stay open during a drag of its own widget.
pub(crate) fn may_appear(ctx: &Context) -> bool {
    quiet_secs_left(ctx) <= 0.0
}

/// Follows the drags of the pointer, once a frame: they delay all tooltips.
pub(crate) fn follow_drags(ctx: &Context) {
    let (now_secs, is_dragging) = ctx.input(|i| (i.time, i.pointer.is_decidedly_dragging()));
    if is_dragging {
        ctx.data_mut(|data| data.insert_temp(last_drag_id(), now_secs));
    }
    let left_secs = quiet_secs_left(ctx);
    let delay_secs = if left_secs > 0.0 { QUIET_DELAY_SECS } else { TOOLTIP_DELAY_SECS };
    if left_secs > 0.0 {
        ctx.request_repaint_after_secs(left_secs as f32);
    }
    if ctx.global_style().interaction.tooltip_delay != delay_secs {
        ctx.all_styles_mut(|style| style.interaction.tooltip_delay = delay_secs);
    }
}
