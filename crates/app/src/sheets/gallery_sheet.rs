//! Gallery of projects that come with the program, each with the surfaces of its textures.

use std::sync::Arc;

use egui::{
    Align2, Context, FontId, Galley, Label, Pos2, Rect, Response, RichText, Role, ScrollArea, Sense,
    TextureHandle, Ui, WidgetInfo, pos2, vec2,
};
use shagreen_formats::gallery::{GALLERY, GalleryProject};
use shagreen_formats::project::Project;

use crate::command::{Command, FileCommand};
use crate::look::sheet_frame::sheet;
use crate::look::theme::{GAP, RADIUS, SCROLL_BAR_ROOM, Tokens, tokens};
use crate::look::together::at_right_ui;
use crate::state::gallery_pictures::GalleryPictures;
use crate::strings::gallery as strings;

/// Number of cards in a row.
const COLUMNS: usize = 3;
/// Width of a card, and distance between its edge and its content, in points.
const WIDTH: f32 = 300.0;
const MARGIN: f32 = 10.0;
/// Width and minimum height of the column of surfaces, in points.
const PICTURE: egui::Vec2 = vec2(84.0, 84.0);
/// Pixels of a surface per point.
const PIXELS_PER_POINT: f32 = 1.5;
/// Maximum number of surfaces of a card.
const MAX_SURFACES: usize = 6;
/// Height of the title, in points.
const TITLE: f32 = 20.0;
/// Height of the sheet around the cards, in points.
const AROUND: f32 = 160.0;

pub(crate) struct GallerySheet {
    projects: Vec<(GalleryProject, Project)>,
    pictures: GalleryPictures,
    /// Index of the project under the pointer in the last frame.
    pointed: Option<usize>,
}

impl GallerySheet {
    /// Sheet with all projects that can be read.
    pub(crate) fn new(ctx: &Context) -> Self {
        // Unreadable projects are left out; a test ensures that all can be read.
        let projects = GALLERY.iter().filter_map(|each| Some((*each, each.read().ok()?)));
        let projects: Vec<(GalleryProject, Project)> = projects.collect();
        Self { pictures: GalleryPictures::new(ctx, &projects), projects, pointed: None }
    }

    /// Project under the pointer, with its index.
    pub(crate) fn pointed(&self) -> Option<(usize, &Project)> {
        let index = self.pointed?;
        self.projects.get(index).map(|(_, project)| (index, project))
    }

    /// Draws the sheet; returns the requested commands.
    pub(crate) fn show(&mut self, ctx: &Context) -> Vec<Command> {
        self.pictures.collect(ctx);
        self.pointed = None;
        let t = tokens(ctx);
        let mut commands = Vec::new();
        sheet(ctx, "gallery", |ui| {
            ui.set_width(COLUMNS as f32 * (WIDTH + GAP) - GAP + SCROLL_BAR_ROOM);
            ui.add(Label::new(RichText::new(strings::TITLE).heading().strong()).selectable(false));
            ui.add(Label::new(RichText::new(strings::HELP).color(t.text_weak)).selectable(false));
            ui.add_space(GAP);
            let height = ctx.content_rect().height() - AROUND;
            let area = ScrollArea::vertical().max_height(height).auto_shrink([false, true]);
            area.show(ui, |ui| commands.extend(self.cards_ui(ui, t)));
            ui.add_space(GAP);
            ui.horizontal(|ui| {
                if self.pictures.is_busy() {
                    let text = RichText::new(strings::MAKING).small().color(t.text_weak);
                    ui.add(Label::new(text).selectable(false));
                }
                if at_right_ui(ui, |ui| ui.button(strings::CLOSE).clicked()) {
                    commands.push(Command::CloseSheet);
                }
            });
        });
        commands
    }

    /// Draws all cards; those of a row are as high as its longest text needs.
    fn cards_ui(&mut self, ui: &mut Ui, t: &Tokens) -> Option<Command> {
        let mut asked = None;
        let text_width = WIDTH - PICTURE.x - 3.0 * MARGIN;
        for (row_index, row) in self.projects.chunks(COLUMNS).enumerate() {
            let font = FontId::proportional(11.5);
            let texts = row.iter().map(|(_, project)| {
                ui.painter().layout(project.notes.clone(), font.clone(), t.text_weak, text_width)
            });
            let texts: Vec<Arc<Galley>> = texts.collect();
            let highest = texts.iter().map(|text| TITLE + text.size().y).fold(PICTURE.y, f32::max);
            ui.horizontal(|ui| {
                for (i, ((each, project), text)) in row.iter().zip(texts).enumerate() {
                    let surfaces = self.pictures.of(each.id);
                    let response = card_ui(ui, each.title, text, surfaces, highest + 2.0 * MARGIN, t);
                    if response.hovered() {
                        self.pointed = Some(COLUMNS * row_index + i);
                    }
                    if response.clicked() {
                        asked = Some(Command::File(FileCommand::BeginFromGallery(*each)));
                    }
                    let names: Vec<&str> =
                        project.authored.iter().map(|texture| texture.name.as_str()).collect();
                    response.on_hover_text(names.join(", "));
                }
            });
        }
        asked
    }
}

/// Draws the card of a project: surfaces on the left, title and text on the right.
fn card_ui(
    ui: &mut Ui,
    title: &str,
    text: Arc<Galley>,
    surfaces: &[TextureHandle],
    height: f32,
    t: &Tokens,
) -> Response {
    let (area, response) = ui.allocate_exact_size(vec2(WIDTH, height), Sense::click());
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, strings::open(title)));
    let fill = if response.hovered() || response.has_focus() { t.control_hovered } else { t.raised };
    ui.painter().rect_filled(area, f32::from(RADIUS), fill);
    let inner = area.shrink(MARGIN);
    let picture = Rect::from_min_size(inner.min, vec2(PICTURE.x, inner.height()));
    ui.painter().rect_filled(picture, 0.0, t.background);
    let n = surfaces.len().min(MAX_SURFACES);
    for (i, surface) in surfaces[..n].iter().enumerate() {
        let edge = |i: usize| picture.top() + picture.height() * i as f32 / n as f32;
        // A line of the background separates two surfaces.
        let gap = if i + 1 < n { 1.0 } else { 0.0 };
        let band =
            Rect::from_min_max(pos2(picture.left(), edge(i)), pos2(picture.right(), edge(i + 1) - gap));
        // The surface has no seam where it repeats.
        let shown = PIXELS_PER_POINT * band.size() / surface.size_vec2();
        let uv = Rect::from_min_size(Pos2::ZERO, shown);
        ui.painter().image(surface.id(), band, uv, egui::Color32::WHITE);
    }
    let left = picture.right() + MARGIN;
    let font = FontId::proportional(14.5);
    ui.painter().text(pos2(left, inner.top()), Align2::LEFT_TOP, title, font, t.text);
    ui.painter().galley(pos2(left, inner.top() + TITLE), text, t.text_weak);
    response
}
