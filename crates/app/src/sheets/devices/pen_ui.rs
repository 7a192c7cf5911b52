//! Pen section: device, size, and the curve from pressure to force.

use egui::{ComboBox, DragValue, Slider, Ui};
use egui_plot::{Line, Plot, PlotPoints, Points};
use shagreen_device::hid::choice::AUTOMATIC_ID;
use shagreen_device::pen_backend::Provides;
use shagreen_device::stylus::StylusInfo;
use shagreen_studio::pen_backends::{backend_name, provided};

use super::{DevicesSheet, heading, note, row, warning};
use crate::command::Command;
use crate::look::list::ShowList as _;
use crate::look::plot::{after_start, fixed};
use crate::look::theme::tokens;
use crate::session::Session;
use crate::state::rig::SIDES_MM;
use crate::strings::devices as strings;

/// Height of the graph, in points.
const HEIGHT: f32 = 110.0;
/// Initial size of a pen that states none, in mm (a small tablet).
const FIRST_SIZE_MM: [f64; 2] = [150.0, 95.0];

impl DevicesSheet {
    pub(super) fn pen_ui(&mut self, ui: &mut Ui, session: &Session) -> Option<Command> {
        let mut command = None;
        heading(ui, strings::PEN);
        row(ui, strings::DEVICE, |ui| command = self.pen_choice_ui(ui, session));
        if let Some(message) = session.pen_message() {
            warning(ui, message);
        }
        let facts = session.pen_facts();
        if let Some(facts) = facts {
            let (backend, provided) = (backend_name(facts.backend), provided(&facts.provides));
            note(ui, &strings::pen_read(&facts.name, backend, &provided));
            if facts.size_m.is_none() {
                warning(ui, strings::NO_SIZE);
            } else if facts.is_size_doubtful {
                warning(ui, strings::DOUBTFUL_SIZE);
            }
        } else {
            note(ui, &strings::window_pointer(&provided(&Provides::WINDOW)));
        }
        if self.rig.pen.is_some()
            && (self.rig.pen_size_mm.is_some()
                || facts.is_some_and(|f| f.size_m.is_none() || f.is_size_doubtful))
        {
            let mut size = self.rig.pen_size_mm.unwrap_or(FIRST_SIZE_MM);
            for (i, name) in [strings::WIDTH, strings::HEIGHT].into_iter().enumerate() {
                row(ui, name, |ui| {
                    let value = DragValue::new(&mut size[i]).range(SIDES_MM).speed(0.5).suffix(" mm");
                    let value = value.min_decimals(1).max_decimals(3);
                    if ui.add(value).accessible_name(name).changed() {
                        self.rig.pen_size_mm = Some(size);
                    }
                });
            }
        }
        if facts.is_none_or(|f| f.full_n.is_none()) {
            self.curve_ui(ui, session);
        }
        command
    }

    fn pen_choice_ui(&mut self, ui: &mut Ui, session: &Session) -> Option<Command> {
        let pens = session.pens();
        let label = |pen: &StylusInfo| strings::pen_choice(&pen.name, backend_name(pen.backend));
        let name_of = |id: &str| match pens.iter().find(|pen| pen.id == id) {
            Some(pen) => label(pen),
            None if id == AUTOMATIC_ID => strings::AUTOMATIC.to_owned(),
            None => id.to_owned(),
        };
        let chosen = self.rig.pen.as_deref().map_or(strings::MOUSE_ONLY.to_owned(), name_of);
        let combo = ComboBox::from_id_salt("pen").width(260.0).truncate().selected_text(chosen);
        let shown = combo.show_list(ui, |ui| {
            let automatic = Some(AUTOMATIC_ID.to_owned());
            ui.selectable_value(&mut self.rig.pen, automatic, strings::AUTOMATIC);
            ui.selectable_value(&mut self.rig.pen, None, strings::MOUSE_ONLY);
            for pen in pens {
                let row = ui.selectable_value(&mut self.rig.pen, Some(pen.id.clone()), label(pen));
                let told = format!("{}\n{}", pen.id, provided(&pen.provides));
                let advice = pen.advice.iter().map(String::as_str);
                row.on_hover_text(
                    std::iter::once(told.as_str()).chain(advice).collect::<Vec<_>>().join("\n"),
                );
            }
        });
        // Listed again, because a device may have been connected since.
        let command = shown.response.clicked().then_some(Command::ListPens);
        shown.response.accessible_name(strings::PEN).on_hover_text(strings::PEN_HELP);
        command
    }

    fn curve_ui(&mut self, ui: &mut Ui, session: &Session) {
        let t = tokens(ui.ctx());
        heading(ui, strings::CURVE);
        let map = &mut self.rig.pressure_map;
        row(ui, strings::ACTIVATION, |ui| {
            let slider = Slider::new(&mut map.activation_n, 0.0..=0.5).suffix(" N").fixed_decimals(3);
            ui.add(slider).accessible_name(strings::ACTIVATION);
        });
        row(ui, strings::FULL, |ui| {
            let slider = Slider::new(&mut map.full_n, 0.6..=10.0).suffix(" N").fixed_decimals(2);
            ui.add(slider).accessible_name(strings::FULL);
        });
        row(ui, strings::BEND, |ui| {
            let slider = Slider::new(&mut map.bend, -4.0..=6.0).fixed_decimals(2);
            ui.add(slider).accessible_name(strings::BEND).on_hover_text(strings::CURVE_HELP);
        });
        let map = *map;
        let curve: PlotPoints<'_> =
            (0..=50).map(|i| f64::from(i) / 50.0).map(|p| [100.0 * p, map.force_n(p, true)]).collect();
        fixed(Plot::new("pressure"), t.line)
            .height(HEIGHT)
            .x_axis_formatter(after_start(0.0, |percent| format!("{percent:.0} %")))
            .x_grid_spacer(egui_plot::uniform_grid_spacer(|_| [50.0, 25.0, 25.0]))
            .y_axis_formatter(|mark, _| format!("{:.0} N", mark.value))
            .show(ui, |plot| {
                plot.set_plot_bounds_x(0.0..=100.0);
                plot.set_plot_bounds_y(0.0..=map.full_n.max(0.1));
                plot.line(Line::new("", curve).color(t.accent).width(2.0));
                if let Some(pressure) = session.pen_pressure() {
                    let at = vec![[100.0 * pressure, map.force_n(pressure, true)]];
                    plot.points(Points::new("", at).color(t.warning).radius(4.0));
                }
            });
        note(ui, strings::CURVE_HELP);
    }
}
