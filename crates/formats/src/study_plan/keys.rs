//! Which keys of a part belong to which design.

use super::wire::PartV1;

/// Keys of each design, besides those of every part.
const KEYS: [(&str, &[&str]); 11] = [
    ("sorting", &["stimuli", "groups"]),
    ("relevance", &["stimuli", "adjectives", "questionnaire"]),
    ("rating", &["stimuli", "scales", "own_scales", "questionnaire", "slider_mm"]),
    ("dissimilarity", &["pairs", "first", "second", "stimuli", "reference"]),
    ("same-different", &["pairs", "first", "second", "stimuli", "segments"]),
    (
        "staircase",
        &[
            "varied",
            "stimulus",
            "start",
            "lowest",
            "highest",
            "down",
            "factors",
            "later_factor",
            "reversals",
            "averaged",
            "max_trials",
            "feedback_reversals",
        ],
    ),
    ("similarity", &["pairs", "first", "second", "stimuli", "points", "low", "high"]),
    ("likert", &["conditions", "statements", "prompts", "own_prompts", "points", "low", "high"]),
    ("abx", &["pairs", "first", "second", "stimuli"]),
    ("mushra", &["pages"]),
    ("anchors", &["stimuli", "low_anchor", "high_anchor"]),
];

/// Keys of the part that its design does not have; `None` if there is no such design.
pub(super) fn stray_keys(part: &PartV1) -> Option<Vec<&'static str>> {
    let design = part.design.as_deref()?;
    let (_, known) = KEYS.iter().find(|(of, _)| *of == design)?;
    Some(stated(part).into_iter().filter(|key| !known.contains(key)).collect())
}

/// Keys of designs that the part states.
fn stated(part: &PartV1) -> Vec<&'static str> {
    let keys = [
        ("stimuli", part.stimuli.is_some()),
        ("groups", part.groups.is_some()),
        ("questionnaire", part.questionnaire.is_some()),
        ("adjectives", part.adjectives.is_some()),
        ("scales", part.scales.is_some()),
        ("own_scales", part.own_scales.is_some()),
        ("slider_mm", part.slider_mm.is_some()),
        ("pairs", part.pairs.is_some()),
        ("first", part.first.is_some()),
        ("second", part.second.is_some()),
        ("reference", part.reference.is_some()),
        ("segments", part.segments.is_some()),
        ("varied", part.varied.is_some()),
        ("stimulus", part.stimulus.is_some()),
        ("start", part.start.is_some()),
        ("lowest", part.lowest.is_some()),
        ("highest", part.highest.is_some()),
        ("down", part.down.is_some()),
        ("factors", part.factors.is_some()),
        ("later_factor", part.later_factor.is_some()),
        ("reversals", part.reversals.is_some()),
        ("averaged", part.averaged.is_some()),
        ("max_trials", part.max_trials.is_some()),
        ("feedback_reversals", part.feedback_reversals.is_some()),
        ("points", part.points.is_some()),
        ("low", part.low.is_some()),
        ("high", part.high.is_some()),
        ("conditions", part.conditions.is_some()),
        ("statements", part.statements.is_some()),
        ("prompts", part.prompts.is_some()),
        ("own_prompts", part.own_prompts.is_some()),
        ("pages", part.pages.is_some()),
        ("low_anchor", part.low_anchor.is_some()),
        ("high_anchor", part.high_anchor.is_some()),
    ];
    keys.into_iter().filter(|(_, is_stated)| *is_stated).map(|(key, _)| key).collect()
}

#[cfg(test)]
mod tests {
    use super::KEYS;
    use shagreen_core::people::study::plan::Design;

    #[test]
    fn every_design_has_its_keys() {
        assert_eq!(KEYS.map(|(design, _)| design), Design::IDS);
    }
}
