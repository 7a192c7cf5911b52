use std::collections::BTreeSet;

use proptest::prelude::{prop_assert, prop_assert_eq, proptest};
use shagreen_core::people::ratings::AdjectivePair;
use shagreen_core::people::study::order::Order;
use shagreen_core::people::study::plan::{
    Comparison, Condition, Design, MaskingNoise, MushraPage, NoiseColor, Part, Plan, Prompts, ShownControls,
    Source, Statement, Stimulus, Timing, USUAL_TOUCH_MM, Variant, Varied, problems,
};
use shagreen_core::people::study::staircase::{LaterFactor, StaircaseRule};

use super::{
    StudyPlanError, has_placeholder_consent, read_logged_plan, read_study_plan, read_study_plan_with,
    study_template, study_templates, write_study_plan,
};
use crate::starter::starter_library;

/// A plan of two textures with this part.
fn with_part(part: &str) -> String {
    format!(
        "format = \"shagreen-study\"\nversion = \"1.0\"\nname = \"a\"\nseed = 1\n\n[[stimulus]]\nid = \"cork\"\ntexture = \"cork\"\n\n[[stimulus]]\nid = \"felt\"\ntexture = \"felt\"\n\n[[part]]\nid = \"p\"\n{part}\n"
    )
}

#[track_caller]
fn check_error(text: &str, words: &[&str]) {
    let error = read_study_plan(text.as_bytes()).unwrap_err();
    let message = error.to_string();
    assert!(!message.contains('\n'), "{message}");
    for expected in words {
        assert!(message.contains(expected), "{expected:?} is not in {message:?}");
    }
}

#[test]
fn the_templates_can_be_run_and_have_every_design() {
    let library = starter_library().unwrap();
    let textures: BTreeSet<&str> = library.textures.iter().map(|texture| texture.id.as_str()).collect();
    let mut designs = BTreeSet::new();
    for template in study_templates() {
        let plan = read_study_plan(template.text.as_bytes())
            .unwrap_or_else(|error| panic!("{}: {error}", template.id));
        for stimulus in &plan.stimuli {
            match &stimulus.source {
                Source::Texture(name) => assert!(textures.contains(name.as_str()), "{}: {name}", template.id),
                Source::Profile(name) => assert!(["A", "B", "C", "D"].contains(&name.as_str()), "{name}"),
            }
        }
        assert!(!plan.consent.is_empty() && !plan.description.is_empty(), "{}", template.id);
        assert!(has_placeholder_consent(&plan), "{}", template.id);
        assert!(!has_placeholder_consent(&Plan { consent: "I agree.".to_owned(), ..plan.clone() }));
        assert!(plan.parts.iter().all(|part| !part.title.is_empty() && !part.instructions.is_empty()));
        designs.extend(plan.parts.iter().map(|part| part.design.id()));
        // Comments are for people; what is written has the same meaning without them.
        assert_eq!(read_study_plan(&write_study_plan(&plan)), Ok(plan), "{}", template.id);
    }
    assert_eq!(designs, BTreeSet::from(Design::IDS));
    assert!(study_template("abx").is_some() && study_template("abc").is_none());
}

/// The numbers of the published experiments.
#[test]
fn the_templates_have_the_published_structure() {
    let part =
        |id: &str| read_study_plan(study_template(id).unwrap().text.as_bytes()).unwrap().parts.remove(0);
    let Design::Sorting { stimuli, groups } = part("cluster-sorting").design else { panic!("sorting") };
    assert_eq!((stimuli.len(), groups), (25, vec![3, 6, 9]));
    let Design::Relevance { adjectives, .. } = part("adjective-relevance").design else {
        panic!("relevance")
    };
    assert_eq!(adjectives.len(), 25);
    let Design::Rating { pairs, slider_mm, .. } = part("bipolar-rating").design else { panic!("rating") };
    assert_eq!((pairs.len(), slider_mm), (5, 127.0));
    let dissimilarity = part("authored-dissimilarity");
    let Design::Dissimilarity { pairs, reference } = dissimilarity.design else { panic!("dissimilarity") };
    assert_eq!((pairs.len(), reference.is_some(), dissimilarity.n_repeats), (36, true, 2));
    let quality = read_study_plan(study_template("same-different").unwrap().text.as_bytes()).unwrap();
    assert_eq!(quality.parts.len(), 5);
    for part in &quality.parts {
        assert_eq!(part.design.n_trials().map(|n| n * part.n_repeats), Some(180));
        assert_eq!(
            (part.timing.stimulus_secs, part.timing.gap_secs, part.timing.pause_secs),
            (Some(0.8), 0.6, 1.3)
        );
    }
    let Design::Staircase { rule, varied, feedback_reversals } = part("gap-detection").design else {
        panic!("staircase")
    };
    assert_eq!((rule, varied, feedback_reversals), (StaircaseRule::gap_detection(), Varied::Gap, 2));
    let similarity = part("reconstruction-similarity");
    assert_eq!(
        (similarity.design.n_trials(), similarity.n_repeats, similarity.n_practice),
        (Some(28), 2, 24)
    );
    let Design::Likert { conditions, statements, prompts, n_points, .. } = part("text-to-texture").design
    else {
        panic!("likert")
    };
    assert_eq!((conditions.len(), statements.len(), prompts.n_texts(), n_points), (3, 5, 5, 7));
}

#[test]
fn an_unknown_key_is_named_with_its_line() {
    check_error(
        &with_part("design = \"abx\"\npears = []"),
        &["line 17, part[1].pears: the key is unknown; did you mean pairs?"],
    );
    check_error(
        "format = \"shagreen-study\"\nversion = \"1.0\"\nname = 3\nseed = 1",
        &[
            "the plan has 2 problems: part: there is no part",
            "line 3, name: it has the number 3 where a text",
        ],
    );
    check_error("format = \"shagreen-study\"\nversion = \"1.0\"\nname = = 3", &["at line 3"]);
    check_error("x = 1", &["the field `format` is missing"]);
    check_error("format = \"shagreen-actuator\"\nversion = \"1.0\"", &["not a plan of a study"]);
    check_error("format = \"shagreen-study\"\nversion = \"2.0\"\nnew = 1", &["version 2.0", "newer version"]);
    let error = read_study_plan(b"name = \"\xff\"").unwrap_err();
    assert_eq!(error, StudyPlanError::NotText { at: 8 });
    let long =
        with_part("design = \"abx\"").replace("name = \"a\"", &format!("name = \"{}\"", "a".repeat(2000)));
    check_error(&long, &["the name of the study", "2000 characters"]);
}

/// Misspelled keys, values of another kind, missing keys, unknown stimuli and missing textures together, in their order.
#[test]
fn problems_of_all_kinds_are_reported_at_once() {
    let text = "format = \"shagreen-study\"\nversion = \"1.0\"\nnme = \"a\"\nseed = \"one\"\nmasking_noise = { color = \"blue\", level_db = -20 }\n\n[[stimulus]]\nid = \"cork\"\ntexture = \"crok\"\nlevel = 3\n\n[[stimulus]]\nid = \"felt\"\ntexture = \"felt\"\nvariant = \"codet\"\nkbps = 3\n\n[[part]]\ndesign = \"abx\"\npairs = [[\"cork\", \"tin\"]]\nrepeats = \"two\"\n";
    let advice = |source: &Source| {
        (*source == Source::Texture("crok".to_owned())).then(|| "did you mean cork?".to_owned())
    };
    let StudyPlanError::Problems(problems) = read_study_plan_with(text.as_bytes(), advice).unwrap_err()
    else {
        panic!("a list of problems")
    };
    let found: Vec<(Option<usize>, &str)> =
        problems.iter().map(|problem| (problem.line, problem.key.as_str())).collect();
    let expected = [
        (None, "name"),
        (Some(3), "nme"),
        (Some(4), "seed"),
        (Some(5), "masking_noise"),
        (Some(9), "stimulus[1].texture"),
        (Some(10), "stimulus[1].level"),
        (Some(15), "stimulus[2].variant"),
        (Some(18), "part[1].id"),
        (Some(20), "part[1].pairs"),
        (Some(21), "part[1].repeats"),
    ];
    assert_eq!(found, expected, "{problems:?}");
    for (index, words) in [
        (0, "the key is missing; add it"),
        (1, "did you mean name?"),
        (3, "`blue` is unknown; the known words are `white`"),
        (4, "there is no texture \"crok\"; did you mean cork?"),
        (5, "did you mean level_db?"),
        (6, "`codet` is unknown; the known words are `original`"),
        (8, "there is no stimulus \"tin\""),
        (9, "it has the text \"two\" where a whole number"),
    ] {
        assert!(problems[index].text.contains(words), "{words}: {}", problems[index]);
    }
}

/// A profile of another kind has one problem: no texture with the identifier of its stimulus is missing.
#[test]
fn a_profile_that_is_no_text_is_reported_once() {
    let text = with_part("design = \"abx\"\npairs = [[\"cork\", \"felt\"]]");
    let text = text.replace("texture = \"felt\"", "profile = 3");
    let advice = |source: &Source| {
        (*source != Source::Texture("cork".to_owned())).then(|| "correct the name".to_owned())
    };
    let error = read_study_plan_with(text.as_bytes(), advice).unwrap_err().to_string();
    assert!(error.starts_with("the plan has 1 problem: line 12, stimulus[2].profile: it has the"), "{error}");
}

#[test]
fn a_table_with_one_pair_of_brackets_is_explained() {
    let text = with_part("design = \"abx\"\npairs = [[\"cork\", \"felt\"]]").replace("[[part]]", "[part]");
    check_error(
        &text,
        &["the plan has 1 problem: line 14, part: one pair of brackets is missing; write [[part]]"],
    );
}

#[test]
fn pairs_of_adjectives_are_known_or_declared() {
    let rated = |keys: &str| with_part(&format!("design = \"rating\"\nslider_mm = 127\n{keys}"));
    check_error(
        &rated("scales = [\"rough-smooth\", \"rogh-smooth\", \"cold-warm\"]"),
        &[
            "the plan has 2 problems: line 18, part[1].scales: \"rogh-smooth\" is not a known pair of adjectives; did you mean rough-smooth? known are rough-smooth, flat-bumpy",
            "\"cold-warm\" is not a known pair of adjectives; known are rough-smooth",
            "list it in `own_scales` too",
        ],
    );
    let pairs = |keys: &str| {
        let plan = read_study_plan(rated(keys).as_bytes()).unwrap();
        let Design::Rating { pairs, .. } = &plan.parts[0].design else { panic!("ratings") };
        let names: Vec<String> = pairs.iter().map(AdjectivePair::name).collect();
        // The declaration is written too.
        assert_eq!(read_study_plan(&write_study_plan(&plan)), Ok(plan));
        names
    };
    assert_eq!(pairs("scales = [\"Soft - Hard\"]"), ["Soft-Hard"], "either adjective can be at 0");
    let declared = "own_scales = [\"cold-warm\", \"wet-dry\"]";
    assert_eq!(pairs(declared), ["cold-warm", "wet-dry"]);
    assert_eq!(
        pairs(&format!("scales = [\"wet-dry\", \"hard-soft\"]\n{declared}")),
        ["wet-dry", "hard-soft", "cold-warm"]
    );
    assert_eq!(pairs(&format!("questionnaire = \"authoring-2020\"\n{declared}")).len(), 6);
    // A log of an earlier version may have pairs that were never declared.
    let earlier = rated("scales = [\"cold-warm\"]");
    assert!(read_study_plan(earlier.as_bytes()).is_err() && read_logged_plan(earlier.as_bytes()).is_ok());
}

#[test]
fn a_touch_is_required_unless_the_plan_says_otherwise() {
    let touch_mm = |keys: &str| {
        let text = with_part(&format!("design = \"abx\"\npairs = [[\"cork\", \"felt\"]]\n{keys}"));
        let plan = read_study_plan(text.as_bytes()).unwrap();
        let touch_mm = plan.parts[0].touch_mm;
        assert_eq!(read_study_plan(&write_study_plan(&plan)), Ok(plan));
        touch_mm
    };
    assert_eq!(touch_mm(""), Some(USUAL_TOUCH_MM));
    assert_eq!(touch_mm("require_touch = true"), Some(USUAL_TOUCH_MM));
    assert_eq!(touch_mm("touch_mm = 7.5"), Some(7.5));
    assert_eq!(touch_mm("require_touch = false"), None);
    let with = |keys: &str| with_part(&format!("design = \"abx\"\npairs = [[\"cork\", \"felt\"]]\n{keys}"));
    check_error(&with("touch_mm = 0"), &["line 18, part[1].touch_mm: 0 is out of range; choose 1 to 1000"]);
    check_error(&with("require_touch = false\ntouch_mm = 5"), &["line 19, part[1].touch_mm: no touch"]);
}

/// Problems of the keys and of the plan together, each with its line.
#[test]
fn all_problems_are_reported_at_once_with_their_lines() {
    let text =
        with_part("design = \"rating\"\nscales = [\"rough\"]\ngroups = [2]\norder = \"random\"\nrepeats = 0");
    check_error(
        &text,
        &[
            "the plan has 5 problems: ",
            "line 18, part[1].groups: the design rating has no such key",
            "line 17, part[1].scales: \"rough\" names only one pole",
            "line 14, part[1].slider_mm: the key is missing",
            "line 19, part[1].order: \"random\" is not an order; choose one of listed, shuffled",
            "line 20, part[1].repeats: 0 is out of range; choose 1 to 1000",
        ],
    );
    let text = with_part("design = \"abx\"\npairs = [[\"cork\", \"tin\"]]");
    check_error(&text, &["line 17, part[1].pairs: there is no stimulus \"tin\""]);
    // A wrong design hides what follows from it.
    check_error(
        &with_part("design = \"ABX\"\nrepeats = 0"),
        &["the plan has 1 problem: line 16, part[1].design"],
    );
    check_error(&with_part("design = \"abx\""), &["part[1].pairs: state what is compared"]);
    check_error(
        &with_part("design = \"relevance\"\nquestionnaire = \"x\""),
        &["there is no questionnaire \"x\"; choose vrst-2023 or authoring-2020"],
    );
    let stimulus = |keys: &str| {
        with_part("design = \"abx\"\nstimuli = [\"cork\", \"felt\"]").replace("texture = \"felt\"", keys)
    };
    check_error(&stimulus(""), &["stimulus[2].texture: state either"]);
    check_error(
        &stimulus("texture = \"felt\"\nkbps = 3"),
        &["stimulus[2].kbps: the variant does not have this key"],
    );
    check_error(&stimulus("profile = \"A\"\nvariant = \"coded\""), &["stimulus[2].kbps: the key is missing"]);
}

#[test]
fn lists_stand_for_pairs() {
    let pairs = |keys: &str| {
        let plan =
            read_study_plan(with_part(&format!("design = \"dissimilarity\"\n{keys}")).as_bytes()).unwrap();
        plan.parts[0].design.comparisons().iter().map(Comparison::name).collect::<Vec<_>>()
    };
    assert_eq!(pairs("stimuli = [\"cork\", \"felt\"]"), ["cork|felt"]);
    assert_eq!(pairs("first = [\"cork\"]\nsecond = [\"cork\", \"felt\"]"), ["cork|cork", "cork|felt"]);
    let many = format!("design = \"abx\"\nstimuli = [{}]", "\"cork\", ".repeat(60));
    check_error(&with_part(&many), &["stand for more than 1000 pairs"]);
}

#[test]
fn all_stimuli_are_used_if_none_are_listed() {
    let plan = read_study_plan(with_part("design = \"sorting\"\ngroups = [2]").as_bytes());
    // Two textures are too few, so the list was filled.
    let message = plan.unwrap_err().to_string();
    assert!(message.contains("2 of 3 stimuli"), "{message}");
}

/// A plan with every kind of value.
fn full(number: f64, count: usize, text: &str) -> Plan {
    let stimulus = |id: &str, source: Source, variant: Variant| Stimulus {
        id: id.to_owned(),
        source,
        variant,
        level_db: number,
    };
    let texture = |name: &str| Source::Texture(name.to_owned());
    let part = |id: &str, design: Design| Part {
        id: id.to_owned(),
        title: text.to_owned(),
        instructions: text.to_owned(),
        design,
        order: Order::ALL[count % 4],
        n_repeats: 1 + count % 3,
        n_practice: count,
        break_every: (count > 0).then_some(count),
        max_plays: None,
        touch_mm: count.is_multiple_of(2).then_some(1.0 + number),
        timing: Timing {
            lead_secs: number,
            stimulus_secs: Some(number),
            gap_secs: 0.0,
            pause_secs: 0.1 + 0.2,
        },
    };
    let pairs = vec![Comparison::new("a", "b"), Comparison::new("a", "c")];
    let ids = |ids: [&str; 2]| ids.map(str::to_owned).to_vec();
    let rule = StaircaseRule { later: LaterFactor::Constant(1.0 + number), ..StaircaseRule::gap_detection() };
    let likert = Design::Likert {
        conditions: vec![Condition { id: "x".to_owned(), shown: ShownControls::PictureAndSliders }],
        statements: vec![Statement { id: "s".to_owned(), text: format!("It is {text}") }],
        prompts: Prompts::Given(vec!["bark".to_owned()]),
        n_points: 7,
        low: "no".to_owned(),
        high: "yes".to_owned(),
    };
    Plan {
        name: format!("Plan {text}"),
        description: text.to_owned(),
        consent: text.to_owned(),
        seed: 7 + count as u64,
        part_order: Order::LatinSquare,
        masking_noise: Some(MaskingNoise { color: NoiseColor::Pink, level_db: -number }),
        stimuli: vec![
            stimulus("a", texture("a"), Variant::Original),
            stimulus("b", texture("a"), Variant::Authored),
            stimulus("c", texture("a"), Variant::Coded { kbps: 1.0 + number }),
            stimulus("d", Source::Profile("A".to_owned()), Variant::Reconstructed { window_mm: number }),
        ],
        parts: vec![
            part(
                "1",
                Design::Dissimilarity { pairs: pairs.clone(), reference: Some(Comparison::new("c", "d")) },
            ),
            part(
                "2",
                Design::Staircase {
                    varied: Varied::Level { stimulus: "a".to_owned() },
                    rule,
                    feedback_reversals: 1,
                },
            ),
            part("3", likert),
            part("4", Design::Abx { pairs: pairs.clone() }),
            part("5", Design::SameDifferent { pairs, n_segments: 2 }),
            part(
                "6",
                Design::Anchors { stimuli: ids(["a", "b"]), low: "c".to_owned(), high: "d".to_owned() },
            ),
            part(
                "7",
                Design::Mushra {
                    pages: vec![MushraPage {
                        reference: "a".to_owned(),
                        tested: ids(["b", "c"]),
                        anchors: vec!["d".to_owned()],
                    }],
                },
            ),
        ],
    }
}

proptest! {
    /// Every plan that can be run comes back from its file.
    #[test]
    fn plans_come_back(number in 0.06..40.0_f64, count in 0_usize..20, text in "[ -~\n\tä\"\\\\]{0,40}") {
        let plan = full(number, count, &text);
        prop_assert!(problems(&plan).is_empty(), "{:?}", problems(&plan));
        prop_assert_eq!(read_study_plan(&write_study_plan(&plan)), Ok(plan));
    }
}
