//! Validation summary of a built space, and the button that uses the space.

use std::sync::Arc;

use egui::{Button, Frame, Label, Margin, Panel as Side, RichText, ScrollArea, Ui, vec2};
use shagreen_core::space::LabelSource;

use crate::command::Command;
use crate::look::primary::primary_button;
use crate::look::theme::{GAP, SCROLL_BAR_ROOM, tokens};
use crate::panel::Panel;
use crate::state::edit::Edit;
use crate::strings::build as strings;
use crate::workspace::Workspace;
use shagreen_studio::space::BuiltSpace;

/// Height of the area with the button, in points.
const FOOT: f32 = 72.0;

/// Draws the column; returns the requested command.
pub(super) fn validation_ui(
    ui: &mut Ui,
    panel: &Panel<'_>,
    built: Option<&BuiltSpace>,
    has_changed: bool,
) -> Option<Command> {
    let t = tokens(ui.ctx());
    let mut asked = None;
    if let Some(built) = built {
        let frame = Frame::new().inner_margin(Margin::symmetric(0, 8));
        Side::bottom("use").exact_size(FOOT).frame(frame).show(ui, |ui| {
            asked = use_ui(ui, panel, built);
        });
    }
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        ui.set_max_width(ui.available_width() - SCROLL_BAR_ROOM);
        ui.add_space(GAP);
        ui.add(Label::new(RichText::new(strings::VERDICT).heading()).wrap().selectable(false));
        let Some(built) = built else {
            ui.add(Label::new(RichText::new(strings::NO_VERDICT).color(t.text_weak)).wrap());
            return;
        };
        if built.build.source != LabelSource::HumanRatings {
            let source = RichText::new(built.build.source.label()).strong().color(t.warning);
            ui.add(Label::new(source).selectable(false));
        }
        if has_changed {
            ui.add(Label::new(RichText::new(strings::CHANGED).color(t.warning)).wrap());
        }
        for finding in &built.build.findings {
            ui.add_space(2.0);
            ui.add(Label::new(RichText::new(finding).color(t.warning)).wrap());
        }
        for sentence in &built.validation {
            ui.add_space(2.0);
            ui.add(Label::new(sentence).wrap());
        }
        ui.add_space(GAP);
    });
    asked
}

fn use_ui(ui: &mut Ui, panel: &Panel<'_>, built: &BuiltSpace) -> Option<Command> {
    let t = tokens(ui.ctx());
    let is_in_use = panel.project.space.as_ref().is_some_and(|used| Arc::ptr_eq(used, &built.placed));
    let size = vec2(ui.available_width(), 30.0);
    if is_in_use {
        let text = RichText::new(format!("{}: {}", strings::IN_USE, built.build.place_source().label()));
        ui.add(Label::new(text.color(t.accent)).selectable(false));
        return ui
            .add_sized(size, Button::new(strings::GO_TO_AUTHOR))
            .clicked()
            .then_some(Command::Show(Workspace::Author));
    }
    let note = RichText::new(strings::USE_NOTE).color(t.text_weak);
    ui.add(Label::new(note).truncate().selectable(false));
    let button = primary_button(t, strings::USE_SPACE, true);
    let is_wanted = ui.add_sized(size, button).on_hover_text(strings::USE_HELP).clicked();
    is_wanted.then(|| Command::Edit(Edit::UseSpace(Arc::clone(&built.placed))))
}
