//! Scrolling to the widget with the keyboard focus. egui itself does not scroll, so that the focus could be out of sight.

use egui::{Id, Memory, Ui};

/// Scrolls to the widget in this scroll area that has just received the keyboard focus, if it is not wholly visible. `ui` is
/// the content of the scroll area, after its last widget.
pub(crate) fn scroll_to_focus(ui: &Ui) {
    let focused = ui.memory(Memory::focused);
    let key = ui.scope_id().with("focus before");
    let before = ui.data_mut(|data| {
        let before = data.get_temp::<Option<Id>>(key).flatten();
        data.insert_temp(key, focused);
        before
    });
    let Some(focused) = focused.filter(|focused| before != Some(*focused)) else { return };
    let Some(response) = ui.ctx().read_response(focused) else { return };
    // A visible widget elsewhere may lie where hidden content of this area would be.
    let shown = response.interact_rect;
    let is_inside = response.layer_id == ui.layer_id()
        && ui.min_rect().contains(response.rect.center())
        && (!shown.is_positive() || ui.clip_rect().contains_rect(shown));
    if is_inside && shown != response.rect {
        response.scroll_to_me(None);
    }
}

#[cfg(test)]
mod tests {
    use super::scroll_to_focus;
    use egui::{Key, ScrollArea, Ui, vec2};
    use egui_kittest::Harness;
    use egui_kittest::kittest::{NodeT as _, Queryable as _};

    fn rows(ui: &mut Ui, follows: bool) {
        ScrollArea::vertical().max_height(60.0).show(ui, |ui| {
            for row in 0..9 {
                let _ = ui.button(format!("row {row}"));
            }
            if follows {
                scroll_to_focus(ui);
            }
        });
        // Where the lower rows would be.
        let _ = ui.button("below");
    }

    /// Rows whose center was inside the visible part when they had the focus, and the final offset of the first row.
    fn walk(follows: bool) -> (Vec<bool>, f32) {
        let mut harness =
            Harness::builder().with_size(vec2(200.0, 200.0)).build_ui(move |ui| rows(ui, follows));
        harness.run_steps(2);
        let top = harness.get_by_label("row 0").rect().top();
        let mut visible = Vec::new();
        for _ in 0..10 {
            harness.key_press(Key::Tab);
            harness.run_steps(60);
            let focused = harness.root().children_recursive().find(egui_kittest::Node::is_focused);
            let focused = focused.expect("a focus");
            let name = focused.accesskit_node().label().unwrap_or_default();
            if name != "below" {
                // egui shows three points more than the area.
                visible.push(focused.rect().bottom() <= top + 64.0);
            }
        }
        (visible, harness.get_by_label("row 0").rect().top() - top)
    }

    #[test]
    fn the_focus_is_in_sight_and_one_elsewhere_scrolls_nothing() {
        let (visible, offset) = walk(true);
        assert_eq!(visible, [true; 9]);
        let last = -offset;
        assert!(last > 100.0, "scrolled by {last}");
        // Negative control.
        let (visible, offset) = walk(false);
        assert!(!visible[8] && offset == 0.0, "{visible:?}");
    }
}
