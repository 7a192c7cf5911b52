use super::{
    Comparison, Design, Part, Plan, Prompts, Source, Stimulus, Variant, Varied, check_plan, missing_sources,
    problems,
};
use crate::people::study::staircase::{LaterFactor, StaircaseRule};
use crate::people::study::test_plans::{all_designs, ids, part, plan_of, staircase, stimulus, textures};

/// The keys of the problems.
fn keys(plan: &Plan) -> Vec<String> {
    problems(plan).into_iter().map(|problem| problem.key).collect()
}

#[track_caller]
fn check_design(design: Design, key: &str, words: &str) {
    let found = problems(&plan_of(vec![part("a", design)]));
    let is_named = found.iter().any(|of| of.key == format!("part[1].{key}") && of.text.contains(words));
    assert!(is_named, "{found:?}");
}

#[test]
fn a_plan_of_all_designs_has_no_problem() {
    let plan = all_designs();
    assert!(problems(&plan).is_empty(), "{:?}", problems(&plan));
    let used: Vec<&str> = plan.parts.iter().map(|part| part.design.id()).collect();
    assert_eq!(used, Design::IDS);
    assert!(check_plan(&plan).is_ok());
}

#[test]
fn all_problems_are_found_at_once_with_their_keys() {
    let mut plan = all_designs();
    plan.name = " ".to_owned();
    plan.seed = u64::MAX;
    plan.stimuli[1].id = "cork".to_owned();
    plan.stimuli[2].level_db = f64::NAN;
    plan.stimuli.push(Stimulus { id: "again".to_owned(), ..stimulus("brick", Variant::Original) });
    plan.stimuli.push(stimulus("x", Variant::Coded { kbps: 0.0 }));
    plan.parts[2].n_repeats = 0;
    plan.parts[3].break_every = Some(0);
    plan.parts[4].id = "rating".to_owned();
    plan.parts[5].timing.stimulus_secs = Some(-1.0);
    plan.parts[6].touch_mm = Some(0.0);
    let keys = keys(&plan);
    for expected in [
        "name",
        "seed",
        "stimulus[2].id",
        "stimulus[3].level_db",
        "stimulus[13].id",
        "stimulus[14].kbps",
        "part[3].repeats",
        "part[4].break_every",
        "part[5].id",
        "part[6].stimulus_s",
        "part[7].touch_mm",
        // "felt" is gone.
        "part[1].stimuli",
        "part[4].pairs",
    ] {
        assert!(keys.iter().any(|key| key == expected), "{expected} is not among {keys:?}");
    }
    let error = check_plan(&plan).unwrap_err().to_string();
    assert!(error.starts_with("the plan has ") && error.contains("there is no stimulus \"felt\""), "{error}");
}

#[test]
fn every_design_is_checked() {
    let sorting = |stimuli: Vec<String>, groups| Design::Sorting { stimuli, groups };
    check_design(sorting(textures(), vec![6]), "groups", "choose 2 to 5");
    check_design(sorting(textures(), vec![3, 3]), "groups", "twice");
    check_design(sorting(textures(), vec![]), "groups", "add at least one");
    check_design(sorting(ids(&["cork", "felt"]), vec![2]), "stimuli", "2 of 3");
    check_design(sorting(ids(&["cork", "felt", "cork"]), vec![2]), "stimuli", "listed twice");
    let adjectives = ids(&["rough", ""]);
    check_design(Design::Relevance { stimuli: textures(), adjectives }, "adjectives", "is empty");
    let rating = Design::Rating { stimuli: textures(), pairs: Vec::new(), slider_mm: 5.0 };
    check_design(rating.clone(), "scales", "add at least one");
    check_design(rating, "slider_mm", "choose 20 to 500");
    let same = |first: &str, second: &str| vec![Comparison::new(first, second)];
    let twice = [same("cork", "felt"), same("felt", "cork")].concat();
    check_design(Design::Abx { pairs: twice }, "pairs", "compared twice");
    check_design(Design::Abx { pairs: same("cork", "cork") }, "pairs", "paired with itself");
    check_design(Design::Abx { pairs: same("cork", "tin") }, "pairs", "no stimulus \"tin\"");
    check_design(
        Design::SameDifferent { pairs: same("cork", "felt"), n_segments: 0 },
        "segments",
        "choose 1",
    );
    let reference = Some(Comparison::new("cork", "cork"));
    check_design(Design::Dissimilarity { pairs: same("cork", "cork-low"), reference }, "reference", "itself");
    let anchors = Design::Anchors { stimuli: textures(), low: "cork".to_owned(), high: "cork".to_owned() };
    check_design(anchors, "high_anchor", "the same stimulus");
    check_design(Design::Mushra { pages: Vec::new() }, "pages", "add at least one");
    let prompts = Prompts::Given(Vec::new());
    let (low, high) = (String::new(), "good".to_owned());
    let likert =
        Design::Likert { conditions: Vec::new(), statements: Vec::new(), prompts, n_points: 1, low, high };
    for (key, words) in [
        ("conditions", "no condition"),
        ("prompts", "no prompt"),
        ("points", "choose 2 to 11"),
        ("low", "no name"),
    ] {
        check_design(likert.clone(), key, words);
    }
}

#[test]
fn a_rule_that_cannot_work_is_refused() {
    let with = |rule: StaircaseRule| Design::Staircase { varied: Varied::Gap, rule, feedback_reversals: 0 };
    let usual = StaircaseRule::gap_detection;
    check_design(with(StaircaseRule { start: 9.0, ..usual() }), "start", "not between");
    check_design(with(StaircaseRule { start: f64::NAN, ..usual() }), "start", "not between");
    check_design(with(StaircaseRule { lowest: 0.0, ..usual() }), "lowest", "out of range");
    check_design(with(StaircaseRule { n_down: 0, ..usual() }), "down", "choose 1 to 10");
    check_design(with(StaircaseRule { first_factors: vec![0.5], ..usual() }), "factors", "above 1");
    check_design(
        with(StaircaseRule { later: LaterFactor::Constant(1.0), ..usual() }),
        "later_factor",
        "above 1",
    );
    check_design(with(StaircaseRule { n_averaged: 17, ..usual() }), "averaged", "choose 1 to 16");
    let unknown = Varied::Level { stimulus: "tin".to_owned() };
    let design = Design::Staircase { varied: unknown, rule: usual(), feedback_reversals: 0 };
    check_design(design, "stimulus", "no stimulus \"tin\"");
}

#[test]
fn a_study_of_gaps_needs_no_stimuli_but_parts() {
    let mut plan = plan_of(vec![part("gaps", staircase())]);
    plan.stimuli.clear();
    assert!(problems(&plan).is_empty(), "{:?}", problems(&plan));
    plan.parts.clear();
    assert_eq!(keys(&plan), ["part"]);
}

#[test]
fn too_many_trials_are_refused() {
    let many = Part { n_repeats: 1000, ..part("a", Design::Abx { pairs: Vec::new() }) };
    let pairs: Vec<Comparison> = (0..30).map(|i| Comparison::new(format!("t{i}"), "cork")).collect();
    let plan = plan_of(vec![Part { design: Design::Abx { pairs }, ..many }]);
    assert!(problems(&plan).iter().any(|of| of.text.contains("30000 trials exceed")));
}

#[test]
fn tables_for_a_space_name_textures() {
    let plan = all_designs();
    assert_eq!(plan.texture_name("cork"), "cork");
    assert_eq!(plan.texture_name("cork-low"), "cork-low");
    let mut plan = plan;
    plan.stimuli[0].id = "first".to_owned();
    assert_eq!(plan.texture_name("first"), "cork");
    plan.stimuli[0].level_db = 3.0;
    assert_eq!(plan.texture_name("first"), "first");
    assert!(plan.stimulus("felt").is_some() && plan.part("abx").is_some() && plan.part("x").is_none());
}

#[test]
fn references_are_compared_with_each_other_and_themselves() {
    let design = Design::Dissimilarity {
        pairs: vec![Comparison::new("a", "b")],
        reference: Some(Comparison::new("x", "y")),
    };
    let names: Vec<String> = design.comparisons().iter().map(Comparison::name).collect();
    assert_eq!(names, ["a|b", "x|y", "x|x", "y|y"]);
    assert_eq!((design.n_trials(), staircase().n_trials()), (Some(4), None));
}

#[test]
fn textures_that_do_not_exist_are_named_before_a_study_begins() {
    let plan = all_designs();
    assert!(missing_sources(&plan, |_| None).is_empty());
    let advice = |source: &Source| {
        (*source == Source::Texture("felt".to_owned())).then(|| "did you mean felts?".to_owned())
    };
    let missing = missing_sources(&plan, advice);
    let keys: Vec<&str> = missing.iter().map(|problem| problem.key.as_str()).collect();
    // The original and its three versions.
    assert_eq!(
        keys,
        ["stimulus[2].texture", "stimulus[7].texture", "stimulus[10].texture", "stimulus[12].texture"]
    );
    assert_eq!(missing[0].text, "there is no texture \"felt\"; did you mean felts?");
}
