//! Gallery of projects that come with the program, each with a picture of its points.

use egui::{Align2, Context, FontId, Label, Rect, RichText, Role, Sense, Ui, WidgetInfo, vec2};
use shagreen_formats::gallery::{GALLERY, GalleryProject};
use shagreen_formats::project::Project;

use crate::command::{Command, FileCommand};
use crate::look::axes::{Axes, View};
use crate::look::sheet_frame::{is_left, sheet};
use crate::look::theme::{GAP, RADIUS, Tokens, tokens};
use crate::strings::gallery as strings;

/// Number of cards in a row.
const COLUMNS: usize = 3;
/// Size of a card, in points.
const CARD: egui::Vec2 = vec2(236.0, 104.0);
/// Side of the picture of the points, in points.
const PICTURE: f32 = 84.0;

pub(crate) struct GallerySheet {
    projects: Vec<(GalleryProject, Project)>,
}

impl GallerySheet {
    /// Sheet with all projects that can be read.
    pub(crate) fn new() -> Self {
        // Unreadable projects are left out; a test ensures that all can be read.
        let projects = GALLERY.iter().filter_map(|each| Some((*each, each.read().ok()?)));
        Self { projects: projects.collect() }
    }

    /// Draws the sheet; returns the requested commands.
    pub(crate) fn show(&self, ctx: &Context) -> Vec<Command> {
        let t = tokens(ctx);
        let mut commands = Vec::new();
        sheet(ctx, "gallery", |ui| {
            ui.set_width(COLUMNS as f32 * (CARD.x + GAP));
            ui.add(Label::new(RichText::new(strings::TITLE).heading().strong()).selectable(false));
            ui.add(Label::new(RichText::new(strings::HELP).color(t.text_weak)).selectable(false));
            ui.add_space(GAP);
            for row in self.projects.chunks(COLUMNS) {
                ui.horizontal(|ui| {
                    for (each, project) in row {
                        if card_ui(ui, each.title, project, t) {
                            commands.push(Command::File(FileCommand::BeginFromGallery(*each)));
                        }
                    }
                });
            }
            ui.add_space(GAP);
            if ui.button(strings::CLOSE).clicked() {
                commands.push(Command::CloseSheet);
            }
        });
        if is_left(ctx) {
            commands.push(Command::CloseSheet);
        }
        commands
    }
}

/// Draws the card of a project with its points, name and description; returns whether it was chosen.
fn card_ui(ui: &mut Ui, title: &str, project: &Project, t: &Tokens) -> bool {
    let (area, response) = ui.allocate_exact_size(CARD, Sense::click());
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, strings::open(title)));
    let fill = if response.hovered() || response.has_focus() { t.control_hovered } else { t.raised };
    ui.painter().rect_filled(area, f32::from(RADIUS), fill);
    let picture = Rect::from_min_size(area.min + vec2(10.0, 10.0), vec2(PICTURE, PICTURE));
    ui.painter().rect_filled(picture, f32::from(RADIUS), t.background);
    let axes = Axes { rect: picture.shrink(7.0), view: View::default() };
    for texture in &project.authored {
        let color = t.authored[usize::from(texture.color)];
        if let Some(path) = &texture.path {
            let points: Vec<egui::Pos2> =
                path.points.iter().map(|point| axes.ui_from_space(*point)).collect();
            ui.painter().line(points, egui::Stroke::new(1.5, color.gamma_multiply(0.7)));
        }
        ui.painter().circle_filled(axes.ui_from_space(texture.at), 4.0, color);
    }
    let left = picture.right() + 10.0;
    let right = area.right() - 8.0;
    let title_font = FontId::proportional(14.5);
    let name =
        ui.painter().text(egui::pos2(left, picture.top()), Align2::LEFT_TOP, title, title_font, t.text);
    let mut room =
        Rect::from_min_max(egui::pos2(left, name.bottom() + 2.0), egui::pos2(right, picture.bottom()));
    room.max.y += 4.0;
    let mut job = egui::text::LayoutJob::simple(
        project.notes.clone(),
        FontId::proportional(11.5),
        t.text_weak,
        room.width(),
    );
    job.wrap.max_rows = (room.height() / 14.5) as usize;
    let galley = ui.painter().layout_job(job);
    ui.painter().galley(room.min, galley, t.text_weak);
    let names: Vec<&str> = project.authored.iter().map(|texture| texture.name.as_str()).collect();
    let is_chosen = response.clicked();
    response.on_hover_text(format!("{}\n{}", project.notes, names.join(", ")));
    is_chosen
}
