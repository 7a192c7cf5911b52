//! Lists of choices that the keyboard closes too.

use egui::{ComboBox, InnerResponse, Key, Memory, Ui};

/// Shows a list that closes when Enter chooses an entry, as it does after a click.
pub(crate) trait ShowList {
    /// Draws the field and, while it is open, its entries by `content`. After Enter the field has the keyboard focus again.
    fn show_list<R>(self, ui: &mut Ui, content: impl FnOnce(&mut Ui) -> R) -> InnerResponse<Option<R>>;
}

impl ShowList for ComboBox<'_> {
    fn show_list<R>(self, ui: &mut Ui, content: impl FnOnce(&mut Ui) -> R) -> InnerResponse<Option<R>> {
        let mut is_entered = false;
        let shown = self.show_ui(ui, |ui| {
            let chosen = content(ui);
            // In the frame that opens the list by Enter, the focus is still on the field.
            let focused = ui.memory(Memory::focused).and_then(|id| ui.ctx().read_response(id));
            let is_inside = focused.is_some_and(|entry| entry.layer_id == ui.layer_id());
            is_entered = is_inside && ui.input(|i| i.key_pressed(Key::Enter));
            if is_entered {
                ui.close();
            }
            chosen
        });
        if is_entered {
            shown.response.request_focus();
        }
        shown
    }
}
