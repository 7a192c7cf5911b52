//! Common parts of all sheets: the frame over the window, the buttons at its foot, and the key that closes them.

use egui::{Context, Frame, Id, Key, Modal, ModalResponse, Modifiers, Order, Popup, Ui};

use crate::look::theme::tokens;
use crate::look::together::at_right_ui;

/// Draws a modal sheet over the window, with the id `name` and the given `content`. Lists and menus are above it. While
/// one of them is open, Escape closes it and not the sheet.
pub(crate) fn sheet<R>(
    ctx: &Context,
    name: &'static str,
    content: impl FnOnce(&mut Ui) -> R,
) -> ModalResponse<R> {
    let frame = Frame::popup(&ctx.global_style()).fill(tokens(ctx).panel).inner_margin(14.0);
    let id = Id::unique(name);
    // Below lists and menus. In the same order as theirs, a click would move the sheet to the top. If its press and
    // release arrive in one frame, the list that it opens keeps its place behind the sheet.
    let area = Modal::default_area(id).order(Order::Middle);
    let was_shown = ctx.memory(|memory| memory.areas().visible_last_frame(&area.layer()));
    if !was_shown {
        // A menu of the window must not lie above the sheet.
        Popup::close_all(ctx);
    }
    let shown = Modal::new(id).area(area).frame(frame).show(ctx, content);
    if shown.any_popup_open {
        ctx.input_mut(|i| i.consume_key(Modifiers::NONE, Key::Escape));
    }
    shown
}

/// Draws the buttons at the foot of a sheet, in its lower right corner. The one that closes the sheet comes last.
pub(crate) fn foot_ui<R>(ui: &mut Ui, buttons: impl FnOnce(&mut Ui) -> R) -> R {
    ui.horizontal(|ui| at_right_ui(ui, buttons)).inner
}

/// Whether the key that closes a sheet (Escape) was pressed. The key press is consumed.
pub(crate) fn is_left(ctx: &Context) -> bool {
    ctx.input_mut(|i| i.consume_key(Modifiers::NONE, Key::Escape))
}
