//! The authored texture in numbers: name, sliders, blend, parents.

use egui::{Label, Rect, RichText, Role, Sense, Slider, TextEdit, Ui, WidgetInfo, vec2};
use shagreen_core::blend::Mode;
use shagreen_core::space::SpacePoint;

use crate::axes_choice::axis_choice_ui;
use crate::command::Command;
use crate::library_panel::picture_ui;
use crate::panel::Panel;
use crate::project::Edit;
use crate::strings;
use crate::theme::{GAP, GROUP_GAP, RADIUS, tokens};

/// Draws the column and returns what the user asked of it.
pub fn inspector_ui(ui: &mut Ui, panel: &Panel<'_>) -> Vec<Command> {
    let area = egui::ScrollArea::vertical().auto_shrink(false);
    area.show(ui, |ui| content_ui(ui, panel)).inner
}

fn content_ui(ui: &mut Ui, panel: &Panel<'_>) -> Vec<Command> {
    let mut commands = Vec::new();
    ui.add_space(GAP);
    let mut name = panel.project.name.clone();
    let field =
        ui.add(TextEdit::singleline(&mut name).font(egui::TextStyle::Heading).desired_width(f32::INFINITY));
    field.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, strings::NAME));
    if field.changed() {
        commands.push(Command::Edit(Edit::Rename(name)));
    }
    ui.add_space(GAP);
    commands.extend(sliders(ui, panel));
    ui.add_space(GROUP_GAP);
    commands.extend(blend_ui(ui, panel.project.mode));
    ui.add_space(GROUP_GAP);
    parents_ui(ui, panel);
    commands
}

/// The two axes, bound to the point both ways.
fn sliders(ui: &mut Ui, panel: &Panel<'_>) -> Vec<Command> {
    let mut commands = Vec::new();
    let SpacePoint { mut rough_smooth, mut hard_soft } = panel.project.point;
    let [across, up] = panel.session.poles();
    let mut is_changed = false;
    for (axis, value, ends) in [(0, &mut rough_smooth, across), (1, &mut hard_soft, up)] {
        let (changed, choice) = axis_slider(ui, panel, axis, value, ends);
        is_changed |= changed;
        commands.extend(choice);
    }
    if is_changed {
        commands.push(Command::Edit(Edit::MovePoint(SpacePoint { rough_smooth, hard_soft })));
    }
    commands
}

/// The slider of one axis under the words at its ends; returns whether it was moved, and which axis was chosen instead.
fn axis_slider(
    ui: &mut Ui,
    panel: &Panel<'_>,
    axis: usize,
    value: &mut f64,
    ends: &[String; 2],
) -> (bool, Option<Command>) {
    let t = tokens(ui.ctx());
    let choice = ui.horizontal(|ui| {
        ui.add(Label::new(RichText::new(&ends[0]).color(t.text_weak)).selectable(false));
        let choice = axis_choice_ui(ui, panel, axis);
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            ui.add(Label::new(RichText::new(&ends[1]).color(t.text_weak)).selectable(false));
        });
        choice
    });
    let width = ui.available_width();
    ui.spacing_mut().slider_width = width - 66.0;
    // Shown with one decimal, not rounded to it: a slider that rounds would edit the project by itself.
    let one_decimal = |value: f64, _| format!("{value:.1}");
    let slider = Slider::new(value, 0.0..=100.0).custom_formatter(one_decimal).smart_aim(false);
    let slider = ui.add(slider).accessible_name(strings::axis(ends)).on_hover_text(strings::axis_help(ends));
    (slider.changed(), choice.inner)
}

fn blend_ui(ui: &mut Ui, mode: Mode) -> Option<Command> {
    let mut chosen = None;
    ui.horizontal(|ui| {
        ui.add(Label::new(strings::BLEND).selectable(false));
        for each in Mode::ALL {
            if ui.selectable_label(mode == each, each.id()).on_hover_text(mode_help(each)).clicked() {
                chosen = Some(Command::Edit(Edit::SetMode(each)));
            }
        }
    });
    chosen
}

fn mode_help(mode: Mode) -> &'static str {
    match mode {
        Mode::Paper => strings::PAPER_HELP,
        Mode::Power => strings::POWER_HELP,
        Mode::Shared => strings::SHARED_HELP,
        Mode::Parametric => strings::PARAMETRIC_HELP,
        Mode::Field => strings::FIELD_HELP,
    }
}

/// The neighbors, with pictures and weights.
fn parents_ui(ui: &mut Ui, panel: &Panel<'_>) {
    let t = tokens(ui.ctx());
    ui.add(Label::new(RichText::new(strings::PARENTS).strong()).selectable(false))
        .on_hover_text(strings::PARENTS_HELP);
    let Some(authored) = panel.session.authored() else { return };
    // A weight that would read 0.0 % is not worth a card.
    let heard = authored.parents.iter().enumerate().filter(|(_, (_, weight))| *weight >= 5e-4);
    for (rank, (texture, weight)) in heard {
        let entry = &panel.session.textures()[*texture];
        let (area, response) = ui.allocate_exact_size(vec2(ui.available_width(), 50.0), Sense::hover());
        let percent = 100.0 * weight;
        response
            .widget_info(|| WidgetInfo::labeled(Role::Label, true, strings::parent(&entry.name, percent)));
        let color = t.parents[rank.min(2)];
        ui.painter().rect_filled(area, f32::from(RADIUS), t.raised);
        let picture = Rect::from_min_size(area.min + vec2(4.0, 4.0), vec2(42.0, 42.0));
        picture_ui(ui, panel, *texture, picture);
        ui.painter().rect_stroke(
            picture,
            f32::from(RADIUS) - 1.0,
            egui::Stroke::new(2.0, color),
            egui::StrokeKind::Outside,
        );
        let left = picture.right() + 10.0;
        let right = area.right() - 10.0;
        let font = egui::FontId::proportional(14.0);
        let number = ui.painter().text(
            egui::pos2(right, area.top() + 9.0),
            egui::Align2::RIGHT_TOP,
            format!("{percent:.1} %"),
            font.clone(),
            t.text,
        );
        let mut name = ui.new_child(egui::UiBuilder::new().max_rect(Rect::from_min_max(
            egui::pos2(left, area.top() + 8.0),
            egui::pos2(number.left() - 6.0, area.bottom()),
        )));
        name.add(Label::new(RichText::new(&entry.name).color(color)).truncate().selectable(false));
        let bar = Rect::from_min_max(
            egui::pos2(left, area.bottom() - 16.0),
            egui::pos2(right, area.bottom() - 10.0),
        );
        ui.painter().rect_filled(bar, 3.0, t.control);
        let filled = Rect::from_min_size(bar.min, vec2(bar.width() * *weight as f32, bar.height()));
        ui.painter().rect_filled(filled, 3.0, color);
    }
}
