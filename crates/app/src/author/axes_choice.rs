//! Choice of the attributes shown on the axes, for spaces with more than two attributes.

use egui::{ComboBox, Ui};

use crate::command::Command;
use crate::look::list::ShowList as _;
use crate::panel::Panel;
use crate::state::edit::Edit;
use crate::strings;

/// Width of the combo box, in points.
const WIDTH: f32 = 132.0;

/// Draws the attribute choice of the X axis (0) or Y axis (1), into a row that starts with the label of its low end.
/// Draws nothing if there are fewer than three attributes and no choice has been made. Returns the requested command.
pub(crate) fn axis_choice_ui(ui: &mut Ui, panel: &Panel<'_>, axis: usize) -> Option<Command> {
    let names: Vec<String> = panel.session.attribute_names().into_iter().map(str::to_owned).collect();
    let current = panel.project.axes.as_ref();
    if names.len() < 3 && current.is_none() {
        return None;
    }
    let name = if axis == 0 { strings::AXIS_ACROSS } else { strings::AXIS_UP };
    let shown = current.map_or(strings::AXES_AS_PLACED, |axes| axes[axis].as_str());
    let mut chosen = None;
    // Centered, whatever the length of the axis end labels.
    let row = ui.max_rect();
    ui.add_space((row.center().x - 0.5 * WIDTH - ui.cursor().left()).max(0.0));
    let combo = ComboBox::from_id_salt(name).width(WIDTH).truncate().selected_text(shown);
    let combo = combo.show_list(ui, |ui| {
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

/// Returns both axes after `chosen` from `all` is assigned to the axis with index `axis`.
/// The other axis keeps its attribute. If that is `chosen` itself, it takes the previous attribute of this axis.
/// Without previous axes it takes the first free attribute. `None` if there is no other attribute.
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
        // The two axes swap their attributes.
        check(Some(['a', 'b']), 0, 'b', ['b', 'a']);
        assert_eq!(with_axis(None, &['a'], 0, &'a'), None);
    }
}
