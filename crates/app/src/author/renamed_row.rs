//! Renaming of an authored texture in its row of the list.

use egui::{Context, Id, Key, Margin, Rect, Role, TextEdit, Ui, UiBuilder, WidgetInfo};
use shagreen_formats::project::AuthoredTexture;

use crate::command::Command;
use crate::look::text_selection::select_all;
use crate::state::edit::Edit;
use crate::strings::authored as words;

/// Margin of the text in the field, in points: as little as its row has room for.
const MARGIN: Margin = Margin::symmetric(3, 1);

/// Texture that is being renamed: its key, and its name before.
#[derive(Clone)]
struct Renamed {
    key: u32,
    before: String,
}

fn key_of_renamed() -> Id {
    Id::unique("authored texture renamed in its row")
}

fn field() -> Id {
    Id::unique("name in the row of an authored texture")
}

/// Replaces the name in the row by a field from the next frame on, with all of the name selected.
pub(super) fn begin_rename(ui: &Ui, texture: &AuthoredTexture) {
    let renamed = Renamed { key: texture.key, before: texture.name.clone() };
    ui.data_mut(|data| data.insert_temp(key_of_renamed(), renamed));
    ui.memory_mut(|memory| memory.request_focus(field()));
    select_all(ui.ctx(), field(), &texture.name);
}

/// Whether the row of the texture with this key has the field.
pub(super) fn is_renamed(ui: &Ui, key: u32) -> bool {
    renamed(ui.ctx()).is_some_and(|renamed| renamed.key == key)
}

fn renamed(ctx: &Context) -> Option<Renamed> {
    ctx.data(|data| data.get_temp(key_of_renamed()))
}

/// Draws the field in `area`, for the selected texture; returns the requested command. Escape restores the name. The field
/// disappears when it loses the keyboard focus.
pub(super) fn rename_ui(ui: &mut Ui, area: Rect, texture: &AuthoredTexture) -> Option<Command> {
    let mut name = texture.name.clone();
    let widget = TextEdit::singleline(&mut name).id(field()).margin(MARGIN).desired_width(f32::INFINITY);
    // Without a change of the layout: the row has its place already.
    let response = ui.new_child(UiBuilder::new().max_rect(area)).add(widget);
    response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, words::ROW_NAME));
    let mut asked = response.changed().then_some(name);
    if !response.has_focus() {
        let is_left = ui.input(|i| i.key_pressed(Key::Escape));
        asked = renamed(ui.ctx()).filter(|_| is_left).map(|renamed| renamed.before).or(asked);
        ui.data_mut(|data| data.remove::<Renamed>(key_of_renamed()));
    }
    asked.map(|name| Command::Edit(Edit::Rename(name)))
}
