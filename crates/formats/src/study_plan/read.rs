//! A plan from the keys of its file.

mod designs;

use shagreen_core::people::study::order::Order;
use shagreen_core::people::study::plan::{
    Design, MAX_PARTS, MAX_STIMULI, MaskingNoise, NoiseColor, Part, Plan, Source, Stimulus, Timing, Variant,
};

use super::keys::stray_keys;
use super::wire::{ColorV1, PartV1, PlanV1, StimulusV1, VariantV1};

/// A plan, and problems of its keys.
pub(super) struct Draft {
    pub(super) plan: Plan,
    pub(super) problems: Vec<KeyProblem>,
}

/// A problem of a key.
pub(super) struct KeyProblem {
    pub(super) key: String,
    pub(super) text: String,
    /// Whether the whole table is not what was meant, so that its other problems mean nothing.
    hides_table: bool,
}

impl KeyProblem {
    /// Whether a problem with this key follows from this one.
    pub(super) fn hides(&self, key: &str) -> bool {
        let table = self.key.rsplit_once('.').map_or("", |(table, _)| table);
        self.hides_table && key.strip_prefix(table).is_some_and(|rest| rest.starts_with('.'))
    }
}

/// Returns what a file says, with defaults for what is missing.
pub(super) fn draft(mut wire: PlanV1) -> Draft {
    // One too many is enough to be refused.
    wire.stimulus.truncate(MAX_STIMULI + 1);
    wire.part.truncate(MAX_PARTS + 1);
    let mut reader = Reader { at: String::new(), problems: Vec::new() };
    let part_order = reader.order("part_order", wire.part_order.as_deref(), Order::Listed);
    let ids: Vec<String> = wire.stimulus.iter().map(|stimulus| stimulus.id.clone()).collect();
    let mut stimuli = Vec::with_capacity(wire.stimulus.len());
    for (index, stimulus) in wire.stimulus.into_iter().enumerate() {
        reader.at = format!("stimulus[{}].", index + 1);
        stimuli.push(reader.stimulus(stimulus));
    }
    let mut parts = Vec::with_capacity(wire.part.len());
    for (index, part) in wire.part.into_iter().enumerate() {
        reader.at = format!("part[{}].", index + 1);
        parts.push(reader.part(part, &ids));
    }
    let masking_noise = wire.masking_noise.map(|noise| MaskingNoise {
        color: match noise.color {
            ColorV1::White => NoiseColor::White,
            ColorV1::Pink => NoiseColor::Pink,
        },
        level_db: noise.level_db,
    });
    let plan = Plan {
        name: wire.name,
        description: wire.description,
        consent: wire.consent,
        seed: wire.seed,
        part_order,
        masking_noise,
        stimuli,
        parts,
    };
    Draft { plan, problems: reader.problems }
}

struct Reader {
    /// Key of the table that is being read, with its final dot.
    at: String,
    problems: Vec<KeyProblem>,
}

impl Reader {
    fn add(&mut self, key: &str, text: impl Into<String>) {
        self.push(key, text.into(), false);
    }

    fn push(&mut self, key: &str, text: String, hides_table: bool) {
        self.problems.push(KeyProblem { key: format!("{}{key}", self.at), text, hides_table });
    }

    /// The value of a key that the design needs.
    fn need<T: Default>(&mut self, key: &str, value: Option<T>) -> T {
        value.unwrap_or_else(|| {
            self.add(key, "the key is missing, but this design needs it; add it");
            T::default()
        })
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
        let source = match (texture, profile) {
            (Some(texture), None) => Source::Texture(texture),
            (None, Some(profile)) => Source::Profile(profile),
            (texture, _) => {
                self.add("texture", "state either `texture` or `profile`");
                Source::Texture(texture.unwrap_or_else(|| id.clone()))
            }
        };
        let kind = variant.unwrap_or(VariantV1::Original);
        for (key, is_stated, of) in [
            ("kbps", kbps.is_some(), VariantV1::Coded),
            ("window_mm", window_mm.is_some(), VariantV1::Reconstructed),
        ] {
            if is_stated && kind != of {
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
        if let Some(stray) = stray_keys(&wire) {
            for key in stray {
                let text =
                    format!("the design {} has no such key; remove it, or change `design`", wire.design);
                self.add(key, text);
            }
        } else {
            let text =
                format!("\"{}\" is not a design; choose one of {}", wire.design, Design::IDS.join(", "));
            self.push("design", text, true);
        }
        let design = self.design(&wire, all_stimuli);
        let order = self.order("order", wire.order.as_deref(), Order::default());
        let timing = Timing {
            lead_secs: wire.lead_s.unwrap_or(0.0),
            stimulus_secs: wire.stimulus_s,
            gap_secs: wire.gap_s.unwrap_or(0.0),
            pause_secs: wire.pause_s.unwrap_or(0.0),
        };
        Part {
            id: wire.id,
            title: wire.title,
            instructions: wire.instructions,
            design,
            order,
            n_repeats: wire.repeats.unwrap_or(1),
            n_practice: wire.practice.unwrap_or(0),
            break_every: wire.break_every,
            max_plays: wire.max_plays,
            timing,
        }
    }
}
