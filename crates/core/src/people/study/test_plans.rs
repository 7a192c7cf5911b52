//! Small plans for tests.

use crate::people::ratings::AdjectivePair;
use crate::people::study::order::Order;
use crate::people::study::plan::{
    Comparison, Condition, Design, MushraPage, Part, Plan, Prompts, ShownControls, Source, Statement,
    Stimulus, Timing, USUAL_TOUCH_MM, Variant, Varied,
};
use crate::people::study::staircase::StaircaseRule;

pub(crate) fn stimulus(id: &str, variant: Variant) -> Stimulus {
    let texture = id.split('-').next().unwrap_or(id).to_owned();
    Stimulus { id: id.to_owned(), source: Source::Texture(texture), variant, level_db: 0.0 }
}

pub(crate) fn part(id: &str, design: Design) -> Part {
    Part {
        id: id.to_owned(),
        title: id.to_owned(),
        instructions: format!("Do {id}."),
        design,
        order: Order::Shuffled,
        n_repeats: 1,
        n_practice: 0,
        break_every: None,
        max_plays: None,
        touch_mm: Some(USUAL_TOUCH_MM),
        timing: Timing::default(),
    }
}

/// A plan with these parts and five textures, three of them in further versions.
pub(crate) fn plan_of(parts: Vec<Part>) -> Plan {
    let originals = ["cork", "felt", "glass", "denim", "brick"].map(|id| stimulus(id, Variant::Original));
    let coded = ["cork-low", "felt-low", "glass-low"].map(|id| stimulus(id, Variant::Coded { kbps: 1.75 }));
    let high = ["cork-high", "felt-high"].map(|id| stimulus(id, Variant::Coded { kbps: 3.15 }));
    let authored = ["cork-authored", "felt-authored"].map(|id| stimulus(id, Variant::Authored));
    Plan {
        name: "All".to_owned(),
        description: String::new(),
        consent: "I agree.".to_owned(),
        seed: 7,
        part_order: Order::Listed,
        masking_noise: None,
        stimuli: originals.into_iter().chain(coded).chain(high).chain(authored).collect(),
        parts,
    }
}

pub(crate) fn ids(ids: &[&str]) -> Vec<String> {
    ids.iter().map(|id| (*id).to_owned()).collect()
}

pub(crate) fn textures() -> Vec<String> {
    ids(&["cork", "felt", "glass", "denim", "brick"])
}

/// Pairs of an original and its version at a low bit rate.
pub(crate) fn coded_pairs() -> Vec<Comparison> {
    ["cork", "felt", "glass"].map(|id| Comparison::new(id, format!("{id}-low"))).to_vec()
}

pub(crate) fn dissimilarity() -> Design {
    let pairs = ["cork", "felt"].into_iter().flat_map(|original| {
        ["cork-authored", "felt-authored"].map(|authored| Comparison::new(original, authored))
    });
    Design::Dissimilarity { pairs: pairs.collect(), reference: Some(Comparison::new("brick", "denim")) }
}

pub(crate) fn likert() -> Design {
    let condition = |(id, shown): (&str, ShownControls)| Condition { id: id.to_owned(), shown };
    let statement = |id: &str| Statement { id: id.to_owned(), text: format!("It has {id}.") };
    Design::Likert {
        conditions: [
            ("txt-t", ShownControls::Nothing),
            ("txt-ti", ShownControls::Picture),
            ("txt-tis", ShownControls::PictureAndSliders),
        ]
        .map(condition)
        .to_vec(),
        statements: ["realism", "response", "engagement", "ease", "learning"].map(statement).to_vec(),
        prompts: Prompts::Own(5),
        n_points: 7,
        low: "strongly disagree".to_owned(),
        high: "strongly agree".to_owned(),
    }
}

pub(crate) fn staircase() -> Design {
    Design::Staircase { varied: Varied::Gap, rule: StaircaseRule::gap_detection(), feedback_reversals: 2 }
}

pub(crate) fn rating() -> Design {
    let pairs =
        ["rough-smooth", "hard-soft"].into_iter().filter_map(|name| name.parse::<AdjectivePair>().ok());
    Design::Rating { stimuli: textures(), pairs: pairs.collect(), slider_mm: 127.0 }
}

/// A part of every design.
pub(crate) fn all_designs() -> Plan {
    let similarity = Design::Similarity {
        pairs: coded_pairs(),
        n_points: 5,
        low: "very similar".to_owned(),
        high: "very different".to_owned(),
    };
    let page = |reference: &str| MushraPage {
        reference: reference.to_owned(),
        tested: vec![format!("{reference}-high")],
        anchors: vec![format!("{reference}-low")],
    };
    let parts = vec![
        part("sorting", Design::Sorting { stimuli: textures(), groups: vec![2, 3] }),
        part(
            "relevance",
            Design::Relevance { stimuli: textures(), adjectives: ids(&["rough", "smooth", "soft"]) },
        ),
        part("rating", rating()),
        Part { n_repeats: 2, n_practice: 2, break_every: Some(5), ..part("dissimilarity", dissimilarity()) },
        Part {
            n_repeats: 2,
            order: Order::ShuffledBlocks,
            ..part("same-different", Design::SameDifferent { pairs: coded_pairs(), n_segments: 2 })
        },
        Part { n_practice: 1, ..part("staircase", staircase()) },
        part("similarity", similarity),
        Part { order: Order::LatinSquare, ..part("likert", likert()) },
        Part { n_repeats: 4, ..part("abx", Design::Abx { pairs: coded_pairs() }) },
        part("mushra", Design::Mushra { pages: ["cork", "felt"].map(page).to_vec() }),
        part(
            "anchors",
            Design::Anchors {
                stimuli: ids(&["cork", "felt", "glass"]),
                low: "brick".to_owned(),
                high: "denim".to_owned(),
            },
        ),
    ];
    plan_of(parts)
}
