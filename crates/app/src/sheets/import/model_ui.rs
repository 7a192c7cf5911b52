//! Imported textures that already are models: facts, measured contacts and license.

use egui::{Align, ComboBox, Label, Layout, RichText, ScrollArea, Ui, vec2};
use shagreen_core::texture::plane::Plane;
use shagreen_core::units::{Contact, Hertz};
use shagreen_formats::library::{Provenance, TextureEntry};

use crate::look::list::ShowList as _;
use crate::look::plot::title;
use crate::look::spectrum_plot::spectrum_plot;
use crate::look::theme::{GAP, GROUP_GAP, tokens};
use crate::sheets::import::fit_ui::{figure_rows_ui, list_ui};
use crate::sheets::import::import_context::ImportContext;
use crate::sheets::import::plane_plot::{Dot, plane_plot};
use crate::sheets::import::shown_model::ShownModel;
use crate::strings::import as strings;
use crate::strings::textures::FRICTION_HELP;

/// Number of frequencies of a spectrum.
const N_FREQUENCIES: usize = 120;

/// Draws the textures of a file; `shown` is the selection.
pub(super) fn model_ui(
    ui: &mut Ui,
    entries: &[TextureEntry],
    warnings: &[String],
    shown: &mut ShownModel,
    around: ImportContext<'_>,
) {
    let Some(entry) = entries.get(shown.texture).or(entries.first()) else {
        ui.label(crate::strings::NO_TEXTURES);
        return;
    };
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        if entries.len() > 1 {
            let combo = ComboBox::from_id_salt("texture").width(260.0).selected_text(&entry.name);
            let combo = combo.show_list(ui, |ui| {
                for (index, other) in entries.iter().enumerate() {
                    ui.selectable_value(&mut shown.texture, index, &other.name);
                }
            });
            combo.response.accessible_name(strings::TEXTURE_OF_FILE);
        } else {
            ui.heading(&entry.name);
        }
        let t = tokens(ui.ctx());
        if entry.provenance == Provenance::Restricted {
            ui.add(Label::new(RichText::new(strings::RESTRICTED).color(t.warning)).wrap());
        }
        ui.add_space(GAP);
        plots_ui(ui, entry, shown);
        ui.add_space(GAP);
        about_ui(ui, entry, around);
        list_ui(ui, strings::WARNINGS, warnings, t.warning);
    });
}

fn plots_ui(ui: &mut Ui, entry: &TextureEntry, shown: &mut ShownModel) {
    let t = tokens(ui.ctx());
    let contacts: Vec<Contact> = entry.model.contacts().collect();
    let dots: Vec<Dot> = contacts
        .iter()
        .map(|c| Dot { speed_mm_per_s: c.speed.mm_per_s(), force_n: c.force.0, color: t.accent })
        .collect();
    let middle = contacts.iter().position(|c| c.speed.0 > 0.0 && c.force.0 > 0.0).unwrap_or(0);
    let mut node = shown.nodes.get(&shown.texture).copied().unwrap_or(middle);
    let size = vec2(0.5 * (ui.available_width() - GROUP_GAP), 280.0);
    let inner = size.y - 24.0;
    ui.horizontal_top(|ui| {
        ui.allocate_ui_with_layout(size, Layout::top_down(Align::Min), |ui| {
            ui.set_width(size.x);
            title(ui, strings::NODES, strings::PLANE_UNIT);
            if let Some(clicked) = plane_plot(ui, strings::NODES, &dots, node, inner) {
                node = clicked;
            }
        });
        ui.add_space(GROUP_GAP - GAP);
        ui.allocate_ui_with_layout(size, Layout::top_down(Align::Min), |ui| {
            ui.set_width(size.x);
            let Some(contact) = contacts.get(node) else { return };
            title(ui, strings::SPECTRUM, &strings::spectrum_at(*contact));
            let high = 0.4995 * entry.model.rate().0;
            let frequency =
                |i: usize| Hertz(10.0 * (high / 10.0).powf(i as f64 / (N_FREQUENCIES - 1) as f64));
            let frequencies: Vec<Hertz> = (0..N_FREQUENCIES).map(frequency).collect();
            let at = (shown.texture, node);
            let (_, psd) = match shown.spectrum.take().filter(|(drawn_at, _)| *drawn_at == at) {
                Some(drawn) => shown.spectrum.insert(drawn),
                None => shown.spectrum.insert((at, Plane::new(&entry.model).at(*contact).psd(&frequencies))),
            };
            spectrum_plot(ui, &frequencies, None, (strings::MODEL_LINE, psd), inner);
        });
    });
    shown.nodes.insert(shown.texture, node);
}

fn about_ui(ui: &mut Ui, entry: &TextureEntry, around: ImportContext<'_>) {
    let t = tokens(ui.ctx());
    let model = &entry.model;
    let or_unknown = |text: &str| if text.is_empty() { strings::UNKNOWN.to_owned() } else { text.to_owned() };
    let friction = model.friction().map_or(strings::UNKNOWN.to_owned(), |mu| format!("{mu:.2}"));
    let rows = [
        (strings::N_NODES, model.n_nodes().to_string(), ""),
        (strings::MODEL_RATE, strings::rate(model.rate().0), ""),
        (strings::MODEL_ORDER, strings::orders(model.order(), model.ma_order()), strings::ORDER_HELP),
        (strings::FRICTION, friction, FRICTION_HELP),
        (strings::ORIGIN, or_unknown(&entry.origin), ""),
        (strings::TERMS, or_unknown(&entry.license), ""),
    ];
    figure_rows_ui(ui, &rows);
    let (rate_hz, space_rate_hz) = (model.rate().0, around.space_rate_hz);
    let note = if rate_hz > space_rate_hz && entry.place.is_some() {
        strings::other_rate(rate_hz, space_rate_hz)
    } else if entry.place.is_some() {
        strings::KEEPS_PLACE.to_owned()
    } else {
        strings::JOINS_UNPLACED.to_owned()
    };
    ui.add_space(GAP);
    ui.add(Label::new(RichText::new(note).small().color(t.text_weak)).wrap().selectable(false));
}
