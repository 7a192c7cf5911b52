//! Which attributes are the axes, where textures have more than the two of their places.

use egui::{ComboBox, Label, RichText, Ui};

use crate::command::Command;
use crate::panel::Panel;
use crate::project::Edit;
use crate::strings;
use crate::theme::{GAP, tokens};

/// Draws the choice where there is one, and returns what the user asked of it.
pub(crate) fn axes_choice_ui(ui: &mut Ui, panel: &Panel<'_>) -> Option<Command> {
    let names: Vec<String> = panel.session.attribute_names().into_iter().map(str::to_owned).collect();
    if names.len() < 3 && panel.project.axes.is_none() {
        return None;
    }
    let t = tokens(ui.ctx());
    let current = panel.project.axes.as_ref();
    let mut chosen = None;
    let wide = 0.5 * (ui.available_width() - GAP);
    ui.horizontal(|ui| {
        for (axis, label, name) in
            [(0, strings::ACROSS, strings::AXIS_ACROSS), (1, strings::UP, strings::AXIS_UP)]
        {
            ui.vertical(|ui| {
                ui.set_width(wide);
                ui.add(Label::new(RichText::new(label).small().color(t.text_weak)).selectable(false));
                let shown = current.map_or(strings::AXES_AS_PLACED, |axes| axes[axis].as_str());
                let combo = ComboBox::from_id_salt(name).width(wide).truncate().selected_text(shown);
                let combo = combo.show_ui(ui, |ui| {
                    if ui.selectable_label(current.is_none(), strings::AXES_AS_PLACED).clicked() {
                        chosen = Some(None);
                    }
                    for each in &names {
                        if ui.selectable_label(current.is_some() && shown == each, each).clicked() {
                            chosen = Some(with_axis(current, &names, axis, each));
                        }
                    }
                });
                combo.response.accessible_name(name).on_hover_text(strings::AXES_HELP);
            });
        }
    });
    ui.add_space(GAP);
    chosen.map(|axes| Command::Edit(Edit::SetAxes(axes)))
}

/// The axes after one of them, of index `axis`, was chosen from `all`. The other stays; where it is the same, or none was
/// chosen before, it becomes what this one was, or the first that is free. `None` where there is only one.
pub(crate) fn with_axis<T: Clone + PartialEq>(
    before: Option<&[T; 2]>,
    all: &[T],
    axis: usize,
    chosen: &T,
) -> Option<[T; 2]> {
    let known = before.into_iter().flat_map(|axes| [&axes[1 - axis], &axes[axis]]);
    let other = known.chain(all).find(|other| *other != chosen)?.clone();
    Some(if axis == 0 { [chosen.clone(), other] } else { [other, chosen.clone()] })
}

#[cfg(test)]
mod tests {
    use super::with_axis;

    #[test]
    fn choosing_one_axis_never_leaves_two_of_the_same() {
        let check = |before: Option<[char; 2]>, axis: usize, chosen: char, expected: [char; 2]| {
            assert_eq!(with_axis(before.as_ref(), &['a', 'b', 'c'], axis, &chosen), Some(expected));
        };
        check(None, 0, 'a', ['a', 'b']);
        check(None, 1, 'c', ['a', 'c']);
        check(Some(['a', 'b']), 1, 'c', ['a', 'c']);
        // The two change places.
        check(Some(['a', 'b']), 0, 'b', ['b', 'a']);
        assert_eq!(with_axis(None, &['a'], 0, &'a'), None);
    }
}
