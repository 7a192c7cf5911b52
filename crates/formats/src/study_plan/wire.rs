//! Keys of a plan file.

use serde::Deserialize;

use crate::text_limits::{MAX_ID, MAX_NAME, MAX_NOTES, TooLong, check};

#[derive(Deserialize)]
pub(super) struct HeaderV1 {
    pub(super) format: String,
    pub(super) version: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PlanV1 {
    #[serde(rename = "format")]
    _format: String,
    #[serde(rename = "version")]
    _version: String,
    pub(super) name: String,
    #[serde(default)]
    pub(super) description: String,
    #[serde(default)]
    pub(super) consent: String,
    pub(super) seed: u64,
    pub(super) part_order: Option<String>,
    pub(super) masking_noise: Option<MaskingNoiseV1>,
    #[serde(default)]
    pub(super) stimulus: Vec<StimulusV1>,
    #[serde(default)]
    pub(super) part: Vec<PartV1>,
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

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct StimulusV1 {
    pub(super) id: String,
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
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PartV1 {
    pub(super) id: String,
    #[serde(default)]
    pub(super) title: String,
    #[serde(default)]
    pub(super) instructions: String,
    pub(super) design: String,
    pub(super) order: Option<String>,
    pub(super) repeats: Option<usize>,
    pub(super) practice: Option<usize>,
    pub(super) break_every: Option<usize>,
    pub(super) max_plays: Option<u32>,
    pub(super) lead_s: Option<f64>,
    pub(super) stimulus_s: Option<f64>,
    pub(super) gap_s: Option<f64>,
    pub(super) pause_s: Option<f64>,
    pub(super) stimuli: Option<Vec<String>>,
    pub(super) groups: Option<Vec<usize>>,
    pub(super) questionnaire: Option<String>,
    pub(super) adjectives: Option<Vec<String>>,
    pub(super) scales: Option<Vec<String>>,
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

impl PlanV1 {
    /// Checks the lengths of the texts that are drawn.
    pub(super) fn check_lengths(&self) -> Result<(), TooLong> {
        check("the name of the study", &self.name, MAX_NAME)?;
        check("the description", &self.description, MAX_NOTES)?;
        check("the consent text", &self.consent, MAX_NOTES)?;
        for stimulus in &self.stimulus {
            check("the id of a stimulus", &stimulus.id, MAX_ID)?;
            for name in stimulus.texture.iter().chain(&stimulus.profile) {
                check("the name of a texture", name, MAX_ID)?;
            }
        }
        for part in &self.part {
            check("the id of a part", &part.id, MAX_ID)?;
            check("the title of a part", &part.title, MAX_NAME)?;
            check("the instructions of a part", &part.instructions, MAX_NOTES)?;
            let words = part.adjectives.iter().chain(&part.scales).chain(&part.prompts).flatten();
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
