//! The design of a part from its keys.

use shagreen_core::people::ratings::AdjectivePair;
use shagreen_core::people::study::plan::{
    Comparison, Condition, Design, MushraPage, Prompts, ShownControls, Statement, Varied,
};
use shagreen_core::people::study::staircase::{LaterFactor, StaircaseRule};
use shagreen_core::words::near;

use crate::questionnaire::{Questionnaire, is_known_pair, is_same_pair, known_pairs, questionnaires};
use crate::study_plan::key_problem::KeyProblem;
use crate::study_plan::read::Reader;
use crate::study_plan::wire::{ConditionV1, PageV1, PartV1, ShownV1, VariedV1};

/// Largest number of comparisons that lists of stimuli may stand for.
const MOST_PAIRS: usize = 1000;

impl Reader {
    pub(super) fn design(&mut self, part: &PartV1, all_stimuli: &[String]) -> Design {
        let stimuli = || part.stimuli.clone().unwrap_or_else(|| all_stimuli.to_vec());
        match part.design.as_deref().unwrap_or_default() {
            "relevance" => Design::Relevance { stimuli: stimuli(), adjectives: self.adjectives(part) },
            "rating" => Design::Rating {
                stimuli: stimuli(),
                pairs: self.scales(part),
                slider_mm: self.need("slider_mm", part.slider_mm),
            },
            "dissimilarity" => Design::Dissimilarity {
                pairs: self.pairs(part),
                reference: part.reference.as_ref().map(|[first, second]| Comparison::new(first, second)),
            },
            "same-different" => {
                Design::SameDifferent { pairs: self.pairs(part), n_segments: part.segments.unwrap_or(1) }
            }
            "staircase" => self.staircase(part),
            "similarity" => Design::Similarity {
                pairs: self.pairs(part),
                n_points: self.need("points", part.points),
                low: self.need("low", part.low.clone()),
                high: self.need("high", part.high.clone()),
            },
            "likert" => self.likert(part),
            "abx" => Design::Abx { pairs: self.pairs(part) },
            "mushra" => Design::Mushra { pages: self.pages(part) },
            "anchors" => Design::Anchors {
                stimuli: stimuli(),
                low: self.need("low_anchor", part.low_anchor.clone()),
                high: self.need("high_anchor", part.high_anchor.clone()),
            },
            "sorting" => {
                Design::Sorting { stimuli: stimuli(), groups: self.need("groups", part.groups.clone()) }
            }
            // An unknown or missing design, which is reported already.
            _ => Design::Sorting { stimuli: Vec::new(), groups: Vec::new() },
        }
    }

    fn adjectives(&mut self, part: &PartV1) -> Vec<String> {
        match (&part.adjectives, self.questionnaire(part)) {
            (Some(adjectives), _) => adjectives.clone(),
            (None, Some(questionnaire)) => questionnaire.adjectives.clone(),
            (None, None) => self.need("adjectives", None),
        }
    }

    /// Adjective pairs of a part: those of `scales` or of the questionnaire, then the own ones that are not among them.
    fn scales(&mut self, part: &PartV1) -> Vec<AdjectivePair> {
        let own = self.adjective_pairs("own_scales", part.own_scales.as_deref().unwrap_or_default());
        let mut pairs = match (&part.scales, self.questionnaire(part)) {
            (Some(names), _) => {
                let pairs = self.adjective_pairs("scales", names);
                self.check_declared(&pairs, &own);
                pairs
            }
            (None, Some(questionnaire)) => questionnaire.pairs.clone(),
            (None, None) if part.own_scales.is_some() => Vec::new(),
            (None, None) => self.need("scales", None),
        };
        let further = own.into_iter().filter(|pair| !pairs.iter().any(|of| is_same_pair(of, pair)));
        let further: Vec<AdjectivePair> = further.collect();
        pairs.extend(further);
        pairs
    }

    fn adjective_pairs(&mut self, key: &str, names: &[String]) -> Vec<AdjectivePair> {
        let mut pairs = Vec::with_capacity(names.len());
        for name in names {
            match name.parse::<AdjectivePair>() {
                Ok(pair) => pairs.push(pair),
                Err(error) => self.add(key, error.to_string()),
            }
        }
        pairs
    }

    /// Checks that each pair is known, or declared as one of the user's own: most others are misspelled.
    fn check_declared(&mut self, pairs: &[AdjectivePair], own: &[AdjectivePair]) {
        for pair in pairs {
            if is_known_pair(pair) || own.iter().any(|of| is_same_pair(of, pair)) {
                continue;
            }
            let known: Vec<String> = known_pairs().iter().map(AdjectivePair::name).collect();
            let near = near(known.iter().map(String::as_str), &pair.name());
            let meant =
                if near.is_empty() { String::new() } else { format!("did you mean {}? ", near.join(", ")) };
            let text = format!(
                "\"{}\" is not a known pair of adjectives; {meant}known are {}; if it is a pair of your own, list it in `own_scales` too",
                pair.name(),
                known.join(", ")
            );
            self.undeclared.push(KeyProblem::new(format!("{}scales", self.at), text));
        }
    }

    /// The questionnaire that a part names.
    fn questionnaire(&mut self, part: &PartV1) -> Option<&'static Questionnaire> {
        let id = part.questionnaire.as_ref()?;
        // A damaged program file has no questionnaires, and then none has this id.
        let known = questionnaires().unwrap_or_default();
        let found = known.iter().find(|questionnaire| questionnaire.id == *id);
        if found.is_none() {
            let ids: Vec<&str> = known.iter().map(|questionnaire| questionnaire.id.as_str()).collect();
            let text = format!("there is no questionnaire \"{id}\"; choose {}", ids.join(" or "));
            self.add("questionnaire", text);
        }
        found
    }

    fn pairs(&mut self, part: &PartV1) -> Vec<Comparison> {
        match (&part.pairs, &part.first, &part.second, &part.stimuli) {
            (Some(pairs), None, None, None) => {
                pairs.iter().map(|[first, second]| Comparison::new(first, second)).collect()
            }
            (None, Some(first), Some(second), None) => {
                if !self.may_stand_for("first", first.len().saturating_mul(second.len())) {
                    return Vec::new();
                }
                let with =
                    |one: &String| second.iter().map(|other| Comparison::new(one, other)).collect::<Vec<_>>();
                first.iter().flat_map(with).collect()
            }
            (None, None, None, Some(stimuli)) => {
                if !self.may_stand_for("stimuli", stimuli.len().saturating_mul(stimuli.len()) / 2) {
                    return Vec::new();
                }
                let with = |(index, one): (usize, &String)| {
                    stimuli[index + 1..].iter().map(|other| Comparison::new(one, other)).collect::<Vec<_>>()
                };
                stimuli.iter().enumerate().flat_map(with).collect()
            }
            _ => {
                let text = "state what is compared: `pairs`, or `first` and `second` (each with each), or `stimuli` (all pairs)";
                self.add("pairs", text);
                Vec::new()
            }
        }
    }

    fn may_stand_for(&mut self, key: &str, n_pairs: usize) -> bool {
        if n_pairs > MOST_PAIRS {
            self.add(key, format!("the lists stand for more than {MOST_PAIRS} pairs; shorten them"));
        }
        n_pairs <= MOST_PAIRS
    }

    fn staircase(&mut self, part: &PartV1) -> Design {
        let varied = match part.varied {
            Some(VariedV1::Gap) => Varied::Gap,
            Some(VariedV1::Level) => Varied::Level { stimulus: self.need("stimulus", part.stimulus.clone()) },
            None => {
                self.add("varied", "the key is missing; state \"gap\" or \"level\"");
                Varied::Gap
            }
        };
        let rule = StaircaseRule {
            start: self.need("start", part.start),
            lowest: self.need("lowest", part.lowest),
            highest: self.need("highest", part.highest),
            n_down: self.need("down", part.down),
            first_factors: part.factors.clone().unwrap_or_default(),
            later: part.later_factor.map_or(LaterFactor::Harmonic, LaterFactor::Constant),
            n_reversals: self.need("reversals", part.reversals),
            n_averaged: self.need("averaged", part.averaged),
            max_trials: self.need("max_trials", part.max_trials),
        };
        Design::Staircase { varied, rule, feedback_reversals: part.feedback_reversals.unwrap_or(0) }
    }

    fn likert(&mut self, part: &PartV1) -> Design {
        let conditions = self.need("conditions", part.conditions.clone());
        let statements = self.need("statements", part.statements.clone());
        let prompts = match (&part.prompts, part.own_prompts) {
            (Some(texts), None) => Prompts::Given(texts.clone()),
            (None, Some(n)) => Prompts::Own(n),
            _ => {
                self.add("prompts", "state either `prompts` (texts for all) or `own_prompts` (a number)");
                Prompts::Own(1)
            }
        };
        let condition = |of: ConditionV1| Condition {
            id: of.id,
            shown: match of.shown {
                ShownV1::Nothing => ShownControls::Nothing,
                ShownV1::Picture => ShownControls::Picture,
                ShownV1::PictureAndSliders => ShownControls::PictureAndSliders,
            },
        };
        Design::Likert {
            conditions: conditions.into_iter().map(condition).collect(),
            statements: statements.into_iter().map(|of| Statement { id: of.id, text: of.text }).collect(),
            prompts,
            n_points: self.need("points", part.points),
            low: self.need("low", part.low.clone()),
            high: self.need("high", part.high.clone()),
        }
    }

    fn pages(&mut self, part: &PartV1) -> Vec<MushraPage> {
        let pages = self.need("pages", part.pages.clone());
        let page =
            |of: PageV1| MushraPage { reference: of.reference, tested: of.tested, anchors: of.anchors };
        pages.into_iter().map(page).collect()
    }
}
