//! What all sheets have in common: the frame over the window, and the key that leaves them.

use egui::{Context, Frame, Id, Key, Modal, ModalResponse, Modifiers, Ui};

use crate::theme::tokens;

/// A sheet over the window, known by `name`, with what `content` draws.
pub(crate) fn sheet<R>(
    ctx: &Context,
    name: &'static str,
    content: impl FnOnce(&mut Ui) -> R,
) -> ModalResponse<R> {
    let frame = Frame::popup(&ctx.global_style()).fill(tokens(ctx).panel).inner_margin(14.0);
    Modal::new(Id::unique(name)).frame(frame).show(ctx, content)
}

/// Whether the key was pressed that leaves a sheet; nothing else sees it then.
pub(crate) fn is_left(ctx: &Context) -> bool {
    ctx.input_mut(|i| i.consume_key(Modifiers::NONE, Key::Escape))
}
