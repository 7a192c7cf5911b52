//! Widgets of a row that stay together.

use egui::{Align, Id, Layout, Ui, vec2};

/// Draws widgets beside each other. In a wrapped row, all of them begin the next row if they do not fit into the present
/// one. `name` must be unique within `ui`.
pub(crate) fn together_ui<R>(ui: &mut Ui, name: &str, add: impl FnOnce(&mut Ui) -> R) -> R {
    let id = ui.scope_id().with(("together", name));
    measured_ui(ui, id, width_before(ui, id), add)
}

/// Draws widgets at the right edge of a row, in their own order, which is also that of the Tab key.
pub(crate) fn at_right_ui<R>(ui: &mut Ui, add: impl FnOnce(&mut Ui) -> R) -> R {
    let id = ui.scope_id().with("at the right edge");
    let width = width_before(ui, id);
    // Before their width is known, they must not reach beyond the row.
    if width > 0.0 {
        ui.add_space((ui.available_width() - width).max(0.0));
    }
    measured_ui(ui, id, width, add)
}

/// Width of the widgets with this id: it is known after they were drawn once, and 0 before.
fn width_before(ui: &Ui, id: Id) -> f32 {
    ui.data(|data| data.get_temp(id)).unwrap_or(0.0)
}

/// Draws widgets in a row of the width that they had before, and remembers the width that they have.
fn measured_ui<R>(ui: &mut Ui, id: Id, before: f32, add: impl FnOnce(&mut Ui) -> R) -> R {
    let size = vec2(before, ui.spacing().interact_size.y);
    let shown = ui.allocate_ui_with_layout(size, Layout::left_to_right(Align::Center), add);
    let width = shown.response.rect.width();
    if (width - before).abs() > 0.5 {
        ui.data_mut(|data| data.insert_temp(id, width));
        ui.ctx().request_repaint();
    }
    shown.inner
}

#[cfg(test)]
mod tests {
    use super::{at_right_ui, together_ui};
    use egui_kittest::Harness;
    use egui_kittest::kittest::Queryable as _;

    /// In rows of 200 points, the button before leaves no room for both of the others, though it does for the first.
    #[test]
    fn what_belongs_together_begins_the_next_row() {
        let mut harness = Harness::builder().with_size([216.0, 200.0]).build_ui(|ui| {
            let wide = |ui: &mut egui::Ui, name: &str, width: f32| {
                ui.add(egui::Button::new(name).min_size(egui::vec2(width, 20.0)));
            };
            ui.horizontal_wrapped(|ui| {
                wide(ui, "before", 110.0);
                together_ui(ui, "pair", |ui| {
                    wide(ui, "one", 50.0);
                    wide(ui, "two", 50.0);
                });
                wide(ui, "after", 30.0);
            });
        });
        harness.run_steps(3);
        let area = |name: &str| harness.get_by_label(name).rect();
        assert!(area("one").top() > area("before").bottom());
        assert!((area("one").center().y - area("two").center().y).abs() < 1.0);
        assert!((area("two").center().y - area("after").center().y).abs() < 1.0);
        assert!(area("two").right() < area("after").left());
    }

    /// The row ends where the window does, whatever stands before them; they keep their order.
    #[test]
    fn what_belongs_to_the_right_edge_ends_there() {
        let mut harness = Harness::builder().with_size([300.0, 100.0]).build_ui(|ui| {
            ui.horizontal(|ui| {
                ui.label("before");
                at_right_ui(ui, |ui| {
                    for name in ["main", "Close"] {
                        ui.add(egui::Button::new(name).min_size(egui::vec2(50.0, 20.0)));
                    }
                });
            });
        });
        harness.run_steps(3);
        let area = |name: &str| harness.get_by_label(name).rect();
        let right = 300.0 - area("before").left();
        assert!((area("Close").right() - right).abs() < 1.0, "{:?} in {right}", area("Close"));
        assert!(area("main").right() < area("Close").left());
        assert!((area("main").center().y - area("before").center().y).abs() < 2.0);
    }
}
