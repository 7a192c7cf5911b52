//! A plan from the keys of its file.

mod designs;

use shagreen_core::people::study::order::Order;
use shagreen_core::people::study::plan::{
    Design, MaskingNoise, NoiseColor, Part, Plan, Source, Stimulus, Timing, USUAL_TOUCH_MM, Variant,
};

use super::key_problem::KeyProblem;
use super::keys::stray_keys;
use super::wire::{ColorV1, PartV1, StimulusV1, Tables, VariantV1};

/// A plan, and problems of its keys.
pub(super) struct Draft {
    pub(super) plan: Plan,
    pub(super) problems: Vec<KeyProblem>,
    /// Adjective pairs that are neither known nor declared. They are problems of a plan that is to be run, but plans in logs of
    /// earlier versions have such pairs.
    pub(super) undeclared: Vec<KeyProblem>,
}

/// Returns what a file says, with defaults for what is missing. `problems` are those of its tables.
pub(super) fn draft(tables: Tables, problems: Vec<KeyProblem>) -> Draft {
    let Tables { plan: wire, stimuli, parts } = tables;
    let mut reader = Reader { at: String::new(), problems, undeclared: Vec::new() };
    let name = reader.stated("name", wire.name);
    let seed = reader.stated("seed", wire.seed);
    let part_order = reader.order("part_order", wire.part_order.as_deref(), Order::Listed);
    let ids: Vec<String> = stimuli.iter().filter_map(|stimulus| stimulus.id.clone()).collect();
    let stimuli: Vec<Stimulus> = stimuli
        .into_iter()
        .enumerate()
        .map(|(index, stimulus)| {
            reader.at = format!("stimulus[{}].", index + 1);
            reader.stimulus(stimulus)
        })
        .collect();
    let parts: Vec<Part> = parts
        .into_iter()
        .enumerate()
        .map(|(index, part)| {
            reader.at = format!("part[{}].", index + 1);
            reader.part(part, &ids)
        })
        .collect();
    let masking_noise = wire.masking_noise.map(|noise| MaskingNoise {
        color: match noise.color {
            ColorV1::White => NoiseColor::White,
            ColorV1::Pink => NoiseColor::Pink,
        },
        level_db: noise.level_db,
    });
    let plan = Plan {
        name,
        description: wire.description,
        consent: wire.consent,
        seed,
        part_order,
        masking_noise,
        stimuli,
        parts,
    };
    Draft { plan, problems: reader.problems, undeclared: reader.undeclared }
}

struct Reader {
    /// Key of the table that is being read, with its final dot.
    at: String,
    problems: Vec<KeyProblem>,
    /// Adjective pairs that are neither known nor declared.
    undeclared: Vec<KeyProblem>,
}

impl Reader {
    fn add(&mut self, key: &str, text: impl Into<String>) {
        self.problems.push(KeyProblem::new(format!("{}{key}", self.at), text));
    }

    /// Whether something is wrong with a key already, so that its value is missing.
    fn has_problem(&self, key: &str) -> bool {
        let key = format!("{}{key}", self.at);
        self.problems.iter().any(|problem| problem.key == key)
    }

    fn add_missing(&mut self, key: &str, text: &str) {
        if !self.has_problem(key) {
            self.add(key, text);
        }
    }

    /// The value of a key that every table of this kind has.
    fn stated<T: Default>(&mut self, key: &str, value: Option<T>) -> T {
        value.unwrap_or_else(|| {
            self.add_missing(key, "the key is missing; add it");
            T::default()
        })
    }

    /// The value of a key that the design needs.
    fn need<T: Default>(&mut self, key: &str, value: Option<T>) -> T {
        value.unwrap_or_else(|| {
            self.add_missing(key, "the key is missing, but this design needs it; add it");
            T::default()
        })
    }

    /// Notes that a part has no design, so that its other problems mean nothing.
    fn hide_part(&mut self, text: &str) {
        self.add_missing("design", text);
        let key = format!("{}design", self.at);
        for problem in self.problems.iter_mut().filter(|problem| problem.key == key) {
            problem.hide_table();
        }
    }

    fn order(&mut self, key: &str, id: Option<&str>, usual: Order) -> Order {
        let Some(id) = id else { return usual };
        Order::from_id(id).unwrap_or_else(|| {
            let known = Order::ALL.map(Order::id).join(", ");
            self.add(key, format!("\"{id}\" is not an order; choose one of {known}"));
            usual
        })
    }

    fn stimulus(&mut self, wire: StimulusV1) -> Stimulus {
        let StimulusV1 { id, texture, profile, variant, kbps, window_mm, level_db } = wire;
        let id = self.stated("id", id);
        let source = match (texture, profile) {
            (Some(texture), None) => Source::Texture(texture),
            (None, Some(profile)) => Source::Profile(profile),
            // Its name is not known, and no texture is missing.
            (None, None) if self.has_problem("profile") => Source::Profile(id.clone()),
            (texture, _) => {
                self.add_missing("texture", "state either `texture` or `profile`");
                Source::Texture(texture.unwrap_or_else(|| id.clone()))
            }
        };
        let is_misspelled = self.has_problem("variant");
        let kind = variant.unwrap_or(VariantV1::Original);
        for (key, is_stated, of) in [
            ("kbps", kbps.is_some(), VariantV1::Coded),
            ("window_mm", window_mm.is_some(), VariantV1::Reconstructed),
        ] {
            if is_stated && kind != of && !is_misspelled {
                self.add(key, "the variant does not have this key; remove it, or change `variant`");
            }
        }
        let variant = match kind {
            VariantV1::Original => Variant::Original,
            VariantV1::Authored => Variant::Authored,
            VariantV1::Coded => Variant::Coded { kbps: self.need("kbps", kbps) },
            VariantV1::Reconstructed => {
                Variant::Reconstructed { window_mm: self.need("window_mm", window_mm) }
            }
        };
        Stimulus { id, source, variant, level_db }
    }

    fn part(&mut self, wire: PartV1, all_stimuli: &[String]) -> Part {
        let known = Design::IDS.join(", ");
        match (&wire.design, stray_keys(&wire)) {
            (Some(design), Some(stray)) => {
                for key in stray {
                    let text = format!("the design {design} has no such key; remove it, or change `design`");
                    self.add(key, text);
                }
            }
            (Some(design), None) => {
                self.hide_part(&format!("\"{design}\" is not a design; choose one of {known}"));
            }
            (None, _) => self.hide_part(&format!("the key is missing; choose one of {known}")),
        }
        let id = self.stated("id", wire.id.clone());
        let design = self.design(&wire, all_stimuli);
        let order = self.order("order", wire.order.as_deref(), Order::default());
        let timing = Timing {
            lead_secs: wire.lead_s.unwrap_or(0.0),
            stimulus_secs: wire.stimulus_s,
            gap_secs: wire.gap_s.unwrap_or(0.0),
            pause_secs: wire.pause_s.unwrap_or(0.0),
        };
        let touch_mm = match (wire.require_touch, wire.touch_mm) {
            (Some(false), Some(_)) => {
                self.add("touch_mm", "no touch is required, so the key has no effect; remove it");
                None
            }
            (Some(false), None) => None,
            (_, stated) => Some(stated.unwrap_or(USUAL_TOUCH_MM)),
        };
        Part {
            id,
            title: wire.title,
            instructions: wire.instructions,
            design,
            order,
            n_repeats: wire.repeats.unwrap_or(1),
            n_practice: wire.practice.unwrap_or(0),
            break_every: wire.break_every,
            max_plays: wire.max_plays,
            touch_mm,
            timing,
        }
    }
}
