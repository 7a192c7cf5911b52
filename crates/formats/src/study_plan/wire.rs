//! Keys of a plan file.

use serde::Deserialize;
use shagreen_core::people::study::plan::{MAX_PARTS, MAX_STIMULI};
use toml::{Table, Value};

use super::key_problem::KeyProblem;
use super::tables::read_table;
use crate::text_limits::{MAX_ID, MAX_NAME, MAX_NOTES, TooLong, check};

#[derive(Deserialize)]
pub(super) struct HeaderV1 {
    pub(super) format: String,
    pub(super) version: String,
}

/// Keys of the whole study. A missing key is no error here, so that all problems are found ([`super::tables`]).
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PlanV1 {
    #[serde(rename = "format")]
    _format: Option<String>,
    #[serde(rename = "version")]
    _version: Option<String>,
    pub(super) name: Option<String>,
    #[serde(default)]
    pub(super) description: String,
    #[serde(default)]
    pub(super) consent: String,
    pub(super) seed: Option<u64>,
    pub(super) part_order: Option<String>,
    pub(super) masking_noise: Option<MaskingNoiseV1>,
    #[serde(default)]
    stimulus: Vec<Table>,
    #[serde(default)]
    part: Vec<Table>,
}

/// All tables of a plan file.
pub(super) struct Tables {
    pub(super) plan: PlanV1,
    pub(super) stimuli: Vec<StimulusV1>,
    pub(super) parts: Vec<PartV1>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MaskingNoiseV1 {
    pub(super) color: ColorV1,
    pub(super) level_db: f64,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum ColorV1 {
    White,
    Pink,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct StimulusV1 {
    pub(super) id: Option<String>,
    pub(super) texture: Option<String>,
    pub(super) profile: Option<String>,
    pub(super) variant: Option<VariantV1>,
    pub(super) kbps: Option<f64>,
    pub(super) window_mm: Option<f64>,
    #[serde(default)]
    pub(super) level_db: f64,
}

#[derive(Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum VariantV1 {
    Original,
    Authored,
    Coded,
    Reconstructed,
}

/// All keys of all designs; [`super::keys`] says which belong to which.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PartV1 {
    pub(super) id: Option<String>,
    #[serde(default)]
    pub(super) title: String,
    #[serde(default)]
    pub(super) instructions: String,
    pub(super) design: Option<String>,
    pub(super) order: Option<String>,
    pub(super) repeats: Option<usize>,
    pub(super) practice: Option<usize>,
    pub(super) break_every: Option<usize>,
    pub(super) max_plays: Option<u32>,
    pub(super) require_touch: Option<bool>,
    pub(super) touch_mm: Option<f64>,
    pub(super) lead_s: Option<f64>,
    pub(super) stimulus_s: Option<f64>,
    pub(super) gap_s: Option<f64>,
    pub(super) pause_s: Option<f64>,
    pub(super) stimuli: Option<Vec<String>>,
    pub(super) groups: Option<Vec<usize>>,
    pub(super) questionnaire: Option<String>,
    pub(super) adjectives: Option<Vec<String>>,
    pub(super) scales: Option<Vec<String>>,
    pub(super) own_scales: Option<Vec<String>>,
    pub(super) slider_mm: Option<f64>,
    pub(super) pairs: Option<Vec<[String; 2]>>,
    pub(super) first: Option<Vec<String>>,
    pub(super) second: Option<Vec<String>>,
    pub(super) reference: Option<[String; 2]>,
    pub(super) segments: Option<usize>,
    pub(super) varied: Option<VariedV1>,
    pub(super) stimulus: Option<String>,
    pub(super) start: Option<f64>,
    pub(super) lowest: Option<f64>,
    pub(super) highest: Option<f64>,
    pub(super) down: Option<u32>,
    pub(super) factors: Option<Vec<f64>>,
    pub(super) later_factor: Option<f64>,
    pub(super) reversals: Option<usize>,
    pub(super) averaged: Option<usize>,
    pub(super) max_trials: Option<usize>,
    pub(super) feedback_reversals: Option<usize>,
    pub(super) points: Option<u32>,
    pub(super) low: Option<String>,
    pub(super) high: Option<String>,
    pub(super) conditions: Option<Vec<ConditionV1>>,
    pub(super) statements: Option<Vec<StatementV1>>,
    pub(super) prompts: Option<Vec<String>>,
    pub(super) own_prompts: Option<usize>,
    pub(super) pages: Option<Vec<PageV1>>,
    pub(super) low_anchor: Option<String>,
    pub(super) high_anchor: Option<String>,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum VariedV1 {
    Gap,
    Level,
}

#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ConditionV1 {
    pub(super) id: String,
    pub(super) shown: ShownV1,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum ShownV1 {
    Nothing,
    Picture,
    PictureAndSliders,
}

#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct StatementV1 {
    pub(super) id: String,
    pub(super) text: String,
}

#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PageV1 {
    pub(super) reference: String,
    pub(super) tested: Vec<String>,
    #[serde(default)]
    pub(super) anchors: Vec<String>,
}

impl Tables {
    /// Reads the tables of a plan file, and adds what is wrong with their keys to `problems`.
    pub(super) fn of(mut file: Table, problems: &mut Vec<KeyProblem>) -> Self {
        for key in ["stimulus", "part"] {
            if file.get(key).is_some_and(Value::is_table) {
                file.remove(key);
                let text = format!("one pair of brackets is missing; write [[{key}]] above each {key}");
                problems.push(KeyProblem::new(key, text));
            }
        }
        let mut plan: PlanV1 = read_table(file, "", problems);
        // One too many is enough to be refused.
        let stimuli = std::mem::take(&mut plan.stimulus).into_iter().take(MAX_STIMULI + 1).enumerate();
        let stimuli = stimuli
            .map(|(index, table)| read_table(table, &format!("stimulus[{}].", index + 1), problems))
            .collect();
        let parts = std::mem::take(&mut plan.part).into_iter().take(MAX_PARTS + 1).enumerate();
        let parts = parts
            .map(|(index, table)| read_table(table, &format!("part[{}].", index + 1), problems))
            .collect();
        Self { plan, stimuli, parts }
    }

    /// Checks the lengths of the texts that are drawn.
    pub(super) fn check_lengths(&self) -> Result<(), TooLong> {
        let optional = |what: &'static str, text: Option<&String>, most: usize| {
            text.map_or(Ok(()), |text| check(what, text, most))
        };
        optional("the name of the study", self.plan.name.as_ref(), MAX_NAME)?;
        check("the description", &self.plan.description, MAX_NOTES)?;
        check("the consent text", &self.plan.consent, MAX_NOTES)?;
        for stimulus in &self.stimuli {
            optional("the id of a stimulus", stimulus.id.as_ref(), MAX_ID)?;
            for name in stimulus.texture.iter().chain(&stimulus.profile) {
                check("the name of a texture", name, MAX_ID)?;
            }
        }
        for part in &self.parts {
            optional("the id of a part", part.id.as_ref(), MAX_ID)?;
            check("the title of a part", &part.title, MAX_NAME)?;
            check("the instructions of a part", &part.instructions, MAX_NOTES)?;
            let lists = [&part.adjectives, &part.scales, &part.own_scales, &part.prompts];
            let words = lists.into_iter().flatten().flatten();
            let ends = part.low.iter().chain(&part.high);
            let conditions = part.conditions.iter().flatten().map(|condition| &condition.id);
            let statements = part.statements.iter().flatten().flat_map(|of| [&of.id, &of.text]);
            for text in words.chain(ends).chain(conditions).chain(statements) {
                check("a text of a part", text, MAX_NAME)?;
            }
        }
        Ok(())
    }
}
