//! Work that the window does not wait for.

use std::sync::mpsc::{Receiver, channel};

/// Does something on a thread of its own; what comes of it can be taken in the frame after.
pub(crate) fn in_background<T: Send + 'static>(
    ctx: egui::Context,
    work: impl FnOnce() -> T + Send + 'static,
) -> Receiver<T> {
    let (sender, receiver) = channel();
    std::thread::spawn(move || {
        // The window may have closed meanwhile: then nobody asks any more.
        let _ = sender.send(work());
        ctx.request_repaint();
    });
    receiver
}
