//! Which stimuli a part of a plan presents.

use std::collections::BTreeSet;

use shagreen_core::people::study::plan::{
    Comparison, Design, MushraPage, Part, Plan, Source, Variant, Varied,
};

/// Identifiers of the stimuli that a part presents, each once, in the order of its lists. Questionnaires present none: their
/// textures are made from texts.
pub(super) fn stimuli_of(part: &Part) -> Vec<&str> {
    let mut all: Vec<&str> = Vec::new();
    match &part.design {
        Design::Sorting { stimuli, .. }
        | Design::Relevance { stimuli, .. }
        | Design::Rating { stimuli, .. } => {
            all.extend(stimuli.iter().map(String::as_str));
        }
        Design::Dissimilarity { pairs, reference } => {
            all.extend(both(pairs));
            all.extend(both(reference.as_slice()));
        }
        Design::SameDifferent { pairs, .. } | Design::Similarity { pairs, .. } | Design::Abx { pairs } => {
            all.extend(both(pairs));
        }
        Design::Staircase { varied: Varied::Level { stimulus }, .. } => all.push(stimulus),
        Design::Staircase { varied: Varied::Gap, .. } | Design::Likert { .. } => {}
        Design::Mushra { pages } => {
            for MushraPage { reference, tested, anchors } in pages {
                all.push(reference);
                all.extend(tested.iter().chain(anchors).map(String::as_str));
            }
        }
        Design::Anchors { stimuli, low, high } => {
            all.extend(stimuli.iter().chain([low, high]).map(String::as_str));
        }
    }
    let mut seen = BTreeSet::new();
    all.retain(|id| seen.insert(*id));
    all
}

fn both(pairs: &[Comparison]) -> impl Iterator<Item = &str> {
    pairs.iter().flat_map(|pair| [pair.first.as_str(), pair.second.as_str()])
}

/// Whether a part presents signals: if one of its stimuli is decoded or reconstructed from the signal of a texture, all of them
/// are signals, so that nothing but the processing differs.
pub(super) fn presents_signals(plan: &Plan, part: &Part) -> bool {
    stimuli_of(part).into_iter().filter_map(|id| plan.stimulus(id)).any(|stimulus| {
        matches!(
            (&stimulus.source, stimulus.variant),
            (_, Variant::Coded { .. }) | (Source::Texture(_), Variant::Reconstructed { .. })
        )
    })
}
