//! The switch of an added texture between the whole space and the authored textures that pin it.

use egui::{Label, RichText, Ui};
use shagreen_formats::project::AuthoredTexture;

use crate::command::Command;
use crate::look::theme::tokens;
use crate::panel::Panel;
use crate::state::edit::Edit;
use crate::strings::textures as words;

/// Draws the switch; nothing for a texture of the library.
pub(crate) fn whole_space_switch(ui: &mut Ui, panel: &Panel<'_>, texture: usize) -> Option<Command> {
    let joined = panel.joined_index(texture)?;
    let mut is_everywhere = !panel.session.is_own(texture);
    let switch = ui.checkbox(&mut is_everywhere, words::WHOLE_SPACE);
    let is_changed = switch.changed();
    switch.on_hover_text(effect(panel, texture));
    let name = panel.session.textures()[texture].name.clone();
    is_changed.then(|| Command::Edit(Edit::SetOwn { joined, name, is_own: !is_everywhere }))
}

/// Draws the switch with a sentence of what it changes; nothing for a texture of the library.
pub(crate) fn whole_space_ui(ui: &mut Ui, panel: &Panel<'_>, texture: usize) -> Option<Command> {
    panel.joined_index(texture)?;
    let asked = whole_space_switch(ui, panel, texture);
    let effect = RichText::new(effect(panel, texture)).small().color(tokens(ui.ctx()).text_weak);
    ui.add(Label::new(effect).wrap().selectable(false));
    asked
}

/// Authored textures in which an added texture takes part, if only those that pin it use it.
pub(crate) fn only_in(panel: &Panel<'_>, texture: usize) -> Option<String> {
    if !panel.session.is_own(texture) {
        return None;
    }
    let id = &panel.session.textures()[texture].id;
    let users = panel.project.authored.iter().filter(|authored| authored.blend.locked.contains(id));
    Some(words::only_in(&users.map(|authored| authored.name.as_str()).collect::<Vec<_>>()))
}

/// Textures that only the authored textures that pin them use, and that this one pins.
pub(crate) fn own_textures(panel: &Panel<'_>, authored: &AuthoredTexture) -> Vec<usize> {
    let pinned = authored.blend.locked.iter().filter_map(|id| panel.session.index_of(id));
    pinned.filter(|texture| panel.session.is_own(*texture)).collect()
}

/// Why the textures of [`own_textures`] are not among those of the space while another authored texture is selected; `None`
/// without any.
pub(crate) fn own_help(panel: &Panel<'_>, authored: &AuthoredTexture) -> Option<&'static str> {
    (!own_textures(panel, authored).is_empty()).then_some(words::OWN_HELP)
}

/// What the switch changes.
fn effect(panel: &Panel<'_>, texture: usize) -> String {
    let is_placed = panel.session.position(texture).is_some();
    let id = &panel.session.textures()[texture].id;
    let n_changed = is_placed.then(|| panel.project.n_without_pin(id));
    words::whole_space_effect(!panel.session.is_own(texture), n_changed)
}
