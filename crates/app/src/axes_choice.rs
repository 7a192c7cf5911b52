//! Which attributes are the axes, where textures have more than the two of their places.

use egui::{ComboBox, Ui};

use crate::command::Command;
use crate::edit::Edit;
use crate::panel::Panel;
use crate::strings;

/// Width of a choice, in points.
const WIDTH: f32 = 132.0;

/// Draws the choice for the axis across (0) or up (1), where there is one, into a row that has the word at the low end,
/// and returns what the user asked of it.
pub(crate) fn axis_choice_ui(ui: &mut Ui, panel: &Panel<'_>, axis: usize) -> Option<Command> {
    let names: Vec<String> = panel.session.attribute_names().into_iter().map(str::to_owned).collect();
    let current = panel.project.axes.as_ref();
    if names.len() < 3 && current.is_none() {
        return None;
    }
    let name = if axis == 0 { strings::AXIS_ACROSS } else { strings::AXIS_UP };
    let shown = current.map_or(strings::AXES_AS_PLACED, |axes| axes[axis].as_str());
    let mut chosen = None;
    // In the middle, however long the words at the ends of the axis are.
    let row = ui.max_rect();
    ui.add_space((row.center().x - 0.5 * WIDTH - ui.cursor().left()).max(0.0));
    let combo = ComboBox::from_id_salt(name).width(WIDTH).truncate().selected_text(shown);
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
