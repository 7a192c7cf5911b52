//! A plan as TOML.

use shagreen_core::people::ratings::AdjectivePair;
use shagreen_core::people::study::plan::{
    Comparison, Design, MushraPage, NoiseColor, Part, Plan, Prompts, ShownControls, Source, Stimulus,
    Variant, Varied,
};
use shagreen_core::people::study::staircase::{LaterFactor, StaircaseRule};

use super::{FORMAT, VERSION};
use crate::questionnaire::is_known_pair;
use crate::toml_text::quoted;

/// Serializes a plan. Reading it again gives the same plan.
pub fn write_study_plan(plan: &Plan) -> Vec<u8> {
    let mut lines = vec![
        format!("format = {}", quoted(FORMAT)),
        format!("version = {}", quoted(VERSION)),
        format!("name = {}", quoted(&plan.name)),
        format!("description = {}", quoted(&plan.description)),
        format!("consent = {}", quoted(&plan.consent)),
        format!("seed = {}", plan.seed),
        format!("part_order = {}", quoted(plan.part_order.id())),
    ];
    if let Some(noise) = plan.masking_noise {
        let color = match noise.color {
            NoiseColor::White => "white",
            NoiseColor::Pink => "pink",
        };
        lines.push(format!("masking_noise = {{ color = {}, level_db = {} }}", quoted(color), noise.level_db));
    }
    lines.extend(plan.stimuli.iter().flat_map(stimulus_lines));
    lines.extend(plan.parts.iter().flat_map(part_lines));
    (lines.join("\n") + "\n").into_bytes()
}

fn stimulus_lines(stimulus: &Stimulus) -> Vec<String> {
    let (key, name) = match &stimulus.source {
        Source::Texture(name) => ("texture", name),
        Source::Profile(name) => ("profile", name),
    };
    let (variant, further) = match stimulus.variant {
        Variant::Original => ("original", None),
        Variant::Authored => ("authored", None),
        Variant::Coded { kbps } => ("coded", Some(format!("kbps = {kbps}"))),
        Variant::Reconstructed { window_mm } => ("reconstructed", Some(format!("window_mm = {window_mm}"))),
    };
    let first = [
        String::new(),
        "[[stimulus]]".to_owned(),
        format!("id = {}", quoted(&stimulus.id)),
        format!("{key} = {}", quoted(name)),
        format!("variant = {}", quoted(variant)),
    ];
    first.into_iter().chain(further).chain([format!("level_db = {}", stimulus.level_db)]).collect()
}

fn part_lines(part: &Part) -> Vec<String> {
    let mut lines = vec![
        String::new(),
        "[[part]]".to_owned(),
        format!("id = {}", quoted(&part.id)),
        format!("title = {}", quoted(&part.title)),
        format!("instructions = {}", quoted(&part.instructions)),
        format!("design = {}", quoted(part.design.id())),
        format!("order = {}", quoted(part.order.id())),
        format!("repeats = {}", part.n_repeats),
        format!("practice = {}", part.n_practice),
    ];
    lines.extend(part.break_every.map(|n| format!("break_every = {n}")));
    lines.extend(part.max_plays.map(|n| format!("max_plays = {n}")));
    lines.push(match part.touch_mm {
        Some(least_mm) => format!("touch_mm = {least_mm}"),
        None => "require_touch = false".to_owned(),
    });
    lines.push(format!("lead_s = {}", part.timing.lead_secs));
    lines.extend(part.timing.stimulus_secs.map(|secs| format!("stimulus_s = {secs}")));
    lines.push(format!("gap_s = {}", part.timing.gap_secs));
    lines.push(format!("pause_s = {}", part.timing.pause_secs));
    lines.extend(design_lines(&part.design));
    lines
}

fn design_lines(design: &Design) -> Vec<String> {
    match design {
        Design::Sorting { stimuli, groups } => {
            let groups: Vec<String> = groups.iter().map(ToString::to_string).collect();
            vec![words("stimuli", stimuli), format!("groups = [{}]", groups.join(", "))]
        }
        Design::Relevance { stimuli, adjectives } => {
            vec![words("stimuli", stimuli), words("adjectives", adjectives)]
        }
        Design::Rating { stimuli, pairs, slider_mm } => {
            let names: Vec<String> = pairs.iter().map(AdjectivePair::name).collect();
            let own: Vec<String> =
                pairs.iter().filter(|pair| !is_known_pair(pair)).map(AdjectivePair::name).collect();
            let first = [words("stimuli", stimuli), words("scales", &names)];
            let declared = (!own.is_empty()).then(|| words("own_scales", &own));
            first.into_iter().chain(declared).chain([format!("slider_mm = {slider_mm}")]).collect()
        }
        Design::Dissimilarity { pairs, reference } => {
            let reference = reference.as_ref().map(|reference| format!("reference = {}", pair(reference)));
            [pairs_line(pairs)].into_iter().chain(reference).collect()
        }
        Design::SameDifferent { pairs, n_segments } => {
            vec![pairs_line(pairs), format!("segments = {n_segments}")]
        }
        Design::Staircase { varied, rule, feedback_reversals } => {
            let mut lines = match varied {
                Varied::Gap => vec![format!("varied = {}", quoted("gap"))],
                Varied::Level { stimulus } => {
                    vec![format!("varied = {}", quoted("level")), format!("stimulus = {}", quoted(stimulus))]
                }
            };
            lines.extend(rule_lines(rule));
            lines.push(format!("feedback_reversals = {feedback_reversals}"));
            lines
        }
        Design::Similarity { pairs, n_points, low, high } => {
            [vec![pairs_line(pairs)], scale_lines(*n_points, low, high)].concat()
        }
        Design::Likert { conditions, statements, prompts, n_points, low, high } => {
            let conditions: Vec<String> = conditions
                .iter()
                .map(|of| format!("{{ id = {}, shown = {} }}", quoted(&of.id), quoted(shown(of.shown))))
                .collect();
            let statements: Vec<String> = statements
                .iter()
                .map(|of| format!("{{ id = {}, text = {} }}", quoted(&of.id), quoted(&of.text)))
                .collect();
            let prompts = match prompts {
                Prompts::Own(n) => format!("own_prompts = {n}"),
                Prompts::Given(texts) => words("prompts", texts),
            };
            let first = vec![
                format!("conditions = [{}]", conditions.join(", ")),
                format!("statements = [{}]", statements.join(", ")),
                prompts,
            ];
            [first, scale_lines(*n_points, low, high)].concat()
        }
        Design::Abx { pairs } => vec![pairs_line(pairs)],
        Design::Mushra { pages } => {
            let pages: Vec<String> = pages.iter().map(page).collect();
            vec![format!("pages = [{}]", pages.join(", "))]
        }
        Design::Anchors { stimuli, low, high } => vec![
            words("stimuli", stimuli),
            format!("low_anchor = {}", quoted(low)),
            format!("high_anchor = {}", quoted(high)),
        ],
    }
}

fn rule_lines(rule: &StaircaseRule) -> Vec<String> {
    let factors: Vec<String> = rule.first_factors.iter().map(ToString::to_string).collect();
    let later = match rule.later {
        LaterFactor::Harmonic => None,
        LaterFactor::Constant(factor) => Some(format!("later_factor = {factor}")),
    };
    let first = [
        format!("start = {}", rule.start),
        format!("lowest = {}", rule.lowest),
        format!("highest = {}", rule.highest),
        format!("down = {}", rule.n_down),
        format!("factors = [{}]", factors.join(", ")),
    ];
    let last = [
        format!("reversals = {}", rule.n_reversals),
        format!("averaged = {}", rule.n_averaged),
        format!("max_trials = {}", rule.max_trials),
    ];
    first.into_iter().chain(later).chain(last).collect()
}

fn scale_lines(n_points: u32, low: &str, high: &str) -> Vec<String> {
    vec![format!("points = {n_points}"), format!("low = {}", quoted(low)), format!("high = {}", quoted(high))]
}

fn shown(shown: ShownControls) -> &'static str {
    match shown {
        ShownControls::Nothing => "nothing",
        ShownControls::Picture => "picture",
        ShownControls::PictureAndSliders => "picture-and-sliders",
    }
}

fn list(texts: &[String]) -> String {
    format!("[{}]", texts.iter().map(|text| quoted(text)).collect::<Vec<_>>().join(", "))
}

fn words(key: &str, texts: &[String]) -> String {
    format!("{key} = {}", list(texts))
}

fn pair(of: &Comparison) -> String {
    format!("[{}, {}]", quoted(&of.first), quoted(&of.second))
}

fn pairs_line(pairs: &[Comparison]) -> String {
    format!("pairs = [{}]", pairs.iter().map(pair).collect::<Vec<_>>().join(", "))
}

fn page(of: &MushraPage) -> String {
    let MushraPage { reference, tested, anchors } = of;
    let reference = quoted(reference);
    format!("{{ reference = {reference}, tested = {}, anchors = {} }}", list(tested), list(anchors))
}
