//! Common parts of all sheets: the frame over the window, and the key that closes them.

use egui::{Context, Frame, Id, Key, Modal, ModalResponse, Modifiers, Ui};

use crate::look::theme::tokens;

/// Draws a modal sheet over the window, with the id `name` and the given `content`.
pub(crate) fn sheet<R>(
    ctx: &Context,
    name: &'static str,
    content: impl FnOnce(&mut Ui) -> R,
) -> ModalResponse<R> {
    let frame = Frame::popup(&ctx.global_style()).fill(tokens(ctx).panel).inner_margin(14.0);
    Modal::new(Id::unique(name)).frame(frame).show(ctx, content)
}

/// Whether the key that closes a sheet (Escape) was pressed. The key press is consumed.
pub(crate) fn is_left(ctx: &Context) -> bool {
    ctx.input_mut(|i| i.consume_key(Modifiers::NONE, Key::Escape))
}
