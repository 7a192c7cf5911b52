//! Sheet about a texture of the list: name, position, license, model parameters and plots.

mod curves;
mod facts_ui;
mod levels_ui;

use std::sync::Arc;

use egui::{
    Align, Button, Color32, Context, Label, Layout, Rect, RichText, ScrollArea, Sense, TextEdit, TextStyle,
    Ui, vec2,
};
use shagreen_core::texture::plane::Plane;
use shagreen_formats::library::TextureEntry;

use self::curves::Curves;
use self::facts_ui::{about_ui, attributes_ui, model_ui};
use self::levels_ui::levels_ui;
use crate::author::texture_menu::{duplicated, relief_button, remove_button};
use crate::author::texture_picture::picture_ui;
use crate::author::whole_space::whole_space_ui;
use crate::command::Command;
use crate::look::plot::{legend_entry_ui, title};
use crate::look::sheet_frame::sheet;
use crate::look::spectrum_plot::{SpectrumLine, spectra_plot};
use crate::look::text_selection::select_all;
use crate::look::theme::{GAP, GROUP_GAP, tokens};
use crate::panel::Panel;
use crate::state::edit::Edit;
use crate::strings::help::CLOSE;
use crate::strings::textures as words;

/// Widths of the facts and of the plots, in points.
const FACTS_WIDTH: f32 = 366.0;
const PLOTS_WIDTH: f32 = 396.0;
/// Height of a plot, in points.
const PLOT_HEIGHT: f32 = 178.0;
/// Side of the picture, in points.
const PICTURE: f32 = 112.0;
/// Height of the sheet in addition to its scrolled content, in points.
const AROUND: f32 = 150.0;

pub(crate) struct TextureSheet {
    id: String,
    /// The name while it is being typed: a name that is not valid yet must not be reset meanwhile.
    written: Option<String>,
    /// Whether the name field is to get the keyboard focus.
    wants_name: bool,
    /// Plotted data, computed once: evaluating the model takes too long for every frame.
    curves: Option<Curves>,
}

impl TextureSheet {
    pub(crate) fn new(id: String) -> Self {
        Self { id, written: None, wants_name: false, curves: None }
    }

    /// Sheet of the texture with this identifier, with the keyboard focus in the name field.
    pub(crate) fn to_rename(id: String) -> Self {
        Self { wants_name: true, ..Self::new(id) }
    }

    /// Identifier of the texture.
    pub(crate) fn id(&self) -> &str {
        &self.id
    }

    /// Draws the sheet; returns the requested commands.
    pub(crate) fn show(&mut self, ctx: &Context, panel: &Panel<'_>) -> Vec<Command> {
        let Some(texture) = panel.session.index_of(&self.id) else {
            // The texture was removed.
            return vec![Command::CloseSheet];
        };
        sheet(ctx, "texture sheet", |ui| {
            ui.set_width(FACTS_WIDTH + GROUP_GAP + PLOTS_WIDTH);
            ui.add(Label::new(RichText::new(words::TITLE).heading().strong()).selectable(false));
            ui.add_space(GAP);
            let height = (ctx.content_rect().height() - AROUND).max(PLOT_HEIGHT);
            // Otherwise the sheet would grow frame by frame, and its buttons would move away from the pointer.
            let area = ScrollArea::vertical().max_height(height).min_scrolled_height(height);
            let area = area.auto_shrink([false, true]);
            let mut commands = area.show(ui, |ui| self.content_ui(ui, panel, texture)).inner;
            ui.add_space(GAP);
            commands.extend(foot_ui(ui, panel, texture));
            commands
        })
        .inner
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
                commands.extend(whole_space_ui(ui, panel, texture));
                model_ui(ui, panel, entry);
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

    /// Draws the editable name and the description.
    fn name_ui(&mut self, ui: &mut Ui, entry: &TextureEntry) -> Option<Command> {
        let t = tokens(ui.ctx());
        let mut name = self.written.take().unwrap_or_else(|| entry.name.clone());
        let field = TextEdit::singleline(&mut name).font(TextStyle::Heading).desired_width(f32::INFINITY);
        let field = ui.add(field).accessible_name(words::NAME).on_hover_text(words::RENAME_HELP);
        if std::mem::take(&mut self.wants_name) {
            field.request_focus();
            select_all(ui.ctx(), field.id, &name);
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
        // A name that is not valid is discarded when the field loses the focus.
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
        // From the blue of one contributing texture to the amber of another, distinguishable with any color vision.
        let color = |i: usize| t.parents[1].lerp_to_gamma(t.parents[0], i as f32 / last);
        speeds_ui(ui, &curves.speeds_mm_per_s, color);
        let lines = curves.spectra.iter().enumerate().map(|(i, density)| SpectrumLine {
            // Named above the plot, where the names cover nothing and keep their order.
            name: "",
            density,
            color: color(i),
            width: 1.6,
        });
        let lines: Vec<SpectrumLine<'_>> = lines.collect();
        spectra_plot(ui, words::SPECTRA, &curves.frequencies, &lines, PLOT_HEIGHT);
    }
}

/// Draws the actions on the texture.
fn foot_ui(ui: &mut Ui, panel: &Panel<'_>, texture: usize) -> Vec<Command> {
    let mut commands = Vec::new();
    ui.horizontal(|ui| {
        let is_alone = panel.solo() == Some(texture);
        let alone = ui.add(Button::new(words::HEAR_ALONE).selected(is_alone));
        if alone.on_hover_text(words::HEAR_ALONE_HELP).clicked() {
            let id = panel.session.textures()[texture].id.clone();
            commands.push(Command::Edit(Edit::Solo(Some(id))));
        }
        // The list then shows the result.
        if ui.button(words::DUPLICATE).on_hover_text(words::DUPLICATE_HELP).clicked() {
            commands.extend([Command::Edit(duplicated(panel, texture)), Command::CloseSheet]);
        }
        commands.extend(relief_button(ui, panel, texture));
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

/// Legend of the spectra by speed, from slow to fast.
fn speeds_ui(ui: &mut Ui, speeds_mm_per_s: &[f64], color: impl Fn(usize) -> Color32) {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(4.0, 0.0);
        for (i, speed) in speeds_mm_per_s.iter().enumerate() {
            legend_entry_ui(ui, color(i), &words::speed(*speed));
        }
    });
}

/// Point of a rectangle at shares of its width and height, the latter measured upwards.
fn at_share(area: Rect, across: f32, up: f32) -> egui::Pos2 {
    egui::pos2(area.left() + across * area.width(), area.bottom() - up * area.height())
}
