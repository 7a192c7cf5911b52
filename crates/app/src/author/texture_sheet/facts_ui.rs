//! Facts about a texture, as text and numbers.

use egui::{Color32, Grid, Label, RichText, Ui};
use shagreen_core::people::ratings::poles;
use shagreen_core::space::LabelSource;
use shagreen_core::texture::TextureModel;
use shagreen_core::units::Newtons;
use shagreen_formats::library::{Provenance, TextureEntry};

use crate::look::theme::{GAP, tokens};
use crate::panel::Panel;
use crate::strings::{self, import, textures as words};
use shagreen_studio::library_names;

struct Fact {
    name: &'static str,
    value: String,
    color: Option<Color32>,
    help: &'static str,
}

fn fact(name: &'static str, value: String, help: &'static str) -> Fact {
    Fact { name, value, color: None, help }
}

/// Draws identifier, library, position, tags, license and origin of a texture.
pub(super) fn about_ui(ui: &mut Ui, panel: &Panel<'_>, texture: usize) {
    let t = tokens(ui.ctx());
    let session = panel.session;
    let entry = &session.textures()[texture];
    let library = session.library();
    let or_unknown = |text: &str| if text.is_empty() { import::UNKNOWN.to_owned() } else { text.to_owned() };
    let part_of = match panel.joined_index(texture) {
        Some(_) => words::THE_PROJECT.to_owned(),
        None => library_names::name(session.base()).into_owned(),
    };
    let mut facts = vec![
        fact(words::IDENTIFIER, entry.id.clone(), words::IDENTIFIER_HELP),
        fact(words::PART_OF, part_of, ""),
    ];
    match session.position(texture) {
        Some(at) => {
            let source = session.place_source(texture);
            let is_simulated = source == Some(LabelSource::SimulatedRaters);
            let from = source.map_or(strings::NO_SOURCE.to_owned(), words::place_from);
            facts.push(fact(words::PLACE, strings::place_in_words(at, session.poles()), ""));
            facts.push(Fact {
                color: is_simulated.then_some(t.warning),
                ..fact(words::PLACE_FROM, from, strings::SOURCE_HELP)
            });
        }
        None => {
            facts.push(fact(words::PLACE, strings::NOT_PLACED_YET.to_owned(), strings::NOT_PLACED_HELP));
        }
    }
    let tags = if entry.tags.is_empty() { words::NONE.to_owned() } else { entry.tags.join(", ") };
    facts.push(fact(words::TAGS_LABEL, tags, ""));
    facts.push(fact(import::TERMS, or_unknown(library.license_of(entry)), words::TERMS_HELP));
    let passing_on = match entry.provenance {
        Provenance::Free => {
            fact(words::PASSING_ON, words::passed_on(library.license_of(entry)).to_owned(), "")
        }
        Provenance::Restricted => {
            Fact { color: Some(t.warning), ..fact(words::PASSING_ON, import::RESTRICTED.to_owned(), "") }
        }
    };
    facts.push(passing_on);
    let origin = if entry.origin.is_empty() { &library.origin } else { &entry.origin };
    facts.push(fact(import::ORIGIN, or_unknown(origin), ""));
    facts_ui(ui, "about", &facts);
}

/// Draws the parameters of the texture model.
pub(super) fn model_ui(ui: &mut Ui, panel: &Panel<'_>, entry: &TextureEntry) {
    let model = &entry.model;
    heading_ui(ui, words::MODEL, "");
    let friction = model.friction().map_or(words::NO_FRICTION.to_owned(), |coefficient| {
        words::friction(coefficient, stick_slip(model), panel.session.renders_friction())
    });
    let landing = model
        .tap()
        .map_or(words::NO_LANDING.to_owned(), |tap| words::landing(tap.frequency.0, tap.decay_per_sec));
    let [speeds, forces] = ranges(model);
    let mut facts = vec![
        fact(import::MODEL_RATE, import::rate(model.rate().0), words::RATE_HELP),
        fact(words::NODES, model.n_nodes().to_string(), words::NODES_HELP),
        fact(words::SPEEDS, speeds, words::RANGE_HELP),
        fact(words::FORCES, forces, words::RANGE_HELP),
        fact(import::FRICTION, friction, words::FRICTION_HELP),
        fact(import::TAP, landing, import::TAP_HELP),
    ];
    if let Some(path) = &entry.path {
        let path = words::path(path.keys().len(), path.length(), path.along());
        facts.push(fact(words::PATH, path, words::PATH_HELP));
    }
    if let Some(physical) = entry.physical {
        let level = words::level(10.0_f64.powf(physical.roughness_log10_mps2));
        let stiffness = words::stiffness(10.0_f64.powf(physical.hardness_log10_n_per_m));
        facts.push(fact(words::LEVEL_MEASURED, level, words::PHYSICAL_HELP));
        facts.push(fact(words::STIFFNESS, stiffness, words::PHYSICAL_HELP));
    }
    facts_ui(ui, "model", &facts);
}

/// Highest speed in mm/s at which a tip sticks and slips, and the force in N of that speed: 1 N, or the highest force of
/// the model if it slides steadily at 1 N. `None` if it slides at both.
fn stick_slip(model: &TextureModel) -> Option<(f64, f64)> {
    let (coefficient, stick_slip) = (model.friction()?, model.stick_slip()?);
    [Newtons(1.0), model.force_max()].into_iter().find_map(|force| {
        let critical = stick_slip.critical_speed(coefficient, force)?;
        Some((critical.mm_per_s(), force.0))
    })
}

/// Ranges of speed and force that the model covers, as text.
fn ranges(model: &TextureModel) -> [String; 2] {
    let lowest = |values: &mut dyn Iterator<Item = f64>, highest: f64| {
        values.filter(|value| *value > 0.0).fold(highest, f64::min)
    };
    let (fast, hard) = (model.speed_max().mm_per_s(), model.force_max().0);
    let slow = lowest(&mut model.contacts().map(|c| c.speed.mm_per_s()), fast);
    let light = lowest(&mut model.contacts().map(|c| c.force.0), hard);
    [
        words::range(&format!("{slow:.0}"), &format!("{fast:.0}"), import::SPEED_UNIT),
        words::range(&format!("{light:.2}"), &format!("{hard:.2}"), import::FORCE_UNIT),
    ]
}

/// Draws the attribute values; nothing if there are none.
pub(super) fn attributes_ui(ui: &mut Ui, entry: &TextureEntry) {
    let Some(attributes) = entry.attributes.as_ref().filter(|attributes| !attributes.values.is_empty())
    else {
        return;
    };
    let t = tokens(ui.ctx());
    heading_ui(ui, words::ATTRIBUTES, words::ATTRIBUTES_HELP);
    let from = RichText::new(words::place_from(attributes.source)).small();
    let is_simulated = attributes.source == LabelSource::SimulatedRaters;
    let from = from.color(if is_simulated { t.warning } else { t.text_weak });
    ui.add(Label::new(from).selectable(false));
    table("attributes").show(ui, |ui| {
        for attribute in &attributes.values {
            let name = RichText::new(strings::axis(&poles(&attribute.name))).color(t.text_weak);
            ui.add(Label::new(name).selectable(false));
            ui.add(Label::new(format!("{:.0}", attribute.value)));
            ui.end_row();
        }
    });
}

fn heading_ui(ui: &mut Ui, text: &str, help: &str) {
    ui.add_space(GAP);
    let heading = ui.add(Label::new(RichText::new(text).strong()).selectable(false));
    if !help.is_empty() {
        heading.on_hover_text(help);
    }
}

fn table(name: &str) -> Grid {
    Grid::new(name).num_columns(2).min_row_height(0.0).spacing([2.0 * GAP, 2.0])
}

/// Draws names and values in two columns with tooltips; `name` is the id of the table.
fn facts_ui(ui: &mut Ui, name: &str, facts: &[Fact]) {
    let t = tokens(ui.ctx());
    table(name).show(ui, |ui| {
        for fact in facts {
            let name = ui.add(Label::new(RichText::new(fact.name).color(t.text_weak)).selectable(false));
            let value = RichText::new(&fact.value).color(fact.color.unwrap_or(t.text));
            let value = ui.add(Label::new(value).wrap());
            if !fact.help.is_empty() {
                name.on_hover_text(fact.help);
                value.on_hover_text(fact.help);
            }
            ui.end_row();
        }
    });
}
