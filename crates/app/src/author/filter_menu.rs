//! Filter menu of the texture list.

use egui::containers::menu::{MenuButton, MenuConfig};
use egui::{Button, Label, PopupCloseBehavior, RichText, ScrollArea, Ui, vec2};

use crate::author::library_filter::{Filter, NEAR, tag_counts};
use crate::choices::textures::Region;
use crate::look::menu_checkbox::menu_checkbox;
use crate::look::theme::{GAP, tokens};
use crate::panel::Panel;
use crate::strings::textures as words;

/// Width of the menu, in points.
const WIDTH: f32 = 250.0;
/// Maximum height of the tag list, in points.
const TAGS_HEIGHT: f32 = 130.0;

/// Draws the menu button, `width` points wide, and updates `filter`.
pub(crate) fn filter_menu(ui: &mut Ui, panel: &Panel<'_>, filter: &mut Filter, width: f32) {
    let n_on = filter.n_on();
    let button = Button::new(words::filter(n_on)).selected(n_on > 0).min_size(vec2(width, 0.0));
    // The menu stays open, so that several filters can be chosen at once.
    let config = MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    let (response, _) = MenuButton::from_button(button).config(config).ui(ui, |ui| {
        ui.set_width(WIDTH);
        content_ui(ui, panel, filter);
    });
    response.on_hover_text(words::FILTER_HELP);
}

fn content_ui(ui: &mut Ui, panel: &Panel<'_>, filter: &mut Filter) {
    let heading = |ui: &mut Ui, text: &str, help: &str| {
        ui.add(Label::new(RichText::new(text).strong()).selectable(false)).on_hover_text(help);
    };
    heading(ui, words::REGION, &words::region_help(NEAR));
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(2.0, 2.0);
        ui.spacing_mut().button_padding.x = 6.0;
        let n_axes = panel.session.n_axes();
        for region in Region::ALL.into_iter().filter(|region| region.is_on(n_axes)) {
            let name = words::region(region, panel.session.poles());
            ui.selectable_value(&mut filter.region, region, name);
        }
    });
    ui.add_space(GAP);
    heading(ui, words::TAGS, words::TAGS_HELP);
    tags_ui(ui, panel, filter);
    ui.separator();
    for (is_on, name, help) in [
        (&mut filter.only_starred, words::ONLY_STARRED, words::ONLY_STARRED_HELP),
        (&mut filter.only_joined, words::ONLY_JOINED, words::ONLY_JOINED_HELP),
    ] {
        menu_checkbox(ui, is_on, name, true).on_hover_text(help);
    }
    ui.separator();
    if ui.add_enabled(filter.n_on() > 0, Button::new(words::CLEAR)).clicked() {
        *filter = Filter::default();
    }
}

fn tags_ui(ui: &mut Ui, panel: &Panel<'_>, filter: &mut Filter) {
    let chosen = filter.tags.clone();
    let counts = tag_counts(panel.session.textures().iter().map(|entry| entry.tags.as_slice()), &chosen);
    if counts.is_empty() {
        let weak = RichText::new(words::NO_TAGS).color(tokens(ui.ctx()).text_weak);
        ui.add(Label::new(weak).selectable(false));
    }
    ScrollArea::vertical().id_salt("tags").max_height(TAGS_HEIGHT).show(ui, |ui| {
        ui.set_width(ui.available_width());
        ui.spacing_mut().item_spacing.y = 0.0;
        for (tag, n) in counts {
            let mut is_on = chosen.contains(tag);
            if menu_checkbox(ui, &mut is_on, &words::tag(tag, n), true).changed() {
                if is_on {
                    filter.tags.insert(tag.to_owned());
                } else {
                    filter.tags.remove(tag);
                }
            }
        }
    });
}
