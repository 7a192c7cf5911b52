//! Menu of a texture in the list.

use std::sync::Arc;

use egui::{Button, Ui};
use shagreen_formats::library::{Library, TextureEntry, free_id, free_name, id_from_name};

use crate::author::context_menu::menu_entry;
use crate::author::exact::{authored_exactly, taken};
use crate::author::locks::{can_lock, lock_entry};
use crate::author::whole_space::whole_space_switch;
use crate::command::Command;
use crate::command::relief::{ReliefCommand, ReliefOf};
use crate::panel::Panel;
use crate::state::edit::Edit;
use crate::strings::authored::copy_of;
use crate::strings::{relief, textures as words};
use shagreen_studio::place_estimate::{can_estimate, place_by_estimate};

/// Width of the menu, in points.
const WIDTH: f32 = 150.0;

/// Draws the menu entries; returns the requested command.
pub(crate) fn texture_menu(ui: &mut Ui, panel: &Panel<'_>, texture: usize) -> Option<Command> {
    let id = || panel.session.textures()[texture].id.clone();
    let mut asked = None;
    ui.set_min_width(WIDTH);
    if ui.button(words::DETAILS).on_hover_text(words::DETAILS_HELP).clicked() {
        asked = Some(Command::OpenTexture(id()));
    }
    if ui.button(words::HEAR_ALONE).on_hover_text(words::HEAR_ALONE_HELP).clicked() {
        asked = Some(Command::Edit(Edit::Solo(Some(id()))));
    }
    for (name, help, edit) in [
        (words::CHOOSE, words::CHOOSE_HELP, taken(panel, texture)),
        (words::AUTHOR, words::AUTHOR_HELP, authored_exactly(panel, texture)),
    ] {
        if let Some(edit) = edit {
            asked = menu_entry(ui, name, help, Command::Edit(edit)).or(asked);
        } else {
            ui.add_enabled(false, Button::new(name)).on_disabled_hover_text(words::NO_POSITION);
        }
    }
    ui.separator();
    let star = if panel.is_starred(texture) { words::UNSTAR } else { words::STAR };
    if ui.button(star).on_hover_text(words::STAR_HELP).clicked() {
        asked = Some(Command::Edit(starred(panel, texture)));
    }
    if ui.button(words::RENAME).on_hover_text(words::RENAME_HELP).clicked() {
        asked = Some(Command::RenameTexture(id()));
    }
    if ui.button(words::DUPLICATE).on_hover_text(words::DUPLICATE_HELP).clicked() {
        asked = Some(Command::Edit(duplicated(panel, texture)));
    }
    asked = place_button(ui, panel, texture).or(asked);
    asked = relief_button(ui, panel, texture).or(asked);
    asked = remove_button(ui, panel, texture).or(asked);
    if let Some(switch) = whole_space_switch(ui, panel, texture) {
        asked = Some(switch);
        ui.close();
    }
    if can_lock(panel, texture) {
        ui.separator();
        asked = lock_entry(ui, panel, texture).or(asked);
    }
    asked
}

/// Draws the button that estimates the position of an added texture; nothing for a texture that has one. It is disabled where no
/// position can be estimated.
fn place_button(ui: &mut Ui, panel: &Panel<'_>, texture: usize) -> Option<Command> {
    let joined = panel.joined_index(texture)?;
    if panel.session.position(texture).is_some() {
        return None;
    }
    let entry = panel.project.joined.get(joined)?;
    // A built space places only what has been rated, and an estimate does not replace a position on other axes.
    let is_of_files =
        panel.project.space.is_none() && (panel.project.axes.is_none() || entry.place.is_none());
    let is_slow_enough = entry.model.rate().0 <= panel.session.space_rate_hz();
    let can_place = is_of_files && is_slow_enough && can_estimate(panel.session.library());
    let button = ui.add_enabled(can_place, Button::new(words::ESTIMATE_PLACE));
    let button = button.on_hover_text(words::ESTIMATE_PLACE_HELP).on_disabled_hover_text(words::CANNOT_PLACE);
    if !button.clicked() {
        return None;
    }
    let mut placed = TextureEntry::clone(entry);
    place_by_estimate(&mut placed, panel.session.library());
    let name = panel.session.textures()[texture].name.clone();
    Some(Command::Edit(Edit::PlaceTexture { joined, name, entry: Arc::new(placed) }))
}

/// Draws the button that gives a texture a relief; it is disabled for a texture path.
pub(crate) fn relief_button(ui: &mut Ui, panel: &Panel<'_>, texture: usize) -> Option<Command> {
    let entry = &panel.session.textures()[texture];
    let button = ui.add_enabled(entry.path.is_none(), Button::new(relief::MENU));
    let button = button.on_hover_text(relief::MENU_HELP).on_disabled_hover_text(relief::IS_PATH);
    let of = || ReliefOf::Listed(entry.id.clone());
    button.clicked().then(|| Command::Relief(ReliefCommand::Begin(Some(of()), None)))
}

/// Draws the button that removes a texture; it is disabled for a texture that was not added to the project.
pub(crate) fn remove_button(ui: &mut Ui, panel: &Panel<'_>, texture: usize) -> Option<Command> {
    let joined = panel.joined_index(texture);
    let button = ui.add_enabled(joined.is_some(), Button::new(words::REMOVE));
    let button = button.on_hover_text(words::REMOVE_HELP).on_disabled_hover_text(words::CANNOT_REMOVE);
    joined.filter(|_| button.clicked()).map(|joined| Command::Edit(Edit::RemoveTexture(joined)))
}

/// Edit that adds or removes the star of a texture.
pub(crate) fn starred(panel: &Panel<'_>, texture: usize) -> Edit {
    let TextureEntry { id, name, .. } = &panel.session.textures()[texture];
    Edit::Star { id: id.clone(), name: name.clone(), is_starred: !panel.is_starred(texture) }
}

/// Edit that adds a copy of the texture to the project.
pub(crate) fn duplicated(panel: &Panel<'_>, texture: usize) -> Edit {
    Edit::AddTextures(vec![Arc::new(copied(panel.session.library(), texture, copy_of))])
}

/// Copy of a texture at the same position, with a free identifier and the name that `named` makes of its own, or a free
/// one. License and origin of the library are stored in the copy, because another library may be open later.
pub(crate) fn copied(library: &Library, texture: usize, named: fn(&str) -> String) -> TextureEntry {
    let entry = &library.textures[texture];
    let name = free_name(&named(&entry.name), |name| library.textures.iter().any(|t| t.name == name));
    let id = free_id(&id_from_name(&name), |id| library.index_of(id).is_some());
    TextureEntry { id, name, ..library.with_terms(entry) }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::{copied, copy_of};
    use shagreen_formats::starter::starter_library;

    #[test]
    fn a_copy_has_a_name_of_its_own_and_the_terms_of_the_library() {
        let mut library = starter_library().unwrap();
        let cork = library.index_of("cork").unwrap();
        for (name, id) in [("Cork copy", "cork-copy"), ("Cork copy 2", "cork-copy-2")] {
            let copy = copied(&library, cork, copy_of);
            assert_eq!((copy.name.as_str(), copy.id.as_str()), (name, id));
            assert_eq!((&copy.license, &copy.origin), (&library.license, &library.origin));
            let original = &library.textures[cork];
            assert_eq!((copy.place, &copy.model), (original.place, &original.model));
            library.join(&[Arc::new(copy)]);
        }
        "CC-BY-4.0".clone_into(&mut library.textures[cork].license);
        assert_eq!(copied(&library, cork, copy_of).license, "CC-BY-4.0");
    }
}
