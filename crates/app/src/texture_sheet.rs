//! What is known of a texture of the list: its name, place and terms, its model in numbers, and plots of it.

mod curves;
mod facts_ui;
mod levels_ui;

use std::sync::Arc;

use egui::{
    Align, Button, Color32, Context, Label, Layout, Rect, RichText, ScrollArea, Sense, TextEdit, TextStyle,
    Ui, vec2,
};
use shagreen_core::plane::Plane;
use shagreen_formats::library::TextureEntry;

use self::curves::Curves;
use self::facts_ui::{about_ui, attributes_ui, model_ui};
use self::levels_ui::levels_ui;
use crate::command::Command;
use crate::edit::Edit;
use crate::import::spectrum_plot::{SpectrumLine, spectra_plot};
use crate::library_panel::picture_ui;
use crate::panel::Panel;
use crate::plot::title;
use crate::sheet_frame::{is_left, sheet};
use crate::strings::help::CLOSE;
use crate::strings::textures as words;
use crate::texture_menu::{duplicated, remove_button};
use crate::theme::{GAP, GROUP_GAP, tokens};

/// Widths of what is said and of the plots, in points.
const FACTS_WIDTH: f32 = 366.0;
const PLOTS_WIDTH: f32 = 396.0;
/// Height of a plot, in points.
const PLOT_HEIGHT: f32 = 178.0;
/// Side of the picture, in points.
const PICTURE: f32 = 112.0;
/// What the sheet needs above and below its content, in points.
const AROUND: f32 = 150.0;

/// The sheet, as long as it is open.
pub(crate) struct TextureSheet {
    id: String,
    /// The name as it is written, while it is: what is no name yet must not be taken from under the hand.
    written: Option<String>,
    /// Whether the keyboard is to go to the name.
    wants_name: bool,
    /// What is drawn, worked out once: a plane takes too long for every frame.
    curves: Option<Curves>,
}

impl TextureSheet {
    /// The sheet of the texture with this identifier.
    pub(crate) fn new(id: String) -> Self {
        Self { id, written: None, wants_name: false, curves: None }
    }

    /// The same, with the keyboard in the name.
    pub(crate) fn to_rename(id: String) -> Self {
        Self { wants_name: true, ..Self::new(id) }
    }

    /// Draws the sheet over the window and returns what the user asked of it.
    pub(crate) fn show(&mut self, ctx: &Context, panel: &Panel<'_>) -> Vec<Command> {
        let Some(texture) = panel.session.index_of(&self.id) else {
            // It was taken away.
            return vec![Command::CloseSheet];
        };
        let shown = sheet(ctx, "texture sheet", |ui| {
            ui.set_width(FACTS_WIDTH + GROUP_GAP + PLOTS_WIDTH);
            ui.add(Label::new(RichText::new(words::TITLE).heading().strong()).selectable(false));
            ui.add_space(GAP);
            let height = (ctx.content_rect().height() - AROUND).max(PLOT_HEIGHT);
            // Else it would grow frame by frame, and its buttons run away from the pointer.
            let area = ScrollArea::vertical().max_height(height).min_scrolled_height(height);
            let area = area.auto_shrink([false, true]);
            let mut commands = area.show(ui, |ui| self.content_ui(ui, panel, texture)).inner;
            ui.add_space(GAP);
            commands.extend(foot_ui(ui, panel, texture));
            commands
        });
        let mut commands = shown.inner;
        if is_left(ctx) {
            commands.push(Command::CloseSheet);
        }
        commands
    }

    fn content_ui(&mut self, ui: &mut Ui, panel: &Panel<'_>, texture: usize) -> Vec<Command> {
        let mut commands = Vec::new();
        let entry = &panel.session.textures()[texture];
        let top_down = Layout::top_down(Align::Min);
        ui.horizontal_top(|ui| {
            ui.allocate_ui_with_layout(vec2(FACTS_WIDTH, 0.0), top_down, |ui| {
                ui.set_width(FACTS_WIDTH);
                ui.horizontal_top(|ui| {
                    let (area, _) = ui.allocate_exact_size(vec2(PICTURE, PICTURE), Sense::hover());
                    picture_ui(ui, panel, texture, area);
                    ui.vertical(|ui| commands.extend(self.name_ui(ui, entry)));
                });
                ui.add_space(GAP);
                about_ui(ui, panel, texture);
                model_ui(ui, entry);
                attributes_ui(ui, entry);
            });
            ui.add_space(GROUP_GAP - GAP);
            ui.allocate_ui_with_layout(vec2(PLOTS_WIDTH, 0.0), top_down, |ui| {
                ui.set_width(PLOTS_WIDTH - GROUP_GAP);
                self.plots_ui(ui, &panel.session.planes()[texture], entry);
            });
        });
        commands
    }

    /// The name, to be changed, and what the texture is.
    fn name_ui(&mut self, ui: &mut Ui, entry: &TextureEntry) -> Option<Command> {
        let t = tokens(ui.ctx());
        let mut name = self.written.take().unwrap_or_else(|| entry.name.clone());
        let field = TextEdit::singleline(&mut name).font(TextStyle::Heading).desired_width(f32::INFINITY);
        let field = ui.add(field).accessible_name(words::NAME).on_hover_text(words::RENAME_HELP);
        if std::mem::take(&mut self.wants_name) {
            field.request_focus();
        }
        let is_named = !name.trim().is_empty();
        let is_new = field.changed() && is_named && name.trim() != entry.name;
        let edit = is_new.then(|| Edit::RenameTexture { id: self.id.clone(), name: name.trim().to_owned() });
        if !is_named {
            let needed = RichText::new(words::NAME_NEEDED).small().color(t.error);
            ui.add(Label::new(needed).wrap().selectable(false));
        } else if !entry.description.is_empty() {
            ui.add(Label::new(RichText::new(&entry.description).small()).wrap());
        }
        // Who leaves the field leaves what is no name behind.
        self.written = field.has_focus().then_some(name);
        edit.map(Command::Edit)
    }

    fn plots_ui(&mut self, ui: &mut Ui, plane: &Arc<Plane>, entry: &TextureEntry) {
        let t = tokens(ui.ctx());
        let known = self.curves.take().filter(|curves| curves.are_of(plane));
        let curves = &*self.curves.insert(known.unwrap_or_else(|| Curves::new(plane, &entry.model)));
        title(ui, words::LEVELS, &words::levels_unit(curves.range_db));
        levels_ui(ui, curves, &entry.model, PLOT_HEIGHT);
        ui.add_space(GAP);
        title(ui, words::SPECTRA, &words::spectra_unit(curves.middle_force_n));
        let last = curves.speeds_mm_per_s.len().saturating_sub(1).max(1) as f32;
        // From the blue of the one parent to the amber of the other: readers of any color vision tell them apart.
        let color = |i: usize| t.parents[1].lerp_to_gamma(t.parents[0], i as f32 / last);
        speeds_ui(ui, &curves.speeds_mm_per_s, color);
        let lines = curves.spectra.iter().enumerate().map(|(i, density)| SpectrumLine {
            // Named above the plot, where names cover nothing and stand in their order.
            name: "",
            density,
            color: color(i),
            width: 1.6,
        });
        let lines: Vec<SpectrumLine<'_>> = lines.collect();
        spectra_plot(ui, words::SPECTRA, &curves.frequencies, &lines, PLOT_HEIGHT);
    }
}

/// What can be done with the texture.
fn foot_ui(ui: &mut Ui, panel: &Panel<'_>, texture: usize) -> Vec<Command> {
    let mut commands = Vec::new();
    ui.horizontal(|ui| {
        let is_alone = panel.solo() == Some(texture);
        let alone = ui.add(Button::new(words::HEAR_ALONE).selected(is_alone));
        if alone.on_hover_text(words::HEAR_ALONE_HELP).clicked() {
            let id = panel.session.textures()[texture].id.clone();
            commands.push(Command::Edit(Edit::Solo(Some(id))));
        }
        // The list shows what came of it.
        if ui.button(words::DUPLICATE).on_hover_text(words::DUPLICATE_HELP).clicked() {
            commands.extend([Command::Edit(duplicated(panel, texture)), Command::CloseSheet]);
        }
        if let Some(remove) = remove_button(ui, panel, texture) {
            commands.extend([remove, Command::CloseSheet]);
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            if ui.button(CLOSE).clicked() {
                commands.push(Command::CloseSheet);
            }
        });
    });
    commands
}

/// Which line is of which speed, from slow to fast.
fn speeds_ui(ui: &mut Ui, speeds_mm_per_s: &[f64], color: impl Fn(usize) -> Color32) {
    let t = tokens(ui.ctx());
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(4.0, 0.0);
        for (i, speed) in speeds_mm_per_s.iter().enumerate() {
            let (area, _) = ui.allocate_exact_size(vec2(8.0, 8.0), Sense::hover());
            ui.painter().circle_filled(area.center(), 3.5, color(i));
            let speed = RichText::new(words::speed(*speed)).small().color(t.text_weak);
            ui.add(Label::new(speed).selectable(false));
            ui.add_space(GAP);
        }
    });
}

/// A place in a rectangle by shares of its width and height, the latter upwards.
fn at_share(area: Rect, across: f32, up: f32) -> egui::Pos2 {
    egui::pos2(area.left() + across * area.width(), area.bottom() - up * area.height())
}
